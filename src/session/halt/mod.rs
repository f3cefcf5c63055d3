//! Frames that take too long, and devices that do not respond.
//!
//! Owns the rules: when the picture halts, how it resumes, and when a device is replaced by a new one
//! ([`HaltControl`]). `actions` applies them to the session. The texts are never changed.

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

/// A device that is still drawing a frame is abandoned after this many frame limits.
const ABANDON_AFTER: u32 = 5;
/// The same for new code, which drivers compile in its first frame: many passes take seconds on a busy processor.
const ABANDON_NEW_AFTER: u32 = 15;
/// A frame that the user allows to continue may take this many limits, or this many times what it has taken.
const ALLOWED_LIMITS: u32 = 5;
const ALLOWED_TIMES: u32 = 3;
/// A device that is lost again within this time, with no edit in between, is not reopened.
const LOST_AGAIN: Duration = Duration::from_secs(10);
/// The debounce time before newer code takes over the device of hung code, for each thread that has been abandoned
/// already: each may keep a processor busy.
const QUIET: Duration = Duration::from_millis(1500);
/// The interval of checks whether that time has passed.
const LOOK: Duration = Duration::from_millis(100);

/// The current halt of the picture, if any, and statistics of its frames.
#[derive(Default)]
pub(super) struct HaltControl {
    halt: Option<Halt>,
    /// The picture was playing when it was halted, and resumes afterwards.
    resumes: bool,
    /// The newest code that drew a frame within the limit.
    good: Option<Project>,
    limit: Duration,
    pace: Pace,
    /// The frame time that the user has allowed.
    allowed: Option<Duration>,
    /// The newest program that was submitted has not drawn a frame yet.
    is_new: bool,
    marker: Marker,
    lost_at: Option<Instant>,
    /// The device is lost for good.
    is_device_gone: bool,
}

/// The consequence of a drawn frame.
#[derive(Debug, PartialEq)]
pub(super) enum Verdict {
    Halt(Halt),
    /// The picture had been halted while the frame was drawn.
    EndHalt,
    GoOn,
}

/// The consequence of a frame that is taking too long.
#[derive(Debug, PartialEq)]
pub(super) enum OverdueAction {
    Wait,
    /// Newer code gets the device of the old code, if it may take it yet.
    MakeRoom,
    AbandonDevice,
}

impl HaltControl {
    pub(crate) fn new(limit: Duration, state_dir: Option<&Path>) -> Self {
        Self { limit, marker: Marker::new(state_dir), ..Self::default() }
    }

    /// The halt of another project. `is_overdue`: the device still draws a frame of this one.
    pub(crate) fn successor(&mut self, is_overdue: bool) -> Self {
        if self.halt.is_none() && !is_overdue {
            self.marker.clear();
        } else {
            self.marker.leave();
        }
        Self {
            limit: self.limit,
            marker: take(&mut self.marker),
            is_device_gone: self.is_device_gone,
            ..Self::default()
        }
    }

    /// Returns whether a project hung or crashed the process when it was last open.
    pub(crate) fn found_marker_of(&mut self, project: &Project) -> bool {
        self.marker.find(project)
    }

    pub(crate) fn halt(&self) -> Option<&Halt> {
        self.halt.as_ref()
    }

    pub(crate) fn is_halted(&self) -> bool {
        self.halt.is_some()
    }

    /// Returns whether no code of the author may reach the device yet.
    pub(crate) fn is_held(&self) -> bool {
        matches!(self.halt, Some(Halt::Opened { .. }))
    }

    /// Returns whether the picture resumes once it is drawn fast enough.
    pub(crate) fn resumes(&self) -> bool {
        self.resumes
    }

    /// Cancels resuming after the halt.
    pub(crate) fn forget_resuming(&mut self) {
        self.resumes = false;
    }

    /// Returns whether the picture resumes as before the halt, once.
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

    /// Stops all drawing for good. Returns whether the device was still in use.
    pub(crate) fn lose_device(&mut self) -> bool {
        !replace(&mut self.is_device_gone, true)
    }

    /// Halts the picture. `project`: the project of the program that draws.
    pub(crate) fn start(&mut self, halt: Halt, was_playing: bool, project: Option<&Project>) {
        self.resumes |= was_playing;
        self.halt = Some(halt);
        if let Some(project) = project {
            self.marker.set(project);
        }
    }

    /// Holds a project, of which nothing is drawn before the user plays it.
    pub(crate) fn hold(&mut self, was_playing: bool, after_trouble: bool) {
        self.resumes = was_playing;
        self.halt = Some(Halt::Opened { after_trouble });
    }

    pub(crate) fn end(&mut self) -> Option<Halt> {
        self.halt.take()
    }

    /// Resets the statistics: frames of other code or another canvas take a different time.
    pub(crate) fn reset_pace(&mut self) {
        self.pace.reset();
    }

    /// Allows frames to take longer than the one for which the picture was halted.
    pub(crate) fn allow_more(&mut self, now: Instant) {
        let Some(taken) = self.frame_time(now) else { return };
        self.pace.reset();
        self.allowed = Some((self.limit() * ALLOWED_LIMITS).max(taken.saturating_mul(ALLOWED_TIMES)));
    }

    /// The time of the frame for which the picture was halted, as far as it is known.
    fn frame_time(&self, now: Instant) -> Option<Duration> {
        match self.halt? {
            Halt::Drawing { since, .. } => Some(now.saturating_duration_since(since)),
            Halt::Drawn { took, .. } => Some(took),
            Halt::Forecast { would_take, .. } => Some(would_take),
            Halt::Opened { .. } => None,
        }
    }

    /// Returns the factor of a side that brings a frame below the limit, judging by the time of the frame for which the
    /// picture was halted.
    pub(crate) fn smaller_by(&self, now: Instant) -> f64 {
        let taken = self.frame_time(now).unwrap_or_default();
        let times = taken.as_secs_f64() / self.limit.as_secs_f64().max(1e-3);
        // Half the side is a quarter of the pixels.
        let halvings = (times.max(1.0).log2() / 2.0).ceil().clamp(1.0, 6.0) as i32;
        0.5_f64.powi(halvings)
    }

    /// Returns how long a frame has been drawn, if that is too long.
    pub(crate) fn overdue(&self, now: Instant, draws_since: Option<Instant>) -> Option<Duration> {
        let age = now.saturating_duration_since(draws_since?);
        (age >= self.limit() * self.pace.patience()).then_some(age)
    }

    /// Returns what to do about an overdue frame, given how long it has been drawn.
    pub(crate) fn judge_overdue(&self, age: Duration, is_newer_wanted: bool) -> OverdueAction {
        match () {
            () if is_newer_wanted => OverdueAction::MakeRoom,
            () if age >= self.patience() => OverdueAction::AbandonDevice,
            () => OverdueAction::Wait,
        }
    }

    /// The time after which a device that is still drawing a frame is abandoned.
    fn patience(&self) -> Duration {
        self.limit() * if self.is_new { ABANDON_NEW_AFTER } else { ABANDON_AFTER }
    }

    /// Returns when to judge the frame in progress next.
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

    /// Returns whether newer code may take over the device of hung code, given the number of hung threads.
    pub(crate) fn may_take_device(now: Instant, edited_at: Option<Instant>, lost_threads: usize) -> bool {
        let lost = u32::try_from(lost_threads).unwrap_or(u32::MAX);
        let quiet = edited_at.map_or(Duration::MAX, |at| now.saturating_duration_since(at));
        quiet >= QUIET.saturating_mul(lost)
    }

    /// Records that a frame of the current program hangs. Code that was good until now would hang again.
    pub(crate) fn abandon_frame(&mut self) {
        if !self.is_new {
            self.good = None;
        }
    }

    /// Records the loss of the device. Returns whether it was opened only just before, with no edit since.
    pub(crate) fn device_is_lost(&mut self, now: Instant, edited_at: Option<Instant>) -> bool {
        let before = self.lost_at.replace(now);
        before.is_some_and(|at| {
            now.saturating_duration_since(at) < LOST_AGAIN && edited_at.is_none_or(|edited| edited <= at)
        })
    }

    /// Returns whether the newest code has not drawn a frame yet.
    pub(crate) fn is_new(&self) -> bool {
        self.is_new
    }

    /// Code is about to reach the device. `project`: set if it is of the newest text.
    pub(crate) fn on_new_code(&mut self, project: Option<&Project>) {
        if let Some(project) = project {
            self.marker.set(project);
        }
        self.is_new = true;
        self.pace.reset();
    }

    /// Records a drawn frame. `newest`: set if it is by the program of the newest text. `can_halt`: the session
    /// did not block on it.
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

    /// The session ends without a hung frame: removes the marker, unless the picture is halted.
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
    fn device_is_abandoned_sooner_for_code_that_drew_before() {
        let (mut control, since) = (control(), Instant::now());
        let at = |secs| since + Duration::from_secs(secs);
        assert_eq!(control.overdue(at(1), Some(since)), None);
        let age = control.overdue(at(10), Some(since)).unwrap();
        assert_eq!(
            [true, false].map(|newer| control.judge_overdue(age, newer)),
            [OverdueAction::MakeRoom, OverdueAction::AbandonDevice]
        );
        control.on_new_code(None);
        assert_eq!(control.judge_overdue(age, false), OverdueAction::Wait);
        assert_eq!(control.deadline(at(0), Some(since), false), Some(at(2)));
        control.start(Halt::Drawing { limit: LIMIT, since }, true, None);
        assert_eq!(control.deadline(at(10), Some(since), false), Some(at(30)));
        assert_eq!(control.frame_took(Duration::ZERO, None, true), Verdict::EndHalt);
    }

    #[test]
    fn device_lost_again_at_once_is_not_reopened() {
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
