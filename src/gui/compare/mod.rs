//! The panel that compares this project's picture with that of its last save, of another project or of a revision,
//! drawn from the same inputs, and shows how much they differ in picture and speed.
//!
//! Nothing is drawn for it unless requested.

mod figures;
mod panel;
mod pictures;
mod report;
mod state;

pub(super) use panel::PANEL;
pub(super) use state::Compare;
