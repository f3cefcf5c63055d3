//! Owns what is kept of a walk.

use super::super::number::Number;
use eddy_glsl::{types::TypeId, walkable::Walkable};

/// Control comes to a part of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Moment {
    pub kind: MomentKind,
    /// The statement: an id of the program's.
    pub(in crate::trace) statement: u32,
    /// An index into the calls.
    pub(in crate::trace) call: u32,
    /// Writes before it.
    pub(super) writes: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MomentKind {
    /// A statement is about to run.
    Statement,
    /// A loop is about to begin a turn, from 1: with its test, if that stands before its body.
    Iteration(u32),
    /// A loop is about to do the test behind its body.
    Test,
    /// A loop is about to do what it does between two turns.
    Step,
    /// The function has done its last statement.
    Return,
}

/// An activation of one of the author's functions.
#[derive(Clone, Debug, PartialEq)]
pub struct Call {
    pub name: String,
    /// The call that it was made in, and the last moment before it.
    pub parent: Option<u32>,
    pub from: u32,
    /// Calls that it lies in.
    pub depth: u32,
    /// The function's variables lie from here on among the slots.
    pub(super) slots: u32,
    pub(super) function: u32,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Write {
    /// Says where the words begin.
    pub words: u32,
    /// Words of the variable before those that are written, and how many are.
    pub offset: u32,
    pub count: u32,
    /// The write to the same variable before it.
    pub previous: u32,
}

/// No write.
pub(super) const NONE: u32 = u32::MAX;

/// A variable of a function or of the module.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    pub name: String,
    pub ty: TypeId,
    /// The local variable that it is, by its place among the program's.
    pub local: Option<u32>,
    /// Holds what it always holds.
    pub constant: Option<Vec<u32>>,
}

/// A turn of a loop, by moments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Iteration {
    pub first: usize,
    /// Its last statement.
    pub last: usize,
    /// Before what the loop does between two turns; the last statement where it comes to that no more.
    pub end: usize,
}

/// Holds what a name stands for at a moment.
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
    /// It is a vector of floats, which can be a colour.
    pub is_vector: bool,
    pub(in crate::trace) words: Vec<u32>,
}

/// The way of a pixel.
pub struct History {
    pub(super) walkable: Walkable,
    pub moments: Vec<Moment>,
    pub calls: Vec<Call>,
    /// More happened than was kept.
    pub is_cut: bool,
    pub(super) writes: Vec<Write>,
    pub(super) words: Vec<u32>,
    /// The newest write to each variable of each call; first those of the module.
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
