//! The recorded data of a walk.

use super::super::number::Number;
use eddy_glsl::{types::TypeId, walkable::Walkable};

/// Control reaches a part of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Moment {
    pub kind: MomentKind,
    /// The id of the statement in the program.
    pub(in crate::trace) statement: u32,
    /// An index into the calls.
    pub(in crate::trace) call: u32,
    /// The number of earlier writes.
    pub(super) writes: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MomentKind {
    /// A statement is about to run.
    Statement,
    /// A loop is about to start an iteration, numbered from 1: with its test, if that comes before its body.
    Iteration(u32),
    /// A loop is about to run the test after its body.
    Test,
    /// A loop is about to run its step between two iterations.
    Step,
    /// The function has run its last statement.
    Return,
}

/// An activation of one of the author's functions.
#[derive(Clone, Debug, PartialEq)]
pub struct Call {
    pub name: String,
    /// The calling activation, and the last moment before the call.
    pub parent: Option<u32>,
    pub from: u32,
    /// The number of enclosing calls.
    pub depth: u32,
    /// The first slot of the function's variables.
    pub(super) slots: u32,
    pub(super) function: u32,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Write {
    /// The index of the first word.
    pub words: u32,
    /// The offset in the variable of the written words, and their number.
    pub offset: u32,
    pub count: u32,
    /// The previous write to the same variable.
    pub previous: u32,
}

/// The index for no write.
pub(super) const NONE: u32 = u32::MAX;

/// A variable of a function or of the module.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    pub name: String,
    pub ty: TypeId,
    /// The index of the local variable among the program's.
    pub local: Option<u32>,
    /// Its constant value, if it is never written.
    pub constant: Option<Vec<u32>>,
}

/// An iteration of a loop, by moments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Iteration {
    pub first: usize,
    /// Its last statement.
    pub last: usize,
    /// The moment before the loop's step between two iterations; the last statement if the step is not reached.
    pub end: usize,
}

/// The value of a name at a moment.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedValue {
    pub name: String,
    pub value: Value,
}

/// A value of the language.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    pub type_text: String,
    /// Every scalar in memory order.
    pub numbers: Vec<Number>,
    /// True for a vector of floats, which can be a colour.
    pub is_vector: bool,
    pub(in crate::trace) words: Vec<u32>,
}

/// The execution of a pixel.
pub struct History {
    pub(super) walkable: Walkable,
    pub moments: Vec<Moment>,
    pub calls: Vec<Call>,
    /// The limit was exceeded: the rest was not recorded.
    pub is_cut: bool,
    pub(super) writes: Vec<Write>,
    pub(super) words: Vec<u32>,
    /// The newest write to each variable of each call; the module's variables come first.
    pub(super) slots: Vec<u32>,
    pub(super) globals: Vec<Variable>,
    /// The variables of each function.
    pub(super) variables: Vec<Vec<Variable>>,
}

impl std::fmt::Debug for History {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("History").field("moments", &self.moments.len()).finish_non_exhaustive()
    }
}
