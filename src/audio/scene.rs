//! The sources that are played, and their time.

use crate::{SAMPLE_RATE, Sound, Track, kernel::Kernel};
use std::{sync::Arc, time::Instant};

/// The maximum number of sources that are mixed: four channels of four passes.
pub const MOST_SOURCES: usize = 16;

/// A source that starts at time 0.
#[derive(Clone)]
pub enum Source {
    /// A file that is played in a loop.
    Loop(Arc<Sound>),
    /// The sound pass: played once, as far as it is drawn.
    Track(Arc<Track>),
}

impl Source {
    /// Returns frame `n`; `None` if it is not written yet.
    pub(crate) fn frame(&self, n: i64) -> Option<[f32; 2]> {
        match self {
            Source::Loop(sound) if n < 0 || sound.frames.is_empty() => Some([0.0; 2]),
            Source::Loop(sound) => Some(sound.frames[(n % sound.frames.len() as i64) as usize].map(finite)),
            Source::Track(track) => Some(track.frame(n)?.map(|sample| f32::from(sample) / 32_768.0)),
        }
    }

    /// Returns whether both play the same.
    pub fn is(&self, other: &Source) -> bool {
        match (self, other) {
            (Source::Loop(one), Source::Loop(other)) => Arc::ptr_eq(one, other),
            (Source::Track(one), Source::Track(other)) => Arc::ptr_eq(one, other),
            _ => false,
        }
    }
}

/// Makes a sample finite: a file of floats may contain any value.
fn finite(sample: f32) -> f32 {
    if sample.is_finite() { sample.clamp(-8.0, 8.0) } else { 0.0 }
}

/// Sources that are played together. The first [`MOST_SOURCES`] are mixed.
#[derive(Clone, Default)]
pub struct Scene {
    /// Each at full volume, and in time with the others.
    pub sources: Vec<Source>,
}

impl Scene {
    /// Returns whether both sound the same.
    pub fn is(&self, other: &Scene) -> bool {
        let pairs = self.sources.iter().zip(&other.sources);
        self.sources.len() == other.sources.len() && pairs.into_iter().all(|(one, other)| one.is(other))
    }
}

impl Scene {
    /// Mixes frames `from..to` at full volume, as a player does at speed 1: sums beyond full scale are clipped, and
    /// missing blocks are silent.
    pub fn mixed(&self, from: u64, to: u64) -> Vec<[i16; 2]> {
        let frame = |n: u64| {
            let mut sum = [0.0f32; 2];
            for source in self.sources.iter().take(MOST_SOURCES) {
                let frame = i64::try_from(n).ok().and_then(|n| source.frame(n)).unwrap_or_default();
                sum = [sum[0] + frame[0], sum[1] + frame[1]];
            }
            sum.map(|sample| (sample * 32_768.0).round() as i16)
        };
        (from..to).map(frame).collect()
    }
}

/// Reads scenes between their samples and at other speeds.
#[derive(Default)]
pub struct Resampler(Kernel);

impl Resampler {
    /// Returns the number of samples needed before and after a read range, at a speed.
    pub fn reach(speed: f64) -> i64 {
        Kernel::reach(speed) + 1
    }

    /// Reads `count` frames at full volume, the first one at `position` and each `speed` samples after the previous
    /// one. Full scale is 1, which sums may exceed. Missing blocks are silent.
    pub fn read(&self, scene: &Scene, position: f64, speed: f64, count: usize) -> Vec<[f32; 2]> {
        let frame = |n: usize| {
            let mut sum = [0.0f32; 2];
            for source in scene.sources.iter().take(MOST_SOURCES) {
                let frame = |n| source.frame(n).unwrap_or_default();
                let frame = self.0.read(position + speed * n as f64, speed, frame);
                sum = [sum[0] + frame[0], sum[1] + frame[1]];
            }
            sum
        };
        (0..count).map(frame).collect()
    }
}

/// A time that runs at a constant speed: `secs` at the moment `at`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timeline {
    /// The moment at which `iTime` is `secs`.
    pub at: Instant,
    /// `iTime` at that moment, in seconds.
    pub secs: f64,
    /// Seconds of `iTime` per second, above 0.
    pub speed: f64,
}

impl Timeline {
    /// Returns `iTime` in seconds at a moment, which may also be before `at`.
    pub fn secs_at(&self, at: Instant) -> f64 {
        let since = at.saturating_duration_since(self.at).as_secs_f64();
        let before = self.at.saturating_duration_since(at).as_secs_f64();
        self.secs + self.speed * (since - before)
    }

    /// Returns the position in samples of [`SAMPLE_RATE`] at a moment.
    pub(crate) fn position_at(&self, at: Instant) -> f64 {
        self.secs_at(at) * f64::from(SAMPLE_RATE)
    }
}

/// The complete desired output of a device.
#[derive(Clone)]
pub struct OutputState {
    /// The sources to play.
    pub scene: Arc<Scene>,
    /// The course of time; `None` while paused.
    pub line: Option<Timeline>,
    /// The factor for each sample: 0 for mute, 1 for the files' own loudness.
    pub gain: f32,
}

impl Default for OutputState {
    fn default() -> Self {
        Self { scene: Arc::default(), line: None, gain: 1.0 }
    }
}

impl OutputState {
    /// Returns whether a device is needed for it.
    pub fn is_heard(&self) -> bool {
        self.line.is_some() && self.gain > 0.0 && !self.scene.sources.is_empty()
    }
}
