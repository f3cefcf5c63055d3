//! Types, scopes and every rule of meaning: a syntax tree in, the typed program of [`super::hir`] and what is wrong
//! out.
//!
//! Owns chapters 4 to 8 of the GLSL ES 3.00 specification: declarations, conversions (there are none), overloads,
//! places, constant expressions and their values, placement of statements, recursion, the site's uniforms and entry
//! points. It judges as WebGL 2 does (ANGLE, the site's compiler): what that refuses is an error, what only ANGLE
//! refuses a warning. It reads no text, only tokens' symbols, and decides nothing about how a construct is executed.
//!
//! One pass over the tree in text order. Expressions are checked in a loop over the arena (children come before
//! parents), so no chain of operators is too long; statements recurse, no deeper than the parser's nesting limit. A
//! scope is an undo stack over one table indexed by symbol, so looking a name up is one load.

mod access;
mod call;
mod checker;
mod construct;
mod conversion;
mod declare;
pub(in crate::glsl) mod env;
mod expr;
mod facts;
mod fold;
mod fold_builtin;
mod function;
mod given;
mod graph;
mod header;
mod ops;
pub(in crate::glsl) mod overloads;
mod qualifiers;
mod scope;
mod size;
mod statement;
mod suggest;
mod types;
mod words;

#[cfg(test)]
mod tests;

pub(crate) use env::knob_type;
pub use env::taken;

use super::{
    ast::{Ast, Interner, Origins},
    hir::Module,
    source::{ChannelKind, Knob, PassSource},
};
use crate::diag::Diagnostic;
use checker::Checker;
use env::Env;

/// A program, right or wrong: the module exists for any tree, lowering wants one without errors.
#[derive(Debug)]
pub(crate) struct Checked {
    pub module: Module,
    /// In the order in which they were found, which is text order but for what concerns the whole program.
    pub diagnostics: Vec<Diagnostic>,
}

/// Checks one pass, whose texts `ast` is of.
pub(crate) fn check(ast: &Ast, origins: &Origins, names: &Interner, source: &PassSource<'_>) -> Checked {
    let mut checker = Checker::new(ast, origins, names, Env::Pass(source.kind), source.channels, source.knobs);
    checker.values = source.values;
    checker.common = source.common.map(|text| text.id);
    checker.unit();
    Checked { module: checker.module, diagnostics: checker.diagnostics }
}

/// Returns what the site would refuse in Common because it compiles it alone, where only `iDate` and `iSampleRate`
/// exist: one warning for each name that only passes have. What is wrong in any case is left to the passes, which
/// report it.
pub(crate) fn check_common(ast: &Ast, origins: &Origins, names: &Interner, knobs: &[Knob<'_>]) -> Vec<Diagnostic> {
    let mut checker = Checker::new(ast, origins, names, Env::Common, [ChannelKind::Sampler2D; 4], knobs);
    checker.unit();
    checker.refused_in_common
}
