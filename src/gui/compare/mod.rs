//! The panel that compares: this project's picture against that of its last save, of another project or of a revision,
//! from the same inputs, and how far and how fast they are.
//!
//! Nothing is drawn for it but what somebody has asked for.

mod figures;
mod panel;
mod pictures;
mod report;
mod state;

pub(super) use panel::show;
pub(super) use report::report;
pub(super) use state::Compare;
