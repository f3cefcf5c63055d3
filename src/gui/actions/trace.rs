//! Owns what keys and the palette can ask of the debugger.

use crate::debugger::trace::travel::{Direction, Stride};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TraceAction {
    Go(Stride, Direction),
    /// To the next breakpoint.
    Continue(Direction),
    /// To the line of the caret.
    ToCursor(Direction),
    /// To the begin or the end of all.
    End(Direction),
    /// Sets a breakpoint at the line of the caret, or takes it away.
    Breakpoint,
}
