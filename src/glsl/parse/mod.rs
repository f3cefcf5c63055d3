//! The parser (chapter 9): tokens to [`Ast`], with recovery.
//!
//! Owns [`parse`], every message about syntax, and reserved words. Whether names exist, types match or a statement is
//! allowed at its place is left to the checker. No symbol table is needed: two names in a row are a declaration, a name
//! before `[..](` is a constructor, and everything else is decided by the first tokens.
//!
//! Recovery: on an error the parser abandons the smallest recognisable group around it (an initialiser, a parameter, a
//! condition, a statement, a declaration), leaves an `Error` node there and continues. No second message is reported
//! for the same token, and none for operands that the preprocessor has reported.

pub(super) mod brackets;
mod decl;
mod expr;
mod function;
mod hint;
mod later;
mod mistakes;
mod parser;
mod recover;
mod stmt;
mod tests;
mod types;

pub(super) use hint::foreign_type;

use super::{
    ast::{Ast, DeclKind, Interner, Origins, with_room},
    cancel::Cancel,
    lex::{Kind, words},
    pieces::{self, Piece},
    preprocess::{MacroTable, Preprocessed, Tok, Unit, preprocess},
    report::Report,
    source::{Dialect, PassSource},
    stack::on_deep_stack,
};
use parser::Parser;

/// Parsed texts for the checker, and the state from which further texts are parsed.
#[derive(Clone)]
pub(crate) struct Parsed {
    pub ast: Ast,
    pub origins: Origins,
    pub names: Interner,
    /// Errors and warnings of preprocessor and parser, in the order they were found.
    pub(super) report: Report,
    reader: Reader,
}

/// State that texts pass on to the texts that follow them.
#[derive(Default)]
struct Reader {
    /// The same number as `origins.tokens`.
    tokens: Vec<Tok>,
    macros: MacroTable,
    /// The number of pieces that were read.
    pieces: usize,
    has_line_numbers: bool,
    /// True if a struct has the name, by symbol.
    structs: Vec<bool>,
}

impl Clone for Reader {
    fn clone(&self) -> Self {
        Self {
            tokens: with_room(&self.tokens),
            macros: self.macros.clone(),
            pieces: self.pieces,
            has_line_numbers: self.has_line_numbers,
            structs: with_room(&self.structs),
        }
    }
}

impl Parsed {
    /// Returns the state before the first text.
    fn nothing() -> Self {
        Self {
            ast: Ast::default(),
            origins: Origins::default(),
            names: words::interner(),
            report: Report::default(),
            reader: Reader::default(),
        }
    }

    /// Returns whether the meaning of these texts is independent of what follows and of the unit: they end between two
    /// declarations, with all conditionals and comments closed, and do not use line numbers.
    pub(crate) fn is_self_contained(&self) -> bool {
        !self.report.has_errors() && !self.reader.has_line_numbers
    }

    /// Returns for each symbol whether some token is this name.
    pub(crate) fn mentioned(&self) -> Vec<bool> {
        let mut mentioned = vec![false; self.names.len()];
        for token in self.reader.tokens.iter().filter(|token| token.kind == Kind::Ident) {
            mentioned[token.value as usize] = true;
        }
        mentioned
    }
}

/// Preprocesses and parses a pass after its Common, which may have been parsed `already`. Every text results in a tree.
pub(crate) fn parse(source: &PassSource<'_>, already: Option<&Parsed>) -> Parsed {
    let texts: Vec<_> = source.common.into_iter().chain([source.code]).collect();
    let pieces = pieces::of(&texts, source.includes, source.includes_once);
    let unit = (Unit::Pass(source.kind), source.dialect, source.cancel);
    read(&pieces, unit, already.map_or_else(Parsed::nothing, Parsed::clone))
}

/// Preprocesses and parses Common by itself.
pub(super) fn parse_common(pieces: &[Piece<'_>]) -> Parsed {
    read(pieces, (Unit::CommonAlone, Dialect::default(), Cancel::default()), Parsed::nothing())
}

/// Preprocesses and parses the pieces after those of `done`.
fn read(pieces: &[Piece<'_>], unit: (Unit, Dialect, Cancel<'_>), done: Parsed) -> Parsed {
    on_deep_stack(|| read_here(pieces, unit, done))
}

fn read_here(pieces: &[Piece<'_>], (unit, dialect, cancel): (Unit, Dialect, Cancel<'_>), done: Parsed) -> Parsed {
    let Parsed { ast, origins, mut names, mut report, reader } = done;
    let Reader { tokens, macros, pieces: count, has_line_numbers, mut structs } = reader;
    let start = tokens.len().saturating_sub(1);
    let done =
        Preprocessed { tokens, origins, macros, pieces: count, is_cut: false, has_line_numbers, is_stopped: false };
    let Preprocessed { mut tokens, origins, macros, pieces: count, is_cut, has_line_numbers, is_stopped } =
        preprocess(pieces, (unit, dialect, cancel), done, &mut names, &mut report);
    brackets::pair(&mut tokens, start);
    if dialect.is_any() {
        later::mark_qualifiers(&mut tokens, start, &names);
    }
    let end = tokens.len() - 1;
    structs.resize(names.len(), false);
    let mut parser = Parser {
        tokens,
        at: start,
        ast,
        origins,
        names: &names,
        report: &mut report,
        pieces,
        unit,
        dialect,
        cancel,
        depth: 0,
        levels: 0,
        expr_stack: Vec::new(),
        stmt_stack: Vec::new(),
        declarators: Vec::new(),
        last_error: is_cut.then_some(end),
        reported_reserved: Vec::new(),
        structs,
        body: None,
        is_outside_functions: false,
        reported_too_deep: false,
    };
    parser.ast.exprs.reserve((end - start) / 2);
    parser.file();
    if is_stopped {
        // Nothing is reported as missing.
        let nothing = parser.loc(start);
        let item = parser.ast.decl(DeclKind::Error, nothing);
        parser.ast.items.push(item);
    }
    let Parser { ast, origins, tokens, structs, .. } = parser;
    let reader = Reader { tokens, macros, pieces: count, has_line_numbers, structs };
    Parsed { ast, origins, names, report, reader }
}
