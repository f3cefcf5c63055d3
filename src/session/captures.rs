//! Pictures of the shown pass are written to new files.

use super::{
    Session,
    drawing::{RenderTask, Renderer, Tasks, Ticket},
    scene::PictureSource,
    view::{About, Level},
};
use eddy_engine::{EngineError, Pixels};
use eddy_playback::{capture, scene::Scene};
use eddy_project::PassName;
use std::path::PathBuf;

/// A picture that is to be written to a file.
#[derive(Clone, Debug)]
struct Capture {
    pass: PassName,
    format: capture::Format,
    folder: PathBuf,
    stem: String,
    /// The project that is saved in the file.
    source: Option<PictureSource>,
}

/// A picture, and what it was drawn from.
type Captured = (Result<Pixels, EngineError>, Option<Scene>);

impl RenderTask for Capture {
    type Output = Captured;

    fn run(self, renderer: &mut Renderer) -> Self::Output {
        let scene = self.source.and_then(|source| source.scene(renderer));
        (renderer.engine_mut().read(&self.pass), scene)
    }
}

/// The pictures that are to be written, oldest first. Another project changes none of them.
pub(super) struct Captures {
    /// The project is saved in them.
    pub with_project: bool,
    due: Vec<Capture>,
    in_flight: Vec<(Capture, Ticket<Captured>)>,
}

impl Default for Captures {
    fn default() -> Self {
        Self { with_project: true, due: Vec::new(), in_flight: Vec::new() }
    }
}

impl Captures {
    pub(crate) fn request(&mut self, tasks: &mut Tasks) {
        let due = self.due.drain(..);
        self.in_flight.extend(due.map(|capture| (capture.clone(), tasks.add(capture))));
    }

    /// The pictures of a device that was given up are read of the next one.
    pub(crate) fn retry(&mut self) {
        self.due.splice(..0, self.in_flight.drain(..).map(|(capture, _)| capture));
    }
}

impl Session {
    /// Writes the shown pass to a new file, as soon as the engine has time.
    pub(super) fn capture(&mut self, format: capture::Format) {
        if !self.drawing.has_program() {
            self.notice_about(About::Drawing, Level::Warning, "there is no picture to save yet");
            return;
        }
        let project = self.documents.current();
        // A value that is looked at is no picture of the project.
        let is_asked = self.watched.captures.with_project && format == capture::Format::Png;
        let source = (is_asked && self.pictured() == self.picture.shown).then(|| PictureSource {
            project: project.clone(),
            pass: self.picture.shown.clone(),
            has_state: self.has_state(),
        });
        self.watched.captures.due.push(Capture {
            pass: self.pictured(),
            format,
            folder: capture::folder_for(project, &self.options.pictures),
            stem: capture::stem_for(project, &self.picture.shown),
            source,
        });
        if !self.drawing.is_apart() {
            let mut tasks = Tasks::default();
            self.watched.captures.request(&mut tasks);
            self.hand_in(None, false, tasks);
            self.take_drawn(false);
        }
    }

    /// Writes the pictures that came with a job. Those that did not are lost with their device.
    pub(super) fn write_captures(&mut self) {
        for (capture, mut ticket) in std::mem::take(&mut self.watched.captures.in_flight) {
            if let Some(read) = ticket.take() {
                self.write_capture(&capture, read.output);
            }
        }
    }

    fn write_capture(&mut self, capture: &Capture, (pixels, scene): Captured) {
        let pixels = match pixels {
            Ok(pixels) => pixels,
            Err(e) => {
                self.notice_about(About::Capture, Level::Error, format!("cannot save the screenshot: {e}"));
                return;
            }
        };
        match capture::save_new(&capture.folder, &capture.stem, &pixels, capture.format, scene.as_ref()) {
            Ok(path) => {
                let with = if scene.is_some() { ", with the project in it" } else { "" };
                let text = format!("saved {}{with}", path.display());
                self.notice_with_path(About::Capture, Level::Info, text, path);
            }
            Err(e) => self.notice_about(About::Capture, Level::Error, e.to_string()),
        }
    }
}
