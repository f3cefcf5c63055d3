//! Owns what the window keeps of the open project, and of no other: it is made anew as a whole when another is opened.

use crate::gui::{
    buffers::Buffers, compare::Compare, measures::Measurements, passes::Passes, sound::Sound, trace::Debugger,
};
use std::sync::Arc;

/// The panels that are about the open project. The code keeps its editors by the project as well
/// ([`CodePanel`](crate::gui::code::CodePanel)); where panels are, how the picture fills its place, and what is looked
/// for are the person's.
pub(super) struct OfProject {
    /// Breakpoints, watched expressions, and where one is in a trace.
    pub debugger: Debugger,
    pub buffers: Buffers,
    pub compare: Compare,
    pub measurements: Measurements,
    pub passes: Passes,
    pub sound: Sound,
}

impl OfProject {
    /// `wake` is called when there is something to show.
    pub(super) fn new(wake: Arc<dyn Fn() + Send + Sync>) -> Self {
        Self {
            debugger: Debugger::default(),
            buffers: Buffers::default(),
            compare: Compare::new(wake),
            measurements: Measurements::default(),
            passes: Passes::default(),
            sound: Sound::default(),
        }
    }
}
