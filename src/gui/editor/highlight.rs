//! What colouring needs to know of lines nobody sees: the state each line begins in, and the macros defined anywhere.

use super::{
    buffer::Buffer,
    lexer::{self, LineState, Token},
};
use std::collections::HashSet;

/// Kept in step with a [`Buffer`] by [`Highlight::update`].
#[derive(Clone, Debug, Default)]
pub struct Highlight {
    /// State each line begins in.
    states: Vec<LineState>,
    macros: HashSet<String>,
    /// Columns of the widest line, tabs counted as four.
    columns: usize,
}

impl Highlight {
    /// Takes in what changed since the last call. `shared` is a text whose macros count here too: Common's.
    pub fn update(&mut self, buffer: &mut Buffer, shared: &str) {
        let Some(first) = buffer.take_changed_line() else { return };
        self.states.truncate(first + 1);
        if self.states.is_empty() {
            self.states.push(LineState::default());
        }
        for line in self.states.len() - 1..buffer.line_count() - 1 {
            let next = lexer::state_after(buffer.line(line), self.states[line]);
            self.states.push(next);
        }
        self.columns = (0..buffer.line_count()).map(|l| columns(buffer.line(l))).max().unwrap_or(0);
        self.macros.clear();
        for line in buffer.text().lines().chain(shared.lines()) {
            if line.contains('#') {
                self.macros.extend(lexer::defined_name(line).map(str::to_owned));
            }
        }
    }

    pub fn tokens(&self, line: usize, text: &str) -> Vec<Token> {
        let state = self.states.get(line).copied().unwrap_or_default();
        lexer::lex_line(text, state, &self.macros).0
    }

    pub fn columns(&self) -> usize {
        self.columns
    }
}

fn columns(line: &str) -> usize {
    // Bytes are enough: wider than it is does no harm, and a tab is what matters.
    line.len() + 3 * line.bytes().filter(|b| *b == b'\t').count()
}

#[cfg(test)]
mod tests {
    use super::super::{history::Kind, lexer::TokenKind};
    use super::*;

    #[test]
    fn a_comment_opened_above_colours_what_is_below() {
        let mut b = Buffer::new("a\nb\nc\n");
        let mut h = Highlight::default();
        h.update(&mut b, "#define SHARED 1\n");
        assert_eq!(h.tokens(2, "c")[0].kind, TokenKind::Plain);
        assert_eq!(h.tokens(2, "SHARED")[0].kind, TokenKind::Macro);
        b.replace(0..0, "/*", Kind::Other);
        h.update(&mut b, "");
        assert_eq!(h.tokens(2, "c")[0].kind, TokenKind::Comment);
        b.replace(5..5, "*/\n", Kind::Other);
        h.update(&mut b, "");
        assert_eq!((h.tokens(1, "b*/")[0].kind, h.tokens(2, "x")[0].kind), (TokenKind::Comment, TokenKind::Plain));
        assert_eq!(h.states.len(), b.line_count());
        b.replace(0..b.text().len(), "", Kind::Other);
        h.update(&mut b, "");
        assert_eq!((h.states.len(), h.columns()), (1, 0));
    }
}
