//! Which bracket belongs to which, found before parsing: it decides what `a[..] b` is without trying both, and lets the
//! parser step over a group that it did not understand.

use super::super::{lex::Kind, preprocess::Tok};

/// The partner of a bracket that has none.
pub(in crate::glsl) const ALONE: u32 = u32::MAX;

/// Writes into each bracket's value the index of its partner, or [`ALONE`]. Text with mistakes is paired the way its author
/// most likely meant it: a closing brace closes what is still open inside it, a semicolon or an opening brace ends
/// parentheses (but those of `for` hold semicolons).
pub(in crate::glsl) fn pair(tokens: &mut [Tok]) {
    let mut open: Vec<u32> = Vec::new();
    for i in 0..tokens.len() {
        match tokens[i].kind {
            Kind::LParen | Kind::LBracket => {
                tokens[i].value = ALONE;
                open.push(i as u32);
            }
            Kind::LBrace => {
                tokens[i].value = ALONE;
                while let Some(&top) = open.last() {
                    if tokens[top as usize].kind == Kind::LBrace {
                        break;
                    }
                    open.pop();
                }
                open.push(i as u32);
            }
            Kind::Semicolon => {
                while let Some(&top) = open.last() {
                    let top = top as usize;
                    let is_for = top > 0 && tokens[top].kind == Kind::LParen && tokens[top - 1].kind == Kind::For;
                    if tokens[top].kind == Kind::LBrace || is_for {
                        break;
                    }
                    open.pop();
                }
            }
            Kind::RParen => close(tokens, &mut open, i, Kind::LParen),
            Kind::RBracket => close(tokens, &mut open, i, Kind::LBracket),
            Kind::RBrace => close(tokens, &mut open, i, Kind::LBrace),
            _ => {}
        }
    }
}

fn close(tokens: &mut [Tok], open: &mut Vec<u32>, i: usize, wanted: Kind) {
    tokens[i].value = ALONE;
    // Looked for from the inside out, but a parenthesis or bracket not beyond a brace.
    let found = open.iter().rposition(|&o| {
        let kind = tokens[o as usize].kind;
        kind == wanted || kind == Kind::LBrace
    });
    let Some(found) = found.filter(|&f| tokens[open[f] as usize].kind == wanted) else { return };
    let partner = open[found];
    open.truncate(found);
    tokens[i].value = partner;
    tokens[partner as usize].value = i as u32;
}
