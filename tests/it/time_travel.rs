//! Frames that were drawn before: gone back to, and drawn again from their recorded inputs, bit for bit.

use crate::support::{self, stage::*};
use eddy::{
    engine::{BuildOptions, Pixels},
    media,
    project::{self, PassId},
    session::{Command, Level, npy, offline::Offline, recording::Recording, script::ScriptedInputs},
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

fn stage(gpu: eddy::gpu::Gpu) -> Stage {
    let mut stage = Stage::open(gpu, &[("eddy.toml", MANIFEST), ("buffer_a.glsl", HISTORY), ("image.glsl", SHOW)]);
    assert!(stage.is_ok(), "{:?}", stage.session.notices());
    stage.session.apply(Command::ShowPass(PassId::Buffer("A".into())));
    stage.tick();
    stage
}

/// The texels of the pass that is shown.
fn texels(stage: &mut Stage) -> Vec<u8> {
    stage.session.apply(Command::SaveTexels);
    stage.tick();
    let notice = stage.session.notices().iter().rev().find_map(|n| n.path.clone()).unwrap();
    fs::read(notice).unwrap()
}

/// Draws as many frames as there are, one after the other, with a hand that moves and a slider that is turned.
fn steps(stage: &mut Stage, frames: std::ops::Range<i32>) {
    for frame in frames {
        match frame {
            30 => stage.session.apply(Command::MouseDown { x: 1.5, y: 1.5 }),
            31..90 => stage.session.apply(Command::MouseMove { x: (frame % 8) as f32, y: 2.5 }),
            90 => stage.session.apply(Command::MouseUp),
            110 => stage.session.apply(Command::AssignCustomUniform("level=0.125".into())),
            _ => {}
        }
        stage.session.apply(Command::Step);
        stage.tick();
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
        stage.session.apply(Command::StepBack((at - frame) as usize));
        stage.tick();
        assert!(texels(&mut stage) == before, "frame {frame}");
        assert!(!stage.session.transport().playing);
        at = frame;
    }
    // On from there as ever.
    let frame = stage.session.transport().frame;
    stage.session.apply(Command::Step);
    stage.tick();
    assert_eq!(stage.session.transport().frame, frame + 1);
    assert!(stage.notices(Level::Error).is_empty() && stage.notices(Level::Warning).is_empty());
}

#[test]
fn what_is_out_of_reach_is_told_and_changes_nothing() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    steps(&mut stage, 0..10);
    let before = texels(&mut stage);
    stage.session.apply(Command::StepBack(500));
    stage.tick();
    assert!(texels(&mut stage) == before);
    assert!(stage.notices(Level::Warning)[0].contains("one can go back"), "{:?}", stage.notices(Level::Warning));
    stage.session.apply(Command::Reset);
    stage.tick();
    stage.session.apply(Command::StepBack(1));
    stage.tick();
    assert!(stage.notices(Level::Warning)[1].contains("begins anew"), "{:?}", stage.notices(Level::Warning));
}

/// Plays a preset for so many frames of uneven length with a hand on it, and records it. Gives the recording and what
/// the pass holds at the end.
fn recorded(gpu: &eddy::gpu::Gpu, preset: &str, frames: u32) -> (PathBuf, Vec<u8>, tempfile::TempDir) {
    let mut stage = Stage::bare(gpu.clone());
    stage.session.apply(Command::SetFixedSize(Some((64, 36))));
    stage.session.apply(Command::Open(preset.into()));
    stage.until_compiled();
    stage.session.apply(Command::Record);
    let mut now = Instant::now();
    let mut drawn = 0;
    while drawn < frames {
        let third = frames / 3;
        match drawn {
            n if n == third => stage.session.apply(Command::SetFixedSize(Some((80, 45)))),
            n if n % 40 == 5 => stage.session.apply(Command::MouseDown { x: 10.0, y: 18.0 }),
            n if n % 40 < 30 => {
                stage.session.apply(Command::MouseMove { x: (n * 7 % 64) as f32, y: (n * 5 % 36) as f32 })
            }
            n if n % 40 == 30 => stage.session.apply(Command::MouseUp),
            n if n % 40 == 33 => stage.session.apply(Command::KeyDown(39)),
            n if n % 40 == 38 => stage.session.apply(Command::KeyUp(39)),
            _ => {}
        }
        now += Duration::from_micros(9_000 + u64::from(drawn * 7919 % 17_000));
        drawn += u32::from(stage.session.tick(now).frame_drawn);
    }
    assert!(stage.session.recorded_frames().unwrap() as u32 >= frames - 1);
    stage.session.apply(Command::Pause);
    let last = texels(&mut stage);
    stage.session.apply(Command::Record);
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
        let pixels: Pixels = offline.read(&PassId::Image, 0).unwrap();
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
    stage.session.apply(Command::Audit);
    stage.until("findings", |session| !session.diagnostics().is_empty());
    let told: Vec<_> =
        stage.session.diagnostics().iter().map(|d| (d.place.as_ref().unwrap().line, &*d.message)).collect();
    assert!(told.iter().all(|(line, _)| *line == 4), "{told:?}");
    for what in ["NaN is born here", "that nothing was written to", "square root of a negative number"] {
        assert!(told.iter().any(|(_, message)| message.contains(what)), "{what}: {told:?}");
    }
    assert!(stage.notices(Level::Info).iter().any(|text| text.starts_with("Image is off double precision by")));
    stage.edit(&plain(0.5));
    stage.until_compiled();
    stage.until("a compile without findings", |session| session.diagnostics().is_empty());
}
