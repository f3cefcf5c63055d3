//! Records the inputs of drawn frames.

use crate::drawing::{Change, Draw, PendingChanges};
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

    /// Records a job for the engine: its changes, the resulting canvas size, and its frame. `stays`: before a new frame
    /// the last one is drawn again, with the changes.
    pub(crate) fn note(&mut self, changes: &PendingChanges, size: (u32, u32), draw: &Draw, stays: bool) {
        for change in changes.iter() {
            match change {
                Change::Reset => self.is_reset = true,
                Change::CustomUniforms(values) => self.values.clone_from(values),
                _ => {}
            }
        }
        let again = matches!(draw, Draw::Again) || (stays && matches!(draw, Draw::Next(_)));
        if let Some(last) = self.recording.frames.last_mut().filter(|_| again) {
            (last.size, last.values) = (size, self.values.clone());
        }
        if let Draw::Next(inputs) = draw {
            let (inputs, values) = (inputs.clone(), self.values.clone());
            let reset = std::mem::take(&mut self.is_reset);
            self.recording.frames.push(RecordedFrame { inputs, size, values, reset });
        }
    }
}
