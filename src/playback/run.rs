//! Frames that can be drawn again: what each was drawn with, and a snapshot that they begin with.

use eddy_engine::{FrameInputs, Snapshot};
use eddy_project::CustomUniformValues;
use std::sync::Arc;

/// Holds what a frame was drawn with.
#[derive(Clone)]
pub struct Frame {
    pub inputs: FrameInputs,
    pub values: Arc<CustomUniformValues>,
    /// The size of the canvas.
    pub size: (u32, u32),
}

/// Holds what the frames up to the one that is shown were drawn with.
pub struct Run {
    pub frames: Vec<Frame>,
    /// The first of them is the first since a reset.
    pub is_whole: bool,
}

/// Says where a run of frames begins that is drawn again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReplayFrom {
    /// With a snapshot of some ten seconds of drawing ago, or the oldest after it.
    Oldest,
    /// With the newest snapshot that lies more than a frame before the one that is shown, where there is one: after a
    /// frame the targets hold also what later frames do not read.
    Newest,
}

/// A run of frames that can be drawn again elsewhere on the same device.
pub struct Replay {
    /// The targets before the first of the frames.
    pub snapshot: Arc<Snapshot>,
    pub frames: Vec<Frame>,
}
