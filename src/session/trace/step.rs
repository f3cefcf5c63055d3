//! A step of a trace.

use super::number::Number;
use eddy_diag::Span;

/// Says what happened in a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// A function of this name begins.
    Enter(String),
    /// The function that began last has ended.
    Leave,
    /// A loop begins its next turn, counted from 1 through all loops of the call. The last is the one whose test ends
    /// the loop.
    Turn(u64),
    /// A variable, or a part of one, takes a value: its name as GLSL spells it, and its scalars in memory order.
    Set { name: String, value: Vec<Number> },
}

/// A step of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    pub event: Event,
    /// Calls that the step lies in.
    pub depth: u32,
    /// The part of the text; none where it is no part of it.
    pub span: Option<Span>,
}
