//! A text, its lines, the selection and the way back: what an editor is without its picture.
//!
//! Owns every change of a text (all go through [`Buffer::replace`], so every one can be undone) and the index of its
//! lines. Knows no window, no keys and no GLSL. Positions are bytes on character boundaries; lines count from 0.

use super::{
    history::{Change, History, Kind},
    selection::Selection,
};
use std::ops::Range;

/// The ends of a text that are as they were, in bytes: what lies between has changed. They do not overlap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unchanged {
    pub head: usize,
    pub tail: usize,
}

/// A text being edited.
#[derive(Clone, Debug)]
pub struct Buffer {
    text: String,
    /// Byte at which each line begins; never empty.
    starts: Vec<usize>,
    pub(super) selection: Selection,
    history: History,
    /// Counts changes of the text.
    revision: u64,
    /// The ends that are as they were at the last [`Buffer::take_unchanged`]; `None` if nothing has changed.
    unchanged: Option<Unchanged>,
    /// Column the caret wants to keep while it moves up and down, in characters.
    pub(super) wanted_column: Option<usize>,
}

impl Buffer {
    pub fn new(text: &str) -> Self {
        Self {
            text: text.to_owned(),
            starts: line_starts(text),
            selection: Selection::default(),
            history: History::default(),
            revision: 0,
            unchanged: Some(Unchanged { head: 0, tail: 0 }),
            wanted_column: None,
        }
    }

    pub fn text(&self) -> &str {
        &self.text
    }

    pub fn revision(&self) -> u64 {
        self.revision
    }

    pub fn selection(&self) -> Selection {
        self.selection
    }

    pub fn selected_text(&self) -> &str {
        &self.text[self.selection.range()]
    }

    /// Puts the selection somewhere; both ends are moved to the nearest places that exist.
    pub fn select(&mut self, anchor: usize, head: usize) {
        self.selection = Selection { anchor: self.snap(anchor), head: self.snap(head) };
        self.wanted_column = None;
        self.history.seal();
    }

    /// The nearest position at or before `at` that lies between two characters and not inside a `\r\n`.
    pub fn snap(&self, at: usize) -> usize {
        let mut at = at.min(self.text.len());
        while !self.text.is_char_boundary(at) {
            at -= 1;
        }
        let bytes = self.text.as_bytes();
        if at > 0 && bytes[at - 1] == b'\r' && bytes.get(at) == Some(&b'\n') { at - 1 } else { at }
    }

    pub fn line_count(&self) -> usize {
        self.starts.len()
    }

    pub fn line_of(&self, at: usize) -> usize {
        self.starts.partition_point(|s| *s <= at) - 1
    }

    /// Bytes of a line without its end; the last line for one that is not there.
    pub fn line_range(&self, line: usize) -> Range<usize> {
        let line = line.min(self.starts.len() - 1);
        let start = self.starts[line];
        let mut end = self.starts.get(line + 1).map_or(self.text.len(), |next| next - 1);
        if end > start && self.text.as_bytes()[end - 1] == b'\r' {
            end -= 1;
        }
        start..end
    }

    pub fn line(&self, line: usize) -> &str {
        &self.text[self.line_range(line)]
    }

    /// Line and column (in characters) of a position, both from 0.
    pub fn line_column(&self, at: usize) -> (usize, usize) {
        let line = self.line_of(at);
        (line, self.text[self.starts[line]..at].chars().count())
    }

    /// The position of a column (in characters) of a line, or the line's end if it is shorter.
    pub fn position(&self, line: usize, column: usize) -> usize {
        let range = self.line_range(line);
        self.text[range.clone()].char_indices().nth(column).map_or(range.end, |(i, _)| range.start + i)
    }

    /// Returns what ends a line in this text: of the first line, so that a file keeps its own.
    pub fn line_end(&self) -> &'static str {
        match self.starts.get(1) {
            Some(next) if *next >= 2 && self.text.as_bytes()[next - 2] == b'\r' => "\r\n",
            _ => "\n",
        }
    }

    /// Puts `with` in the place of `range` and the caret behind it.
    pub fn replace(&mut self, range: Range<usize>, with: &str, kind: Kind) {
        let caret = range.start + with.len();
        self.replace_selecting(range, with, Selection::caret(caret), kind);
    }

    /// Puts `with` in the place of `range`, then selects `after`.
    pub fn replace_selecting(&mut self, range: Range<usize>, with: &str, after: Selection, kind: Kind) {
        if range.is_empty() && with.is_empty() {
            self.selection = after;
            return;
        }
        let change = Change {
            at: range.start,
            removed: self.text[range.clone()].to_owned(),
            inserted: with.to_owned(),
            before: self.selection,
            after,
        };
        self.apply(range, with);
        self.selection = after;
        self.wanted_column = None;
        self.history.push(change, kind);
    }

    /// Makes the text equal to `new` by the smallest single change, so that the caret stays where it was when it can.
    /// Undo leads back. This is how a text that changed elsewhere arrives.
    pub fn set_text(&mut self, new: &str) {
        if new == self.text {
            return;
        }
        let (old_bytes, new_bytes) = (self.text.as_bytes(), new.as_bytes());
        let mut head = old_bytes.iter().zip(new_bytes).take_while(|(a, b)| a == b).count();
        while !(self.text.is_char_boundary(head) && new.is_char_boundary(head)) {
            head -= 1;
        }
        let limit = (old_bytes.len() - head).min(new_bytes.len() - head);
        let mut tail =
            old_bytes.iter().rev().zip(new_bytes.iter().rev()).take(limit).take_while(|(a, b)| a == b).count();
        while !(self.text.is_char_boundary(old_bytes.len() - tail) && new.is_char_boundary(new_bytes.len() - tail)) {
            tail -= 1;
        }
        let range = head..old_bytes.len() - tail;
        let with = &new[head..new.len() - tail];
        let moved = |at: usize| {
            if at <= range.start {
                at
            } else if at >= range.end {
                at - range.end + range.start + with.len()
            } else {
                at.min(range.start + with.len())
            }
        };
        let after = Selection { anchor: moved(self.selection.anchor), head: moved(self.selection.head) };
        self.replace_selecting(range, with, after, Kind::Other);
        self.select(after.anchor, after.head);
    }

    /// Joins every change until [`Buffer::end_group`] into one step of undo.
    pub fn begin_group(&mut self) {
        self.history.begin_group();
    }

    pub fn end_group(&mut self) {
        self.history.end_group();
    }

    /// Takes the last step back. False if there is none.
    pub fn undo(&mut self) -> bool {
        let Some(step) = self.history.undo() else { return false };
        for change in step.iter().rev() {
            self.apply(change.at..change.at + change.inserted.len(), &change.removed);
            self.selection = change.before;
        }
        self.wanted_column = None;
        true
    }

    /// Does again what undo took back. False if there is nothing.
    pub fn redo(&mut self) -> bool {
        let Some(step) = self.history.redo() else { return false };
        for change in &step {
            self.apply(change.at..change.at + change.removed.len(), &change.inserted);
            self.selection = change.after;
        }
        self.wanted_column = None;
        true
    }

    /// Returns what has not changed since the last call; none if nothing has: what is derived from it can be kept.
    pub fn take_unchanged(&mut self) -> Option<Unchanged> {
        self.unchanged.take()
    }

    fn apply(&mut self, range: Range<usize>, with: &str) {
        let first = self.line_of(range.start);
        let last = self.line_of(range.end);
        self.text.replace_range(range.clone(), with);
        for start in &mut self.starts[last + 1..] {
            *start = *start - range.len() + with.len();
        }
        let added = with.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(i, _)| range.start + i + 1);
        self.starts.splice(first + 1..=last, added);
        self.revision += 1;
        let (head, tail) = (range.start, self.text.len() - range.start - with.len());
        let before = self.unchanged.unwrap_or(Unchanged { head, tail });
        self.unchanged = Some(Unchanged { head: head.min(before.head), tail: tail.min(before.tail) });
    }
}

fn line_starts(text: &str) -> Vec<usize> {
    std::iter::once(0).chain(text.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(i, _)| i + 1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_index_follows_every_change() {
        let mut b = Buffer::new("one\ntwo\nthree");
        for (range, with) in [(3..4, ""), (0..0, "a\nb\n"), (2..9, "\n\n\n"), (0..0, "\r\n"), (1..3, "")] {
            b.replace(range, with, Kind::Other);
            assert_eq!(b.starts, line_starts(b.text()), "{:?}", b.text());
        }
        while b.undo() {
            assert_eq!(b.starts, line_starts(b.text()));
        }
        assert_eq!(b.text(), "one\ntwo\nthree");
        while b.redo() {}
        assert_eq!(b.starts, line_starts(b.text()));
    }

    #[test]
    fn typing_is_undone_word_by_word() {
        let mut b = Buffer::new("");
        for c in "red green".chars() {
            let at = b.selection().head;
            b.replace(at..at, &c.to_string(), Kind::Typing);
        }
        assert!(b.undo());
        assert_eq!(b.text(), "red ");
        assert!(b.undo());
        assert_eq!(b.text(), "");
        assert!(!b.undo());
        assert!(b.redo() && b.redo());
        assert_eq!(b.text(), "red green");
    }

    #[test]
    fn a_text_from_elsewhere_keeps_the_caret_at_its_word() {
        let mut b = Buffer::new("a\nb\nc\n");
        b.select(4, 5);
        b.set_text("a\nlonger\nb\nc\n");
        assert_eq!(b.selected_text(), "c");
        b.set_text("ä\nc");
        b.set_text("ö\nc");
        assert_eq!(b.text(), "ö\nc");
        assert!(b.undo());
        assert_eq!(b.text(), "ä\nc");
    }

    #[test]
    fn carriage_returns_are_no_part_of_a_line() {
        let b = Buffer::new("ab\r\ncd\r\n");
        assert_eq!((b.line(0), b.line(1), b.line(2), b.line_count()), ("ab", "cd", "", 3));
        assert_eq!(b.line_end(), "\r\n");
        assert_eq!(b.snap(3), 2);
        assert_eq!(b.position(0, 99), 2);
        assert_eq!(b.line_column(5), (1, 1));
    }
}
