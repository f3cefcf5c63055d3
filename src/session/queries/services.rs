//! The state of a [`Session`]'s devices, films and analyses of texts, for front ends.

use crate::{ControlsView, FilmFacts, MicrophoneView, OutputView, Session, SoundView, TabAnalysis};
use eddy_audio::{Sound, Track};
use eddy_control::PickupSide;
use eddy_diag::SourceId;
use eddy_project::{ControlAddress, ControlTarget, Media, Tab};
use std::{ops::Range, sync::Arc};

impl Session {
    /// Returns the state of all controls.
    pub fn controls_view(&self) -> ControlsView {
        self.services.controls.controls_view()
    }

    /// Returns whether a target's control is being learned.
    pub fn is_learning(&self, target: &ControlTarget) -> bool {
        self.services.controls.is_learning(&self.open, target)
    }

    /// Returns the side of the value on which the target's knob waits for pickup; `None` if it does not wait.
    pub fn control_waits(&self, target: &ControlTarget) -> Option<PickupSide> {
        self.services.controls.control_waits(&self.open, target)
    }

    /// Sets the sound pass as far as it is rendered, with its revision; `None` removes it. Playback moves from one
    /// revision to the next without a gap.
    pub fn play_track(&mut self, track: Option<(u64, Arc<Track>)>) {
        self.services.audio.play_track(track)
    }

    /// Returns the state of the output; `None` if the front end has provided no audio host.
    pub fn output_view(&self) -> Option<OutputView> {
        self.services.audio.output_view()
    }

    /// Returns the state of the microphone; `None` if the front end has provided no audio host.
    pub fn microphone_view(&self) -> Option<MicrophoneView> {
        self.services.audio.microphone_view(&self.open)
    }

    /// Returns the names of the output devices and of the input devices, once
    /// [`SoundCommand::ListAudioDevices`](crate::SoundCommand::ListAudioDevices) was given and they are known.
    pub fn audio_devices(&self) -> (Option<Vec<String>>, Option<Vec<String>>) {
        self.services.audio.audio_devices()
    }

    /// The latency of the sound against the picture's time in seconds and the number of jumps to correct it, both since
    /// the device was opened; then the number of buffer underruns since the start.
    pub fn sound_health(&self) -> Option<(f64, u64, u64)> {
        self.services.audio.sound_health()
    }

    /// Returns how many sources are mixed.
    pub fn sources_heard(&self) -> usize {
        self.services.audio.sources_heard()
    }

    /// Returns the newest analysis of the front tab, which may be of an older text.
    pub fn analysis(&self) -> Option<&Arc<TabAnalysis>> {
        self.services.analyst.analysis()
    }

    /// Returns the line, from 0, at which a breakpoint in a line of a tab stops: its own, or the next one with a
    /// statement. `None` if no statement follows. Parses the text again, which takes about a millisecond for a thousand
    /// lines.
    pub fn stop_line(&self, tab: &Tab, line: usize) -> Option<usize> {
        self.services.analyst.stop_line(&self.open, tab, line)
    }

    /// Removes the recovery file: the unsaved work is discarded on purpose, or stored elsewhere.
    pub fn forget_unsaved(&self) {
        self.services.recovery.forget_unsaved()
    }

    /// Returns the track of the sound pass and its revision, which grows with each new track; `None` if there is no
    /// sound pass that compiles. Blocks of the track may still be missing.
    pub fn sound_track(&self) -> Option<(u64, Arc<Track>)> {
        self.services.sound_pass.sound_track()
    }

    /// Returns the state of the sound pass; `None` if the project has none.
    pub fn sound(&self) -> Option<SoundView> {
        self.services.sound_pass.sound(&self.open)
    }

    /// Returns why the sound cannot be saved yet; `None` if it can.
    pub fn sound_unsaved(&self) -> Option<&'static str> {
        self.services.sound_pass.sound_unsaved()
    }

    /// Returns the control that moves a component of a uniform.
    pub fn control_of(&self, target: &ControlTarget) -> Option<&ControlAddress> {
        self.project().controls.get(&self.open.as_in_texts(target))
    }

    /// Returns the music of a channel, as loaded for the program that draws.
    pub fn music(&self, media: &Media) -> Option<&Arc<Sound>> {
        self.services.audio.music().iter().find(|known| known.media == *media).map(|known| &known.sound)
    }

    /// Returns whether the window closes when the film is complete.
    pub fn closes_after_film(&self) -> bool {
        self.services.films.closes()
    }

    /// Returns the facts that a film's form is validated against.
    pub fn film_facts(&self) -> FilmFacts {
        self.services.films.facts(&self.open, self.gpu())
    }

    /// Returns whether the encoders of ffmpeg are being queried.
    pub fn looks_for_encoders(&self) -> bool {
        self.services.films.looks_for_encoders()
    }

    /// Every place in the project that names the symbol at a place of `of`. A symbol that is declared in a text shared
    /// by several passes is searched for in every pass, which takes about a millisecond for a thousand lines.
    pub fn uses(&self, of: &TabAnalysis, source: SourceId, offset: usize) -> Vec<(Tab, Range<usize>)> {
        self.open.uses(of, source, offset)
    }
}
