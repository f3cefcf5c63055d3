//! Records the inputs of what is drawn, and writes them to a file.

use super::{
    Session,
    drawing::Changes,
    view::{About, Level},
};
use eddy_engine::FrameInputs;
use eddy_playback::{
    capture,
    recording::{EXTENSION, RecordedFrame, Recording},
};
use eddy_project::CustomUniformValues;

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

/// Takes down what each frame is drawn with.
pub(super) struct Recorder {
    pub recording: Recording,
    /// The values as the engine has them.
    values: CustomUniformValues,
    /// The buffers are cleared before the next frame.
    is_reset: bool,
}

impl Recorder {
    /// Nothing has been drawn yet; the author's own uniforms have these values.
    pub fn new(project: String, values: CustomUniformValues) -> Self {
        Self { recording: Recording { project, frames: Vec::new() }, values, is_reset: false }
    }

    /// Takes down a job for the engine: its changes, the canvas that it has then, and its frame, or that it draws the
    /// last one again.
    pub fn note(&mut self, changes: &Changes, size: (u32, u32), frame: Option<&FrameInputs>, again: bool) {
        self.is_reset |= changes.reset;
        if let Some(values) = &changes.custom_uniforms {
            self.values.clone_from(values);
        }
        if let Some(last) = self.recording.frames.last_mut().filter(|_| again) {
            (last.size, last.values) = (size, self.values.clone());
        }
        if let Some(inputs) = frame {
            let (inputs, values) = (inputs.clone(), self.values.clone());
            let reset = std::mem::take(&mut self.is_reset);
            self.recording.frames.push(RecordedFrame { inputs, size, values, reset });
        }
    }
}
