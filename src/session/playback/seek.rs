//! Seeking: to an earlier frame, to a time, looping a range, and to the same frame with new code.
//!
//! A project whose passes do not read the last frame has one picture for each time, which is drawn at once. The picture
//! of any other depends on its earlier frames: an earlier frame is drawn again from its recorded inputs, and a later
//! time is reached by drawing every frame on the way, at a fixed step.

use super::Playback;
use crate::drawing::SeekProgress;
use std::{mem::take, time::Instant};

/// The frame of the run to be shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SeekTarget {
    /// This number of frames after the shown one; negative: before it.
    By(i64),
    /// The frame with this number; the run's first is 0.
    Frame(u64),
    /// The last frame whose `iTime` is at most this, in seconds, or the first that can be shown.
    Time(f64),
    /// The same as `Frame`, with a new program: every frame is drawn again from the run's start.
    Redraw(u64),
}

/// The range of frames for seeking.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reach {
    /// The number of frames before the shown one, and after it.
    pub back: u64,
    pub ahead: u64,
    /// `iTime` of the first and the last of them, in seconds.
    pub first_secs: f64,
    pub last_secs: f64,
    /// The number of the shown frame, and whether the inputs of all frames since the last reset are kept.
    pub shown: u64,
    pub is_whole: bool,
}

/// A range of `iTime`, in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeRange {
    pub from: f64,
    pub to: f64,
}

impl TimeRange {
    /// Returns the range between two times in any order. `None` if it is empty.
    pub fn new(a: f64, b: f64) -> Option<TimeRange> {
        let (from, to) = (a.min(b).max(0.0), a.max(b));
        (from.is_finite() && to.is_finite() && from < to).then_some(TimeRange { from, to })
    }
}

#[derive(Default)]
pub(crate) struct Seeking {
    /// The frame to request from the engine.
    pub goal: Option<SeekTarget>,
    /// The request was submitted.
    pub is_under_way: bool,
    /// The project has just been opened: its first program seeks there.
    pub awaits_program: bool,
    /// The frames up to where the project was closed are being drawn.
    pub is_restoring: bool,
    /// `iTime` up to which frames are drawn at a fixed step, once the goal is reached.
    pub until: Option<f64>,
    /// The picture plays after that.
    pub resumes: bool,
    /// The range that is looped.
    pub range: Option<TimeRange>,
    /// A new program draws all frames since the last reset again, from the same inputs.
    pub keeps_inputs: bool,
}

impl Seeking {
    /// Ends a seek at its current position.
    pub(crate) fn cancel(&mut self) {
        (self.goal, self.is_under_way, self.until, self.resumes) = (None, false, None, false);
        (self.awaits_program, self.is_restoring) = (false, false);
    }

    pub(crate) fn is_seeking(&self) -> bool {
        self.goal.is_some() || self.is_under_way || self.until.is_some()
    }
}

impl Playback {
    /// Steps back by a number of frames, and pauses.
    pub(crate) fn step_back(&mut self, by: usize) {
        self.clock.pause();
        self.steps = 0;
        let before = self.take_steps_of_goal();
        self.seeking.goal = Some(SeekTarget::By(before.saturating_sub(i64::try_from(by).unwrap_or(i64::MAX))));
    }

    /// Steps one frame forward: to the next frame of the run after going back, otherwise to a new one. `ahead`: the
    /// number of frames of the run after the shown one.
    pub(crate) fn step_forward(&mut self, ahead: u64) {
        self.clock.pause();
        let before = self.take_steps_of_goal();
        let is_ahead = i64::try_from(ahead).is_ok_and(|ahead| ahead > before);
        if self.steps == 0 && is_ahead && !self.is_frame_due {
            self.seeking.goal = Some(SeekTarget::By(before + 1));
        } else {
            self.steps = self.steps.saturating_add(1);
        }
    }

    /// Returns the requested steps that are still pending.
    fn take_steps_of_goal(&mut self) -> i64 {
        let goal = self.seeking.goal;
        self.seeking.cancel();
        if let Some(SeekTarget::By(frames)) = goal { frames } else { 0 }
    }

    /// Shows the picture, or the recording that plays, at a time. Playing or paused is unchanged. Returns whether frames
    /// are drawn from the start, which requires a reset of the buffers.
    pub(crate) fn seek(&mut self, secs: f64, reach: Reach, has_state: bool) -> bool {
        if self.is_replaying() {
            self.seek_in_replay(secs, reach);
            return false;
        }
        let resumes = self.is_playing();
        self.seeking.cancel();
        self.steps = 0;
        if !has_state {
            self.clock.jump(secs);
            self.is_frame_due = true;
            return false;
        }
        self.clock.pause();
        let is_from_reset = self.clock.next_frame_number() == 0 || secs < reach.first_secs;
        if is_from_reset {
            self.reset();
        } else {
            self.seeking.goal = Some(SeekTarget::Time(secs));
        }
        self.seeking.until = (is_from_reset || secs > reach.last_secs).then_some(secs);
        self.seeking.resumes = resumes;
        is_from_reset
    }

    /// Draws all frames since the reset again, up to the one with this number.
    pub(crate) fn redraw_run(&mut self, shown: u64) {
        let resumes = self.is_playing();
        self.seeking.cancel();
        self.stop();
        self.seeking.goal = Some(SeekTarget::Redraw(shown));
        self.seeking.resumes = resumes;
    }

    /// The first program draws the frames of an earlier run, up to the one with this number.
    pub(crate) fn restore_run(&mut self, last: u64) {
        self.seeking.goal = Some(SeekTarget::Redraw(last));
        (self.seeking.awaits_program, self.seeking.is_restoring) = (true, true);
    }

    /// Returns the start of the looped range if the next frame would not be before its end. A recording is not looped.
    pub(crate) fn loop_start(&self, now: Instant) -> Option<f64> {
        let range = self.seeking.range.filter(|_| !self.is_replaying())?;
        (self.is_running() && self.clock.running_time(now) >= range.to).then_some(range.from)
    }

    /// Returns whether there is a frame to request from the engine now.
    pub(crate) fn is_goal_due(&self) -> bool {
        self.seeking.goal.is_some() && !self.seeking.awaits_program
    }

    /// Returns the frame to request from the engine, once.
    pub(crate) fn take_goal(&mut self) -> Option<SeekTarget> {
        let goal = self.seeking.goal.take();
        self.seeking.is_under_way |= goal.is_some();
        goal
    }

    /// The engine shows another frame of the run, with the number `shown`. Returns whether that is the goal.
    pub(crate) fn travelled(&mut self, travelled: &SeekProgress, shown: u64) -> bool {
        let is_wanted = take(&mut self.seeking.is_under_way);
        self.forget_due_frames();
        self.clock.go_to(travelled.inputs.frame, travelled.inputs.time_secs);
        if let Some(playing) = &mut self.replay.playing {
            playing.go_to(shown);
        }
        if self.seeking.goal.is_some() || !is_wanted {
            return false;
        }
        if travelled.left > 0 {
            self.seeking.goal = Some(SeekTarget::Frame(travelled.goal));
            return false;
        }
        // With its own canvas size the picture was different. The last run of the project may have ended with values
        // that were not saved.
        let is_outdated = self.seeking.is_restoring && travelled.has_other_values;
        self.is_redraw_due = travelled.is_display_new || is_outdated;
        self.arrive();
        true
    }

    /// The goal is out of reach: the shown frame stays.
    pub(crate) fn abandon_seek(&mut self) {
        self.seeking.cancel();
        self.forget_due_frames();
    }

    /// Returns whether a frame at a fixed step is due: a single step, or one before the goal of a seek.
    pub(crate) fn take_step(&mut self) -> bool {
        if let Some(until) = self.seeking.until.filter(|_| !self.seeking.is_under_way) {
            let half = 0.5 / self.clock.step_rate();
            // Stops at the nearest frame.
            if self.clock.next_frame_number() == 0 || self.clock.time_secs() + half <= until {
                return true;
            }
            self.seeking.until = None;
            self.arrive();
        }
        let is_due = self.steps > 0;
        self.steps = self.steps.saturating_sub(1);
        is_due
    }

    fn arrive(&mut self) {
        self.seeking.is_restoring = false;
        if self.seeking.until.is_none() && take(&mut self.seeking.resumes) {
            self.resume();
        }
    }

    pub(crate) fn is_seeking(&self) -> bool {
        self.seeking.is_seeking()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_range_accepts_either_order() {
        assert_eq!(TimeRange::new(3.0, 1.5), Some(TimeRange { from: 1.5, to: 3.0 }));
        assert_eq!(TimeRange::new(-2.0, 1.0), Some(TimeRange { from: 0.0, to: 1.0 }));
        for (a, b) in [(1.0, 1.0), (-3.0, -1.0), (f64::NAN, 2.0), (0.0, f64::INFINITY)] {
            assert_eq!(TimeRange::new(a, b), None, "{a} to {b}");
        }
    }
    /// A run of frames from 0 to 9 at 60 per second, paused at the one with this number.
    fn paused_at(shown: u64) -> (Playback, Reach) {
        let mut playback = Playback::default();
        playback.clock.go_to(shown as i32, shown as f64 / 60.0);
        let (back, ahead) = (shown, 9 - shown);
        (playback, Reach { back, ahead, first_secs: 0.0, last_secs: 9.0 / 60.0, shown, is_whole: true })
    }

    #[test]
    fn steps_follow_the_run_before_drawing_new_frames() {
        let (mut playback, reach) = paused_at(7);
        playback.step_back(2);
        playback.step_back(1);
        assert_eq!(playback.take_goal(), Some(SeekTarget::By(-3)));
        assert!(playback.take_goal().is_none() && playback.is_seeking());
        let (mut playback, _) = paused_at(7);
        (0..2).for_each(|_| playback.step_forward(reach.ahead));
        assert_eq!(playback.take_goal(), Some(SeekTarget::By(2)));
        assert!(!playback.take_step(), "the goal is being reached");
        let (mut playback, reach) = paused_at(9);
        playback.step_forward(reach.ahead);
        assert!(playback.take_goal().is_none() && playback.take_step() && !playback.take_step());
    }

    #[test]
    fn restored_run_waits_for_the_first_program() {
        let mut playback = Playback::default();
        playback.restore_run(41);
        assert!(playback.is_seeking() && !playback.is_goal_due());
        playback.on_program_installed();
        assert!(playback.is_goal_due());
        assert_eq!(playback.take_goal(), Some(SeekTarget::Redraw(41)));
    }

    #[test]
    fn seek_jumps_travels_or_draws_frames() {
        let (mut playback, reach) = paused_at(5);
        assert!(!playback.seek(2.0, reach, false) && playback.take_goal().is_none());
        assert_eq!(playback.clock.time_secs(), 2.0, "a picture without a state has one for each time");
        let (mut playback, reach) = paused_at(5);
        assert!(!playback.seek(0.05, reach, true));
        assert_eq!((playback.take_goal(), playback.seeking.until), (Some(SeekTarget::Time(0.05)), None));
        let (mut playback, reach) = paused_at(5);
        playback.play();
        assert!(!playback.seek(0.5, reach, true) && playback.is_playing() && !playback.clock.is_playing());
        assert_eq!((playback.take_goal(), playback.seeking.until), (Some(SeekTarget::Time(0.5)), Some(0.5)));
        let late = Reach { first_secs: 0.05, ..reach };
        assert!(playback.seek(0.01, late, true), "from the beginning");
        assert_eq!((playback.clock.next_frame_number(), playback.seeking.until), (0, Some(0.01)));
    }
}
