//! The panel "Speed and error": the knobs of the open project, what each does to time and picture, and the frontier.
//!
//! Nothing is measured for it unless requested. A setting is tried by its picture, which the search kept; it changes the
//! texts only when it is applied, as one edit that can be undone.

mod panel;
mod plot;
mod state;

pub(super) use panel::PANEL;
pub(super) use state::Speed;
