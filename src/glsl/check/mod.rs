//! Semantic analysis: checks types, scopes and every semantic rule of a syntax tree, and returns the typed program of
//! [`super::hir`] and diagnostics.
//!
//! Implements chapters 4 to 8 of the GLSL ES 3.00 specification: declarations, conversions (there are none), overloads,
//! places, constant expressions and their values, placement of statements, recursion, Shadertoy's uniforms and entry
//! points. It accepts what WebGL 2 accepts (ANGLE, Shadertoy's compiler): what the specification rejects is an error,
//! what only ANGLE rejects a warning. It reads no text, only tokens' symbols, and does not decide how a construct is
//! executed.
//!
//! One pass over the tree in text order. Expressions are checked in a loop over the arena (children come before
//! parents), so chains of operators may have any length; statements recurse, no deeper than the parser's nesting limit.
//! A scope is an undo stack over one table indexed by symbol, so looking up a name is one load.

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
mod graph;
mod header;
mod ops;
mod plain;
mod qualifiers;
mod redeclaration;
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
pub use env::{keyword_in_any_version, taken};
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

/// A program, with or without errors: the module exists for any tree, lowering requires one without errors.
#[derive(Debug)]
pub(crate) struct Checked {
    pub module: Module,
    /// In the order in which they were found, which is text order except for diagnostics of the whole program.
    pub diagnostics: Vec<Diagnostic>,
    /// Operations on constants whose results are undefined or not finite numbers.
    pub faults: Vec<Fault>,
    /// The name of the function that makes up the largest part of an error-free program.
    pub largest_function: Option<Span>,
}

/// Checks one pass with the syntax tree `ast`; the first of its texts may already be checked in `checkpoint`.
pub(crate) fn check(
    ast: &Ast,
    origins: &Origins,
    names: &Interner,
    source: &PassSource<'_>,
    checkpoint: Option<&Checkpoint>,
) -> Checked {
    let &PassSource { dialect, channels, custom_uniforms, samplers, values, common, cancel, .. } = source;
    let common = common.map(|text| text.id);
    let settings = Settings { dialect, channels, custom_uniforms, samplers, values, common, cancel };
    let mut checker = Checker::new(ast, origins, names, Env::Pass(source.kind), settings, checkpoint);
    on_deep_stack(|| checker.unit());
    let largest_function = checker.largest_function.map(|name| origins.span(name));
    Checked { module: checker.module, diagnostics: checker.diagnostics, faults: checker.faults, largest_function }
}

/// Returns what Shadertoy would reject in Common because it compiles it alone, where only `iDate` and `iSampleRate`
/// exist: one warning for each name that only passes have. Other errors are reported with the passes.
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

/// Checks Common once for every pass that is not a stage. `mentions` returns whether a name occurs in it: it must not
/// use any name of [`env::differ`], nor any custom uniform. Returns `None` if each pass has to check it.
pub(crate) fn check_common_prefix(
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
    checker.into_checkpoint()
}
