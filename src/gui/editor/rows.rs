//! Rows of the window: a wrapped line has several, a folded line has none.

use super::{
    brackets,
    buffer::Buffer,
    highlight::{Highlight, Replaced},
    selection::Selection,
};
use std::ops::Range;

/// The mapping of rows to lines.
#[derive(Clone, Debug, Default)]
pub(super) struct Rows {
    /// The number of rows above each line, and last the total; empty while every line is one row.
    above: Vec<u32>,
    /// Folded lines, each range below the line that opens its block; ranges may be nested.
    folds: Vec<Range<usize>>,
}

/// A row and the part of a line that it shows.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    pub line: usize,
    /// Bytes of the text.
    pub bytes: Range<usize>,
    /// The indent of a continuation row, in digit widths.
    pub indent: f32,
    pub is_first: bool,
    pub is_last: bool,
}

impl Rows {
    /// Updates the mapping after lines were replaced or the wrap width changed.
    pub(super) fn update(&mut self, buffer: &Buffer, index: &Highlight, replaced: Option<Replaced>) {
        if let Some(replaced) = replaced {
            self.folds = std::mem::take(&mut self.folds)
                .into_iter()
                .filter_map(|fold| followed(fold, replaced, buffer, index))
                .collect();
        }
        self.count(buffer, index);
    }

    fn count(&mut self, buffer: &Buffer, index: &Highlight) {
        self.above.clear();
        if self.folds.is_empty() && !index.wraps() {
            return;
        }
        let mut hidden = vec![false; buffer.line_count()];
        for fold in &self.folds {
            hidden[fold.start.min(buffer.line_count())..fold.end.min(buffer.line_count())].fill(true);
        }
        let mut sum = 0;
        self.above.reserve(buffer.line_count() + 1);
        self.above.push(0);
        for (line, is_hidden) in hidden.into_iter().enumerate() {
            sum += if is_hidden { 0 } else { index.rows(line) };
            self.above.push(sum);
        }
    }

    /// Returns whether every line is one row.
    pub(super) fn is_plain(&self) -> bool {
        self.above.is_empty()
    }

    /// Returns the number of rows.
    pub(super) fn len(&self, buffer: &Buffer) -> usize {
        self.above.last().map_or(buffer.line_count(), |all| *all as usize)
    }

    /// Returns the first row of a line; for a folded line, that of the visible line above it.
    pub(super) fn of_line(&self, line: usize) -> usize {
        match self.above.get(line) {
            None => line,
            Some(row) if self.is_hidden(line) => (*row as usize).saturating_sub(1),
            Some(row) => *row as usize,
        }
    }

    /// Returns the row that shows a place of the text.
    pub(super) fn of(&self, buffer: &Buffer, index: &Highlight, at: usize) -> usize {
        let line = buffer.line_of(at);
        let first = self.of_line(line);
        if self.is_plain() || self.is_hidden(line) || index.rows(line) == 1 {
            return first;
        }
        let mut start = buffer.line_range(line).start;
        let mut row = first;
        for piece in index.pieces(line) {
            let end = start + piece.len;
            if at < end || end == buffer.line_range(line).end {
                let breaks = index.breaks(&buffer.text()[start..end], piece);
                return row + breaks.starts.partition_point(|b| start + b <= at) - 1;
            }
            row += piece.rows as usize;
            start = end;
        }
        row
    }

    /// Returns the line of a row, and the index of the row in it.
    pub(super) fn line_at(&self, buffer: &Buffer, row: usize) -> (usize, usize) {
        if self.is_plain() {
            return (row.min(buffer.line_count() - 1), 0);
        }
        // Of the lines with equal counts, the last is the one that has rows itself.
        let line = self.above.partition_point(|above| *above as usize <= row).saturating_sub(1);
        let line = line.min(buffer.line_count() - 1);
        (line, row.saturating_sub(self.above[line] as usize))
    }

    /// Returns the part of the text that a row shows.
    pub(super) fn part(&self, buffer: &Buffer, index: &Highlight, row: usize) -> Part {
        let (line, number) = self.line_at(buffer, row);
        let whole = buffer.line_range(line);
        let mut part = Part { line, bytes: whole.clone(), indent: 0.0, is_first: number == 0, is_last: true };
        if index.rows(line) <= 1 {
            return part;
        }
        let mut above = 0;
        let mut start = whole.start;
        for piece in index.pieces(line) {
            let end = start + piece.len;
            let rows = piece.rows as usize;
            if number < above + rows || end == whole.end {
                let breaks = index.breaks(&buffer.text()[start..end], piece);
                let number = (number - above).min(breaks.starts.len() - 1);
                let to = breaks.starts.get(number + 1).map_or(end, |next| start + next);
                part.bytes = start + breaks.starts[number]..to;
                part.indent = if number == 0 { 0.0 } else { breaks.indent };
                part.is_last = to == whole.end;
                break;
            }
            above += rows;
            start = end;
        }
        part
    }

    /// Returns the caret this number of rows away, at the column that the caret keeps.
    pub(super) fn moved_by_rows(&self, buffer: &Buffer, index: &Highlight, from: Selection, by: isize) -> Selection {
        let row = self.of(buffer, index, from.head);
        let letters = |range: Range<usize>| buffer.text()[range].chars().count();
        let column = from.column.unwrap_or_else(|| {
            let part = self.part(buffer, index, row);
            letters(part.bytes.start..from.head.max(part.bytes.start)) + part.indent.round() as usize
        });
        let head = match row.checked_add_signed(by) {
            None => 0,
            Some(to) if to >= self.len(buffer) => buffer.text().len(),
            Some(to) => {
                let part = self.part(buffer, index, to);
                let text = &buffer.text()[part.bytes.clone()];
                let mut column = column.saturating_sub(part.indent.round() as usize);
                if !part.is_last {
                    // The position after its last letter belongs to the next row.
                    column = column.min(letters(part.bytes.clone()).saturating_sub(1));
                }
                text.char_indices().nth(column).map_or(part.bytes.end, |(i, _)| part.bytes.start + i)
            }
        };
        Selection { column: Some(column), ..Selection::caret(head) }
    }

    /// Returns whether the line is folded.
    pub(super) fn is_hidden(&self, line: usize) -> bool {
        self.folds.iter().any(|fold| fold.contains(&line))
    }

    /// Returns whether the block that the line opens is folded.
    pub(super) fn is_folded(&self, line: usize) -> bool {
        self.folds.iter().any(|fold| fold.start == line + 1)
    }

    /// Folds the block that a line opens. Returns false if there is nothing to fold.
    pub(super) fn fold(&mut self, buffer: &Buffer, index: &Highlight, line: usize) -> bool {
        let Some(hidden) = hidden_by(buffer, index, line).filter(|hidden| !self.folds.contains(hidden)) else {
            return false;
        };
        self.folds.push(hidden);
        self.count(buffer, index);
        true
    }

    pub(super) fn fold_all(&mut self, buffer: &Buffer, index: &Highlight) {
        let blocks = brackets::blocks(index, buffer).into_iter();
        self.folds = blocks.map(|(first, last)| first + 1..last).filter(|hidden| !hidden.is_empty()).collect();
        self.count(buffer, index);
    }

    pub(super) fn unfold_all(&mut self, buffer: &Buffer, index: &Highlight) {
        self.folds.clear();
        self.count(buffer, index);
    }

    /// Unfolds the block that a line opens.
    pub(super) fn unfold(&mut self, buffer: &Buffer, index: &Highlight, line: usize) {
        self.folds.retain(|fold| fold.start != line + 1);
        self.count(buffer, index);
    }

    /// Unfolds the blocks that hide a line.
    pub(super) fn reveal(&mut self, buffer: &Buffer, index: &Highlight, line: usize) {
        if self.is_hidden(line) {
            self.folds.retain(|fold| !fold.contains(&line));
            self.count(buffer, index);
        }
    }
}

/// Returns the lines between the one that opens a block and the one that closes it.
fn hidden_by(buffer: &Buffer, index: &Highlight, line: usize) -> Option<Range<usize>> {
    let hidden = line + 1..brackets::block_end(index, buffer, line)?;
    (!hidden.is_empty()).then_some(hidden)
}

/// Returns a fold after lines were replaced; `None` if its block changed beyond its first and last line.
fn followed(fold: Range<usize>, replaced: Replaced, buffer: &Buffer, index: &Highlight) -> Option<Range<usize>> {
    let Replaced { first, old, new } = replaced;
    let header = fold.start - 1;
    if first > fold.end {
        return Some(fold);
    }
    if first + old <= header {
        let moved = |line: usize| line - old + new;
        return Some(moved(fold.start)..moved(fold.end));
    }
    let is_at_an_end = (first == header && old == 1 && new == 1) || first >= fold.end;
    if is_at_an_end { hidden_by(buffer, index, header) } else { None }
}

#[cfg(test)]
mod tests {
    use super::{super::history::Kind, *};

    struct Text {
        buffer: Buffer,
        index: Highlight,
        rows: Rows,
    }

    impl Text {
        fn new(text: &str, wrap: Option<f32>) -> Self {
            let (buffer, index, rows) = (Buffer::new(text), Highlight::default(), Rows::default());
            let mut text = Text { buffer, index, rows };
            text.index.set_wrap(&text.buffer, wrap);
            text.update();
            text
        }

        fn update(&mut self) {
            self.index.update(&mut self.buffer, "", &mut |_| 1.0);
            let replaced = self.index.take_replaced();
            self.rows.update(&self.buffer, &self.index, replaced);
        }

        fn replace(&mut self, range: Range<usize>, with: &str) {
            self.buffer.replace(range, with, Kind::Other);
            self.update();
        }

        /// Returns the text of each row.
        fn shown(&self) -> Vec<&str> {
            let part = |row| self.rows.part(&self.buffer, &self.index, row);
            (0..self.rows.len(&self.buffer)).map(|row| &self.buffer.text()[part(row).bytes]).collect()
        }

        fn fold(&mut self, line: usize) -> bool {
            self.rows.fold(&self.buffer, &self.index, line)
        }
    }

    #[test]
    fn folds_hide_rows_and_follow_their_block() {
        let mut t = Text::new("a\nf() {\n  if {\n    b\n  }\n}\nc\n", None);
        assert!(t.rows.is_plain() && t.fold(2) && t.fold(1) && !t.fold(0));
        assert_eq!(t.shown(), ["a", "f() {", "}", "c", ""]);
        assert_eq!((t.rows.of_line(5), t.rows.of_line(3), t.rows.line_at(&t.buffer, 2)), (2, 1, (5, 0)));
        t.replace(0..0, "x\ny\n");
        assert_eq!(t.shown(), ["x", "y", "a", "f() {", "}", "c", ""]);
        let header = t.buffer.line_range(3).start;
        t.replace(header..header, "g");
        assert_eq!(t.shown()[3], "gf() {");
        t.rows.unfold(&t.buffer, &t.index, 3);
        assert_eq!(t.shown()[3..6], ["gf() {", "  if {", "  }"], "the inner one stays folded");
        t.fold(3);
        t.rows.reveal(&t.buffer, &t.index, 5);
        assert!(t.rows.is_plain());
        t.fold(3);
        // A change inside a fold unfolds it.
        let inside = t.buffer.line_range(5).start;
        t.replace(inside..inside, "z");
        assert!(t.rows.is_plain());
        t.rows.fold_all(&t.buffer, &t.index);
        assert_eq!(t.shown(), ["x", "y", "a", "gf() {", "}", "c", ""]);
    }

    #[test]
    fn wrapped_rows_cover_the_text_and_carets_move_by_row() {
        let long = "vec3 colour = mix(a, b, smoothstep(0.0, 1.0, x)); ";
        let mut t = Text::new(&format!("{long}\n{}\n\nshort {{\n{long}\n}}\n", long.repeat(60)), Some(30.0));
        let mut seed = 5u32;
        for round in 0..200 {
            let all: String = t.shown().concat();
            assert_eq!(all, t.buffer.text().replace('\n', ""), "round {round}");
            let rows = t.rows.len(&t.buffer);
            for row in (0..rows).step_by(7) {
                let part = t.rows.part(&t.buffer, &t.index, row);
                assert_eq!(t.rows.of(&t.buffer, &t.index, part.bytes.start), row);
                let down = t.rows.moved_by_rows(&t.buffer, &t.index, Selection::caret(part.bytes.start), 1);
                let wanted = (row + 1).min(rows - 1);
                assert_eq!(t.rows.of(&t.buffer, &t.index, down.head), wanted, "down from {row} of {rows}");
            }
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let at = t.buffer.snap((seed >> 8) as usize % t.buffer.text().len());
            let with = ["x", " wide words ", "\n", "/*", "é"][(seed >> 4) as usize % 5];
            t.replace(at..at, with);
        }
        assert!(t.index.set_wrap(&t.buffer, None) && !t.index.set_wrap(&t.buffer, None));
        t.rows.update(&t.buffer, &t.index, None);
        assert!(t.rows.is_plain());
    }
}
