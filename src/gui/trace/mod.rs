//! The debugger: the trace of a pixel through its pass, stepped forwards and backwards.
//!
//! Owns the position in the trace, breakpoints and watches ([`Debugger`]), and the panel that shows them.
//! [`crate::debugger::trace`] computes the contents of a moment and the target of a step.

mod buttons;
mod debugger;
mod divergence;
mod moment;
mod panel;
mod parts;
mod report;
mod rows;

pub(super) use debugger::Debugger;
pub(super) use panel::PANEL;
