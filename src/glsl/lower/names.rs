//! Names of the author's, for who shows a program while it runs.

use crate::glsl::{ast::Symbol, ir};

/// The names in a program as lowering made it. A pass over the program may put others in the place of what they name.
#[derive(Debug, Default)]
pub(in crate::glsl) struct Names {
    /// By [`ir::FuncId::index`].
    pub functions: Vec<FunctionNames>,
    pub globals: Vec<(Symbol, ir::GlobalId)>,
    /// Of each structure its members, by [`StructId::index`](crate::glsl::types::StructId::index).
    pub members: Vec<Vec<Symbol>>,
}

/// The names in one function.
#[derive(Debug, Default)]
pub(in crate::glsl) struct FunctionNames {
    /// None of the code around the author's.
    pub name: Option<Symbol>,
    /// Parameters and local variables, in the order of their declarations: each is a value, or a place.
    pub locals: Vec<(Symbol, ir::Value)>,
}
