//! Records the inputs of what is drawn.

use crate::drawing::Changes;
use eddy_engine::FrameInputs;
use eddy_playback::recording::{RecordedFrame, Recording};
use eddy_project::CustomUniformValues;

/// Takes down what each frame is drawn with.
pub(crate) struct Recorder {
    pub recording: Recording,
    /// The values as the engine has them.
    values: CustomUniformValues,
    /// The buffers are cleared before the next frame.
    is_reset: bool,
}

impl Recorder {
    /// Nothing has been drawn yet; the author's own uniforms have these values.
    pub(crate) fn new(project: String, values: CustomUniformValues) -> Self {
        Self { recording: Recording { project, frames: Vec::new() }, values, is_reset: false }
    }

    /// Takes down a job for the engine: its changes, the canvas that it has then, and its frame, or that it draws the
    /// last one again.
    pub(crate) fn note(&mut self, changes: &Changes, size: (u32, u32), frame: Option<&FrameInputs>, again: bool) {
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
