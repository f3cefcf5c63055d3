//! The panel of buffers: one target down to its texels and their numbers, the texels of all targets below the pointer,
//! statistics of its values, and the render graph.
//!
//! Nothing is read back while it is closed; the page of the graph only gathers costs of passes.

mod canvas;
mod controls;
mod figures;
mod graph;
mod list;
mod numbers;
mod panel;
mod report;
mod search;
mod state;
mod zoom;

pub(super) use panel::PANEL;
pub(super) use state::Buffers;
