//! Pictures of the shown pass, written to new files.

use super::{
    Session,
    drawing::{Draw, RenderTask, Renderer, Tasks, Ticket},
    open_project::OpenProject,
    scene::PictureSource,
    view::{About, Level},
};
use eddy_engine::{EngineError, Pixels};
use eddy_playback::{capture, scene::Scene};
use eddy_project::PassName;
use std::path::PathBuf;

/// A picture to be written to a file.
#[derive(Clone, Debug)]
struct Capture {
    pass: PassName,
    format: capture::Format,
    folder: PathBuf,
    stem: String,
    /// The project to embed in the file.
    source: Option<PictureSource>,
}

/// A picture and the scene that it was drawn from.
type Captured = (Result<Pixels, EngineError>, Option<Scene>);

impl RenderTask for Capture {
    type Output = Captured;

    fn run(self, renderer: &mut Renderer) -> Self::Output {
        let scene = self.source.and_then(|source| source.scene(renderer));
        (renderer.engine_mut().read(&self.pass), scene)
    }
}

/// The pictures to be written, oldest first. Opening another project keeps them.
pub(super) struct Captures {
    /// The project is embedded in PNG files.
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

    /// Reads the pictures that a lost device did not deliver from the next one.
    pub(crate) fn retry(&mut self) {
        self.due.splice(..0, self.in_flight.drain(..).map(|(capture, _)| capture));
    }
}

impl Session {
    /// Writes the shown pass to a new file, as soon as the engine is free.
    pub(super) fn capture(&mut self, format: capture::Format) {
        if !self.open.engine.has_program() {
            self.open.notice_about(About::Drawing, Level::Warning, "there is no picture to save yet");
            return;
        }
        let project = self.open.documents.current();
        // A picture of a probed value does not represent the project.
        let is_asked = self.services.captures.with_project && format == capture::Format::Png;
        let source = (is_asked && self.open.pictured() == self.open.picture.shown).then(|| PictureSource {
            project: project.clone(),
            pass: self.open.picture.shown.clone(),
            has_state: self.open.has_state(),
        });
        self.services.captures.due.push(Capture {
            pass: self.open.pictured(),
            format,
            folder: capture::folder_for(project, &self.open.host.options.pictures),
            stem: capture::stem_for(project, &self.open.picture.shown),
            source,
        });
        if !self.services.drawing.is_on_thread() {
            let mut tasks = Tasks::default();
            self.services.captures.request(&mut tasks);
            self.submit_frame(Draw::Nothing, tasks);
            self.take_drawn(false);
        }
    }

    /// Writes the pictures that came with a job. Pictures that did not come are lost with their device.
    pub(super) fn write_captures(&mut self) {
        for (capture, mut ticket) in std::mem::take(&mut self.services.captures.in_flight) {
            if let Some(read) = ticket.take() {
                self.open.write_capture(&capture, read.output);
            }
        }
    }
}

impl OpenProject {
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
