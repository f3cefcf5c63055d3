//! The result of preprocessing: tokens, and the state from which further texts continue.

use super::macros::MacroTable;
use crate::{ast::Origins, lex::Kind};

/// Preprocessed tokens for the parser, and the state of the preprocessor for further texts.
#[derive(Clone, Debug, Default)]
pub(crate) struct Preprocessed {
    /// The same number as `origins.tokens`; the last is `Eof`.
    pub tokens: Vec<Tok>,
    pub origins: Origins,
    pub macros: MacroTable,
    /// The number of pieces that were read.
    pub pieces: usize,
    /// The text is incomplete, which was reported: an unclosed comment or conditional hides what may be missing.
    pub is_cut: bool,
    /// Line numbers were used, which depend on the unit.
    pub has_line_numbers: bool,
    /// Reading stopped at an error that makes the rest meaningless, which was reported: there are no tokens.
    pub is_stopped: bool,
}

impl Preprocessed {
    /// Removes the end token: more text follows.
    pub(super) fn reopen(&mut self) {
        self.tokens.pop();
        self.origins.tokens.pop();
    }
}

/// A token for the parser. Its place is `Origins::tokens` at the same index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tok {
    pub kind: Kind,
    /// The value documented for [`Kind`]; for brackets the parser's index of the partner.
    pub value: u32,
}
