//! Seeking: to a frame that was drawn before, to a time, round and round a range, and to the same frame by new code.
//!
//! A project whose passes read nothing of the last frame has a picture for each time, which is drawn at once. Any other
//! is where its frames have brought it: one that was drawn is drawn again from the inputs that it had, and a later time
//! is reached by drawing every frame on the way, at a fixed step.

use super::{
    Session,
    drawing::{Job, Travelled},
    seeking::{Goal, Reach, TimeRange},
    view::{About, Level},
};
use eddy_engine::EngineError;

impl Session {
    /// Shows the frame that is so many before the one that is shown, and pauses.
    pub(super) fn step_back(&mut self, by: usize) {
        self.settled(About::Seeking);
        self.override_halt();
        self.run.clock.pause();
        self.run.steps = 0;
        let by = i64::try_from(by).unwrap_or(i64::MAX);
        let before = match self.run.seeking.goal {
            Some(Goal::By(frames)) => frames,
            _ => 0,
        };
        self.run.seeking.cancel();
        self.run.seeking.goal = Some(Goal::By(before.saturating_sub(by)));
    }

    /// One frame further: the next one of the run, where one has gone back, else a new one.
    pub(super) fn step_forward(&mut self) {
        self.settled(About::Seeking);
        self.override_halt();
        self.run.clock.pause();
        let before = match self.run.seeking.goal {
            Some(Goal::By(frames)) => frames,
            _ => 0,
        };
        self.run.seeking.cancel();
        let is_ahead = i64::try_from(self.drawing.reach().ahead).is_ok_and(|ahead| ahead > before);
        if self.run.steps == 0 && is_ahead && !self.run.is_frame_due {
            self.run.seeking.goal = Some(Goal::By(before + 1));
        } else {
            self.run.steps = self.run.steps.saturating_add(1);
        }
    }

    /// Shows the picture at a time, in seconds. Playing or paused stays as it is.
    pub(super) fn seek(&mut self, secs: f64) {
        if !secs.is_finite() {
            return;
        }
        let secs = secs.max(0.0);
        self.settled(About::Seeking);
        self.override_halt();
        // What is recorded is a run without a break.
        self.end_recording();
        if self.is_replaying() {
            return self.seek_in_replay(secs);
        }
        let resumes = self.is_playing();
        self.run.seeking.cancel();
        self.run.steps = 0;
        if !self.has_state() {
            self.run.clock.jump(secs);
            self.run.is_frame_due = true;
            return;
        }
        let reach = self.drawing.reach();
        self.run.clock.pause();
        if self.run.clock.next_frame_number() == 0 || secs < reach.first_secs {
            self.reset();
            self.run.seeking.until = Some(secs);
        } else {
            self.run.seeking.goal = Some(Goal::Time(secs));
            self.run.seeking.until = (secs > reach.last_secs).then_some(secs);
        }
        self.run.seeking.resumes = resumes;
    }

    /// Goes back to the beginning of the range that is played where its end has come.
    pub(super) fn loop_range(&mut self) {
        let Some(range) = self.run.seeking.range else { return };
        if self.run.clock.is_playing() && !self.run.is_covered && self.run.clock.time_secs() >= range.to {
            self.seek(range.from);
        }
    }

    /// Hands in the frame that is to be shown. False where there is none, or nothing to draw it.
    pub(super) fn travel(&mut self) -> bool {
        let is_ready = self.drawing.has_program() && !self.drawing.wanted.restart;
        if self.run.seeking.goal.is_none() || self.drawing.is_program_coming() || self.run.seeking.awaits_program {
            return false;
        }
        let goal = self.run.seeking.goal.take();
        if !is_ready {
            self.run.seeking.cancel();
            return false;
        }
        self.end_recording();
        self.run.seeking.is_under_way = true;
        self.drawing.submit(self.now, false, |job: &mut Job| job.travel = goal);
        true
    }

    /// The engine shows another frame of the run, or cannot.
    pub(super) fn travelled(&mut self, travelled: Option<Result<Travelled, EngineError>>) {
        self.changed = true;
        (self.run.is_frame_due, self.run.is_again_due) = (false, false);
        let is_wanted = std::mem::take(&mut self.run.seeking.is_under_way);
        match travelled {
            Some(Ok(Travelled { inputs, goal, left, is_display_new })) => {
                self.picture_is_other();
                self.run.clock.go_to(inputs.frame, inputs.time_secs);
                self.replay_travelled();
                if self.run.seeking.goal.is_some() || !is_wanted {
                    return;
                }
                if left > 0 {
                    self.run.seeking.goal = Some(Goal::Frame(goal));
                } else {
                    self.run.measuring.go_to(inputs.frame);
                    // On its own canvas it was another picture.
                    self.run.is_again_due = is_display_new;
                    self.arrive();
                }
            }
            Some(Err(error)) => {
                self.run.seeking.cancel();
                self.stop_drawing(&error);
            }
            None => {
                self.run.seeking.cancel();
                let text = match self.drawing.reach().back {
                    0 => "there is no earlier frame: an edit, a reset or a change of resolution restarts at frame 0"
                        .to_owned(),
                    back => format!("that frame is out of reach: you can go back {back} frames"),
                };
                self.notice_about(About::Seeking, Level::Warning, text);
            }
        }
    }

    /// Returns whether one more frame at a fixed step is due before the time that is sought.
    pub(super) fn is_step_due(&mut self) -> bool {
        let Some(until) = self.run.seeking.until.filter(|_| !self.run.seeking.is_under_way) else { return false };
        let half = 0.5 / self.run.clock.step_rate();
        // The frame that is nearest to it.
        let is_due = self.run.clock.next_frame_number() == 0 || self.run.clock.time_secs() + half <= until;
        if !is_due {
            self.run.seeking.until = None;
            self.arrive();
        }
        is_due
    }

    fn arrive(&mut self) {
        self.run.seeking.is_taking_up = false;
        if self.run.seeking.until.is_none() && std::mem::take(&mut self.run.seeking.resumes) {
            self.run.clock.play();
            self.run.fps.restart();
        }
    }

    /// A new program draws: by the same inputs up to the same frame, where that is asked for.
    pub(super) fn keep_inputs(&mut self) {
        let reach = self.drawing.reach();
        if !self.keeps_inputs_of(reach) {
            return;
        }
        if !reach.is_whole {
            self.notice(
                Level::Info,
                "not all frames since the last reset are kept: reset once, then edits replay to the same frame",
            );
            return;
        }
        let resumes = self.is_playing();
        self.run.seeking.cancel();
        self.run.clock.pause();
        (self.run.is_frame_due, self.run.is_again_due) = (false, false);
        self.run.seeking.goal = Some(Goal::Anew(reach.shown));
        self.run.seeking.resumes = resumes;
    }

    fn keeps_inputs_of(&self, reach: Reach) -> bool {
        self.run.seeking.keeps_inputs && reach.shown > 0 && self.has_state()
    }

    /// A program that is coming draws all frames since the reset.
    pub(super) fn draws_all_anew(&self) -> bool {
        let reach = self.drawing.reach();
        self.drawing.wanted.program.is_some() && reach.is_whole && self.keeps_inputs_of(reach)
    }

    pub(super) fn has_state(&self) -> bool {
        // A project that was opened paused has no program yet.
        let project = self.drawing.project().unwrap_or_else(|| self.documents.current());
        !project.stateful_passes().is_empty()
    }

    /// Time runs, or will once the time that is sought is reached.
    pub(super) fn is_playing(&self) -> bool {
        self.run.clock.is_playing() || self.run.seeking.resumes
    }

    /// Returns the frames that one can go to without drawing new ones.
    pub fn reach(&self) -> Reach {
        self.drawing.reach()
    }

    /// Returns the range that is played again and again.
    pub fn time_range(&self) -> Option<TimeRange> {
        self.run.seeking.range
    }

    /// Returns whether new code draws the frames since the last reset again, from the same inputs.
    pub fn keeps_inputs(&self) -> bool {
        self.run.seeking.keeps_inputs
    }
}
