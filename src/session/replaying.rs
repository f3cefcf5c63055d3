//! A session plays a recording in the open project: every frame gets its recorded time, date, mouse, keys, canvas and
//! values of uniforms, from frame 0 on, and is drawn as [`super::offline`] draws it.
//!
//! Input on the picture does not reach it meanwhile. A person takes over by [`Command::StopReplay`]: the
//! picture goes on live from the frame that is shown. Nothing of the project is changed by it: canvas and values are
//! the recording's until the picture is reset, or another size is asked for.
//!
//! [`Command::StopReplay`]: super::Command::StopReplay

use super::{
    Session,
    replay::{Playing, Reading, ReplayView, name},
    seeking::Goal,
    view::{About, Level},
};
use eddy_engine::FrameInputs;
use std::{path::PathBuf, time::Instant};

impl Session {
    /// Returns what is known of the recording that is played, while one is.
    pub fn replay(&self) -> Option<ReplayView> {
        self.run.replay.playing.as_ref().map(Playing::view)
    }

    pub(super) fn is_replaying(&self) -> bool {
        self.run.replay.playing.is_some()
    }

    /// Returns when the next frame of the recording that is played is due.
    pub(super) fn replay_due(&self) -> Option<Instant> {
        let playing = self.run.replay.playing.as_ref()?;
        Some(playing.due_at(self.now, self.run.clock.speed()))
    }

    /// Reads a recording, which is played when it is there.
    pub(super) fn play_recording(&mut self, file: PathBuf) {
        self.settled(About::Replay);
        let file = std::path::absolute(&file).unwrap_or(file);
        match Reading::begin(file, self.wake.clone()) {
            Ok(reading) => self.run.replay.reading = Some(reading),
            Err(e) => {
                self.notice_about(About::Replay, Level::Error, format!("cannot start a thread for reading: {e}"));
            }
        }
    }

    /// Begins with a recording that has been read.
    pub(super) fn take_recording(&mut self) {
        let Some(read) = self.run.replay.reading.as_ref().and_then(Reading::take) else { return };
        let Some(Reading { file, .. }) = self.run.replay.reading.take() else { return };
        let recording = match read {
            Ok(recording) => recording,
            Err(error) => {
                let text = format!("cannot play {}: {error}; {}", file.display(), error.remedy());
                self.notice_with_path(About::Replay, Level::Error, text, file);
                return;
            }
        };
        self.end_recording();
        self.stop_replay();
        let here = self.project().name.clone();
        if !recording.project.is_empty() && recording.project != here {
            let text = format!(
                "{} was recorded in the project \"{}\", but \"{here}\" is open: the picture may differ from the \
                 recorded one. Open \"{}\" and play it there to see the same picture",
                name(&file),
                recording.project,
                recording.project
            );
            self.notice_about(About::Replay, Level::Warning, text);
        }
        self.override_halt();
        self.reset();
        self.release_inputs();
        self.run.clock.play();
        self.run.replay.playing = Some(Playing::new(file, recording));
        self.changed = true;
    }

    /// Nothing is held any more: what is pressed when a recording begins is not in it.
    fn release_inputs(&mut self) {
        self.run.mouse.release();
        self.run.keyboard.release_all();
    }

    /// Ends the recording that is played at the frame that is shown. The picture goes on from it as it was: playing or
    /// paused.
    pub(super) fn stop_replay(&mut self) -> Option<ReplayView> {
        let playing = self.run.replay.playing.take()?;
        let view = playing.view();
        if let Some(frame) = playing.newest().filter(|_| view.drawn > 0) {
            // What the hand does next begins where the recorded one was.
            self.run.mouse.follow(frame.inputs.mouse, frame.inputs.drag);
            self.run.keyboard = frame.inputs.keyboard.clone();
            self.release_inputs();
        }
        self.run.clock.rebase();
        self.run.fps.restart();
        self.changed = true;
        Some(view)
    }

    /// The same, and says so.
    pub(super) fn end_replay(&mut self, why: &str) {
        if let Some(ReplayView { file, drawn, frames }) = self.stop_replay() {
            let text = format!("stopped {} at frame {drawn} of {frames}: {why}", name(&file));
            self.notice_about(About::Replay, Level::Info, text);
        }
    }

    /// The last frame has been handed in: the picture stays there.
    fn replay_is_over(&mut self) {
        let Some(ReplayView { file, frames, .. }) = self.stop_replay() else { return };
        self.run.seeking.cancel();
        self.run.steps = 0;
        self.run.clock.pause();
        let text = format!(
            "{} ended: the picture is paused at frame {frames} of {frames}. Press Play to continue live from there",
            name(&file)
        );
        self.notice_about(About::Replay, Level::Info, text);
    }

    /// Returns the frame of the recording that is due now. `is_step`: one is asked for, whatever the time.
    pub(super) fn next_replayed(&mut self, is_step: bool) -> Option<FrameInputs> {
        // Nothing that a hand does forces a frame.
        self.run.is_frame_due = false;
        let is_running = self.run.clock.is_playing() && !self.run.is_covered;
        if !is_step && (!is_running || self.gives_way()) {
            return None;
        }
        let (now, speed) = (self.now, self.run.clock.speed());
        let is_compiling = self.is_compile_under_way();
        let playing = self.run.replay.playing.as_mut()?;
        // The first frame is drawn by the newest text: what follows depends on it.
        let is_early = playing.is_at_start() && is_compiling;
        if is_early || !(is_step || playing.is_due(now, speed)) {
            return None;
        }
        let (frame, change) = playing.take(now)?;
        let is_over = playing.is_over();
        if let Some(size) = change.size {
            self.canvas.replayed = Some(size);
            self.fit_canvas();
        }
        if let Some(values) = change.values {
            self.drawing.wanted.custom_uniforms = Some(values);
            self.run.replay.has_values = true;
        }
        self.drawing.wanted.reset |= change.reset;
        self.run.replay.follows = true;
        self.run.is_again_due = false;
        let inputs = frame.inputs;
        self.run.clock.draw(inputs.frame, inputs.time_secs, inputs.frame_rate);
        self.changed = true;
        if is_over {
            self.replay_is_over();
        }
        Some(inputs)
    }

    /// Gives the engine the project's own values again, before a frame that is not the recording's.
    pub(super) fn take_values_back(&mut self) {
        if self.run.replay.has_values && !self.is_replaying() {
            self.custom_uniforms_turned();
            self.run.replay.follows = true;
        }
    }

    /// Shows the recording at a time.
    pub(super) fn seek_in_replay(&mut self, secs: f64) {
        let (resumes, reach) = (self.is_playing(), self.drawing.reach());
        let is_at_start = self.run.replay.playing.as_ref().is_some_and(Playing::is_at_start);
        self.run.seeking.cancel();
        self.run.steps = 0;
        self.run.clock.pause();
        if !is_at_start {
            self.run.seeking.goal = Some(Goal::Time(secs));
        }
        self.run.seeking.until = (is_at_start || secs > reach.last_secs).then_some(secs);
        self.run.seeking.resumes = resumes;
    }

    /// The engine shows another frame of the run: the recording goes on after it.
    pub(super) fn replay_travelled(&mut self) {
        let shown = self.drawing.reach().shown;
        if let Some(playing) = &mut self.run.replay.playing {
            playing.go_to(shown);
        }
    }
}
