//! Halting the picture, resuming it, and abandoning a device that does not respond.

use super::{HaltControl, OverdueAction, Verdict};
use crate::{
    Session,
    drawing::{PendingChanges, ProgramOrigin, ShownFrame},
    open_project::OpenProject,
    view::{About, Halt, Level},
};
use eddy_playback::run::Run;
use std::time::{Duration, Instant};

/// The maximum wait at exit for a frame that is being drawn.
const EXIT_TIMEOUT: Duration = Duration::from_millis(500);

impl Session {
    /// Checks whether a frame has been drawn for too long.
    pub(crate) fn watch_drawing(&mut self) {
        let Some(age) = self.overdue() else { return };
        if !self.open.halt.is_halted() {
            let since = self.open.host.now.checked_sub(age).unwrap_or(self.open.host.now);
            self.open.halt_with(Halt::Drawing { limit: self.open.halt.limit(), since });
        }
        match self.open.halt.judge_overdue(age, self.open.is_newer_wanted()) {
            OverdueAction::Wait => {}
            OverdueAction::MakeRoom => {
                let lost = self.services.drawing.lost_threads();
                if HaltControl::may_take_device(self.open.host.now, self.open.compile.edited_at, lost) {
                    self.replace_device();
                    self.open.end_halt_of_frame();
                    self.open.compile_soon();
                }
            }
            OverdueAction::AbandonDevice => self.abandon_frame(age),
        }
    }

    fn abandon_frame(&mut self, age: Duration) {
        let secs = age.as_secs_f64().round();
        self.open.halt.abandon_frame();
        self.replace_device();
        let is_good = self.open.fall_back(&format!(
            "a frame of this code did not finish within {secs} s; change the code, or compile again to retry"
        ));
        self.open.end_halt_of_frame();
        let what = if is_good { " with the last version of the code that worked" } else { "" };
        self.open.notice_about(
            About::Code,
            Level::Error,
            format!("The GPU hung for {secs} s and was restarted{what}. Your code is unchanged"),
        );
    }

    /// The next time at which [`Session::watch_drawing`] may have something to do.
    pub(crate) fn drawing_deadline(&self) -> Option<Instant> {
        self.open.halt.deadline(self.open.host.now, self.services.drawing.draws_since(), self.open.is_newer_wanted())
    }

    /// Returns how long the engine has been drawing, if that is too long.
    pub(crate) fn overdue(&self) -> Option<Duration> {
        self.open
            .halt
            .overdue(self.open.host.now, self.services.drawing.draws_since())
            .filter(|_| self.services.drawing.is_on_thread())
    }

    /// Abandons the drawing device with its threads, and opens a new one. It has no program yet.
    fn replace_device(&mut self) {
        if let Err(e) = self.services.drawing.restart_thread(self.open.host.now, self.open.engine.size()) {
            self.open.halt.lose_device();
            self.open.notice_about(
                About::Window,
                Level::Error,
                format!("cannot start a thread for drawing: {e}. Save your texts and restart Eddy"),
            );
            return;
        }
        self.open.engine = self.open.engine.successor();
        self.open.changes = PendingChanges::default();
        self.open.compile.change_compiler();
        let (device, options, wake) =
            (self.services.drawing.device(), &self.open.host.options, self.open.host.wake.clone());
        if let Err(e) = self.services.compiler.change_device(device, options, wake) {
            let text = format!("cannot start a thread for compiling: {e}. Save your texts and restart Eddy");
            self.open.notice_about(About::Window, Level::Error, text);
        }
        self.renew_requests();
        // Its buffers are reset, so the replay that drove them ends as well.
        self.open.end_replay("the GPU device was replaced");
        self.open.playback.change_device();
        self.open.read_backs.costs.forget();
        self.open.host.changed = true;
    }

    /// Handles the loss of the device, or a panic of the drawing thread.
    pub(crate) fn on_device_lost(&mut self, why: &str) {
        if self.services.drawing.shares_window_device() && self.services.drawing.gpu().is_lost() {
            // The window opens another one when it is painted next.
            self.lose_window_device(why);
            return;
        }
        let shown = self.shown_before_loss();
        if self.recover_from_loss(why, shown) {
            let text = format!("{why}. Drawing continues on a new device; your texts are unchanged");
            self.open.notice(Level::Error, text);
        }
    }

    /// Records the loss of the device that draws and paints, until the window has another.
    pub(crate) fn lose_window_device(&mut self, why: &str) {
        if self.services.drawing.lose_window_device(why) {
            let shown = self.shown_before_loss();
            self.services.drawing.keep_shown(shown);
            self.open.host.changed = true;
        }
    }

    /// Returns what is needed to show the same frame on another device. A thread that does not answer has lost it.
    fn shown_before_loss(&mut self) -> ShownFrame {
        let clock = &self.open.playback.clock;
        let time = ShownFrame::Time { secs: clock.time_secs(), frame: clock.next_frame_number() - 1 };
        if !self.open.has_state() {
            return time;
        }
        match self.take_run() {
            Some(Run { frames, is_whole: true }) => ShownFrame::Run(frames),
            _ => ShownFrame::Run(Vec::new()),
        }
    }

    /// Opens a new device for frames after a loss, and shows the same frame again. Returns false if the same has just
    /// happened before: the picture is paused then.
    pub(crate) fn recover_from_loss(&mut self, why: &str, shown: ShownFrame) -> bool {
        self.film_lost_device();
        let is_again = self.open.halt.device_is_lost(self.open.host.now, self.open.compile.edited_at);
        if is_again {
            self.open.playback.clock.pause();
            self.open.halt.lose_device();
            self.open.notice(
                Level::Error,
                format!("{why}. Your texts are unchanged: save them, then restart Eddy to continue drawing"),
            );
            return false;
        }
        self.replace_device();
        if self.open.halt.is_new() {
            self.open.fall_back(&format!("the GPU device was lost in the first frame of this code ({why})"));
        } else {
            self.open.compile_soon();
        }
        self.open.end_halt_of_frame();
        match shown {
            ShownFrame::Time { secs, frame } => self.open.playback.start_at(secs, Some(frame), self.open.is_playing()),
            ShownFrame::Run(frames) => self.open.restore_frames(frames),
        }
        true
    }

    /// Resumes with fewer pixels: few enough to bring a frame below the limit, judging by its time.
    pub(crate) fn draw_smaller(&mut self) {
        if !self.open.halt.is_halted() {
            return;
        }
        self.open.end_replay("the resolution was changed");
        self.open.canvas.replayed = None;
        let is_overdue = self.overdue().is_some();
        let factor = self.open.halt.smaller_by(self.open.host.now);
        self.open.canvas.shrink(factor);
        self.open.end_halt();
        if is_overdue {
            self.replace_device();
            self.open.compile_soon();
        }
        self.open.resume();
    }

    pub(crate) fn draw_last_good(&mut self) {
        if self.open.halt.good().is_none() || !self.open.halt.is_halted() {
            return;
        }
        let is_overdue = self.overdue().is_some();
        let limit = self.open.halt.limit().as_secs_f64();
        self.open.end_halt();
        if is_overdue {
            self.replace_device();
        } else {
            self.open.engine.drop_program();
        }
        self.open.fall_back(&format!(
            "a frame of this code takes longer than {limit} s: the picture shows the previous code; change the \
             code, or compile again to retry"
        ));
        self.open.resume();
    }

    /// Records the time of a drawn frame.
    pub(crate) fn frame_took(&mut self, took: Duration) {
        let newest = self.open.engine.project().filter(|_| self.open.engine.is_newest_program());
        match self.open.halt.frame_took(took, newest, self.services.drawing.is_on_thread()) {
            Verdict::Halt(halt) => self.open.halt_with(halt),
            Verdict::EndHalt => {
                self.open.end_halt();
                self.open.resume();
            }
            Verdict::GoOn => {}
        }
    }

    /// Waits briefly for the frame in progress. Returns whether drawing threads are hung: only the end of the process
    /// ends them.
    pub fn end(&mut self) -> bool {
        let has_lost = !self.open.comparison.background.end(EXIT_TIMEOUT)
            | self.services.sound_pass.end(EXIT_TIMEOUT)
            | self.services.films.end(EXIT_TIMEOUT)
            | !self.services.closing.end(EXIT_TIMEOUT);
        !self.services.drawing.wait_idle(EXIT_TIMEOUT) || self.services.drawing.lost_threads() > 0 || has_lost
    }
}

impl OpenProject {
    /// Returns whether something newer than the engine's current work is to be drawn.
    fn is_newer_wanted(&self) -> bool {
        self.changes.has_other_program() || self.compile.is_newer_wanted(self.host.now)
    }

    fn halt_with(&mut self, halt: Halt) {
        self.halt.start(halt, self.playback.hold(), self.engine.project());
        self.host.changed = true;
    }

    /// Ends the halt, so that drawing continues.
    fn end_halt(&mut self) {
        let Some(halt) = self.halt.end() else { return };
        self.host.changed = true;
        match halt {
            Halt::Forecast { .. } => self.playback.is_redraw_due = true,
            Halt::Opened { .. } => _ = self.compile.set_compiling(self.is_compile_under_way()),
            Halt::Drawing { .. } | Halt::Drawn { .. } => {}
        }
    }

    /// Resumes after a halt, unless the project was opened paused.
    fn end_halt_of_frame(&mut self) {
        if !self.halt.is_held() {
            self.end_halt();
            self.resume();
        }
    }

    /// Restores the state before the halt.
    fn resume(&mut self) {
        if self.halt.take_resuming() {
            self.playback.resume();
        }
    }

    pub(crate) fn continue_drawing(&mut self) {
        self.halt.allow_more(self.host.now);
        self.end_halt();
        self.resume();
    }

    /// Ends a halt because the user plays or steps: whether it was playing before no longer matters.
    pub(crate) fn override_halt(&mut self) {
        self.halt.allow_more(self.host.now);
        self.end_halt();
        self.halt.forget_resuming();
    }

    /// Draws the last good code, if there is any, instead of the newest, and adds the reason to the errors.
    fn fall_back(&mut self, why: &str) -> bool {
        self.compile.add_failure(why);
        let is_good = self.compile.fall_back(self.halt.good().cloned());
        self.compile.fail(self.engine.has_program());
        self.compile.set_compiling(self.is_compile_under_way());
        self.host.changed = true;
        is_good
    }

    /// New code is about to be submitted to the device.
    pub(crate) fn mark_new_code(&mut self) {
        let origin = self.changes.program().and_then(|coming| coming.origin.as_ref());
        let newest = origin.filter(|origin| origin.millis.is_some()).map(|ProgramOrigin { project, .. }| project);
        self.halt.on_new_code(newest);
    }

    pub(crate) fn halt_for_new_program(&mut self, forecast: Option<Duration>) {
        self.end_halt_of_frame();
        if let Some(would_take) = forecast {
            self.halt_with(Halt::Forecast { limit: self.halt.limit(), would_take });
        }
    }

    /// Holds a newly opened project if it hung or crashed the process last time.
    pub(crate) fn hold_after_trouble(&mut self) {
        if self.halt.found_marker_of(self.documents.current()) {
            self.hold_after(true);
        }
    }

    pub(crate) fn hold(&mut self) {
        if !self.halt.is_held() {
            self.hold_after(false);
        }
    }

    fn hold_after(&mut self, after_trouble: bool) {
        self.halt.hold(self.playback.hold(), after_trouble);
        self.host.changed = true;
    }
}

impl Drop for Session {
    /// Waits briefly for a frame, but not at all for a hung device.
    fn drop(&mut self) {
        self.open.comparison.background.end(EXIT_TIMEOUT);
        self.services.closing.end(EXIT_TIMEOUT);
        self.services.sound_pass.end(EXIT_TIMEOUT);
        self.services.films.end(EXIT_TIMEOUT);
        if !self.services.drawing.wait_idle(EXIT_TIMEOUT) {
            self.services.compiler.leave();
            return;
        }
        self.services.drawing.close();
        self.open.halt.close();
    }
}
