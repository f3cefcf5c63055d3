//! Sound that is played with the picture and recorded for it: a session with devices that run by the test's own clock.

use crate::support::{gpu, stage::Stage};
use eddy::{
    audio::{
        Track,
        fake::{FakeHost, FakeOut},
        host::Format,
    },
    playback::scene::{Scene, SceneInputs},
    project::{InputKind, Media, PassName},
    session::{
        CanvasCommand, Command, DeviceState, EditCommand, FileCommand, Level, SessionOptions, SoundCommand,
        TransportCommand,
    },
};
use std::{
    f64::consts::TAU,
    path::{Path, PathBuf},
    sync::Arc,
    time::{Duration, Instant},
};

const RATE: f64 = 44_100.0;
/// The number of samples of the song.
const LENGTH: f64 = 441_000.0;
const SONG: &str = "channels.0 = { file = \"song.wav\", kind = \"music\" }";
const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) { o = texture(iChannel0, vec2(0.1, 0.75)); }\n";

/// Returns a WAV file of 16 bits, stereo, 44.1 kHz, with the same samples on both channels.
pub(crate) fn wav(samples: impl ExactSizeIterator<Item = i16>) -> Vec<u8> {
    let count = samples.len() as u32;
    let mut file = b"RIFF".to_vec();
    file.extend((36 + 4 * count).to_le_bytes());
    file.extend(b"WAVEfmt \x10\0\0\0\x01\0\x02\0");
    file.extend(44_100u32.to_le_bytes());
    file.extend(176_400u32.to_le_bytes());
    file.extend(b"\x04\0\x10\0data");
    file.extend((4 * count).to_le_bytes());
    for value in samples {
        file.extend(value.to_le_bytes().repeat(2));
    }
    file
}

/// Returns sample `n` of a saw tooth with 22 periods per second, from which `n` can be read.
fn saw(n: usize) -> i16 {
    ((n % 2000) as i16 - 1000) * 10
}

/// A session that runs by its own clock, with a device that runs by the same clock.
struct Room {
    stage: Stage,
    host: FakeHost,
    now: Instant,
}

impl Room {
    fn open(host: FakeHost, manifest: &str) -> Option<Room> {
        Self::with_state(host, manifest, None)
    }

    fn with_state(host: FakeHost, manifest: &str, state_dir: Option<PathBuf>) -> Option<Room> {
        let gpu = gpu()?;
        let audio = host.clone();
        let mut stage = Stage::with_options(gpu, |_| SessionOptions {
            audio: Some(Arc::new(audio)),
            audio_on_thread: false,
            state_dir,
            ..SessionOptions::default()
        });
        stage.write("song.wav", wav((0..441_000).map(saw)));
        stage.write("eddy.toml", format!("[passes.image]\n{manifest}\n"));
        stage.write("image.glsl", SHOW);
        if manifest.contains("buffer_a") {
            stage.write("buffer_a.glsl", SHOW);
        }
        let folder = stage.folder();
        stage.session.apply(FileCommand::Open(folder.to_str().unwrap().into()));
        stage.session.apply(TransportCommand::Pause);
        stage.until_compiled();
        stage.session.apply(TransportCommand::Reset);
        Some(Room { stage, host, now: Instant::now() + Duration::from_secs(1) })
    }

    fn with_song(host: FakeHost) -> Option<Room> {
        Self::open(host, SONG)
    }

    /// Advances the clock by `secs`, at 60 frames per second.
    fn run(&mut self, secs: f64) {
        let end = self.now + Duration::from_secs_f64(secs);
        while self.now < end {
            self.stage.session.tick(self.now);
            // Like a real device, it mixes the sound of the next frame now.
            self.host.out.run_until(self.now);
            self.now += Duration::from_micros(16_667);
        }
    }

    fn time(&self) -> f64 {
        self.stage.session.transport().time_secs
    }

    /// Returns the left channel of the samples played since the last call, and the time of the first sample.
    fn heard(&self) -> (Instant, Vec<f32>) {
        let (at, samples) = self.host.out.take_heard();
        (at.expect("something was played"), samples.chunks(2).map(|frame| frame[0]).collect())
    }

    /// Returns the largest distance, in samples, of the last `secs` of played sound from the file at `iTime`.
    fn worst(&self, secs: f64, speed: f64) -> f64 {
        let (at, left) = self.heard();
        // The newest frame was drawn at the tick before now.
        let (drawn, time) = (self.now - Duration::from_micros(16_667), self.time());
        let mut worst = 0.0_f64;
        for (n, sample) in left.iter().enumerate().skip(left.len() - (secs * RATE) as usize) {
            let heard_at = at + Duration::from_secs_f64(n as f64 / RATE);
            let ahead = heard_at.saturating_duration_since(drawn).as_secs_f64();
            let since = drawn.saturating_duration_since(heard_at).as_secs_f64();
            let place = ((time + speed * (ahead - since)) * RATE).rem_euclid(LENGTH);
            let encoded = f64::from(*sample) * 32_768.0 / 10.0 + 1000.0;
            let distance = (place - encoded).rem_euclid(2000.0);
            // An interpolated sample at the edge of the saw tooth is ambiguous.
            if (100.0..1900.0).contains(&place.rem_euclid(2000.0)) && (100.0..LENGTH - 100.0).contains(&place) {
                worst = worst.max(distance.min(2000.0 - distance));
            }
        }
        worst
    }
}

#[test]
fn the_sound_plays_at_the_pictures_time() {
    let Some(mut room) = Room::with_song(FakeHost::default()) else { return };
    room.run(0.2);
    assert!(!room.host.out.is_open(), "the device is opened before it is needed");
    room.stage.session.apply(TransportCommand::Play);
    room.run(1.0);
    assert!(room.host.out.is_open());
    assert!(room.time() > 0.9);
    let worst = room.worst(0.9, 1.0);
    assert!(worst < 1.0, "{worst} samples off");
    // A seek, forwards and back.
    for secs in [7.3, 2.0] {
        room.stage.session.apply(TransportCommand::Seek(secs));
        room.run(0.5);
        assert!((room.time() - secs - 0.48).abs() < 0.03, "{}", room.time());
        let worst = room.worst(0.4, 1.0);
        assert!(worst < 1.0, "{worst} samples off after a seek to {secs}");
    }
    // At the end it loops.
    room.stage.session.apply(TransportCommand::Seek(9.8));
    room.run(0.6);
    assert!(room.worst(0.25, 1.0) < 1.0);
    room.stage.session.apply(TransportCommand::Reset);
    room.run(0.5);
    assert!(room.time() < 0.52 && room.worst(0.4, 1.0) < 1.0);
    // At other speeds, the file is read faster or slower at iTime.
    for speed in [0.25, 0.5, 2.0, 4.0] {
        room.stage.session.apply(TransportCommand::Seek(1.0));
        room.stage.session.apply(TransportCommand::SetSpeed(speed));
        room.run(0.6);
        let worst = room.worst(0.4, speed);
        assert!(worst < 1.0 + speed, "{worst} samples off at {speed}");
    }
    room.stage.session.apply(TransportCommand::SetSpeed(8.0));
    room.run(0.2);
    room.heard();
    room.run(0.2);
    assert!(room.heard().1.iter().all(|sample| *sample == 0.0), "sound at a speed of 8");
    assert_eq!(room.stage.notices(Level::Warning), [""; 0]);
}

#[test]
fn pause_fixed_rate_and_hidden_window_are_silent_and_sound_resumes_in_step() {
    let Some(mut room) = Room::with_song(FakeHost::default()) else { return };
    let silence: [(Command, Command); 3] = [
        (Command::Transport(TransportCommand::Pause), Command::Transport(TransportCommand::Play)),
        (
            Command::Transport(TransportCommand::SetFixedRate(Some(60.0))),
            Command::Transport(TransportCommand::SetFixedRate(None)),
        ),
        (Command::Canvas(CanvasCommand::Hide(true)), Command::Canvas(CanvasCommand::Hide(false))),
    ];
    room.stage.session.apply(TransportCommand::Play);
    for (stop, go_on) in silence {
        room.run(0.5);
        room.stage.session.apply(stop.clone());
        room.run(0.1);
        room.heard();
        room.run(0.5);
        assert!(room.heard().1.iter().all(|sample| *sample == 0.0), "sound after {stop:?}");
        room.stage.session.apply(go_on);
        room.run(0.5);
        let worst = room.worst(0.4, 1.0);
        assert!(worst < 1.0, "{worst} samples off after {stop:?}");
    }
    // Steps and seeks while paused are silent.
    room.stage.session.apply(TransportCommand::Pause);
    room.run(0.1);
    room.heard();
    for _ in 0..5 {
        room.stage.session.apply(TransportCommand::Step);
        room.run(0.05);
        room.stage.session.apply(TransportCommand::Seek(3.0));
        room.run(0.05);
    }
    assert!(room.heard().1.iter().all(|sample| *sample == 0.0));
}

#[test]
fn volume_and_mute_apply_and_shared_music_plays_once() {
    let two = "channels.0 = { file = \"song.wav\", kind = \"music\" }\n[passes.buffer_a]\nchannels.0 = { file = \
               \"song.wav\", kind = \"music\" }";
    let Some(mut room) = Room::open(FakeHost::default(), two) else { return };
    room.stage.session.apply(TransportCommand::Play);
    room.run(0.5);
    assert_eq!(room.stage.session.sources_heard(), 1);
    let loudest = |room: &Room| {
        let left = room.heard().1;
        left[left.len() - 9000..].iter().fold(0.0_f32, |largest, sample| largest.max(sample.abs()))
    };
    let full = loudest(&room);
    assert!((full - 10_000.0 / 32_768.0).abs() < 0.01, "{full}");
    room.stage.session.apply(SoundCommand::SetVolume(0.5));
    room.run(0.5);
    assert!((loudest(&room) - full / 4.0).abs() < 0.01, "a volume of a half is a quarter of the level");
    room.stage.session.apply(SoundCommand::SetMute(true));
    room.run(0.5);
    assert_eq!(loudest(&room), 0.0);
    room.stage.session.apply(SoundCommand::SetMute(false));
    room.run(0.5);
    assert!((loudest(&room) - full / 4.0).abs() < 0.01);
    let view = room.stage.session.output_view().unwrap();
    assert!(view.has_sound && !view.is_muted && view.volume == 0.5);
    // A sound pass in addition, and another one after an edit.
    for (revision, value) in [(1, 3000_i16), (2, -3000)] {
        let track = Track::new(441_000, 44_100);
        (0..10).for_each(|block| track.write(block, vec![[value; 2]; 44_100]));
        room.stage.session.apply(SoundCommand::SetVolume(1.0));
        room.stage.session.play_track(Some((revision, Arc::new(track))));
        room.run(0.5);
        assert_eq!(room.stage.session.sources_heard(), 2);
        let left = room.heard().1;
        let mean = left[left.len() - 8000..].iter().sum::<f32>() / 8000.0;
        // Four whole periods of the song, whose mean is almost zero.
        assert!((mean - f32::from(value) / 32_768.0).abs() < 0.001, "{mean}");
    }
    // Another project is silent.
    room.stage.session.play_track(None);
    room.stage.session.apply(FileCommand::New);
    room.run(0.5);
    assert_eq!(room.stage.session.sources_heard(), 0);
}

#[test]
fn a_missing_device_is_reported_once_and_reopened() {
    let host = FakeHost::default();
    host.out.set_names(&[]);
    let Some(mut room) = Room::with_song(host) else { return };
    room.stage.session.apply(TransportCommand::Play);
    room.run(7.0);
    let reported = |room: &Room| room.stage.count("no sound: ");
    assert_eq!(reported(&room), 1);
    assert!(room.time() > 6.5, "the picture keeps running");
    assert_eq!(room.host.out.attempts(), 3, "every three seconds");
    assert!(matches!(room.stage.session.output_view().unwrap().device, DeviceState::Missing(_)));
    room.host.out.set_names(&["speakers"]);
    room.run(3.5);
    assert!(room.host.out.is_open());
    assert_eq!((reported(&room), room.stage.count("sound plays on speakers")), (0, 1));
    assert!(room.worst(0.3, 1.0) < 1.0, "in step with the picture");
    room.host.out.set_names(&[]);
    room.run(1.0);
    assert_eq!(reported(&room), 1);
    room.host.out.set_names(&["headphones"]);
    room.run(3.5);
    assert!(room.host.out.is_open() && reported(&room) == 0);
    // By name: a missing one, then the existing one.
    room.stage.session.apply(SoundCommand::SetAudioOutput(Some("Kitchen".into())));
    room.run(0.5);
    assert!(!room.host.out.is_open());
    assert_eq!(room.stage.notices(Level::Warning).len(), 1);
    assert!(room.stage.notices(Level::Warning)[0].contains("there is no device \"Kitchen\""));
    room.stage.session.apply(SoundCommand::SetAudioOutput(None));
    room.run(0.5);
    assert!(room.host.out.is_open());
}

#[test]
fn a_project_without_sound_opens_no_device() {
    let host = FakeHost::default();
    host.out.set_names(&[]);
    let Some(mut room) = Room::open(host, "channels.0 = { keyboard = true }") else { return };
    room.stage.session.apply(TransportCommand::Play);
    room.run(5.0);
    assert_eq!((room.host.out.attempts(), room.stage.session.notices().len()), (0, 0));
    // Nor in a session without sound devices.
    let Some(gpu) = gpu() else { return };
    let mut bare = Stage::open(gpu, &[("image.glsl", SHOW)]);
    bare.session.apply(SoundCommand::UseMicrophone(true));
    bare.session.apply(SoundCommand::ListAudioDevices);
    bare.for_a_while();
    assert!(bare.session.output_view().is_none() && bare.session.microphone_view().is_none());
}

#[test]
fn an_unused_device_is_closed_after_a_while() {
    let Some(mut room) = Room::with_song(FakeHost::default()) else { return };
    room.stage.session.apply(TransportCommand::Play);
    room.run(0.5);
    room.stage.session.apply(TransportCommand::Pause);
    room.run(15.0);
    assert!(room.host.out.is_open());
    room.run(8.0);
    assert!(!room.host.out.is_open());
    room.stage.session.apply(TransportCommand::Play);
    room.run(0.5);
    assert!(room.host.out.is_open() && room.worst(0.3, 1.0) < 1.0);
}

#[test]
fn another_device_rate_keeps_the_position() {
    let host = FakeHost { out: FakeOut::new(Format { rate: 48_000, channels: 2 }, 480), ..FakeHost::default() };
    let Some(mut room) = Room::with_song(host) else { return };
    room.stage.session.apply(TransportCommand::Play);
    room.run(1.0);
    let (at, left) = room.heard();
    let (drawn, time) = (room.now - Duration::from_micros(16_667), room.time());
    let mut worst = 0.0_f64;
    for (n, sample) in left.iter().enumerate().skip(20_000) {
        let heard_at = at + Duration::from_secs_f64(n as f64 / 48_000.0);
        let since = drawn.saturating_duration_since(heard_at).as_secs_f64();
        let ahead = heard_at.saturating_duration_since(drawn).as_secs_f64();
        let place = ((time + ahead - since) * RATE).rem_euclid(2000.0);
        if (100.0..1900.0).contains(&place) {
            worst = worst.max((f64::from(*sample) * 32_768.0 / 10.0 + 1000.0 - place).abs());
        }
    }
    assert!(worst < 3.0, "{worst} samples off, more than the ripple of the saw tooth's edge");
}

/// Returns the red of the first pixel, by which the test knows what the shader read.
fn seen(room: &mut Room) -> u8 {
    room.stage.red()
}

#[test]
fn a_microphone_is_opened_only_by_consent_and_its_frames_are_recorded() {
    let host = FakeHost::default();
    let Some(mut room) = Room::open(host, "channels.0 = { microphone = true }") else { return };
    // A silent wave is 128; the synthetic one is not for long.
    room.host.input.plug_in();
    room.stage.session.apply(TransportCommand::Play);
    room.run(0.3);
    assert!(!room.host.input.is_open(), "a project alone opened it");
    let view = room.stage.session.microphone_view().unwrap();
    assert!(view.is_read && !view.is_on);
    room.stage.session.apply(SoundCommand::UseMicrophone(true));
    room.run(0.1);
    assert!(room.host.input.is_open());
    let tone = |from: usize| -> Vec<f32> {
        (from..from + 735).map(|n| (0.2 * (TAU * 441.0 * n as f64 / RATE).sin()) as f32).collect()
    };
    room.stage.session.apply(TransportCommand::Record);
    for frame in 0..30 {
        room.host.input.hear(&tone(735 * frame));
        room.run(0.016);
    }
    assert!(room.stage.session.microphone_view().unwrap().level > 0.15);
    room.stage.session.apply(TransportCommand::Pause);
    room.run(0.1);
    let shown = seen(&mut room);
    // An image contains its project, but no recorded sound.
    let picture = room.stage.screenshot();
    let SceneInputs::Recording(held) = Scene::read(&picture).unwrap().inputs else { panic!("inputs of the window") };
    assert!(held.frames.len() == 1 && held.frames[0].inputs.microphone.is_none());
    // Sound that arrives while time is stopped is not shown.
    room.host.input.hear(&vec![0.9; 4410]);
    room.run(0.1);
    assert_eq!(seen(&mut room), shown);
    room.stage.session.apply(TransportCommand::Record);
    room.run(0.1);
    let notice = room.stage.session.notices().iter().rev().find(|n| n.text.contains("frames of input saved"));
    let file = notice.and_then(|notice| notice.path.clone()).expect("a recording");
    let text = std::fs::read_to_string(&file).unwrap();
    assert!(text.matches("\"mic\"").count() >= 29, "{} frames with it", text.matches("\"mic\"").count());
    // It is closed at once, and the recording replays its sound.
    room.stage.session.apply(SoundCommand::UseMicrophone(false));
    room.run(0.05);
    assert!(!room.host.input.is_open());
    room.stage.session.apply(TransportCommand::PlayRecording(file));
    let end = Instant::now() + Duration::from_secs(20);
    while !room.stage.session.notices().iter().any(|n| n.text.contains(" ended: ")) {
        assert!(Instant::now() < end, "{:#?}", room.stage.session.notices());
        std::thread::sleep(Duration::from_millis(2));
        room.run(0.05);
    }
    assert_eq!(seen(&mut room), shown, "the same picture without the microphone");
    // It is open only while a channel reads it.
    let is_on = |room: &Room| room.stage.session.microphone_view().is_some_and(|view| view.is_on);
    room.stage.session.apply(SoundCommand::UseMicrophone(true));
    room.run(0.1);
    assert!(is_on(&room));
    room.stage.session.apply(EditCommand::SetChannel { pass: PassName::image(), index: 0, channel: None });
    room.run(0.1);
    assert!(!is_on(&room) && !room.host.input.is_open());
    room.stage.session.apply(EditCommand::UndoPassEdit);
    room.run(0.1);
    assert!(is_on(&room) && room.host.input.is_open());
    assert_eq!(room.stage.session.shown_pass(), &PassName::image());
}

#[test]
fn a_microphone_is_closed_when_another_project_opens() {
    let reads = "channels.0 = { microphone = true }";
    let Some(mut room) = Room::open(FakeHost::default(), reads) else { return };
    room.host.input.plug_in();
    room.stage.session.apply(TransportCommand::Play);
    room.stage.session.apply(SoundCommand::UseMicrophone(true));
    room.run(0.2);
    assert!(room.host.input.is_open());
    // The next project reads it as well, but the user has not turned it on for that one.
    std::fs::create_dir(room.stage.path("next")).unwrap();
    room.stage.write("next/eddy.toml", format!("[passes.image]\n{reads}\n"));
    room.stage.write("next/image.glsl", SHOW);
    let next = room.stage.folder().join("next");
    room.stage.session.apply(FileCommand::Open(next.to_str().unwrap().into()));
    room.stage.until_compiled();
    room.stage.session.apply(TransportCommand::Play);
    room.run(0.5);
    let view = room.stage.session.microphone_view().unwrap();
    assert!(view.is_read && !view.is_on && !room.host.input.is_open(), "{view:?}");
    room.stage.session.apply(SoundCommand::UseMicrophone(true));
    room.run(0.2);
    assert!(room.host.input.is_open());
}

/// Returns a copy of the state folder, as a crash would leave it at this moment.
fn crashed(state: &Path) -> tempfile::TempDir {
    let copy = tempfile::tempdir().unwrap();
    for entry in std::fs::read_dir(state).unwrap() {
        let entry = entry.unwrap();
        if entry.file_type().unwrap().is_file() {
            std::fs::copy(entry.path(), copy.path().join(entry.file_name())).unwrap();
        }
    }
    copy
}

#[test]
fn a_sound_device_that_crashed_eddy_is_not_opened_at_the_next_start() {
    let state = tempfile::tempdir().unwrap();
    let start = |state: &Path| Room::with_state(FakeHost::default(), SONG, Some(state.to_owned()));
    let Some(mut room) = start(state.path()) else { return };
    room.stage.session.apply(TransportCommand::Play);
    room.run(0.1);
    assert_eq!(room.host.out.attempts(), 1);
    let after_crash = crashed(state.path());
    // A device that plays for a while leaves no mark, and neither does a run that ends normally.
    room.run(1.5);
    let well = crashed(state.path());
    drop(room);

    let mut next = start(after_crash.path()).unwrap();
    next.stage.session.apply(TransportCommand::Play);
    next.run(1.0);
    assert_eq!(
        (next.host.out.attempts(), next.stage.count("Eddy ended while it opened the default sound device")),
        (0, 1)
    );
    assert!(next.stage.session.output_view().unwrap().ended_before);
    drop(next);
    // Until the user requests it.
    let mut again = start(after_crash.path()).unwrap();
    again.stage.session.apply(TransportCommand::Play);
    again.run(0.5);
    assert_eq!(again.host.out.attempts(), 0, "it was opened without a request");
    again.stage.session.apply(SoundCommand::OpenSoundAgain);
    again.run(0.1);
    assert!(again.host.out.is_open() && again.stage.count("Eddy ended while") == 0);
    again.run(1.5);
    drop(again);
    for state in [well.path(), after_crash.path()] {
        let mut last = start(state).unwrap();
        last.stage.session.apply(TransportCommand::Play);
        last.run(0.1);
        assert_eq!(last.host.out.attempts(), 1);
    }

    // Another device is opened at once.
    let other = crashed(state.path());
    std::fs::write(other.path().join("opening-sound.txt"), "headphones\n").unwrap();
    let mut last = start(other.path()).unwrap();
    last.stage.session.apply(SoundCommand::SetAudioOutput(Some("headphones".into())));
    last.stage.session.apply(TransportCommand::Play);
    last.run(0.2);
    assert_eq!(last.stage.count("Eddy ended while it opened the sound device headphones"), 1);
    last.stage.session.apply(SoundCommand::SetAudioOutput(Some("speakers".into())));
    last.run(0.2);
    assert!(last.host.out.is_open());
}

#[test]
fn a_missing_microphone_is_reported_and_an_unread_one_is_closed() {
    let Some(mut room) = Room::open(FakeHost::default(), "channels.0 = { microphone = true }") else { return };
    room.stage.session.apply(TransportCommand::Play);
    room.stage.session.apply(SoundCommand::UseMicrophone(true));
    room.run(4.0);
    assert_eq!(room.stage.count("the microphone cannot be used: this machine has no input device"), 1);
    room.host.input.plug_in();
    room.run(3.5);
    assert!(room.host.input.is_open());
    assert_eq!(room.stage.count("the microphone cannot be used"), 0);
    room.stage.session.apply(EditCommand::SetChannel { pass: PassName::image(), index: 0, channel: None });
    room.run(0.2);
    assert!(!room.host.input.is_open());
}

#[test]
fn a_dropped_sound_file_is_music_on_a_free_channel() {
    let Some(mut room) = Room::open(FakeHost::default(), "channels.0 = { keyboard = true }") else { return };
    let elsewhere = room.stage.dir.path().join("tune.WAV");
    std::fs::write(&elsewhere, wav((0..44_100).map(saw))).unwrap();
    room.stage.session.apply(TransportCommand::Play);
    room.stage
        .session
        .apply(FileCommand::Bring { paths: vec![elsewhere.clone()], to: Some((PassName::image(), None)) });
    room.stage.until("music", |session| session.output_view().is_some_and(|view| view.has_sound));
    let channel = room.stage.session.project().image().unwrap().bindings.get(1).cloned().unwrap();
    assert_eq!(channel.input.kind(), InputKind::Music);
    assert_eq!(channel.input.media(), Some(&Media::Picked(elsewhere)));
    assert_eq!(room.stage.count("iChannel1 of Image reads tune.WAV"), 1);
    // Saving copies it into the project's folder.
    room.stage.session.apply(FileCommand::Save);
    room.run(0.3);
    assert!(room.stage.path("tune.wav").is_file());
    assert!(room.stage.read("eddy.toml").contains("kind = \"music\""), "{}", room.stage.read("eddy.toml"));
}
