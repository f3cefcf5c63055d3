//! The panel of measurements: a card for every `//@probe` comment, with its number over time.
//!
//! Owns which cards are in sight, and tells the session: what is out of sight, or in a panel that is closed or covered,
//! is not measured.

mod card;
mod number;
mod panel;
mod plot;
mod report;
mod state;

pub(super) use panel::show;
pub(super) use report::report;
pub(super) use state::Measurements;
