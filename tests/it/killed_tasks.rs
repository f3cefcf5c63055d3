//! Simulation tasks that resume from checkpoints and are killed at any time: run again, they write the same files as a
//! single run, and no file is ever incomplete.

use crate::support::{env, program::Bench};
use std::{
    collections::BTreeMap,
    process::{Command, Stdio},
    time::{Duration, Instant},
};

/// The number of frames, and the number between two checkpoints.
const FRAMES: u32 = 24;
const CHECKPOINT_INTERVAL: u32 = 4;
const TASKS: u64 = 3;

/// Returns a call that draws `fluid`, with a mouse script that stirs it.
fn fluid(b: &Bench, more: &[&str]) -> Command {
    let mut command = b.command();
    let frames = format!("0-{}", FRAMES - 1);
    command.args(["render", "fluid", "--size", "48x27", "--mouse", "0:down 8,8; 9:move 40,20; 18:up"]);
    command.args(["--frames", &frames]).args(more).stdout(Stdio::null()).stderr(Stdio::null());
    command
}

fn files(b: &Bench, folder: &str) -> BTreeMap<String, Vec<u8>> {
    b.names(folder).into_iter().map(|name| (name.clone(), b.bytes(&format!("{folder}/{name}")))).collect()
}

fn is_temporary(name: &str) -> bool {
    name.starts_with(".eddy-save-") && name.ends_with(".tmp")
}

/// Runs a call to its end. Returns its duration, and the time from its first file to its end.
fn run_timed(b: &Bench, command: &mut Command, folder: &str) -> (Duration, Duration) {
    let start = Instant::now();
    let mut child = command.spawn().unwrap();
    let mut first = None;
    loop {
        if first.is_none() && !b.names(folder).is_empty() {
            first = Some(Instant::now());
        }
        if let Some(status) = child.try_wait().unwrap() {
            assert!(status.success(), "{command:?}: {status}");
            return (start.elapsed(), first.map_or(Duration::ZERO, |first| first.elapsed()));
        }
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Kills a call: every second one at any time after its start, the others while it writes. Returns whether it was
/// running.
fn run_and_kill(
    b: &Bench,
    command: &mut Command,
    folder: &str,
    kill: u64,
    (whole, writing): (Duration, Duration),
) -> bool {
    let mut child = command.spawn().unwrap();
    // The golden ratio spreads any number of times evenly over the interval.
    let fraction = (kill as f64 * 0.618_033_988_75 + 0.5).fract();
    if kill.is_multiple_of(2) {
        std::thread::sleep(whole.mul_f64(fraction));
    } else {
        while b.names(folder).is_empty() && child.try_wait().unwrap().is_none() {
            std::thread::sleep(Duration::from_millis(1));
        }
        std::thread::sleep(writing.mul_f64(fraction));
    }
    let was_running = child.try_wait().unwrap().is_none();
    child.kill().unwrap();
    child.wait().unwrap();
    was_running
}

/// Counts of the files that are found after kills.
#[derive(Debug, Default)]
struct KillReport {
    kills: u64,
    killed_while_running: u64,
    complete_files: usize,
    temporary_files: usize,
}

impl KillReport {
    /// Checks the files of a folder after a kill: each is complete, or has the name of a temporary file.
    fn check(&mut self, b: &Bench, folder: &str, expected_files: &BTreeMap<String, Vec<u8>>) {
        for (name, bytes) in files(b, folder) {
            if is_temporary(&name) {
                self.temporary_files += 1;
                continue;
            }
            let expected = expected_files
                .get(&name)
                .unwrap_or_else(|| panic!("{folder}: {name} was not written by the uninterrupted run"));
            assert!(bytes == *expected, "{folder}: {name} is incomplete");
            self.complete_files += 1;
        }
    }
}

fn check_killed_tasks(kills: u64) {
    let Some(b) = Bench::with_gpu() else { return };
    assert!(fluid(&b, &["--out", "serial"]).status().unwrap().success());
    let serial = files(&b, "serial");
    assert_eq!(serial.len(), FRAMES as usize);
    let every = CHECKPOINT_INTERVAL.to_string();
    let checkpoints = |folder: &str| fluid(&b, &["--checkpoint-every", &every, "--checkpoints", folder]);
    let checkpoint_times = run_timed(&b, &mut checkpoints("states"), "states");
    let states = files(&b, "states");
    assert_eq!(states.len(), (FRAMES / CHECKPOINT_INTERVAL) as usize);
    let task = |n: u64, from: &str, out: &str| {
        fluid(&b, &["--shard", &format!("{n}/{TASKS}"), "--resume", from, "--out", out])
    };
    // All tasks together, from one set of checkpoints, equal the serial run.
    let mut task_times = (Duration::ZERO, Duration::ZERO);
    for n in 0..TASKS {
        let folder = format!("task{n}");
        task_times = run_timed(&b, &mut task(n, "states", &folder), &folder);
    }
    let parts: Vec<BTreeMap<String, Vec<u8>>> = (0..TASKS).map(|n| files(&b, &format!("task{n}"))).collect();
    assert!(
        parts.iter().flatten().map(|(name, bytes)| (name.clone(), bytes.clone())).collect::<BTreeMap<_, _>>() == serial
    );
    let mut report = KillReport::default();
    for kill in 0..kills {
        report.kills += 1;
        // Two of the serial runs that write checkpoints, then two of the tasks that resume from them.
        if kill % 4 < 2 {
            let folder = format!("states{kill}");
            report.killed_while_running +=
                u64::from(run_and_kill(&b, &mut checkpoints(&folder), &folder, kill, checkpoint_times));
            report.check(&b, &folder, &states);
            // The existing checkpoints can be used at once, and half a checkpoint of a dead process is ignored.
            let checkpoint = states.values().next_back().unwrap();
            b.write(&format!("{folder}/.eddy-save-dead00.tmp"), &checkpoint[..checkpoint.len() / 2]);
            let out = format!("early{kill}");
            assert!(task(TASKS - 1, &folder, &out).status().unwrap().success());
            assert!(files(&b, &out) == parts[TASKS as usize - 1], "a task that uses the existing checkpoints");
            assert!(checkpoints(&folder).status().unwrap().success());
            assert!(files(&b, &folder) == states, "{:?} is not {:?}", b.names(&folder), b.names("states"));
        } else {
            let (n, out) = (kill / 2 % TASKS, format!("killed{kill}"));
            report.killed_while_running +=
                u64::from(run_and_kill(&b, &mut task(n, "states", &out), &out, kill, task_times));
            report.check(&b, &out, &parts[n as usize]);
            assert!(task(n, "states", &out).status().unwrap().success());
            assert!(files(&b, &out) == parts[n as usize], "{:?}", b.names(&out));
        }
    }
    eprintln!("{report:?}, {checkpoint_times:?} for the checkpoints, {task_times:?} for a task");
    assert!(report.killed_while_running > 0, "no call was killed while it was running: {report:?}");
}

#[test]
fn killed_tasks_of_a_simulation_can_be_run_again() {
    check_killed_tasks(4);
}

/// `EDDY_KILLS` sets the number of kills; 50 take some minutes.
#[test]
#[ignore = "takes minutes"]
fn killed_tasks_of_a_simulation_can_be_run_again_many_times() {
    check_killed_tasks(env::number("EDDY_KILLS", 50));
}
