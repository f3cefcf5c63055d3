//! Edits of passes in a session: the way back, what was typed meanwhile, saving, and a disk that changes under them.

use crate::support::{self, stage::*};
use eddy::{
    project::{Input, MeshSource, PassEdit, PassName, Tab},
    session::{Answer, Command, EditCommand, FileCommand, Level, Question, ViewCommand},
};

const MANIFEST: &str = "\
[passes.buffer_a] # the first
[passes.buffer_b]
[passes.image]
channels.0 = { buffer = \"A\" }
";

fn buffer(name: &str) -> PassName {
    PassName::buffer(name)
}

fn tab(name: &str) -> Tab {
    Tab::Pass(buffer(name))
}

fn open() -> Option<Stage> {
    let gpu = support::gpu()?;
    let (a, b) = (plain(0.25), plain(0.5));
    let image = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(0), 0); }";
    let files = [("eddy.toml", MANIFEST), ("buffer_a.glsl", &a), ("buffer_b.glsl", &b), ("image.glsl", image)];
    Some(Stage::open(gpu, &files))
}

fn edit(stage: &mut Stage, edit: PassEdit) {
    stage.session.apply(EditCommand::EditPasses(edit));
}

fn rename(stage: &mut Stage, from: &str, to: &str) {
    edit(stage, PassEdit::Rename { pass: buffer(from), name: to.into() });
}

fn type_in(stage: &mut Stage, tab: Tab, text: &str) {
    stage.session.apply(EditCommand::EditText { tab, text: text.into() });
}

#[test]
fn a_pass_that_was_removed_comes_back_with_its_text() {
    let Some(mut stage) = open() else { return };
    type_in(&mut stage, tab("A"), &plain(0.75));
    edit(&mut stage, PassEdit::Remove(tab("A")));
    assert!(stage.session.question().is_none() && !stage.session.tabs().contains(&tab("A")));
    let notice = stage.session.notices().last().unwrap().clone();
    assert_eq!(notice.text, "Buffer A was removed");
    assert_eq!(notice.undoes, stage.session.pass_undo().map(|step| step.serial));
    stage.until_red(0);
    // What is typed elsewhere meanwhile stays.
    type_in(&mut stage, tab("B"), &plain(0.125));
    stage.session.apply(EditCommand::UndoPassEdit);
    assert_eq!(stage.session.text(&tab("A")), plain(0.75));
    assert_eq!(stage.session.text(&tab("B")), plain(0.125));
    stage.until_red(191);
    stage.session.apply(EditCommand::RedoPassEdit);
    assert!(!stage.session.tabs().contains(&tab("A")));
    assert_eq!(stage.session.text(&tab("B")), plain(0.125));
    edit(&mut stage, PassEdit::Remove(image_tab()));
    assert!(stage.session.tabs().contains(&image_tab()));
    assert!(stage.notices(Level::Warning).last().unwrap().contains("cannot be removed"));
}

#[test]
fn a_new_name_is_saved_taken_back_and_saved_again() {
    let Some(mut stage) = open() else { return };
    stage.session.apply(ViewCommand::ShowPass(buffer("A")));
    rename(&mut stage, "A", "glow");
    assert_eq!(*stage.session.shown_pass(), buffer("glow"));
    assert!(stage.session.is_dirty() && !stage.session.is_tab_dirty(&tab("glow")), "its text is the disk's");
    type_in(&mut stage, tab("glow"), &plain(0.75));
    stage.session.apply(FileCommand::Save);
    assert!(!stage.session.is_dirty(), "{:?}", stage.session.notices());
    assert_eq!(stage.read("buffer_glow.glsl"), plain(0.75));
    assert!(!stage.path("buffer_a.glsl").exists() && stage.read("eddy.toml").contains("# the first"));
    // Back, with what was typed since, and the file follows.
    stage.session.apply(EditCommand::UndoPassEdit);
    assert_eq!(stage.session.text(&tab("A")), plain(0.75));
    assert_eq!(*stage.session.shown_pass(), buffer("A"));
    stage.session.apply(FileCommand::Save);
    assert!(!stage.session.is_dirty(), "{:?}", stage.session.notices());
    assert_eq!(stage.read("buffer_a.glsl"), plain(0.75));
    assert!(!stage.path("buffer_glow.glsl").exists());
    assert_eq!(stage.read("eddy.toml"), MANIFEST);
    assert_eq!(
        stage.session.renamed_passes(),
        [(buffer("A"), buffer("glow")), (buffer("glow"), buffer("A"))],
        "a front end follows both"
    );
}

#[test]
fn a_disk_that_changes_under_a_new_name_loses_nothing() {
    let Some(mut stage) = open() else { return };
    rename(&mut stage, "A", "glow");
    // Another program writes the file that the pass is still in: untouched here, it is taken.
    stage.write("buffer_a.glsl", plain(0.75));
    stage.until("the text of the disk", |s| s.text(&tab("glow")) == plain(0.75));
    // Edited here too, it is asked which of them.
    type_in(&mut stage, tab("glow"), &plain(0.125));
    stage.write("buffer_a.glsl", plain(1.0));
    stage.until("the question", |s| s.question().is_some());
    let Some(Question::Conflict { tab: asked, .. }) = stage.session.question() else { panic!("another question") };
    assert_eq!(asked.as_ref(), Some(&tab("glow")));
    stage.session.apply(FileCommand::Answer(Answer::TakeDisk));
    assert_eq!(stage.session.text(&tab("glow")), plain(1.0));
    stage.session.apply(FileCommand::Save);
    assert!(!stage.session.is_dirty(), "{:?}", stage.session.notices());
    assert_eq!(stage.read("buffer_glow.glsl"), plain(1.0));
}

#[test]
fn channels_and_dragged_numbers_are_taken_back_in_whole_steps() {
    let Some(mut stage) = open() else { return };
    let before = stage.session.project().clone();
    for steps in 2..30 {
        edit(&mut stage, PassEdit::Steps(buffer("A"), steps));
    }
    assert_eq!(stage.session.pass_undo().map(|step| step.title), Some("steps of Buffer A"));
    stage.session.apply(EditCommand::SetChannel { pass: PassName::image(), index: 0, channel: None });
    stage.session.apply(EditCommand::UndoPassEdit);
    let image = stage.session.project().image().unwrap();
    assert_eq!(image.bindings.get(0).unwrap().input, Input::buffer("A"));
    stage.session.apply(EditCommand::UndoPassEdit);
    assert_eq!(*stage.session.project(), before, "one drag is one step");
    assert!(stage.session.pass_undo().is_none());
    // Another project's steps are not this one's.
    edit(&mut stage, PassEdit::Steps(buffer("A"), 2));
    stage.session.apply(FileCommand::Save);
    stage.session.apply(FileCommand::New);
    assert!(stage.session.pass_undo().is_none() && stage.session.pass_redo().is_none());
}

#[test]
fn a_model_from_elsewhere_is_saved_with_the_project() {
    let Some(mut stage) = open() else { return };
    let elsewhere = tempfile::tempdir().unwrap();
    let file = elsewhere.path().join("tri angle.obj");
    std::fs::write(&file, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let to = Some((PassName::image(), None));
    stage.session.apply(FileCommand::Bring { paths: vec![file.clone()], to });
    let draws = |stage: &Stage| {
        let pass = stage.session.project().pass(&buffer("model")).unwrap().clone();
        pass.body.geometry().unwrap().draws[0].mesh.clone()
    };
    assert_eq!(draws(&stage), MeshSource::Picked(file));
    stage.compile(Command::Edit(EditCommand::CompileNow));
    assert!(stage.is_ok(), "{:?}", stage.session.diagnostics());
    // Another file has the name that the copy would get.
    stage.write("tri angle.obj", "somebody else's");
    stage.session.apply(FileCommand::Save);
    assert!(!stage.session.is_dirty(), "{:?}", stage.session.notices());
    assert_eq!(draws(&stage), MeshSource::File("tri angle/tri angle.obj".into()));
    assert_eq!(stage.read("tri angle.obj"), "somebody else's");
    let opened = eddy::project::load(stage.folder().to_str().unwrap()).unwrap();
    assert_eq!(opened.project, *stage.session.project());
    assert!(eddy::media::gather(&opened.project, None).0.mesh_errors(&opened.project).is_empty());
}
