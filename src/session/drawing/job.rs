//! The jobs that the engine gets, and its answers.

use super::{
    changes::PendingChanges,
    gate::Gate,
    history::SeekProgress,
    renderer::ShownPicture,
    task::{Delivery, Tasks},
};
use crate::playback::{Reach, SeekTarget};
use eddy_engine::{CostClock, EngineError, FrameInputs, PassCost, PassTime};
use eddy_project::Project;
use std::time::Duration;

/// One unit of work for the engine: first the changes, then the frame, then the tasks.
#[derive(Default)]
pub(crate) struct Job {
    pub changes: PendingChanges,
    pub draw: Draw,
    /// Time is paused: if the changes alter the shown frame, it is drawn again without advancing.
    pub stays: bool,
    /// The read-backs that follow the frame.
    pub tasks: Tasks,
    /// The project whose pass costs are requested: a view shows them.
    pub costs_of: Option<Project>,
    /// The limit for trying a new program on tiles before it draws; `None` skips the trial.
    pub tile_limit: Option<TileLimit>,
    /// The frame may wait or be abandoned; `None` draws it without interruption.
    pub gate: Option<Gate>,
}

/// The frame that a job draws.
#[derive(Default)]
pub(crate) enum Draw {
    #[default]
    Nothing,
    /// A new frame.
    Next(FrameInputs),
    /// The shown frame, with the current state.
    Again,
    /// Another frame of the run.
    Seek(SeekTarget),
}

/// The limit above which a program is too slow to be drawn whole without asking the user.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileLimit {
    /// The time that a whole frame may take.
    pub frame: Duration,
}

/// The answer to a job.
#[derive(Default)]
pub(crate) struct JobResult {
    /// The events of the job, in their order. A failure makes the later ones meaningless.
    pub events: Vec<Event>,
    /// The outputs of the tasks, in their order.
    pub outputs: Vec<Delivery>,
    /// The display may be another texture.
    pub is_display_new: bool,
    /// The duration of the job, if another thread did it.
    pub took: Duration,
}

/// A step of a job that the session has to know of.
pub(crate) enum Event {
    /// The canvas has another size, or keeps its own because the device rejected this one.
    Resized((u32, u32), Result<(), EngineError>),
    /// The new program draws, or was rejected. With the expected time of its frame if that is too long: it was not drawn.
    ProgramSet(Result<Option<Duration>, EngineError>),
    /// The shown frame should have been drawn again, but its inputs are not kept.
    CannotRedraw,
    /// Another frame of the run is shown; `None` if the goal is out of reach.
    Travelled(Option<Result<SeekProgress, EngineError>>),
    /// The shown frame was not drawn with the new canvas or values.
    Outdated,
    /// The frame shows a video frame that is too old.
    Late,
    /// The display's picture, if it may have changed and is delivered to the session.
    Picture(ShownPicture),
    Drawn(DrawnFrame),
    /// The engine cannot restart, or cannot draw.
    Failed(EngineError),
    /// The range of frames for seeking; without this event there is none.
    Reach(Reach),
    Clock(CostClock),
    Costs(Vec<PassCost>),
}

impl JobResult {
    /// Returns whether a frame was drawn, even if it failed.
    pub(crate) fn has_frame(&self) -> bool {
        let is_frame =
            |event: &Event| matches!(event, Event::Drawn(_) | Event::Failed(_) | Event::Travelled(Some(Ok(_))));
        self.events.iter().any(is_frame)
    }
}

/// A submitted frame; on a thread of its own, a drawn frame.
pub(crate) struct DrawnFrame {
    pub cpu_micros: f64,
    /// Milliseconds of each pass, for the newest frame with known times.
    pub times: Option<Vec<PassTime>>,
    /// The time until the device had drawn the frame.
    pub took: Duration,
}
