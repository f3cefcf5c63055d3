//! Matches brackets.

use super::{buffer::Buffer, highlight::Highlight, nesting::Bracket, pieces::Piece};
use crate::glsl::services::lines::{LineContext, Scanner};
use std::ops::Range;

/// Returns the start of the bracket at a caret and of its partner, in the order of the text.
pub(super) fn pair_at(index: &Highlight, buffer: &Buffer, caret: usize) -> Option<[usize; 2]> {
    let bytes = buffer.text().as_bytes();
    // The bracket after the caret comes first, because the caret is drawn on it.
    [Some(caret), caret.checked_sub(1)].into_iter().flatten().find_map(|at| {
        let (kind, by) = Bracket::of(*bytes.get(at)?)?;
        if index.is_comment(buffer, at) {
            return None;
        }
        let other = if by > 0 { forward(index, buffer, kind, at) } else { backward(index, buffer, kind, at) }?;
        Some([at.min(other), at.max(other)])
    })
}

/// Returns the line that ends the outermost block that a line opens and does not close; `None` if it opens none, or if
/// the block reaches the end of the text.
pub(super) fn block_end(index: &Highlight, buffer: &Buffer, line: usize) -> Option<usize> {
    let mut open = index.nesting(line).of(Bracket::Curly).opened();
    if open <= 0 {
        return None;
    }
    for below in line + 1..buffer.line_count() {
        let depth = index.nesting(below).of(Bracket::Curly);
        if depth.closed() >= open {
            return Some(below);
        }
        open += depth.net();
    }
    None
}

/// Returns the line that opens the innermost block around a line that does not open a block itself.
pub(super) fn block_around(index: &Highlight, line: usize) -> Option<usize> {
    let mut closed = 1;
    (0..line).rev().find(|above| {
        let depth = index.nesting(*above).of(Bracket::Curly);
        let is_opened = depth.opened() >= closed;
        closed -= depth.net();
        is_opened
    })
}

/// Returns all blocks of several lines as the lines that open and close them, in the order of their starts.
pub(super) fn blocks(index: &Highlight, buffer: &Buffer) -> Vec<(usize, usize)> {
    let mut ends = std::collections::BTreeMap::new();
    let mut open: Vec<usize> = Vec::new();
    for line in 0..buffer.line_count() {
        let depth = index.nesting(line).of(Bracket::Curly);
        for _ in 0..depth.closed() {
            // Of several blocks that a line opens, the outermost ends last.
            if let Some(header) = open.pop() {
                ends.insert(header, line);
            }
        }
        open.extend(std::iter::repeat_n(line, depth.opened() as usize));
    }
    ends.into_iter().collect()
}

/// Returns the closing bracket for the opening one at a byte.
fn forward(index: &Highlight, buffer: &Buffer, kind: Bracket, from: usize) -> Option<usize> {
    let mut open = 0;
    for (bytes, piece) in pieces_from(index, buffer, from) {
        let depth = piece.nesting.of(kind);
        let is_first = bytes.contains(&from);
        if !is_first && depth.closed() < open {
            open += depth.net();
            continue;
        }
        for (at, by) in brackets(buffer, &bytes, piece, kind).into_iter().filter(|(at, _)| *at >= from) {
            open += by;
            if open == 0 {
                return Some(at);
            }
        }
    }
    None
}

/// Returns the opening bracket for the closing one at a byte.
fn backward(index: &Highlight, buffer: &Buffer, kind: Bracket, from: usize) -> Option<usize> {
    let mut closed = 0;
    for line in (0..=buffer.line_of(from)).rev() {
        let start = buffer.line_range(line).start;
        let mut end = start + index.pieces(line).iter().map(|p| p.len).sum::<usize>();
        for piece in index.pieces(line).iter().rev() {
            let bytes = end - piece.len..end;
            end = bytes.start;
            let depth = piece.nesting.of(kind);
            let is_first = bytes.contains(&from);
            if bytes.start > from {
                continue;
            }
            if !is_first && depth.opened() < closed {
                closed -= depth.net();
                continue;
            }
            for (at, by) in brackets(buffer, &bytes, piece, kind).into_iter().rev().filter(|(at, _)| *at <= from) {
                closed -= by;
                if closed == 0 {
                    return Some(at);
                }
            }
        }
    }
    None
}

/// Iterates over pieces with their bytes, from the one that contains a byte to the end of the text.
fn pieces_from<'i>(
    index: &'i Highlight,
    buffer: &'i Buffer,
    from: usize,
) -> impl Iterator<Item = (Range<usize>, &'i Piece)> {
    (buffer.line_of(from)..buffer.line_count())
        .flat_map(move |line| {
            let mut at = buffer.line_range(line).start;
            index.pieces(line).iter().map(move |piece| {
                let bytes = at..at + piece.len;
                at = bytes.end;
                (bytes, piece)
            })
        })
        .filter(move |(bytes, _)| bytes.end > from)
}

/// Iterates over the brackets of a kind in a piece, outside comments.
fn brackets(buffer: &Buffer, bytes: &Range<usize>, piece: &Piece, kind: Bracket) -> Vec<(usize, i32)> {
    let text = &buffer.text()[bytes.clone()];
    let mut scanner = Scanner::new(text, 0, piece.state);
    let mut found = Vec::new();
    while !scanner.is_at_end() {
        let at = scanner.at;
        scanner.step();
        if scanner.state.inside == LineContext::Code
            && let Some((of, by)) = Bracket::of(text.as_bytes()[at])
            && of == kind
        {
            found.push((bytes.start + at, by));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn index(text: &str) -> (Highlight, Buffer) {
        let mut buffer = Buffer::new(text);
        let mut index = Highlight::default();
        index.update(&mut buffer, "", &mut |_| 1.0);
        (index, buffer)
    }

    #[test]
    fn matching_skips_comments_and_other_kinds() {
        let text = "void f() {\n  a[(1)]; // }\n  /* } */ { }\n  g((2));\n}\n)";
        let (index, buffer) = index(text);
        let pair = |at: usize| pair_at(&index, &buffer, at);
        let at = |part: &str| text.find(part).unwrap();
        let whole = [at("{"), at("}\n)")];
        assert_eq!(pair(whole[0]), Some(whole));
        assert_eq!(pair(whole[1] + 1), Some(whole), "behind it");
        assert_eq!(pair(at("[")), Some([at("["), at("]")]));
        assert_eq!(pair(at("((")), Some([at("(("), at("));") + 1]));
        assert_eq!(pair(at("));") + 1), Some([at("(("), at("));") + 1]), "the one it stands on");
        assert_eq!(pair(at("// }") + 3), None);
        assert_eq!(pair(text.len()), None, "closed and never opened");
        assert_eq!(pair(1), None);
    }

    #[test]
    fn pairs_in_long_texts_match_a_stack() {
        let mut seed = 11u32;
        for round in 0..30 {
            let mut text = String::new();
            for _ in 0..600 {
                seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let words = ["{", "}", "(", ")", "x + y; ", "\n", "[", "]", "// } (\n", "/* ) */", "name "];
                text.push_str(words[(seed >> 16) as usize % words.len()]);
                if round == 0 {
                    text.push_str("a long line ");
                }
            }
            let (index, buffer) = index(&text);
            for open in [b'{', b'(', b'['] {
                let mut stack = Vec::new();
                for at in (0..text.len()).filter(|at| !index.is_comment(&buffer, *at)) {
                    let (kind, byte) = (Bracket::of(open).unwrap().0, text.as_bytes()[at]);
                    match Bracket::of(byte).filter(|(of, _)| *of == kind) {
                        Some((_, 1)) => stack.push(at),
                        Some(_) => {
                            let other = stack.pop();
                            assert_eq!(backward(&index, &buffer, kind, at), other);
                            if let Some(other) = other {
                                assert_eq!(forward(&index, &buffer, kind, other), Some(at));
                            }
                        }
                        None => {}
                    }
                }
                for never in stack {
                    assert_eq!(forward(&index, &buffer, Bracket::of(open).unwrap().0, never), None);
                }
            }
        }
    }

    #[test]
    fn block_end_is_that_of_the_outermost_block_opened() {
        let (index, buffer) = index("void f()\n{\n  if (a) { if (b) {\n  } else {\n  }\n  }\n}\nint a[] = { 1 };\n{");
        let ends: Vec<_> = (0..9).map(|line| block_end(&index, &buffer, line)).collect();
        assert_eq!(ends, [None, Some(6), Some(5), Some(4), None, None, None, None, None]);
        assert_eq!(blocks(&index, &buffer), [(1, 6), (2, 5), (3, 4)]);
        let around: Vec<_> = (0..8).map(|line| block_around(&index, line)).collect();
        assert_eq!(around, [None, None, Some(1), Some(2), Some(3), Some(2), Some(1), None]);
    }
}
