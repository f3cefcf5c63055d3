//! Tests of round trips through snapshots.

use super::*;
use crate::{self as project, Channel, Input, PassName, presets};

fn round_trip(project: &Project) -> Project {
    read_snapshot(&write_snapshot(project).unwrap()).unwrap_or_else(|e| panic!("{}: {e}", project.name))
}

fn without_includes(project: &Project) -> Project {
    Project { includes: Vec::new(), ..project.clone() }
}

#[test]
fn every_preset_round_trips_with_each_text_edited() {
    for name in presets::names() {
        let mut project = presets::load(name).unwrap().project;
        for source in project.tab_sources_mut() {
            source.text = format!("{}// \u{e9}\r\n\t\"typed\" \\ '''", source.text).into();
        }
        assert_eq!(round_trip(&project), without_includes(&project), "{name}");
    }
}

#[test]
fn files_and_picked_pictures_round_trip_with_absolute_paths() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["common.glsl", "Buffer A.frag", "image.glsl"] {
        std::fs::write(folder.path().join(name), "// text\n").unwrap();
    }
    let mut project = project::load(folder.path().to_str().unwrap()).unwrap().project;
    let media = Media::Picked(folder.path().join("a picture.png"));
    project.passes[1].bindings.set(3, Some(Channel::new(Input::texture(media))));
    assert_eq!(round_trip(&project), project);
    project.origin = Origin::File("image.glsl".into());
    let back = round_trip(&project);
    assert_eq!(back.origin, Origin::File(std::env::current_dir().unwrap().join("image.glsl")));
}

#[test]
fn two_passes_of_one_file_keep_their_own_texts() {
    let folder = tempfile::tempdir().unwrap();
    let toml = "[passes.buffer_a]\nfile = \"one.glsl\"\n[passes.image]\nfile = \"one.glsl\"\n";
    std::fs::write(folder.path().join("eddy.toml"), toml).unwrap();
    std::fs::write(folder.path().join("one.glsl"), "// text\n").unwrap();
    let mut project = project::load(folder.path().to_str().unwrap()).unwrap().project;
    project.passes[0].source.text = "// only here\n".into();
    assert_eq!(round_trip(&project), project);
}

#[test]
fn invalid_snapshots_are_rejected_with_the_reason() {
    assert!(matches!(read_snapshot("{\"eddy_snapshot\": 1, \"name\": \"cut"), Err(SnapshotError::Json(_))));
    let newer = read_snapshot("{\"eddy_snapshot\": 2}").unwrap_err();
    assert!(newer.to_string().contains("version 2"), "{newer}");
}

#[test]
fn a_picked_model_and_a_new_name_round_trip() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["buffer_a.glsl", "image.glsl"] {
        std::fs::write(folder.path().join(name), "// text\n").unwrap();
    }
    let mut project = project::load(folder.path().to_str().unwrap()).unwrap().project;
    let fit = project::Fit { scale: 2.0, position: [1.0, 0.0, 0.0] };
    project.add_model(&folder.path().join("a fox.glb"), fit).unwrap();
    let rename = project::PassEdit::Rename { pass: PassName::buffer("A"), name: "glow".into() };
    project.edit_passes(&rename).unwrap();
    assert_eq!(round_trip(&project), project);
}
