//! Names of the author's, for who shows a program while it runs.

use rustc_hash::FxHashMap;

use crate::{
    ast::{Loc, Symbol},
    builtins::Builtin,
    hir::LocalId,
    ir,
};

/// The names in a program as lowering made it. A pass over the program may put others in the place of what they name.
#[derive(Debug, Default)]
pub(crate) struct Names {
    /// By [`ir::FuncId::index`].
    pub functions: Vec<FunctionNames>,
    /// Variables of the module, each with the place of its name.
    pub globals: Vec<(Symbol, ir::GlobalId, Loc)>,
    /// By function and value: only where they are asked for.
    pub preconditions: FxHashMap<(ir::FuncId, ir::Value), Precondition>,
    /// The members of each structure, by [`StructId::index`](crate::types::StructId::index).
    pub members: Vec<Vec<Symbol>>,
}

/// The names in one function.
#[derive(Debug, Default)]
pub(crate) struct FunctionNames {
    /// None of the code around the author's.
    pub name: Option<Symbol>,
    /// Parameters and local variables, in the order of their declarations: each name has a value, or a place.
    pub locals: Vec<(Symbol, ir::Value)>,
    /// Zeros in place of values that GLSL leaves undefined, where these are marked.
    pub undefined: Vec<Unset>,
    /// The variables of `locals`, in the same order.
    pub ids: Vec<LocalId>,
    /// Values that mean nothing but that control has come to a part of the text; only where they are asked for.
    pub marks: Vec<(ir::Value, StatementEvent)>,
}

/// A value that GLSL leaves undefined, by the declaration that should have given it one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Unset {
    /// The zero in its place; or a variable of the function whose declaration a jump of a `switch` may pass over, which
    /// has no value when the function starts.
    pub value: ir::Value,
    pub kind: UnsetKind,
    pub name: Symbol,
    /// The place of the name.
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

/// Operands that GLSL leaves a result undefined for. It is noted of the operation that lowering keeps the device from
/// them by, or of the result.
#[derive(Clone, Debug)]
pub enum Precondition {
    /// Arguments of a built-in function are in none of its gaps.
    Call(Builtin, Vec<ir::Value>),
    /// The divisor of integers is not zero.
    Divisor(ir::Value),
    /// The bits that a shift goes by are fewer than there are.
    Distance(ir::Value),
    /// An index is below a length.
    Index(ir::Value, u32),
}

/// Control comes to a part of a statement, which [`Statements`](crate::statements::Statements) tells of by this number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StatementEvent {
    /// It begins.
    Begin(u32),
    /// A loop begins an iteration: with its test, if that stands before its body.
    Iteration(u32),
    /// A loop comes to the test behind its body.
    Test(u32),
    /// A loop comes to what it does between two iterations.
    Step(u32),
}

/// Marks in a program for who walks through it; a device needs none.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Marks {
    /// Zeros in place of undefined values are told from zeros that the author wrote ([`FunctionNames::undefined`]), and
    /// preconditions are noted ([`Names::preconditions`]).
    pub undefined: bool,
    /// The beginning of each statement is marked ([`FunctionNames::marks`]).
    pub statements: bool,
}
