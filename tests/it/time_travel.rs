//! Frames that were drawn before: gone back to, and drawn again from their recorded inputs, bit for bit.

use crate::support::{self, stage::*};
use eddy::{
    engine::{BuildOptions, Engine, Pixels},
    media,
    playback::{npy, offline::Offline, recording::Recording, script::ScriptedInputs},
    project::{self, PassName, Tab},
    session::{
        CanvasCommand, CaptureCommand, Command, EditCommand, FileCommand, InputCommand, Level, TimeRange, ToolCommand,
        TransportCommand, ViewCommand,
    },
};
use std::{
    fs::{self, File},
    io::BufReader,
    path::PathBuf,
    sync::Arc,
    time::{Duration, Instant},
};

/// Sums what it saw of time, input and a slider; some texels keep what they had two frames before.
const HISTORY: &str = "#iUniform float level = 0.5 in { 0.0, 1.0 }
void mainImage(out vec4 o, in vec2 p) {
    vec4 before = texelFetch(iChannel0, ivec2(p), 0);
    if (iFrame % 3 == 1 && p.x > 5.) discard;
    o = fract(before + vec4(iTime * 0.37 + float(iFrame) * 0.11, iTimeDelta, level, 0.0)
        + abs(iMouse) * 0.013 + vec4(0.0, 0.0, 0.0, p.x * 0.01));
}";
const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";
const MANIFEST: &str =
    "eddy = 1\n[passes.buffer_a]\nchannels.0 = { buffer = \"A\" }\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n";

pub(super) fn stage(gpu: eddy::gpu::Gpu) -> Stage {
    let mut stage = Stage::open(gpu, &[("eddy.toml", MANIFEST), ("buffer_a.glsl", HISTORY), ("image.glsl", SHOW)]);
    assert!(stage.is_ok(), "{:?}", stage.session.notices());
    stage.act(Command::View(ViewCommand::ShowPass(PassName::buffer("A"))));
    stage
}

/// The texels of the pass that is shown.
pub(super) fn texels(stage: &mut Stage) -> Vec<u8> {
    stage.act(Command::Capture(CaptureCommand::SaveTexels));
    let notice = stage.session.notices().iter().rev().find_map(|n| n.path.clone()).unwrap();
    fs::read(notice).unwrap()
}

/// Draws as many frames as there are, one after the other, with a hand that moves and a slider that is turned.
pub(super) fn steps(stage: &mut Stage, frames: std::ops::Range<i32>) {
    for frame in frames {
        match frame {
            30 => stage.session.apply(InputCommand::MouseDown { x: 1.5, y: 1.5 }),
            31..90 => stage.session.apply(InputCommand::MouseMove { x: (frame % 8) as f32, y: 2.5 }),
            90 => stage.session.apply(InputCommand::MouseUp),
            110 => stage.session.apply(EditCommand::AssignCustomUniform("level=0.125".into())),
            _ => {}
        }
        stage.act(Command::Transport(TransportCommand::Step));
    }
}

#[test]
fn one_goes_back_to_any_frame_with_the_buffers_as_they_were() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    let first = stage.session.transport().frame;
    let mut known = Vec::new();
    for (from, to) in [(0, 20), (20, 61), (61, 100), (100, 101), (101, 170), (170, 300)] {
        steps(&mut stage, from..to);
        known.push((to, texels(&mut stage)));
    }
    let newest = stage.session.transport().frame;
    assert_eq!((first, newest), (0, 300));
    let mut at = 300;
    while let Some((frame, before)) = known.pop() {
        stage.act(Command::Transport(TransportCommand::StepBack((at - frame) as usize)));
        assert!(texels(&mut stage) == before, "frame {frame}");
        assert!(!stage.session.transport().playing);
        at = frame;
    }
    // On from there as ever.
    let frame = stage.session.transport().frame;
    stage.act(Command::Transport(TransportCommand::Step));
    assert_eq!(stage.session.transport().frame, frame + 1);
    assert!(stage.notices(Level::Error).is_empty() && stage.notices(Level::Warning).is_empty());
}

#[test]
fn what_is_out_of_reach_is_told_and_changes_nothing() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    steps(&mut stage, 0..10);
    let before = texels(&mut stage);
    stage.act(Command::Transport(TransportCommand::StepBack(500)));
    assert!(texels(&mut stage) == before);
    assert!(stage.notices(Level::Warning)[0].contains("you can go back"), "{:?}", stage.notices(Level::Warning));
    stage.act(Command::Transport(TransportCommand::Reset));
    stage.act(Command::Transport(TransportCommand::StepBack(1)));
    let warnings = stage.notices(Level::Warning);
    assert!(warnings.len() == 1 && warnings[0].contains("restarts at frame 0"), "the one before is over: {warnings:?}");
}

/// A checkpoint is put into an engine that has drawn nothing, so what it lacks is zeros there.
#[test]
fn a_checkpoint_holds_all_that_later_frames_read() {
    let Some(gpu) = support::gpu() else { return };
    for preset in project::presets::names() {
        let project = support::presets::preset(preset);
        let (media, _) = media::gather(&project, None);
        let mut engines = support::Engines::new(&gpu);
        for skip in [true, false] {
            let options = BuildOptions { skip, ..BuildOptions::default() };
            let mut engine = || engines.with(&project, &media, &options, (48, 27));
            let all = |engine: &mut Engine| -> Vec<_> {
                let read = |id| Some(support::presets::bits(&engine.read(id).ok()?));
                support::presets::buffers(&project).map(read).collect()
            };
            let mut ran = engine();
            support::run(&mut ran, 0, 5);
            let checkpoint = ran.checkpoint().unwrap();
            let (kept, whole) = (checkpoint.bytes(), ran.snapshot().unwrap().bytes());
            assert!(kept == ran.checkpoint_bytes() && kept < whole + u64::from(!skip), "{preset}: {kept} of {whole}");
            let mut restored = engine();
            // The same by way of the process's memory, as a file has it.
            if skip {
                restored.set_state(&ran.state().unwrap()).unwrap();
            } else {
                assert!(restored.restore(&checkpoint), "{preset}");
            }
            for frame in 5..8 {
                support::run(&mut ran, frame, frame + 1);
                support::run(&mut restored, frame, frame + 1);
                assert!(all(&mut ran) == all(&mut restored), "{preset}, frame {frame}, skip: {skip}");
            }
        }
    }
}

/// Time and number of the frame that is shown.
fn place(stage: &Stage) -> (f64, i32) {
    let transport = stage.session.transport();
    (transport.time_secs, transport.frame)
}

#[test]
fn what_was_gone_back_from_is_gone_forward_to_until_something_else_is_drawn() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    steps(&mut stage, 0..150);
    let last = texels(&mut stage);
    stage.act(Command::Transport(TransportCommand::StepBack(100)));
    assert_eq!((stage.session.transport().frame, stage.session.reach().ahead), (50, 100));
    // With the mouse and the slider that those frames had.
    for _ in 0..100 {
        stage.session.apply(TransportCommand::Step);
    }
    stage.tick();
    assert_eq!((stage.session.transport().frame, stage.session.reach().ahead), (150, 0));
    assert!(texels(&mut stage) == last);
    // A slider that is turned makes another run of it, from the frame that is shown on.
    stage.act(Command::Transport(TransportCommand::StepBack(20)));
    stage.act(Command::Edit(EditCommand::AssignCustomUniform("level=0.75".into())));
    assert_eq!((stage.session.transport().frame, stage.session.reach().ahead), (130, 0));
    for _ in 0..20 {
        stage.act(Command::Transport(TransportCommand::Step));
    }
    assert_eq!(stage.session.transport().frame, 150);
    assert!(texels(&mut stage) != last);
}

#[test]
fn a_picture_without_a_state_is_there_at_any_time_at_once() {
    let Some(gpu) = support::gpu() else { return };
    let time = "void mainImage(out vec4 o, in vec2 p) { o = vec4(iTime, float(iFrame), 0.0, 1.0); }";
    let mut stage = Stage::open(gpu, &[("image.glsl", time)]);
    for (secs, frame) in [(12.5, 750), (0.25, 15), (0.0, 0), (3600.0, 216_000)] {
        let before = stage.frames();
        stage.act(Command::Transport(TransportCommand::Seek(secs)));
        assert_eq!((place(&stage), stage.frames()), ((secs, frame), before + 1));
        let bytes = texels(&mut stage);
        let red = f32::from_le_bytes(bytes[bytes.len() - 16..][..4].try_into().unwrap());
        assert_eq!(red, secs as f32);
    }
    stage.session.apply(TransportCommand::Seek(f64::NAN));
    stage.act(Command::Transport(TransportCommand::Seek(-3.0)));
    assert_eq!(place(&stage), (0.0, 0));
    // While it runs, it runs on from there.
    stage.session.apply(TransportCommand::Play);
    stage.session.apply(TransportCommand::Seek(7.0));
    let now = Instant::now();
    stage.session.tick(now);
    stage.session.tick(now + Duration::from_millis(50));
    assert!((place(&stage).0 - 7.05).abs() < 1e-9 && stage.session.transport().playing);
}

#[test]
fn a_state_is_drawn_again_for_an_earlier_time_and_on_for_a_later_one() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    steps(&mut stage, 0..60);
    let one_second = texels(&mut stage);
    steps(&mut stage, 60..150);
    stage.act(Command::Transport(TransportCommand::Seek(1.004)));
    assert_eq!(place(&stage), (1.0, 60), "the last frame that is not later");
    assert!(texels(&mut stage) == one_second);
    stage.act(Command::Transport(TransportCommand::Seek(2.0)));
    assert_eq!((place(&stage), stage.session.reach().ahead), ((2.0, 120), 30));
    // Beyond what was drawn: the same as to go on step by step.
    stage.act(Command::Transport(TransportCommand::Seek(3.0)));
    assert_eq!((place(&stage), stage.session.transport().is_seeking), ((3.0, 180), false));
    let sought = texels(&mut stage);
    stage.act(Command::Transport(TransportCommand::Seek(2.5)));
    for _ in 0..30 {
        stage.act(Command::Transport(TransportCommand::Step));
    }
    assert_eq!(place(&stage), (3.0, 180));
    assert!(texels(&mut stage) == sought);
    // On another canvas there is nothing to go back in: it begins at 0.
    stage.act(Command::Canvas(CanvasCommand::SetFixedSize(Some((10, 4)))));
    stage.act(Command::Transport(TransportCommand::Seek(0.5)));
    assert_eq!(place(&stage), (0.5, 30));
    assert!(stage.notices(Level::Warning).is_empty(), "{:?}", stage.notices(Level::Warning));
}

#[test]
fn a_range_is_played_again_and_again_from_the_same_state() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    steps(&mut stage, 0..60);
    let begin = texels(&mut stage);
    stage.session.apply(TransportCommand::SetTimeRange(TimeRange::new(1.0, 1.5)));
    stage.session.apply(TransportCommand::SetFixedRate(Some(60.0)));
    stage.session.apply(TransportCommand::Play);
    let (mut now, mut turns, mut before) = (Instant::now(), 0, 1.0);
    for _ in 0..200 {
        now += Duration::from_millis(7);
        stage.session.tick(now);
        let (time, _) = place(&stage);
        assert!((1.0..1.5).contains(&time), "{time}");
        turns += i32::from(time < before);
        before = time;
        if time == 1.0 {
            assert!(texels(&mut stage) == begin);
        }
        assert!(stage.session.transport().playing);
    }
    assert!(turns >= 5, "{turns}");
    // In real time, of which a slow frame takes a tenth of a second.
    stage.session.apply(TransportCommand::SetFixedRate(None));
    let (mut turns, mut latest) = (0, 0.0f64);
    for _ in 0..40 {
        now += Duration::from_millis(100);
        stage.session.tick(now);
        let (time, _) = place(&stage);
        assert!((1.0..1.5).contains(&time), "{time}");
        turns += i32::from(time < before);
        before = time;
        latest = latest.max(time);
    }
    assert!(turns >= 5 && latest > 1.35, "{turns}, up to {latest}");
    stage.session.apply(TransportCommand::SetTimeRange(None));
    for _ in 0..60 {
        now += Duration::from_millis(7);
        stage.session.tick(now);
    }
    assert!(place(&stage).0 > 1.5);
}

#[test]
fn new_code_shows_the_same_frame_of_the_same_inputs() {
    let Some(gpu) = support::gpu() else { return };
    let other = HISTORY.replace("0.37", "0.41");
    let buffer_a = || Tab::Pass(PassName::buffer("A"));
    let edited = |stage: &mut Stage, text: &str| {
        stage.session.apply(EditCommand::EditText { tab: buffer_a(), text: text.into() });
        stage.compile(Command::Edit(EditCommand::CompileNow));
    };
    let mut kept = stage(gpu.clone());
    kept.session.apply(TransportCommand::Reset);
    kept.session.apply(TransportCommand::SetKeepInputs(true));
    steps(&mut kept, 0..120);
    let original = texels(&mut kept);
    let shown = place(&kept);
    edited(&mut kept, &other);
    assert_eq!(place(&kept), shown, "no frame is added");
    let changed = texels(&mut kept);
    assert!(changed != original);
    // As by the new code from the beginning.
    let mut fresh = stage(gpu);
    edited(&mut fresh, &other);
    fresh.session.apply(TransportCommand::Reset);
    steps(&mut fresh, 0..120);
    assert_eq!(place(&fresh), shown);
    assert!(texels(&mut fresh) == changed);
    // And back, from the middle of the run: what was ahead still is.
    kept.act(Command::Transport(TransportCommand::StepBack(40)));
    edited(&mut kept, HISTORY);
    assert_eq!((place(&kept).1, kept.session.reach().ahead), (shown.1 - 40, 40));
    kept.act(Command::Transport(TransportCommand::Seek(shown.0)));
    assert!(texels(&mut kept) == original);
    // A new size of the canvas is an input like others.
    let resized = |stage: &mut Stage| {
        stage.session.apply(CanvasCommand::SetFixedSize(Some((8, 4))));
        stage.session.apply(TransportCommand::Reset);
        steps(stage, 0..60);
        stage.session.apply(CanvasCommand::SetFixedSize(Some((10, 4))));
        steps(stage, 60..120);
    };
    resized(&mut kept);
    let original = texels(&mut kept);
    edited(&mut kept, &other);
    assert_eq!(place(&kept), shown);
    let changed = texels(&mut kept);
    assert!(changed != original);
    resized(&mut fresh);
    assert!(texels(&mut fresh) == changed);
    // Back goes as far as the canvas is the same: the frame that was shown was drawn again on it.
    assert_eq!(kept.session.reach().back, 60);
    // Without the switch only the frame that is shown is drawn by the new code.
    kept.session.apply(TransportCommand::SetKeepInputs(false));
    edited(&mut kept, HISTORY);
    assert_eq!(place(&kept), shown);
    let mixed = texels(&mut kept);
    assert!(mixed != changed && mixed != original);
}

/// Plays a preset for so many frames of uneven length with a hand on it, and records it. Gives the recording and what
/// the pass holds at the end.
pub(super) fn recorded(gpu: &eddy::gpu::Gpu, preset: &str, frames: u32) -> (PathBuf, Vec<u8>, tempfile::TempDir) {
    let mut stage = Stage::bare(gpu.clone());
    stage.session.apply(CanvasCommand::SetFixedSize(Some((64, 36))));
    stage.compile(Command::File(FileCommand::Open(preset.into())));
    stage.session.apply(TransportCommand::Record);
    let mut now = Instant::now();
    let mut drawn = 0;
    while drawn < frames {
        let third = frames / 3;
        match drawn {
            n if n == third => stage.session.apply(CanvasCommand::SetFixedSize(Some((80, 45)))),
            n if n % 40 == 5 => stage.session.apply(InputCommand::MouseDown { x: 10.0, y: 18.0 }),
            n if n % 40 < 30 => {
                stage.session.apply(InputCommand::MouseMove { x: (n * 7 % 64) as f32, y: (n * 5 % 36) as f32 })
            }
            n if n % 40 == 30 => stage.session.apply(InputCommand::MouseUp),
            n if n % 40 == 33 => stage.session.apply(InputCommand::KeyDown(39)),
            n if n % 40 == 38 => stage.session.apply(InputCommand::KeyUp(39)),
            _ => {}
        }
        now += Duration::from_micros(9_000 + u64::from(drawn * 7919 % 17_000));
        drawn += u32::from(stage.session.tick(now).frame_drawn);
    }
    assert!(stage.session.recorded_frames().unwrap() as u32 >= frames - 1);
    stage.session.apply(TransportCommand::Pause);
    let last = texels(&mut stage);
    stage.session.apply(TransportCommand::Record);
    let path = stage.session.notices().iter().rev().find_map(|n| n.path.clone()).unwrap();
    assert_eq!(path.extension().unwrap(), "replay");
    (path, last, stage.dir)
}

#[test]
fn a_recorded_run_is_replayed_bit_for_bit() {
    let Some(gpu) = support::gpu() else { return };
    for preset in ["brick-breaker", "fluid"] {
        let (path, last, _folder) = recorded(&gpu, preset, 1000);
        let recording = Recording::read(BufReader::new(File::open(&path).unwrap())).unwrap();
        let frames = recording.frames.len();
        assert!(frames >= 999, "{frames}");
        let loaded = project::load(preset).unwrap().project;
        let (media, _) = media::gather(&loaded, None);
        let inputs = ScriptedInputs::new(60.0).with_replay(Some(Arc::new(recording)));
        let mut offline = Offline::new(&gpu, (64, 36), inputs).unwrap();
        offline.build(&loaded, &media, &BuildOptions::default()).unwrap();
        for _ in 0..frames {
            offline.draw().unwrap();
        }
        let pixels: Pixels = offline.read(&PassName::image(), 0).unwrap();
        let mut replayed = Vec::new();
        npy::write(&mut replayed, &pixels).unwrap();
        assert_eq!((pixels.width, pixels.height), (80, 45));
        assert!(replayed == last, "{preset}");
    }
}

#[test]
fn an_audit_is_told_in_the_list_of_problems_until_the_next_compile() {
    let Some(gpu) = support::gpu() else { return };
    let code = "void mainImage(out vec4 o, in vec2 p) {\n    float c;\n    if (p.x > 1e9) c = 1.;\n    \
                o = vec4(c + 0.25, sqrt(p.x - 4.0), 0.0, 1.0);\n}\n";
    let mut stage = Stage::open(gpu, &[("image.glsl", code)]);
    assert!(stage.session.diagnostics().is_empty());
    stage.session.apply(ToolCommand::Audit);
    stage.until("findings", |session| !session.diagnostics().is_empty());
    let told: Vec<_> =
        stage.session.diagnostics().iter().map(|d| (d.place.as_ref().unwrap().line, &*d.message)).collect();
    // An undefined variable is reported at its declaration, the others where they arise.
    let line = |message: &str| if message.contains("was never written") { 2 } else { 4 };
    assert!(told.iter().all(|(at, message)| *at == line(message)), "{told:?}");
    for what in ["first NaN here", "was never written", "square root of a negative number"] {
        assert!(told.iter().any(|(_, message)| message.contains(what)), "{what}: {told:?}");
    }
    assert!(
        stage
            .notices(Level::Info)
            .iter()
            .any(|text| text.starts_with("largest error of Image against double precision:"))
    );
    stage.edit(&plain(0.5));
    stage.until_compiled();
    stage.until("a compile without findings", |session| session.diagnostics().is_empty());
}
