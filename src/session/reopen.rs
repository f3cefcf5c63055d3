//! Stores the time of a project, the size of its picture and a thumbnail when it is closed, and restores them when it
//! is opened again.
//!
//! The rule: a project without state continues at the time and frame where it was. A project whose passes read the last
//! frame starts at frame 0, as its buffers do; if it was closed while paused, the frames up to the shown one are drawn
//! again from their recorded inputs, and it is paused there. If these are not available, as for a run of more than ten
//! minutes, it is paused at frame 0.

use super::{
    Session,
    canvas::CanvasSize,
    drawing::{Change, Job, RenderTask, Tasks},
    kept_files,
    open_project::OpenProject,
    read_back::{ReadPicture, TakeRun},
    recent::{Left, RecentProject},
    view::{About, Level},
};
use eddy_engine::Picture;
use eddy_playback::run::{Frame, Run};
use std::{
    path::Path,
    time::{Duration, Instant},
};

/// The maximum wait for the inputs of the run when a project is closed.
const CLOSE_TIMEOUT: Duration = Duration::from_millis(500);

impl Session {
    /// Records the path of the open project, if it has one, and returns its entry.
    pub(super) fn record_recent(&mut self) -> Option<RecentProject> {
        let project = self.open.documents.current();
        match self.services.recent.opened(&project.origin, project.dialect) {
            Ok(known) => known,
            Err(why) => {
                self.open.notice_about(About::Window, Level::Warning, why);
                None
            }
        }
    }

    /// Stores the time of the open project.
    pub(super) fn keep_time(&mut self) {
        // The frames of the last session have not been drawn again yet: keep what is stored.
        if self.open.playback.seeking.is_restoring {
            return;
        }
        self.keep_picture();
        let clock = &self.open.playback.clock;
        // A picture that was halted while playing plays again once it is drawn fast enough.
        let is_paused = !self.open.is_playing() && !self.open.halt.resumes();
        let (CanvasSize { scale, fixed }, default_size) = (self.open.canvas.requested, self.open.canvas.default_size);
        let left = Left {
            time_secs: clock.time_secs(),
            frame: clock.next_frame_number() - 1,
            is_paused,
            size: fixed.filter(|_| fixed != default_size.fixed),
            scale: Some(scale).filter(|scale| *scale != default_size.scale),
        };
        let origin = self.open.documents.current().origin.clone();
        if let Err(why) = self.services.recent.left(&origin, left, &self.open.trace.breakpoints) {
            log::warn!("{why}");
        }
        self.keep_run(is_paused);
    }

    /// Stores the inputs up to the shown frame, if they are needed to show it again.
    fn keep_run(&mut self, is_paused: bool) {
        let (reach, origin) = (self.open.engine.reach(), self.open.documents.current().origin.clone());
        let is_kept =
            is_paused && reach.is_whole && self.open.has_state() && self.services.runs.takes(&origin, reach.shown + 1);
        match if is_kept { self.take_run() } else { None } {
            Some(Run { frames, is_whole: true }) if !frames.is_empty() => {
                let name = self.open.documents.current().name.clone();
                if let Err(e) = self.services.runs.keep(&origin, name, frames) {
                    log::warn!("the shown frame cannot be restored at the next start: {e}");
                    self.services.runs.forget(&origin);
                }
            }
            _ => self.services.runs.forget(&origin),
        }
    }

    /// Stores the shown picture before its project is closed.
    fn keep_picture(&mut self) {
        // A device that is too slow is not waited for.
        if !self.services.last_pictures.is_kept() || self.open.halt.is_halted() || !self.open.is_picture_of_project() {
            return;
        }
        let end = Instant::now() + CLOSE_TIMEOUT;
        if let Some(Ok(picture)) = self.ask_engine(end, ReadPicture) {
            self.picture_is_read(&picture);
        }
    }

    pub(super) fn picture_is_read(&mut self, picture: &Picture) {
        let Some(path) = kept_files::path_of(&self.open.documents.current().origin).map(Path::to_owned) else { return };
        match self.services.last_pictures.keep(&path, picture) {
            Ok(()) => self.open.host.changed = true,
            Err(e) => log::warn!("cannot keep the picture of {}: {e}", path.display()),
        }
    }

    /// Requests the run from the engine, and waits for it up to a limit.
    pub(super) fn take_run(&mut self) -> Option<Run> {
        self.ask_engine(Instant::now() + CLOSE_TIMEOUT, TakeRun).map(|(run, _)| run)
    }

    /// Requests a read-back from the engine, and waits for it until `end`.
    fn ask_engine<T: RenderTask>(&mut self, end: Instant, task: T) -> Option<T::Output> {
        self.wait_idle_until(end)?;
        let mut tasks = Tasks::default();
        let mut ticket = tasks.add(task);
        // Pending changes are submitted later, if the project stays open.
        self.services.drawing.submit(self.open.host.now, false, Job { tasks, ..Job::default() });
        loop {
            if self.take_result(true).is_some() {
                return ticket.take().map(|finished| finished.output);
            }
            if Instant::now() >= end {
                return None;
            }
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    /// Waits for the job in progress. `None` if it does not end in time.
    fn wait_idle_until(&mut self, end: Instant) -> Option<()> {
        while self.services.drawing.is_busy() {
            self.take_drawn(false);
            if Instant::now() >= end {
                return None;
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        Some(())
    }

    /// Restores the time of the project that has just been opened.
    pub(super) fn restore_run(&mut self) {
        let Some(RecentProject { time_secs, frame, paused, size, scale, breakpoints, .. }) = self.record_recent()
        else {
            return;
        };
        self.open.trace.breakpoints = breakpoints;
        self.open.restore_size(size, scale);
        let is_playing = !paused;
        if !self.open.has_state() {
            self.open.playback.start_at(time_secs, frame, is_playing);
            return;
        }
        self.open.playback.start(is_playing);
        let origin = &self.open.documents.current().origin;
        if let Some(frames) = paused.then(|| self.services.runs.of(origin)).flatten() {
            self.open.restore_frames(frames);
        }
    }
}

impl OpenProject {
    /// The first program draws the frames of an earlier run again, and shows the last one.
    pub(super) fn restore_frames(&mut self, frames: Vec<Frame>) {
        if let Some(last) = frames.len().checked_sub(1) {
            self.playback.restore_run(last as u64);
            self.changes.set(Change::Run(frames));
        }
    }

    /// Returns whether the picture is the project's own: not that of the previous project, a probe, or a frame on the
    /// way of a seek.
    pub(super) fn is_picture_of_project(&self) -> bool {
        let is_drawn = self.engine.has_program() && !self.is_program_coming() && !self.picture.is_program_new;
        let is_passing = self.read_backs.probe.view().is_some() || self.playback.is_seeking();
        is_drawn && self.playback.has_drawn() && !is_passing
    }

    /// Restores the size of the picture. The file can be edited by hand: invalid sizes are ignored.
    fn restore_size(&mut self, size: Option<(u32, u32)>, scale: Option<f32>) {
        let default_size = self.canvas.default_size;
        let fixed = size.filter(|(width, height)| *width > 0 && *height > 0).or(default_size.fixed);
        let scale = scale.filter(|scale| scale.is_finite() && *scale > 0.0).unwrap_or(default_size.scale);
        self.canvas.requested = CanvasSize { scale, fixed };
    }
}
