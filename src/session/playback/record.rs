//! Records the inputs of drawn frames.

use crate::drawing::PendingChanges;
use eddy_engine::FrameInputs;
use eddy_playback::recording::{RecordedFrame, Recording};
use eddy_project::CustomUniformValues;

/// Records the inputs of each frame.
pub(crate) struct Recorder {
    pub recording: Recording,
    /// The values that the engine has.
    values: CustomUniformValues,
    /// The buffers are cleared before the next frame.
    is_reset: bool,
}

impl Recorder {
    /// A recorder before the first frame, with these values of the author's own uniforms.
    pub(crate) fn new(project: String, values: CustomUniformValues) -> Self {
        Self { recording: Recording { project, frames: Vec::new() }, values, is_reset: false }
    }

    /// Records a job for the engine: its changes, the resulting canvas size, and its frame, or that it draws the last
    /// one again.
    pub(crate) fn note(
        &mut self,
        changes: &PendingChanges,
        size: (u32, u32),
        frame: Option<&FrameInputs>,
        again: bool,
    ) {
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
