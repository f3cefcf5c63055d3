//! Frames that take too long, and devices that do not come back.
//!
//! Owns the rules: when the picture stops, what it goes on with, and when a device is given up for a fresh one
//! ([`HaltControl`]). What a session does by them is in `actions`. The texts are never touched.

mod actions;
mod marker;
mod pace;

use super::view::Halt;
use eddy_project::Project;
use marker::Marker;
use pace::Pace;
use std::{
    mem::{replace, take},
    path::Path,
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

/// The halt of the picture, if there is one, and what is known of its frames.
#[derive(Default)]
pub(super) struct HaltControl {
    halt: Option<Halt>,
    /// The picture ran when it was halted, and goes on after.
    resumes: bool,
    /// The newest code that drew a frame within the limit.
    good: Option<Project>,
    limit: Duration,
    pace: Pace,
    /// The time that the user has let a frame take.
    allowed: Option<Duration>,
    /// No frame of the newest program that was handed in has been drawn yet.
    is_new: bool,
    marker: Marker,
    lost_at: Option<Instant>,
    /// The device is gone for good.
    is_device_gone: bool,
}

/// A frame has been drawn; the picture does this.
#[derive(Debug, PartialEq)]
pub(super) enum Verdict {
    Halt(Halt),
    /// It had been halted while the frame was drawn.
    EndHalt,
    GoOn,
}

/// A device still draws a frame that takes too long.
#[derive(Debug, PartialEq)]
pub(super) enum OverdueAction {
    Wait,
    /// Newer code has its device, or may not take it yet.
    MakeRoom,
    GiveUp,
}

impl HaltControl {
    pub(crate) fn new(limit: Duration, state_dir: Option<&Path>) -> Self {
        Self { limit, marker: Marker::new(state_dir), ..Self::default() }
    }

    /// Begins with another project. `is_overdue`: the device still draws a frame of the one before.
    pub(crate) fn begin_next_project(&mut self, is_overdue: bool) {
        if self.halt.is_none() && !is_overdue {
            self.marker.clear();
        } else {
            self.marker.leave();
        }
        (self.halt, self.good, self.allowed) = (None, None, None);
        (self.resumes, self.is_new, self.lost_at) = (false, false, None);
        self.pace.begin();
    }

    /// Returns whether a project froze or ended the process when it was open last.
    pub(crate) fn finds_trouble_of(&mut self, project: &Project) -> bool {
        self.marker.find(project)
    }

    pub(crate) fn halt(&self) -> Option<&Halt> {
        self.halt.as_ref()
    }

    pub(crate) fn is_halted(&self) -> bool {
        self.halt.is_some()
    }

    /// Nothing of the author's may reach the device yet.
    pub(crate) fn is_held(&self) -> bool {
        matches!(self.halt, Some(Halt::Opened { .. }))
    }

    /// The picture runs again once it is drawn fast.
    pub(crate) fn resumes(&self) -> bool {
        self.resumes
    }

    /// The picture does not go on after the halt.
    pub(crate) fn forget_resuming(&mut self) {
        self.resumes = false;
    }

    /// Returns whether the picture goes on as it was before the halt, once.
    pub(crate) fn take_resuming(&mut self) -> bool {
        take(&mut self.resumes)
    }

    pub(crate) fn good(&self) -> Option<&Project> {
        self.good.as_ref()
    }

    pub(crate) fn set_limit(&mut self, limit: Duration) {
        self.limit = limit;
    }

    /// The time that a frame may take.
    pub(crate) fn limit(&self) -> Duration {
        self.allowed.unwrap_or(self.limit)
    }

    pub(crate) fn is_device_gone(&self) -> bool {
        self.is_device_gone
    }

    /// Nothing more is drawn. Returns whether that is news.
    pub(crate) fn lose_device(&mut self) -> bool {
        !replace(&mut self.is_device_gone, true)
    }

    /// Halts the picture. `project`: its program draws.
    pub(crate) fn start(&mut self, halt: Halt, was_playing: bool, project: Option<&Project>) {
        self.resumes |= was_playing;
        self.halt = Some(halt);
        if let Some(project) = project {
            self.marker.set(project);
        }
    }

    /// Holds a project that nothing is drawn of before one plays it.
    pub(crate) fn hold(&mut self, was_playing: bool, after_trouble: bool) {
        self.resumes = was_playing;
        self.halt = Some(Halt::Opened { after_trouble });
    }

    pub(crate) fn end(&mut self) -> Option<Halt> {
        self.halt.take()
    }

    /// Other code or another canvas: its frames take another time.
    pub(crate) fn begin_pace(&mut self) {
        self.pace.begin();
    }

    /// Lets frames take more time than the one that the picture was halted for.
    pub(crate) fn allow_more(&mut self, now: Instant) {
        let Some(taken) = self.frame_time(now) else { return };
        self.pace.begin();
        self.allowed = Some((self.limit() * ALLOWED_LIMITS).max(taken.saturating_mul(ALLOWED_TIMES)));
    }

    /// The time of the frame that the picture was halted for, as far as it is known.
    fn frame_time(&self, now: Instant) -> Option<Duration> {
        match self.halt? {
            Halt::Drawing { since, .. } => Some(now.saturating_duration_since(since)),
            Halt::Drawn { took, .. } => Some(took),
            Halt::Forecast { would_take, .. } => Some(would_take),
            Halt::Opened { .. } => None,
        }
    }

    /// Returns the factor of a side that brings a frame below the limit, by what the one took that the picture was halted
    /// for.
    pub(crate) fn smaller_by(&self, now: Instant) -> f64 {
        let taken = self.frame_time(now).unwrap_or_default();
        let times = taken.as_secs_f64() / self.limit.as_secs_f64().max(1e-3);
        // Half a side is a quarter of the pixels.
        let halvings = (times.max(1.0).log2() / 2.0).ceil().clamp(1.0, 6.0) as i32;
        0.5_f64.powi(halvings)
    }

    /// Returns how long a frame has been drawn, if that is too long.
    pub(crate) fn overdue(&self, now: Instant, draws_since: Option<Instant>) -> Option<Duration> {
        let age = now.saturating_duration_since(draws_since?);
        (age >= self.limit() * self.pace.patience()).then_some(age)
    }

    /// Returns what is done about a frame that is overdue by such an age.
    pub(crate) fn judge_overdue(&self, age: Duration, is_newer_wanted: bool) -> OverdueAction {
        match () {
            () if is_newer_wanted => OverdueAction::MakeRoom,
            () if age >= self.patience() => OverdueAction::GiveUp,
            () => OverdueAction::Wait,
        }
    }

    /// The time after which a device is given up that still draws a frame.
    fn patience(&self) -> Duration {
        self.limit() * if self.is_new { GIVE_UP_NEW } else { GIVE_UP }
    }

    /// Returns when the frame that is being drawn is to be judged next.
    pub(crate) fn deadline(
        &self,
        now: Instant,
        draws_since: Option<Instant>,
        is_newer_wanted: bool,
    ) -> Option<Instant> {
        let since = draws_since?;
        let over = since + self.limit() * self.pace.patience();
        Some(match () {
            () if self.halt.is_none() || now < over => over,
            () if is_newer_wanted => now + LOOK,
            () => since + self.patience(),
        })
    }

    /// Returns whether newer code may take the device of code that does not come back, where so many threads do not.
    pub(crate) fn may_take_device(now: Instant, edited_at: Option<Instant>, lost_threads: usize) -> bool {
        let lost = u32::try_from(lost_threads).unwrap_or(u32::MAX);
        let quiet = edited_at.map_or(Duration::MAX, |at| now.saturating_duration_since(at));
        quiet >= QUIET.saturating_mul(lost)
    }

    /// A frame of the program that draws does not come back. Good code was fast enough until now, and would come to this
    /// again.
    pub(crate) fn give_up_frame(&mut self) {
        if !self.is_new {
            self.good = None;
        }
    }

    /// The device is lost. Returns whether it was opened only just before, with no edit since.
    pub(crate) fn device_is_lost(&mut self, now: Instant, edited_at: Option<Instant>) -> bool {
        let before = self.lost_at.replace(now);
        before.is_some_and(|at| {
            now.saturating_duration_since(at) < LOST_AGAIN && edited_at.is_none_or(|edited| edited <= at)
        })
    }

    /// No frame of the newest code has been drawn yet.
    pub(crate) fn is_new(&self) -> bool {
        self.is_new
    }

    /// Code is about to reach the device. `project`: it is of the newest text.
    pub(crate) fn begin_code(&mut self, project: Option<&Project>) {
        if let Some(project) = project {
            self.marker.set(project);
        }
        self.is_new = true;
        self.pace.begin();
    }

    /// A frame has been drawn. `newest`: by the program of the newest text. `can_halt`: nobody waited for it.
    pub(crate) fn frame_took(&mut self, took: Duration, newest: Option<&Project>, can_halt: bool) -> Verdict {
        let limit = self.limit();
        if self.pace.is_too_slow(took, limit) && can_halt {
            return Verdict::Halt(Halt::Drawn { limit, took });
        }
        if took <= self.limit / 2 {
            self.allowed = None;
        }
        let was_new = take(&mut self.is_new);
        if let Some(project) = newest {
            if was_new {
                self.good = Some(project.clone());
            }
            self.marker.clear();
        }
        if matches!(self.halt, Some(Halt::Drawing { .. })) { Verdict::EndHalt } else { Verdict::GoOn }
    }

    /// The session ends, and no frame with it.
    pub(crate) fn close(&mut self) {
        if self.halt.is_none() {
            self.marker.clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMIT: Duration = Duration::from_secs(2);

    fn control() -> HaltControl {
        HaltControl::new(LIMIT, None)
    }

    #[test]
    fn a_slow_frame_halts_until_more_time_is_allowed() {
        let (mut control, now) = (control(), Instant::now());
        let took = Duration::from_secs(5);
        let Verdict::Halt(halt) = control.frame_took(took, None, true) else { panic!("the first frame is too slow") };
        control.start(halt, true, None);
        assert_eq!((control.halt(), control.smaller_by(now)), (Some(&Halt::Drawn { limit: LIMIT, took }), 0.5));
        control.allow_more(now);
        assert!(control.end().is_some() && control.take_resuming() && !control.take_resuming());
        assert_eq!(control.limit(), Duration::from_secs(15), "three times what it took");
        assert_eq!(control.frame_took(took, None, true), Verdict::GoOn);
        assert_eq!(control.frame_took(LIMIT / 2, None, true), Verdict::GoOn);
        assert_eq!(control.limit(), LIMIT, "it is fast again");
    }

    #[test]
    fn a_device_is_given_up_sooner_for_code_that_drew_before() {
        let (mut control, since) = (control(), Instant::now());
        let at = |secs| since + Duration::from_secs(secs);
        assert_eq!(control.overdue(at(1), Some(since)), None);
        let age = control.overdue(at(10), Some(since)).unwrap();
        assert_eq!(
            [true, false].map(|newer| control.judge_overdue(age, newer)),
            [OverdueAction::MakeRoom, OverdueAction::GiveUp]
        );
        control.begin_code(None);
        assert_eq!(control.judge_overdue(age, false), OverdueAction::Wait);
        assert_eq!(control.deadline(at(0), Some(since), false), Some(at(2)));
        control.start(Halt::Drawing { limit: LIMIT, since }, true, None);
        assert_eq!(control.deadline(at(10), Some(since), false), Some(at(30)));
        assert_eq!(control.frame_took(Duration::ZERO, None, true), Verdict::EndHalt);
    }

    #[test]
    fn a_device_that_is_lost_again_at_once_is_not_opened_again() {
        let (mut control, now) = (control(), Instant::now());
        let at = |secs| now + Duration::from_secs(secs);
        assert!(!control.device_is_lost(now, None) && control.device_is_lost(at(5), None));
        assert!(!control.device_is_lost(at(7), Some(at(6))), "other code");
        assert!(!control.device_is_lost(at(60), Some(at(6))), "long after");
        assert!(HaltControl::may_take_device(now, Some(now), 0) && !HaltControl::may_take_device(now, Some(now), 1));
        assert!(
            HaltControl::may_take_device(at(2), Some(now), 1) && !HaltControl::may_take_device(at(2), Some(now), 2)
        );
    }
}
