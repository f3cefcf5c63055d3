//! Fair measurement of the cost of a frame: methods take turns, so that other load on the machine affects all of them
//! equally; the median of at least seven turns is used, with the minimum and the maximum; and a pass that only copies,
//! and one that draws a single texel, are measured as the roofline and the floor.
//!
//! A GPU has timestamps, and the cost of a frame is the sum of its passes' times. A CPU that draws has only the wall
//! clock: a turn draws a batch of frames without waiting, then waits for the queue, and the cost of a frame is the
//! elapsed time divided by the number of frames.

use super::{LabError, Rig, Running, Setup};
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// The minimum number of turns per method.
pub const MIN_REPEATS: u32 = 7;

/// The maximum number of frames per turn.
const MAX_BATCH: u32 = 512;

/// The number of passes in a frame of the floor's projects, so that the cost of a frame apart from its passes is not
/// attributed to them.
const FLOOR_STEPS: u32 = 16;

/// The bytes per texel that the copying pass moves: it reads and writes rgba32f.
const COPY_BYTES: f64 = 32.0;

/// If the copying pass takes less than this many times the time of a pass of one texel, the overhead of the pass
/// dominates.
const COPY_OVER_EMPTY: f64 = 4.0;

/// The clock of a measurement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Clock {
    Timestamps,
    Wall,
}

impl Clock {
    fn of(rig: &Rig) -> Clock {
        if rig.gpu().has_timestamps && rig.gpu().rasteriser().has_exact_timestamps() {
            Clock::Timestamps
        } else {
            Clock::Wall
        }
    }
}

/// Times of one method, in milliseconds per frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Times {
    pub median: f64,
    pub min: f64,
    pub max: f64,
}

impl Times {
    /// Returns all times multiplied by a factor.
    #[must_use]
    pub fn by(self, factor: f64) -> Times {
        Times { median: self.median * factor, min: self.min * factor, max: self.max * factor }
    }

    /// # Panics
    /// If there are no samples.
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

/// The cost of a frame of a method.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cost {
    pub frame: Times,
    /// The times of one copying pass and of one that draws a single texel, in the same turns.
    pub copy: Times,
    pub empty: Times,
    /// The minimum number of bytes that a frame moves per texel of the study's grid, by its plan.
    pub bytes_per_texel: f64,
    /// The number of texels that a frame draws per texel of the study's grid.
    pub texels_per_texel: f64,
    pub canvas_texels: f64,
    pub repeats: u32,
    /// The number of frames per turn.
    pub batch: u32,
    pub clock: Clock,
}

impl Cost {
    /// Returns the millions of texels drawn per second.
    pub fn megatexels_per_second(&self) -> f64 {
        self.canvas_texels * self.texels_per_texel / self.frame.median / 1e3
    }

    /// Returns the bytes per second relative to those of the copying pass. `None` on a grid so small that the copying
    /// pass takes hardly longer than a pass of a single texel: its speed is then not a limit.
    pub fn roofline(&self) -> Option<f64> {
        let is_of_texels = self.copy.median >= COPY_OVER_EMPTY * self.empty.median;
        is_of_texels.then(|| (self.bytes_per_texel / self.frame.median) / (COPY_BYTES / self.copy.median))
    }
}

/// The accuracy of a measurement.
#[derive(Clone, Copy, Debug)]
pub struct MeasureSettings {
    /// At least [`MIN_REPEATS`].
    pub repeats: u32,
    /// The minimum duration of a turn in milliseconds.
    pub turn_millis: f64,
}

/// Measures setups against each other. `size` is that of the studied grid, whose texels costs refer to; a setup's
/// canvas may be larger, as for a preset that solves on a coarser grid than it paints. `turned` is called with the
/// number of turns that each has had, their total number, and the costs so far: none before the first.
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
        turns.push(TimedBatch::open(rig, setup, care.turn_millis, clock)?);
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

/// Returns the costs after the turns so far. The first `floor` setups are the copying pass and the one of a texel.
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

/// Returns the milliseconds per frame of a single setup, in a single turn: an estimate of its cost, long before all
/// have taken turns.
pub fn estimate(rig: &Rig, setup: &Setup, turn_millis: f64) -> Result<f64, LabError> {
    let clock = Clock::of(rig);
    TimedBatch::open(rig, setup, turn_millis, clock)?.take(clock)
}

/// Returns the bytes per second that a pass of this size moves which only copies rgba32f texels: the roofline. It is the
/// median of three turns. A frame has `passes` of these passes.
pub fn copied_bytes_per_second(rig: &Rig, size: (u32, u32), passes: u32, turn_millis: f64) -> Result<f64, LabError> {
    let clock = Clock::of(rig);
    let setup = Setup::new("floor", size).wants(&["copy"]).steps("copy", passes);
    let mut turns = TimedBatch::open(rig, &setup, turn_millis, clock)?;
    let millis: Result<Vec<f64>, LabError> = (0..3).map(|_| turns.take(clock)).collect();
    let texels = f64::from(size.0) * f64::from(size.1) * f64::from(passes);
    Ok(texels * COPY_BYTES / (Times::of(millis?).median / 1e3))
}

struct TimedBatch {
    running: Running,
    batch: u32,
    samples: Vec<f64>,
}

impl TimedBatch {
    /// Opens a setup and warms it up.
    fn open(rig: &Rig, setup: &Setup, turn_millis: f64, clock: Clock) -> Result<TimedBatch, LabError> {
        let mut running = rig.open(setup)?;
        if clock == Clock::Timestamps {
            running.engine().set_timing(true);
        }
        let batch = warm_up(&mut running, turn_millis)?;
        Ok(TimedBatch { running, batch, samples: Vec::new() })
    }

    /// Returns the milliseconds per frame of one turn.
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

/// Returns the milliseconds of a batch of frames, from the first call to the empty queue.
fn batch_millis(running: &mut Running, frames: u32) -> Result<f64, LabError> {
    let began = Instant::now();
    for _ in 0..frames {
        running.draw()?;
    }
    running.engine().gpu().wait()?;
    Ok(began.elapsed().as_secs_f64() * 1e3)
}

/// Draws until the driver has compiled and a batch takes long enough; returns the number of frames in a batch.
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
    fn outliers_affect_the_maximum_but_not_the_median() {
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
