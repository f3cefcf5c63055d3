//! Sound that plays with the picture, and sound recorded for it.
//!
//! Owns the player and the microphone. Music of channels and the sound pass play at `iTime`: the player gets a timeline
//! and corrects its position by the device's clock (`eddy_audio::mixer`). Devices are opened on threads of their own
//! when there is something to play or record; a missing device is reported once.

mod marker;
mod microphone;
mod view;

use marker::{MarkedHost, OutputMarker, UnfinishedOpen};
use microphone::reads_it;
pub use view::{MicrophoneView, OutputView};

use crate::{
    command::SoundCommand,
    open_project::OpenProject,
    view::{About, Level},
};
use eddy_audio::{
    DeviceState, OutputState, Scene, Source, Spectrum, Timeline, Track, host::AudioHost, microphone::Microphone,
    player::Player,
};
use eddy_media::ChannelSound;
use std::{
    path::Path,
    sync::Arc,
    time::{Duration, Instant},
};

/// Speeds at which sound plays. At slower or faster speeds there is silence.
const SPEEDS: std::ops::RangeInclusive<f64> = 0.25..=4.0;

/// A device that has played for this long will not crash the program by being opened.
const SETTLES: Duration = Duration::from_secs(1);

pub(crate) struct Audio {
    host: Option<Arc<dyn AudioHost>>,
    on_thread: bool,
    output: Option<String>,
    input: Option<String>,
    player: Option<Player>,
    microphone: Option<Microphone>,
    /// The music of the program that draws, and of one that is about to.
    sounds: Vec<ChannelSound>,
    coming: Option<Vec<ChannelSound>>,
    /// The sound pass with its revision.
    track: Option<(u64, Arc<Track>)>,
    scene: Arc<Scene>,
    /// The state that was sent to the player last.
    sent: Option<(Arc<Scene>, Option<Timeline>, f32)>,
    volume: f32,
    is_muted: bool,
    is_hidden: bool,
    /// The user has enabled the microphone.
    uses_microphone: bool,
    /// The project reads the microphone.
    reads_microphone: bool,
    is_recording: bool,
    /// The spectrum that the newest frame read.
    spectrum: Option<Arc<Spectrum>>,
    /// A missing output device was reported.
    output_is_missing: bool,
    input_is_missing: bool,
    /// Marks for the next start that a device is being opened.
    marker: OutputMarker,
    /// The device whose driver crashed the previous run. It is opened only when the user requests it.
    ended_before: Option<UnfinishedOpen>,
    is_end_told: bool,
    /// The time at which the output was opened.
    open_since: Option<Instant>,
}

impl Audio {
    pub(crate) fn apply(&mut self, open: &mut OpenProject, command: SoundCommand) {
        match command {
            SoundCommand::SetVolume(volume) => self.set_volume(volume),
            SoundCommand::SetMute(on) => self.set_mute(on),
            SoundCommand::OpenSoundAgain => self.open_sound_again(open),
            SoundCommand::SetAudioOutput(device) => self.choose_output(device),
            SoundCommand::SetAudioInput(device) => self.choose_input(device),
            SoundCommand::ListAudioDevices => self.list_devices(&open.host.wake),
            SoundCommand::UseMicrophone(on) => self.use_microphone(open, on),
        }
    }

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

    /// Stops all sound of the previous project and turns the microphone off: the user enabled it for that project only.
    pub(crate) fn close_project(&mut self) {
        // The next project reports it again.
        self.is_end_told = false;
        (self.uses_microphone, self.input_is_missing) = (false, false);
        if std::mem::take(&mut self.is_recording)
            && let Some(microphone) = &mut self.microphone
        {
            microphone.switch(false);
        }
        (self.sounds, self.coming, self.track, self.spectrum) = (Vec::new(), None, None, None);
    }

    /// Sets the music of a program that was built and does not draw yet.
    pub(crate) fn expect(&mut self, sounds: Vec<ChannelSound>) {
        self.coming = Some(sounds);
    }

    /// Switches to that music: the new program draws from now on.
    pub(crate) fn on_program_installed(&mut self) {
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

    /// Opens the sound device that crashed the previous run again, or another one that the user has chosen.
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

    /// Returns the player, creating it if necessary and if the machine has sound. This does not open a device.
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

    /// The gain of every sample. Loudness is perceived as a ratio: the middle of the slider is a quarter, -12 dB.
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

    /// Sends the player its sources, timeline and gain if they have changed.
    fn play(&mut self, line: Option<Timeline>, wake: &Arc<dyn Fn() + Send + Sync>, now: Instant) {
        let scene = Scene { sources: self.sources() };
        if !scene.is(&self.scene) {
            self.scene = Arc::new(scene);
        }
        let line = line.filter(|line| SPEEDS.contains(&line.speed) && !self.is_hidden);
        let desired = OutputState { scene: self.scene.clone(), line, gain: self.gain() };
        // No device is opened for a project without sound.
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
            // It is closed, or its thread is opening it.
            DeviceState::Closed | DeviceState::Missing(_) => self.open_since = None,
        }
        self.sent = Some(wanted);
    }
}

/// A change of a device's state to report.
enum News {
    /// The device could not be opened, or was disconnected.
    Missing(String),
    /// A missing device is open again.
    Back(String),
    /// The missing device is no longer needed.
    Over,
}

/// Compares the state of a device with what was reported about it.
fn news(state: DeviceState, is_missing: &mut bool) -> Option<News> {
    match state {
        DeviceState::Missing(why) if !std::mem::replace(is_missing, true) => Some(News::Missing(why)),
        DeviceState::Open { name, .. } if std::mem::take(is_missing) => Some(News::Back(name)),
        DeviceState::Closed if *is_missing => Some(News::Over),
        _ => None,
    }
}

impl Drop for Audio {
    /// A regular exit: removes the marker.
    fn drop(&mut self) {
        self.marker.clear();
    }
}

impl Audio {
    /// Sets the sound pass as far as it is rendered, with its revision; `None` removes it. Playback moves from one
    /// revision to the next without a gap.
    pub(crate) fn play_track(&mut self, track: Option<(u64, Arc<Track>)>) {
        self.track = track;
    }

    /// Synchronises sound with the picture, at the end of a tick.
    pub(crate) fn play_sound(&mut self, open: &mut OpenProject) {
        let is_drawn = open.engine.has_program() && !open.halt.is_halted() && !open.halt.is_device_gone();
        let line = open.playback.line().filter(|_| is_drawn);
        self.play(line, &open.host.wake, open.host.now);
        self.report_crash_of_output(open);
        let Some(player) = &self.player else { return };
        match news(player.state(), &mut self.output_is_missing) {
            Some(News::Missing(why)) => {
                let text = format!("no sound: {why}. The picture goes on; Eddy looks for a device every 3 seconds");
                open.notice_about(About::Sound, Level::Warning, text);
            }
            Some(News::Back(name)) => {
                open.dismiss_notices(About::Sound);
                open.notice_about(About::Sound, Level::Info, format!("sound plays on {name}"));
            }
            Some(News::Over) => open.dismiss_notices(About::Sound),
            None => {}
        }
    }

    /// Reports that sound is off because a sound driver crashed the previous run.
    fn report_crash_of_output(&mut self, open: &mut OpenProject) {
        let Some(before) = self.ended_before.clone().filter(|_| self.has_sound()) else { return };
        if std::mem::replace(&mut self.is_end_told, true) {
            return;
        }
        let device = before.map_or("the default sound device".to_owned(), |name| format!("the sound device {name}"));
        let text = format!(
            "Eddy ended while it opened {device} the last time, so nothing is heard. Click the speaker below the picture to open it \
             again, or choose another device in Settings"
        );
        open.notice_about(About::Sound, Level::Warning, text);
    }

    pub(crate) fn open_sound_again(&mut self, open: &mut OpenProject) {
        self.open_again();
        open.dismiss_notices(About::Sound);
    }

    pub(crate) fn hide(&mut self, open: &mut OpenProject, is_hidden: bool) {
        if std::mem::replace(&mut self.is_hidden, is_hidden) && !is_hidden {
            // Nothing was drawn meanwhile: time continues from where it was.
            open.playback.rebase();
        }
        self.play_sound(open);
    }
}
