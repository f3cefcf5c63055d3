//! Frames that take too long, and devices that do not come back.
//!
//! Owns the rules: when the picture stops, what it goes on with, and when a device is given up for a fresh one. The
//! texts are never touched.

use super::{
    Session, compile,
    drawing::ProgramOrigin,
    marker::Marker,
    pace::Pace,
    view::{About, Halt, Level, TabDiagnostic},
};
use eddy_background::Background;
use eddy_project::Project;
use std::{
    path::PathBuf,
    time::{Duration, Instant},
};

/// Limits of a frame after which a device that still draws it is given up.
const GIVE_UP: u32 = 5;
/// The same for new code, which drivers compile in its first frame: many passes take seconds on a busy processor.
const GIVE_UP_NEW: u32 = 15;
/// The user who lets a frame go on lets it have so many limits, or so often what it has taken.
const ALLOWED_LIMITS: u32 = 5;
const ALLOWED_TIMES: u32 = 3;
/// A device that is lost again so soon after the one before, with no edit in between, is not opened again.
const LOST_AGAIN: Duration = Duration::from_secs(10);
/// The quiet after the last edit before newer code takes the device of code that does not come back, for each thread
/// that has been given up already: each may keep a processor busy.
const QUIET: Duration = Duration::from_millis(1500);
/// The time between two looks at whether that quiet has come.
const LOOK: Duration = Duration::from_millis(100);
/// The end waits so long for a frame that is being drawn.
const FAREWELL: Duration = Duration::from_millis(500);

impl Session {
    /// Looks whether a frame has been drawn for too long.
    pub(super) fn watch_drawing(&mut self) {
        let Some(age) = self.overdue() else { return };
        let limit = self.halting.limit();
        if self.halting.halt.is_none() {
            let since = self.now.checked_sub(age).unwrap_or(self.now);
            self.halt_with(Halt::Drawing { limit, since });
        }
        if self.is_newer_wanted() {
            if self.may_start_anew() {
                self.start_anew();
                self.end_halt_of_frame();
                self.compile_soon();
            }
        } else if age >= self.patience() {
            let secs = age.as_secs_f64().round();
            if !self.halting.is_new {
                // It was fast enough until now, and would come to this again.
                self.halting.good = None;
            }
            self.start_anew();
            let is_good = self.fall_back(&format!(
                "a frame of this code did not finish within {secs} s, and its GPU device was dropped; change the \
                 code, or compile again to retry"
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
    }

    /// The next moment in which [`Session::watch_drawing`] may have something to do.
    pub(super) fn drawing_deadline(&self) -> Option<Instant> {
        let (since, limit) = (self.drawing.draws_since()?, self.halting.limit());
        let over = since + limit * self.halting.pace.patience();
        if self.halting.halt.is_none() || self.now < over {
            Some(over)
        } else if self.is_newer_wanted() {
            Some(self.now + LOOK)
        } else {
            Some(since + self.patience())
        }
    }

    /// The time after which a device is given up that still draws a frame.
    fn patience(&self) -> Duration {
        self.halting.limit() * if self.halting.is_new { GIVE_UP_NEW } else { GIVE_UP }
    }

    /// Returns how long the engine has been drawing, if that is too long.
    fn overdue(&self) -> Option<Duration> {
        let age = self.now.saturating_duration_since(self.drawing.draws_since()?);
        let patience = self.halting.limit() * self.halting.pace.patience();
        (self.drawing.is_apart() && age >= patience).then_some(age)
    }

    /// The user has something else to draw than what the engine is at.
    fn is_newer_wanted(&self) -> bool {
        let wanted = &self.drawing.wanted;
        wanted.restart
            || wanted.program.is_some()
            || self.compile.is_wanted
            || self.compile.newest_since.is_some()
            || self.compile.fallback.is_some()
            || self.compile.edits.deadline().is_some_and(|at| at <= self.now)
    }

    fn may_start_anew(&mut self) -> bool {
        let lost = u32::try_from(self.drawing.lost_threads()).unwrap_or(u32::MAX);
        let quiet = self.compile.edited_at.map_or(Duration::MAX, |at| self.now.saturating_duration_since(at));
        quiet >= QUIET.saturating_mul(lost)
    }

    /// Gives up the device that draws, with its threads, for a fresh one. No program is on that yet.
    fn start_anew(&mut self) {
        if let Err(e) = self.drawing.start_anew(self.now) {
            self.run.is_device_lost = true;
            self.notice_about(
                About::Window,
                Level::Error,
                format!("cannot start a thread for drawing: {e}. Save your texts and restart Eddy"),
            );
            return;
        }
        let work = compile::work(self.drawing.device(), &self.options, self.compile.jobs.clone());
        match Background::new("compile", "the compiler", self.wake.clone(), work) {
            // The old one may wait for the device.
            Ok(worker) => std::mem::replace(&mut self.compiler, worker).leave(),
            Err(e) => {
                let text = format!("cannot start a thread for compiling: {e}. Save your texts and restart Eddy");
                self.notice_about(About::Window, Level::Error, text);
            }
        }
        self.compile.newest_since = None;
        self.captures.retry();
        self.searching.background.renew_request();
        self.comparing.background.renew_request();
        self.auditing.renew_request();
        self.tracing.renew_request();
        // Its buffers begin anew, and so must what they go by.
        self.end_replay("the GPU device was replaced");
        self.playback.change_device();
        self.run.costs.forget();
        self.changed = true;
    }

    /// The device was lost, or the thread that draws has stumbled.
    pub(super) fn engine_is_gone(&mut self, why: &str) {
        let is_again = self.halting.lost_at.is_some_and(|at| {
            let is_soon = self.now.saturating_duration_since(at) < LOST_AGAIN;
            is_soon && self.compile.edited_at.is_none_or(|edited| edited <= at)
        });
        self.halting.lost_at = Some(self.now);
        if is_again {
            self.playback.clock.pause();
            self.run.is_device_lost = true;
            self.notice(
                Level::Error,
                format!("{why}. Your texts are unchanged: save them, then restart Eddy to continue drawing"),
            );
            return;
        }
        self.start_anew();
        if self.halting.is_new {
            self.fall_back(&format!("the GPU device was lost in the first frame of this code ({why})"));
        } else {
            self.compile_soon();
        }
        self.end_halt_of_frame();
        self.notice(Level::Error, format!("{why}. Drawing continues on a new device; your texts are unchanged"));
    }

    fn halt_with(&mut self, halt: Halt) {
        self.halting.resumes |= self.playback.clock.is_playing();
        self.playback.clock.pause();
        self.halting.halt = Some(halt);
        if let Some(project) = self.drawing.project() {
            self.halting.marker.set(project);
        }
        self.changed = true;
    }

    /// Lets everything that is drawn from now on take its time.
    fn end_halt(&mut self) {
        let Some(halt) = self.halting.halt.take() else { return };
        self.changed = true;
        match halt {
            Halt::Forecast { .. } => self.playback.is_again_due = true,
            Halt::Opened { .. } => self.compile.state.compiling = self.is_compile_under_way(),
            Halt::Drawing { .. } | Halt::Drawn { .. } => {}
        }
    }

    /// Goes on after a halt, unless the project was opened paused.
    fn end_halt_of_frame(&mut self) {
        if !self.halting.is_held() {
            self.end_halt();
            self.resume();
        }
    }

    /// Goes on as it was before the halt.
    fn resume(&mut self) {
        if std::mem::take(&mut self.halting.resumes) {
            self.playback.resume();
        }
    }

    fn allow_more(&mut self) {
        let Some(taken) = self.frame_time() else { return };
        self.halting.pace.begin();
        self.halting.allowed = Some((self.halting.limit() * ALLOWED_LIMITS).max(taken.saturating_mul(ALLOWED_TIMES)));
    }

    /// The time of the frame that the picture was halted for, as far as it is known.
    fn frame_time(&self) -> Option<Duration> {
        match self.halting.halt? {
            Halt::Drawing { since, .. } => Some(self.now.saturating_duration_since(since)),
            Halt::Drawn { took, .. } => Some(took),
            Halt::Forecast { would_take, .. } => Some(would_take),
            Halt::Opened { .. } => None,
        }
    }

    pub(super) fn go_on_drawing(&mut self) {
        self.allow_more();
        self.end_halt();
        self.resume();
    }

    /// Ends a halt, for who plays or steps on: whether it ran before does not count any more.
    pub(super) fn override_halt(&mut self) {
        self.allow_more();
        self.end_halt();
        self.halting.resumes = false;
    }

    /// Goes on with fewer pixels: as few as bring a frame below the limit, by what it took.
    pub(super) fn draw_smaller(&mut self) {
        if self.halting.halt.is_none() {
            return;
        }
        self.end_replay("the resolution was changed");
        self.canvas.replayed = None;
        let is_overdue = self.overdue().is_some();
        let taken = self.frame_time().unwrap_or_default();
        let times = taken.as_secs_f64() / self.halting.limit.as_secs_f64().max(1e-3);
        // Half a side is a quarter of the pixels.
        let halvings = (times.max(1.0).log2() / 2.0).ceil().clamp(1.0, 6.0) as i32;
        let factor = 0.5_f64.powi(halvings);
        match &mut self.canvas.asked.fixed {
            Some((width, height)) => {
                for side in [width, height] {
                    *side = ((f64::from(*side) * factor) as u32).max(1);
                }
            }
            None => self.canvas.asked.scale *= factor as f32,
        }
        self.end_halt();
        if is_overdue {
            self.start_anew();
            self.compile_soon();
        }
        self.resume();
    }

    pub(super) fn draw_last_good(&mut self) {
        if self.halting.good.is_none() || self.halting.halt.is_none() {
            return;
        }
        let is_overdue = self.overdue().is_some();
        let limit = self.halting.limit().as_secs_f64();
        self.end_halt();
        if is_overdue {
            self.start_anew();
        } else {
            self.drawing.drop_program();
        }
        self.fall_back(&format!(
            "a frame of this code takes longer than {limit} s: the picture shows the previous code; change the \
             code, or compile again to retry"
        ));
        self.resume();
    }

    /// Draws the last good code, if there is any, instead of the newest, and says why where errors are said.
    fn fall_back(&mut self, why: &str) -> bool {
        self.compile.diagnostics.insert(0, TabDiagnostic::nowhere(why));
        // Only another edit, or who asks for it, tries the newest again.
        (self.compile.is_wanted, self.compile.edited) = (false, false);
        self.compile.edits.cancel();
        self.compile.fallback = self.halting.good.clone();
        self.compile.state.last = Some(self.failed());
        self.compile.state.compiling = self.is_compile_under_way();
        self.changed = true;
        self.compile.fallback.is_some()
    }

    /// New code is about to reach the device.
    pub(super) fn mark_new_code(&mut self) {
        let origin = self.drawing.wanted.program.as_ref().and_then(|coming| coming.origin.as_ref());
        if let Some(ProgramOrigin { project, millis: Some(_), .. }) = origin {
            self.halting.marker.set(project);
        }
        self.halting.is_new = true;
        self.halting.pace.begin();
    }

    pub(super) fn halt_for_new_program(&mut self, forecast: Option<Duration>) {
        self.end_halt_of_frame();
        if let Some(would_take) = forecast {
            self.halt_with(Halt::Forecast { limit: self.halting.limit(), would_take });
        }
    }

    /// A frame has been drawn.
    pub(super) fn frame_took(&mut self, took: Duration) {
        let limit = self.halting.limit();
        if self.halting.pace.is_too_slow(took, limit) && self.drawing.is_apart() {
            self.halt_with(Halt::Drawn { limit, took });
            return;
        }
        if took <= self.halting.limit / 2 {
            self.halting.allowed = None;
        }
        if matches!(self.halting.halt, Some(Halt::Drawing { .. })) {
            self.end_halt();
            self.resume();
        }
        let is_newest = self.drawing.is_newest_program();
        if std::mem::take(&mut self.halting.is_new) && is_newest {
            self.halting.good = self.drawing.project().cloned();
        }
        if is_newest {
            self.halting.marker.clear();
        }
    }

    /// Another project has been opened.
    pub(super) fn halt_for_new_project(&mut self) {
        if self.halting.halt.is_none() && self.overdue().is_none() {
            self.halting.marker.clear();
        } else {
            self.halting.marker.leave();
        }
        (self.halting.halt, self.halting.good, self.halting.allowed) = (None, None, None);
        (self.halting.resumes, self.halting.is_new, self.halting.lost_at) = (false, false, None);
        self.halting.pace.begin();
        if self.halting.marker.find(self.documents.current()) {
            self.hold_after(true);
        }
    }

    pub(super) fn hold(&mut self) {
        if !self.halting.is_held() {
            self.hold_after(false);
        }
    }

    fn hold_after(&mut self, after_trouble: bool) {
        self.halting.resumes = self.playback.clock.is_playing();
        self.playback.clock.pause();
        self.halting.halt = Some(Halt::Opened { after_trouble });
        self.changed = true;
    }

    /// Waits a moment for the frame under way. Returns whether threads that draw do not come back: only the end of the
    /// process ends them.
    pub fn end(&mut self) -> bool {
        let has_lost = !self.comparing.background.end(FAREWELL);
        !self.drawing.rest(FAREWELL) || self.drawing.lost_threads() > 0 || has_lost
    }
}

impl Drop for Session {
    /// Nobody waits long for a frame, and not at all for a device that does not come back.
    fn drop(&mut self) {
        self.comparing.background.end(FAREWELL);
        if !self.drawing.rest(FAREWELL) {
            self.compiler.leave();
            return;
        }
        self.drawing.close();
        if self.halting.halt.is_none() {
            self.halting.marker.clear();
        }
    }
}

pub(super) struct Halting {
    pub halt: Option<Halt>,
    /// The picture ran when it was halted, and goes on after.
    pub resumes: bool,
    /// The newest code that drew a frame within the limit.
    pub good: Option<Project>,
    pub limit: Duration,
    pub pace: Pace,
    /// The time that the user has let a frame take.
    pub allowed: Option<Duration>,
    /// No frame of the newest program that was handed in has been drawn yet.
    pub is_new: bool,
    pub marker: Marker,
    pub lost_at: Option<Instant>,
}

impl Halting {
    pub fn new(limit: Duration, state_dir: Option<PathBuf>) -> Self {
        Self {
            halt: None,
            resumes: false,
            good: None,
            limit,
            pace: Pace::default(),
            allowed: None,
            is_new: false,
            marker: Marker::new(state_dir.as_deref()),
            lost_at: None,
        }
    }

    /// The time that a frame may take.
    pub fn limit(&self) -> Duration {
        self.allowed.unwrap_or(self.limit)
    }

    /// Nothing of the author's may reach the device yet.
    pub fn is_held(&self) -> bool {
        matches!(self.halt, Some(Halt::Opened { .. }))
    }
}
