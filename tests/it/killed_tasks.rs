//! Tasks of a simulation that go on from checkpoints and are killed at any time: done again, they write what one run
//! writes, and nothing is half written meanwhile.

use crate::support::{env, program::Bench};
use std::{
    collections::BTreeMap,
    process::{Command, Stdio},
    time::{Duration, Instant},
};

/// Frames of the run, and how often its state is saved.
const FRAMES: u32 = 24;
const EVERY: u32 = 4;
const TASKS: u64 = 3;

/// Returns a call that draws `fluid`, with a hand that stirs it.
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

/// Runs a call to its end. Returns how long it took, and how long from its first file on.
fn timed(b: &Bench, command: &mut Command, folder: &str) -> (Duration, Duration) {
    let began = Instant::now();
    let mut child = command.spawn().unwrap();
    let mut first = None;
    loop {
        if first.is_none() && !b.names(folder).is_empty() {
            first = Some(Instant::now());
        }
        if let Some(status) = child.try_wait().unwrap() {
            assert!(status.success(), "{command:?}: {status}");
            return (began.elapsed(), first.map_or(Duration::ZERO, |first| first.elapsed()));
        }
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Kills a call: one of two at any time after its start, the other while it writes. Returns whether it was under way.
fn killed(b: &Bench, command: &mut Command, folder: &str, kill: u64, (whole, writing): (Duration, Duration)) -> bool {
    let mut child = command.spawn().unwrap();
    // By the golden ratio, which spreads any number of times over the whole.
    let part = (kill as f64 * 0.618_033_988_75 + 0.5).fract();
    if kill.is_multiple_of(2) {
        std::thread::sleep(whole.mul_f64(part));
    } else {
        while b.names(folder).is_empty() && child.try_wait().unwrap().is_none() {
            std::thread::sleep(Duration::from_millis(1));
        }
        std::thread::sleep(writing.mul_f64(part));
    }
    let is_under_way = child.try_wait().unwrap().is_none();
    child.kill().unwrap();
    child.wait().unwrap();
    is_under_way
}

/// Counts what was found after the kills.
#[derive(Debug, Default)]
struct Found {
    kills: u64,
    under_way: u64,
    whole_files: usize,
    temporary_files: usize,
}

impl Found {
    /// Checks the files of a folder after a kill: each is whole, or has the name of a temporary one.
    fn check(&mut self, b: &Bench, folder: &str, whole: &BTreeMap<String, Vec<u8>>) {
        for (name, bytes) in files(b, folder) {
            if is_temporary(&name) {
                self.temporary_files += 1;
                continue;
            }
            let expected = whole.get(&name).unwrap_or_else(|| panic!("{folder}: {name} is of no run"));
            assert!(bytes == *expected, "{folder}: {name} is half written");
            self.whole_files += 1;
        }
    }
}

fn tasks_are_killed(kills: u64) {
    let Some(b) = Bench::with_gpu() else { return };
    assert!(fluid(&b, &["--out", "serial"]).status().unwrap().success());
    let serial = files(&b, "serial");
    assert_eq!(serial.len(), FRAMES as usize);
    let every = EVERY.to_string();
    let checkpoints = |folder: &str| fluid(&b, &["--checkpoint-every", &every, "--checkpoints", folder]);
    let of_checkpoints = timed(&b, &mut checkpoints("states"), "states");
    let states = files(&b, "states");
    assert_eq!(states.len(), (FRAMES / EVERY) as usize);
    let task = |n: u64, from: &str, out: &str| {
        fluid(&b, &["--shard", &format!("{n}/{TASKS}"), "--resume", from, "--out", out])
    };
    // All tasks from one set of checkpoints are the serial run.
    let mut of_task = (Duration::ZERO, Duration::ZERO);
    for n in 0..TASKS {
        let folder = format!("task{n}");
        of_task = timed(&b, &mut task(n, "states", &folder), &folder);
    }
    let parts: Vec<BTreeMap<String, Vec<u8>>> = (0..TASKS).map(|n| files(&b, &format!("task{n}"))).collect();
    assert!(
        parts.iter().flatten().map(|(name, bytes)| (name.clone(), bytes.clone())).collect::<BTreeMap<_, _>>() == serial
    );
    let mut found = Found::default();
    for kill in 0..kills {
        found.kills += 1;
        // Two of the serial runs that write checkpoints, then two of the tasks that go on from them.
        if kill % 4 < 2 {
            let folder = format!("states{kill}");
            found.under_way += u64::from(killed(&b, &mut checkpoints(&folder), &folder, kill, of_checkpoints));
            found.check(&b, &folder, &states);
            // What is there serves already, and half a checkpoint of a dead process is none.
            let some = states.values().next_back().unwrap();
            b.write(&format!("{folder}/.eddy-save-dead00.tmp"), &some[..some.len() / 2]);
            let out = format!("early{kill}");
            assert!(task(TASKS - 1, &folder, &out).status().unwrap().success());
            assert!(files(&b, &out) == parts[TASKS as usize - 1], "a task from the checkpoints that were there");
            assert!(checkpoints(&folder).status().unwrap().success());
            assert!(files(&b, &folder) == states, "{:?} is not {:?}", b.names(&folder), b.names("states"));
        } else {
            let (n, out) = (kill / 2 % TASKS, format!("killed{kill}"));
            found.under_way += u64::from(killed(&b, &mut task(n, "states", &out), &out, kill, of_task));
            found.check(&b, &out, &parts[n as usize]);
            assert!(task(n, "states", &out).status().unwrap().success());
            assert!(files(&b, &out) == parts[n as usize], "{:?}", b.names(&out));
        }
    }
    eprintln!("{found:?}, {of_checkpoints:?} for the checkpoints, {of_task:?} for a task");
    assert!(found.under_way > 0, "no call was killed in time: {found:?}");
}

#[test]
fn killed_tasks_of_a_simulation_are_done_again() {
    tasks_are_killed(4);
}

/// `EDDY_KILLS` says how many times; 50 take some minutes.
#[test]
#[ignore = "takes minutes"]
fn killed_tasks_of_a_simulation_are_done_again_many_times() {
    tasks_are_killed(env::number("EDDY_KILLS", 50));
}
