//! The outcome of preprocessing: tokens, and the state that further texts go on from.

use super::macros::MacroTable;
use crate::{ast::Origins, lex::Kind};

/// Preprocessed tokens for the parser, and the state of the preprocessor where further texts follow.
#[derive(Clone, Debug, Default)]
pub(crate) struct Preprocessed {
    /// As many as `origins.tokens`; the last is `Eof`.
    pub tokens: Vec<Tok>,
    pub origins: Origins,
    pub macros: MacroTable,
    /// The number of pieces that were read.
    pub pieces: usize,
    /// The text ends before its end, which was reported: an open comment or conditional hides what may be missing.
    pub is_cut: bool,
    /// Numbers of lines were asked for, which depend on the unit.
    pub has_line_numbers: bool,
    /// The reading ended at what makes no sense of the rest, which was reported: there are no tokens.
    pub is_stopped: bool,
}

impl Preprocessed {
    /// Takes the end off: more follows.
    pub(super) fn reopen(&mut self) {
        self.tokens.pop();
        self.origins.tokens.pop();
    }
}

/// A token as the parser reads it. Its place is `Origins::tokens` of the same index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tok {
    pub kind: Kind,
    /// Holds the value that [`Kind`] describes; for brackets the parser's index of the partner.
    pub value: u32,
}
