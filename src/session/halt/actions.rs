//! Halting the picture, resuming it, and abandoning a device that does not respond.

use super::{HaltControl, OverdueAction, Verdict};
use crate::{
    Session,
    drawing::{Changes, ProgramOrigin},
    view::{About, Halt, Level},
};
use std::time::{Duration, Instant};

/// The maximum wait at exit for a frame that is being drawn.
const FAREWELL: Duration = Duration::from_millis(500);

impl Session {
    /// Checks whether a frame has been drawn for too long.
    pub(crate) fn watch_drawing(&mut self) {
        let Some(age) = self.overdue() else { return };
        if !self.open.halt.is_halted() {
            let since = self.open.host.now.checked_sub(age).unwrap_or(self.open.host.now);
            self.halt_with(Halt::Drawing { limit: self.open.halt.limit(), since });
        }
        match self.open.halt.judge_overdue(age, self.is_newer_wanted()) {
            OverdueAction::Wait => {}
            OverdueAction::MakeRoom => {
                let lost = self.services.drawing.lost_threads();
                if HaltControl::may_take_device(self.open.host.now, self.open.compile.edited_at, lost) {
                    self.start_anew();
                    self.end_halt_of_frame();
                    self.compile_soon();
                }
            }
            OverdueAction::GiveUp => self.give_up_frame(age),
        }
    }

    fn give_up_frame(&mut self, age: Duration) {
        let secs = age.as_secs_f64().round();
        self.open.halt.give_up_frame();
        self.start_anew();
        let is_good = self.fall_back(&format!(
            "a frame of this code did not finish within {secs} s, and its GPU device was dropped; change the code, or \
             compile again to retry"
        ));
        self.end_halt_of_frame();
        let what =
            if is_good { "a new device draws the last good code" } else { "a new device waits for your next edit" };
        self.notice_about(
            About::Code,
            Level::Error,
            format!("the GPU did not finish a frame within {secs} s: {what}. Your text is unchanged"),
        );
    }

    /// The next time at which [`Session::watch_drawing`] may have something to do.
    pub(crate) fn drawing_deadline(&self) -> Option<Instant> {
        self.open.halt.deadline(self.open.host.now, self.services.drawing.draws_since(), self.is_newer_wanted())
    }

    /// Returns how long the engine has been drawing, if that is too long.
    pub(crate) fn overdue(&self) -> Option<Duration> {
        self.open
            .halt
            .overdue(self.open.host.now, self.services.drawing.draws_since())
            .filter(|_| self.services.drawing.is_apart())
    }

    /// Returns whether something newer than the engine's current work is to be drawn.
    fn is_newer_wanted(&self) -> bool {
        let wanted = &self.open.changes;
        wanted.restart || wanted.program.is_some() || self.open.compile.is_newer_wanted(self.open.host.now)
    }

    /// Abandons the drawing device with its threads, and opens a new one. It has no program yet.
    fn start_anew(&mut self) {
        if let Err(e) = self.services.drawing.restart_thread(self.open.host.now, self.open.engine.size()) {
            self.open.halt.lose_device();
            self.notice_about(
                About::Window,
                Level::Error,
                format!("cannot start a thread for drawing: {e}. Save your texts and restart Eddy"),
            );
            return;
        }
        self.open.engine = self.open.engine.successor();
        self.open.changes = Changes::default();
        self.open.compile.change_compiler();
        let (device, options, wake) =
            (self.services.drawing.device(), &self.open.host.options, self.open.host.wake.clone());
        if let Err(e) = self.services.compiler.change_device(device, options, wake) {
            let text = format!("cannot start a thread for compiling: {e}. Save your texts and restart Eddy");
            self.notice_about(About::Window, Level::Error, text);
        }
        self.renew_requests();
        // Its buffers are reset, so the replay that drove them ends as well.
        self.end_replay("the GPU device was replaced");
        self.open.playback.change_device();
        self.open.read_backs.costs.forget();
        self.open.host.changed = true;
    }

    /// Handles the loss of the device, or a panic of the drawing thread.
    pub(crate) fn engine_is_gone(&mut self, why: &str) {
        self.film_lost_device();
        let is_again = self.open.halt.device_is_lost(self.open.host.now, self.open.compile.edited_at);
        if is_again {
            self.open.playback.clock.pause();
            self.open.halt.lose_device();
            self.notice(
                Level::Error,
                format!("{why}. Your texts are unchanged: save them, then restart Eddy to continue drawing"),
            );
            return;
        }
        self.start_anew();
        if self.open.halt.is_new() {
            self.fall_back(&format!("the GPU device was lost in the first frame of this code ({why})"));
        } else {
            self.compile_soon();
        }
        self.end_halt_of_frame();
        self.notice(Level::Error, format!("{why}. Drawing continues on a new device; your texts are unchanged"));
    }

    fn halt_with(&mut self, halt: Halt) {
        self.open.halt.start(halt, self.open.playback.clock.is_playing(), self.open.engine.project());
        self.open.playback.clock.pause();
        self.open.host.changed = true;
    }

    /// Ends the halt, so that drawing continues.
    fn end_halt(&mut self) {
        let Some(halt) = self.open.halt.end() else { return };
        self.open.host.changed = true;
        match halt {
            Halt::Forecast { .. } => self.open.playback.is_again_due = true,
            Halt::Opened { .. } => _ = self.open.compile.set_compiling(self.is_compile_under_way()),
            Halt::Drawing { .. } | Halt::Drawn { .. } => {}
        }
    }

    /// Resumes after a halt, unless the project was opened paused.
    fn end_halt_of_frame(&mut self) {
        if !self.open.halt.is_held() {
            self.end_halt();
            self.resume();
        }
    }

    /// Restores the state before the halt.
    fn resume(&mut self) {
        if self.open.halt.take_resuming() {
            self.open.playback.resume();
        }
    }

    pub(crate) fn go_on_drawing(&mut self) {
        self.open.halt.allow_more(self.open.host.now);
        self.end_halt();
        self.resume();
    }

    /// Ends a halt because the user plays or steps: whether it was playing before no longer matters.
    pub(crate) fn override_halt(&mut self) {
        self.open.halt.allow_more(self.open.host.now);
        self.end_halt();
        self.open.halt.forget_resuming();
    }

    /// Resumes with fewer pixels: few enough to bring a frame below the limit, judging by its time.
    pub(crate) fn draw_smaller(&mut self) {
        if !self.open.halt.is_halted() {
            return;
        }
        self.end_replay("the resolution was changed");
        self.open.canvas.replayed = None;
        let is_overdue = self.overdue().is_some();
        let factor = self.open.halt.smaller_by(self.open.host.now);
        self.open.canvas.shrink(factor);
        self.end_halt();
        if is_overdue {
            self.start_anew();
            self.compile_soon();
        }
        self.resume();
    }

    pub(crate) fn draw_last_good(&mut self) {
        if self.open.halt.good().is_none() || !self.open.halt.is_halted() {
            return;
        }
        let is_overdue = self.overdue().is_some();
        let limit = self.open.halt.limit().as_secs_f64();
        self.end_halt();
        if is_overdue {
            self.start_anew();
        } else {
            self.open.engine.drop_program();
        }
        self.fall_back(&format!(
            "a frame of this code takes longer than {limit} s: the picture shows the previous code; change the \
             code, or compile again to retry"
        ));
        self.resume();
    }

    /// Draws the last good code, if there is any, instead of the newest, and adds the reason to the errors.
    fn fall_back(&mut self, why: &str) -> bool {
        self.open.compile.add_failure(why);
        let is_good = self.open.compile.fall_back(self.open.halt.good().cloned());
        self.open.compile.fail(self.open.engine.has_program());
        self.open.compile.set_compiling(self.is_compile_under_way());
        self.open.host.changed = true;
        is_good
    }

    /// New code is about to be submitted to the device.
    pub(crate) fn mark_new_code(&mut self) {
        let origin = self.open.changes.program.as_ref().and_then(|coming| coming.origin.as_ref());
        let newest = origin.filter(|origin| origin.millis.is_some()).map(|ProgramOrigin { project, .. }| project);
        self.open.halt.begin_code(newest);
    }

    pub(crate) fn halt_for_new_program(&mut self, forecast: Option<Duration>) {
        self.end_halt_of_frame();
        if let Some(would_take) = forecast {
            self.halt_with(Halt::Forecast { limit: self.open.halt.limit(), would_take });
        }
    }

    /// Records the time of a drawn frame.
    pub(crate) fn frame_took(&mut self, took: Duration) {
        let newest = self.open.engine.project().filter(|_| self.open.engine.is_newest_program());
        match self.open.halt.frame_took(took, newest, self.services.drawing.is_apart()) {
            Verdict::Halt(halt) => self.halt_with(halt),
            Verdict::EndHalt => {
                self.end_halt();
                self.resume();
            }
            Verdict::GoOn => {}
        }
    }

    /// Holds a newly opened project if it hung or crashed the process last time.
    pub(crate) fn hold_after_trouble(&mut self) {
        if self.open.halt.finds_trouble_of(self.open.documents.current()) {
            self.hold_after(true);
        }
    }

    pub(crate) fn hold(&mut self) {
        if !self.open.halt.is_held() {
            self.hold_after(false);
        }
    }

    fn hold_after(&mut self, after_trouble: bool) {
        self.open.halt.hold(self.open.playback.clock.is_playing(), after_trouble);
        self.open.playback.clock.pause();
        self.open.host.changed = true;
    }

    /// Waits briefly for the frame in progress. Returns whether drawing threads are hung: only the end of the process
    /// ends them.
    pub fn end(&mut self) -> bool {
        let has_lost = !self.open.comparison.background.end(FAREWELL)
            | self.services.sound_pass.end(FAREWELL)
            | self.services.films.end(FAREWELL)
            | !self.services.closing.end(FAREWELL);
        !self.services.drawing.rest(FAREWELL) || self.services.drawing.lost_threads() > 0 || has_lost
    }
}

impl Drop for Session {
    /// Waits briefly for a frame, but not at all for a hung device.
    fn drop(&mut self) {
        self.open.comparison.background.end(FAREWELL);
        self.services.closing.end(FAREWELL);
        self.services.sound_pass.end(FAREWELL);
        self.services.films.end(FAREWELL);
        if !self.services.drawing.rest(FAREWELL) {
            self.services.compiler.leave();
            return;
        }
        self.services.drawing.close();
        self.open.halt.close();
    }
}
