//! Sound that is heard with the picture, and recorded for it.
//!
//! Owns the player and the microphone. Music of the channels and the sound pass are heard at `iTime`: what plays is told
//! how time runs, and by the device's own clock it is brought there (`eddy_audio::mixer`). Devices are opened when
//! something is to be heard or recorded, on threads of their own; one that is missing is told of once.

mod marker;
mod microphone;
mod view;

use marker::{MarkedHost, OutputMarker, UnfinishedOpen};
use microphone::reads_it;
pub use view::{MicrophoneView, OutputView};

use crate::{
    Session,
    view::{About, Level},
};
use eddy_audio::{
    DeviceState, OutputState, Scene, Sound, Source, Spectrum, Timeline, Track, host::AudioHost, microphone::Microphone,
    player::Player,
};
use eddy_media::ChannelSound;
use std::{
    path::Path,
    sync::Arc,
    time::{Duration, Instant},
};

/// Speeds at which sound is played. Slower and faster it is none that anybody would want to hear.
const SPEEDS: std::ops::RangeInclusive<f64> = 0.25..=4.0;

/// A device that has played for so long will not end the program by being opened.
const SETTLES: Duration = Duration::from_secs(1);

pub(crate) struct Audio {
    host: Option<Arc<dyn AudioHost>>,
    on_thread: bool,
    output: Option<String>,
    input: Option<String>,
    player: Option<Player>,
    microphone: Option<Microphone>,
    /// The music of the program that draws, and of one that is coming.
    sounds: Vec<ChannelSound>,
    coming: Option<Vec<ChannelSound>>,
    /// The sound pass, with its revision.
    track: Option<(u64, Arc<Track>)>,
    scene: Arc<Scene>,
    /// Holds what the player was told last.
    sent: Option<(Arc<Scene>, Option<Timeline>, f32)>,
    volume: f32,
    is_muted: bool,
    is_hidden: bool,
    /// A person has switched the microphone on.
    uses_microphone: bool,
    /// The project reads it.
    reads_microphone: bool,
    is_recording: bool,
    /// Holds what the newest frame read of it.
    spectrum: Option<Arc<Spectrum>>,
    /// A device that is missing was told of.
    output_is_missing: bool,
    input_is_missing: bool,
    /// Says to the next start that a device was being opened.
    marker: OutputMarker,
    /// Found of the run before: the device whose driver ended it. That one is not opened before a person asks.
    ended_before: Option<UnfinishedOpen>,
    is_end_told: bool,
    /// Since when the output is open.
    open_since: Option<Instant>,
}

impl Audio {
    pub(crate) fn new(host: Option<Arc<dyn AudioHost>>, on_thread: bool, state_dir: Option<&Path>) -> Self {
        let marker = OutputMarker::new(state_dir.filter(|_| host.is_some()));
        let marked = |host| -> Arc<dyn AudioHost> { Arc::new(MarkedHost { host, marker: marker.clone() }) };
        Self {
            host: host.map(marked),
            ended_before: marker.found(),
            marker,
            is_end_told: false,
            open_since: None,
            on_thread,
            output: None,
            input: None,
            player: None,
            microphone: None,
            sounds: Vec::new(),
            coming: None,
            track: None,
            scene: Arc::default(),
            sent: None,
            volume: 1.0,
            is_muted: false,
            is_hidden: false,
            uses_microphone: false,
            reads_microphone: false,
            is_recording: false,
            spectrum: None,
            output_is_missing: false,
            input_is_missing: false,
        }
    }

    /// Nothing of the project before is heard, and the microphone is off: a person has switched it on for that project.
    pub(crate) fn begin_next_project(&mut self) {
        // The next project is told of it again.
        self.is_end_told = false;
        (self.uses_microphone, self.input_is_missing) = (false, false);
        if std::mem::take(&mut self.is_recording)
            && let Some(microphone) = &mut self.microphone
        {
            microphone.switch(false);
        }
        (self.sounds, self.coming, self.track, self.spectrum) = (Vec::new(), None, None, None);
    }

    /// A program was built whose channels read this music.
    pub(crate) fn expect(&mut self, sounds: Vec<ChannelSound>) {
        self.coming = Some(sounds);
    }

    /// It draws from now on.
    pub(crate) fn program_is_there(&mut self) {
        if let Some(sounds) = self.coming.take() {
            self.sounds = sounds;
        }
    }

    /// Returns the music of the program that draws.
    pub(crate) fn music(&self) -> &[ChannelSound] {
        &self.sounds
    }

    pub(crate) fn set_volume(&mut self, volume: f32) {
        if volume.is_finite() {
            self.volume = volume.clamp(0.0, 1.0);
        }
    }

    pub(crate) fn set_mute(&mut self, on: bool) {
        self.is_muted = on;
    }

    pub(crate) fn choose_output(&mut self, device: Option<String>) {
        if self.ended_before.as_ref().is_some_and(|before| *before != device) {
            self.open_again();
        }
        if let Some(player) = &mut self.player {
            player.choose(device.clone());
        }
        self.output = device;
    }

    /// A person wants the sound device that ended the run before to be opened again, or has chosen another one.
    pub(crate) fn open_again(&mut self) {
        if self.ended_before.take().is_some() {
            self.marker.remove();
        }
    }

    pub(crate) fn choose_input(&mut self, device: Option<String>) {
        if let Some(microphone) = &mut self.microphone {
            microphone.choose(device.clone());
        }
        self.input = device;
    }

    pub(crate) fn list_devices(&mut self, wake: &Arc<dyn Fn() + Send + Sync>) {
        if let Some(player) = self.player(wake) {
            player.ask_names();
        }
        if let Some(microphone) = self.microphone(wake) {
            microphone.ask_names();
        }
    }

    /// Returns the player, made if there is none and the machine has sound. It opens nothing yet.
    fn player(&mut self, wake: &Arc<dyn Fn() + Send + Sync>) -> Option<&mut Player> {
        if self.player.is_none() {
            let host = self.host.as_deref()?;
            let player = if self.on_thread { Player::on_thread(host, wake.clone()) } else { Ok(Player::here(host)) };
            let mut player = player.inspect_err(|e| log::warn!("no thread for sound: {e}")).ok()?;
            player.choose(self.output.clone());
            self.player = Some(player);
        }
        self.player.as_mut()
    }

    fn microphone(&mut self, wake: &Arc<dyn Fn() + Send + Sync>) -> Option<&mut Microphone> {
        if self.microphone.is_none() {
            let host = self.host.as_deref()?;
            let made =
                if self.on_thread { Microphone::on_thread(host, wake.clone()) } else { Ok(Microphone::here(host)) };
            let mut microphone = made.inspect_err(|e| log::warn!("no thread for the microphone: {e}")).ok()?;
            microphone.choose(self.input.clone());
            self.microphone = Some(microphone);
        }
        self.microphone.as_mut()
    }

    /// The factor of every sample. Ears hear ratios: half the way of the slider is a quarter, -12 dB.
    fn gain(&self) -> f32 {
        if self.is_muted { 0.0 } else { self.volume * self.volume }
    }

    /// Each music once, however many channels read it, then the sound pass.
    fn sources(&self) -> Vec<Source> {
        let mut sources: Vec<Source> = Vec::new();
        for ChannelSound { sound, .. } in &self.sounds {
            let source = Source::Loop(sound.clone());
            if !sources.iter().any(|known| known.is(&source)) {
                sources.push(source);
            }
        }
        sources.extend(self.track.iter().map(|(_, track)| Source::Track(track.clone())));
        sources
    }

    /// Tells the player what is to be heard from now on, where that is something else than before.
    fn play(&mut self, line: Option<Timeline>, wake: &Arc<dyn Fn() + Send + Sync>, now: Instant) {
        let scene = Scene { sources: self.sources() };
        if !scene.is(&self.scene) {
            self.scene = Arc::new(scene);
        }
        let line = line.filter(|line| SPEEDS.contains(&line.speed) && !self.is_hidden);
        let desired = OutputState { scene: self.scene.clone(), line, gain: self.gain() };
        // Nothing is opened for a project without sound.
        if self.ended_before.is_some() || (self.player.is_none() && !desired.is_heard()) {
            return;
        }
        let wanted = (desired.scene.clone(), line, desired.gain);
        let is_sent = self
            .sent
            .as_ref()
            .is_some_and(|sent| Arc::ptr_eq(&sent.0, &wanted.0) && (sent.1, sent.2) == (wanted.1, wanted.2));
        let Some(player) = self.player(wake) else { return };
        if !is_sent {
            player.play(desired);
        }
        player.step(now);
        match player.state() {
            DeviceState::Open { .. } => {
                let since = *self.open_since.get_or_insert(now);
                if now.saturating_duration_since(since) >= SETTLES {
                    self.marker.clear();
                }
            }
            // It is closed, or being opened on its thread.
            DeviceState::Closed | DeviceState::Missing(_) => self.open_since = None,
        }
        self.sent = Some(wanted);
    }
}

/// Something to say of a device.
enum News {
    /// It could not be opened, or has vanished.
    Missing(String),
    /// One that was missing is open.
    Back(String),
    /// Nobody needs the one that was missing.
    Over,
}

/// Compares the state of a device with what was told of it.
fn news(state: DeviceState, is_missing: &mut bool) -> Option<News> {
    match state {
        DeviceState::Missing(why) if !std::mem::replace(is_missing, true) => Some(News::Missing(why)),
        DeviceState::Open { name, .. } if std::mem::take(is_missing) => Some(News::Back(name)),
        DeviceState::Closed if *is_missing => Some(News::Over),
        _ => None,
    }
}

impl Drop for Audio {
    /// The program ends as it should.
    fn drop(&mut self) {
        self.marker.clear();
    }
}

impl Session {
    /// Takes the sound pass as far as it is made, with its revision; `None`: there is none. The sound goes over from one
    /// revision to the next without a gap.
    pub fn play_track(&mut self, track: Option<(u64, Arc<Track>)>) {
        self.audio.track = track;
    }

    /// Has what is heard follow the picture, at the end of a tick.
    pub(crate) fn play_sound(&mut self) {
        let is_drawn = self.drawing.has_program() && !self.halting.is_halted() && !self.halting.is_device_gone();
        let line = self.playback.line().filter(|_| is_drawn);
        self.audio.play(line, &self.wake, self.now);
        self.tell_of_the_end_before();
        let Some(player) = &self.audio.player else { return };
        match news(player.state(), &mut self.audio.output_is_missing) {
            Some(News::Missing(why)) => {
                let text = format!("no sound: {why}. The picture goes on; Eddy looks for a device every 3 seconds");
                self.notice_about(About::Sound, Level::Warning, text);
            }
            Some(News::Back(name)) => {
                self.settled(About::Sound);
                self.notice_about(About::Sound, Level::Info, format!("sound plays on {name}"));
            }
            Some(News::Over) => self.settled(About::Sound),
            None => {}
        }
    }

    /// Says why nothing is heard where a sound driver ended the run before.
    fn tell_of_the_end_before(&mut self) {
        let audio = &mut self.audio;
        let Some(before) = audio.ended_before.clone().filter(|_| audio.has_sound()) else { return };
        if std::mem::replace(&mut audio.is_end_told, true) {
            return;
        }
        let device = before.map_or("the default sound device".to_owned(), |name| format!("the sound device {name}"));
        let text = format!(
            "Eddy ended while it opened {device} the last time, so nothing is heard. Click the speaker below the picture to open it \
             again, or choose another device in Settings"
        );
        self.notice_about(About::Sound, Level::Warning, text);
    }

    pub(crate) fn open_sound_again(&mut self) {
        self.audio.open_again();
        self.settled(About::Sound);
    }

    pub(crate) fn hide(&mut self, is_hidden: bool) {
        if std::mem::replace(&mut self.audio.is_hidden, is_hidden) && !is_hidden {
            // Nothing was drawn meanwhile: time goes on from where it was.
            self.playback.rebase();
        }
        self.play_sound();
    }
}
