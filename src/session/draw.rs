//! Submits jobs to the engine and takes its results.

use super::{
    Session,
    drawing::{DrawnFrame, Job, JobResult, Tasks, TileLimit, beside},
    open_project::OpenProject,
    view::{About, Level},
};
use eddy_engine::{EngineError, FrameInputs};
use eddy_gpu::{Gpu, GpuError};
use std::time::Duration;

impl Session {
    /// Takes the engine's result, if there is one. Returns whether a frame was drawn.
    pub(super) fn take_drawn(&mut self, was_just_submitted: bool) -> bool {
        self.take_result(was_just_submitted).is_some_and(|done| self.take_done(done))
    }

    /// Submits a job with all pending changes and what `fill` adds.
    pub(super) fn submit(&mut self, may_wait: bool, fill: impl FnOnce(&mut Job)) {
        let mut job = self.open.next_job();
        fill(&mut job);
        self.services.drawing.submit(self.open.host.now, may_wait, job);
    }

    /// Takes the result of the job in flight, and records what it says of the engine.
    pub(super) fn take_result(&mut self, was_just_submitted: bool) -> Option<JobResult> {
        let (mut done, is_of_project) = self.services.drawing.take(was_just_submitted)?;
        if is_of_project {
            self.open.engine.finish(&mut done);
            return Some(done);
        }
        self.open.engine.take_size(&done);
        Some(JobResult { thread_error: done.thread_error, ..JobResult::default() })
    }

    /// Submits pending changes and due frames, one job after the other, as long as the engine accepts them: while
    /// playing one frame per call. Returns whether a frame was drawn.
    ///
    /// `runs`: a frame of the running picture may be among them.
    pub(super) fn draw_due_frames(&mut self, runs: bool) -> bool {
        let (mut is_drawn, mut has_run) = (false, !runs);
        while !self.services.drawing.is_busy() && !self.open.halt.is_held() && !self.open.halt.is_device_gone() {
            if !self.open.playback.is_replaying() {
                self.open.loop_range();
            }
            if self.travel() {
                is_drawn |= self.take_drawn(true);
                continue;
            }
            let frame = self.next_frame(&mut has_run);
            let again = frame.is_none() && self.open.take_redraw();
            let mut tasks = self.due_tasks(frame.is_some() || again);
            if frame.is_some() {
                self.request_film_frame(&mut tasks);
            }
            if frame.is_none() && !again && tasks.is_empty() && self.open.changes.is_empty() {
                break;
            }
            self.submit_frame(frame, again, tasks);
            is_drawn |= self.take_drawn(true);
        }
        is_drawn
    }

    /// Returns the frame that is due now. A new program, or a new project's engine, is submitted before its first one.
    fn next_frame(&mut self, has_run: &mut bool) -> Option<FrameInputs> {
        let wanted = &self.open.changes;
        let is_other_coming = wanted.restart || wanted.program.is_some();
        if is_other_coming || !self.open.engine.has_program() || self.open.halt.is_halted() {
            return None;
        }
        let is_step = self.services.films.has_room() && self.open.playback.take_step();
        if self.open.playback.is_replaying() {
            return self.open.next_replayed(is_step);
        }
        // The first frame of a new program does not wait for the next tick.
        let may_run = (!*has_run || self.open.picture.is_program_new)
            && !self.open.is_waiting_for_compile()
            && self.services.films.may_draw(self.open.host.now);
        *has_run |= !is_step && self.open.playback.is_running();
        let is_new = is_step || self.open.playback.is_running();
        let mut inputs = self.open.playback.next_frame(self.open.host.now, is_step, may_run)?;
        inputs.microphone = self.services.audio.spectrum(is_new);
        self.services.films.note_frame(is_new, self.open.host.now);
        if is_new {
            self.note_heard(inputs.time_secs);
        }
        self.open.restore_values();
        Some(inputs)
    }

    /// `again`: the shown frame is drawn again.
    pub(super) fn submit_frame(&mut self, frame: Option<FrameInputs>, again: bool, tasks: Tasks) {
        let stays = self.open.stays() && !std::mem::take(&mut self.open.playback.replay.follows);
        // Before a new frame the shown one is drawn again, with what was changed meanwhile.
        self.open.note_job(frame.as_ref(), again || (stays && frame.is_some()));
        if let Some(frame) = &frame {
            self.open.read_backs.measurements.start_frame(frame.frame);
        } else if again {
            self.open.read_backs.measurements.redraw(self.open.playback.frame());
        }
        let costs_of = self.open.read_backs.costs.is_watched().then(|| self.open.documents.current().clone());
        let tile_limit = self.tile_limit();
        let may_wait = self.open.frame_may_be_dropped() && tasks.is_empty() && costs_of.is_none();
        if self.open.changes.program.is_some() {
            self.open.mark_new_code();
        }
        self.submit(may_wait, |job| {
            (job.frame, job.stays, job.again, job.tasks) = (frame, stays, again, tasks);
            (job.costs_of, job.tile_limit) = (costs_of, tile_limit);
        });
    }

    fn tile_limit(&self) -> Option<TileLimit> {
        self.services.drawing.is_on_thread().then(|| TileLimit { frame: self.open.halt.limit() })
    }

    fn take_done(&mut self, done: JobResult) -> bool {
        self.write_captures();
        if let Some(why) = done.thread_error {
            self.on_device_lost(&why);
            return false;
        }
        if let Some(Ok(picture)) = self.services.last_pictures.ticket.take().map(|read| read.output) {
            self.picture_is_read(&picture);
        }
        self.services.display.generation += u64::from(done.is_display_new && !self.services.drawing.is_on_thread());
        // An engine on the session's own thread draws into the display itself.
        self.services.display.shown_count += u64::from(done.picture.is_some() || !self.services.drawing.is_on_thread());
        self.services.display.is_new |= done.picture.is_some();
        if let Some(Err(e)) = done.restarted {
            self.stop_drawing(&e);
            return false;
        }
        if done.cannot_redraw {
            self.open.on_redraw_impossible();
        }
        let has_frame = done.frame.is_some() || matches!(done.travelled, Some(Some(Ok(_))));
        if let Some(travelled) = done.travelled {
            self.travelled(travelled);
        }
        self.take_outputs(has_frame);
        self.feed_film();
        match done.resized {
            Some((_, Ok(()))) => {
                self.open.dismiss_notices(About::CanvasSize);
                self.open.halt.reset_pace();
                self.open.playback.is_redraw_due |= !has_frame;
                self.open.host.changed = true;
            }
            Some((size, Err(e))) => self.open.on_size_rejected(size, &e),
            None => {}
        }
        match done.program {
            Some(Ok(())) => self.on_program_installed(done.forecast),
            Some(Err(e)) => {
                self.refused(&e);
                return false;
            }
            None => {}
        }
        self.open.playback.is_redraw_due |= done.custom_uniforms_changed && !has_frame;
        // While the picture runs, the next frame shows it.
        self.open.playback.is_redraw_due |= done.is_late && has_frame && !self.open.playback.is_running();
        self.open.host.changed |= self.open.read_backs.costs.is_watched();
        match done.frame.transpose().and_then(|frame| Ok((frame, done.picture.transpose()?))) {
            Ok((frame, picture)) => {
                if let Some(picture) = picture {
                    // Also without a frame, if the display mode has changed.
                    self.open.host.changed |= frame.is_none();
                    match self.services.drawing.show(&picture) {
                        Ok(is_new) => self.services.display.generation += u64::from(is_new),
                        Err(e) => self.report_gpu_error(&e),
                    }
                }
                let is_drawn = frame.is_some();
                if let Some(frame) = frame {
                    self.frame_is_drawn(frame);
                }
                is_drawn
            }
            Err(e) => {
                self.stop_drawing(&e);
                false
            }
        }
    }

    fn frame_is_drawn(&mut self, frame: DrawnFrame) {
        let DrawnFrame { cpu_micros, times, took } = frame;
        self.open.on_picture_changed();
        self.open.dismiss_notices(About::Drawing);
        self.open.read_backs.cpu_micros = cpu_micros;
        if let Some(times) = times {
            self.open.read_backs.costs.add(times, self.open.engine.clock());
        }
        if std::mem::take(&mut self.open.picture.is_program_new) && self.open.engine.is_newest_program() {
            self.services.display.programs_drawn += 1;
        }
        self.open.host.changed |= self.open.playback.frame_is_drawn(self.open.host.now);
        self.frame_took(took);
    }

    /// The newest program draws from now on.
    fn on_program_installed(&mut self, forecast: Option<Duration>) {
        self.open.playback.is_redraw_due = true;
        self.services.audio.on_program_installed();
        self.open.playback.seeking.awaits_program = false;
        self.open.picture.is_program_new = true;
        self.open.host.changed = true;
        self.open.compile.set_compiling(self.open.is_compile_under_way());
        if let Some(millis) = self.open.engine.new_program_millis() {
            self.open.dismiss_code_notices();
            self.open.compile.succeed(millis);
            if std::mem::take(&mut self.open.compile.resets) {
                self.open.reset();
            } else {
                self.open.keep_inputs();
            }
        } else {
            // The picture is older than the text of the errors.
            self.open.compile.fail(self.open.engine.has_program());
        }
        self.open.halt_for_new_program(forecast);
    }

    /// Handles a frame that could not be drawn: the picture stops, everything else continues.
    pub(super) fn stop_drawing(&mut self, error: &EngineError) {
        let is_lost = matches!(error, EngineError::Gpu(GpuError::Lost(_)));
        if is_lost && self.services.drawing.is_on_thread() {
            self.on_device_lost(&error.to_string());
            return;
        }
        self.open.playback.clock.pause();
        self.open.end_replay("a frame could not be drawn");
        self.open.playback.forget_due_frames();
        if !is_lost {
            self.open.notice_about(About::Drawing, Level::Error, format!("{error}; the picture is paused"));
        } else if self.open.halt.lose_device() {
            self.open.notice_about(
                About::Window,
                Level::Error,
                format!("{error}. Your texts are unchanged: save them, then restart Eddy to continue drawing"),
            );
        }
    }

    /// Shows the picture on a new device of the window, whose previous one was lost. Drawing uses a separate device.
    pub fn show_on(&mut self, window: Gpu) -> Result<(), GpuError> {
        self.services.drawing.show_on(window.clone())?;
        self.services.sound_pass.change_device(beside(window));
        // Request it again, also while paused.
        self.open.changes.shown = Some(self.open.pictured());
        self.services.display.generation += 1;
        self.services.display.shown_count += 1;
        self.open.host.changed = true;
        Ok(())
    }
}

impl OpenProject {
    /// Returns whether the next frame is followed by similar ones, so that it may be dropped. The first frame of a
    /// program is always shown, however soon another follows, and so is a frame that is drawn while time is paused.
    pub(super) fn frame_may_be_dropped(&self) -> bool {
        self.playback.clock.is_playing() && !self.picture.is_program_new && self.changes.is_empty()
    }

    /// Tells the engine how to display a probe, if that has changed.
    pub(super) fn update_probe_display(&mut self) {
        if let Some(look) = self.read_backs.probe.take_look(false) {
            self.changes.look = Some(look);
        }
    }
}
