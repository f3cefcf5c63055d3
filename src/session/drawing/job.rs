//! The engine is asked to do a job at once, and gives an answer.

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

/// Changes that wait for the engine, each the newest of its kind.
#[derive(Default)]
pub(crate) struct Changes {
    /// Begin with an engine that has drawn nothing.
    pub restart: bool,
    pub size: Option<(u32, u32)>,
    pub program: Option<PendingProgram>,
    pub custom_uniforms: Option<CustomUniformValues>,
    pub shown: Option<PassName>,
    /// The way in which the shown pass is shown: as numbers, or as a picture.
    pub look: Option<Option<ValueLook>>,
    /// Every buffer as before frame 0.
    pub reset: bool,
    /// The frames of a run from that reset on, which are to be gone to.
    pub run: Option<Vec<Frame>>,
    /// The table of costs is to be made anew.
    pub costs: bool,
}

impl Changes {
    pub(crate) fn is_empty(&self) -> bool {
        let Self { restart, size, program, custom_uniforms, shown, look, reset, run, costs } = self;
        let is_asked = *restart || *reset || *costs || run.is_some();
        let is_shown_otherwise = shown.is_some() || look.is_some();
        !is_asked && size.is_none() && program.is_none() && custom_uniforms.is_none() && !is_shown_otherwise
    }

    /// Returns whether the targets are others after it, on a canvas of such a size.
    pub(crate) fn touches_targets(&self, canvas: (u32, u32)) -> bool {
        self.program.is_some() || self.size.is_some_and(|size| size != canvas)
    }
}

/// A program on its way to the engine.
pub(crate) struct PendingProgram {
    pub program: Program,
    /// Stays with the session when the program goes.
    pub origin: Option<ProgramOrigin>,
}

/// Holds what the session keeps of a program.
pub(crate) struct ProgramOrigin {
    /// The project that it was built of.
    pub project: Project,
    /// Milliseconds of the compile, if the program is of the newest text and not one to fall back to.
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

/// One turn of the engine: first the changes in the order of their fields, then the frame, then the tasks.
#[derive(Default)]
pub(crate) struct Job {
    pub changes: Changes,
    pub frame: Option<FrameInputs>,
    /// Another frame of the run is to be shown.
    pub travel: Option<SeekTarget>,
    /// Time stands still: what the changes make other than before is drawn again, and is not a further frame.
    pub stays: bool,
    /// The frame that is shown is to be drawn again, as it would be now.
    pub again: bool,
    /// The read-backs behind the frame.
    pub tasks: Tasks,
    /// The project whose passes' costs are asked for: somebody looks at them.
    pub costs_of: Option<Project>,
    /// Tiles of a new program are tried before it; without, none.
    pub tile_limit: Option<TileLimit>,
    /// The frame may wait, or be given up; without, it is drawn at once.
    pub gate: Option<Gate>,
}

/// Says when a program is too slow to be drawn whole unasked.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileLimit {
    /// The time that a whole frame may take.
    pub frame: Duration,
}

/// The answer to a job. `None` where it was not asked.
#[derive(Default)]
pub(crate) struct Done {
    pub restarted: Option<Result<(), EngineError>>,
    pub resized: Option<((u32, u32), Result<(), EngineError>)>,
    pub program: Option<Result<(), EngineError>>,
    /// The time that a frame of the new program would take, if that is too long: it was not drawn.
    pub forecast: Option<Duration>,
    /// The values of the author's own uniforms are others than before.
    pub custom_uniforms_changed: bool,
    /// The display may be another texture.
    pub is_display_new: bool,
    pub frame: Option<Result<DrawnFrame, EngineError>>,
    /// The frame that is shown was to be drawn again, and what it was drawn from is not kept.
    pub is_again_lost: bool,
    /// The frame shows an older frame of a video than it should.
    pub is_late: bool,
    /// The frame of the run that is shown now; `Some(None)` where the goal is out of reach.
    pub travelled: Option<Option<Result<SeekProgress, EngineError>>>,
    /// The frames that one can go to.
    pub reach: Reach,
    /// The outputs of the tasks, in their order.
    pub outputs: Vec<Delivery>,
    /// The display's picture, if it may have changed and is handed out.
    pub picture: Option<Result<Picture, EngineError>>,
    pub costs: Option<Vec<PassCost>>,
    pub clock: Option<CostClock>,
    /// The time of the job, where it was done on another thread.
    pub took: Duration,
    /// The reason why the engine's thread has ended.
    pub gave_up: Option<String>,
}

/// A frame that was handed in; on a thread of its own, drawn.
pub(crate) struct DrawnFrame {
    pub cpu_micros: f64,
    /// Milliseconds of each pass, of the newest frame for which they are known.
    pub times: Option<Vec<PassTime>>,
    /// The frame until the device had drawn it.
    pub took: Duration,
}
