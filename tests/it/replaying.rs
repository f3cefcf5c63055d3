//! A recording is played in an open session as the command line draws it, and leaves everything as it was.

use super::time_travel::{recorded, stage, steps, texels};
use crate::support::{self, stage::*};
use eddy::{
    engine::BuildOptions,
    gpu::Gpu,
    media,
    playback::{npy, offline::Offline, recording::Recording, script::ScriptedInputs},
    project::{self, PassName},
    session::{Answer, Command, Level},
};
use std::{
    fs::{self, File},
    io::BufReader,
    path::{Path, PathBuf},
    sync::Arc,
    time::{Duration, Instant},
};

/// Begins to play a file.
fn play(stage: &mut Stage, file: &Path) {
    stage.session.apply(Command::PlayRecording(file.to_owned()));
    stage.until("a recording that plays", |session| session.replay().is_some());
}

/// Ticks, 60 times a second of a time of its own, until so many frames have been drawn, or all.
fn draw(stage: &mut Stage, frames: usize) {
    let mut now = Instant::now();
    for _ in 0..20_000 {
        match stage.session.replay() {
            Some(replay) if replay.drawn < frames => {}
            _ => return,
        }
        now += Duration::from_micros(16_667);
        stage.session.tick(now);
    }
    panic!("only {:?}", stage.session.replay());
}

/// Returns the texels of a pass at the end of a recording as `eddy render --replay` draws them.
fn rendered(gpu: &Gpu, spec: &str, file: &Path, pass: &PassName) -> Vec<u8> {
    let recording = Recording::read(BufReader::new(File::open(file).unwrap())).unwrap();
    let (size, frames) = (recording.frames[0].size, recording.frames.len());
    let loaded = project::load(spec).unwrap().project;
    let (media, _) = media::gather(&loaded, None);
    let inputs = ScriptedInputs::new(60.0).with_replay(Some(Arc::new(recording)));
    let mut offline = Offline::new(gpu, size, inputs).unwrap();
    offline.build(&loaded, &media, &BuildOptions { requested: vec![pass.clone()], ..BuildOptions::default() }).unwrap();
    for _ in 0..frames {
        offline.draw().unwrap();
    }
    let mut bytes = Vec::new();
    npy::write(&mut bytes, &offline.read(pass, 0).unwrap()).unwrap();
    bytes
}

/// The hand, the keys, the canvas and the date are the recording's, whatever happens to the window meanwhile.
#[test]
fn what_was_recorded_is_played_bit_for_bit_and_ends_paused() {
    let Some(gpu) = support::gpu() else { return };
    for preset in ["brick-breaker", "fluid"] {
        let (file, last, _folder) = recorded(&gpu, preset, 240);
        let mut stage = Stage::bare(gpu.clone());
        stage.session.apply(Command::SetFixedSize(Some((32, 18))));
        stage.compile(Command::Open(preset.into()));
        stage.session.apply(Command::KeyDown(37));
        stage.session.apply(Command::MouseDown { x: 1.0, y: 1.0 });
        play(&mut stage, &file);
        assert!(stage.session.transport().playing);
        draw(&mut stage, 50);
        stage.session.apply(Command::MouseMove { x: 30.0, y: 3.0 });
        stage.session.apply(Command::MouseUp);
        stage.session.apply(Command::MouseDown { x: 2.0, y: 12.0 });
        stage.session.apply(Command::KeyDown(39));
        draw(&mut stage, usize::MAX);
        assert!(!stage.session.transport().playing);
        assert_eq!(stage.session.transport().resolution, (80, 45));
        assert!(texels(&mut stage) == last, "{preset}: as it was when it was recorded");
        assert!(texels(&mut stage) == rendered(&gpu, preset, &file, &PassName::image()), "{preset}: as it is rendered");
        let notices = stage.notices(Level::Info).join("\n");
        assert!(notices.contains("ended: the picture is paused at frame"), "{notices}");
        assert!(stage.notices(Level::Warning).is_empty() && stage.notices(Level::Error).is_empty());
        assert!(!stage.session.is_dirty());
        // Paused it stays, and an own size takes over again.
        stage.for_a_while();
        assert!(texels(&mut stage) == last);
        stage.act(Command::SetFixedSize(Some((40, 20))));
        assert_eq!(stage.session.transport().resolution, (40, 20));
    }
}

/// Records frames by steps, with a hand and a slider. Gives the file, and what the pass held after some of them.
fn by_steps(stage: &mut Stage) -> (PathBuf, Vec<(i32, f64, Vec<u8>)>) {
    stage.session.apply(Command::Record);
    let mut known = Vec::new();
    for (from, to) in [(0, 20), (20, 61), (61, 130)] {
        steps(stage, from..to);
        let transport = stage.session.transport();
        known.push((transport.frame, transport.time_secs, texels(stage)));
    }
    stage.session.apply(Command::Record);
    let file = stage.session.notices().iter().rev().find_map(|n| n.path.clone()).unwrap();
    assert_eq!(file.extension().unwrap(), "replay");
    (file, known)
}

#[test]
fn sliders_are_the_recordings_until_it_is_over_and_the_projects_after_it() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu.clone());
    let (file, known) = by_steps(&mut stage);
    // A slider stands elsewhere than the recording has it.
    stage.act(Command::AssignCustomUniform("level=0.75".into()));
    let before = stage.session.project().clone();
    play(&mut stage, &file);
    draw(&mut stage, usize::MAX);
    let folder = stage.folder();
    let buffer = PassName::buffer("A");
    let end = texels(&mut stage);
    assert!(end == known.last().unwrap().2, "as it was recorded");
    assert!(end == rendered(&gpu, folder.to_str().unwrap(), &file, &buffer), "as it is rendered");
    assert_eq!(*stage.session.project(), before, "nothing of the project is changed");
    // Played again it is the same, also at another speed.
    stage.session.apply(Command::SetSpeed(8.0));
    play(&mut stage, &file);
    draw(&mut stage, usize::MAX);
    assert!(texels(&mut stage) == end);
    // The next frame is the project's own.
    stage.act(Command::Step);
    assert_eq!(stage.session.transport().frame, 130);
    let own = texels(&mut stage);
    stage.act(Command::StepBack(1));
    assert!(texels(&mut stage) == end, "the frame before it is still the recording's");
    // The same with the recording's value is another frame.
    play(&mut stage, &file);
    draw(&mut stage, usize::MAX);
    stage.session.apply(Command::AssignCustomUniform("level=0.125".into()));
    stage.act(Command::Step);
    assert!(texels(&mut stage) != own);
}

#[test]
fn a_recording_is_paused_sought_stepped_and_stopped() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    let (file, known) = by_steps(&mut stage);
    play(&mut stage, &file);
    draw(&mut stage, 30);
    let frames = stage.session.replay().unwrap().frames;
    stage.session.apply(Command::Pause);
    // Further than it has been played, back, and over again.
    for (frame, time, wanted) in [&known[1], &known[0], &known[1], &known[0]] {
        stage.session.apply(Command::Seek(*time + 1e-4));
        stage.until("the time that was sought", |session| !session.transport().is_seeking);
        let replay = stage.session.replay().expect("it is not over");
        assert_eq!((replay.drawn as i32, replay.frames), (frame + 1, frames));
        assert_eq!(stage.session.transport().frame, *frame);
        assert!(!stage.session.transport().playing);
        assert!(texels(&mut stage) == *wanted, "frame {frame}");
    }
    // Paused, nothing is drawn, whatever a hand does.
    stage.session.apply(Command::MouseDown { x: 1.0, y: 1.0 });
    stage.session.apply(Command::KeyDown(32));
    stage.for_a_while();
    assert!(texels(&mut stage) == known[0].2);
    // Step by step to the next known one.
    for _ in known[0].0..known[1].0 {
        stage.act(Command::Step);
    }
    assert!(texels(&mut stage) == known[1].2);
    stage.act(Command::StopReplay);
    assert!(stage.session.replay().is_none() && texels(&mut stage) == known[1].2);
    assert!(stage.notices(Level::Info).iter().any(|text| text.contains("continues live")));
    // From here on it is a hand's again.
    let frame = stage.session.transport().frame;
    stage.act(Command::MouseDown { x: 1.0, y: 1.0 });
    assert_eq!(stage.session.transport().frame, frame + 1, "input draws a frame while paused");
    assert!(texels(&mut stage) != known[1].2);
}

#[test]
fn what_ends_a_recording_says_so() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    let (file, _) = by_steps(&mut stage);
    for (command, why) in [
        (Command::Reset, "the picture was reset"),
        (Command::SetFixedSize(Some((12, 6))), "the resolution was changed"),
        (Command::Record, "the picture was reset"),
    ] {
        play(&mut stage, &file);
        draw(&mut stage, 30);
        let drawn = stage.session.replay().unwrap().drawn;
        stage.session.apply(command.clone());
        assert!(stage.session.replay().is_none(), "{command:?}");
        let notices = stage.notices(Level::Info).join("\n");
        assert!(notices.contains(&format!("stopped project-0001.replay at frame {drawn} of 130: {why}")), "{notices}");
        let ids: Vec<u64> = stage.session.notices().iter().map(|notice| notice.id).collect();
        ids.into_iter().for_each(|id| stage.session.apply(Command::DismissNotice(id)));
    }
    // A recording that begins to play ends one that is made, and loses nothing of it.
    stage.tick();
    steps(&mut stage, 0..3);
    play(&mut stage, &file);
    assert!(stage.session.recorded_frames().is_none());
    assert!(stage.path("project-0002.replay").exists());
    // Another project has nothing to do with it.
    stage.session.apply(Command::Open("feedback".into()));
    stage.session.apply(Command::Answer(Answer::Discard));
    assert!(stage.session.replay().is_none());
}

#[test]
fn a_file_that_cannot_be_played_is_named_with_its_line_and_what_to_do() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    let before = texels(&mut stage);
    let head = "{\"eddy_recording\":1,\"project\":\"project\"}\n";
    for (text, says) in [
        (Some("hello\n".to_owned()), "not an Eddy recording"),
        (Some(format!("{head}{{\"time\":0,\"size\":[4,4]}}\n{{\"mouse\":3}}\n")), "line 3: "),
        (Some(head.to_owned()), "it has no frames; record the input again"),
        (None, "check that the file is there"),
    ] {
        let file = stage.path("bad.replay");
        let _ = fs::remove_file(&file);
        if let Some(text) = text {
            fs::write(&file, text).unwrap();
        }
        stage.session.apply(Command::Bring { paths: vec![file.clone()], to: Some((PassName::image(), None)) });
        stage.until("an error", |session| session.notices().iter().any(|n| n.text.contains(says)));
        let [error] = stage.notices(Level::Error)[..] else { panic!("{:?}", stage.session.notices()) };
        assert!(error.starts_with(&format!("cannot play {}: ", file.display())), "{error}");
        assert!(stage.session.replay().is_none());
    }
    assert!(texels(&mut stage) == before, "the picture is as it was");
}

#[test]
fn a_recording_of_another_project_is_played_with_a_warning_and_none_without_a_project() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    let (file, _) = by_steps(&mut stage);
    stage.session.apply(Command::Open("feedback".into()));
    stage.compile(Command::Answer(Answer::Discard));
    stage.session.apply(Command::Bring { paths: vec![file.clone()], to: None });
    let notices = stage.notices(Level::Warning).join("\n");
    assert!(
        notices.contains("open the project that it was recorded in") && stage.session.replay().is_none(),
        "{notices}"
    );
    stage.session.apply(Command::Bring { paths: vec![file], to: Some((PassName::image(), None)) });
    stage.until("a recording that plays", |session| session.replay().is_some());
    let notices = stage.notices(Level::Warning).join("\n");
    assert!(notices.contains("was recorded in the project \"project\", but \"Feedback\" is open"), "{notices}");
    draw(&mut stage, usize::MAX);
}
