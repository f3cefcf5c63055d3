//! A text with its lines, selections and undo history: an editor without its display.
//!
//! Every change of a text goes through [`Buffer::replace`], so every one can be undone and keeps the index of lines up
//! to date. Knows nothing of windows, keys or GLSL. Positions are bytes on character boundaries; lines count from 0.

use super::{
    history::{Change, Edit, History, Kind},
    selection::{Carets, Selection},
};
use std::ops::Range;

/// The lengths of the unchanged start and end of a text, in bytes: everything between them has changed. They do not
/// overlap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Unchanged {
    pub head: usize,
    pub tail: usize,
}

/// A range of the text, its replacement, and the resulting selection relative to the start of the range.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Replacement {
    pub range: Range<usize>,
    pub with: String,
    pub anchor: usize,
    pub head: usize,
}

impl Replacement {
    /// Leaves the caret after the replacement.
    pub(super) fn new(range: Range<usize>, with: impl Into<String>) -> Self {
        let with = with.into();
        Self { range, anchor: with.len(), head: with.len(), with }
    }
}

/// A text being edited.
#[derive(Clone, Debug)]
pub(crate) struct Buffer {
    text: String,
    /// The byte at which each line starts; never empty.
    starts: Vec<usize>,
    carets: Carets,
    history: History,
    /// Counts changes of the text.
    revision: u64,
    /// The ends that are unchanged since the last [`Buffer::take_unchanged`]; `None` if nothing has changed.
    unchanged: Option<Unchanged>,
    /// The lines that have changed since then, if the change was one edit in many places that kept the number of
    /// lines.
    touched: Vec<usize>,
    /// Closing brackets that were inserted automatically with their opening ones, and can be typed over.
    pub(super) closers: Vec<usize>,
    /// The steps that were undone (`false`) and redone (`true`), for edits of several texts.
    reverted: Vec<(u64, bool)>,
    /// The selections were made from a caret, so that further occurrences must be whole words.
    pub(super) selects_words: bool,
}

impl Buffer {
    pub(crate) fn new(text: &str) -> Self {
        Self {
            text: text.to_owned(),
            starts: line_starts(text),
            carets: Carets::default(),
            history: History::default(),
            revision: 0,
            unchanged: Some(Unchanged { head: 0, tail: 0 }),
            touched: Vec::new(),
            closers: Vec::new(),
            reverted: Vec::new(),
            selects_words: false,
        }
    }

    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    pub(crate) fn revision(&self) -> u64 {
        self.revision
    }

    pub(crate) fn carets(&self) -> &Carets {
        &self.carets
    }

    /// Returns the main selection.
    pub(crate) fn selection(&self) -> Selection {
        self.carets.main()
    }

    /// Returns the text of the main selection.
    pub(crate) fn selected_text(&self) -> &str {
        &self.text[self.selection().range()]
    }

    /// Sets a single selection; both ends are moved to the nearest valid positions.
    pub(crate) fn select(&mut self, anchor: usize, head: usize) {
        self.set_carets(Carets::one(Selection::new(anchor, head)));
    }

    /// Sets the selections; their ends are moved to the nearest valid positions.
    pub(crate) fn set_carets(&mut self, carets: Carets) {
        self.carets = carets.map(|s| Selection { anchor: self.snap(s.anchor), head: self.snap(s.head), ..s });
        self.selects_words = false;
        self.history.end_step();
        self.settle_closers();
    }

    /// Returns the nearest position at or before `at` that is between two characters and not inside a `\r\n`.
    pub(crate) fn snap(&self, at: usize) -> usize {
        let mut at = at.min(self.text.len());
        while !self.text.is_char_boundary(at) {
            at -= 1;
        }
        let bytes = self.text.as_bytes();
        if at > 0 && bytes[at - 1] == b'\r' && bytes.get(at) == Some(&b'\n') { at - 1 } else { at }
    }

    pub(crate) fn line_count(&self) -> usize {
        self.starts.len()
    }

    pub(crate) fn line_of(&self, at: usize) -> usize {
        self.starts.partition_point(|s| *s <= at) - 1
    }

    /// Returns the bytes of a line without its line end; of the last line if the line does not exist.
    pub(crate) fn line_range(&self, line: usize) -> Range<usize> {
        let line = line.min(self.starts.len() - 1);
        let start = self.starts[line];
        let mut end = self.starts.get(line + 1).map_or(self.text.len(), |next| next - 1);
        if end > start && self.text.as_bytes()[end - 1] == b'\r' {
            end -= 1;
        }
        start..end
    }

    pub(crate) fn line(&self, line: usize) -> &str {
        &self.text[self.line_range(line)]
    }

    /// Returns the line and column (in characters) of a position, both from 0.
    pub(crate) fn line_column(&self, at: usize) -> (usize, usize) {
        let line = self.line_of(at);
        (line, self.text[self.starts[line]..at].chars().count())
    }

    /// Returns the position of a column (in characters) of a line, or the line's end if it is shorter.
    pub(crate) fn position(&self, line: usize, column: usize) -> usize {
        let range = self.line_range(line);
        self.text[range.clone()].char_indices().nth(column).map_or(range.end, |(i, _)| range.start + i)
    }

    /// Returns the line end of the text's first line, so that a file keeps its own.
    pub(crate) fn line_end(&self) -> &'static str {
        match self.starts.get(1) {
            Some(next) if *next >= 2 && self.text.as_bytes()[next - 2] == b'\r' => "\r\n",
            _ => "\n",
        }
    }

    /// Replaces `range` with `with`, and leaves one caret after it.
    pub(crate) fn replace(&mut self, range: Range<usize>, with: &str, kind: Kind) {
        let caret = Selection::caret(range.start + with.len());
        self.change(vec![(range, with.to_owned())], kind, |_| Carets::one(caret));
    }

    /// Returns whether the line of a byte includes a file.
    pub(crate) fn names_file(&self, at: usize) -> bool {
        let line = &self.text[self.line_range(self.line_of(at))];
        let directive = line.trim_start().strip_prefix('#').map(str::trim_start);
        directive.is_some_and(|directive| directive.starts_with("include") && directive.contains('"'))
    }

    /// Replaces ordered, disjoint ranges of the text as one step of undo. Carets keep their places.
    pub(crate) fn replace_parts(&mut self, parts: Vec<(Range<usize>, String)>) {
        let changes: Vec<Change> = parts
            .iter()
            .map(|(range, with)| Change {
                at: range.start,
                removed: self.text[range.clone()].to_owned(),
                inserted: with.clone(),
            })
            .collect();
        let after = self.carets.map(|s| s.map(|at| moved(&changes, at)));
        self.change(parts, Kind::Other, |_| after);
        self.set_carets(self.carets.clone());
    }

    /// Replaces a range of the text for each caret, as one edit. A range that overlaps the previous one is cut where
    /// that one ends.
    pub(super) fn replace_at_carets(&mut self, kind: Kind, part: impl Fn(&Self, Selection) -> Replacement) {
        let mut parts: Vec<Replacement> = self.carets.list().iter().map(|s| part(self, *s)).collect();
        let mut end = 0;
        let mut shift = 0isize;
        let mut after = Vec::with_capacity(parts.len());
        for part in &mut parts {
            part.range = part.range.start.max(end)..part.range.end.max(end);
            end = part.range.end;
            let start = part.range.start.saturating_add_signed(shift);
            shift += part.with.len() as isize - part.range.len() as isize;
            after.push(Selection::new(start + part.anchor, start + part.head));
        }
        let after = Carets::new(after, self.carets.main_index());
        self.change(parts.into_iter().map(|p| (p.range, p.with)).collect(), kind, |_| after);
    }

    /// Replaces ordered, disjoint ranges of the text as one edit. `after` returns the new carets from the changed
    /// text.
    pub(super) fn change(
        &mut self,
        parts: Vec<(Range<usize>, String)>,
        kind: Kind,
        after: impl FnOnce(&Self) -> Carets,
    ) {
        let change = |(range, with): (Range<usize>, String)| {
            let removed = self.text[range.clone()].to_owned();
            (removed != with).then_some(Change { at: range.start, removed, inserted: with })
        };
        let changes: Vec<Change> = parts.into_iter().filter_map(change).collect();
        self.apply(&changes);
        self.closers.retain_mut(|at| {
            let stays = !changes.iter().any(|c| c.range().contains(at));
            *at = moved(&changes, *at);
            stays
        });
        let before = std::mem::take(&mut self.carets);
        self.carets = after(self);
        self.selects_words = false;
        if changes.is_empty() {
            self.history.go_on(&self.carets);
        } else {
            self.history.push(Edit { changes, before, after: self.carets.clone() }, kind);
        }
        self.settle_closers();
    }

    /// Makes the text equal to `new` by the smallest single change, so that carets keep their places if possible. The
    /// change can be undone. Used for text that was changed outside the editor.
    pub(crate) fn set_text(&mut self, new: &str) {
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
        let after = self.carets.map(|s| s.map(moved));
        self.change(vec![(range.clone(), with.to_owned())], Kind::Other, |_| after);
        self.set_carets(self.carets.clone());
    }

    /// Returns the number of the step that undo reverts next; different for each step of a text.
    pub(crate) fn done_step(&self) -> Option<u64> {
        self.history.done()
    }

    /// Returns the number of the step that redo makes next.
    pub(crate) fn undone_step(&self) -> Option<u64> {
        self.history.undone()
    }

    /// Returns the steps that were undone (`false`) and redone (`true`) since the last call.
    pub(crate) fn take_reverted(&mut self) -> Vec<(u64, bool)> {
        std::mem::take(&mut self.reverted)
    }

    /// Undoes the last step. Returns false if there is none.
    pub(crate) fn undo(&mut self) -> bool {
        let Some(step) = self.history.undo() else { return false };
        self.reverted.push((step.id, false));
        for edit in step.edits.into_iter().rev() {
            self.apply(&edit.inverse());
            self.carets = edit.before;
        }
        self.closers.clear();
        self.selects_words = false;
        true
    }

    /// Redoes what was last undone. Returns false if there is nothing to redo.
    pub(crate) fn redo(&mut self) -> bool {
        let Some(step) = self.history.redo() else { return false };
        self.reverted.push((step.id, true));
        for edit in step.edits {
            self.apply(&edit.changes);
            self.carets = edit.after;
        }
        self.closers.clear();
        self.selects_words = false;
        true
    }

    /// Returns the ends that have not changed since the last call, so that data derived from them can be kept; `None`
    /// if nothing has changed.
    pub(crate) fn take_unchanged(&mut self) -> Option<Unchanged> {
        self.unchanged.take()
    }

    /// Returns the lines that have changed since [`Buffer::take_unchanged`], in order, if all lines between them are
    /// known to be unchanged; otherwise nothing.
    pub(crate) fn take_touched(&mut self) -> Vec<usize> {
        std::mem::take(&mut self.touched)
    }

    /// Applies ordered, disjoint changes as one replacement from the first to the last, so that many changes cost as
    /// much as copying the text between them.
    fn apply(&mut self, changes: &[Change]) {
        match changes {
            [] => {}
            [one] => self.splice(one.range(), &one.inserted),
            [first, .., last] => {
                let whole = first.at..last.range().end;
                if changes.iter().all(|c| !c.removed.contains('\n') && !c.inserted.contains('\n')) {
                    return self.change_within_lines(changes);
                }
                let mut text = String::with_capacity(whole.len());
                let mut at = whole.start;
                for change in changes {
                    text.push_str(&self.text[at..change.at]);
                    text.push_str(&change.inserted);
                    at = change.range().end;
                }
                self.splice(whole, &text);
            }
        }
    }

    /// Applies several changes that neither add nor remove lines: lines only move.
    fn change_within_lines(&mut self, changes: &[Change]) {
        let mut text = String::with_capacity(self.text.len() + changes.iter().map(|c| c.inserted.len()).sum::<usize>());
        let mut touched = Vec::with_capacity(changes.len());
        let (mut at, mut line, mut shift) = (0, 0, 0isize);
        for change in changes {
            text.push_str(&self.text[at..change.at]);
            text.push_str(&change.inserted);
            at = change.range().end;
            // Lines that start after the previous changes, up to this one.
            while self.starts.get(line + 1).is_some_and(|start| *start <= change.at) {
                line += 1;
                self.starts[line] = self.starts[line].saturating_add_signed(shift);
            }
            shift += change.inserted.len() as isize - change.removed.len() as isize;
            if touched.last() != Some(&line) {
                touched.push(line);
            }
        }
        text.push_str(&self.text[at..]);
        for start in &mut self.starts[line + 1..] {
            *start = start.saturating_add_signed(shift);
        }
        let (head, tail) = (changes[0].at, self.text.len() - at);
        self.text = text;
        self.touched = if self.unchanged.is_none() { touched } else { Vec::new() };
        self.changed_but(head, tail);
    }

    fn splice(&mut self, range: Range<usize>, with: &str) {
        let first = self.line_of(range.start);
        let last = self.line_of(range.end);
        self.text.replace_range(range.clone(), with);
        for start in &mut self.starts[last + 1..] {
            *start = *start - range.len() + with.len();
        }
        let added = with.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(i, _)| range.start + i + 1);
        self.starts.splice(first + 1..=last, added);
        self.touched.clear();
        self.changed_but(range.start, self.text.len() - range.start - with.len());
    }

    /// Records that everything except `head` and `tail` bytes at the ends has changed.
    fn changed_but(&mut self, head: usize, tail: usize) {
        self.revision += 1;
        let before = self.unchanged.unwrap_or(Unchanged { head, tail });
        self.unchanged = Some(Unchanged { head: head.min(before.head), tail: tail.min(before.tail) });
    }
}

/// Maps a position in the text before some changes to the text after them. An insertion at the position goes before
/// it; a position in removed text goes to the end of its replacement.
pub(super) fn moved(changes: &[Change], at: usize) -> usize {
    let count = changes.partition_point(|c| c.at <= at);
    let shift: isize = changes[..count].iter().map(|c| c.inserted.len() as isize - c.removed.len() as isize).sum();
    // Only the last of them can extend past the position.
    let over = changes[..count].last().map_or(0, |c| c.range().end.saturating_sub(at));
    (at + over).saturating_add_signed(shift)
}

fn line_starts(text: &str) -> Vec<usize> {
    std::iter::once(0).chain(text.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(i, _)| i + 1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn line_index_follows_every_change() {
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
    fn external_changes_keep_the_caret_at_its_word() {
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
    fn lines_exclude_carriage_returns() {
        let b = Buffer::new("ab\r\ncd\r\n");
        assert_eq!((b.line(0), b.line(1), b.line(2), b.line_count()), ("ab", "cd", "", 3));
        assert_eq!(b.line_end(), "\r\n");
        assert_eq!(b.snap(3), 2);
        assert_eq!(b.position(0, 99), 2);
        assert_eq!(b.line_column(5), (1, 1));
    }
}
