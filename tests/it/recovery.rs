//! A session that is killed loses at most its last second; the next one offers the rest.

use crate::support::{self, stage::*};
use eddy::{
    gpu::Gpu,
    project::{Origin, Tab},
    session::{
        Answer, Command, DiffLine, EditCommand, FileCommand, Question, Recovered, Request, Session, SessionOptions,
    },
};
use std::{
    env, fs,
    io::{BufRead, BufReader, Write},
    path::{Path, PathBuf},
    process::{self, Stdio},
    sync::Arc,
    time::{Duration, Instant},
};

/// Names the state folder to the process that is killed.
const STATE: &str = "EDDY_TEST_STATE";
const PROJECT: &str = "EDDY_TEST_PROJECT";

fn session(gpu: &Gpu, state: &Path) -> Session {
    let options = SessionOptions { recovery: Some(state.to_owned()), ..SessionOptions::default() };
    Session::with_options(gpu.clone(), Arc::new(|| ()), options).unwrap()
}

/// A session that has opened the project.
fn session_of(gpu: &Gpu, state: &Path, project: &Path) -> Session {
    let mut session = session(gpu, state);
    session.apply(FileCommand::Open(project.display().to_string()));
    session
}

fn recovery_files(state: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(state).into_iter().flatten().flatten();
    entries.map(|e| e.path()).filter(|p| p.extension().is_some_and(|e| e == "json")).collect()
}

/// Ticks until something is so.
fn until<T>(session: &mut Session, what: &str, mut value: impl FnMut(&Session) -> Option<T>) -> T {
    let end = Instant::now() + Duration::from_secs(30);
    loop {
        if let Some(value) = value(session) {
            return value;
        }
        assert!(Instant::now() < end, "never: {what}; notices: {:#?}", session.notices());
        session.tick(Instant::now());
        std::thread::sleep(Duration::from_millis(2));
    }
}

fn offer(session: &mut Session) -> Recovered {
    until(session, "a question", |s| match s.question() {
        Some(Question::Recover(recovered)) => Some((**recovered).clone()),
        _ => None,
    })
}

fn edit(session: &mut Session, text: &str) {
    session.apply(EditCommand::EditText { tab: image_tab(), text: text.into() });
}

fn write_project(dir: &Path) -> PathBuf {
    let folder = dir.join("project");
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("image.glsl"), plain(0.2)).unwrap();
    folder
}

/// Ends a session as a crash does: nothing is forgotten, and what waits is written.
fn crash(session: Session) {
    drop(session);
}

#[test]
fn a_crashed_session_is_offered_with_its_difference_and_taken_up() {
    let Some(gpu) = support::gpu() else { return };
    let dir = tempfile::tempdir().unwrap();
    let (state, folder) = (dir.path().join("state"), write_project(dir.path()));
    let mut first = session_of(&gpu, &state, &folder);
    edit(&mut first, &plain(0.4));
    first.apply(EditCommand::AddTab(Tab::Common));
    crash(first);

    let mut second = session(&gpu, &state);
    second.apply(FileCommand::Open(folder.display().to_string()));
    let offered = offer(&mut second);
    assert_eq!(offered.origin, Origin::Folder { path: folder.clone(), has_manifest: false });
    let tab = offered.tabs.iter().find(|t| t.tab == image_tab()).unwrap();
    let changed: Vec<&DiffLine> = tab.diff.iter().filter(|l| !matches!(l, DiffLine::Both(_))).collect();
    let line = |red: f32| plain(red).lines().nth(1).unwrap().to_owned();
    assert_eq!(changed, [&DiffLine::Disk(line(0.2)), &DiffLine::Mine(line(0.4))]);
    assert!(offered.is_structure_changed, "Common is new");
    assert_eq!(second.text(&image_tab()), plain(0.2), "nothing is taken before the answer");
    second.apply(FileCommand::Answer(Answer::Recover));
    assert_eq!(second.text(&image_tab()), plain(0.4));
    assert!(second.is_dirty() && !second.transport().playing);
    assert!(second.tabs().contains(&Tab::Common));
    assert_eq!(recovery_files(&state).len(), 1, "it is not saved yet");
    // And once more, from what was taken up.
    crash(second);
    let mut third = session(&gpu, &state);
    offer(&mut third);
    third.apply(FileCommand::Answer(Answer::Recover));
    third.apply(FileCommand::Save);
    assert_eq!(fs::read_to_string(folder.join("image.glsl")).unwrap(), plain(0.4));
    until(&mut third, "the file to go", |_| recovery_files(&state).is_empty().then_some(()));
}

#[test]
fn nothing_is_kept_after_a_save_a_discard_or_an_undo() {
    let Some(gpu) = support::gpu() else { return };
    let dir = tempfile::tempdir().unwrap();
    let (state, folder) = (dir.path().join("state"), write_project(dir.path()));
    let mut session = session_of(&gpu, &state, &folder);
    for end in ["undo", "save", "new", "close"] {
        edit(&mut session, &format!("{}// {end}", plain(0.4)));
        until(&mut session, "the file", |_| recovery_files(&state).pop());
        match end {
            "undo" => edit(&mut session, &plain(0.2)),
            "save" => session.apply(FileCommand::Save),
            "new" => {
                session.apply(FileCommand::New);
                session.apply(FileCommand::Answer(Answer::Discard));
            }
            _ => {
                session.apply(FileCommand::Close);
                session.apply(FileCommand::Answer(Answer::Discard));
                assert_eq!(session.take_request(), Some(Request::Exit));
            }
        }
        until(&mut session, end, |_| recovery_files(&state).is_empty().then_some(()));
    }
}

#[test]
fn new_and_preset_work_is_offered_and_can_wait_or_go() {
    let Some(gpu) = support::gpu() else { return };
    let dir = tempfile::tempdir().unwrap();
    let state = dir.path().join("state");
    let mut new = session(&gpu, &state);
    edit(&mut new, &plain(0.4));
    let mut preset = session(&gpu, &state);
    preset.apply(FileCommand::Open("feedback".into()));
    edit(&mut preset, &plain(0.6));
    crash(new);
    crash(preset);
    let mut next = session(&gpu, &state);
    // The one that was open last comes first; `new` was written first.
    let first = offer(&mut next);
    next.apply(FileCommand::Answer(Answer::Cancel));
    let second = offer(&mut next);
    assert_ne!(first.origin, second.origin);
    for origin in [Origin::Unsaved, Origin::Preset("feedback".into())] {
        assert!([&first.origin, &second.origin].contains(&&origin), "{origin:?}");
    }
    next.apply(FileCommand::Answer(Answer::Discard));
    assert!(next.question().is_none());
    until(&mut next, "the discarded one to go", |_| (recovery_files(&state).len() == 1).then_some(()));
    crash(next);
    let mut later = session(&gpu, &state);
    let waited = offer(&mut later);
    assert_eq!(waited.origin, first.origin);
    later.apply(FileCommand::Answer(Answer::Recover));
    assert_eq!(later.project().origin, first.origin);
    assert!(later.is_dirty());
}

#[test]
fn recovered_work_does_not_push_unsaved_work_aside() {
    let Some(gpu) = support::gpu() else { return };
    let dir = tempfile::tempdir().unwrap();
    let (state, folder) = (dir.path().join("state"), write_project(dir.path()));
    let mut first = session_of(&gpu, &state, &folder);
    edit(&mut first, &plain(0.4));
    crash(first);
    let mut next = session(&gpu, &state);
    // Typed before the question was there.
    edit(&mut next, &plain(0.8));
    offer(&mut next);
    next.apply(FileCommand::Answer(Answer::Recover));
    assert!(matches!(next.question(), Some(Question::Unsaved { .. })), "{:?}", next.question());
    assert_eq!(next.text(&image_tab()), plain(0.8));
    next.apply(FileCommand::Answer(Answer::Discard));
    assert_eq!(next.text(&image_tab()), plain(0.4));
}

#[test]
fn commands_without_a_window_keep_nothing() {
    let Some(_) = support::gpu() else { return };
    let dir = tempfile::tempdir().unwrap();
    let project = write_project(dir.path());
    let (state, out) = (dir.path().join("state"), dir.path().join("out"));
    let project = project.to_str().unwrap();
    for arguments in [&["check", project][..], &["render", project, "--size", "8x4", "--out", out.to_str().unwrap()]] {
        let mut eddy = process::Command::new(env!("CARGO_BIN_EXE_eddy"));
        let status = eddy.args(arguments).env("XDG_STATE_HOME", &state).env("HOME", dir.path()).status().unwrap();
        assert!(status.success(), "{arguments:?}");
        assert!(!state.exists() && !dir.path().join(".local").exists(), "{arguments:?}");
    }
}

/// Types a line with a growing number and says each on standard output, until it is killed.
#[test]
#[ignore = "is started by `killed_at_any_moment_it_loses_at_most_a_second`"]
fn a_session_that_types() {
    let (Some(state), Some(project)) = (env::var_os(STATE), env::var_os(PROJECT)) else { return };
    let gpu = support::gpu().unwrap();
    let mut session = session(&gpu, Path::new(&state));
    session.apply(FileCommand::Open(project.to_string_lossy().into_owned()));
    for number in 0.. {
        // No tick between them: a frame may take long, and what is typed must not wait for it.
        edit(&mut session, &format!("// {number}\n{}", plain(0.4)));
        writeln!(std::io::stderr(), "typed {number}").unwrap();
        std::thread::sleep(Duration::from_millis(7));
    }
}

/// Kills a process that types, some time after its first key. Returns the last numbers that it had typed when it was
/// killed and a second before that.
fn kill_one(state: &Path, project: &Path, after: Duration) -> (u64, Option<u64>) {
    let mut child = process::Command::new(env::current_exe().unwrap())
        .args(["recovery::a_session_that_types", "--exact", "--ignored", "--nocapture"])
        .env(STATE, state)
        .env(PROJECT, project)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let lines = BufReader::new(child.stderr.take().unwrap()).lines().map_while(Result::ok);
    let mut typed: Vec<(Instant, u64)> = Vec::new();
    for line in lines {
        let Some(number) = line.strip_prefix("typed ").and_then(|n| n.parse().ok()) else { continue };
        typed.push((Instant::now(), number));
        if typed[0].0.elapsed() >= after {
            break;
        }
    }
    // SIGKILL.
    child.kill().unwrap();
    let killed = Instant::now();
    child.wait().unwrap();
    let second_before = typed.iter().rev().find(|(at, _)| killed - *at >= Duration::from_secs(1));
    (typed.last().expect("it has typed").1, second_before.map(|(_, number)| *number))
}

/// `EDDY_KILLS=100` is a long run.
#[test]
fn killed_at_any_moment_it_loses_at_most_a_second() {
    let Some(gpu) = support::gpu() else { return };
    let dir = tempfile::tempdir().unwrap();
    let project = write_project(dir.path());
    let mut lost = Vec::new();
    let kills = support::env::number("EDDY_KILLS", 25);
    let state = |kill| dir.path().join(format!("state-{kill}"));
    // At every phase of the writing: the steps share no factor with its rhythm.
    let kill = |kill| (kill, kill_one(&state(kill), &project, Duration::from_millis(1000 + kill * 109 % 650)));
    // They wait more than they compute.
    const AT_ONCE: u64 = 4;
    let killed: Vec<_> = std::thread::scope(|scope| {
        let kill = &kill;
        let workers = (0..AT_ONCE)
            .map(|first| scope.spawn(move || (first..kills).step_by(AT_ONCE as usize).map(kill).collect::<Vec<_>>()));
        let workers: Vec<_> = workers.collect();
        workers.into_iter().flat_map(|worker| worker.join().unwrap()).collect()
    });
    for (kill, (last, safe)) in killed {
        let mut next = session(&gpu, &state(kill));
        offer(&mut next);
        next.apply(FileCommand::Answer(Answer::Recover));
        let text = next.text(&image_tab()).to_owned();
        let number: u64 = text.lines().next().unwrap()[3..].parse().unwrap();
        assert_eq!(text, format!("// {number}\n{}", plain(0.4)), "whole");
        assert!(safe.is_none_or(|safe| number >= safe), "kill {kill}: {number} of {safe:?} is there");
        lost.push(last.saturating_sub(number));
    }
    lost.sort_unstable();
    println!("keys lost, of one every 7 ms: median {}, most {}", lost[lost.len() / 2], lost[lost.len() - 1]);
    assert_eq!(fs::read_to_string(project.join("image.glsl")).unwrap(), plain(0.2), "the project itself is untouched");
}
