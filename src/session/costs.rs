//! The cost of each pass, gathered while a view shows it.

use eddy_engine::{CostClock, PassCost, PassTime};
use std::collections::VecDeque;

/// The median is over this many frames: half a second at 60 per second.
const FRAMES: usize = 30;

/// A pass and its time.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedPass {
    pub cost: PassCost,
    /// Median of the newest frames in which it was drawn; `None` before the first.
    pub millis: Option<f64>,
}

/// The costs of all passes of the open project.
#[derive(Clone, Debug, PartialEq)]
pub struct PassCosts {
    /// In drawing order, followed by passes that are not drawn.
    pub passes: Vec<TimedPass>,
    pub clock: CostClock,
}

/// The times of the newest frames.
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

    /// Starts with no measurements.
    pub(crate) fn watched(is_watched: bool) -> Self {
        Self { is_watched, ..Self::default() }
    }

    /// Clears the measurements, which are of another program or project.
    pub(crate) fn forget(&mut self) {
        self.newest.clear();
        self.frames.clear();
    }

    pub(crate) fn watch(&mut self, on: bool) {
        if self.is_watched != on {
            self.is_watched = on;
            self.frames.clear();
            // While paused no other frame follows.
            self.frames.extend((on && !self.newest.is_empty()).then(|| self.newest.clone()));
        }
    }

    /// Returns whether a view shows the costs.
    pub(crate) fn is_watched(&self) -> bool {
        self.is_watched
    }

    /// Adds the times of a frame, measured by a clock.
    pub(crate) fn add(&mut self, times: Vec<PassTime>, clock: CostClock) {
        if self.is_watched {
            self.frames.truncate(FRAMES - 1);
            self.frames.push_front(times.clone());
        }
        // If each pass is waited for, their times do not add up to a frame.
        self.newest = if clock == CostClock::Timestamps { times } else { Vec::new() };
    }

    /// Returns each pass with its median.
    pub(crate) fn of(&self, passes: Vec<PassCost>, clock: CostClock) -> PassCosts {
        let timed = |cost: PassCost| TimedPass { millis: self.median(&cost), cost };
        PassCosts { passes: passes.into_iter().map(timed).collect(), clock }
    }

    fn median(&self, cost: &PassCost) -> Option<f64> {
        let of_frame = |times: &Vec<PassTime>| times.iter().find(|t| t.pass == cost.pass).map(|t| t.gpu_millis);
        // A skipped pass took no time in that frame.
        let mut all: Vec<f64> = self.frames.iter().filter_map(of_frame).filter(|millis| *millis > 0.0).collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() / 2).copied()
    }
}
