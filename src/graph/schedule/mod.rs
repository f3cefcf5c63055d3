//! A frame as a list of operations, decided without a device. An engine executes the list in one loop.

use super::{Changes, Dependencies, Draw, FramePlan, SliceTimes};
use eddy_project::Region;

/// The purpose of drawing a frame, which determines its operations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// To show it: everything in one submission.
    Frame,
    /// To time each draw by the caller's clock: each in a separate submission that is waited for.
    Timed,
    /// To read back the inputs of a draw (an index into [`FramePlan::draws`]) before each of its steps.
    Inspect(usize),
    /// For later frames: only the draws that they depend on, and no picture.
    Advance,
    /// To show it, with the last draw in bands of rows if [`FramePlan::divisible_draw`] allows that.
    Bands,
    /// For the samples of a sound pass: like [`Purpose::Bands`], but nothing is shown.
    Sound,
}

/// An operation of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameOp {
    /// Starts the device's timestamps of the draws.
    StartTimestamps,
    /// Encodes one layer of a draw.
    Encode {
        /// An index into [`FramePlan::draws`].
        draw: usize,
        /// The face of a cube; otherwise 0.
        layer: u32,
    },
    /// Encodes `area` of a draw, in parts of as many rows as the caller returns, rounded up to a multiple of `align`.
    /// Each part but the last is submitted and waited for. The caller is asked before each part, and may stop there;
    /// the frame can be continued later.
    EncodeRows {
        /// An index into [`FramePlan::draws`].
        draw: usize,
        /// The texels that are drawn.
        area: Region,
        /// The number of rows of a part is a multiple of this.
        align: u32,
    },
    /// Encodes a part of a draw in one layer.
    EncodePart {
        /// An index into [`FramePlan::draws`].
        draw: usize,
        /// The texels that are drawn.
        area: Region,
    },
    /// The texels of a draw become visible to readers: double buffers are swapped, mip levels are built.
    Publish {
        /// An index into [`FramePlan::draws`].
        draw: usize,
    },
    /// Reads back everything that a draw is about to read.
    Capture {
        /// An index into [`FramePlan::draws`].
        draw: usize,
    },
    /// Reads the caller's clock.
    Clock(Lap),
    /// Draws the shown pass into the display's texture.
    Present,
    /// Ends the device's timestamps and copies them to a readable buffer.
    ResolveTimestamps,
    /// Submits the encoded commands.
    Submit,
    /// Submits the encoded commands and waits until the device has executed them.
    SubmitAndWait,
}

/// The use of a reading of the caller's clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lap {
    /// Measurement starts here.
    Start,
    /// The time since the start is that of an empty submission, which is included in the time of every draw.
    Overhead,
    /// The time since the start is that of a draw.
    Draw(usize),
}

/// The inputs for scheduling a frame, in addition to its plan.
#[derive(Clone, Copy, Debug)]
pub struct FrameState<'a> {
    /// The size of the picture in pixels.
    pub canvas: (u32, u32),
    /// For each draw, whether its condition ([`Draw::when`]) is false.
    pub off: &'a [bool],
    /// For each draw, what it depends on in this frame: [`Draw::dependencies`], or less.
    pub dependencies: &'a [Dependencies],
    /// For each draw, what it depends on besides targets, in any form for which equality means equal inputs and equal
    /// dependencies.
    pub inputs: &'a [Vec<u8>],
    /// For each draw, whether later frames depend on it ([`FramePlan::lasting_draws`]).
    pub lasting: &'a [bool],
    /// The times of the draws, for a device that is to be free for other work in between: a frame for
    /// [`Purpose::Frame`] or [`Purpose::Advance`] is submitted in slices, each of which is waited for.
    pub slices: Option<&'a SliceTimes>,
}

/// The operations of a frame in order, with their counts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Schedule {
    /// The operations.
    pub ops: Vec<FrameOp>,
    /// For each draw, how often it is executed.
    pub steps: Vec<u32>,
    /// The number of draws in the frame, counting each step of a group. A draw in tiles is counted, though its tiles
    /// are scheduled by [`FramePlan::schedule_tile`].
    pub drawn: u64,
    /// The number of draws skipped because their inputs have not changed.
    pub cached: u64,
    /// The bytes of texels that are therefore not written.
    pub cached_bytes: u64,
}

/// The division of a frame into submissions.
enum Division<'a> {
    One,
    /// This draw is in bands.
    Bands(usize),
    Slices(Slicer<'a>),
}

/// The slice that is being filled.
struct Slicer<'a> {
    times: &'a SliceTimes,
    /// The expected milliseconds of the operations since the last submission.
    unsubmitted: f64,
}

impl Slicer<'_> {
    /// Ends the slice, unless it is empty.
    fn submit(&mut self, ops: &mut Vec<FrameOp>) {
        if std::mem::take(&mut self.unsubmitted) > 0.0 {
            ops.push(FrameOp::SubmitAndWait);
        }
    }
}

impl FramePlan {
    /// Schedules a frame. `changes` tracks what was drawn before; the draws of the schedule count as executed
    /// afterwards.
    ///
    /// # Panics
    /// If the lists in `state` are shorter than the plan's draws.
    pub fn schedule(&self, state: &FrameState<'_>, changes: &mut Changes, purpose: Purpose) -> Schedule {
        let mut schedule = Schedule { steps: vec![0; self.draws.len()], ..Schedule::default() };
        let mut division = match (purpose, state.slices) {
            (Purpose::Bands | Purpose::Sound, _) => self.divisible_draw().map_or(Division::One, Division::Bands),
            (Purpose::Frame | Purpose::Advance, Some(times)) => Division::Slices(Slicer { times, unsubmitted: 0.0 }),
            _ => Division::One,
        };
        // Timestamps of several submissions do not add up to a frame's time.
        let has_timestamps = matches!(purpose, Purpose::Frame | Purpose::Inspect(_) | Purpose::Advance);
        match purpose {
            _ if has_timestamps => schedule.ops.push(FrameOp::StartTimestamps),
            // The first submission includes the commands that were encoded before this frame.
            Purpose::Timed => schedule.ops.extend([
                FrameOp::SubmitAndWait,
                FrameOp::Clock(Lap::Start),
                FrameOp::SubmitAndWait,
                FrameOp::Clock(Lap::Overhead),
            ]),
            _ => {}
        }
        for run in &self.runs {
            for _ in 0..run.steps {
                for index in run.draws.clone() {
                    let is_left_out = state.off[index] || purpose == Purpose::Advance && !state.lasting[index];
                    if !is_left_out {
                        self.schedule_draw(index, state, changes, purpose, &mut division, &mut schedule);
                    }
                }
            }
        }
        if has_timestamps {
            schedule.ops.push(FrameOp::ResolveTimestamps);
        }
        if !matches!(purpose, Purpose::Advance | Purpose::Sound) {
            schedule.ops.push(FrameOp::Present);
        }
        let waits = matches!(purpose, Purpose::Bands | Purpose::Sound) || matches!(division, Division::Slices(_));
        schedule.ops.push(if waits { FrameOp::SubmitAndWait } else { FrameOp::Submit });
        schedule
    }

    /// Schedules one step of a draw.
    fn schedule_draw(
        &self,
        index: usize,
        state: &FrameState<'_>,
        changes: &mut Changes,
        purpose: Purpose,
        division: &mut Division<'_>,
        schedule: &mut Schedule,
    ) {
        let draw = &self.draws[index];
        if purpose == Purpose::Inspect(index) {
            schedule.ops.extend([FrameOp::SubmitAndWait, FrameOp::Capture { draw: index }]);
        }
        if self.tiled.is_some_and(|tiled| tiled.draw == index) {
            schedule.drawn += 1;
            return;
        }
        let texels = self.texels(index, state.canvas);
        if texels == 0 {
            return;
        }
        if !changes.must_draw(index, draw, &state.dependencies[index], &state.inputs[index]) {
            let bytes: u64 = draw.all_targets().map(|target| self.targets[target].format.bytes()).sum();
            schedule.cached += 1;
            schedule.cached_bytes += texels * bytes;
            return;
        }
        schedule.drawn += 1;
        schedule.steps[index] += 1;
        if purpose == Purpose::Timed {
            schedule.ops.push(FrameOp::Clock(Lap::Start));
        }
        match division {
            Division::Slices(slicer) => self.schedule_slices(index, state.canvas, slicer, &mut schedule.ops),
            Division::Bands(divisible) if *divisible == index => {
                let (width, height) = self.targets[draw.targets.start].size.of(state.canvas);
                let area = Region { x: 0, y: 0, width, height };
                schedule.ops.extend([FrameOp::SubmitAndWait, FrameOp::EncodeRows { draw: index, area, align: 1 }]);
            }
            _ => schedule.ops.extend((0..self.layers(index)).map(|layer| FrameOp::Encode { draw: index, layer })),
        }
        schedule.ops.push(FrameOp::Publish { draw: index });
        if purpose == Purpose::Timed {
            schedule.ops.extend([FrameOp::SubmitAndWait, FrameOp::Clock(Lap::Draw(index))]);
        }
    }

    /// Schedules a draw in slices. A draw whose time is not known has slices of its own.
    fn schedule_slices(&self, index: usize, canvas: (u32, u32), slicer: &mut Slicer<'_>, ops: &mut Vec<FrameOp>) {
        let (times, layers) = (slicer.times, self.layers(index));
        let expected = times.expected(index);
        let millis = expected.unwrap_or(times.limit());
        let is_joined = expected.is_some() && slicer.unsubmitted + millis <= times.limit();
        if !is_joined {
            slicer.submit(ops);
        }
        if is_joined || !self.has_parts(index) {
            for layer in 0..layers {
                ops.push(FrameOp::Encode { draw: index, layer });
                slicer.unsubmitted += millis / f64::from(layers);
                if !is_joined {
                    slicer.submit(ops);
                }
            }
            return;
        }
        let (width, height) = self.targets[self.draws[index].targets.start].size.of(canvas);
        let mut y = 0;
        for rows in times.parts(index, (width, height)) {
            slicer.submit(ops);
            ops.push(FrameOp::EncodePart { draw: index, area: Region { x: 0, y, width, height: rows } });
            slicer.unsubmitted = millis * f64::from(rows) / f64::from(height);
            y += rows;
        }
        if expected.is_none() {
            slicer.submit(ops);
        }
    }

    /// Schedules a tile of the picture of [`FramePlan::tiled`], of `size` texels, into the corner of its target. A plan
    /// without such a draw returns no operations.
    pub fn schedule_tile(&self, size: (u32, u32)) -> Vec<FrameOp> {
        let Some(tiled) = self.tiled else { return Vec::new() };
        let area = Region { x: 0, y: 0, width: size.0, height: size.1 };
        // Derivatives are differences within blocks of pixels, which must not be split.
        let align = 4;
        let draw = tiled.draw;
        vec![FrameOp::EncodeRows { draw, area, align }, FrameOp::Publish { draw }, FrameOp::SubmitAndWait]
    }

    /// Returns the number of texels that one step of a draw covers in all layers.
    fn texels(&self, index: usize, canvas: (u32, u32)) -> u64 {
        let draw: &Draw = &self.draws[index];
        let size = self.targets[draw.targets.start].size.of(canvas);
        let count = |(width, height): (u32, u32)| u64::from(width) * u64::from(height);
        let texels = match draw.region {
            None => count(size),
            Some(region) => region.within(size).map_or(0, |region| count((region.width, region.height))),
        };
        texels * u64::from(self.layers(index))
    }
}

#[cfg(test)]
mod tests;
