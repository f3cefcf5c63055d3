//! Read-backs after frames: who requests them, their order, and who takes the outputs.
//!
//! Owns the watched read-backs ([`ReadBack`]), and the tasks that several parts of a session request.

use super::{
    Session,
    buffers::BufferReads,
    costs::Costs,
    drawing::{Change, RenderTask, Renderer, Tasks},
    measures::Measurements,
    miniatures::Miniatures,
    open_project::OpenProject,
    probe::ProbeState,
};
use eddy_engine::{CameraFrame, EngineError, PassInputs, Picture, Pixels};
use eddy_playback::run::{Replay, ReplayFrom, Run};
use eddy_project::PassName;
use std::time::Instant;

/// The circumstances of the job that tasks are added to.
pub(super) struct Moment {
    pub now: Instant,
    /// A frame is drawn before them.
    pub has_frame: bool,
    pub is_playing: bool,
    pub is_seeking: bool,
}

/// A repeated read-back of something that is watched, of which only the newest is kept.
pub(super) trait ReadBack {
    /// Adds a task if one is due.
    fn request(&mut self, at: &Moment, tasks: &mut Tasks);

    /// Takes the output of a job, with or without a frame. Returns whether there is something new to show.
    fn receive(&mut self, has_frame: bool) -> bool;
}

/// Everything that is read back of the picture.
#[derive(Default)]
pub(super) struct ReadBacks {
    pub cpu_micros: f64,
    pub costs: Costs,
    pub probe: ProbeState,
    pub miniatures: Miniatures,
    pub buffers: BufferReads,
    pub measurements: Measurements,
}

impl ReadBacks {
    /// Returns the repeated read-backs, in their order.
    fn read_backs(&mut self) -> [&mut dyn ReadBack; 4] {
        [&mut self.miniatures, &mut self.probe, &mut self.buffers, &mut self.measurements]
    }

    /// The read-backs of another project, for the panels that watch this one's.
    pub(crate) fn successor(&self) -> Self {
        Self {
            cpu_micros: 0.0,
            costs: Costs::watched(self.costs.is_watched()),
            probe: ProbeState::default(),
            miniatures: self.miniatures.successor(),
            buffers: self.buffers.successor(),
            measurements: self.measurements.successor(),
        }
    }
}

impl Session {
    /// Returns the tasks that are due now, after the frame that is due if there is one.
    pub(super) fn due_tasks(&mut self, has_frame: bool) -> Tasks {
        // The engine of another project reports that it has no program.
        let is_there = self.open.engine.has_program() && !self.open.is_program_coming();
        let mut tasks = Tasks::default();
        // During a resize there is no valid picture.
        let is_between = self.open.changes.size().is_some() || self.open.playback.is_redraw_due;
        if is_between && !has_frame && is_there && !self.open.halt.is_halted() {
            return tasks;
        }
        if has_frame || is_there || self.open.changes.has(&Change::Restart) {
            self.request_pictures(has_frame, &mut tasks);
        }
        if is_there && !self.open.is_compile_under_way() {
            self.open.request_inputs(&mut tasks);
        }
        tasks
    }

    /// Requests pictures and numbers of the newest program, after the frame that is due.
    fn request_pictures(&mut self, has_frame: bool, tasks: &mut Tasks) {
        self.services.captures.request(tasks);
        let is_of_project = self.open.is_picture_of_project();
        self.services.last_pictures.request(is_of_project, tasks);
        let playback = &self.open.playback;
        let (is_playing, is_seeking) = (playback.is_running(), playback.is_seeking());
        let at = Moment { now: self.open.host.now, has_frame, is_playing, is_seeking };
        self.open.read_backs.read_backs().into_iter().for_each(|read_back| read_back.request(&at, tasks));
    }

    /// Requests single read-backs again that have not arrived: the device that was to deliver them is lost.
    pub(super) fn renew_requests(&mut self) {
        self.services.captures.retry();
        self.open.nan_search.background.renew_request();
        self.open.comparison.background.renew_request();
        self.open.tuning.background.renew_request();
        self.open.audit.renew_request();
        self.open.counts.renew_request();
        self.open.trace.renew_request();
    }

    /// Takes the outputs of a job.
    pub(super) fn take_outputs(&mut self, has_frame: bool) {
        let is_new = self.open.read_backs.read_backs().map(|read_back| read_back.receive(has_frame)).contains(&true);
        self.open.host.changed |= is_new;
        if self.open.read_backs.probe.take_news() {
            self.open.update_probe_display();
        }
        let device = self.services.drawing.device();
        self.open.search_frames(&device);
        self.open.find_divergence(&device);
        self.open.compare(&device);
        self.open.tune(&device);
        self.open.audit();
        self.open.take_counts();
        self.open.trace_pixel(has_frame);
    }
}

impl OpenProject {
    /// Requests the inputs that the newest program was drawn with. A trace waits until nothing more is to be drawn.
    fn request_inputs(&mut self, tasks: &mut Tasks) {
        self.nan_search.request_input(tasks);
        self.trace.divergence.request_input(tasks);
        self.comparison.request_input(tasks);
        self.tuning.request_input(tasks);
        self.audit.request_input(&self.picture.shown, tasks);
        if self.playback.is_settled() {
            self.trace.request_input(tasks);
        }
        self.request_counts(tasks);
    }
}

/// Reads the shown picture.
pub(super) struct ReadPicture;

impl RenderTask for ReadPicture {
    type Output = Result<Picture, EngineError>;

    fn run(self, renderer: &mut Renderer) -> Self::Output {
        renderer.engine_mut().picture()
    }
}

/// Returns the frames up to the newest, with the camera picture that the newest shows; `None`: none are kept.
pub(super) struct TakeReplay(pub ReplayFrom);

impl RenderTask for TakeReplay {
    type Output = Option<(Replay, Option<CameraFrame>)>;

    fn run(self, renderer: &mut Renderer) -> Self::Output {
        let camera = renderer.engine_mut().camera_picture();
        renderer.history().replay(self.0).map(|replay| (replay, camera))
    }
}

/// Returns the inputs of all frames up to the newest, with the camera picture that the newest shows.
pub(super) struct TakeRun;

impl RenderTask for TakeRun {
    type Output = (Run, Option<CameraFrame>);

    fn run(self, renderer: &mut Renderer) -> Self::Output {
        let camera = renderer.engine_mut().camera_picture();
        (renderer.history().run(), camera)
    }
}

/// Reads the inputs of a pass when it was last drawn, and its picture.
pub(super) struct Inspect(pub PassName);

pub(super) struct Inspected {
    pub pass: PassName,
    pub inputs: PassInputs,
    pub picture: Pixels,
}

impl RenderTask for Inspect {
    type Output = Result<Inspected, EngineError>;

    fn run(self, renderer: &mut Renderer) -> Self::Output {
        let engine = renderer.engine_mut();
        let (inputs, picture) = (engine.inspect(&self.0)?, engine.read(&self.0)?);
        Ok(Inspected { pass: self.0, inputs, picture })
    }
}
