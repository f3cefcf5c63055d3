//! The frame that is shown is drawn again, by other code, on another canvas or with other values: the same frame, from
//! the same state and inputs. What it leaves to the next frame comes of that state once, however often it is drawn.
//!
//! A change of the program or the canvas takes what the targets hold along with it. So the way is: what the targets
//! held before the frame is put back ([`History::rewind`]), the change is made, and the frame is drawn
//! ([`History::prepare_again`]). That state is kept, for the next time.

use super::{BUDGET, Frame, History};
use eddy_engine::{DrawFor, Engine, EngineError, FrameInputs, Snapshot};
use std::{sync::Arc, time::Duration};

impl History {
    /// The number of the frame that is shown.
    pub(super) fn shown(&self) -> Option<u64> {
        self.again.rewound.or(self.drawn.checked_sub(1))
    }

    /// Puts back what the targets held before the frame that is shown. False where that cannot be had any more, as of
    /// buffers too large to be kept; then nothing is changed. The canvas stays as it is, unless another size is coming:
    /// then it has the one that the most is kept of.
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

    /// Keeps what the targets hold before a frame, unless that is kept already.
    fn keep_before(&mut self, engine: &Engine, number: u64) {
        let before = &mut self.again.before;
        if before.as_ref().is_some_and(|before| before.number == number) {
            return;
        }
        *before = None;
        if (1..=BUDGET).contains(&engine.checkpoint_bytes()) {
            // A device without room keeps none.
            let kept = engine.checkpoint().ok();
            *before = kept.map(|kept| PriorState { number, size: engine.size(), snapshot: Arc::new(kept) });
        }
    }

    /// Has the targets hold what they held before a frame that was drawn.
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

    /// Returns the inputs of the frame that is shown, for the engine to draw it again with the program, the canvas and
    /// the values of now; [`History::frame_drawn_again`] follows. `None` where what it was drawn from cannot be had any more.
    pub(crate) fn prepare_again(&mut self, engine: &mut Engine) -> Result<Option<FrameInputs>, EngineError> {
        if !self.rewind(engine, false)? {
            return Ok(None);
        }
        let number = self.drawn;
        if number == 0 && self.is_whole {
            // As this program, on this canvas, begins.
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

    /// The frame has been drawn again.
    pub(crate) fn frame_drawn_again(&mut self, took: Duration) {
        self.again.rewound = None;
        self.drawn += 1;
        self.learn(took);
    }

    /// Takes up a run that was drawn before, by another process: its frames lie ahead of what the targets hold.
    pub(crate) fn take_up(&mut self, frames: Vec<Frame>) {
        self.begin(true);
        self.frames = frames.into();
    }

    /// Frames are drawn on the canvas that they had, on the way to another: it gets another size once that is there.
    /// False where that is not so.
    pub(crate) fn resize_behind(&mut self, size: (u32, u32)) -> bool {
        let is_on_the_way = self.canvas.is_some();
        if is_on_the_way {
            self.canvas = Some(size);
        }
        is_on_the_way
    }
}

/// Holds what the targets held before a frame, on the canvas that they had then.
pub(super) struct PriorState {
    /// The frame's number in the run.
    pub number: u64,
    pub size: (u32, u32),
    pub snapshot: Arc<Snapshot>,
}

/// Holds what is needed to draw the frame again that is shown.
#[derive(Default)]
pub(super) struct Again {
    /// The targets hold what they held before this frame, which is the one that is shown.
    pub rewound: Option<u64>,
    pub before: Option<PriorState>,
}

impl Again {
    /// Another program draws from now on.
    pub(super) fn change_program(&mut self) {
        // Its targets may be others.
        self.before = None;
    }

    /// A frame is drawn that was not drawn before: what follows it is another run.
    pub(super) fn drop_behind(&mut self, number: u64) {
        self.before.take_if(|before| before.number > number);
    }
}
