//! The author's names, for tools that show a program while it runs.

use rustc_hash::FxHashMap;

use crate::{
    ast::{Loc, Symbol},
    builtins::Builtin,
    hir::LocalId,
    ir,
};

/// The names in a lowered program. A pass over the program may replace the named values.
#[derive(Debug, Default)]
pub(crate) struct Names {
    /// By [`ir::FuncId::index`].
    pub functions: Vec<FunctionNames>,
    /// Globals, each with the location of its name.
    pub globals: Vec<(Symbol, ir::GlobalId, Loc)>,
    /// By function and value: only if requested.
    pub preconditions: FxHashMap<(ir::FuncId, ir::Value), Precondition>,
    /// The members of each structure, by [`StructId::index`](crate::types::StructId::index).
    pub members: Vec<Vec<Symbol>>,
}

/// The names in one function.
#[derive(Debug, Default)]
pub(crate) struct FunctionNames {
    /// `None` for generated code.
    pub name: Option<Symbol>,
    /// Parameters and local variables in declaration order, each with its value or place.
    pub locals: Vec<(Symbol, ir::Value)>,
    /// Zeros in place of values that GLSL leaves undefined, if these are marked.
    pub undefined: Vec<Unset>,
    /// The variables of `locals`, in the same order.
    pub ids: Vec<LocalId>,
    /// Values whose only purpose is to mark that control reaches a part of the text; only if requested.
    pub marks: Vec<(ir::Value, StatementEvent)>,
}

/// A value that GLSL leaves undefined, with the declaration that should have initialised it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Unset {
    /// The zero in its place; or a variable of the function whose declaration a `switch` may skip, which has no value
    /// when the function starts.
    pub value: ir::Value,
    pub kind: UnsetKind,
    pub name: Symbol,
    /// The location of the name.
    pub loc: Loc,
}

/// The kind of declaration that leaves a value undefined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnsetKind {
    /// A variable of a function or of the module (section 4.3.1 of the GLSL ES 3.00 specification).
    Variable,
    /// An `out` parameter (section 6.1.1).
    Parameter,
    /// The result of a function that ends without a `return` (section 6.1).
    Result,
}

/// A condition on operands without which GLSL leaves a result undefined. It is recorded for the operation with which
/// lowering guards the operands, or for the result.
#[derive(Clone, Debug)]
pub enum Precondition {
    /// The arguments of a built-in function are in none of its gaps.
    Call(Builtin, Vec<ir::Value>),
    /// The divisor of integers is not zero.
    Divisor(ir::Value),
    /// The shift distance is less than the number of bits.
    Distance(ir::Value),
    /// An index is below a length.
    Index(ir::Value, u32),
}

/// Control reaches a part of a statement, which is identified by its number in
/// [`Statements`](crate::statements::Statements).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StatementEvent {
    /// The statement starts.
    Start(u32),
    /// A loop starts an iteration: with its test, if that comes before its body.
    Iteration(u32),
    /// A loop reaches the test after its body.
    Test(u32),
    /// A loop reaches the step between two iterations.
    Step(u32),
}

/// The marks in a program for the CPU interpreter; a device needs none.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Marks {
    /// Zeros in place of undefined values are distinguished from zeros that the author wrote
    /// ([`FunctionNames::undefined`]), and preconditions are recorded ([`Names::preconditions`]).
    pub undefined: bool,
    /// The start of each statement is marked ([`FunctionNames::marks`]).
    pub statements: bool,
}
