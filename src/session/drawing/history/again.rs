//! Draws the shown frame again, with other code, another canvas or other values: the same frame, from the same state
//! and inputs. Its effect on the next frame's state is applied once, however often it is drawn.
//!
//! A change of the program or the canvas discards the contents of the targets. Therefore the contents before the frame
//! are restored ([`History::rewind`]), the change is made, and the frame is drawn ([`History::prepare_redraw`]). That
//! state is kept for the next time.

use super::{BUDGET, Frame, History};
use eddy_engine::{DrawFor, Engine, EngineError, FrameInputs, Snapshot};
use std::{sync::Arc, time::Duration};

impl History {
    /// The number of the shown frame.
    pub(super) fn shown(&self) -> Option<u64> {
        self.again.rewound.or(self.drawn.checked_sub(1))
    }

    /// Restores the contents of the targets before the shown frame. Returns false if they are no longer available, as
    /// for buffers too large to be kept; then nothing is changed. The canvas keeps its size, unless a resize is
    /// pending: then it gets the size with the most kept data.
    pub(crate) fn rewind(&mut self, engine: &mut Engine, is_size_coming: bool) -> Result<bool, EngineError> {
        let Some(number) = self.shown() else { return Ok(false) };
        if self.again.rewound.is_some() {
            return Ok(true);
        }
        let (width, height) = engine.size();
        let is_there = engine.checkpoint_bytes() == 0 || self.put_back(engine, number)?;
        if is_there {
            (self.drawn, self.again.rewound) = (number, Some(number));
            self.keep_before(engine, number);
        }
        if !is_size_coming && engine.size() != (width, height) {
            engine.resize(width, height)?;
        }
        Ok(is_there)
    }

    /// Keeps the contents of the targets before a frame, unless they are kept already.
    fn keep_before(&mut self, engine: &Engine, number: u64) {
        let before = &mut self.again.before;
        if before.as_ref().is_some_and(|before| before.number == number) {
            return;
        }
        *before = None;
        if (1..=BUDGET).contains(&engine.checkpoint_bytes()) {
            // A device without memory for it keeps none.
            let kept = engine.checkpoint().ok();
            *before = kept.map(|kept| PriorState { number, size: engine.size(), snapshot: Arc::new(kept) });
        }
    }

    /// Restores the contents of the targets before a frame that was drawn.
    fn put_back(&mut self, engine: &mut Engine, number: u64) -> Result<bool, EngineError> {
        if let Some(before) = self.again.before.as_ref().filter(|before| before.number == number) {
            let (canvas, (width, height), snapshot) = (engine.size(), before.size, before.snapshot.clone());
            if canvas != before.size {
                engine.resize(width, height)?;
            }
            if engine.restore(&snapshot) {
                return Ok(true);
            }
            engine.resize(canvas.0, canvas.1)?;
        }
        if number == 0 && self.is_from_reset {
            engine.reset();
            return Ok(true);
        }
        let Some((at, snapshot)) = self.snapshots.iter().rev().find(|(at, _)| *at <= number) else { return Ok(false) };
        let (at, snapshot) = (*at, snapshot.clone());
        let Some(of) = self.frame(at).map(|frame| frame.size) else { return Ok(false) };
        let canvas = engine.size();
        engine.resize(of.0, of.1)?;
        if !engine.restore(&snapshot) {
            engine.resize(canvas.0, canvas.1)?;
            return Ok(false);
        }
        for frame in at..number {
            let Some(frame) = self.frame(frame).cloned() else { return Ok(false) };
            engine.resize(frame.size.0, frame.size.1)?;
            engine.set_custom_uniforms(&frame.values);
            engine.draw_for(&frame.inputs, DrawFor::Advance)?;
        }
        engine.gpu().wait()?;
        engine.set_custom_uniforms(&self.values);
        Ok(true)
    }

    /// Returns the inputs of the shown frame, for the engine to draw it again with the current program, canvas and
    /// values; [`History::frame_redrawn`] follows. `None` if the state that it was drawn from is no longer
    /// available.
    pub(crate) fn prepare_redraw(&mut self, engine: &mut Engine) -> Result<Option<FrameInputs>, EngineError> {
        if !self.rewind(engine, false)? {
            return Ok(None);
        }
        let number = self.drawn;
        if number == 0 && self.is_whole {
            // The initial state of this program on this canvas.
            engine.reset();
            self.is_from_reset = true;
        } else {
            self.keep_before(engine, number);
        }
        let (values, size) = (self.values.clone(), engine.size());
        self.frames.truncate((number + 1 - self.forgotten) as usize);
        let frame = self.frames.back_mut().filter(|_| number >= self.forgotten);
        Ok(frame.map(|frame| {
            (frame.values, frame.size) = (values, size);
            frame.inputs.clone()
        }))
    }

    /// Records that the frame has been drawn again.
    pub(crate) fn frame_redrawn(&mut self, took: Duration) {
        self.again.rewound = None;
        self.drawn += 1;
        self.learn(took);
    }

    /// Takes over a run that another process has drawn: its frames are ahead of the contents of the targets.
    pub(crate) fn load_run(&mut self, frames: Vec<Frame>) {
        self.restart(true);
        self.frames = frames.into();
    }

    /// Sets the canvas size while frames are drawn on their original canvas on the way to a goal: the new size applies
    /// after that. Returns false if no seek is in progress.
    pub(crate) fn resize_before_frame(&mut self, size: (u32, u32)) -> bool {
        let is_on_the_way = self.canvas.is_some();
        if is_on_the_way {
            self.canvas = Some(size);
        }
        is_on_the_way
    }
}

/// The contents of the targets before a frame, on the canvas of that time.
pub(super) struct PriorState {
    /// The frame's number in the run.
    pub number: u64,
    pub size: (u32, u32),
    pub snapshot: Arc<Snapshot>,
}

/// The state needed to draw the shown frame again.
#[derive(Default)]
pub(super) struct Again {
    /// The targets have their contents from before this frame, which is the shown one.
    pub rewound: Option<u64>,
    pub before: Option<PriorState>,
}

impl Again {
    /// Another program draws from now on.
    pub(super) fn change_program(&mut self) {
        // Its targets may differ.
        self.before = None;
    }

    /// A new frame is drawn: the frames after it belong to another run.
    pub(super) fn drop_frames_after(&mut self, number: u64) {
        self.before.take_if(|before| before.number > number);
    }
}
