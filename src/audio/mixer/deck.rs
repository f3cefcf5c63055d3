//! A scene that plays at a position and is faded in or out.

use crate::{
    kernel::Kernel,
    scene::{MOST_SOURCES, Scene, Source},
};
use std::sync::Arc;

pub(super) struct Deck {
    pub scene: Arc<Scene>,
    /// The position in samples of the sources.
    pub position: f64,
    pub gain: f32,
    /// The target gain: 0 or 1.
    pub target: f32,
    /// A gain per source, which depends on whether it is available around the position.
    presence: [f32; MOST_SOURCES],
}

impl Deck {
    pub(super) fn new(scene: Arc<Scene>, position: f64, ratio: f64) -> Self {
        let mut deck = Self { scene, position, gain: 0.0, target: 1.0, presence: [0.0; MOST_SOURCES] };
        for n in 0..deck.scene.sources.len().min(MOST_SOURCES) {
            deck.presence[n] = if deck.is_made(n, ratio, 0.0) { 1.0 } else { 0.0 };
        }
        deck
    }

    /// Returns whether it has faded out.
    pub(super) fn is_over(&self) -> bool {
        self.target == 0.0 && self.gain == 0.0
    }

    /// Returns whether a source is available around the position, and for `ahead` samples of the device after it.
    fn is_made(&self, source: usize, ratio: f64, ahead: f64) -> bool {
        let Source::Track(track) = &self.scene.sources[source] else { return true };
        let (at, reach) = (self.position.floor() as i64, Kernel::reach(ratio));
        track.frame(at - reach).is_some() && track.frame(at + reach + (ahead * ratio).ceil() as i64).is_some()
    }

    /// Returns the next frame, `ratio` samples of the sources after the last one. `fade` is the change of gains per
    /// frame.
    pub(super) fn next(&mut self, kernel: &Kernel, ratio: f64, fade: f32) -> [f32; 2] {
        self.gain += (self.target - self.gain).clamp(-fade, fade);
        let mut sum = [0.0; 2];
        if self.gain > 0.0 {
            for n in 0..self.scene.sources.len().min(MOST_SOURCES) {
                // Fade out before an unavailable part starts, and fade in only after it.
                let target = if self.is_made(n, ratio, 1.0 + f64::from(fade).recip()) { 1.0 } else { 0.0 };
                self.presence[n] += (target - self.presence[n]).clamp(-fade, fade);
                let gain = self.gain * self.presence[n];
                if gain > 0.0 {
                    let source = &self.scene.sources[n];
                    let [left, right] = kernel.read(self.position, ratio, |n| source.frame(n).unwrap_or_default());
                    sum[0] += gain * left;
                    sum[1] += gain * right;
                }
            }
        }
        self.position += ratio;
        sum
    }
}
