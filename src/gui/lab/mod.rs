//! The lab's panel: a study that runs in the background, drawn as it goes.
//!
//! Owns which study is shown, where results are kept, and the run. What is measured and how is `lab`'s; a run is heard
//! of over its channel, and a click on a point opens that point's project as any other.

mod axis;
mod colors;
mod header;
mod legend;
mod model;
mod panel;
mod plot;
mod state;

pub(super) use state::Lab;
