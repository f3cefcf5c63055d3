//! The frames of a run, kept for seeking: the inputs of each, and at intervals a snapshot of the targets' contents that
//! later frames read. A frame between two snapshots is drawn again from the snapshot before it, or from the reset at
//! the start of the run. Snapshots get sparser with distance (`thinning`).

mod again;
mod thinning;

use crate::playback::{Reach, SeekTarget};
use again::Again;
use eddy_engine::{Engine, EngineError, FrameInputs, Snapshot};
use eddy_media::Gamepads;
use eddy_playback::run::{Frame, Replay, ReplayFrom, Run};
use eddy_project::CustomUniformValues;
use std::{
    collections::VecDeque,
    sync::Arc,
    time::{Duration, Instant},
};

/// Device memory for snapshots in bytes, and their maximum number: for small targets this many suffice for the last
/// minute of drawing and any length before it.
const BUDGET: u64 = 256 << 20;
const MOST: usize = 128;
/// Drawing the frames after a snapshot again takes at most about this long.
const REDRAWN: Duration = Duration::from_millis(600);
/// Frames between two snapshots.
const INTERVAL: std::ops::RangeInclusive<u64> = 1..=120;
/// A shorter way needs no snapshot before the frame that it leads to.
const SHORT: u64 = 8;
/// This many intervals are searched frame by frame: reading the texels back takes longer than drawing.
const LOOKED_THROUGH: u64 = 16;
/// Frames whose inputs are kept: 73 minutes at 60 per second, 40 MiB.
const KEPT: usize = 1 << 18;
/// The same while frames have the microphone's texture, 1 KiB each, or gamepads, .8 KiB: 18 minutes, 70 MiB.
const KEPT_HEARD: usize = 1 << 16;

/// The progress towards a goal.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SeekProgress {
    /// The inputs of the frame that is shown now.
    pub inputs: FrameInputs,
    /// The number of the goal's frame.
    pub goal: u64,
    /// The number of frames to draw before it.
    pub left: u64,
    /// The display is another texture: the canvas had another size on the way.
    pub is_display_new: bool,
    /// The shown frame was drawn with other values of uniforms than those that the user has set.
    pub has_other_values: bool,
}

/// A continuous run of frames: a reset starts another. The canvas may be resized on the way; its buffers then keep the
/// area that both sizes have in common.
pub(crate) struct History {
    frames: VecDeque<Frame>,
    /// The number of dropped frames: `frames[0]` is the frame with this number.
    forgotten: u64,
    /// The number of frames of the run that the targets include: the frame before this one is shown.
    drawn: u64,
    /// The number of the first frame on the current canvas: earlier ones are drawn again only on the way to later ones.
    floor: u64,
    /// The current size of the canvas, while earlier frames are drawn on their own.
    canvas: Option<(u32, u32)>,
    /// The run started with a reset, and the inputs of all its frames are kept.
    is_whole: bool,
    /// In addition, the program has drawn all of it.
    is_from_reset: bool,
    /// Each with the number of frames that were drawn before it.
    snapshots: VecDeque<(u64, Arc<Snapshot>)>,
    again: Again,
    /// The current values of the author's own uniforms.
    values: Arc<CustomUniformValues>,
    /// The duration of a frame.
    took: Duration,
    budget: u64,
}

impl Default for History {
    fn default() -> Self {
        Self {
            frames: VecDeque::new(),
            forgotten: 0,
            drawn: 0,
            floor: 0,
            canvas: None,
            is_whole: true,
            is_from_reset: true,
            snapshots: VecDeque::new(),
            again: Again::default(),
            values: Arc::default(),
            took: Duration::ZERO,
            budget: BUDGET,
        }
    }
}

impl History {
    /// Clears everything: later frames do not follow from earlier ones.
    pub(crate) fn restart(&mut self, is_reset: bool) {
        (self.forgotten, self.drawn, self.floor) = (0, 0, 0);
        (self.is_whole, self.is_from_reset) = (is_reset, is_reset);
        self.frames.clear();
        self.snapshots.clear();
        self.again = Again::default();
    }

    /// Applies a new canvas size, from the next frame on.
    pub(crate) fn resize(&mut self) {
        // A frame that is to be drawn again uses the new canvas. The frames of a run that was taken over have their
        // own.
        let kept = self.drawn + u64::from(self.again.rewound.is_some());
        if self.drawn > 0 {
            self.frames.truncate((kept - self.forgotten) as usize);
        }
        self.snapshots.clear();
        (self.floor, self.canvas) = (self.drawn, None);
    }

    /// Another program draws from now on. The inputs of the frames are kept: [`SeekTarget::Redraw`] draws them with the
    /// new program.
    pub(crate) fn change_program(&mut self) {
        self.snapshots.clear();
        self.again.change_program();
        self.is_from_reset = false;
    }

    pub(crate) fn set_values(&mut self, values: &CustomUniformValues) {
        self.values = Arc::new(values.clone());
    }

    /// Prepares for a new frame: drops the frames after the shown one, and takes a snapshot if one is due.
    pub(crate) fn before_frame(&mut self, engine: &mut Engine) -> Result<(), EngineError> {
        // The preceding frame has not been drawn by this program yet.
        if self.again.rewound.is_some()
            && let Some(inputs) = self.prepare_redraw(engine)?
        {
            engine.draw(&inputs)?;
            self.frame_redrawn(self.took);
        }
        // On the way to a frame that is no longer wanted.
        if self.put_canvas_back(engine)? {
            self.floor = self.drawn;
        }
        self.frames.truncate((self.drawn - self.forgotten) as usize);
        while self.snapshots.back().is_some_and(|(at, _)| *at > self.drawn) {
            self.snapshots.pop_back();
        }
        self.again.drop_frames_after(self.drawn);
        self.keep(engine, self.interval());
        let has_texture = |inputs: &FrameInputs| inputs.microphone.is_some() || inputs.gamepads != Gamepads::default();
        let hears = self.frames.back().is_some_and(|frame| has_texture(&frame.inputs));
        self.forget(if hears { KEPT_HEARD } else { KEPT });
        Ok(())
    }

    /// Restores the current size of the canvas. Returns whether it was different.
    fn put_canvas_back(&mut self, engine: &mut Engine) -> Result<bool, EngineError> {
        let Some((width, height)) = self.canvas.take().filter(|size| *size != engine.size()) else { return Ok(false) };
        engine.resize(width, height)?;
        Ok(true)
    }

    /// Drops the oldest frames if there are too many, up to the first that can be shown without them.
    fn forget(&mut self, most: usize) {
        if self.frames.len() < most {
            return;
        }
        (self.is_whole, self.is_from_reset) = (false, false);
        while self.snapshots.front().is_some_and(|(at, _)| *at <= self.forgotten) {
            self.snapshots.pop_front();
        }
        let first = self.first().max(self.forgotten + 1);
        let count = ((first - self.forgotten) as usize).min(self.frames.len());
        self.frames.drain(..count);
        self.forgotten += count as u64;
    }

    /// Records a frame that was drawn.
    pub(crate) fn frame_drawn(&mut self, inputs: FrameInputs, size: (u32, u32), took: Duration) {
        self.learn(took);
        self.frames.push_back(Frame { inputs, values: self.values.clone(), size });
        self.drawn += 1;
    }

    /// Updates the average duration of a frame, so that one slow frame has little effect.
    fn learn(&mut self, took: Duration) {
        self.took = if self.took.is_zero() { took } else { (7 * self.took + took) / 8 };
    }

    /// Takes a snapshot if the previous one is at least `least` frames ago. A device without memory for it keeps none.
    fn keep(&mut self, engine: &Engine, least: u64) {
        let place = self.snapshots.partition_point(|(at, _)| *at <= self.drawn);
        let before = place.checked_sub(1).map(|n| self.snapshots[n].0);
        let most = (self.budget / engine.checkpoint_bytes().max(1)).min(MOST as u64) as usize;
        if self.drawn < self.floor || before.is_some_and(|at| self.drawn - at < least) || most < 2 {
            return;
        }
        // Make room before it is used.
        let mut kept: Vec<u64> = self.snapshots.iter().map(|(at, _)| *at).collect();
        kept.insert(place, self.drawn);
        while let Some(index) = thinning::surplus(&kept, self.drawn, most) {
            let at = kept.remove(index);
            self.snapshots.retain(|(kept, _)| *kept != at);
        }
        match engine.checkpoint() {
            Ok(snapshot) => {
                let place = self.snapshots.partition_point(|(at, _)| *at <= self.drawn);
                self.snapshots.insert(place, (self.drawn, Arc::new(snapshot)));
            }
            Err(_) => self.snapshots.clear(),
        }
    }

    /// Returns the frames up to the shown one, from a snapshot on; `None` if there is no such snapshot.
    pub(crate) fn replay(&self, from: ReplayFrom) -> Option<Replay> {
        let (at, snapshot) = match from {
            ReplayFrom::Oldest => {
                let first = self.drawn.saturating_sub(LOOKED_THROUGH * self.interval());
                let before = || self.snapshots.iter().rev().find(|(at, _)| *at <= self.drawn);
                self.snapshots.iter().find(|(at, _)| (first..=self.drawn).contains(at)).or_else(before)?
            }
            ReplayFrom::Newest => {
                let before = |frame: u64| self.snapshots.iter().rev().find(move |(at, _)| *at < frame);
                before(self.drawn.saturating_sub(1)).or_else(|| before(self.drawn))?
            }
        };
        let first = at.checked_sub(self.forgotten)? as usize;
        let count = (self.drawn - at) as usize;
        let frames = self.frames.iter().skip(first).take(count).cloned().collect();
        Some(Replay { snapshot: snapshot.clone(), frames })
    }

    /// Returns the inputs of all frames up to the shown one, from the oldest that is kept.
    pub(crate) fn run(&self) -> Run {
        let count = (self.drawn - self.forgotten) as usize;
        Run { frames: self.frames.iter().take(count).cloned().collect(), is_whole: self.is_whole }
    }

    fn interval(&self) -> u64 {
        let frames = REDRAWN.as_secs_f64() / self.took.as_secs_f64().max(1e-4);
        (frames as u64).clamp(*INTERVAL.start(), *INTERVAL.end())
    }

    /// The number of the first frame that can be shown again.
    fn first(&self) -> u64 {
        let known = self.snapshots.front().map(|(at, _)| *at);
        let reset = (self.is_from_reset && self.floor == 0).then_some(0);
        reset.or(known).unwrap_or(self.drawn.saturating_sub(1)).max(self.floor)
    }

    fn frame(&self, number: u64) -> Option<&Frame> {
        self.frames.get(usize::try_from(number.checked_sub(self.forgotten)?).ok()?)
    }

    fn end(&self) -> u64 {
        self.forgotten + self.frames.len() as u64
    }

    pub(crate) fn reach(&self) -> Reach {
        let Some(shown) = self.shown() else { return Reach::default() };
        let secs = |number: u64| self.frame(number).map_or(0.0, |frame| frame.inputs.time_secs);
        let first = self.first().min(shown);
        Reach {
            back: shown - first,
            ahead: self.end().saturating_sub(shown + 1),
            first_secs: secs(first),
            last_secs: secs(self.end() - 1),
            shown,
            is_whole: self.is_whole,
        }
    }

    fn number(&self, goal: SeekTarget) -> Option<u64> {
        let first = self.first();
        let number = match goal {
            SeekTarget::By(frames) => self.shown()?.checked_add_signed(frames)?,
            SeekTarget::Frame(number) => number,
            SeekTarget::Redraw(number) => return (number < self.end() && self.is_whole).then_some(number),
            // Time may have been set back on the way.
            SeekTarget::Time(secs) => {
                let found = self.frames.iter().rposition(|frame| frame.inputs.time_secs <= secs);
                found.map_or(first, |found| (found as u64 + self.forgotten).max(first))
            }
        };
        (first..self.end()).contains(&number).then_some(number)
    }

    /// Advances towards a frame of the run and draws until `patience` has passed, but at least one frame if any is
    /// left. `None`: the goal is out of reach, and nothing is changed.
    pub(crate) fn travel(
        &mut self,
        engine: &mut Engine,
        goal: SeekTarget,
        patience: Duration,
    ) -> Option<Result<SeekProgress, EngineError>> {
        let number = self.number(goal)?;
        self.again.rewound = None;
        if let SeekTarget::Redraw(_) = goal {
            engine.reset();
            self.snapshots.clear();
            self.again = Again::default();
            (self.drawn, self.is_from_reset) = (0, true);
            self.canvas.get_or_insert(engine.size());
        } else if !self.go_near(engine, number) {
            self.restart(false);
            return None;
        }
        let began = Instant::now();
        let (mut count, mut is_display_new): (u32, bool) = (0, false);
        while self.drawn <= number && (count == 0 || began.elapsed() < patience) {
            let frame = self.frame(self.drawn)?.clone();
            if frame.size != engine.size() {
                if let Err(error) = engine.resize(frame.size.0, frame.size.1) {
                    return Some(Err(error));
                }
                is_display_new = true;
            }
            // A loop reaches its goal repeatedly.
            let is_there = self.drawn == number && count > 0;
            self.keep(engine, if is_there { SHORT } else { self.interval() });
            engine.set_custom_uniforms(&frame.values);
            if let Err(error) = engine.draw(&frame.inputs).and_then(|_| Ok(engine.gpu().wait()?)) {
                return Some(Err(error));
            }
            self.drawn += 1;
            count += 1;
        }
        if count > 0 {
            self.took = began.elapsed() / count;
        }
        if self.drawn > number {
            match self.put_canvas_back(engine) {
                Ok(is_new) => is_display_new |= is_new,
                Err(error) => return Some(Err(error)),
            }
        }
        // The current values are those set by the user, not those of that frame.
        engine.set_custom_uniforms(&self.values);
        let shown = self.frame(self.drawn.checked_sub(1)?)?;
        Some(Ok(SeekProgress {
            inputs: shown.inputs.clone(),
            goal: number,
            left: (number + 1).saturating_sub(self.drawn),
            is_display_new,
            has_other_values: shown.values != self.values,
        }))
    }

    /// Restores the closest snapshot before a frame, if that is closer than the contents of the targets. False: a
    /// snapshot does not fit.
    fn go_near(&mut self, engine: &mut Engine, number: u64) -> bool {
        let is_before = self.drawn <= number + 1;
        let kept = self.snapshots.iter().rev().find(|(at, _)| *at <= number);
        match kept {
            Some((at, _)) if is_before && *at <= self.drawn => true,
            Some((at, snapshot)) => {
                let at = *at;
                engine.restore(snapshot) && {
                    self.drawn = at;
                    true
                }
            }
            None if is_before => true,
            None => {
                engine.reset();
                self.drawn = 0;
                self.is_from_reset
            }
        }
    }
}

#[cfg(test)]
mod tests;
