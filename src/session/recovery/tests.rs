//! Tests of recovery files without a session.

use super::*;
use eddy_project::{self as project, Project, Tab};
use std::{
    fs,
    path::Path,
    sync::Arc,
    time::{Duration, Instant},
};

const TYPED: &str = "// typed";

fn recovery(folder: &Path) -> Recovery {
    Recovery::new(folder.to_owned(), Arc::new(|| ())).unwrap()
}

/// A project on disk, and the same with an edit.
fn edited(folder: &Path, typed: &str) -> Project {
    fs::create_dir_all(folder).unwrap();
    fs::write(folder.join("image.glsl"), "// saved").unwrap();
    let mut project = project::load(folder.to_str().unwrap()).unwrap().project;
    project.source_mut(&Tab::image()).unwrap().text = typed.into();
    project
}

fn typed_in(left: &Left) -> String {
    left.project.source(&Tab::image()).unwrap().text.to_string()
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let paths = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    paths.filter(|path| path.extension().is_some_and(|e| e == "json")).collect()
}

fn until<T>(what: &str, mut value: impl FnMut() -> Option<T>) -> T {
    let end = Instant::now() + Duration::from_secs(20);
    loop {
        if let Some(value) = value() {
            return value;
        }
        assert!(Instant::now() < end, "never: {what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn found(recovery: &Recovery) -> Vec<Left> {
    recovery.scan();
    let news = until("an answer to a scan", || recovery.take_news());
    let News::Found(found) = news else { panic!("trouble") };
    found
}

#[test]
fn changes_are_stored_until_everything_is_saved() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path().join("state");
    let recovery = recovery(&folder);
    recovery.keep(&edited(&dir.path().join("p"), TYPED));
    let file = until("the file", || files(&folder).pop());
    assert!(fs::read_to_string(&file).unwrap().contains(TYPED));
    recovery.keep(&edited(&dir.path().join("p"), "// more"));
    until("the newer text", || fs::read_to_string(&file).unwrap().contains("// more").then_some(()));
    assert_eq!(files(&folder).len(), 1, "one file a project");
    recovery.forget();
    until("an empty folder", || files(&folder).is_empty().then_some(()));
    until("the folder's own lock alone", || (fs::read_dir(&folder).unwrap().count() == 1).then_some(()));
}

#[test]
fn windows_on_one_project_store_separate_work() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path().join("state");
    let project = |typed| edited(&dir.path().join("p"), typed);
    let (first, second) = (recovery(&folder), recovery(&folder));
    first.keep(&project("// first"));
    second.keep(&project("// second"));
    until("two files", || (files(&folder).len() == 2).then_some(()));
    assert!(found(&first).is_empty() && found(&second).is_empty());
    // The first one ends without saving.
    drop(first);
    let left = found(&second);
    assert_eq!(left.iter().map(typed_in).collect::<Vec<_>>(), ["// first"]);
    // A third one starts while the question is open in the second.
    let third = recovery(&folder);
    assert!(found(&third).is_empty());
    second.put_off(left[0].shown.file.clone());
    assert_eq!(until("the put off", || Some(found(&third)).filter(|l| !l.is_empty())).len(), 1);
    second.forget();
    until("one file", || (files(&folder).len() == 1).then_some(()));
}

#[test]
fn adopted_work_keeps_its_file_and_discarded_work_is_removed() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path().join("state");
    for name in ["p", "q"] {
        let crashed = recovery(&folder);
        crashed.keep(&edited(&dir.path().join(name), TYPED));
        drop(crashed);
    }
    let next = recovery(&folder);
    let left = found(&next);
    assert_eq!(left.len(), 2);
    assert_eq!(left[0].shown.tabs.len(), 1);
    assert!(!left[0].shown.is_structure_changed);
    next.discard(left[1].shown.file.clone());
    until("the discarded one to go", || (files(&folder).len() == 1).then_some(()));
    let file = left[0].shown.file.clone();
    next.adopt(file.clone());
    let mut project = left[0].project.clone();
    project.source_mut(&Tab::image()).unwrap().text = "// further".into();
    next.keep(&project);
    until("the same file to go on", || {
        assert_eq!(files(&folder), std::slice::from_ref(&file));
        fs::read_to_string(&file).unwrap().contains("// further").then_some(())
    });
    next.forget();
    until("an empty folder", || files(&folder).is_empty().then_some(()));
}

#[test]
fn saved_work_is_not_offered_and_unreadable_files_are_kept() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path().join("state");
    let crashed = recovery(&folder);
    crashed.keep(&edited(&dir.path().join("p"), TYPED));
    drop(crashed);
    fs::write(dir.path().join("p/image.glsl"), TYPED).unwrap();
    let broken = folder.join("broken-1.json");
    fs::write(&broken, "{\"eddy_snapshot\": 1, \"texts\": [\"half").unwrap();
    let next = recovery(&folder);
    next.scan();
    let News::Trouble(text) = until("a word", || next.take_news()) else { panic!("found") };
    assert!(text.contains(&broken.display().to_string()), "{text}");
    assert_eq!(files(&folder), [broken]);
}

#[test]
fn work_of_a_deleted_project_is_recovered_without_a_place() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path().join("state");
    let crashed = recovery(&folder);
    crashed.keep(&edited(&dir.path().join("p"), TYPED));
    drop(crashed);
    fs::remove_dir_all(dir.path().join("p")).unwrap();
    let next = recovery(&folder);
    let left = found(&next);
    assert_eq!(typed_in(&left[0]), TYPED);
    assert_eq!(left[0].project.origin, project::Origin::Unsaved);
    assert!(left[0].shown.trouble.as_ref().unwrap().contains("not a file"), "{:?}", left[0].shown.trouble);
}

#[test]
fn unwritable_folder_is_reported_once() {
    let dir = tempfile::tempdir().unwrap();
    let blocked = dir.path().join("a file");
    fs::write(&blocked, "").unwrap();
    let recovery = recovery(&blocked.join("state"));
    for _ in 0..3 {
        recovery.keep(&edited(&dir.path().join("p"), TYPED));
        std::thread::sleep(Duration::from_millis(400));
    }
    let News::Trouble(text) = until("a word", || recovery.take_news()) else { panic!("found") };
    assert!(text.contains("a file"), "{text}");
    assert!(recovery.take_news().is_none(), "once");
}

#[test]
fn failed_write_is_retried_without_a_new_edit() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path().join("state");
    // Simulates a full disk: the folder cannot be created.
    fs::write(&folder, "").unwrap();
    let recovery = Recovery::with_retry(folder.clone(), Arc::new(|| ()), Duration::from_millis(10)).unwrap();
    recovery.keep(&edited(&dir.path().join("p"), TYPED));
    let News::Trouble(why) = until("the trouble", || recovery.take_news()) else { panic!("no trouble") };
    assert!(why.contains("could not be written"), "{why}");
    fs::remove_file(&folder).unwrap();
    let file = until("the file", || files(&folder).pop());
    assert!(fs::read_to_string(&file).unwrap().contains(TYPED));
    assert!(recovery.take_news().is_none(), "the failure is reported once");
}

#[cfg(unix)]
#[test]
fn pipes_in_the_folder_are_rejected_without_blocking() {
    for name in [".turn", "p-1.lock"] {
        let dir = tempfile::tempdir().unwrap();
        let folder = dir.path().join("state");
        fs::create_dir(&folder).unwrap();
        make_pipe(&folder.join(name));
        let recovery = recovery(&folder);
        if name == ".turn" {
            recovery.keep(&edited(&dir.path().join("p"), TYPED));
        } else {
            recovery.scan();
        }
        let News::Trouble(why) = until("the trouble", || recovery.take_news()) else { panic!("{name}: no trouble") };
        assert!(why.contains("not a regular file"), "{why}");
    }
}

#[cfg(unix)]
fn make_pipe(path: &Path) {
    assert!(std::process::Command::new("mkfifo").arg(path).status().unwrap().success());
}
