//! Edits made by the editor's keys: typing, new lines, deleting, pasting. Each is made at every caret.

use crate::glsl;

use super::{
    buffer::{Buffer, Replacement},
    history::Kind,
    motion::{Motion, Vertical},
};
use std::ops::Range;

pub(super) const INDENT: &str = "    ";

impl Buffer {
    /// Replaces the selections with typed text.
    pub(crate) fn insert(&mut self, text: &str) {
        let kind = if text.chars().count() == 1 { Kind::Typing } else { Kind::Other };
        let kind = if text == "}" && self.carets().list().iter().any(|s| s.is_empty() && self.dedent_at(s.head) > 0) {
            Kind::Other
        } else {
            kind
        };
        self.replace_at_carets(kind, |buffer, s| {
            let back = if text == "}" && s.is_empty() { buffer.dedent_at(s.head) } else { 0 };
            Replacement::new(s.range().start - back..s.range().end, text)
        });
    }

    /// Returns the number of bytes by which a closing brace typed alone on its line is unindented: one step of its
    /// indent.
    fn dedent_at(&self, at: usize) -> usize {
        let before = &self.text()[self.line_range(self.line_of(at)).start..at];
        if !before.is_empty() && before.trim().is_empty() { unit_at_end(before) } else { 0 }
    }

    /// Pastes text; its line ends become those of the file. If there are as many lines as carets, each caret gets one.
    pub(crate) fn paste(&mut self, text: &str) {
        let text = text.replace("\r\n", "\n").replace('\r', "\n");
        let carets = self.carets().list().to_vec();
        let lines: Vec<&str> = text.strip_suffix('\n').unwrap_or(&text).split('\n').collect();
        let deals = carets.len() > 1 && lines.len() == carets.len();
        let end = self.line_end();
        self.replace_at_carets(Kind::Other, |_, s| {
            let index = carets.iter().position(|c| *c == s).unwrap_or(0);
            let part = if deals { lines[index] } else { &text };
            Replacement::new(s.range(), if end == "\n" { part.to_owned() } else { part.replace('\n', end) })
        });
    }

    /// Enter: the new line has the indent of this one, plus one step after an opening brace.
    pub(crate) fn new_line(&mut self) {
        self.replace_at_carets(Kind::Other, |buffer, s| {
            let range = s.range();
            let line = buffer.line_range(buffer.line_of(range.start));
            let before = &buffer.text()[line.start..range.start];
            let indent = &before[..before.len() - before.trim_start().len()];
            let opens = before.trim_end().ends_with(['{', '(']);
            let closes = buffer.text()[range.end..].starts_with(['}', ')']);
            let end = buffer.line_end();
            let mut text = format!("{end}{indent}");
            if opens {
                text.push_str(unit_of(indent));
            }
            let caret = text.len();
            if opens && closes {
                text.push_str(end);
                text.push_str(indent);
            }
            Replacement { anchor: caret, head: caret, ..Replacement::new(range, text) }
        });
    }

    /// Ctrl+Enter and Ctrl+Shift+Enter: inserts a line below or above the caret's, with the same indent. The line
    /// itself is not split.
    pub(crate) fn open_line(&mut self, way: Vertical) {
        self.replace_at_carets(Kind::Other, |buffer, s| {
            let line = buffer.line_range(buffer.line_of(s.head));
            let text = &buffer.text()[line.clone()];
            let mut indent = text[..text.len() - text.trim_start().len()].to_owned();
            let end = buffer.line_end();
            if way == Vertical::Up {
                let caret = indent.len();
                return Replacement {
                    anchor: caret,
                    head: caret,
                    ..Replacement::new(line.start..line.start, indent + end)
                };
            }
            if text.trim_end().ends_with(['{', '(']) {
                indent.push_str(unit_of(&indent));
            }
            Replacement::new(line.end..line.end, format!("{end}{indent}"))
        });
    }

    /// Shift+Alt+F: formats the whole text. Carets keep their places. Returns false if nothing was to be done.
    pub(crate) fn format(&mut self) -> bool {
        let parts = glsl::format_edits(self.text());
        let is_other = !parts.is_empty();
        if is_other {
            self.replace_parts(parts);
        }
        is_other
    }

    /// Backspace and Delete: deletes the selections, or what `motion` passes over.
    pub(crate) fn delete(&mut self, motion: Motion) {
        let is_run = self.carets().list().iter().all(|s| s.is_empty());
        let kind = if is_run { Kind::Deleting } else { Kind::Other };
        self.replace_at_carets(kind, |buffer, s| {
            let range = if s.is_empty() { buffer.range_of_motion(motion, s.head) } else { s.range() };
            Replacement::new(range, "")
        });
    }

    /// Returns the range that Backspace or Delete deletes at a caret.
    fn range_of_motion(&self, motion: Motion, at: usize) -> Range<usize> {
        let to = self.target(motion, at);
        let mut range = at.min(to)..at.max(to);
        if motion == Motion::Left {
            // Backspace in the indent deletes one step of it.
            let line = self.line_range(self.line_of(at));
            let before = &self.text()[line.start..at];
            if before.len() > 1 && before.bytes().all(|b| b == b' ') {
                range.start = range.end - unit_at_end(before);
            } else if self.is_empty_pair(at) {
                range.end += 1;
            }
        }
        range
    }

    /// Returns the ranges that Ctrl+C copies: the selections, or the whole line of each caret that selects nothing.
    pub(crate) fn copied_ranges(&self) -> Vec<Range<usize>> {
        let mut ranges: Vec<Range<usize>> = Vec::new();
        for s in self.carets().list() {
            let range = if s.is_empty() { self.whole_line(s.head) } else { s.range() };
            match ranges.last_mut() {
                // Two carets in a line copy it once.
                Some(last) if range.start < last.end => last.end = last.end.max(range.end),
                _ => ranges.push(range),
            }
        }
        ranges
    }

    /// Returns the text that Ctrl+C copies: with several carets, one line for each range.
    pub(crate) fn copied_text(&self) -> String {
        let parts: Vec<&str> = self.copied_ranges().into_iter().map(|r| &self.text()[r]).collect();
        match &parts[..] {
            [one] => (*one).to_owned(),
            several => several.iter().map(|p| p.trim_end_matches(['\n', '\r'])).collect::<Vec<_>>().join("\n"),
        }
    }

    /// Deletes what Ctrl+C would copy.
    pub(crate) fn cut(&mut self) {
        let parts: Vec<_> = self.copied_ranges().into_iter().map(|range| (range, String::new())).collect();
        let carets = {
            let mut gone = 0;
            let at = |range: &Range<usize>| {
                let at = range.start - gone;
                gone += range.len();
                super::selection::Selection::caret(at)
            };
            parts.iter().map(|(range, _)| range).map(at).collect()
        };
        let main = self.carets().main_index();
        self.change(parts, Kind::Other, |_| super::selection::Carets::new(carets, main));
    }

    /// Returns the bytes of a line with its line end.
    pub(super) fn whole_line(&self, at: usize) -> Range<usize> {
        let line = self.line_of(at);
        let start = self.line_range(line).start;
        let end = if line + 1 < self.line_count() { self.line_range(line + 1).start } else { self.text().len() };
        start..end
    }
}

/// Returns one step of indent in the style of a line's indent.
fn unit_of(indent: &str) -> &'static str {
    if indent.starts_with('\t') {
        "\t"
    } else if indent.len() % 4 == 2 {
        "  "
    } else {
        INDENT
    }
}

/// Returns the length of the last step of an indent, in bytes.
fn unit_at_end(indent: &str) -> usize {
    if indent.ends_with('\t') {
        1
    } else {
        let spaces = indent.len() - indent.trim_end_matches(' ').len();
        let over = spaces % INDENT.len();
        if over == 0 { spaces.min(INDENT.len()) } else { over }
    }
}

#[cfg(test)]
#[expect(clippy::single_range_in_vec_init, reason = "one range is what is expected")]
mod tests {
    use super::*;

    fn with(text: &str, anchor: usize, head: usize) -> Buffer {
        let mut b = Buffer::new(text);
        b.select(anchor, head);
        b
    }

    #[test]
    fn enter_keeps_the_indent_and_indents_blocks() {
        let mut b = with("    if (x) {}", 12, 12);
        b.new_line();
        assert_eq!(b.text(), "    if (x) {\n        \n    }");
        assert_eq!(b.line_column(b.selection().head), (1, 8));
        b.insert("}");
        assert_eq!(b.line(1), "    }");
    }

    #[test]
    fn open_line_does_not_split_lines() {
        let mut b = with("  f() {\r\n  }", 4, 6);
        b.open_line(Vertical::Down);
        assert_eq!((b.text(), b.selection().head), ("  f() {\r\n    \r\n  }", 13));
        b.undo();
        b.open_line(Vertical::Up);
        assert_eq!((b.text(), b.selection().head), ("  \r\n  f() {\r\n  }", 2));
        let mut b = with("a", 1, 1);
        b.open_line(Vertical::Up);
        b.insert("b");
        b.open_line(Vertical::Down);
        b.insert("c");
        assert_eq!(b.text(), "b\nc\na");
    }

    #[test]
    fn backspace_deletes_an_indent_step_or_a_letter() {
        let mut b = with("        x", 8, 8);
        b.delete(Motion::Left);
        assert_eq!(b.text(), "    x");
        let mut b = with("a\r\nb", 3, 3);
        b.delete(Motion::Left);
        assert_eq!(b.text(), "ab");
        let mut b = with("one two", 7, 7);
        b.delete(Motion::WordLeft);
        assert_eq!(b.text(), "one ");
        let mut b = with("", 0, 0);
        b.delete(Motion::Left);
        b.delete(Motion::Right);
        assert!(!b.undo(), "nothing happened, so there is nothing to undo");
    }

    #[test]
    fn pasted_lines_get_the_line_ends_of_the_file() {
        let mut b = with("a\r\nb", 4, 4);
        b.paste("x\ny\r\nz");
        assert_eq!(b.text(), "a\r\nbx\r\ny\r\nz");
        assert_eq!(with("a\nb", 0, 0).copied_ranges(), [0..2]);
        let mut b = with("a\nb", 2, 2);
        b.cut();
        assert_eq!(b.text(), "a\n");
    }
}
