//! Edits of whole lines: indent, comments, moving, copying and deleting them.

use super::{
    buffer::{Buffer, Replacement, moved},
    edits::INDENT,
    history::{Change, Kind},
    motion::Vertical,
    selection::{Carets, Selection},
};
use std::ops::Range;

impl Buffer {
    /// Tab: indents the lines of a selection of several lines, or inserts spaces up to the next stop.
    pub(crate) fn indent(&mut self) {
        let is_in_line = |s: &Selection| self.line_of(s.anchor) == self.line_of(s.head);
        if self.carets().list().iter().all(is_in_line) {
            self.replace_at_carets(Kind::Other, |buffer, s| {
                let (_, column) = buffer.line_column(s.range().start);
                Replacement::new(s.range(), &INDENT[column % INDENT.len()..])
            });
        } else {
            self.indent_lines();
        }
    }

    /// Ctrl+]: adds one step of indent to every line of the selections.
    pub(crate) fn indent_lines(&mut self) {
        let indent = |line: &str| if line.trim().is_empty() { line.into() } else { format!("{INDENT}{line}") };
        self.edit_lines(|_, line| indent(line));
    }

    /// Shift+Tab: removes one step of indent from every line of the selections.
    pub(crate) fn unindent(&mut self) {
        self.edit_lines(|_, line| {
            let spaces = line.len() - line.trim_start_matches(' ').len();
            let cut = if line.starts_with('\t') { 1 } else { spaces.min(INDENT.len()) };
            line[cut..].to_owned()
        });
    }

    /// Turns every line of a selection into a comment, or uncomments all if all are comments.
    pub(crate) fn toggle_comment(&mut self) {
        let blocks = self.blocks();
        let plan: Vec<(Range<usize>, bool, usize)> = blocks
            .into_iter()
            .map(|block| {
                let lines = || block.clone().map(|l| self.line(l)).filter(|l| !l.trim().is_empty());
                let all = lines().count() > 0 && lines().all(|l| l.trim_start().starts_with("//"));
                let depth = lines().map(|l| l.len() - l.trim_start().len()).min().unwrap_or(0);
                (block, all, depth)
            })
            .collect();
        self.edit_lines(|at, line| {
            let (_, all, depth) = plan.iter().find(|(block, ..)| block.contains(&at)).unwrap_or(&plan[0]);
            let body = line.trim_start();
            if line.trim().is_empty() {
                line.to_owned()
            } else if *all {
                let rest = body[2..].strip_prefix(' ').unwrap_or(&body[2..]);
                format!("{}{rest}", &line[..line.len() - body.len()])
            } else {
                format!("{}// {}", &line[..*depth], &line[*depth..])
            }
        });
    }

    /// Moves the lines of every selection past the line above or below. If one cannot move, none does.
    pub(crate) fn move_lines(&mut self, way: Vertical) {
        let blocks = self.blocks();
        let is_stuck = |b: &Range<usize>| match way {
            Vertical::Up => b.start == 0,
            Vertical::Down => b.end == self.line_count(),
        };
        if blocks.iter().any(is_stuck) {
            return;
        }
        let mut parts = Vec::new();
        let mut shifts = Vec::new();
        for block in &blocks {
            let lines = self.line_range(block.start).start..self.line_range(block.end - 1).end;
            let text = &self.text()[lines.clone()];
            match way {
                Vertical::Up => {
                    let above = self.line_range(block.start - 1);
                    let end = &self.text()[above.end..lines.start];
                    shifts.push((lines.clone(), -((above.len() + end.len()) as isize)));
                    parts.push((above.start..lines.end, format!("{text}{end}{}", &self.text()[above])));
                }
                Vertical::Down => {
                    let below = self.line_range(block.end);
                    let end = &self.text()[lines.end..below.start];
                    shifts.push((lines.clone(), (below.len() + end.len()) as isize));
                    parts.push((lines.start..below.end, format!("{}{end}{text}", &self.text()[below])));
                }
            }
        }
        let carets = self.carets().clone();
        self.change(parts, Kind::Other, |buffer| {
            carets.map(|s| {
                let of = s.range().start;
                let shift = shifts.iter().rfind(|(lines, _)| lines.start <= of).map_or(0, |(_, by)| *by);
                s.map(|at| at.saturating_add_signed(shift).min(buffer.text().len()))
            })
        });
    }

    /// Copies the lines of every selection above or below them, and moves the carets to the copy.
    pub(crate) fn copy_lines(&mut self, way: Vertical) {
        let blocks = self.blocks();
        let mut parts = Vec::new();
        let mut shifts = Vec::new();
        let mut shift = 0;
        for block in &blocks {
            let lines = self.line_range(block.start).start..self.line_range(block.end - 1).end;
            let copy = format!("{}{}", self.line_end(), &self.text()[lines.clone()]);
            // The text is the same either way; the carets decide which of the two is the copy.
            shifts.push((lines.start, shift + if way == Vertical::Down { copy.len() } else { 0 }));
            shift += copy.len();
            parts.push((lines.end..lines.end, copy));
        }
        let carets = self.carets().clone();
        self.change(parts, Kind::Other, |_| {
            carets.map(|s| {
                let of = s.range().start;
                let shift = shifts.iter().rfind(|(start, _)| *start <= of).map_or(0, |(_, by)| *by);
                s.map(|at| at + shift)
            })
        });
    }

    /// Deletes the lines of every selection.
    pub(crate) fn delete_lines(&mut self) {
        let blocks = self.blocks();
        let columns: Vec<usize> = blocks.iter().map(|b| self.column_in(b).unwrap_or(0)).collect();
        let last = self.line_count();
        let parts = blocks.iter().map(|block| {
            let start = self.line_range(block.start).start;
            let range = match (block.start, block.end) {
                (0, end) if end == last => 0..self.text().len(),
                // The last line is deleted with the line end before it.
                (first, end) if end == last => self.line_range(first - 1).end..self.text().len(),
                (_, end) => start..self.line_range(end).start,
            };
            (range, String::new())
        });
        let parts = parts.collect();
        let main = blocks.iter().position(|b| b.contains(&self.line_of(self.selection().head))).unwrap_or(0);
        self.change(parts, Kind::Other, |buffer| {
            let mut gone = 0;
            let caret = |(block, column): (&Range<usize>, usize)| {
                let line = (block.start - gone).min(buffer.line_count() - 1);
                gone += block.len();
                Selection::caret(buffer.position(line, column))
            };
            Carets::new(blocks.iter().zip(columns).map(caret).collect(), main)
        });
    }

    /// Returns the column of the first caret in a range of lines.
    fn column_in(&self, block: &Range<usize>) -> Option<usize> {
        let places = self.carets().list().iter().map(|s| self.line_column(s.head));
        places.filter(|(line, _)| block.contains(line)).map(|(_, column)| column).next()
    }

    /// Returns the lines that a selection touches; one that ends at a line's start does not touch it.
    fn lines_of(&self, selection: Selection) -> Range<usize> {
        let range = selection.range();
        let first = self.line_of(range.start);
        let mut last = self.line_of(range.end);
        if last > first && self.line_range(last).start == range.end {
            last -= 1;
        }
        first..last + 1
    }

    /// Returns runs of lines that selections touch, in order, with at least one other line between two.
    pub(super) fn blocks(&self) -> Vec<Range<usize>> {
        let mut blocks: Vec<Range<usize>> = Vec::new();
        for lines in self.carets().list().iter().map(|s| self.lines_of(*s)) {
            match blocks.last_mut() {
                Some(last) if lines.start <= last.end => last.end = last.end.max(lines.end),
                _ => blocks.push(lines),
            }
        }
        blocks
    }

    /// Changes every selected line as one step, and keeps the selections' ends at their characters.
    fn edit_lines(&mut self, change: impl Fn(usize, &str) -> String) {
        let mut changes = Vec::new();
        for line in self.blocks().into_iter().flatten() {
            let old = self.line(line);
            let new = change(line, old);
            if new == old {
                continue;
            }
            let start = self.line_range(line).start;
            let head = old.bytes().zip(new.bytes()).take_while(|(a, b)| a == b).count();
            let head = old.floor_char_boundary(head).min(new.floor_char_boundary(head));
            // Each line changes in one place: after the common prefix of the old and the new line.
            let (removed, inserted) = if new.len() > old.len() {
                (head..head, &new[head..head + new.len() - old.len()])
            } else {
                (head..head + old.len() - new.len(), "")
            };
            changes.push(Change {
                at: start + removed.start,
                removed: old[removed].to_owned(),
                inserted: inserted.to_owned(),
            });
        }
        let starts: Vec<usize> = changes.iter().map(|c| self.line_range(self.line_of(c.at)).start).collect();
        // The start of a line stays, so that a selection of whole lines remains one.
        let carets = self.carets().map(|s| {
            s.map(|at| {
                let shift = changes.iter().zip(&starts).find(|(c, start)| **start == at && c.at == at);
                moved(&changes, at) - shift.map_or(0, |(c, _)| c.inserted.len())
            })
        });
        let parts = changes.into_iter().map(|c| (c.range(), c.inserted)).collect();
        self.change(parts, Kind::Other, |_| carets);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(text: &str, anchor: usize, head: usize) -> Buffer {
        let mut b = Buffer::new(text);
        b.select(anchor, head);
        b
    }

    #[test]
    fn toggling_comments_is_one_step() {
        let text = "  a;\n\n    b;\nc;";
        let mut b = with(text, 0, 10);
        b.toggle_comment();
        assert_eq!(b.text(), "  // a;\n\n  //   b;\nc;");
        b.toggle_comment();
        assert_eq!(b.text(), text);
        b.undo();
        b.undo();
        assert_eq!(b.text(), text);
        assert!(!b.undo());
    }

    #[test]
    fn tab_indents_a_selection_and_shift_tab_unindents_it() {
        let mut b = with("a\nb\nc", 0, 3);
        b.indent();
        assert_eq!(b.text(), "    a\n    b\nc");
        b.unindent();
        assert_eq!(b.text(), "a\nb\nc");
        let mut b = with("ab", 2, 2);
        b.indent();
        assert_eq!(b.text(), "ab  ");
        b.indent_lines();
        assert_eq!((b.text(), b.selection().head), ("    ab  ", 8));
    }

    #[test]
    fn lines_are_moved_copied_and_deleted_with_their_carets() {
        let mut b = with("a\nbb\nc", 3, 3);
        b.move_lines(Vertical::Down);
        assert_eq!((b.text(), b.selection()), ("a\nc\nbb", Selection::caret(5)));
        b.move_lines(Vertical::Down);
        assert_eq!(b.text(), "a\nc\nbb", "there is nothing below");
        b.move_lines(Vertical::Up);
        b.move_lines(Vertical::Up);
        assert_eq!((b.text(), b.selection()), ("bb\na\nc", Selection::caret(1)));
        b.copy_lines(Vertical::Down);
        assert_eq!((b.text(), b.selection()), ("bb\nbb\na\nc", Selection::caret(4)));
        b.copy_lines(Vertical::Up);
        assert_eq!((b.text(), b.selection()), ("bb\nbb\nbb\na\nc", Selection::caret(4)));
        b.delete_lines();
        b.delete_lines();
        assert_eq!((b.text(), b.selection()), ("bb\na\nc", Selection::caret(4)));
        // Whole lines with the line end of the last; the next line is not included.
        let mut b = with("a\r\nb\r\nc", 0, 3);
        b.move_lines(Vertical::Down);
        assert_eq!((b.text(), b.selection()), ("b\r\na\r\nc", Selection::new(3, 6)));
        let mut b = with("a\nb", 2, 2);
        b.delete_lines();
        assert_eq!((b.text(), b.selection()), ("a", Selection::caret(0)));
        b.delete_lines();
        assert_eq!(b.text(), "");
    }
}
