//! The tick: takes finished compiles, changes on disk and drawn frames, and draws at most the frames that are due.

use super::{
    Session,
    compile::{CompileResult, Compiled, Source},
    drawing::{Change, FrameControl, PendingProgram},
    open_project::OpenProject,
    view::{About, Level, Tick},
};
use eddy_engine::EngineError;
use eddy_gpu::GpuError;
use std::time::Instant;

impl Session {
    /// Takes finished compiles, changes on disk and drawn frames, and draws a frame if one is due: while playing one
    /// per call, while paused only if something that the picture depends on has changed. If a thread draws, this does
    /// not wait for the frame, which a later tick takes. Call it once for each displayed frame.
    pub fn tick(&mut self, now: Instant) -> Tick {
        self.open.host.now = now;
        self.services.recovery.take_found_work(&mut self.open);
        self.take_recording();
        self.open.check_disk();
        self.open.read_declared_uniforms();
        let mut frame_drawn = self.take_drawn(false);
        self.watch_drawing();
        self.open.follow_devices();
        self.start_compile();
        self.take_compiled();
        self.services.analyst.analyse(&mut self.open);
        self.services.analyst.take_analysed(&mut self.open);
        self.open.host.changed |= self.open.trace.poll();
        self.open.take_audited();
        self.open.host.changed |= self.open.nan_search.background.poll() | self.open.comparison.background.poll();
        self.open.host.changed |= self.open.tuning.background.poll();
        self.tick_sound();
        self.tick_film();
        self.open.fit_canvas();
        self.services.recovery.keep_unsaved(&mut self.open);
        self.services.audio.hear(&mut self.open);
        self.services.controls.follow_controls(&mut self.open);
        self.open.update_measures();
        self.update_frame_control();
        // If a processor both draws and paints, painting the picture would be slower while another frame is drawn.
        let is_picture_new = std::mem::take(&mut self.services.display.is_new);
        self.services.display.waits_for_painting = is_picture_new && self.services.drawing.shares_processor();
        if !self.services.display.waits_for_painting {
            frame_drawn |= self.draw_due_frames(true);
        }
        frame_drawn |= std::mem::take(&mut self.services.display.has_drawn);
        self.services.audio.play_sound(&mut self.open);
        Tick { frame_drawn, wake_at: self.wake_at(), changed: std::mem::take(&mut self.open.host.changed) }
    }

    /// Takes a finished compile, and submits its program with its first frame before the next tick is due, so that
    /// edits are visible sooner. Nothing else is drawn. Call it when the session has woken the front end; the next tick
    /// reports the changes.
    pub fn on_wake(&mut self, now: Instant) {
        self.open.host.now = now;
        self.services.display.has_drawn |= self.take_drawn(false);
        self.take_compiled();
        self.update_frame_control();
        if self.open.changes.program().is_some() || self.open.picture.is_program_new {
            self.open.fit_canvas();
            self.services.display.has_drawn |= self.draw_due_frames(false);
        }
    }

    /// Starts the frame that waited until the picture of the last tick was painted, with the current state.
    pub fn painted(&mut self, now: Instant) {
        if std::mem::take(&mut self.services.display.waits_for_painting) {
            self.open.host.now = now;
            self.services.display.has_drawn |= self.draw_due_frames(true);
        }
    }

    /// Makes the frame that is being drawn wait for the newest text, and abandons it for that text's program.
    fn update_frame_control(&self) {
        self.services.drawing.set_frame_control(match self.open.compile_wait_end() {
            _ if self.open.changes.program().is_some() => FrameControl::Abandon,
            Some(until) => FrameControl::WaitUntil(until),
            None => FrameControl::Continue,
        });
    }

    /// Returns whether the newest text is being compiled and likely to be a program soon, judging by the previous
    /// compile, or its first frame is being drawn.
    pub fn is_first_frame_coming(&self) -> bool {
        let is_drawn = self.services.drawing.is_busy() && !self.open.halt.is_held();
        self.open.is_waiting_for_compile()
            || (is_drawn && (self.open.is_program_coming() || self.open.picture.is_program_new))
    }

    fn wake_at(&self) -> Option<Instant> {
        let is_running =
            self.open.playback.is_running() && self.open.engine.has_program() && !self.open.halt.is_device_gone();
        // The end of a frame in progress wakes the session.
        let is_busy = self.services.drawing.is_busy() || self.services.display.waits_for_painting;
        let is_held = self.open.halt.is_halted() || is_busy || self.open.is_waiting_for_compile();
        let is_next_due = is_running && !is_held;
        // A frame of a recording may become due only after the previous picture was painted, and nothing else wakes the
        // session.
        let is_free =
            !self.open.halt.is_halted() && !self.services.drawing.is_busy() && !self.open.is_waiting_for_compile();
        let replayed = self.open.playback.replay_due(self.open.host.now).filter(|_| is_running && is_free);
        let is_next_due = is_next_due && !self.open.playback.is_replaying();
        let resumes = self.open.compile_wait_end().filter(|_| is_running);
        let (drawing, sound) = (self.drawing_deadline(), self.services.sound_pass.sound_deadline());
        let deadlines = [
            self.open.compile.edits.deadline(),
            self.open.disk.deadline(),
            drawing,
            sound,
            resumes,
            self.services.films.deadline(self.open.host.now),
        ];
        let due = self.services.films.due().map_or(self.open.host.now, |due| due.max(self.open.host.now));
        let next = is_next_due.then_some(due).or(replayed);
        next.into_iter().chain(deadlines.into_iter().flatten()).min()
    }

    fn start_compile(&mut self) {
        let (project, shown) = (self.open.documents.current(), &self.open.picture.shown);
        let source = Source {
            project,
            shown,
            generated: self.open.documents.generated(),
            opened: self.open.disk.opened(),
            probe: self.open.read_backs.probe.order(),
            camera: self.open.devices.camera().cloned(),
        };
        if let Some(job) = self.open.compile.due_job(self.open.host.now, source) {
            self.open.host.changed |= !job.is_check_only;
            self.services.compiler.start(job);
        }
    }

    fn take_compiled(&mut self) {
        let Some(result) = self.services.compiler.take() else { return };
        self.open.compile.receive(matches!(result, Ok(CompileResult { compiled: None, .. })));
        let compiled = match result {
            Ok(CompileResult { files, is_changed, includes, generated, compiled }) => {
                if let Some(now) = generated {
                    self.open.follow_generated(now);
                }
                let has_new_files = self.open.disk.set_media_files(files) | includes.is_some();
                if let Some((edit, includes)) = includes {
                    self.open.take_includes(includes, edit);
                }
                if has_new_files {
                    self.open.watch_folders();
                }
                if is_changed {
                    self.open.compile_soon();
                }
                let is_compiling = self.open.is_compile_under_way();
                let Some(compiled) = compiled else {
                    // It was a check of the files, which made the compiler seem busy.
                    self.open.host.changed |= self.open.compile.set_compiling(is_compiling);
                    return;
                };
                Ok(compiled)
            }
            Err(why) => Err(why),
        };
        self.open.host.changed = true;
        self.open.compile.set_compiling(self.open.is_compile_under_way());
        match compiled {
            Err(what) => {
                self.open.compile.diagnostics.clear();
                self.open.compile.add_failure(&what);
                self.open.audit.map = None;
                let has_program = self.open.engine.has_program();
                self.open.compile.fail(has_program);
                let goes_on = if has_program { "; the last working version keeps running" } else { "" };
                self.open.notice_about(About::Code, Level::Error, format!("{what}{goes_on}"));
            }
            Ok(compiled) => self.take_program(compiled),
        }
    }

    fn take_program(&mut self, compiled: Compiled) {
        let Compiled { project, is_fallback, program, diagnostics, took, probe, heard, sounds } = compiled;
        // The messages are about the newest text.
        if !is_fallback {
            self.services.sound_pass.follow_sound(&mut self.open, &project, heard);
            self.open.compile.diagnose(diagnostics, took);
            self.open.audit.map = None;
        }
        let (program, millis) = match program {
            Ok(Some(built)) => built,
            Ok(None) if is_fallback => return,
            Ok(None) => return self.open.compile.fail(self.open.engine.has_program()),
            Err(e) => return self.refused(&e),
        };
        let millis = (!is_fallback).then_some(millis);
        if let Some(millis) = millis.filter(|_| self.open.halt.is_held()) {
            self.open.compile.succeed(millis);
        }
        self.services.audio.expect(sounds);
        self.open.forget_old_names(&project);
        self.open.changes.set(Change::Program(Box::new(PendingProgram::new(program, project, millis))));
        // They may have been set while it was being compiled.
        self.open.custom_uniforms_changed();
        self.open.read_backs.probe.built(probe);
        self.open.changes.set(Change::Show(self.open.pictured()));
        if let Some(look) = self.open.read_backs.probe.take_look(true) {
            self.open.changes.set(Change::Look(look));
        }
        self.open.compile.set_compiling(self.open.is_compile_under_way());
    }

    /// The machine rejected the newest text: also added to the list of errors, where errors are counted.
    pub(super) fn refused(&mut self, error: &EngineError) {
        self.open.compile.add_failure(&error.to_string());
        self.open.compile.fail(self.open.engine.has_program());
        self.stop_drawing(error);
    }

    /// Reports an error of the graphics layer that no caller was waiting for. Reported once, however often it occurs.
    pub fn report_gpu_error(&mut self, error: &GpuError) {
        self.open.notice_once(About::Window, Level::Error, &error.to_string());
    }
}

impl OpenProject {
    /// Returns whether the newest text is being compiled and likely to be done soon, judging by the previous compile.
    pub(super) fn is_waiting_for_compile(&self) -> bool {
        self.compile_wait_end().is_some()
    }

    fn compile_wait_end(&self) -> Option<Instant> {
        self.compile.holds_frames_until(self.host.now)
    }

    /// Returns whether the picture is older than the newest text.
    pub(super) fn is_compile_under_way(&self) -> bool {
        self.compile.is_busy() || (self.is_program_coming() && !self.halt.is_held())
    }
}

#[cfg(test)]
mod tests;
