//! Sound: files decoded to stereo at 44.1 kHz, the analyser that turns them into a channel's texture, tracks filled by
//! sound passes, writers of sound files, playback and recording.
//!
//! Input is bytes, and time is a number of samples. Browsers smooth a spectrum once for each frame that requests it;
//! here the previous frames are taken at fixed steps, so that a frame does not depend on how it was reached.
//!
//! `mixer` mixes the output; it knows no device and is passed the time. Only [`player`] and [`microphone`] open
//! devices, on threads of their own, through the traits of [`host`]; `device` implements those for the machine and
//! [`fake`] for tests.

#![warn(missing_docs)]

mod analyser;
mod decode;
#[cfg(feature = "device")]
pub mod device;
pub mod fake;
mod flac;
pub mod host;
mod keeper;
mod kernel;
pub mod microphone;
mod mixer;
mod peaks;
pub mod player;
mod scene;
mod spectrum;
mod synthetic;
mod track;
mod wav;

pub use analyser::{Analyser, BINS, Spectrum};
pub use decode::{AudioError, Limits, decode};
pub use flac::flac;
pub use keeper::DeviceState;
pub use mixer::MixerState;
pub use peaks::{Peak, Peaks};
pub use scene::{MOST_SOURCES, OutputState, Resampler, Scene, Source, Timeline};
pub use spectrum::TrackSpectrum;
pub use synthetic::synthetic;
pub use track::Track;
pub use wav::wav;

/// Samples per second of all decoded sound; `iSampleRate`.
pub const SAMPLE_RATE: u32 = 44_100;

/// A decoded file: stereo frames at [`SAMPLE_RATE`], in -1 to 1 unless the file exceeds that.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sound {
    /// Left and right of each frame.
    pub frames: Vec<[f32; 2]>,
    /// The file is longer than [`Limits::seconds`], and the rest was dropped.
    pub truncated: bool,
}

impl Sound {
    /// Returns the length in seconds.
    pub fn seconds(&self) -> f64 {
        self.frames.len() as f64 / f64::from(SAMPLE_RATE)
    }

    /// Returns the largest sample, from 0 to 1, of both channels in each of `stretches` intervals of equal length.
    pub fn outline(&self, stretches: usize) -> Vec<f32> {
        let count = self.frames.len();
        // In a long file only every `stride`-th sample is read: an outline shows no more.
        let stride = (count / stretches.max(1) / 512).max(1);
        let stretch = |n: usize| {
            let frames = &self.frames[n * count / stretches..(n + 1) * count / stretches];
            frames.iter().step_by(stride).fold(0.0, |most: f32, [l, r]| most.max(l.abs()).max(r.abs())).min(1.0)
        };
        (0..stretches).map(stretch).collect()
    }

    /// Returns the mono sample `n` of the sound played in a loop from sample 0; silence before.
    pub fn looped(&self, n: i64) -> f32 {
        if n < 0 || self.frames.is_empty() {
            return 0.0;
        }
        let [left, right] = self.frames[(n % self.frames.len() as i64) as usize];
        0.5 * (left + right)
    }
}
