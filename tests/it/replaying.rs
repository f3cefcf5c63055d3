//! A recording is played in an open session with the same result as on the command line, and changes nothing of the
//! project.

use super::time_travel::{recorded, stage, steps, texels};
use crate::support::{self, stage::*};
use eddy::{
    engine::BuildOptions,
    gpu::Gpu,
    media,
    playback::{npy, offline::Offline, recording::Recording, script::ScriptedInputs},
    project::{self, PassName},
    session::{
        Answer, CanvasCommand, Command, EditCommand, FileCommand, InputCommand, Level, NoticeCommand, TransportCommand,
    },
};
use std::{
    fs::{self, File},
    io::BufReader,
    path::{Path, PathBuf},
    sync::Arc,
    time::{Duration, Instant},
};

/// Starts to play a file.
fn play(stage: &mut Stage, file: &Path) {
    stage.session.apply(TransportCommand::PlayRecording(file.to_owned()));
    stage.until("a recording that plays", |session| session.replay().is_some());
}

/// Ticks at 60 frames per second of its own clock until `frames` frames have been drawn, or all.
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

/// Mouse, keys, size and date come from the recording, whatever happens to the window in the meantime.
#[test]
fn a_recording_is_played_bit_for_bit_and_ends_paused() {
    let Some(gpu) = support::gpu() else { return };
    for preset in ["brick-breaker", "fluid"] {
        let (file, last, _folder) = recorded(&gpu, preset, 240);
        let mut stage = Stage::bare(gpu.clone());
        stage.session.apply(CanvasCommand::SetFixedSize(Some((32, 18))));
        stage.compile(Command::File(FileCommand::Open(preset.into())));
        stage.session.apply(InputCommand::KeyDown(37));
        stage.session.apply(InputCommand::MouseDown { x: 1.0, y: 1.0 });
        play(&mut stage, &file);
        assert!(stage.session.transport().playing);
        draw(&mut stage, 50);
        stage.session.apply(InputCommand::MouseMove { x: 30.0, y: 3.0 });
        stage.session.apply(InputCommand::MouseUp);
        stage.session.apply(InputCommand::MouseDown { x: 2.0, y: 12.0 });
        stage.session.apply(InputCommand::KeyDown(39));
        draw(&mut stage, usize::MAX);
        assert!(!stage.session.transport().playing);
        assert_eq!(stage.session.transport().resolution, (80, 45));
        assert!(texels(&mut stage) == last, "{preset}: equal to the recorded picture");
        assert!(
            texels(&mut stage) == rendered(&gpu, preset, &file, &PassName::image()),
            "{preset}: equal to the rendered picture"
        );
        let notices = stage.notices(Level::Info).join("\n");
        assert!(notices.contains("ended: the picture is paused at frame"), "{notices}");
        assert!(stage.notices(Level::Warning).is_empty() && stage.notices(Level::Error).is_empty());
        assert!(!stage.session.is_dirty());
        // It stays paused, and the user's own size applies again.
        stage.for_a_while();
        assert!(texels(&mut stage) == last);
        stage.act(Command::Canvas(CanvasCommand::SetFixedSize(Some((40, 20)))));
        assert_eq!(stage.session.transport().resolution, (40, 20));
    }
}

/// Records frames by steps, with a mouse and a slider. Returns the file, and the texels of the pass after some frames.
fn record_steps(stage: &mut Stage) -> (PathBuf, Vec<(i32, f64, Vec<u8>)>) {
    stage.session.apply(TransportCommand::Record);
    let mut known = Vec::new();
    for (from, to) in [(0, 20), (20, 61), (61, 130)] {
        steps(stage, from..to);
        let transport = stage.session.transport();
        known.push((transport.frame, transport.time_secs, texels(stage)));
    }
    stage.session.apply(TransportCommand::Record);
    let file = stage.session.notices().iter().rev().find_map(|n| n.path.clone()).unwrap();
    assert_eq!(file.extension().unwrap(), "replay");
    (file, known)
}

#[test]
fn sliders_follow_the_recording_until_it_ends() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu.clone());
    let (file, known) = record_steps(&mut stage);
    // A slider has another value than in the recording.
    stage.act(Command::Edit(EditCommand::AssignCustomUniform("level=0.75".into())));
    let before = stage.session.project().clone();
    play(&mut stage, &file);
    draw(&mut stage, usize::MAX);
    let folder = stage.folder();
    let buffer = PassName::buffer("A");
    let end = texels(&mut stage);
    assert!(end == known.last().unwrap().2, "equal to the recorded texels");
    assert!(end == rendered(&gpu, folder.to_str().unwrap(), &file, &buffer), "equal to the rendered texels");
    assert_eq!(*stage.session.project(), before, "the project is unchanged");
    // Playing it again, also at another speed, gives the same result.
    stage.session.apply(TransportCommand::SetSpeed(8.0));
    play(&mut stage, &file);
    draw(&mut stage, usize::MAX);
    assert!(texels(&mut stage) == end);
    // The next frame uses the project's own values.
    stage.act(Command::Transport(TransportCommand::Step));
    assert_eq!(stage.session.transport().frame, 130);
    let own = texels(&mut stage);
    stage.act(Command::Transport(TransportCommand::StepBack(1)));
    assert!(texels(&mut stage) == end, "the previous frame still has the recording's values");
    // With the recording's value the next frame is different.
    play(&mut stage, &file);
    draw(&mut stage, usize::MAX);
    stage.session.apply(EditCommand::AssignCustomUniform("level=0.125".into()));
    stage.act(Command::Transport(TransportCommand::Step));
    assert!(texels(&mut stage) != own);
}

#[test]
fn a_recording_can_be_paused_sought_stepped_and_stopped() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    let (file, known) = record_steps(&mut stage);
    play(&mut stage, &file);
    draw(&mut stage, 30);
    let frames = stage.session.replay().unwrap().frames;
    stage.session.apply(TransportCommand::Pause);
    // Beyond the played part, back, and again.
    for (frame, time, wanted) in [&known[1], &known[0], &known[1], &known[0]] {
        stage.session.apply(TransportCommand::Seek(*time + 1e-4));
        stage.until("the seek", |session| !session.transport().is_seeking);
        let replay = stage.session.replay().expect("it is not over");
        assert_eq!((replay.drawn as i32, replay.frames), (frame + 1, frames));
        assert_eq!(stage.session.transport().frame, *frame);
        assert!(!stage.session.transport().playing);
        assert!(texels(&mut stage) == *wanted, "frame {frame}");
    }
    // While paused, input draws no frame.
    stage.session.apply(InputCommand::MouseDown { x: 1.0, y: 1.0 });
    stage.session.apply(InputCommand::KeyDown(32));
    stage.for_a_while();
    assert!(texels(&mut stage) == known[0].2);
    // Step by step to the next known one.
    for _ in known[0].0..known[1].0 {
        stage.act(Command::Transport(TransportCommand::Step));
    }
    assert!(texels(&mut stage) == known[1].2);
    stage.act(Command::Transport(TransportCommand::StopReplay));
    assert!(stage.session.replay().is_none() && texels(&mut stage) == known[1].2);
    assert!(stage.notices(Level::Info).iter().any(|text| text.contains("continues live")));
    // From here on, the picture follows live input.
    let frame = stage.session.transport().frame;
    stage.act(Command::Input(InputCommand::MouseDown { x: 1.0, y: 1.0 }));
    assert_eq!(stage.session.transport().frame, frame + 1, "input draws a frame while paused");
    assert!(texels(&mut stage) != known[1].2);
}

#[test]
fn stopping_a_replay_is_reported_with_its_reason() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    let (file, _) = record_steps(&mut stage);
    for (command, why) in [
        (Command::Transport(TransportCommand::Reset), "the picture was reset"),
        (Command::Canvas(CanvasCommand::SetFixedSize(Some((12, 6)))), "the resolution was changed"),
        (Command::Transport(TransportCommand::Record), "the picture was reset"),
    ] {
        play(&mut stage, &file);
        draw(&mut stage, 30);
        let drawn = stage.session.replay().unwrap().drawn;
        stage.session.apply(command.clone());
        assert!(stage.session.replay().is_none(), "{command:?}");
        let notices = stage.notices(Level::Info).join("\n");
        assert!(notices.contains(&format!("stopped project-0001.replay at frame {drawn} of 130: {why}")), "{notices}");
        let ids: Vec<u64> = stage.session.notices().iter().map(|notice| notice.id).collect();
        ids.into_iter().for_each(|id| stage.session.apply(NoticeCommand::DismissNotice(id)));
    }
    // Playing a recording stops the one being made, and saves it.
    stage.tick();
    steps(&mut stage, 0..3);
    play(&mut stage, &file);
    assert!(stage.session.recorded_frames().is_none());
    assert!(stage.path("project-0002.replay").exists());
    // Opening another project ends the replay.
    stage.session.apply(FileCommand::Open("feedback".into()));
    stage.session.apply(FileCommand::Answer(Answer::Discard));
    assert!(stage.session.replay().is_none());
}

#[test]
fn an_invalid_recording_is_reported_with_its_line_and_a_fix() {
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
        stage.session.apply(FileCommand::Bring { paths: vec![file.clone()], to: Some((PassName::image(), None)) });
        stage.until("an error", |session| session.notices().iter().any(|n| n.text.contains(says)));
        let [error] = stage.notices(Level::Error)[..] else { panic!("{:?}", stage.session.notices()) };
        assert!(error.starts_with(&format!("cannot play {}: ", file.display())), "{error}");
        assert!(stage.session.replay().is_none());
    }
    assert!(texels(&mut stage) == before, "the picture is unchanged");
}

#[test]
fn a_recording_of_another_project_is_played_with_a_warning() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    let (file, _) = record_steps(&mut stage);
    stage.session.apply(FileCommand::Open("feedback".into()));
    stage.compile(Command::File(FileCommand::Answer(Answer::Discard)));
    stage.session.apply(FileCommand::Bring { paths: vec![file.clone()], to: None });
    let notices = stage.notices(Level::Warning).join("\n");
    assert!(
        notices.contains("open the project that it was recorded in") && stage.session.replay().is_none(),
        "{notices}"
    );
    stage.session.apply(FileCommand::Bring { paths: vec![file], to: Some((PassName::image(), None)) });
    stage.until("a recording that plays", |session| session.replay().is_some());
    let notices = stage.notices(Level::Warning).join("\n");
    assert!(notices.contains("was recorded in the project \"project\", but \"Feedback\" is open"), "{notices}");
    draw(&mut stage, usize::MAX);
}
