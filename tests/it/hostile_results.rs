//! Malicious results of the lab and output folders: no file outside the folder is written, and no project is opened
//! because a result names it.

use crate::support::program::Bench;
use eddy::lab::{
    RESULTS_FILE, Results,
    stability::{self, CheckedProject, Outcome, StabilityRecord},
};
use std::fs;

fn case(project: &str) -> StabilityRecord {
    StabilityRecord {
        project: project.into(),
        case: "untouched".into(),
        size: (64, 64),
        frames: 1,
        outcome: Some(Outcome::Held),
        ..StabilityRecord::default()
    }
}

#[test]
fn a_report_does_not_open_projects_that_only_a_result_names() {
    let b = Bench::new();
    // Opening a folder removes the temporary files of a killed save, so a removed file would show that it was opened.
    let temporary = "own/.eddy-save-aB3xYz.tmp";
    b.image("own/image.glsl", "fragColor = vec4(1.0);");
    b.write(temporary, "half");
    let own_project = b.path("own").to_str().unwrap().to_owned();
    let results = Results { cases: vec![case(&own_project), case("fluid")], ..Results::default() };
    results.write(&b.path("theirs")).unwrap();
    b.line("lab merge theirs --out merged").expect(0);
    let page = fs::read_to_string(b.path("merged/stability.html")).unwrap();
    assert!(page.contains(&own_project) && b.path(temporary).exists());
    assert_eq!(page.matches("<summary>Bounds</summary>").count(), 1, "only the preset has bounds");
    // The bounds of a project that the user named are shown as well.
    let subject = CheckedProject::load(&own_project, &[]).unwrap();
    stability::write_of(&b.path("merged"), &results, &[subject]).unwrap();
    let page = fs::read_to_string(b.path("merged/stability.html")).unwrap();
    assert_eq!(page.matches("<summary>Bounds</summary>").count(), 2);
}

#[cfg(unix)]
#[test]
fn results_and_reports_are_not_written_through_links() {
    use std::os::unix::fs::symlink;
    let b = Bench::new();
    Results { cases: vec![case("fluid")], ..Results::default() }.write(&b.path("from")).unwrap();
    b.write("mine.txt", "mine");
    for name in [RESULTS_FILE, "index.html", "stability.html", "stability.csv"] {
        for target in ["../mine.txt", "../not there"] {
            let out = b.path("out");
            fs::create_dir_all(&out).unwrap();
            symlink(target, out.join(name)).unwrap();
            let run = b.line("lab merge from --out out").expect(2);
            let expected = if target == "../mine.txt" { "a link leads out of" } else { "a broken link" };
            assert!(run.err.contains(expected) && run.err.contains(name), "{}", run.err);
            assert_eq!(fs::read_to_string(b.path("mine.txt")).unwrap(), "mine");
            assert!(!b.path("not there").exists());
            fs::remove_dir_all(out).unwrap();
        }
    }
    // A link to a file in the same folder, which a user may have made, is followed.
    b.write("out/kept.html", "before");
    symlink("kept.html", b.path("out/index.html")).unwrap();
    b.line("lab merge from --out out").expect(0);
    assert!(fs::read_to_string(b.path("out/kept.html")).unwrap().contains("Speed against error"));
    // A pipe, whose reading would block.
    fs::create_dir(b.path("pipe")).unwrap();
    let pipe = b.path("pipe").join(RESULTS_FILE);
    assert!(std::process::Command::new("mkfifo").arg(pipe).status().unwrap().success());
    let run = b.line("lab merge pipe --out other").expect(2);
    assert!(run.err.contains("is not a regular file"), "{}", run.err);
}

#[cfg(unix)]
#[test]
fn pictures_are_not_written_into_a_folder_through_links() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("p/image.glsl", "fragColor = vec4(1.0);");
    b.write("mine.txt", "mine");
    fs::create_dir(b.path("p/pictures")).unwrap();
    std::os::unix::fs::symlink("../../mine.txt", b.path("p/pictures/p.png")).unwrap();
    let run = b.line("render p --size 4x4 --out p/pictures").expect(2);
    assert!(run.err.contains("a link leads out of p/pictures"), "{}", run.err);
    assert_eq!(fs::read_to_string(b.path("mine.txt")).unwrap(), "mine");
    // A file that the user named is written, even if it is a link.
    b.line("render p --size 4x4 --out p/pictures/p.png").expect(0);
    assert_ne!(fs::read(b.path("mine.txt")).unwrap(), b"mine");
}
