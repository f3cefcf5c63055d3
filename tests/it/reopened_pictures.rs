//! Pictures that contain their project: dropped on the window, they reopen at the frame that they show.

use crate::support::{self, stage::*};
use crate::time_travel::{stage, steps, texels};
use eddy::{
    playback::scene::Scene,
    project::PassName,
    session::{CaptureCommand, Command, FileCommand, InputCommand, Level, TransportCommand},
};
use std::{fs, path::Path};

/// Opens a picture in another session.
fn open_picture(picture: &Path) -> Stage {
    let mut stage = Stage::bare(support::gpu().unwrap());
    let name = stage.path("picture.png");
    fs::copy(picture, &name).unwrap();
    stage.session.apply(FileCommand::Bring { paths: vec![name], to: Some((PassName::image(), None)) });
    stage.until_compiled();
    stage
}

fn until_frame(stage: &mut Stage, frame: i32) {
    stage.until("the frame of the picture", |session| session.transport().frame == frame);
    stage.for_a_while();
}

#[test]
fn a_picture_with_state_is_redrawn_from_its_inputs() {
    let Some(gpu) = support::gpu() else { return };
    let mut before = stage(gpu);
    steps(&mut before, 0..150);
    let wanted = texels(&mut before);
    let picture = before.screenshot();
    let mut after = open_picture(&picture);
    until_frame(&mut after, 150);
    assert_eq!(after.session.shown_pass(), &PassName::buffer("A"));
    assert!(texels(&mut after) == wanted);
    assert!(!after.session.transport().playing && !after.session.is_dirty());
    let text = "Opened from the image at frame 150 (paused)";
    assert!(after.notices(Level::Info).contains(&text), "{:?}", after.session.notices());
    // The following frames are those of the original run.
    steps(&mut before, 150..160);
    steps(&mut after, 150..160);
    assert!(texels(&mut after) == texels(&mut before));
    // The picture contains the code, but not its path.
    let scene = Scene::read(&picture).unwrap();
    assert!(scene.project.passes.iter().all(|pass| pass.source.path.is_none() && !pass.source.text.is_empty()));
    let bytes = fs::read(&picture).unwrap();
    let place = before.dir.path().file_name().unwrap().to_str().unwrap().as_bytes();
    assert!(!bytes.windows(place.len()).any(|part| part == place));
}

#[test]
fn a_picture_without_state_keeps_its_time_and_mouse() {
    let Some(gpu) = support::gpu() else { return };
    let text =
        "void mainImage(out vec4 o, in vec2 p) { o = fract(vec4(iTime, iMouse.x / 8.0, iMouse.w / 4.0, iDate.w)); }";
    let mut before = Stage::open(gpu, &[("image.glsl", text)]);
    before.session.apply(InputCommand::MouseDown { x: 3.0, y: 2.0 });
    before.act(Command::Transport(TransportCommand::Step));
    before.session.apply(InputCommand::MouseMove { x: 5.0, y: 3.0 });
    for _ in 0..20 {
        before.act(Command::Transport(TransportCommand::Step));
    }
    let (wanted, frame) = (texels(&mut before), before.session.transport().frame);
    let picture = before.screenshot();
    let mut after = open_picture(&picture);
    until_frame(&mut after, frame);
    assert!(texels(&mut after) == wanted);
    assert_eq!(&*after.session.project().passes[0].source.text, text);
}

#[test]
fn a_picture_on_a_channel_or_without_project_is_a_texture() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu, &[("image.glsl", &plain(0.25))]);
    let picture = stage.screenshot();
    assert!(stage.notices(Level::Info).iter().any(|text| text.ends_with("with the project in it")));
    let bring = |stage: &mut Stage, channel| {
        stage
            .session
            .apply(FileCommand::Bring { paths: vec![picture.clone()], to: Some((PassName::image(), channel)) });
    };
    bring(&mut stage, Some(2));
    let channels = |stage: &Stage| stage.session.project().passes[0].bindings.channels().count();
    assert_eq!(channels(&stage), 1);
    // Unsaved work causes a question first.
    bring(&mut stage, None);
    assert!(stage.session.question().is_some() && channels(&stage) == 1);
    let mut plain_stage = Stage::open(support::gpu().unwrap(), &[("image.glsl", &plain(0.5))]);
    plain_stage.session.apply(CaptureCommand::SetProjectInPictures(false));
    let picture = plain_stage.screenshot();
    assert!(!Scene::is_in(&fs::read(&picture).unwrap()));
    plain_stage.session.apply(FileCommand::Bring { paths: vec![picture], to: Some((PassName::image(), None)) });
    assert_eq!(channels(&plain_stage), 1);
}

#[test]
fn a_damaged_picture_is_reported_and_changes_nothing() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu, &[("image.glsl", &plain(0.25))]);
    let picture = stage.screenshot();
    let mut bytes = fs::read(&picture).unwrap();
    // Within the compressed text.
    bytes[33 + 8 + 40] ^= 0x55;
    fs::write(&picture, bytes).unwrap();
    let before = stage.session.project().clone();
    stage.session.apply(FileCommand::Open(picture.to_str().unwrap().into()));
    assert!(*stage.session.project() == before);
    let errors = stage.notices(Level::Error);
    assert!(errors.len() == 1 && errors[0].contains("is damaged") && errors[0].contains(".png"), "{errors:?}");
}
