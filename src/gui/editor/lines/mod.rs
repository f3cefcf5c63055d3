//! The layout of the visible rows: maps between places of the text and points of the window.
//!
//! Only visible pieces are laid out. Their positions are computed from the numbers of a row and a piece in 64 bits:
//! ten million letters are 80 million points wide, and 32-bit floats of that size have steps of eight.

use super::{
    buffer::Buffer,
    colors::code_color,
    highlight::Highlight,
    pieces,
    rows::{Part, Rows},
    semantic::Semantic,
};
use crate::glsl::services::lines::Token;
use crate::gui::theme::Palette;
use egui::{
    FontId, Galley, Pos2, Rect, Stroke, Ui, pos2,
    text::{CCursor, LayoutJob, TextFormat},
    vec2,
};
use std::{ops::Range, sync::Arc};

/// The margin left of every line.
pub(super) const MARGIN: f32 = 6.0;

pub(super) struct Lines<'a> {
    pub index: &'a Highlight,
    /// The mapping of rows to lines.
    pub folding: &'a Rows,
    /// The top left corner of the text, which may be far outside the window.
    pub origin: Pos2,
    pub row_height: f32,
    /// The width of a digit.
    pub glyph: f32,
    pub font: FontId,
    pub palette: &'static Palette,
    /// The first row that is laid out.
    pub first: usize,
    pub rows: Vec<Row>,
}

/// A visible row.
#[derive(Debug)]
pub(super) struct Row {
    pub part: Part,
    /// The runs of it that are laid out, from left to right without gaps.
    pub runs: Vec<Run>,
    /// The end of the row, in points from the start of lines.
    pub width: f64,
}

/// A piece laid out.
#[derive(Debug)]
pub(super) struct Run {
    /// The distance from the start of lines, in points.
    x: f64,
    /// Bytes of the text.
    bytes: Range<usize>,
    pub galley: Arc<Galley>,
}

impl Row {
    /// Returns the bytes of the text that are laid out; `None` if nothing is.
    pub(super) fn bytes(&self) -> Option<Range<usize>> {
        Some(self.runs.first()?.bytes.start..self.runs.last()?.bytes.end)
    }
}

impl Lines<'_> {
    /// Lays out the visible part of some rows; egui caches the layouts of the last frame, so an unchanged row costs
    /// only its lexing. `shown` is the visible part of the window.
    pub(super) fn lay_out(
        &mut self,
        ui: &Ui,
        buffer: &Buffer,
        semantic: Option<&Semantic<'_>>,
        preedit: &str,
        range: Range<usize>,
        shown: Rect,
    ) {
        let left = f64::from(shown.left()) - f64::from(self.origin.x + MARGIN);
        let in_sight = left..left + f64::from(shown.width());
        for row in range {
            let part = self.folding.part(buffer, self.index, row);
            let row = self.row_of_part(ui, buffer, semantic, preedit, part, &in_sight);
            self.rows.push(row);
        }
    }

    fn row_of_part(
        &self,
        ui: &Ui,
        buffer: &Buffer,
        semantic: Option<&Semantic<'_>>,
        preedit: &str,
        part: Part,
        in_sight: &Range<f64>,
    ) -> Row {
        let caret = buffer.selection().head;
        let of_line = buffer.line_range(part.line);
        let text = &buffer.text()[of_line.clone()];
        let indent = f64::from(part.indent * self.glyph);
        let mut row = Row { runs: Vec::new(), width: indent, part };
        let mut at = of_line.start;
        for piece in self.index.pieces(row.part.line) {
            let whole = at..at + piece.len;
            at = whole.end;
            if whole.start >= row.part.bytes.end {
                break;
            }
            let bytes = whole.start.max(row.part.bytes.start)..whole.end.min(row.part.bytes.end);
            if bytes.is_empty() {
                continue;
            }
            let is_end = bytes.end == row.part.bytes.end && row.part.is_last;
            let has_caret = bytes.contains(&caret) || (is_end && caret == bytes.end);
            let composed = if has_caret { preedit } else { "" };
            let glyph = |c| ui.fonts_mut(|f| f.glyph_width(&self.font, c)) / self.glyph;
            let columns = if bytes == whole {
                piece.columns
            } else {
                pieces::columns(&buffer.text()[bytes.clone()], &mut |c| glyph(c))
            };
            let mut width = f64::from(columns * self.glyph);
            if !composed.is_empty() {
                width += f64::from(self.glyph * pieces::columns(composed, &mut |c| glyph(c)));
            }
            if row.width + width >= in_sight.start && row.width <= in_sight.end {
                let of_piece = &buffer.text()[whole.clone()];
                let known = semantic.and_then(|s| s.tokens(whole.clone(), of_piece));
                let tokens = known.unwrap_or_else(|| {
                    let in_line = whole.start - of_line.start..whole.end - of_line.start;
                    self.index.tokens(text, in_line, piece.state)
                });
                let composing = (!composed.is_empty()).then_some((caret, composed));
                let job = self.job(buffer, &tokens, whole.start, &bytes, composing);
                row.runs.push(Run { x: row.width, bytes, galley: ui.painter().layout_job(job) });
            }
            row.width += width;
        }
        if row.part.bytes.is_empty() {
            let mut job = LayoutJob::default();
            if !preedit.is_empty() && caret == of_line.start {
                self.append_preedit(&mut job, preedit);
            }
            row.runs.push(Run { x: row.width, bytes: of_line, galley: ui.painter().layout_job(job) });
        } else if let [run] = &row.runs[..]
            && run.bytes == row.part.bytes
        {
            // The full width of a row is known exactly, including kerning.
            row.width = run.x + f64::from(run.galley.size().x);
        }
        row
    }

    /// Lays out some bytes of the text in their colours. `tokens` start at the byte `from`; `composing` is the text
    /// that an input method composes, with its place.
    fn job(
        &self,
        buffer: &Buffer,
        tokens: &[Token],
        from: usize,
        bytes: &Range<usize>,
        composing: Option<(usize, &str)>,
    ) -> LayoutJob {
        let mut job = LayoutJob::default();
        job.wrap.max_width = f32::INFINITY;
        job.break_on_newline = false;
        let mut at = from;
        for token in tokens {
            let part = at.max(bytes.start)..(at + token.len).min(bytes.end);
            at += token.len;
            if part.is_empty() {
                continue;
            }
            let format = TextFormat::simple(self.font.clone(), code_color(token.class, self.palette));
            match composing.filter(|(caret, _)| part.contains(caret)) {
                Some((caret, composed)) => {
                    job.append(&buffer.text()[part.start..caret], 0.0, format.clone());
                    self.append_preedit(&mut job, composed);
                    job.append(&buffer.text()[caret..part.end], 0.0, format);
                }
                None => job.append(&buffer.text()[part], 0.0, format),
            }
        }
        if let Some((_, composed)) = composing.filter(|(caret, _)| *caret == bytes.end) {
            self.append_preedit(&mut job, composed);
        }
        job
    }

    fn append_preedit(&self, job: &mut LayoutJob, preedit: &str) {
        let underline = Stroke::new(1.0, self.palette.accent);
        job.append(
            preedit,
            0.0,
            TextFormat { underline, ..TextFormat::simple(self.font.clone(), self.palette.strong) },
        );
    }

    pub(super) fn row(&self, row: usize) -> Option<&Row> {
        row.checked_sub(self.first).and_then(|i| self.rows.get(i))
    }

    /// Converts an x coordinate from the start of lines to the window.
    fn in_window(&self, x: f64) -> f32 {
        (f64::from(self.origin.x) + f64::from(MARGIN) + x) as f32
    }

    /// Returns the left edge of the character at a byte of a row; out of view it is estimated from the piece.
    fn x(&self, buffer: &Buffer, row: usize, at: usize) -> f32 {
        let runs = self.row(row).map_or(&[][..], |row| &row.runs);
        if let Some(run) = runs.iter().find(|r| (r.bytes.start..=r.bytes.end).contains(&at)) {
            let column = buffer.text()[run.bytes.start..at].chars().count();
            let in_galley = run.galley.pos_from_cursor(CCursor::new(column)).left();
            return self.in_window(run.x + f64::from(in_galley));
        }
        let part = self.folding.part(buffer, self.index, row);
        let (mut from, mut x) = (part.bytes.start, f64::from(part.indent * self.glyph));
        if part.is_first && part.is_last {
            for piece in self.index.pieces(part.line) {
                if at < from + piece.len {
                    break;
                }
                from += piece.len;
                x += f64::from(piece.columns * self.glyph);
            }
        }
        let rest = pieces::columns(&buffer.text()[from.min(at)..at], &mut |_| 1.0);
        self.in_window(x + f64::from(rest * self.glyph))
    }

    /// Returns where a row ends.
    pub(super) fn end(&self, row: &Row) -> f32 {
        self.in_window(row.width)
    }

    /// Returns where a run is painted in its row.
    pub(super) fn run_pos(&self, row: usize, run: &Run) -> Pos2 {
        let y = self.top(row) + (self.row_height - run.galley.size().y) / 2.0;
        pos2(self.in_window(run.x), y)
    }

    pub(super) fn top(&self, row: usize) -> f32 {
        (f64::from(self.origin.y) + row as f64 * f64::from(self.row_height)) as f32
    }

    pub(super) fn caret_rect(&self, buffer: &Buffer) -> Rect {
        self.rect_of(buffer, buffer.selection().head)
    }

    /// Returns the rectangle of a caret at a position.
    pub(super) fn rect_of(&self, buffer: &Buffer, at: usize) -> Rect {
        let at = buffer.snap(at);
        let row = self.folding.of(buffer, self.index, at);
        Rect::from_min_size(pos2(self.x(buffer, row, at), self.top(row)), vec2(1.0, self.row_height))
    }

    /// Returns the left and right edge of the laid out part of a range in a row; `None` if none of it is laid out.
    pub(super) fn span(&self, buffer: &Buffer, row: usize, range: &Range<usize>) -> Option<(f32, f32)> {
        let laid_out = self.row(row)?.bytes()?;
        if range.end < laid_out.start || range.start > laid_out.end {
            return None;
        }
        let x = |at: usize| self.x(buffer, row, buffer.snap(at.clamp(laid_out.start, laid_out.end)));
        Some((x(range.start), x(range.end)))
    }

    /// Returns the position in the text nearest to a point.
    pub(super) fn position_at(&self, buffer: &Buffer, point: Pos2) -> usize {
        let row = ((f64::from(point.y) - f64::from(self.origin.y)) / f64::from(self.row_height)).floor();
        if row < 0.0 {
            return 0;
        }
        if row as usize >= self.folding.len(buffer) {
            return buffer.text().len();
        }
        let part = self.folding.part(buffer, self.index, row as usize);
        let x = f64::from(point.x) - f64::from(self.origin.x) - f64::from(MARGIN);
        let runs = self.row(row as usize).map_or(&[][..], |row| &row.runs);
        let is_first = |run: &Run| run.bytes.start == part.bytes.start;
        let is_last = |run: &Run| run.bytes.end == part.bytes.end;
        let found = runs.iter().enumerate().find(|(i, run)| {
            let right = match runs.get(i + 1) {
                Some(next) => next.x,
                None if is_last(run) => f64::INFINITY,
                None => run.x + f64::from(run.galley.size().x),
            };
            (x >= run.x || is_first(run)) && x < right
        });
        if let Some((_, run)) = found {
            let column: usize = run.galley.cursor_from_pos(vec2((x - run.x) as f32, 0.0)).index.into();
            let text = &buffer.text()[run.bytes.clone()];
            // The position after the last letter of a wrapped row belongs to the next row.
            let last = if part.is_last || !is_last(run) { usize::MAX } else { text.chars().count().saturating_sub(1) };
            let column = column.min(last);
            return text.char_indices().nth(column).map_or(run.bytes.end, |(i, _)| run.bytes.start + i);
        }
        if !(part.is_first && part.is_last) {
            return part.bytes.start;
        }
        let (mut from, mut left) = (part.bytes.start, 0.0);
        for piece in self.index.pieces(part.line) {
            let width = f64::from(piece.columns * self.glyph);
            if x < left + width {
                let column = ((x - left) / f64::from(self.glyph)).round().max(0.0) as usize;
                let text = &buffer.text()[from..from + piece.len];
                return from + text.char_indices().nth(column).map_or(text.len(), |(i, _)| i);
            }
            (from, left) = (from + piece.len, left + width);
        }
        part.bytes.end
    }
}

/// Returns those of an ordered list of ranges that touch a range.
pub(super) fn touching<'r>(list: &'r [Range<usize>], range: &Range<usize>) -> &'r [Range<usize>] {
    let first = list.partition_point(|r| r.end < range.start);
    let count = list[first..].partition_point(|r| r.start <= range.end);
    &list[first..first + count]
}

#[cfg(test)]
mod tests;
