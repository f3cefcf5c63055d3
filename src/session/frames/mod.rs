//! The tick: takes finished compiles, changes on disk and drawn frames, and draws at most the frames that are due.

use super::{
    Session,
    compile::{Compiled, Done, Source},
    drawing::{FrameControl, PendingProgram},
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
        self.now = now;
        self.take_found_work();
        self.take_recording();
        self.check_disk();
        self.read_declared_uniforms();
        let mut frame_drawn = self.take_drawn(false);
        self.watch_drawing();
        self.follow_devices();
        self.start_compile();
        self.take_compiled();
        self.analyse();
        self.take_analysed();
        self.changed |= self.tracing.poll();
        self.take_audited();
        self.changed |= self.searching.background.poll() | self.comparing.background.poll();
        self.tick_sound();
        self.tick_film();
        self.fit_canvas();
        self.keep_unsaved();
        self.hear();
        self.follow_controls();
        self.follow_measures();
        self.steer_frame();
        // If a processor both draws and paints, painting the picture would be slower while another frame is drawn.
        let is_picture_new = std::mem::take(&mut self.picture.is_new);
        self.picture.waits_for_painting = is_picture_new && self.drawing.shares_processor();
        if !self.picture.waits_for_painting {
            frame_drawn |= self.draw_due_frames(true);
        }
        frame_drawn |= std::mem::take(&mut self.picture.has_drawn);
        self.play_sound();
        Tick { frame_drawn, wake_at: self.wake_at(), changed: std::mem::take(&mut self.changed) }
    }

    /// Takes a finished compile, and submits its program with its first frame before the next tick is due, so that
    /// edits are visible sooner. Nothing else is drawn. Call it when the session has woken the front end; the next tick
    /// reports the changes.
    pub fn attend(&mut self, now: Instant) {
        self.now = now;
        self.picture.has_drawn |= self.take_drawn(false);
        self.take_compiled();
        self.steer_frame();
        if self.drawing.wanted.program.is_some() || self.picture.is_program_new {
            self.fit_canvas();
            self.picture.has_drawn |= self.draw_due_frames(false);
        }
    }

    /// Starts the frame that waited until the picture of the last tick was painted, with the current state.
    pub fn painted(&mut self, now: Instant) {
        if std::mem::take(&mut self.picture.waits_for_painting) {
            self.now = now;
            self.picture.has_drawn |= self.draw_due_frames(true);
        }
    }

    /// Makes the frame that is being drawn wait for the newest text, and abandons it for that text's program.
    fn steer_frame(&self) {
        self.drawing.steer(match self.gives_way_until() {
            _ if self.drawing.wanted.program.is_some() => FrameControl::GiveUp,
            Some(until) => FrameControl::WaitUntil(until),
            None => FrameControl::GoOn,
        });
    }

    /// Returns whether the newest text is being compiled and likely to be a program soon, judging by the previous
    /// compile, or its first frame is being drawn.
    pub fn is_first_frame_coming(&self) -> bool {
        let is_drawn = self.drawing.is_busy() && !self.halting.is_held();
        self.gives_way() || (is_drawn && (self.drawing.is_program_coming() || self.picture.is_program_new))
    }

    /// Returns whether the newest text is being compiled and likely to be done soon, judging by the previous compile.
    pub(super) fn gives_way(&self) -> bool {
        self.gives_way_until().is_some()
    }

    fn gives_way_until(&self) -> Option<Instant> {
        self.compile.holds_frames_until(self.now)
    }

    fn wake_at(&self) -> Option<Instant> {
        let is_running = self.playback.is_running() && self.drawing.has_program() && !self.halting.is_device_gone();
        // The end of a frame in progress wakes the session.
        let is_busy = self.drawing.is_busy() || self.picture.waits_for_painting;
        let is_held = self.halting.is_halted() || is_busy || self.gives_way();
        let is_next_due = is_running && !is_held;
        // A frame of a recording may become due only after the previous picture was painted, and nothing else wakes the
        // session.
        let is_free = !self.halting.is_halted() && !self.drawing.is_busy() && !self.gives_way();
        let replayed = self.playback.replay_due(self.now).filter(|_| is_running && is_free);
        let is_next_due = is_next_due && !self.playback.is_replaying();
        let resumes = self.gives_way_until().filter(|_| is_running);
        let (drawing, sound) = (self.drawing_deadline(), self.sound_deadline());
        let deadlines = [
            self.compile.edits.deadline(),
            self.disk.deadline(),
            drawing,
            sound,
            resumes,
            self.films.deadline(self.now),
        ];
        let due = self.films.due().map_or(self.now, |due| due.max(self.now));
        let next = is_next_due.then_some(due).or(replayed);
        next.into_iter().chain(deadlines.into_iter().flatten()).min()
    }

    fn start_compile(&mut self) {
        let (project, shown) = (self.documents.current(), &self.picture.shown);
        let source = Source {
            project,
            shown,
            opened: self.disk.opened(),
            probe: self.watched.probing.order(),
            camera: self.devices.camera().cloned(),
        };
        self.changed |= self.compile.start(self.now, source);
    }

    fn take_compiled(&mut self) {
        let compiled = match self.compile.take() {
            None => return,
            Some(Ok(Done { files, is_changed, includes, compiled })) => {
                let has_new_files = self.disk.set_media_files(files) | includes.is_some();
                if let Some((edit, includes)) = includes {
                    self.take_includes(includes, edit);
                }
                if has_new_files {
                    self.watch_what_is_read();
                }
                if is_changed {
                    self.compile_soon();
                }
                let is_compiling = self.is_compile_under_way();
                let Some(compiled) = compiled else {
                    // It was a check of the files, which made the compiler seem busy.
                    self.changed |= self.compile.set_compiling(is_compiling);
                    return;
                };
                Ok(compiled)
            }
            Some(Err(why)) => Err(why),
        };
        self.changed = true;
        self.compile.set_compiling(self.is_compile_under_way());
        match compiled {
            Err(what) => {
                self.compile.diagnostics.clear();
                self.compile.add_failure(&what);
                self.auditing.map = None;
                let has_program = self.drawing.has_program();
                self.compile.fail(has_program);
                let goes_on = if has_program { "; the last working version keeps running" } else { "" };
                self.notice_about(About::Code, Level::Error, format!("{what}{goes_on}"));
            }
            Ok(compiled) => self.take_program(compiled),
        }
    }

    /// Returns whether the picture is older than the newest text.
    pub(super) fn is_compile_under_way(&self) -> bool {
        self.compile.is_busy() || (self.drawing.is_program_coming() && !self.halting.is_held())
    }

    fn take_program(&mut self, compiled: Compiled) {
        let Compiled { project, is_fallback, program, diagnostics, took, probe, heard, sounds } = compiled;
        // The messages are about the newest text.
        if !is_fallback {
            self.follow_sound(&project, heard);
            self.compile.diagnose(diagnostics, took);
            self.auditing.map = None;
        }
        let (program, millis) = match program {
            Ok(Some(built)) => built,
            Ok(None) if is_fallback => return,
            Ok(None) => return self.compile.fail(self.drawing.has_program()),
            Err(e) => return self.refused(&e),
        };
        let millis = (!is_fallback).then_some(millis);
        if let Some(millis) = millis.filter(|_| self.halting.is_held()) {
            self.compile.succeed(millis);
        }
        self.audio.expect(sounds);
        self.forget_old_names(&project);
        self.drawing.wanted.program = Some(PendingProgram::new(program, project, millis));
        // They may have been set while it was being compiled.
        self.custom_uniforms_turned();
        self.watched.probing.built(probe);
        self.drawing.wanted.shown = Some(self.pictured());
        self.drawing.wanted.look = self.watched.probing.take_look(true);
        self.compile.set_compiling(self.is_compile_under_way());
    }

    /// The machine rejected the newest text: also added to the list of errors, where errors are counted.
    pub(super) fn refused(&mut self, error: &EngineError) {
        self.compile.add_failure(&error.to_string());
        self.compile.fail(self.drawing.has_program());
        self.stop_drawing(error);
    }

    /// Reports an error of the graphics layer that no caller was waiting for. Reported once, however often it occurs.
    pub fn tell_of(&mut self, error: &GpuError) {
        self.notice_once(About::Window, Level::Error, &error.to_string());
    }
}

#[cfg(test)]
mod tests;
