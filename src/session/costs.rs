//! The costs of each pass are gathered while somebody looks.

use eddy_engine::{CostClock, PassCost, PassTime};
use std::collections::VecDeque;

/// Frames whose median counts: half a second at 60 a second.
const FRAMES: usize = 30;

/// A pass, and how long it takes.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedPass {
    pub cost: PassCost,
    /// Median of the newest frames in which it was drawn; `None` before the first.
    pub millis: Option<f64>,
}

/// All passes of the open project.
#[derive(Clone, Debug, PartialEq)]
pub struct PassCosts {
    /// In drawing order; then those that are not drawn.
    pub passes: Vec<TimedPass>,
    pub clock: CostClock,
}

/// Times of the newest frames.
#[derive(Default)]
pub(super) struct Costs {
    newest: Vec<PassTime>,
    is_watched: bool,
    frames: VecDeque<Vec<PassTime>>,
}

impl Costs {
    /// Returns the times of the newest frame that the device has finished.
    pub(crate) fn newest(&self) -> &[PassTime] {
        &self.newest
    }

    /// Nothing is measured yet.
    pub(crate) fn watched(is_watched: bool) -> Self {
        Self { is_watched, ..Self::default() }
    }

    /// Another program, or another project: what was measured is no longer of it.
    pub(crate) fn forget(&mut self) {
        self.newest.clear();
        self.frames.clear();
    }

    pub(crate) fn watch(&mut self, on: bool) {
        if self.is_watched != on {
            self.is_watched = on;
            self.frames.clear();
            // While paused no other frame comes.
            self.frames.extend((on && !self.newest.is_empty()).then(|| self.newest.clone()));
        }
    }

    /// Somebody looks at them.
    pub(crate) fn is_watched(&self) -> bool {
        self.is_watched
    }

    /// Adds the times of a frame, by a clock.
    pub(crate) fn add(&mut self, times: Vec<PassTime>, clock: CostClock) {
        if self.is_watched {
            self.frames.truncate(FRAMES - 1);
            self.frames.push_front(times.clone());
        }
        // Waited for, the passes are no measure of a frame.
        self.newest = if clock == CostClock::Timestamps { times } else { Vec::new() };
    }

    /// Each pass with its median.
    pub(crate) fn of(&self, passes: Vec<PassCost>, clock: CostClock) -> PassCosts {
        let timed = |cost: PassCost| TimedPass { millis: self.median(&cost), cost };
        PassCosts { passes: passes.into_iter().map(timed).collect(), clock }
    }

    fn median(&self, cost: &PassCost) -> Option<f64> {
        let of_frame = |times: &Vec<PassTime>| times.iter().find(|t| t.pass == cost.pass).map(|t| t.gpu_millis);
        // A pass that rested took nothing in that frame.
        let mut all: Vec<f64> = self.frames.iter().filter_map(of_frame).filter(|millis| *millis > 0.0).collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() / 2).copied()
    }
}
