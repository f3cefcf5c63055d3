//! Playing, pausing, seeking, recording and replaying: [`Playback`](super::playback) decides how, and this module
//! applies the consequences to the picture, the canvas and the notices.

use super::{
    Session,
    command::TransportCommand,
    drawing::{Change, Draw, Job, SeekProgress},
    open_project::OpenProject,
    playback::{Reach, Recorder, ReplayView, ReplayedFrame, TimeRange, name},
    view::{About, Level},
};
use eddy_engine::{EngineError, FrameInputs};
use eddy_playback::{capture, recording::EXTENSION};
use std::path::PathBuf;

impl Session {
    /// Submits the seek. Returns false if there is none, or no program to draw it.
    pub(super) fn travel(&mut self) -> bool {
        if !self.open.playback.is_goal_due() || self.open.is_program_coming() {
            return false;
        }
        if !self.open.engine.has_program() || self.open.changes.has(&Change::Restart) {
            self.open.playback.seeking.cancel();
            return false;
        }
        self.open.end_recording();
        let Some(goal) = self.open.playback.take_goal() else { return false };
        self.submit(false, Job { draw: Draw::Seek(goal), ..Job::default() });
        true
    }

    /// Handles the result of a seek: another frame of the run is shown, or it is out of reach.
    pub(super) fn travelled(&mut self, travelled: Option<Result<SeekProgress, EngineError>>) {
        self.open.host.changed = true;
        let reach = self.open.engine.reach();
        match travelled {
            Some(Ok(travelled)) => {
                self.open.on_picture_changed();
                if self.open.playback.travelled(&travelled, reach.shown) {
                    self.open.read_backs.measurements.go_to(travelled.inputs.frame);
                }
            }
            Some(Err(error)) => {
                self.open.playback.seeking.cancel();
                self.stop_drawing(&error);
            }
            None => {
                self.open.playback.abandon_seek();
                let text = match reach.back {
                    0 => "there is no earlier frame: an edit, a reset or a change of resolution restarts at frame 0"
                        .to_owned(),
                    back => format!("that frame is out of reach: you can go back {back} frames"),
                };
                self.open.notice_about(About::Seeking, Level::Warning, text);
            }
        }
    }

    /// Returns the range of frames for seeking without drawing new ones.
    pub fn reach(&self) -> Reach {
        self.open.engine.reach()
    }

    /// Returns the range that is looped.
    pub fn time_range(&self) -> Option<TimeRange> {
        self.open.playback.seeking.range
    }

    /// Returns whether new code draws the frames since the last reset again, from the same inputs.
    pub fn keeps_inputs(&self) -> bool {
        self.open.playback.seeking.keeps_inputs
    }

    /// Returns how many frames have been recorded, if a recording is being made.
    pub fn recorded_frames(&self) -> Option<usize> {
        self.open.playback.recorder.as_ref().map(|recorder| recorder.recording.frames.len())
    }

    /// Returns the state of the replay, if there is one.
    pub fn replay(&self) -> Option<ReplayView> {
        self.open.playback.replay.playing.as_ref().map(|playing| playing.view())
    }

    /// Starts a replay of a recording that was loaded.
    pub(super) fn take_recording(&mut self) {
        let Some((file, read)) = self.open.playback.take_recording() else { return };
        let recording = match read {
            Ok(recording) => recording,
            Err(error) => {
                let text = format!("cannot play {}: {error}; {}", file.display(), error.remedy());
                self.open.notice_with_path(About::Replay, Level::Error, text, file);
                return;
            }
        };
        self.open.end_recording();
        self.cut_film("a recording of input is played");
        self.open.playback.stop_replay();
        let here = self.project().name.clone();
        if !recording.project.is_empty() && recording.project != here {
            let text = format!(
                "{} was recorded in the project \"{}\", but \"{here}\" is open: the picture may differ from the \
                 recorded one. Open \"{}\" and play it there to see the same picture",
                name(&file),
                recording.project,
                recording.project
            );
            self.open.notice_about(About::Replay, Level::Warning, text);
        }
        self.open.override_halt();
        self.open.reset();
        self.open.playback.start_replay(file, recording);
        self.open.host.changed = true;
    }
}

impl OpenProject {
    pub(super) fn apply_transport(&mut self, command: TransportCommand) {
        match command {
            TransportCommand::Play => self.play(),
            TransportCommand::Pause => self.pause(),
            TransportCommand::TogglePlay if self.is_playing() => self.pause(),
            TransportCommand::TogglePlay => self.play(),
            TransportCommand::Step => self.step_forward(),
            TransportCommand::StepBack(by) => self.step_back(by),
            TransportCommand::Seek(secs) => self.seek(secs),
            TransportCommand::SetSpeed(speed) => self.playback.clock.set_speed(speed),
            TransportCommand::SetFixedRate(rate) => self.playback.clock.set_fixed_rate(rate),
            TransportCommand::SetTimeRange(range) => self.playback.seeking.range = range,
            TransportCommand::SetKeepInputs(on) => self.playback.seeking.keeps_inputs = on,
            TransportCommand::Reset => self.reset(),
            TransportCommand::Record => self.record(),
            TransportCommand::PlayRecording(file) => self.play_recording(file),
            TransportCommand::StopReplay => self.end_replay("the picture continues live from there"),
        }
    }

    pub(super) fn play(&mut self) {
        self.dismiss_notices(About::Seeking);
        self.override_halt();
        self.playback.play();
    }

    pub(super) fn pause(&mut self) {
        self.halt.forget_resuming();
        self.playback.pause();
    }

    pub(super) fn reset(&mut self) {
        self.reset_buffers();
        self.playback.reset();
    }

    fn reset_buffers(&mut self) {
        self.dismiss_notices(About::Seeking);
        self.end_replay("the picture was reset");
        self.canvas.replayed = None;
        self.restore_values();
        self.changes.set(Change::Reset);
    }

    /// Shows the frame that is this number of frames before the shown one, and pauses.
    pub(super) fn step_back(&mut self, by: usize) {
        self.dismiss_notices(About::Seeking);
        self.override_halt();
        self.playback.step_back(by);
    }

    pub(super) fn step_forward(&mut self) {
        self.dismiss_notices(About::Seeking);
        self.override_halt();
        self.playback.step_forward(self.engine.reach().ahead);
    }

    /// Shows the picture at a time, in seconds. Playing or paused is unchanged.
    pub(super) fn seek(&mut self, secs: f64) {
        if !secs.is_finite() {
            return;
        }
        let secs = secs.max(0.0);
        self.dismiss_notices(About::Seeking);
        self.override_halt();
        // A recording must be a continuous run.
        self.end_recording();
        if self.playback.seek(secs, self.engine.reach(), self.has_state()) {
            self.reset_buffers();
        }
    }

    /// Seeks to the start of the looped range before a frame that would not be before its end. Without a program, time
    /// continues, as there is no frame to go back from.
    pub(super) fn loop_range(&mut self) {
        if let Some(from) = self.playback.loop_start(self.host.now).filter(|_| self.engine.has_program()) {
            self.seek(from);
        }
    }

    /// A new program draws: if enabled, up to the same frame with the same inputs.
    pub(super) fn keep_inputs(&mut self) {
        let reach = self.engine.reach();
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
        self.playback.redraw_run(reach.shown);
    }

    fn keeps_inputs_of(&self, reach: Reach) -> bool {
        self.playback.seeking.keeps_inputs && reach.shown > 0 && self.has_state()
    }

    /// Returns whether a pending program draws all frames since the reset again.
    pub(super) fn redraws_run(&self) -> bool {
        let reach = self.engine.reach();
        self.changes.program().is_some() && reach.is_whole && self.keeps_inputs_of(reach)
    }

    /// Returns whether a move of the pointer is an input: a button is down, or the project's program gives its position
    /// to the shader at all times.
    pub(super) fn follows_pointer(&self) -> bool {
        self.playback.mouse.is_down() || self.documents.current().dialect.row().reads_pointer()
    }

    pub(super) fn has_state(&self) -> bool {
        // A project that was opened paused has no program yet.
        let project = self.engine.project().unwrap_or_else(|| self.documents.current());
        !project.stateful_passes().is_empty()
    }

    pub(super) fn is_playing(&self) -> bool {
        self.playback.is_playing()
    }

    /// Returns whether the shown frame is to be drawn again now, once: no other is due.
    pub(super) fn take_redraw(&mut self) -> bool {
        let is_other_coming = self.changes.has_other_program() || self.changes.size().is_some();
        let is_ready = self.engine.has_program() && !is_other_coming && !self.halt.is_halted();
        is_ready && self.playback.take_redraw()
    }

    /// Returns whether a change of the program or the canvas is followed by the shown frame only.
    pub(super) fn stays(&self) -> bool {
        let restarts = self.changes.has(&Change::Restart)
            || self.changes.has(&Change::Reset)
            || self.compile.resets
            || self.redraws_run();
        self.playback.is_still() && !restarts
    }

    /// The shown frame cannot be drawn again: the next one shows the change.
    pub(super) fn on_redraw_impossible(&mut self) {
        self.playback.is_frame_due = true;
        if self.has_state() {
            let text = "the buffers are too large to be kept: a change while paused draws one frame more";
            self.notice_once(About::Redraw, Level::Info, text);
        }
    }

    /// Restarts at frame 0 and records every frame; the second time, stops and writes the file.
    pub(super) fn record(&mut self) {
        if self.playback.recorder.is_some() {
            self.end_recording();
            return;
        }
        let project = self.documents.current();
        self.playback.recorder = Some(Recorder::new(project.name.clone(), project.custom_uniform_values.clone()));
        self.reset();
    }

    /// Writes the recording, if one is being made.
    pub(super) fn end_recording(&mut self) {
        let Some(Recorder { recording, .. }) = self.playback.recorder.take() else { return };
        let frames = recording.frames.len();
        if frames == 0 {
            self.notice_about(
                About::Capture,
                Level::Warning,
                "nothing to save: no frame was drawn during the recording",
            );
            return;
        }
        let project = self.documents.current();
        let folder = capture::folder_for(project, &self.host.options.pictures);
        let stem = capture::file_stem(&recording.project);
        let name = |n: u32| format!("{stem}-{n:04}.{EXTENSION}");
        match capture::write_new(&folder, name, &stem, |out| recording.write(out)) {
            Ok(path) => {
                let text = format!("{frames} frames of input saved: {}", path.display());
                self.notice_with_path(About::Project, Level::Info, text, path);
            }
            Err(error) => self.notice_about(About::Capture, Level::Error, error.to_string()),
        }
    }

    /// Records a job before it is submitted.
    pub(super) fn note_job(&mut self, draw: &Draw, stays: bool) {
        let size = self.changes.size().unwrap_or_else(|| self.engine.coming_size());
        if let Some(recorder) = &mut self.playback.recorder {
            recorder.note(&self.changes, size, draw, stays);
        }
    }

    /// Starts reading a recording, which is played when it is loaded.
    pub(super) fn play_recording(&mut self, file: PathBuf) {
        self.dismiss_notices(About::Replay);
        let file = std::path::absolute(&file).unwrap_or(file);
        if let Err(e) = self.playback.read_recording(file, self.host.wake.clone()) {
            self.notice_about(About::Replay, Level::Error, format!("cannot start a thread for reading: {e}"));
        }
    }

    /// Ends the replay, with a notice.
    pub(super) fn end_replay(&mut self, why: &str) {
        if let Some(ReplayView { file, drawn, frames }) = self.playback.stop_replay() {
            let text = format!("stopped {} at frame {drawn} of {frames}: {why}", name(&file));
            self.notice_about(About::Replay, Level::Info, text);
        }
    }

    /// Returns the frame of the recording that is due now. `is_step`: a frame is requested, whatever the time.
    pub(super) fn next_replayed(&mut self, is_step: bool) -> Option<FrameInputs> {
        let (may_run, may_start) = (!self.is_waiting_for_compile(), !self.is_compile_under_way());
        let next = self.playback.next_replayed(self.host.now, is_step, may_run, may_start)?;
        let ReplayedFrame { frame, change, is_last } = next;
        if let Some(size) = change.size {
            self.canvas.replayed = Some(size);
            self.fit_canvas();
        }
        if let Some(values) = change.values {
            self.changes.set(Change::CustomUniforms(values));
        }
        if change.reset {
            self.changes.set(Change::Reset);
        }
        self.host.changed = true;
        if is_last && let Some(ReplayView { file, frames, .. }) = self.playback.finish_replay() {
            let text = format!(
                "{} ended: the picture is paused at frame {frames} of {frames}. Press Play to continue live from there",
                name(&file)
            );
            self.notice_about(About::Replay, Level::Info, text);
        }
        Some(frame.inputs)
    }

    /// Gives the engine the project's own values again, before a frame that is not the recording's.
    pub(super) fn restore_values(&mut self) {
        if self.playback.drop_replayed_values() {
            self.custom_uniforms_changed();
        }
    }
}
