//! Measures what a frame costs, fairly: methods take turns, so that what else the machine does falls on all of them
//! alike; the median of at least seven turns counts, with the least and the most; and a pass that only copies, and one
//! that draws a single texel, take part as the roofline and the floor.
//!
//! A device that is no processor gives timestamps, and a frame costs the sum of its passes' times. A processor that
//! draws has only one clock, the wall's: a turn draws a batch of frames without waiting, then waits for the queue, and
//! a frame costs the time of that divided by the frames.

use super::{LabError, Rig, Running, Setup};
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// Fewest turns of a method.
pub const MIN_REPEATS: u32 = 7;

/// Most frames of a turn.
const MAX_BATCH: u32 = 512;

/// Passes that a frame of the floor's projects draws, so that what a frame costs beside its passes is not taken for
/// theirs.
const FLOOR_STEPS: u32 = 16;

/// Bytes a texel that the copying pass moves: it reads and writes rgba32f.
const COPY_BYTES: f64 = 32.0;

/// A copying pass that takes fewer times what a pass of one texel takes is busy with being a pass, and not with texels.
const COPY_OVER_EMPTY: f64 = 4.0;

/// Says how a time was taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Clock {
    Timestamps,
    Wall,
}

impl Clock {
    fn of(rig: &Rig) -> Clock {
        if rig.gpu().has_timestamps && !rig.gpu().is_cpu() { Clock::Timestamps } else { Clock::Wall }
    }
}

/// Times of one method, in milliseconds a frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Times {
    pub median: f64,
    pub min: f64,
    pub max: f64,
}

impl Times {
    /// Each times a factor.
    #[must_use]
    pub fn by(self, factor: f64) -> Times {
        Times { median: self.median * factor, min: self.min * factor, max: self.max * factor }
    }

    /// # Panics
    /// If there are none.
    fn of(mut samples: Vec<f64>) -> Times {
        samples.sort_by(f64::total_cmp);
        let (first, last) = (samples[0], samples[samples.len() - 1]);
        let middle = samples.len() / 2;
        let median = if samples.len().is_multiple_of(2) {
            (samples[middle - 1] + samples[middle]) / 2.0
        } else {
            samples[middle]
        };
        Times { median, min: first, max: last }
    }
}

/// Holds what a frame of a method costs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cost {
    pub frame: Times,
    /// The times of one copying pass and of one that draws a single texel, in the same turns.
    pub copy: Times,
    pub empty: Times,
    /// Fewest bytes a frame moves for a texel of the study's grid, by its plan.
    pub bytes_per_texel: f64,
    /// Texels a frame draws, for one of the study's grid.
    pub texels_per_texel: f64,
    pub canvas_texels: f64,
    pub repeats: u32,
    /// Frames of a turn.
    pub batch: u32,
    pub clock: Clock,
}

impl Cost {
    /// Millions of texels drawn in a second.
    pub fn megatexels_per_second(&self) -> f64 {
        self.canvas_texels * self.texels_per_texel / self.frame.median / 1e3
    }

    /// Returns the bytes a second over those of the copying pass. `None` on a grid so small that the copying pass takes
    /// hardly longer than one of a single texel: how fast it copies is no limit then.
    pub fn roofline(&self) -> Option<f64> {
        let is_of_texels = self.copy.median >= COPY_OVER_EMPTY * self.empty.median;
        is_of_texels.then(|| (self.bytes_per_texel / self.frame.median) / (COPY_BYTES / self.copy.median))
    }
}

/// Says how carefully to measure.
#[derive(Clone, Copy, Debug)]
pub struct MeasureSettings {
    /// At least [`MIN_REPEATS`].
    pub repeats: u32,
    /// Milliseconds that a turn shall take at least.
    pub turn_millis: f64,
}

/// Measures setups against each other. `size` is that of the studied grid, by whose texels costs are told; a setup's
/// canvas may be larger, as that of a preset which solves on a coarser grid than it paints. `turned` gets the turns that
/// each has had, how many there are, and the costs by these: none before the first.
pub fn interleaved(
    rig: &Rig,
    setups: &[Setup],
    size: (u32, u32),
    care: MeasureSettings,
    mut turned: impl FnMut(u32, u32, &[Cost]) -> Result<(), LabError>,
) -> Result<Vec<Cost>, LabError> {
    let clock = Clock::of(rig);
    let floor = ["copy", "empty"].map(|name| Setup::new("floor", size).wants(&[name]).steps(name, FLOOR_STEPS));
    let mut turns = Vec::new();
    for setup in floor.iter().chain(setups) {
        turns.push(TimedBatch::begin(rig, setup, care.turn_millis, clock)?);
    }
    let repeats = care.repeats.max(MIN_REPEATS);
    let mut costs = Vec::new();
    for done in 1..=repeats {
        turned(done - 1, repeats, &costs)?;
        for turn in &mut turns {
            let millis = turn.take(clock)?;
            turn.samples.push(millis);
        }
        costs = so_far(&mut turns, floor.len(), size, clock);
    }
    Ok(costs)
}

/// The costs by the turns that there have been. The first `floor` are the copying pass and the one of a texel.
fn so_far(turns: &mut [TimedBatch], floor: usize, size: (u32, u32), clock: Clock) -> Vec<Cost> {
    let times: Vec<Times> = turns.iter().map(|t| Times::of(t.samples.clone())).collect();
    let canvas_texels = f64::from(size.0) * f64::from(size.1);
    let cost = |(turn, frame): (&mut TimedBatch, &Times)| {
        let traffic = turn.running.engine().traffic();
        Cost {
            frame: *frame,
            copy: times[0].by(1.0 / f64::from(FLOOR_STEPS)),
            empty: times[1].by(1.0 / f64::from(FLOOR_STEPS)),
            bytes_per_texel: traffic.bytes as f64 / canvas_texels,
            texels_per_texel: traffic.texels as f64 / canvas_texels,
            canvas_texels,
            repeats: turn.samples.len() as u32,
            batch: turn.batch,
            clock,
        }
    };
    turns.iter_mut().zip(&times).skip(floor).map(cost).collect()
}

/// Milliseconds a frame of one setup by itself, in a single turn: what it will cost about, long before all have taken
/// turns.
pub fn estimate(rig: &Rig, setup: &Setup, turn_millis: f64) -> Result<f64, LabError> {
    let clock = Clock::of(rig);
    TimedBatch::begin(rig, setup, turn_millis, clock)?.take(clock)
}

struct TimedBatch {
    running: Running,
    batch: u32,
    samples: Vec<f64>,
}

impl TimedBatch {
    /// Opens a setup and warms it up.
    fn begin(rig: &Rig, setup: &Setup, turn_millis: f64, clock: Clock) -> Result<TimedBatch, LabError> {
        let mut running = rig.open(setup)?;
        if clock == Clock::Timestamps {
            running.engine().set_timing(true);
        }
        let batch = warm_up(&mut running, turn_millis)?;
        Ok(TimedBatch { running, batch, samples: Vec::new() })
    }

    /// Milliseconds a frame.
    fn take(&mut self, clock: Clock) -> Result<f64, LabError> {
        match clock {
            Clock::Wall => Ok(batch_millis(&mut self.running, self.batch)? / f64::from(self.batch)),
            Clock::Timestamps => {
                let (mut sum, mut timed) = (0.0, 0);
                for _ in 0..self.batch {
                    self.running.draw()?;
                    self.running.engine().gpu().wait()?;
                    if let Some(passes) = self.running.engine().pass_times() {
                        sum += passes.iter().map(|p| p.gpu_millis).sum::<f64>();
                        timed += 1;
                    }
                }
                Ok(sum / f64::from(timed.max(1)))
            }
        }
    }
}

/// Milliseconds of a batch of frames, from the first call to the empty queue.
fn batch_millis(running: &mut Running, frames: u32) -> Result<f64, LabError> {
    let began = Instant::now();
    for _ in 0..frames {
        running.draw()?;
    }
    running.engine().gpu().wait()?;
    Ok(began.elapsed().as_secs_f64() * 1e3)
}

/// Draws until the driver has compiled and a batch takes long enough; gives the frames of one.
fn warm_up(running: &mut Running, turn_millis: f64) -> Result<u32, LabError> {
    batch_millis(running, 2)?;
    let mut batch = 1;
    loop {
        let millis = batch_millis(running, batch)?;
        if millis >= turn_millis || batch >= MAX_BATCH {
            return Ok(batch);
        }
        let wanted = f64::from(batch) * (turn_millis / millis.max(1e-3)) * 1.1;
        batch = (wanted.ceil() as u32).clamp(batch + 1, batch * 8).min(MAX_BATCH);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_middle_and_an_outlier_is_only_the_most() {
        let times = Times::of(vec![3.0, 1.0, 2.0, 100.0, 2.5]);
        assert_eq!((times.min, times.median, times.max), (1.0, 2.5, 100.0));
        assert_eq!(Times::of(vec![1.0, 3.0]).median, 2.0);
    }

    #[test]
    fn the_copying_pass_reaches_its_own_roofline() {
        let times = Times { median: 2.0, min: 1.0, max: 3.0 };
        let cost = Cost {
            frame: times,
            copy: times,
            empty: times.by(0.1),
            bytes_per_texel: COPY_BYTES,
            texels_per_texel: 1.0,
            canvas_texels: 1e6,
            repeats: 7,
            batch: 1,
            clock: Clock::Wall,
        };
        assert_eq!((cost.roofline(), cost.megatexels_per_second()), (Some(1.0), 500.0));
        let slow = Cost { frame: Times { median: 4.0, ..times }, ..cost };
        assert_eq!(slow.roofline(), Some(0.5));
    }
}
