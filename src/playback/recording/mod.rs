//! The inputs of every frame of a run, from which it can be drawn again bit for bit: by `--replay`, and after an edit.
//!
//! Owns the inputs of a frame (time, date, mouse, keys, gamepads, the content of the microphone's texture, canvas,
//! values of the author's own uniforms) and the file that stores them. It contains no picture and no text of the
//! project: another text draws other pictures from the same inputs.

pub(crate) mod base64;
mod file;

pub use file::{EXTENSION, ReadError};

use eddy_engine::FrameInputs;
use eddy_project::CustomUniformValues;

/// The inputs of a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedFrame {
    pub inputs: FrameInputs,
    /// The canvas, in pixels.
    pub size: (u32, u32),
    /// The author's own uniforms that differ from their defaults.
    pub values: CustomUniformValues,
    /// Every buffer is reset to its state before frame 0.
    pub reset: bool,
}

/// A run from its first frame on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recording {
    /// The project's name, for display.
    pub project: String,
    pub frames: Vec<RecordedFrame>,
}

/// The changes before a frame of a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    pub size: Option<(u32, u32)>,
    pub values: Option<CustomUniformValues>,
    pub reset: bool,
}

impl Recording {
    /// Returns the changes of frame `index` relative to the previous one; the first one sets everything.
    pub fn change(&self, index: usize) -> Option<(Change, &FrameInputs)> {
        let frame = self.frames.get(index)?;
        let before = index.checked_sub(1).map(|before| &self.frames[before]);
        let change = Change {
            size: before.is_none_or(|before| before.size != frame.size).then_some(frame.size),
            values: before.is_none_or(|before| before.values != frame.values).then(|| frame.values.clone()),
            reset: frame.reset && before.is_some(),
        };
        Some((change, &frame.inputs))
    }
}

#[cfg(test)]
mod tests;
