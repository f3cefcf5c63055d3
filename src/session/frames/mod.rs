//! The tick: finished compiles, changes on disk, and at most the frames that are due.

use super::{
    Session, capture,
    clock::FrameTime,
    compile::{Compiled, Done, Job},
    date,
    view::{Level, Meanwhile, Outcome, TabDiagnostic, Tick},
    worker::Panicked,
};
use crate::{
    diag::Severity,
    engine::{EngineError, FrameInputs},
    gpu::GpuError,
};
use std::time::Instant;

impl Session {
    /// Takes finished compiles and changes on disk, and draws a frame if one is due: while playing one a call, while
    /// paused only when something the picture depends on has changed. Call it once for each frame shown.
    pub fn tick(&mut self, now: Instant) -> Tick {
        self.now = now;
        self.check_disk();
        self.start_compile();
        self.take_compiled();
        self.analyse();
        self.take_analysed();
        self.fit_canvas();
        let frame_drawn = self.draw_due_frames();
        Tick { frame_drawn, wake_at: self.wake_at(), changed: std::mem::take(&mut self.changed) }
    }

    fn wake_at(&self) -> Option<Instant> {
        let is_running = self.run.clock.is_playing() && self.compile.has_program && !self.run.is_device_lost;
        [is_running.then_some(self.now), self.compile.edits.deadline(), self.disk.changes.deadline()]
            .into_iter()
            .flatten()
            .min()
    }

    fn start_compile(&mut self) {
        if std::mem::take(&mut self.compile.edited) {
            self.compile.edits.touch(self.now);
        }
        let is_due = self.compile.edits.take_due(self.now);
        let is_compile = std::mem::take(&mut self.compile.is_wanted) || is_due;
        // A look must not take the place of a compile under way, and a compile looks too.
        let is_look = self.compile.is_look_wanted && !self.compiler.is_busy();
        if !is_compile && !is_look {
            return;
        }
        self.compile.is_look_wanted = false;
        if is_compile {
            self.compile.edits.cancel();
            self.changed = true;
        }
        self.compiler.submit(Job {
            project: self.documents.current().clone(),
            shown: self.run.shown.clone(),
            opened: self.disk.opened,
            include_edit: (is_compile && self.compile.includes_read != self.compile.include_edits)
                .then_some(self.compile.include_edits),
            is_look: !is_compile,
        });
    }

    fn take_compiled(&mut self) {
        let Some(result) = self.compiler.take() else { return };
        let done = match result {
            Ok(Done { files, is_changed, includes, compiled }) => {
                let has_new_files = self.disk.media_files != files || includes.is_some();
                self.disk.media_files = files;
                if let Some((edit, includes)) = includes {
                    self.documents.current_mut().includes = includes;
                    self.compile.includes_read = edit;
                }
                if has_new_files {
                    self.watch_what_is_read();
                }
                if is_changed {
                    self.compile_soon();
                }
                let Some(compiled) = compiled else { return };
                Ok(compiled)
            }
            Err(panicked) => Err(panicked),
        };
        self.changed = true;
        self.compile.state.compiling = self.is_compile_due() || self.compiler.is_busy();
        match done {
            Err(Panicked(reason)) => {
                let what = format!("this is a bug in Eddy: the compiler gave up ({reason})");
                self.compile.diagnostics = vec![TabDiagnostic::nowhere(&what)];
                self.compile.state.last = Some(self.failed());
                let goes_on = if self.compile.has_program { "; the last good picture goes on" } else { "" };
                self.notice(Level::Error, format!("{what}{goes_on}"));
            }
            Ok(compiled) => self.take_program(compiled),
        }
    }

    fn is_compile_due(&self) -> bool {
        self.compile.edited || self.compile.is_wanted || self.compile.edits.is_waiting()
    }

    fn take_program(&mut self, compiled: Compiled) {
        self.compile.diagnostics = compiled.diagnostics;
        let (program, millis) = match compiled.program {
            Ok(Some(built)) => built,
            Ok(None) => {
                self.compile.state.last = Some(self.failed());
                return;
            }
            Err(e) => return self.refused(&e),
        };
        let count = |s| self.compile.diagnostics.iter().filter(|d| d.severity == s).count();
        let (errors, warnings) = (count(Severity::Error), count(Severity::Warning));
        self.compile.state.last = Some(match errors {
            0 => Outcome::Ok { millis, warnings },
            _ => Outcome::Failed { errors, meanwhile: Meanwhile::Newest },
        });
        if let Err(e) = self.engine.set_program(program) {
            return self.refused(&e);
        }
        // They may have been turned while it was being compiled.
        self.knobs_turned();
        self.engine.show(self.run.shown.clone());
        self.display_generation += 1;
        self.compile.has_program = true;
        self.run.is_frame_due = true;
        if std::mem::take(&mut self.compile.reset_when_built) {
            self.reset();
        }
    }

    /// A text that gave no program, for the reasons that are in the list.
    fn failed(&self) -> Outcome {
        let errors = self.compile.diagnostics.iter().filter(|d| d.severity == Severity::Error).count();
        let meanwhile = if self.compile.has_program { Meanwhile::LastGood } else { Meanwhile::Nothing };
        Outcome::Failed { errors, meanwhile }
    }

    /// The machine refused what the newest text asks for: said in the list of errors, too, where errors are counted.
    fn refused(&mut self, error: &EngineError) {
        self.compile.diagnostics.insert(0, TabDiagnostic::nowhere(&error.to_string()));
        self.compile.state.last = Some(self.failed());
        self.stop_drawing(error);
    }

    /// Gives the engine the size the canvas shall have.
    fn fit_canvas(&mut self) {
        let Some(size) = self.canvas.size() else { return };
        if size == self.engine.size() || self.canvas.refused == Some(size) {
            return;
        }
        match self.engine.resize(size.0, size.1) {
            Ok(()) => {
                self.run.is_frame_due = true;
                self.display_generation += 1;
                self.changed = true;
            }
            Err(e) => {
                self.canvas.refused = Some(size);
                let (width, height) = self.engine.size();
                self.notice(Level::Error, format!("{e}; the picture stays at {width}x{height}"));
            }
        }
    }

    fn draw_due_frames(&mut self) -> bool {
        if !self.compile.has_program || self.run.is_device_lost {
            return false;
        }
        let mut drawn = false;
        for _ in 0..std::mem::take(&mut self.run.steps) {
            let time = self.run.clock.step_frame();
            drawn |= self.draw(time);
        }
        if self.run.clock.is_playing() {
            let time = self.run.clock.running_frame(self.now);
            drawn |= self.draw(time);
            self.changed |= self.run.fps.frame(self.now);
        } else if self.run.is_frame_due {
            let time = self.run.clock.forced_frame();
            drawn |= self.draw(time);
        }
        drawn
    }

    fn draw(&mut self, time: FrameTime) -> bool {
        let inputs = FrameInputs {
            frame: time.frame,
            time_secs: time.time_secs,
            time_delta_secs: time.time_delta_secs,
            frame_rate: time.frame_rate,
            mouse: self.run.mouse.next_frame(),
            drag: self.run.mouse.dragged(),
            date: date::i_date(date::now()),
            keyboard: self.run.keyboard.clone(),
        };
        self.run.is_frame_due = false;
        self.run.keyboard.frame_painted();
        let start = Instant::now();
        match self.run.costs.draw(&mut self.engine, &inputs) {
            Ok(()) => {
                self.run.cpu_micros = start.elapsed().as_secs_f64() * 1e6;
                self.changed |= !self.run.clock.is_playing();
                true
            }
            Err(e) => {
                self.stop_drawing(&e);
                false
            }
        }
    }

    /// A frame could not be drawn: the picture stands, everything else goes on.
    fn stop_drawing(&mut self, error: &EngineError) {
        self.run.clock.pause();
        self.run.is_frame_due = false;
        if !matches!(error, EngineError::Gpu(GpuError::Lost(_))) {
            self.notice(Level::Error, format!("{error}; the picture is paused"));
        } else if !std::mem::replace(&mut self.run.is_device_lost, true) {
            self.notice(
                Level::Error,
                format!("{error}. Your texts are all here: save them, then start Eddy again to go on drawing"),
            );
        }
    }

    /// The graphics layer refused something that no one waited for an answer to. Said once, however often it happens.
    pub fn tell_of(&mut self, error: &GpuError) {
        let text = error.to_string();
        if self.notices.iter().all(|n| n.text != text) {
            self.notice(Level::Error, text);
        }
    }

    /// Writes the shown pass to a new file.
    pub(super) fn capture(&mut self, format: capture::Format) {
        if !self.compile.has_program {
            self.notice(Level::Warning, "there is no picture to save yet");
            return;
        }
        let pixels = match self.engine.read(&self.run.shown) {
            Ok(pixels) => pixels,
            Err(e) => {
                self.notice(Level::Error, format!("no picture was saved: {e}"));
                return;
            }
        };
        let project = self.documents.current();
        let folder = capture::folder_for(project, &self.options.pictures);
        let stem = capture::stem_for(project, &self.run.shown);
        match capture::save_new(&folder, &stem, &pixels, format) {
            Ok(path) => {
                self.notice(Level::Info, format!("saved {}", path.display()));
                if let Some(notice) = self.notices.last_mut() {
                    notice.path = Some(path);
                }
            }
            Err(e) => self.notice(Level::Error, e.to_string()),
        }
    }
}

impl super::state::Canvas {
    /// Pixels, at least one each way; `None` before the viewport is known.
    fn size(&self) -> Option<(u32, u32)> {
        let scaled = |v: u32| ((f64::from(v) * f64::from(self.scale)).floor() as u32).max(1);
        self.fixed.or_else(|| self.viewport.map(|(w, h)| (scaled(w), scaled(h))))
    }
}

#[cfg(test)]
mod tests;
