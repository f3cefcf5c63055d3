//! The window's state that belongs to the open project. All of it is replaced when another project is opened.

use crate::gui::{
    buffers::Buffers, compare::Compare, measures::Measurements, passes::Passes, sound::Sound, trace::Debugger,
};
use std::sync::Arc;

/// The panels about the open project. The code also keeps its editors per project
/// ([`CodePanel`](crate::gui::code::CodePanel)); the layout of panels, how the picture fits its place and the search
/// text belong to the user.
pub(super) struct OfProject {
    /// Breakpoints, watched expressions and the position in a trace.
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
