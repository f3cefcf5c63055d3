//! The panel of the sound pass: its waveform with the current time, and the spectrum at that time.
//!
//! Owns the visible range of the waveform. Plays nothing, and sends seeks to the session.

mod panel;
mod range;
mod wave;

pub(super) use panel::PANEL;

use crate::{
    audio::{Peaks, TrackSpectrum},
    session::SoundView,
};
use range::VisibleRange;

/// The state of the panel.
#[derive(Default)]
pub(super) struct Sound {
    /// The outline of the newest track.
    peaks: Option<Peaks>,
    spectrum: TrackSpectrum,
    shown: VisibleRange,
}

impl Sound {
    /// Applies the parts of the track that were made since the last call.
    fn outline(&mut self, view: &SoundView) -> Option<&Peaks> {
        let track = view.track.as_ref()?;
        match &mut self.peaks {
            Some(peaks) if std::sync::Arc::ptr_eq(peaks.track(), track) => {
                peaks.update();
            }
            other => *other = Some(Peaks::new(track.clone())),
        }
        self.peaks.as_ref()
    }
}
