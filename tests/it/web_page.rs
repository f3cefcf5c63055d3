//! The HTML page of a project: by the command line, from an open session, and in a browser where there is one.

use crate::support::{
    self,
    program::Bench,
    programs::{failure, has},
    stage::*,
};
use eddy::session::{Answer, Command, FileCommand, Level, Question};
use std::{fs, path::Path, process};

#[test]
fn a_page_is_written_by_its_ending_and_replaces_nothing_unasked() {
    let b = Bench::new();
    let said = b.line("export feedback --out page.html").expect(0);
    assert!(said.out.contains("exported to page.html ("), "{}", said.out);
    let first = b.bytes("page.html");
    assert!(first.starts_with(b"<!DOCTYPE html>"));
    b.line("export feedback --to html --out page.html").expect(0);
    assert!(b.line("export particles --out page.html").expect(2).err.contains("--force"));
    assert_eq!(b.bytes("page.html"), first);
    b.line("export particles --out page.html --force").expect(0);
    assert_ne!(b.bytes("page.html"), first);
    for args in ["--to html --out page.json", "--to json --out page.html", "--out page.txt"] {
        assert!(b.line(&format!("export fluid {args}")).expect(2).err.contains("ends in ."), "{args}");
    }
    b.write("bad.glsl", "void mainImage(out vec4 o, in vec2 p) { o = oops; }");
    let refused = b.line("export bad.glsl --out bad.html").expect(1);
    assert!(refused.err.contains("bad.glsl:1:45") || refused.out.contains("bad.glsl:1:45"), "{}", refused.err);
    assert!(!b.path("bad.html").exists());
}

#[test]
fn a_session_asks_before_it_replaces_a_page_and_keeps_the_old_one() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu, &[("image.glsl", &plain(0.5))]);
    let file = stage.dir.path().join("out.html");
    stage.session.apply(FileCommand::ExportPage(stage.dir.path().join("out")));
    assert!(stage.session.question().is_none() && file.exists(), "{:?}", stage.session.notices());
    fs::write(&file, "precious").unwrap();
    stage.session.apply(FileCommand::ExportPage(file.clone()));
    assert!(matches!(stage.session.question(), Some(Question::Export { exists: true, lost, .. }) if lost.is_empty()));
    stage.session.apply(FileCommand::Answer(Answer::Cancel));
    assert_eq!(fs::read_to_string(&file).unwrap(), "precious");
    stage.session.apply(FileCommand::ExportPage(file.clone()));
    stage.session.apply(FileCommand::Answer(Answer::Export));
    assert!(fs::read_to_string(&file).unwrap().contains("mainImage"));
    let kept = stage.dir.path().join("out.html.replaced-0001/out.html");
    assert_eq!(fs::read_to_string(kept).unwrap(), "precious");
    stage.edit("void mainImage(out vec4 o, in vec2 p) { o = oops; }");
    stage.session.apply(FileCommand::ExportPage(file));
    assert!(stage.notices(Level::Error).join("\n").contains("oops"), "{:?}", stage.session.notices());
}

/// Buffers, cubemaps, meshes, groups, an initial value, a uniform: one preset of each kind. `scripts/compare-html` without
/// names compares all.
#[test]
#[ignore = "takes a minute, and needs chromium"]
fn pages_draw_what_eddy_draws() {
    if !has("chromium") || support::gpu().is_none() {
        return;
    }
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts/compare-html");
    let mut command = process::Command::new(script);
    command.args(["--eddy", env!("CARGO_BIN_EXE_eddy"), "--size", "160x90", "--frame", "3"]);
    command.args(["feedback", "fluid", "ssao", "gaussian-blur", "reaction-diffusion"]);
    assert_eq!(failure(&mut command), None);
}
