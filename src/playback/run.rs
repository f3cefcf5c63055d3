//! Frames that can be drawn again: the inputs of each, and the snapshot that they start from.

use eddy_engine::{FrameInputs, Snapshot};
use eddy_project::CustomUniformValues;
use std::sync::Arc;

/// The inputs of a frame.
#[derive(Clone)]
pub struct Frame {
    pub inputs: FrameInputs,
    pub values: Arc<CustomUniformValues>,
    /// The size of the canvas.
    pub size: (u32, u32),
}

/// The inputs of the frames up to the shown one.
pub struct Run {
    pub frames: Vec<Frame>,
    /// The first of them is the first since a reset.
    pub is_whole: bool,
}

/// The start of a run of frames to draw again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReplayFrom {
    /// A snapshot from about ten seconds of drawing ago, or the oldest after it.
    Oldest,
    /// The newest snapshot that is more than a frame before the shown one, if there is one: after a frame the targets
    /// also contain data that later frames do not read.
    Newest,
}

/// A run of frames that can be drawn again in another engine on the same device.
pub struct Replay {
    /// A snapshot of the targets before the first of the frames.
    pub snapshot: Arc<Snapshot>,
    pub frames: Vec<Frame>,
}
