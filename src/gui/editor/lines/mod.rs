//! The lines in sight, laid out: between places of the text and points of the window.
//!
//! Only pieces that can be seen are laid out. Where they are is reckoned from a line's and a piece's number in 64 bits:
//! ten million letters are 80 million points wide, and a 32-bit number of that size has steps of eight.

use super::{buffer::Buffer, colors::code_color, highlight::Highlight, pieces, semantic::Semantic};
use crate::gui::theme;
use egui::{
    FontId, Galley, Pos2, Rect, Stroke, Ui, pos2,
    text::{CCursor, LayoutJob, TextFormat},
    vec2,
};
use std::{ops::Range, sync::Arc};

/// Left of every line.
pub(super) const MARGIN: f32 = 6.0;

pub(super) struct Lines<'a> {
    pub index: &'a Highlight,
    /// The top left corner of the text, which may be far out of the window.
    pub origin: Pos2,
    pub row_height: f32,
    /// Width of a digit.
    pub glyph: f32,
    pub font: FontId,
    pub first: usize,
    pub rows: Vec<Row>,
}

/// A line in sight.
#[derive(Debug, Default)]
pub(super) struct Row {
    /// The runs of it that are laid out, from left to right without a gap.
    pub runs: Vec<Run>,
    /// The width of the whole line, in points.
    pub width: f64,
}

/// A piece laid out.
#[derive(Debug)]
pub(super) struct Run {
    /// From where the line begins, in points.
    x: f64,
    /// Bytes of the text.
    bytes: Range<usize>,
    pub galley: Arc<Galley>,
}

impl Row {
    /// Bytes of the text that are laid out; `None` if nothing is.
    pub fn bytes(&self) -> Option<Range<usize>> {
        Some(self.runs.first()?.bytes.start..self.runs.last()?.bytes.end)
    }
}

impl Lines<'_> {
    /// Lays out what is in sight of some lines; egui keeps what it has seen in the last frame, so what stands still
    /// costs its lexing. `shown` is what can be seen of the window.
    pub fn lay_out(
        &mut self,
        ui: &Ui,
        buffer: &Buffer,
        semantic: Option<&Semantic<'_>>,
        preedit: &str,
        range: Range<usize>,
        shown: Rect,
    ) {
        let caret = buffer.selection().head;
        let caret_line = buffer.line_of(caret);
        let left = f64::from(shown.left()) - f64::from(self.origin.x + MARGIN);
        let right = left + f64::from(shown.width());
        for line in range {
            let of_line = buffer.line_range(line);
            let text = &buffer.text()[of_line.clone()];
            let composed = if line == caret_line { preedit } else { "" };
            let mut row = Row::default();
            let mut at = 0;
            for piece in self.index.pieces(line) {
                let bytes = at..at + piece.len;
                let mut width = f64::from(piece.columns * self.glyph);
                let is_last = bytes.end == text.len();
                let has_caret = bytes.contains(&caret.wrapping_sub(of_line.start)) || (is_last && caret == of_line.end);
                let composed = if has_caret { composed } else { "" };
                if !composed.is_empty() {
                    let glyph = |c| ui.fonts_mut(|f| f.glyph_width(&self.font, c));
                    width += f64::from(self.glyph * pieces::columns(composed, &mut |c| glyph(c) / self.glyph));
                }
                if row.width + width >= left && row.width <= right {
                    let of_text = of_line.start + at..of_line.start + bytes.end;
                    let known = semantic.and_then(|s| s.tokens(of_text.clone(), &text[bytes.clone()]));
                    let tokens = known.unwrap_or_else(|| self.index.tokens(text, bytes.clone(), piece.state));
                    let mut job = LayoutJob::default();
                    job.wrap.max_width = f32::INFINITY;
                    job.break_on_newline = false;
                    let composing = (!composed.is_empty()).then(|| caret - of_text.start);
                    let mut from = 0;
                    for token in tokens {
                        let part = &text[at + from..at + from + token.len];
                        let format = TextFormat::simple(self.font.clone(), code_color(token.kind));
                        match composing.filter(|c| (from..from + token.len).contains(c)) {
                            Some(c) => {
                                job.append(&part[..c - from], 0.0, format.clone());
                                self.append_preedit(&mut job, composed);
                                job.append(&part[c - from..], 0.0, format);
                            }
                            None => job.append(part, 0.0, format),
                        }
                        from += token.len;
                    }
                    if composing == Some(piece.len) {
                        self.append_preedit(&mut job, composed);
                    }
                    row.runs.push(Run { x: row.width, bytes: of_text, galley: ui.painter().layout_job(job) });
                }
                row.width += width;
                at = bytes.end;
            }
            if text.is_empty() {
                let mut job = LayoutJob::default();
                if !composed.is_empty() {
                    self.append_preedit(&mut job, composed);
                }
                row.runs.push(Run { x: 0.0, bytes: of_line, galley: ui.painter().layout_job(job) });
            } else if let [run] = &row.runs[..]
                && self.index.pieces(line).len() == 1
            {
                // What a line is in whole is known to the last point, whatever its letters join to.
                row.width = f64::from(run.galley.size().x);
            }
            self.rows.push(row);
        }
    }

    fn append_preedit(&self, job: &mut LayoutJob, preedit: &str) {
        let underline = Stroke::new(1.0, theme::ACCENT);
        job.append(preedit, 0.0, TextFormat { underline, ..TextFormat::simple(self.font.clone(), theme::STRONG) });
    }

    pub fn row(&self, line: usize) -> Option<&Row> {
        line.checked_sub(self.first).and_then(|i| self.rows.get(i))
    }

    /// A place right of where lines begin, in the window.
    fn in_window(&self, x: f64) -> f32 {
        (f64::from(self.origin.x) + f64::from(MARGIN) + x) as f32
    }

    /// Left end of the character at a byte of a line; what is out of sight is measured by the piece.
    pub fn x(&self, buffer: &Buffer, line: usize, at: usize) -> f32 {
        let runs = self.row(line).map_or(&[][..], |row| &row.runs);
        if let Some(run) = runs.iter().find(|r| (r.bytes.start..=r.bytes.end).contains(&at)) {
            let column = buffer.text()[run.bytes.start..at].chars().count();
            let in_galley = run.galley.pos_from_cursor(CCursor::new(column)).left();
            return self.in_window(run.x + f64::from(in_galley));
        }
        let start = buffer.line_range(line).start;
        let (mut from, mut x) = (start, 0.0);
        for piece in self.index.pieces(line) {
            if at < from + piece.len {
                break;
            }
            from += piece.len;
            x += f64::from(piece.columns * self.glyph);
        }
        let rest = pieces::columns(&buffer.text()[from.min(at)..at], &mut |_| 1.0);
        self.in_window(x + f64::from(rest * self.glyph))
    }

    /// Returns where a line ends.
    pub fn end(&self, row: &Row) -> f32 {
        self.in_window(row.width)
    }

    /// Returns where a run is painted in its line.
    pub fn run_pos(&self, line: usize, run: &Run) -> Pos2 {
        let y = self.top(line) + (self.row_height - run.galley.size().y) / 2.0;
        pos2(self.in_window(run.x), y)
    }

    pub fn top(&self, line: usize) -> f32 {
        (f64::from(self.origin.y) + line as f64 * f64::from(self.row_height)) as f32
    }

    pub fn caret_rect(&self, buffer: &Buffer) -> Rect {
        self.rect_of(buffer, buffer.selection().head)
    }

    /// A caret at a position.
    pub fn rect_of(&self, buffer: &Buffer, at: usize) -> Rect {
        let at = buffer.snap(at);
        let line = buffer.line_of(at);
        Rect::from_min_size(pos2(self.x(buffer, line, at), self.top(line)), vec2(1.0, self.row_height))
    }

    /// Left and right end of what is laid out of a part of a line; `None` where none of it is.
    pub fn span(&self, buffer: &Buffer, line: usize, range: &Range<usize>) -> Option<(f32, f32)> {
        let laid_out = self.row(line)?.bytes()?;
        if range.end < laid_out.start || range.start > laid_out.end {
            return None;
        }
        let x = |at: usize| self.x(buffer, line, buffer.snap(at.clamp(laid_out.start, laid_out.end)));
        Some((x(range.start), x(range.end)))
    }

    /// The position in the text nearest to a point.
    pub fn position_at(&self, buffer: &Buffer, point: Pos2) -> usize {
        let row = ((f64::from(point.y) - f64::from(self.origin.y)) / f64::from(self.row_height)).floor();
        if row < 0.0 {
            return 0;
        }
        let line = (row as usize).min(buffer.line_count() - 1);
        if row as usize > line {
            return buffer.text().len();
        }
        let of_line = buffer.line_range(line);
        let x = f64::from(point.x) - f64::from(self.origin.x) - f64::from(MARGIN);
        let runs = self.row(line).map_or(&[][..], |row| &row.runs);
        let is_first = |run: &Run| run.bytes.start == of_line.start;
        let is_last = |run: &Run| run.bytes.end == of_line.end;
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
            return text.char_indices().nth(column).map_or(run.bytes.end, |(i, _)| run.bytes.start + i);
        }
        let (mut from, mut left) = (of_line.start, 0.0);
        for piece in self.index.pieces(line) {
            let width = f64::from(piece.columns * self.glyph);
            if x < left + width {
                let column = ((x - left) / f64::from(self.glyph)).round().max(0.0) as usize;
                let text = &buffer.text()[from..from + piece.len];
                return from + text.char_indices().nth(column).map_or(text.len(), |(i, _)| i);
            }
            (from, left) = (from + piece.len, left + width);
        }
        of_line.end
    }
}

/// Those of a list of ranges in order that touch one.
pub(super) fn touching<'r>(list: &'r [Range<usize>], range: &Range<usize>) -> &'r [Range<usize>] {
    let first = list.partition_point(|r| r.end < range.start);
    let behind = list[first..].partition_point(|r| r.start <= range.end);
    &list[first..first + behind]
}

#[cfg(test)]
mod tests;
