//! Submits jobs to the engine and takes its results.

use super::{
    Session,
    drawing::{Change, Draw, DrawnFrame, Event, Job, JobResult, Loss, ShownPicture, Tasks, TileLimit, for_background},
    open_project::OpenProject,
    view::{About, Level},
};
use eddy_engine::{EngineError, FrameInputs};
use eddy_gpu::{Gpu, GpuError};
use std::{mem::take, time::Duration};

impl Session {
    /// Takes the engine's result, if there is one. Returns whether a frame was drawn.
    pub(super) fn take_drawn(&mut self, was_just_submitted: bool) -> bool {
        let Some(done) = self.take_result(was_just_submitted) else { return false };
        self.write_captures();
        match done {
            Ok(done) => self.take_done(done),
            Err(why) => {
                self.on_device_lost(&why);
                false
            }
        }
    }

    /// Submits a job with all pending changes.
    pub(super) fn submit(&mut self, may_wait: bool, mut job: Job) {
        job.changes = self.open.take_changes();
        self.services.drawing.submit(self.open.host.now, may_wait, job);
    }

    /// Takes the result of the job in flight, and records what it says of the engine. `Err`: the engine's thread has
    /// ended.
    pub(super) fn take_result(&mut self, was_just_submitted: bool) -> Option<Result<JobResult, String>> {
        let (mut done, is_of_project) = self.services.drawing.take(was_just_submitted)?;
        let events = done.as_mut().map_or(&mut [][..], |done| &mut done.events);
        self.open.engine.finish(events, is_of_project);
        Some(done.map(|done| if is_of_project { done } else { JobResult::default() }))
    }

    /// Submits pending changes and due frames, one job after the other, as long as the engine accepts them: while
    /// playing one frame per call. Returns whether a frame was drawn.
    ///
    /// `runs`: a frame of the running picture may be among them.
    pub(super) fn draw_due_frames(&mut self, runs: bool) -> bool {
        let (mut is_drawn, mut has_run) = (false, !runs);
        while !self.services.drawing.is_busy() && !self.open.halt.is_held() && !self.open.halt.is_device_gone() {
            self.open.loop_range();
            if self.travel() {
                is_drawn |= self.take_drawn(true);
                continue;
            }
            let frame = self.next_frame(&mut has_run);
            let is_new = frame.is_some();
            let draw = match frame {
                Some(inputs) => Draw::Next(inputs),
                None if self.open.take_redraw() => Draw::Again,
                None => Draw::Nothing,
            };
            let is_idle = matches!(draw, Draw::Nothing);
            let mut tasks = self.due_tasks(!is_idle);
            if is_new {
                self.request_film_frame(&mut tasks);
            }
            if is_idle && tasks.is_empty() && self.open.changes.is_empty() {
                break;
            }
            self.submit_frame(draw, tasks);
            is_drawn |= self.take_drawn(true);
        }
        is_drawn
    }

    /// Returns the frame that is due now. A new program, or a new project's engine, is submitted before its first one.
    fn next_frame(&mut self, has_run: &mut bool) -> Option<FrameInputs> {
        if self.open.changes.has_other_program() || !self.open.engine.has_program() || self.open.halt.is_halted() {
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
        let is_running = self.open.playback.is_running();
        *has_run |= is_running && !is_step;
        let is_new = is_running || is_step;
        let mut inputs = self.open.playback.next_frame(self.open.host.now, is_step, may_run)?;
        inputs.microphone = self.services.audio.spectrum(is_new);
        self.services.films.note_frame(is_new, self.open.host.now);
        if is_new {
            self.note_heard(inputs.time_secs);
        }
        self.open.restore_values();
        Some(inputs)
    }

    /// Submits a frame with all pending changes.
    pub(super) fn submit_frame(&mut self, draw: Draw, tasks: Tasks) {
        let stays = self.open.stays() && !take(&mut self.open.playback.replay.follows);
        // Before a new frame the shown one is drawn again, with what was changed meanwhile.
        self.open.note_job(&draw, stays);
        match &draw {
            Draw::Next(frame) => self.open.read_backs.measurements.start_frame(frame.frame),
            Draw::Again => self.open.read_backs.measurements.redraw(self.open.playback.frame()),
            Draw::Nothing | Draw::Seek(_) => {}
        }
        let costs_of = self.open.read_backs.costs.is_watched().then(|| self.open.documents.current().clone());
        let tile_limit = self.tile_limit();
        let may_wait = self.open.frame_may_be_dropped() && tasks.is_empty() && costs_of.is_none();
        if self.open.changes.program().is_some() {
            self.open.mark_new_code();
        }
        self.submit(may_wait, Job { draw, stays, tasks, costs_of, tile_limit, ..Job::default() });
    }

    fn tile_limit(&self) -> Option<TileLimit> {
        self.services.drawing.is_on_thread().then(|| TileLimit { frame: self.open.halt.limit() })
    }

    /// Applies the result of a job. Returns whether a frame was drawn.
    fn take_done(&mut self, done: JobResult) -> bool {
        if let Some(Ok(picture)) = self.services.last_pictures.ticket.take().map(|read| read.output) {
            self.picture_is_read(&picture);
        }
        if !self.services.drawing.is_on_thread() {
            // The engine draws into the display itself.
            self.services.display.generation += u64::from(done.is_display_new);
            self.services.display.shown_count += 1;
        }
        let has_frame = done.has_frame();
        self.take_outputs(has_frame);
        self.feed_film();
        self.open.host.changed |= self.open.read_backs.costs.is_watched();
        let mut is_drawn = false;
        for event in done.events {
            match event {
                Event::Resized(_, Ok(())) => self.open.on_resized(),
                Event::Resized(size, Err(e)) => self.open.on_size_rejected(size, &e),
                Event::ProgramSet(Ok(forecast)) => self.on_program_installed(forecast),
                Event::ProgramSet(Err(e)) => {
                    self.refused(&e);
                    return false;
                }
                Event::CannotRedraw => self.open.on_redraw_impossible(),
                Event::Travelled(travelled) => self.travelled(travelled),
                Event::Outdated => self.open.playback.is_redraw_due = true,
                // While the picture runs, the next frame shows it.
                Event::Late => self.open.playback.is_redraw_due |= !self.open.playback.is_running(),
                Event::Picture(picture) => self.show_picture(picture, has_frame),
                Event::Drawn(frame) => {
                    self.frame_is_drawn(frame);
                    is_drawn = true;
                }
                Event::Failed(e) => {
                    self.stop_drawing(&e);
                    return false;
                }
                // The status of the engine has them.
                Event::Reach(_) | Event::Clock(_) | Event::Costs(_) => {}
            }
        }
        is_drawn
    }

    /// Shows a picture that another thread drew.
    fn show_picture(&mut self, picture: ShownPicture, has_frame: bool) {
        self.services.display.shown_count += 1;
        self.services.display.is_new = true;
        // Also without a frame, if the display mode has changed.
        self.open.host.changed |= !has_frame;
        match self.services.drawing.show(picture) {
            Ok(is_new) => self.services.display.generation += u64::from(is_new),
            Err(e) => self.report_gpu_error(&e),
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
        if take(&mut self.open.picture.is_program_new) && self.open.engine.is_newest_program() {
            self.services.display.programs_drawn += 1;
        }
        self.open.host.changed |= self.open.playback.frame_is_drawn(self.open.host.now);
        self.frame_took(took);
    }

    /// The newest program draws from now on.
    fn on_program_installed(&mut self, forecast: Option<Duration>) {
        self.open.playback.on_program_installed();
        self.services.audio.on_program_installed();
        self.open.picture.is_program_new = true;
        self.open.host.changed = true;
        self.open.compile.set_compiling(self.open.is_compile_under_way());
        if let Some(millis) = self.open.engine.new_program_millis() {
            self.open.dismiss_code_notices();
            self.open.compile.succeed(millis);
            if take(&mut self.open.compile.resets) {
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
        self.open.playback.stop();
        self.open.end_replay("a frame could not be drawn");
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

    /// Shows the picture on a new device of the window, whose previous one was lost. If frames were drawn on it too,
    /// drawing continues on the new one.
    pub fn show_on(&mut self, window: Gpu) -> Result<(), GpuError> {
        if self.services.drawing.shares_window_device() {
            // The window may have noticed it first.
            self.lose_window_device("the graphics device was lost");
        }
        let lost = self.services.drawing.show_on(window.clone())?;
        self.services.sound_pass.change_device(for_background(window));
        self.services.display.generation += 1;
        self.services.display.shown_count += 1;
        self.open.host.changed = true;
        match lost {
            // The window reports the loss.
            Some(Loss { why, shown }) => drop(self.recover_from_loss(&why, shown)),
            // Request it again, also while paused.
            None => self.open.changes.set(Change::Show(self.open.pictured())),
        }
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
            self.changes.set(Change::Look(look));
        }
    }
}
