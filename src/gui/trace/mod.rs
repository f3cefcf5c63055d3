//! The debugger: a pixel's way through its pass, gone forwards and backwards.
//!
//! Owns where in it one is, breakpoints and watches ([`Debugger`]), and the panel that shows them. What a moment holds,
//! and where a step leads to, is [`crate::debugger::trace`]'s.

mod buttons;
mod debugger;
mod divergence;
mod moment;
mod panel;
mod parts;
mod report;
mod rows;

pub(super) use debugger::Debugger;
pub(super) use panel::show;
