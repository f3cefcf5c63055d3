//! The state of sound and microphone as front ends show it.

use super::{Audio, DeviceState, Source};
use crate::open_project::OpenProject;

/// The state of the sound output.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputView {
    /// From 0 to 1.
    pub volume: f32,
    pub is_muted: bool,
    /// The project has sound.
    pub has_sound: bool,
    pub device: DeviceState,
    /// The device stays closed because the previous run crashed while opening it. See
    /// [`SoundCommand::OpenSoundAgain`](crate::SoundCommand::OpenSoundAgain).
    pub ended_before: bool,
}

/// The state of the microphone.
#[derive(Clone, Debug, PartialEq)]
pub struct MicrophoneView {
    /// The user has enabled it and a channel reads it.
    pub is_on: bool,
    /// A channel of the project reads it.
    pub is_read: bool,
    pub device: DeviceState,
    /// The largest sample of the last 50 ms, from 0 to 1.
    pub level: f32,
}

impl Audio {
    pub(super) fn has_sound(&self) -> bool {
        !self.sounds.is_empty() || self.track.is_some()
    }
}

impl Audio {
    /// Returns the state of the output; `None` if the front end has provided no audio host.
    pub(crate) fn output_view(&self) -> Option<OutputView> {
        let audio = &self;
        audio.host.as_ref()?;
        Some(OutputView {
            volume: audio.volume,
            is_muted: audio.is_muted,
            has_sound: audio.has_sound(),
            device: audio.player.as_ref().map_or(DeviceState::Closed, |player| player.state()),
            ended_before: audio.ended_before.is_some(),
        })
    }

    /// Returns the state of the microphone; `None` if the front end has provided no audio host.
    pub(crate) fn microphone_view(&self, open: &OpenProject) -> Option<MicrophoneView> {
        let audio = &self;
        audio.host.as_ref()?;
        let is_read = open.project().passes.iter().any(super::reads_it);
        Some(MicrophoneView {
            is_on: audio.uses_microphone && is_read,
            is_read,
            device: audio.microphone.as_ref().map_or(DeviceState::Closed, |microphone| microphone.state()),
            level: audio.microphone.as_ref().map_or(0.0, |microphone| microphone.level()),
        })
    }

    /// Returns the names of the output devices and of the input devices, once
    /// [`SoundCommand::ListAudioDevices`](crate::SoundCommand::ListAudioDevices) was given and they are known.
    pub(crate) fn audio_devices(&self) -> (Option<Vec<String>>, Option<Vec<String>>) {
        let audio = &self;
        (audio.player.as_ref().and_then(|player| player.names()), audio.microphone.as_ref().and_then(|m| m.names()))
    }

    /// The latency of the sound against the picture's time in seconds and the number of jumps to correct it, both since
    /// the device was opened; then the number of buffer underruns since the start.
    pub(crate) fn sound_health(&self) -> Option<(f64, u64, u64)> {
        let player = self.player.as_ref()?;
        let mixed = player.mixed()?;
        Some((mixed.behind_secs(), mixed.jumps(), player.underruns()))
    }

    /// Returns how many sources are mixed.
    pub(crate) fn sources_heard(&self) -> usize {
        self.scene.sources.iter().filter(|source| matches!(source, Source::Loop(_) | Source::Track(_))).count()
    }
}
