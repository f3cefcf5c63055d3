//! Pairs of brackets, found before parsing: they decide `a[..] b` without backtracking, and let the parser skip a group
//! that it did not understand.

use crate::{lex::Kind, preprocess::Tok};

/// The partner of an unmatched bracket.
pub(crate) const ALONE: u32 = u32::MAX;

/// Stores in the value of each bracket from `start` on the index of its partner, or [`ALONE`]. Incorrect text is paired
/// the way its author most likely meant it: a closing brace closes everything still open inside it, a semicolon or an
/// opening brace ends parentheses (except those of `for`, which contain semicolons).
pub(crate) fn pair(tokens: &mut [Tok], start: usize) {
    let mut open = Open::default();
    for i in start..tokens.len() {
        match tokens[i].kind {
            Kind::LParen | Kind::LBracket => open.push(tokens, i),
            Kind::LBrace => {
                open.drop_to_brace(tokens);
                open.push(tokens, i);
            }
            Kind::Semicolon => {
                while let Some(top) = open.top() {
                    let is_for = top > 0 && tokens[top].kind == Kind::LParen && tokens[top - 1].kind == Kind::For;
                    if tokens[top].kind == Kind::LBrace || is_for {
                        break;
                    }
                    open.pop(tokens);
                }
            }
            Kind::RParen => open.close(tokens, i, Kind::LParen),
            Kind::RBracket => open.close(tokens, i, Kind::LBracket),
            Kind::RBrace => open.close(tokens, i, Kind::LBrace),
            _ => {}
        }
    }
}

/// Brackets that have not been closed yet.
#[derive(Default)]
struct Open {
    list: Vec<u32>,
    /// The number of parentheses, square brackets and braces in the list. A closing bracket without any to close is
    /// then found without a search, so that a line of a million brackets of the wrong kind takes no longer than any
    /// other.
    counts: [usize; 3],
}

fn kind_index(kind: Kind) -> usize {
    match kind {
        Kind::LParen => 0,
        Kind::LBracket => 1,
        _ => 2,
    }
}

impl Open {
    fn push(&mut self, tokens: &mut [Tok], i: usize) {
        tokens[i].value = ALONE;
        self.counts[kind_index(tokens[i].kind)] += 1;
        self.list.push(i as u32);
    }

    fn top(&self) -> Option<usize> {
        self.list.last().map(|&top| top as usize)
    }

    fn pop(&mut self, tokens: &[Tok]) -> Option<usize> {
        let top = self.list.pop()? as usize;
        self.counts[kind_index(tokens[top].kind)] -= 1;
        Some(top)
    }

    fn drop_to_brace(&mut self, tokens: &[Tok]) {
        while self.top().is_some_and(|top| tokens[top].kind != Kind::LBrace) {
            self.pop(tokens);
        }
    }

    /// Searches from the inside out for the bracket that a closing one closes. For a parenthesis or square bracket the
    /// search does not go beyond a brace: an opening brace has dropped those before it.
    fn close(&mut self, tokens: &mut [Tok], i: usize, wanted: Kind) {
        tokens[i].value = ALONE;
        if self.counts[kind_index(wanted)] == 0 {
            return;
        }
        while let Some(partner) = self.pop(tokens) {
            if tokens[partner].kind == wanted {
                tokens[i].value = partner as u32;
                tokens[partner].value = i as u32;
                return;
            }
        }
    }
}
