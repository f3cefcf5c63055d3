//! Lines cut into pieces short enough to be laid out and coloured each on its own.
//!
//! A line of ordinary code is one piece; one of ten million characters is ten thousand, of which a frame looks at those
//! in sight. After a change only the pieces around it are cut anew.

use super::nesting::Nesting;
use crate::glsl::services::lines::{LexState, LineContext, Scanner};

/// Bytes of a piece: cut at the next place between two tokens from here on, at twice as many wherever that is.
pub(super) const PIECE: usize = 1024;

/// A part of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    /// In bytes.
    pub len: usize,
    /// The state at its beginning.
    pub state: LexState,
    /// Says how wide it is, in widths of a digit.
    pub columns: f32,
    /// Holds what its brackets open and close.
    pub nesting: Nesting,
    /// In how many rows it is shown; 0 until it is counted.
    pub rows: u32,
}

/// Pieces of a line as it was, and how many bytes at an end of it are as they were.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Reusable<'a> {
    pub pieces: &'a [Piece],
    pub bytes: usize,
}

/// A line in pieces.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Cut {
    /// Together they cover the line; none for an empty one.
    pub pieces: Vec<Piece>,
    /// The state at the line's end.
    pub end: LexState,
}

/// Cuts a line that begins in `state`. `head` and `tail` are of the line as it was (of two lines, where they were
/// joined): what they hold for is not looked at again. `tail_end` is the state at the end of the line that `tail` is
/// of; `width` gives the width of a character that is not printable ASCII. Counts the bytes it looks at in `scanned`.
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
    // What is behind its end may have given the last one another end.
    let begins_in = match pieces.pop() {
        Some(piece) => {
            at -= piece.len;
            piece.state
        }
        None => state,
    };
    let (tail, tail_end) = tail;
    // Where pieces of the old line begin whose text is the same, the byte before them too; from the last one on.
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
            // The end of a comment is no bracket.
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
        // A joint that is near is waited for, or a change would leave crumbs.
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

/// A token ends with this byte wherever it is not inside of a comment.
fn is_between_tokens(byte: u8) -> bool {
    byte.is_ascii_whitespace() || b";,(){}[]".contains(&byte)
}

/// Returns how wide a text is, in widths of a digit: a tab is as wide as four.
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
    fn pieces_cover_a_line_and_know_what_they_begin_in() {
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
    fn a_change_cuts_what_is_around_it_and_leaves_what_the_whole_line_would_mean() {
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
