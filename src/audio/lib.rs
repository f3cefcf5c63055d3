//! Sound: files decoded to stereo at 44.1 kHz, the analyser that makes a channel's texture of them, tracks that sound
//! passes fill, the files that these are written to, and what is heard and recorded.
//!
//! Bytes come in, and time is a number of samples. Browsers smooth a spectrum once for each frame that asks for it; here
//! the frames before are those that lie a frame's step apart, so that a frame does not depend on how it was reached.
//!
//! [`mixer`] mixes what is heard; it knows no device and is told what time it is. Only [`player`] and
//! [`microphone`] open devices, on threads of their own, through the traits of [`host`]; `device` has those of the machine
//! and [`fake`] those of a test.

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
pub mod mixer;
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
pub use peaks::{Peak, Peaks};
pub use scene::{MOST_SOURCES, OutputState, Resampler, Scene, Source, Timeline};
pub use spectrum::TrackSpectrum;
pub use synthetic::synthetic;
pub use track::Track;
pub use wav::wav;

/// Samples a second of everything behind the decoder; `iSampleRate`.
pub const SAMPLE_RATE: u32 = 44_100;

/// A decoded file: stereo frames at [`SAMPLE_RATE`], in -1 to 1 unless the file goes beyond.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sound {
    pub frames: Vec<[f32; 2]>,
    /// The file is longer than [`Limits::seconds`], and the rest was left out.
    pub truncated: bool,
}

impl Sound {
    /// Length in seconds.
    pub fn seconds(&self) -> f64 {
        self.frames.len() as f64 / f64::from(SAMPLE_RATE)
    }

    /// Returns the largest sample of each of so many stretches of the same length, from 0 to 1, of both channels.
    pub fn outline(&self, stretches: usize) -> Vec<f32> {
        let count = self.frames.len();
        // Of a long file every so many samples are looked at: an outline shows no more.
        let stride = (count / stretches.max(1) / 512).max(1);
        let stretch = |n: usize| {
            let frames = &self.frames[n * count / stretches..(n + 1) * count / stretches];
            frames.iter().step_by(stride).fold(0.0, |most: f32, [l, r]| most.max(l.abs()).max(r.abs())).min(1.0)
        };
        (0..stretches).map(stretch).collect()
    }

    /// The mono sample `n` of the sound played in a loop from sample 0 on; silence before.
    pub fn looped(&self, n: i64) -> f32 {
        if n < 0 || self.frames.is_empty() {
            return 0.0;
        }
        let [left, right] = self.frames[(n % self.frames.len() as i64) as usize];
        0.5 * (left + right)
    }
}
