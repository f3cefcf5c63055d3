//! Records the inputs of what is drawn, and writes them to a file.

use super::{
    Session, capture,
    recorder::Recorder,
    recording::EXTENSION,
    view::{About, Level},
};
use eddy_engine::FrameInputs;

impl Session {
    /// Begins anew at frame 0 and records every frame; the second time, ends that and writes the file.
    pub(super) fn record(&mut self) {
        if self.run.recorder.is_some() {
            self.end_recording();
            return;
        }
        let project = self.documents.current();
        self.run.recorder = Some(Recorder::new(project.name.clone(), project.custom_uniform_values.clone()));
        self.reset();
    }

    /// Returns how many frames have been recorded, while they are.
    pub fn recorded_frames(&self) -> Option<usize> {
        self.run.recorder.as_ref().map(|recorder| recorder.recording.frames.len())
    }

    /// Writes what has been recorded, if anything is.
    pub(super) fn end_recording(&mut self) {
        let Some(Recorder { recording, .. }) = self.run.recorder.take() else { return };
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
        let folder = capture::folder_for(project, &self.options.pictures);
        let stem = capture::file_stem(&recording.project);
        let name = |n: u32| format!("{stem}-{n:04}.{EXTENSION}");
        match capture::write_new(&folder, name, &stem, |out| recording.write(out)) {
            Ok(path) => {
                self.notice(Level::Info, format!("{frames} frames of input saved: {}", path.display()));
                if let Some(notice) = self.notices.last_mut() {
                    notice.path = Some(path);
                }
            }
            Err(error) => self.notice_about(About::Capture, Level::Error, error.to_string()),
        }
    }

    /// Takes down a job before it is handed in.
    pub(super) fn note_job(&mut self, frame: Option<&FrameInputs>, again: bool) {
        let size = self.drawing.wanted.size.unwrap_or_else(|| self.drawing.coming_size());
        if let Some(recorder) = &mut self.run.recorder {
            recorder.note(&self.drawing.wanted, size, frame, again);
        }
    }
}
