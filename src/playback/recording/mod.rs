//! Inputs of every frame of a run, so that it can be drawn again bit for bit: by `--replay`, and after an edit.
//!
//! Owns what a frame is given (time, date, mouse, keys, gamepads, what the microphone's texture holds, canvas, values of the author's own uniforms) and the file that
//! keeps it. Holds no picture and no text of the project: another text draws other pictures of the same inputs.

pub(crate) mod base64;
mod file;

pub use file::{EXTENSION, ReadError};

use eddy_engine::FrameInputs;
use eddy_project::CustomUniformValues;

/// Holds what a frame is drawn with.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedFrame {
    pub inputs: FrameInputs,
    /// The canvas, in pixels.
    pub size: (u32, u32),
    /// The author's own uniforms that are not at their defaults.
    pub values: CustomUniformValues,
    /// Every buffer is as before frame 0.
    pub reset: bool,
}

/// A run from its first frame on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recording {
    /// The project's name, for a person.
    pub project: String,
    pub frames: Vec<RecordedFrame>,
}

/// Holds what is new in a frame of a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    pub size: Option<(u32, u32)>,
    pub values: Option<CustomUniformValues>,
    pub reset: bool,
}

impl Recording {
    /// Returns what frame `index` changes after the one before it; the first one sets everything.
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
