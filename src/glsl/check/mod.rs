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
mod checkpoint;
mod construct;
mod conversion;
mod declare;
pub(crate) mod env;
mod expr;
mod facts;
mod fault;
mod float_hash;
mod fold;
mod function;
mod given;
mod graph;
mod header;
mod ops;
mod plain;
mod qualifiers;
mod scope;
mod size;
mod statement;
mod suggest;
mod types;
mod uniform_values;
mod words;

#[cfg(test)]
mod tests;

pub(crate) use checkpoint::Checkpoint;
pub(crate) use env::custom_uniform_type;
pub use env::taken;
pub(crate) use fault::Fault;

use super::{
    ast::{Ast, Interner, Origins},
    hir::Module,
    source::{CustomUniform, PassSource, UniformValue},
    stack::on_deep_stack,
};
use checker::{Checker, Settings};
use eddy_diag::{Diagnostic, Span};
use env::Env;

/// A program, right or wrong: the module exists for any tree, lowering wants one without errors.
#[derive(Debug)]
pub(crate) struct Checked {
    pub module: Module,
    /// In the order in which they were found, which is text order but for what concerns the whole program.
    pub diagnostics: Vec<Diagnostic>,
    /// Operations on constants whose results are open or no finite numbers.
    pub faults: Vec<Fault>,
    /// The name of the function that most of the program lies in, of a program without errors.
    pub bulk: Option<Span>,
}

/// Checks one pass, whose texts `ast` is of; the first of them may have `begun` it.
pub(crate) fn check(
    ast: &Ast,
    origins: &Origins,
    names: &Interner,
    source: &PassSource<'_>,
    checkpoint: Option<&Checkpoint>,
) -> Checked {
    let &PassSource { dialect, channels, custom_uniforms, values, common, cancel, .. } = source;
    let settings = Settings { dialect, channels, custom_uniforms, values, common: common.map(|text| text.id), cancel };
    let mut checker = Checker::new(ast, origins, names, Env::Pass(source.kind), settings, checkpoint);
    on_deep_stack(|| checker.unit());
    let bulk = checker.bulk.map(|name| origins.span(name));
    Checked { module: checker.module, diagnostics: checker.diagnostics, faults: checker.faults, bulk }
}

/// Returns what the site would refuse in Common because it compiles it alone, where only `iDate` and `iSampleRate`
/// exist: one warning for each name that only passes have. What is wrong in any case is left to the passes, which
/// report it.
pub(crate) fn check_common(
    ast: &Ast,
    origins: &Origins,
    names: &Interner,
    custom_uniforms: &[CustomUniform<'_>],
) -> Vec<Diagnostic> {
    let settings = Settings { custom_uniforms, ..Settings::default() };
    let mut checker = Checker::new(ast, origins, names, Env::Common, settings, None);
    on_deep_stack(|| checker.unit());
    checker.refused_in_common
}

/// Checks Common for every pass that is no stage at once. `mentions` tells whether a name stands in it: it must name
/// nothing that [`env::differ`] has, nor any of the author's own uniforms. `None`: each pass has to check it.
pub(crate) fn begin(
    ast: &Ast,
    origins: &Origins,
    names: &Interner,
    values: &[UniformValue],
    mut mentions: impl FnMut(&str) -> bool,
) -> Option<Checkpoint> {
    if env::differ().any(&mut mentions) {
        return None;
    }
    let settings = Settings { values, ..Settings::default() };
    let mut checker = Checker::new(ast, origins, names, Env::Common, settings, None);
    on_deep_stack(|| checker.declarations());
    checker.into_begun()
}
