#!/bin/bash
# An array job of Slurm: each task writes its part of the frames. See docs/farms.md.
#   sbatch --array=0-15 slurm.sh PROJECT FRAMES OUT [OPTION...]
#   sbatch --array=0-15 slurm.sh my-project 0-599 /shared/frames --size 3840x2160 --format exr
#SBATCH --job-name=eddy
#SBATCH --array=0-7
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=2
#SBATCH --output=eddy-%A_%a.log
#SBATCH --open-mode=append
#SBATCH --requeue
# One GPU for each task, where nodes have some (remove one #):
##SBATCH --gres=gpu:1

if [ $# -lt 3 ]; then
    echo "usage: sbatch slurm.sh PROJECT FRAMES OUT [OPTION...]" >&2
    exit 2
fi
project=$1 frames=$2 out=$3
shift 3
# The part is known from SLURM_ARRAY_TASK_ID. Where the task is requeued, pictures that are there are kept.
exec "${EDDY:-eddy}" render "$project" --frames "$frames" --out "$out" --shard auto --progress plain "$@"
