//! Toggles `/*` comments around the selections.

use super::{
    buffer::Buffer,
    history::Kind,
    selection::{Carets, Selection},
};
use std::ops::Range;

const OPEN: &str = "/* ";
const CLOSE: &str = " */";

/// A range of the text to delete, or a position at which to insert.
struct Part {
    range: Range<usize>,
    with: &'static str,
}

impl Part {
    fn removal(range: Range<usize>) -> Self {
        Self { range, with: "" }
    }

    /// Returns the distance by which a position moves. An insertion before a selection moves it, one after it does
    /// not.
    fn shift(&self, at: usize) -> isize {
        if self.with.is_empty() {
            -(at.clamp(self.range.start, self.range.end) as isize - self.range.start as isize)
        } else if self.range.start < at || (self.range.start == at && self.with == OPEN) {
            self.with.len() as isize
        } else {
            0
        }
    }
}

impl Buffer {
    /// Removes the comment that contains a selection, or that is selected; if there is none, wraps the selection in
    /// one. A selection that contains a comment delimiter is unchanged, because comments do not nest.
    pub(crate) fn toggle_block_comment(&mut self) {
        let mut parts: Vec<Part> = Vec::new();
        let mut done = 0;
        for s in self.carets().list() {
            let range = s.range();
            if let Some((open, close)) = self.comment_around(&range) {
                // Several carets in one comment remove it once.
                if open.start >= done {
                    done = close.end;
                    parts.extend([Part::removal(open), Part::removal(close)]);
                }
            } else if !["/*", "*/"].iter().any(|mark| self.text()[range.clone()].contains(mark)) {
                done = range.end;
                parts.push(Part { range: range.start..range.start, with: OPEN });
                parts.push(Part { range: range.end..range.end, with: CLOSE });
            }
        }
        let moved = |at: usize| at.saturating_add_signed(parts.iter().map(|part| part.shift(at)).sum());
        let list = self.carets().list().iter().map(|s| Selection::new(moved(s.anchor), moved(s.head))).collect();
        let carets = Carets::new(list, self.carets().main_index());
        let parts = parts.into_iter().map(|part| (part.range, part.with.to_owned())).collect();
        self.change(parts, Kind::Other, |_| carets);
    }

    /// Returns both delimiters of the comment that contains a range or equals it, each with the blank inside it.
    fn comment_around(&self, range: &Range<usize>) -> Option<(Range<usize>, Range<usize>)> {
        let text = self.text();
        let selected = &text[range.clone()];
        let trimmed = selected.trim();
        let is_whole = trimmed.len() >= 4 && trimmed.starts_with("/*") && trimmed.ends_with("*/");
        let (open, close) = if is_whole {
            let open = range.start + (selected.len() - selected.trim_start().len());
            (open, open + trimmed.len() - 2)
        } else {
            (text[..range.start].rfind("/*")?, range.end + text[range.end..].find("*/")?)
        };
        let line = self.line_range(self.line_of(open)).start;
        let inner = text.get(open + 2..close)?;
        if inner.contains("*/") || text[line..open].contains("//") {
            return None;
        }
        let before = usize::from(inner.starts_with(' '));
        let after = usize::from(inner[before..].ends_with(' '));
        Some((open..open + 2 + before, close - after..close + 2))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `[` and `]` are the ends of the selection, `|` a caret.
    fn toggled(text: &str) -> String {
        let bare = text.replace(['[', ']', '|'], "");
        let at = |mark: char| text.find(mark);
        let mut b = Buffer::new(&bare);
        let (anchor, head) = match at('|') {
            Some(at) => (at, at),
            None => (at('[').unwrap(), at(']').unwrap() - 1),
        };
        b.select(anchor, head);
        b.toggle_block_comment();
        let mut text = b.text().to_owned();
        let range = b.selection().range();
        if range.is_empty() {
            text.insert(range.start, '|');
        } else {
            text.insert(range.end, ']');
            text.insert(range.start, '[');
        }
        if b.text() != bare {
            b.undo();
            assert_eq!(b.text(), bare, "one step back");
        }
        text
    }

    #[test]
    fn block_comment_toggles_around_the_selection() {
        for (text, found) in [
            ("a [b + c] d", "a /* [b + c] */ d"),
            ("a /* [b + c] */ d", "a [b + c] d"),
            ("a [/* b + c */] d", "a [b + c] d"),
            ("a /* b |+ c */ d", "a b |+ c d"),
            ("a | d", "a /* | */ d"),
            ("a /* | */ d", "a | d"),
            ("a /*|*/ d", "a | d"),
            ("/* a */ |b /* c */", "/* a */ /* | */b /* c */"),
            ("[one\ntwo]", "/* [one\ntwo] */"),
            // Comments do not nest, and `//` hides what follows it.
            ("[a /* b */ c]", "[a /* b */ c]"),
            ("// /*\n|a; /* b */", "// /*\n/* | */a; /* b */"),
        ] {
            assert_eq!(toggled(text), found, "{text}");
        }
    }

    #[test]
    fn several_carets_in_a_comment_remove_it_once() {
        let mut b = Buffer::new("/* a b */ c");
        b.set_carets(Carets::new(vec![Selection::caret(3), Selection::caret(6), Selection::caret(11)], 0));
        b.toggle_block_comment();
        assert_eq!(b.text(), "a b c/*  */");
        let heads: Vec<usize> = b.carets().list().iter().map(|s| s.head).collect();
        assert_eq!(heads, [0, 3, 8]);
    }
}
