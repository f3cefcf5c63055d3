//! The declarations of a program: variables, functions, folded values.

use super::ids::{ConstId, ExprId, FuncId, StmtId};
use crate::{
    ast::{Ident, List, Loc, Precision, Symbol, TokenId},
    types::TypeId,
};
use std::ops::Range;

/// A file-scope variable.
#[derive(Clone, Copy, Debug)]
pub struct Global {
    pub name: Ident,
    pub ty: TypeId,
    pub storage: GlobalStorage,
    /// `None` is zero. May be any expression of type `ty` (ANGLE accepts non-constant ones, with a warning). Never set
    /// for `Const`.
    pub init: Option<ExprId>,
    /// The folded value: always for `Const`; for others if `init` is constant (lowering may then use either).
    pub value: Option<ConstId>,
    /// The whole declaration.
    pub loc: Loc,
    pub flags: VarFlags,
    /// The input or output is not interpolated.
    pub flat: bool,
    /// The location in the `layout` of an output.
    pub location: Option<u32>,
    /// The name of the uniform block that this is a member of, or represents.
    pub block: Option<Symbol>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum GlobalStorage {
    /// An ordinary global: one copy per invocation, initialised when the entry point starts.
    Private,
    /// `const`: uses are folded to `Literal` or `Const` with this `value`'s id, so no expression refers to the global.
    Const,
    /// A `uniform` the author declared: nothing sets it, so it reads as zero. (A sampler reads `iChannel0`, the texture
    /// unit that WebGL assigns by default: its uses are `Channel(0)`.) In a plain shader it is in a buffer, and the
    /// uses of a sampler are `Channel(n)` with its index in [`super::Module::samplers`].
    Uniform,
    /// `in`: in a pass no vertex shader writes it, so it reads as zero; in a stage the entry point sets it.
    In,
    /// `out`: private memory, which the entry point of a stage outputs.
    Out,
}

bitflags::bitflags! {
    /// The ways in which a variable is used anywhere in the text, reachable or not.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub struct VarFlags: u8 {
        /// Read or written by some expression.
        const USED = 1;
        /// Assigned, changed or passed as `out` or `inout`, in whole or in part. Without it the variable keeps the
        /// value of its declaration (or argument), and lowering needs no memory for it.
        const WRITTEN = 2;
        /// Some `Index` with a non-literal index has this variable at its root.
        const INDEXED = 4;
    }
}

/// A user function.
#[derive(Clone, Debug)]
pub struct Function {
    /// At its definition, or its first prototype if it has none.
    pub name: Ident,
    /// The names in all its prototypes, and in its definition; for editors.
    pub declared_at: Vec<TokenId>,
    pub result: TypeId,
    /// The function's slice of [`super::Module::locals`]: parameters first, in order, then every local of the body.
    /// Scopes are resolved; two variables of one name are two locals. The checker guarantees that bodies do not
    /// interleave.
    pub locals: Range<u32>,
    pub param_count: u32,
    /// The function's slice of [`super::Module::exprs`].
    pub exprs: Range<u32>,
    /// `None` if it is only declared (an error where it is called).
    pub body: Option<List<StmtId>>,
    /// The functions it calls, each once.
    pub calls: Vec<FuncId>,
    /// Reachable from the entry point: member of [`super::Module::call_order`].
    pub used: bool,
    /// The header, and the whole definition or prototype.
    pub header: Loc,
    pub loc: Loc,
}

/// A parameter or a local variable.
#[derive(Clone, Copy, Debug)]
pub struct Local {
    /// `None` for an unnamed parameter.
    pub name: Option<Ident>,
    pub ty: TypeId,
    pub kind: LocalKind,
    /// As written, or the default; it has no effect and is only for hover.
    pub precision: Option<Precision>,
    /// For `Const`: its value.
    pub value: Option<ConstId>,
    pub flags: VarFlags,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LocalKind {
    /// `in` (copied at the call; the function may write its copy). Samplers are always `In` and never written: lowering
    /// makes one copy of the function for each combination of channels that is passed.
    In,
    /// `const in`.
    ConstIn,
    /// Zero at entry, copied to the argument at return.
    Out,
    /// Copied in at the call and out at return.
    Inout,
    /// A local variable.
    Var,
    /// A `const` local: folded away like a [`GlobalStorage::Const`], and not declared by any statement.
    Const,
}

impl LocalKind {
    pub fn is_param(self) -> bool {
        matches!(self, LocalKind::In | LocalKind::ConstIn | LocalKind::Out | LocalKind::Inout)
    }

    /// Returns whether the argument is written at return, and must be a place.
    pub fn copies_out(self) -> bool {
        matches!(self, LocalKind::Out | LocalKind::Inout)
    }
}

/// A folded value of any type except void and samplers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Const {
    pub ty: TypeId,
    /// All scalars in memory order, 32 bits each: floats and ints bit for bit (NaN and infinities may occur), bools 0
    /// or 1; matrices column by column, structs member by member, arrays element by element. The number of words is the
    /// number of scalars in `ty`.
    pub words: List<u32>,
}
