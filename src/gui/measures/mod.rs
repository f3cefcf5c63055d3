//! The panel of measurements: a card for every `//@probe` comment, with its value over time.
//!
//! Owns which cards are visible, and reports them to the session: cards that are scrolled out, or in a panel that is
//! closed or covered, are not measured.

mod card;
mod number;
mod panel;
mod plot;
mod report;
mod state;

pub(super) use panel::PANEL;
pub(super) use state::Measurements;
