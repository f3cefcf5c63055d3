//! Videos and the camera in a session: a paused picture shows the frame of its time, and a camera is on only after the
//! user has turned it on for the open project.

use crate::support::{self, ffmpeg::has_ffmpeg, stage::*};
use eddy::{
    playback::comparing::Baseline,
    project::{InputKind, PassName},
    session::{
        CameraCommand, CameraState, EditCommand, FileCommand, Level, SessionOptions, Status, ToolCommand,
        TransportCommand,
    },
    video::CameraSource,
};
use image::{
    Delay, Frame, Rgba, RgbaImage,
    codecs::gif::{GifEncoder, Repeat},
};

const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(0), 0); }";

/// Returns a GIF with frames of 100 ms, with their number in red.
fn gif(frames: u8) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = GifEncoder::new(&mut bytes);
    encoder.set_repeat(Repeat::Infinite).unwrap();
    for n in 0..frames {
        let image = RgbaImage::from_pixel(4, 4, Rgba([n * 20, 0, 0, 255]));
        encoder.encode_frame(Frame::from_parts(image, 0, 0, Delay::from_numer_denom_ms(100, 1))).unwrap();
    }
    drop(encoder);
    bytes
}

#[test]
fn a_paused_picture_shows_the_frame_of_its_time() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::bare(gpu);
    stage.write("a.gif", gif(10));
    stage.write("eddy.toml", "[passes.image]\nchannels.0 = { file = \"a.gif\", kind = \"video\" }\n");
    stage.write("image.glsl", SHOW);
    let folder = stage.folder();
    stage.session.apply(FileCommand::Open(folder.to_str().unwrap().into()));
    stage.session.apply(TransportCommand::Pause);
    stage.until_compiled();
    assert!(stage.is_ok(), "{:?}", stage.session.notices());
    for (seconds, wanted) in [(0.55, 5), (0.05, 0), (0.95, 9), (1.25, 2), (0.35, 3)] {
        stage.session.apply(TransportCommand::Seek(seconds));
        // A late video frame is drawn again while time is stopped.
        stage.settle();
        assert_eq!(stage.red(), wanted * 20, "at {seconds}");
    }
    // An edit keeps the same frame.
    stage.edit(&SHOW.replace("ivec2(0), 0)", "ivec2(0), 0) * 0.5"));
    stage.session.apply(EditCommand::CompileNow);
    stage.until_compiled();
    stage.settle();
    assert_eq!(stage.red(), 30);
}

#[test]
fn a_dropped_animation_is_a_video() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu, &[("image.glsl", SHOW)]);
    for (name, bytes, kind) in [("moves.gif", gif(3), InputKind::Video), ("still.gif", gif(1), InputKind::Texture)] {
        let path = stage.dir.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        let to = Some((eddy::project::PassName::image(), Some(0)));
        stage.session.apply(FileCommand::Bring { paths: vec![path], to });
        let channel = stage.session.project().passes[0].bindings.get(0).cloned();
        assert_eq!(channel.unwrap().input.kind(), kind, "{name}");
    }
}

#[test]
fn a_camera_is_on_only_by_consent_for_one_project() {
    let Some(gpu) = support::gpu() else { return };
    if !has_ffmpeg() {
        return;
    }
    let camera = CameraSource::of_text("lavfi:color=white:s=24x16:r=30");
    let mut stage = Stage::with_options(gpu, |_| SessionOptions { camera, ..SessionOptions::default() });
    stage.write("eddy.toml", "[passes.image]\nchannels.0 = { webcam = true }\n");
    let width = "void mainImage(out vec4 o, in vec2 p) { o = vec4(texelFetch(iChannel0, ivec2(1), 0).r * iChannelResolution[0].x / 255.); }";
    stage.write("image.glsl", width);
    let folder = stage.folder().to_str().unwrap().to_owned();
    stage.session.apply(FileCommand::Open(folder.clone()));
    stage.session.apply(TransportCommand::Pause);
    stage.until_compiled();
    let webcam = InputKind::Webcam;
    assert!(stage.session.reads_device(webcam) && !stage.session.reads_device(InputKind::Microphone));
    stage.for_a_while();
    assert_eq!(
        (stage.session.device_state(webcam), stage.red()),
        (CameraState::Off, 0),
        "a project alone turns nothing on"
    );
    stage.session.apply(CameraCommand::UseDevice { kind: webcam, on: true });
    stage.until("the camera to be on", |s| s.device_state(webcam) == CameraState::On);
    stage.until_compiled();
    stage.settle();
    assert_eq!(stage.red(), 24);
    stage.session.apply(CameraCommand::UseDevice { kind: webcam, on: false });
    assert_eq!(stage.session.device_state(webcam), CameraState::Off);
    stage.until_compiled();
    stage.settle();
    assert_eq!(stage.red(), 0);
    stage.session.apply(CameraCommand::UseDevice { kind: webcam, on: true });
    stage.until("the camera to be on", |s| s.device_state(webcam) == CameraState::On);
    // It runs only while a channel reads it.
    let set = |channel| EditCommand::SetChannel { pass: PassName::image(), index: 0, channel };
    stage.session.apply(set(None));
    stage.for_a_while();
    assert_eq!(stage.session.device_state(webcam), CameraState::Off);
    stage.session.apply(EditCommand::UndoPassEdit);
    stage.until("the camera to be on again", |s| s.device_state(webcam) == CameraState::On);
    // Opening a project, even the same one, requires consent again.
    stage.session.apply(FileCommand::Open(folder));
    stage.until("another project", |s| s.device_state(webcam) == CameraState::Off);
    stage.for_a_while();
    assert_eq!(stage.session.device_state(webcam), CameraState::Off);
}

/// The trace, the search for a divergence from the device and the comparison read the inputs of the shown frame.
#[test]
fn a_trace_and_a_comparison_read_the_shown_camera_frame() {
    let Some(gpu) = support::gpu() else { return };
    if !has_ffmpeg() {
        return;
    }
    // Every frame has a different grey, and none is black.
    let camera = CameraSource::of_text("lavfi:nullsrc=s=16x16:r=30,geq=lum='60+mod(N*7,150)':cb=128:cr=128");
    let mut stage = Stage::with_options(gpu, |_| SessionOptions { camera, ..SessionOptions::default() });
    stage.write("eddy.toml", "[passes.image]\nchannels.0 = { webcam = true }\n");
    stage.write("image.glsl", SHOW);
    let folder = stage.folder().to_str().unwrap().to_owned();
    stage.session.apply(FileCommand::Open(folder));
    stage.session.apply(TransportCommand::Pause);
    stage.until_compiled();
    stage.session.apply(CameraCommand::UseDevice { kind: InputKind::Webcam, on: true });
    stage.until("the camera to be on", |s| s.device_state(InputKind::Webcam) == CameraState::On);
    stage.until_compiled();
    stage.session.apply(TransportCommand::Step);
    stage.settle();
    let shown = stage.red();
    assert!(shown > 30, "{shown}");
    let near = |value: f32| (value * 255.0 - f32::from(shown)).abs() < 1.0;
    stage.session.apply(ToolCommand::Trace(Some([0.5, 0.5])));
    stage.until("a trace", |s| s.trace().traced.is_some());
    let traced = stage.session.trace().traced.unwrap();
    assert!(near(traced.device[0]) && traced.value == Some(traced.device), "{:?} {:?}", traced.value, traced.device);
    stage.session.apply(ToolCommand::FindDivergence);
    stage.until("the search", |s| matches!(s.divergence(), Some(Status::Ended(_))));
    let Some(Status::Ended(found)) = stage.session.divergence() else { unreachable!() };
    assert_eq!(found.unwrap().first, None);
    stage.session.apply(ToolCommand::Compare(Some(Baseline::LastSave)));
    stage.until("a comparison", |s| matches!(s.comparison(), Some(Status::Ended(_))));
    let Some(Status::Ended(done)) = stage.session.comparison() else { unreachable!() };
    let done = done.unwrap();
    assert!(near(done.ours.texels[0][0]) && done.ours.texels == done.theirs.texels, "{:?}", done.ours.texels[0]);
    assert!(!done.is_camera_still, "only the shown frame was drawn");
}

#[test]
fn a_trace_and_a_comparison_read_the_shown_video_frame() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::bare(gpu);
    stage.write("a.gif", gif(10));
    stage.write("eddy.toml", "[passes.image]\nchannels.0 = { file = \"a.gif\", kind = \"video\" }\n");
    stage.write("image.glsl", SHOW);
    let folder = stage.folder();
    stage.session.apply(FileCommand::Open(folder.to_str().unwrap().into()));
    stage.session.apply(TransportCommand::Pause);
    stage.until_compiled();
    stage.session.apply(TransportCommand::Seek(0.75));
    stage.settle();
    assert_eq!(stage.red(), 140);
    let near = |value: f32| (value * 255.0 - 140.0).abs() < 0.5;
    stage.session.apply(ToolCommand::Trace(Some([0.5, 0.5])));
    stage.until("a trace", |s| s.trace().traced.is_some());
    let traced = stage.session.trace().traced.unwrap();
    assert!(near(traced.device[0]) && traced.value == Some(traced.device), "{:?} {:?}", traced.value, traced.device);
    stage.session.apply(ToolCommand::Compare(Some(Baseline::LastSave)));
    stage.until("a comparison", |s| matches!(s.comparison(), Some(Status::Ended(_))));
    let Some(Status::Ended(done)) = stage.session.comparison() else { unreachable!() };
    assert!(near(done.unwrap().ours.texels[0][0]), "{:?}", done.unwrap().ours.texels[0]);
}

#[test]
fn a_missing_camera_is_reported() {
    let Some(gpu) = support::gpu() else { return };
    let camera = CameraSource::of_text("/dev/video-of-nobody");
    let mut stage = Stage::with_options(gpu, |_| SessionOptions { camera, ..SessionOptions::default() });
    stage.write("eddy.toml", "[passes.image]\nchannels.0 = { webcam = true }\n");
    stage.write("image.glsl", plain(0.2));
    stage.session.apply(FileCommand::Open(stage.folder().to_str().unwrap().to_owned()));
    stage.until_compiled();
    stage.session.apply(CameraCommand::UseDevice { kind: InputKind::Webcam, on: true });
    let is_camera = |n: &eddy::session::Notice| n.level == Level::Warning && n.text.contains("camera");
    stage.until("the warning", |s| s.notices().iter().any(is_camera));
    assert_eq!(stage.session.device_state(InputKind::Webcam), CameraState::Off);
}
