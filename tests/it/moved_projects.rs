//! A project whose folder or file is renamed, moved or deleted while it is open: it is followed, or Eddy says so, and
//! saving it writes everything that the session has.

use crate::support::{self, stage::*};
use eddy::session::{FileCommand, Level, Request};
use std::fs;

const IMAGE: &str = "#include \"lib/noise.glsl\"\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(NOISE); }\n";

/// Opens a project in a folder of the stage, with an included file and a picture.
fn open(name: &str) -> Option<Stage> {
    let mut stage = Stage::bare(support::gpu()?);
    fs::create_dir_all(stage.path(&format!("{name}/lib"))).unwrap();
    stage.write(&format!("{name}/image.glsl"), IMAGE);
    stage.write(&format!("{name}/lib/noise.glsl"), "#define NOISE 0.4\n");
    stage.session.apply(FileCommand::Open(stage.path(name).to_str().unwrap().into()));
    stage.until_compiled();
    assert_eq!(stage.red(), 102);
    Some(stage)
}

fn asks_for_a_place(stage: &mut Stage) -> bool {
    std::iter::from_fn(|| stage.session.take_request()).any(|request| matches!(request, Request::SaveAs { .. }))
}

#[cfg(unix)]
#[test]
fn a_renamed_folder_is_followed() {
    let Some(mut stage) = open("multi") else { return };
    stage.edit(&format!("{IMAGE}// mine\n"));
    fs::rename(stage.path("multi"), stage.path("other")).unwrap();
    stage.until("the new name", |s| s.notices().iter().any(|n| n.text.contains("renamed to")));
    assert_eq!((stage.session.project().name.as_str(), stage.notices(Level::Warning).len()), ("other", 0));
    stage.session.apply(FileCommand::Save);
    assert!(!stage.session.is_dirty(), "{:?}", stage.session.notices());
    assert!(stage.read("other/image.glsl").ends_with("// mine\n") && !stage.path("multi").exists());
    // Its files are watched there.
    stage.write("other/lib/noise.glsl", "#define NOISE 0.6\n");
    stage.until_red(153);
}

#[cfg(unix)]
#[test]
fn a_save_finds_the_project_in_a_renamed_folder() {
    let Some(mut stage) = open("above/multi") else { return };
    stage.edit(&format!("{IMAGE}// mine\n"));
    fs::rename(stage.path("above"), stage.path("beyond")).unwrap();
    stage.session.apply(FileCommand::Save);
    assert!(stage.read("beyond/multi/image.glsl").ends_with("// mine\n") && !stage.path("above").exists());
}

#[test]
fn a_deleted_folder_is_saved_elsewhere_or_written_completely() {
    let Some(mut stage) = open("multi") else { return };
    fs::remove_dir_all(stage.path("multi")).unwrap();
    let gone = "was moved or deleted. Your work is still open here: save it elsewhere";
    stage.until("the warning", |s| s.notices().iter().any(|n| n.text.contains(gone)));
    stage.for_a_while();
    assert_eq!(stage.notices(Level::Warning).len(), 1, "{:?}", stage.session.notices());
    stage.session.apply(FileCommand::Save);
    assert!(asks_for_a_place(&mut stage) && stage.red() == 102);
    assert!(!stage.path("multi").exists(), "neither saving nor a screenshot makes a part of it again");
    for folder in ["multi", "elsewhere"] {
        stage.session.apply(FileCommand::SaveAs(stage.path(folder)));
        assert_eq!(stage.read(&format!("{folder}/lib/noise.glsl")), "#define NOISE 0.4\n", "{folder}");
        assert_eq!(stage.read(&format!("{folder}/image.glsl")), IMAGE, "{folder}");
    }
}

#[cfg(unix)]
#[test]
fn a_renamed_file_is_followed_and_a_deleted_one_is_written_again() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::bare(gpu);
    stage.write("a.glsl", plain(0.4));
    stage.session.apply(FileCommand::Open(stage.path("a.glsl").to_str().unwrap().into()));
    stage.until_compiled();
    fs::rename(stage.path("a.glsl"), stage.path("b.glsl")).unwrap();
    stage.until("the new name", |s| s.notices().iter().any(|n| n.text.contains("renamed to")));
    stage.edit(&plain(0.6));
    stage.session.apply(FileCommand::Save);
    assert!(stage.read("b.glsl") == plain(0.6) && !stage.path("a.glsl").exists());
    fs::remove_file(stage.path("b.glsl")).unwrap();
    stage.until("the warning", |s| {
        s.notices().iter().any(|n| n.text == "b.glsl was deleted on disk. Save to write it again")
    });
    stage.session.apply(FileCommand::Save);
    assert!(stage.read("b.glsl") == plain(0.6));
    stage.edit(&plain(0.8));
    stage.session.apply(FileCommand::Save);
    assert!(stage.read("b.glsl") == plain(0.8) && !stage.session.is_dirty());
}
