//! The frames that have been drawn, so that one can go back to any of them: what each was drawn with, and every so many
//! frames a snapshot of the targets. A frame between two snapshots is drawn again from the one before it.

use crate::{
    engine::{Engine, EngineError, FrameInputs, Snapshot},
    project::CustomUniformValues,
};
use std::{
    collections::VecDeque,
    time::{Duration, Instant},
};

/// Bytes of the device that snapshots may take, and how many there may be: half a minute is enough of what is small.
const BUDGET: u64 = 256 << 20;
const MOST: usize = 16;
/// To draw the frames behind a snapshot again takes about so long at most.
const REDRAWN: Duration = Duration::from_millis(600);
/// Frames between two snapshots.
const INTERVAL: std::ops::RangeInclusive<u64> = 1..=120;

/// A run of frames, without a break: a new program, another canvas or a reset begins another.
pub struct History {
    frames: VecDeque<Frame>,
    /// The number of frames that are forgotten: `frames[0]` is the frame of this number.
    forgotten: u64,
    /// Each with the number of frames that were drawn before it.
    snapshots: VecDeque<(u64, Snapshot)>,
    /// What the author's own uniforms stand at.
    values: CustomUniformValues,
    /// The time that a frame takes.
    took: Duration,
}

struct Frame {
    inputs: FrameInputs,
    values: CustomUniformValues,
}

impl Default for History {
    fn default() -> Self {
        Self {
            frames: VecDeque::new(),
            forgotten: 0,
            snapshots: VecDeque::new(),
            values: CustomUniformValues::new(),
            took: Duration::ZERO,
        }
    }
}

impl History {
    /// Forgets everything: what is drawn from now on does not follow from what was.
    pub fn begin(&mut self) {
        self.forgotten = 0;
        self.frames.clear();
        self.snapshots.clear();
    }

    pub fn set_values(&mut self, values: &CustomUniformValues) {
        self.values.clone_from(values);
    }

    /// Takes a snapshot before the next frame where it is time for one. A device without room keeps none.
    pub fn before_frame(&mut self, engine: &Engine) {
        let drawn = self.forgotten + self.frames.len() as u64;
        let is_due = self.snapshots.back().is_none_or(|(at, _)| drawn - at >= self.interval());
        let bytes = engine.snapshot_bytes();
        if !is_due || bytes > BUDGET / 2 {
            return;
        }
        let held = |snapshots: &VecDeque<(u64, Snapshot)>| snapshots.iter().map(|(_, kept)| kept.bytes()).sum::<u64>();
        while self.snapshots.len() >= MOST || held(&self.snapshots) + bytes > BUDGET {
            self.snapshots.pop_front();
        }
        match engine.snapshot() {
            Ok(snapshot) => self.snapshots.push_back((drawn, snapshot)),
            Err(_) => self.snapshots.clear(),
        }
        // Frames before the first snapshot cannot be drawn again.
        let first = self.snapshots.front().map_or(drawn, |(at, _)| *at);
        while self.forgotten < first && self.frames.pop_front().is_some() {
            self.forgotten += 1;
        }
        self.forgotten = first;
    }

    /// A frame has been drawn.
    pub fn drew(&mut self, inputs: FrameInputs, took: Duration) {
        // A slow one alone tells nothing.
        self.took = if self.took.is_zero() { took } else { (7 * self.took + took) / 8 };
        if self.snapshots.is_empty() {
            self.forgotten += 1;
        } else {
            self.frames.push_back(Frame { inputs, values: self.values.clone() });
        }
    }

    fn interval(&self) -> u64 {
        let frames = REDRAWN.as_secs_f64() / self.took.as_secs_f64().max(1e-4);
        (frames as u64).clamp(*INTERVAL.start(), *INTERVAL.end())
    }

    /// How many frames one can go back from the newest.
    pub fn reach(&self) -> usize {
        if self.snapshots.is_empty() { 0 } else { self.frames.len().saturating_sub(1) }
    }

    /// Draws the frame again that is so many before the newest, from the snapshot before it; those after it are
    /// forgotten. `None` where it is out of reach. Gives what the frame is drawn with.
    pub fn go_back(&mut self, engine: &mut Engine, by: usize) -> Option<Result<FrameInputs, EngineError>> {
        if by > self.reach() {
            return None;
        }
        let target = self.frames.len() - 1 - by;
        let number = self.forgotten + target as u64;
        while self.snapshots.back().is_some_and(|(at, _)| *at > number) {
            self.snapshots.pop_back();
        }
        let (at, snapshot) = self.snapshots.back()?;
        if !engine.restore(snapshot) {
            self.begin();
            return None;
        }
        self.frames.truncate(target + 1);
        let first = (at - self.forgotten) as usize;
        let began = Instant::now();
        for frame in self.frames.iter().skip(first) {
            engine.set_custom_uniforms(&frame.values);
            if let Err(error) = engine.draw(&frame.inputs).and_then(|_| Ok(engine.gpu().wait()?)) {
                return Some(Err(error));
            }
        }
        let drawn = (target + 1 - first) as u32;
        self.took = began.elapsed() / drawn.max(1);
        // The values that stand now are those that a person turned, not those of that frame.
        engine.set_custom_uniforms(&self.values);
        self.frames.back().map(|frame| Ok(frame.inputs.clone()))
    }
}
