#!/bin/bash
# Tasks by GNU parallel, on this machine or several: each writes its part of the frames. See docs/farms.md.
#   parallel.sh TASKS PROJECT FRAMES OUT [OPTION...]
#   parallel.sh 16 my-project 0-599 /shared/frames --size 3840x2160
# JOBS tasks run at a time on each machine, by default 2. HOSTS names the machines, as in HOSTS=a,b,: with a shared
# folder and the same paths. ":" is this machine.

if [ $# -lt 4 ] || ! [[ $1 =~ ^[1-9][0-9]*$ ]]; then
    echo "usage: parallel.sh TASKS PROJECT FRAMES OUT [OPTION...]" >&2
    exit 2
fi
tasks=$1 project=$2 frames=$3 out=$4
shift 4
hosts=()
if [ -n "$HOSTS" ]; then
    hosts=(--sshlogin "$HOSTS" --workdir .)
fi
# The part is known from PARALLEL_SEQ. -n0 hands no argument to the command, --quote keeps blanks in names, and a task
# that fails is tried twice.
exec parallel -n0 --quote --jobs "${JOBS:-2}" --retries 2 --line-buffer --tagstring '{#}' --joblog "eddy-$$.joblog" "${hosts[@]}" \
    "${EDDY:-eddy}" render "$project" --frames "$frames" --out "$out" --shard "auto/$tasks" --progress plain "$@" \
    ::: $(seq "$tasks")
