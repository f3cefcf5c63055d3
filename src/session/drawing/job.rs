//! The jobs that the engine gets, and its answers.

use super::{
    gate::Gate,
    history::SeekProgress,
    task::{Delivery, Tasks},
};
use crate::playback::{Reach, SeekTarget};
use eddy_engine::{CostClock, EngineError, FrameInputs, PassCost, PassTime, Picture, Program, ValueLook};
use eddy_playback::run::Frame;
use eddy_project::{CustomUniform, CustomUniformValues, PassName, Project};
use std::time::Duration;

/// PendingChanges pending for the engine; a newer one of a kind replaces the older.
#[derive(Default)]
pub(crate) struct PendingChanges {
    /// Start with an engine that has drawn nothing.
    pub restart: bool,
    pub size: Option<(u32, u32)>,
    pub program: Option<PendingProgram>,
    pub custom_uniforms: Option<CustomUniformValues>,
    pub shown: Option<PassName>,
    /// The display of the shown pass: as numbers, or as a picture.
    pub look: Option<Option<ValueLook>>,
    /// Reset every buffer to its state before frame 0.
    pub reset: bool,
    /// The frames of a run from that reset on, to seek in.
    pub run: Option<Vec<Frame>>,
    /// Rebuild the table of costs.
    pub costs: bool,
}

impl PendingChanges {
    pub(crate) fn is_empty(&self) -> bool {
        let Self { restart, size, program, custom_uniforms, shown, look, reset, run, costs } = self;
        let is_asked = *restart || *reset || *costs || run.is_some();
        let is_shown_otherwise = shown.is_some() || look.is_some();
        !is_asked && size.is_none() && program.is_none() && custom_uniforms.is_none() && !is_shown_otherwise
    }

    /// Returns whether applying the changes alters the targets, given the canvas size.
    pub(crate) fn touches_targets(&self, canvas: (u32, u32)) -> bool {
        self.program.is_some() || self.size.is_some_and(|size| size != canvas)
    }
}

/// A program to be submitted to the engine.
pub(crate) struct PendingProgram {
    pub program: Program,
    /// Kept by the session when the program is submitted.
    pub origin: Option<ProgramOrigin>,
}

/// The session's record of a program.
pub(crate) struct ProgramOrigin {
    /// The project that it was built from.
    pub project: Project,
    /// Milliseconds of the compile, if the program is of the newest text, not a fallback.
    pub millis: Option<f64>,
    /// The author's own uniforms.
    pub custom_uniforms: Vec<CustomUniform>,
    /// The passes that are drawn.
    pub drawn: Vec<PassName>,
}

impl PendingProgram {
    pub(crate) fn new(program: Program, project: Project, millis: Option<f64>) -> Self {
        let drawn = program.plan().targets.iter().map(|t| t.id.clone()).collect();
        let origin = ProgramOrigin { project, millis, custom_uniforms: program.custom_uniforms().to_vec(), drawn };
        Self { origin: Some(origin), program }
    }
}

/// One unit of work for the engine: first the changes in the order of their fields, then the frame, then the tasks.
#[derive(Default)]
pub(crate) struct Job {
    pub changes: PendingChanges,
    pub frame: Option<FrameInputs>,
    /// Show another frame of the run.
    pub travel: Option<SeekTarget>,
    /// Time is paused: if the changes alter the shown frame, it is drawn again without advancing.
    pub stays: bool,
    /// Draw the shown frame again, with the current state.
    pub again: bool,
    /// The read-backs that follow the frame.
    pub tasks: Tasks,
    /// The project whose pass costs are requested: a view shows them.
    pub costs_of: Option<Project>,
    /// The limit for trying a new program on tiles before it draws; `None` skips the trial.
    pub tile_limit: Option<TileLimit>,
    /// The frame may wait or be abandoned; `None` draws it without interruption.
    pub gate: Option<Gate>,
}

/// The limit above which a program is too slow to be drawn whole without asking the user.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileLimit {
    /// The time that a whole frame may take.
    pub frame: Duration,
}

/// The answer to a job. A field is `None` if the job did not request it.
#[derive(Default)]
pub(crate) struct JobResult {
    pub restarted: Option<Result<(), EngineError>>,
    pub resized: Option<((u32, u32), Result<(), EngineError>)>,
    pub program: Option<Result<(), EngineError>>,
    /// The expected time of a frame of the new program, if that is too long: it was not drawn.
    pub forecast: Option<Duration>,
    /// The values of the author's own uniforms have changed.
    pub custom_uniforms_changed: bool,
    /// The display may be another texture.
    pub is_display_new: bool,
    pub frame: Option<Result<DrawnFrame, EngineError>>,
    /// The shown frame should have been drawn again, but its inputs are not kept.
    pub cannot_redraw: bool,
    /// The frame shows a video frame that is too old.
    pub is_late: bool,
    /// The frame of the run that is shown now; `Some(None)` if the goal is out of reach.
    pub travelled: Option<Option<Result<SeekProgress, EngineError>>>,
    /// The range of frames for seeking.
    pub reach: Reach,
    /// The outputs of the tasks, in their order.
    pub outputs: Vec<Delivery>,
    /// The display's picture, if it may have changed and is delivered to the session.
    pub picture: Option<Result<Picture, EngineError>>,
    pub costs: Option<Vec<PassCost>>,
    pub clock: Option<CostClock>,
    /// The duration of the job, if another thread did it.
    pub took: Duration,
    /// The reason why the engine's thread has ended.
    pub thread_error: Option<String>,
}

/// A submitted frame; on a thread of its own, a drawn frame.
pub(crate) struct DrawnFrame {
    pub cpu_micros: f64,
    /// Milliseconds of each pass, for the newest frame with known times.
    pub times: Option<Vec<PassTime>>,
    /// The time until the device had drawn the frame.
    pub took: Duration,
}
