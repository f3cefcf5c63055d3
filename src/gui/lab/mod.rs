//! The lab's panel: a study that runs in the background, plotted while it runs.
//!
//! Owns the selected study, the folder for results, and the run. `lab` measures; a run reports over its channel, and a
//! click on a point opens that point's project like any other.

pub(super) mod axis;
mod colors;
mod header;
mod legend;
mod model;
mod panel;
mod plot;
mod state;

pub(super) use panel::PANEL;
pub(super) use state::Lab;
