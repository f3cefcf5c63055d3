//! Lines cut into pieces that are short enough to be laid out and coloured independently.
//!
//! A line of ordinary code is one piece; one of ten million characters is ten thousand, of which a frame processes the
//! visible ones. After a change only the pieces around it are cut again.

use super::nesting::Nesting;
use crate::glsl::services::lines::{LexState, LineContext, Scanner};

/// The size of a piece in bytes: it is cut at the first token boundary from here on, and at twice this size regardless
/// of tokens.
pub(super) const PIECE: usize = 1024;

/// A part of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    /// The length in bytes.
    pub len: usize,
    /// The lexer state at its start.
    pub state: LexState,
    /// The width, in digit widths.
    pub columns: f32,
    /// The nesting of its brackets.
    pub nesting: Nesting,
    /// The number of its rows; 0 until it is counted.
    pub rows: u32,
}

/// The pieces of the old line, and the number of unchanged bytes at one of its ends.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Reusable<'a> {
    pub pieces: &'a [Piece],
    pub bytes: usize,
}

/// A line in pieces.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Cut {
    /// Together they cover the line; empty for an empty line.
    pub pieces: Vec<Piece>,
    /// The lexer state at the line's end.
    pub end: LexState,
}

/// Cuts a line that starts in `state`. `head` and `tail` describe the old line (two lines, if they were joined): the
/// ranges that they cover are not scanned again. `tail_end` is the state at the end of the line that `tail` describes;
/// `width` returns the width of a character that is not printable ASCII. Adds the number of bytes scanned to
/// `scanned`.
pub(super) fn cut(
    line: &str,
    state: LexState,
    head: Reusable<'_>,
    tail: (Reusable<'_>, LexState),
    width: &mut dyn FnMut(char) -> f32,
    scanned: &mut usize,
) -> Cut {
    let mut pieces: Vec<Piece> = Vec::new();
    let mut at = 0;
    if head.pieces.first().is_some_and(|p| p.state == state) {
        for piece in head.pieces {
            if at + piece.len > head.bytes {
                break;
            }
            pieces.push(*piece);
            at += piece.len;
        }
    }
    // The text after it may have changed the end of the last piece.
    let begins_in = match pieces.pop() {
        Some(piece) => {
            at -= piece.len;
            piece.state
        }
        None => state,
    };
    let (tail, tail_end) = tail;
    // Starts of pieces of the old line whose text is unchanged, including the byte before them; from the last one on.
    let mut joints = Vec::new();
    let mut from_end = 0;
    for (i, piece) in tail.pieces.iter().enumerate().rev() {
        from_end += piece.len;
        if from_end >= tail.bytes || from_end >= line.len() - at {
            break;
        }
        joints.push((line.len() - from_end, i));
    }
    let mut scanner = Scanner::new(line, at, begins_in);
    let mut start = (at, begins_in);
    let mut nesting = Nesting::default();
    let mut push = |pieces: &mut Vec<Piece>, from: (usize, LexState), to: usize, nesting: &mut Nesting| {
        *scanned += to - from.0;
        let columns = columns(&line[from.0..to], width);
        pieces.push(Piece { len: to - from.0, state: from.1, columns, nesting: std::mem::take(nesting), rows: 0 });
    };
    while !scanner.is_at_end() {
        let byte = line.as_bytes()[scanner.at];
        scanner.step();
        if scanner.state.inside == LineContext::Code {
            // The end of a comment is not a bracket.
            nesting.push(byte);
        }
        let len = scanner.at - start.0;
        while joints.last().is_some_and(|(at, _)| *at < scanner.at) {
            joints.pop();
        }
        if let Some((_, i)) =
            joints.last().filter(|(at, i)| *at == scanner.at && tail.pieces[*i].state == scanner.state)
        {
            push(&mut pieces, start, scanner.at, &mut nesting);
            pieces.extend_from_slice(&tail.pieces[*i..]);
            return Cut { pieces, end: tail_end };
        }
        // Wait for a nearby joint, or a change would leave tiny pieces.
        let waits = joints.last().is_some_and(|(at, _)| *at <= start.0 + 2 * PIECE);
        let is_due = (len >= PIECE && !waits && is_between_tokens(line.as_bytes()[scanner.at - 1])) || len >= 2 * PIECE;
        if is_due && line.is_char_boundary(scanner.at) && !scanner.is_at_end() {
            push(&mut pieces, start, scanner.at, &mut nesting);
            start = (scanner.at, scanner.state);
        }
    }
    if scanner.at > start.0 {
        push(&mut pieces, start, scanner.at, &mut nesting);
    }
    Cut { pieces, end: scanner.state }
}

/// Returns whether a token ends with this byte if it is not inside a comment.
fn is_between_tokens(byte: u8) -> bool {
    byte.is_ascii_whitespace() || b";,(){}[]".contains(&byte)
}

/// Returns the width of a text, in digit widths: a tab counts as four.
pub(super) fn columns(text: &str, width: &mut dyn FnMut(char) -> f32) -> f32 {
    let mut plain = 0;
    let mut other = 0.0;
    for c in text.chars() {
        match c {
            ' '..='~' => plain += 1,
            '\t' => plain += 4,
            c => other += width(c),
        }
    }
    plain as f32 + other
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole(line: &str) -> Cut {
        cut(line, LexState::default(), Reusable::default(), Default::default(), &mut |_| 1.0, &mut 0)
    }

    fn text(len: usize) -> String {
        let words = ["a /* b */ + c1; ", "// x\\ ", "éé ", "/*", "*/ f(x)", "\t# q", "name ", "1.5e-3*", "/"];
        let mut seed = 7u32;
        let mut text = String::new();
        while text.len() < len {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            text.push_str(words[(seed >> 16) as usize % words.len()]);
        }
        text
    }

    #[test]
    fn pieces_cover_a_line_and_store_their_state() {
        for line in
            [text(20_000), "x".repeat(9_000), "é".repeat(5_000), "/*/".repeat(4_000), "*".repeat(7_000), " ".into()]
        {
            let Cut { pieces, end } = whole(&line);
            let mut scanner = Scanner::new(&line, 0, LexState::default());
            let mut at = 0;
            for piece in &pieces {
                while scanner.at < at {
                    scanner.step();
                }
                assert_eq!((scanner.at, scanner.state), (at, piece.state));
                at += piece.len;
                assert!(line.is_char_boundary(at));
                assert!(piece.len <= 2 * PIECE + 4, "{} bytes", piece.len);
            }
            while !scanner.is_at_end() {
                scanner.step();
            }
            assert_eq!((at, end), (line.len(), scanner.state));
        }
        assert_eq!(whole(""), Cut::default());
    }

    #[test]
    fn recutting_after_a_change_matches_cutting_the_whole_line() {
        let line = text(60_000);
        let old = whole(&line);
        for at in (0..line.len()).step_by(997) {
            let at = (0..=at).rev().find(|i| line.is_char_boundary(*i)).unwrap();
            for (removed, with) in [(0, "x"), (1, ""), (0, "/*"), (0, "*/"), (2, "// "), (0, "\u{e9}"), (0, "/")] {
                let Some(rest) = line.get(at + removed..) else { continue };
                let new = format!("{}{with}{rest}", &line[..at]);
                let head = Reusable { pieces: &old.pieces, bytes: at };
                let tail = Reusable { pieces: &old.pieces, bytes: rest.len() };
                let mut scanned = 0;
                let cut = cut(&new, LexState::default(), head, (tail, old.end), &mut |_| 1.0, &mut scanned);
                let mut scanner = Scanner::new(&new, 0, LexState::default());
                let mut start = 0;
                for piece in &cut.pieces {
                    while scanner.at < start {
                        scanner.step();
                    }
                    assert_eq!((scanner.at, scanner.state), (start, piece.state), "{with:?} at {at}");
                    start += piece.len;
                }
                assert_eq!(start, new.len());
                assert_eq!(cut.end.next_line(&new), whole(&new).end.next_line(&new));
                if with == "x" {
                    assert!(scanned < 8 * PIECE, "{scanned} bytes looked at for a letter at {at}");
                }
            }
        }
    }
}
