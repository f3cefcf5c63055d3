//! The parser (chapter 9): tokens to [`Ast`], with recovery.
//!
//! Owns [`parse`], every message about form, and reserved words. Whether names exist, types fit or a statement is at
//! its place is the checker's. No symbol table is needed: two names in a row are a declaration, a name before `[..](` a
//! constructor, and everything else is decided by the first tokens.
//!
//! Recovery: a mistake gives up the smallest group around it that can be told apart (an initialiser, a parameter, a
//! condition, a statement, a declaration), leaves an `Error` node there and goes on. A message is not repeated for the
//! same token, and nothing is said about operands that the preprocessor has reported.

pub(super) mod brackets;
mod decl;
mod expr;
mod function;
mod hint;
mod parser;
mod recover;
mod slips;
mod stmt;
mod tests;
mod types;

pub(super) use hint::foreign_type;

use super::{
    ast::{Ast, Interner, Origins},
    lex::words,
    pieces::{self, Piece},
    preprocess::{Unit, preprocess},
    report::Report,
    source::PassSource,
};
use crate::diag::Diagnostic;
use parser::Parser;

/// A pass as the checker takes it.
#[derive(Clone)]
pub(crate) struct Parsed {
    pub ast: Ast,
    pub origins: Origins,
    pub names: Interner,
    /// Errors and warnings of preprocessor and parser, in the order they were found.
    pub diagnostics: Vec<Diagnostic>,
}

/// Preprocesses and parses a pass behind its Common. Any text gives a tree.
pub(crate) fn parse(source: &PassSource<'_>) -> Parsed {
    let texts: Vec<_> = source.common.into_iter().chain([source.code]).collect();
    parse_texts(&pieces::of(&texts, source.includes), Unit::Pass(source.kind))
}

/// Preprocesses and parses texts that follow each other.
pub(super) fn parse_texts(pieces: &[Piece<'_>], unit: Unit) -> Parsed {
    let mut names = words::interner();
    let mut report = Report::default();
    let pre = preprocess(pieces, unit, &mut names, &mut report);
    let mut tokens = pre.tokens;
    brackets::pair(&mut tokens);
    let count = tokens.len();
    let mut parser = Parser {
        tokens,
        at: 0,
        ast: Ast::default(),
        origins: pre.origins,
        names: &names,
        report: &mut report,
        pieces,
        depth: 0,
        deepest: 0,
        expr_stack: Vec::new(),
        stmt_stack: Vec::new(),
        declarators: Vec::new(),
        last_error: pre.is_cut.then_some(count - 1),
        reserved_told: Vec::new(),
        structs: vec![false; names.len()],
        body: None,
        adrift: false,
        too_deep_told: false,
    };
    parser.ast.exprs.reserve(count / 2);
    parser.file();
    let Parser { ast, origins, .. } = parser;
    Parsed { ast, origins, names, diagnostics: report.diagnostics }
}
