//! What the editor looks like: lines of code, the selection, marks, numbers.

use super::{
    buffer::Buffer,
    highlight::Highlight,
    semantic::Semantic,
    view::{Look, Mark},
};
use crate::{diag::Severity, gui::theme};
use egui::{
    Align2, Color32, FontId, Galley, Pos2, Rect, Shape, Stroke, Ui,
    emath::GuiRounding as _,
    pos2,
    text::{CCursor, LayoutJob, TextFormat},
    vec2,
};
use std::{ops::Range, sync::Arc};

/// The lines in sight, laid out.
pub(super) struct Lines {
    pub origin: Pos2,
    pub row_height: f32,
    pub glyph: f32,
    pub font: FontId,
    pub first: usize,
    pub galleys: Vec<Arc<Galley>>,
}

/// Left of every line.
const MARGIN: f32 = 6.0;

/// The caret's part in the picture.
#[derive(Clone, Copy)]
pub(super) struct Caret<'a> {
    pub has_focus: bool,
    /// It is in the lit half of its blinking.
    pub is_lit: bool,
    /// Places of the name it is on.
    pub uses: &'a [Range<usize>],
}

/// What painting found out.
#[derive(Debug)]
pub(super) struct Painted {
    pub caret: Rect,
    pub popup: Option<Popup>,
    /// Lines with a mark that are in sight, and where they are.
    pub marked: Vec<(usize, Rect)>,
}

/// Messages to show over the text.
#[derive(Debug)]
pub(super) struct Popup {
    at: Pos2,
    /// It hangs from that point; else it stands on it.
    below: bool,
    marks: Vec<Mark>,
}

impl Default for Painted {
    fn default() -> Self {
        Self { caret: Rect::ZERO, popup: None, marked: Vec::new() }
    }
}

impl Lines {
    /// Lays lines out; egui keeps those it has seen in the last frame, so a still line costs its lexing.
    pub fn lay_out(
        &mut self,
        ui: &Ui,
        buffer: &Buffer,
        highlight: &Highlight,
        semantic: Option<&Semantic<'_>>,
        preedit: &str,
        range: Range<usize>,
    ) {
        let caret_line = buffer.line_of(buffer.selection().head);
        for line in range {
            let text = buffer.line(line);
            let mut job = LayoutJob::default();
            job.wrap.max_width = f32::INFINITY;
            job.break_on_newline = false;
            let mut at = 0;
            let composing = (line == caret_line && !preedit.is_empty())
                .then(|| buffer.selection().head - buffer.line_range(line).start);
            let known = semantic.and_then(|s| s.tokens(buffer.line_range(line), text));
            for token in known.unwrap_or_else(|| highlight.tokens(line, text)) {
                let piece = &text[at..at + token.len];
                let format = TextFormat::simple(self.font.clone(), theme::code_color(token.kind));
                match composing.filter(|c| (at..at + token.len).contains(c)) {
                    Some(c) => {
                        job.append(&piece[..c - at], 0.0, format.clone());
                        self.append_preedit(&mut job, preedit);
                        job.append(&piece[c - at..], 0.0, format);
                    }
                    None => job.append(piece, 0.0, format),
                }
                at += token.len;
            }
            if composing == Some(text.len()) {
                self.append_preedit(&mut job, preedit);
            }
            self.galleys.push(ui.painter().layout_job(job));
        }
    }

    fn append_preedit(&self, job: &mut LayoutJob, preedit: &str) {
        let underline = Stroke::new(1.0, theme::ACCENT);
        job.append(preedit, 0.0, TextFormat { underline, ..TextFormat::simple(self.font.clone(), theme::STRONG) });
    }

    /// Left end of a column of a line; lines out of sight are measured by the letter.
    fn x(&self, line: usize, column: usize) -> f32 {
        let x = match line.checked_sub(self.first).and_then(|i| self.galleys.get(i)) {
            Some(galley) => galley.pos_from_cursor(CCursor::new(column)).left(),
            None => column as f32 * self.glyph,
        };
        self.origin.x + MARGIN + x
    }

    fn top(&self, line: usize) -> f32 {
        self.origin.y + line as f32 * self.row_height
    }

    pub fn caret_rect(&self, buffer: &Buffer) -> Rect {
        self.rect_of(buffer, buffer.selection().head)
    }

    /// A caret at a position.
    pub fn rect_of(&self, buffer: &Buffer, at: usize) -> Rect {
        let (line, column) = buffer.line_column(buffer.snap(at));
        Rect::from_min_size(pos2(self.x(line, column), self.top(line)), vec2(1.0, self.row_height))
    }

    /// The position in the text nearest to a point.
    pub fn position_at(&self, buffer: &Buffer, point: Pos2) -> usize {
        let row = ((point.y - self.origin.y) / self.row_height).floor();
        if row < 0.0 {
            return 0;
        }
        let line = (row as usize).min(buffer.line_count() - 1);
        if row as usize > line {
            return buffer.text().len();
        }
        let x = point.x - self.origin.x - MARGIN;
        let column = match line.checked_sub(self.first).and_then(|i| self.galleys.get(i)) {
            Some(galley) => galley.cursor_from_pos(vec2(x, 0.0)).index.into(),
            None => (x / self.glyph).round().max(0.0) as usize,
        };
        buffer.position(line, column)
    }
}

/// Paints the lines in sight and what lies behind and beside them.
pub(super) fn text(ui: &Ui, lines: &Lines, buffer: &Buffer, look: &Look<'_>, caret: Caret<'_>, shown: Rect) -> Painted {
    let painter = ui.painter();
    let Caret { has_focus, is_lit, uses } = caret;
    let caret = lines.caret_rect(buffer);
    let caret_line = buffer.line_of(buffer.selection().head);
    let hovered = ui.ctx().pointer_latest_pos().filter(|p| shown.contains(*p) && !ui.ctx().any_popup_open());
    let mut painted = Painted { caret, popup: None, marked: Vec::new() };
    for (i, galley) in lines.galleys.iter().enumerate() {
        let line = lines.first + i;
        let row = Rect::from_min_size(pos2(shown.left(), lines.top(line)), vec2(shown.width(), lines.row_height));
        let marks: Vec<&Mark> = look.marks.iter().filter(|m| m.line == line).collect();
        let worst = marks.iter().max_by_key(|m| m.severity);
        if let Some(worst) = worst {
            painter.rect_filled(row, 0.0, color(worst.severity).gamma_multiply(0.13));
            painted.marked.push((line, row));
        } else if has_focus && line == caret_line {
            painter.rect_filled(row, 0.0, Color32::from_white_alpha(8));
        }
        for used in uses {
            fill_range(ui, lines, buffer, line, used, Color32::from_rgb(52, 60, 74));
        }
        for found in look.matches {
            fill_range(ui, lines, buffer, line, found, Color32::from_rgb(94, 80, 36));
        }
        let selection = if has_focus { Color32::from_rgb(44, 84, 136) } else { Color32::from_rgb(50, 68, 96) };
        fill_range(ui, lines, buffer, line, &buffer.selection().range(), selection);
        let y = lines.top(line) + (lines.row_height - galley.size().y) / 2.0;
        painter.galley(pos2(lines.origin.x + MARGIN, y), galley.clone(), theme::TEXT);
        for mark in &marks {
            underline(ui, lines, buffer, mark);
        }
        if let Some(worst) = worst {
            let room = shown.right() - (lines.origin.x + MARGIN + galley.size().x) - 40.0;
            let fits = room > 140.0;
            if fits {
                beside(ui, lines, line, galley.size().x, worst, marks.len(), room);
            }
            let under_pointer = hovered.is_some_and(|p| row.contains(p));
            if under_pointer || (!fits && has_focus && line == caret_line) {
                let x = lines.x(line, 0).max(shown.left() + MARGIN);
                let below = row.bottom() + 70.0 < shown.bottom();
                let y = if below { row.bottom() + 2.0 } else { row.top() - 2.0 };
                painted.popup = Some(Popup { at: pos2(x, y), below, marks: marks.into_iter().cloned().collect() });
            }
        }
    }
    if is_lit {
        let x = caret.left().round_to_pixels(ui.pixels_per_point());
        painter.rect_filled(
            Rect::from_min_size(pos2(x - 0.5, caret.top()), vec2(2.0, caret.height())),
            0.0,
            theme::STRONG,
        );
    }
    painted
}

fn color(severity: Severity) -> Color32 {
    match severity {
        Severity::Error => theme::ERROR,
        Severity::Warning => theme::WARNING,
        Severity::Note => theme::ACCENT,
    }
}

/// Fills the part of a range of the text that lies in a line.
fn fill_range(ui: &Ui, lines: &Lines, buffer: &Buffer, line: usize, range: &Range<usize>, fill: Color32) {
    let of_line = buffer.line_range(line);
    if range.is_empty() || range.end < of_line.start || range.start > of_line.end {
        return;
    }
    let column = |at: usize| buffer.text()[of_line.start..at].chars().count();
    let left = lines.x(line, column(buffer.snap(range.start.clamp(of_line.start, of_line.end))));
    let mut right = lines.x(line, column(buffer.snap(range.end.clamp(of_line.start, of_line.end))));
    if range.end > of_line.end {
        // The line's end is taken too.
        right += lines.glyph;
    }
    let rect = Rect::from_min_max(pos2(left, lines.top(line)), pos2(right, lines.top(line) + lines.row_height));
    ui.painter().rect_filled(rect, 2.0, fill);
}

/// A wave under what a mark is about.
fn underline(ui: &Ui, lines: &Lines, buffer: &Buffer, mark: &Mark) {
    let of_line = buffer.line_range(mark.line);
    let start = buffer.snap(mark.range.start.clamp(of_line.start, of_line.end));
    let end = buffer.snap(mark.range.end.clamp(start, of_line.end));
    let column = |at: usize| buffer.text()[of_line.start..at].chars().count();
    let left = lines.x(mark.line, column(start));
    let right = lines.x(mark.line, column(end)).max(left + lines.glyph);
    let y = lines.top(mark.line) + lines.row_height - 2.0;
    let steps = ((right - left) / 2.0).ceil() as usize;
    let wave =
        (0..=steps).map(|i| pos2((left + i as f32 * 2.0).min(right), if i % 2 == 0 { y } else { y - 2.0 })).collect();
    ui.painter().add(Shape::line(wave, Stroke::new(1.0, color(mark.severity))));
}

/// The message right of the code, as much of it as fits.
fn beside(ui: &Ui, lines: &Lines, line: usize, code_width: f32, mark: &Mark, count: usize, room: f32) {
    let more = if count > 1 { format!("  (+{})", count - 1) } else { String::new() };
    let text = format!("{}{more}", mark.message.replace('\n', " "));
    let size = (lines.font.size - 0.5).max(9.0);
    let mut job = LayoutJob::simple_singleline(text, FontId::proportional(size), color(mark.severity));
    job.wrap = egui::text::TextWrapping::truncate_at_width(room);
    let galley = ui.painter().layout_job(job);
    let y = lines.top(line) + (lines.row_height - galley.size().y) / 2.0;
    ui.painter().galley(pos2(lines.origin.x + MARGIN + code_width + 28.0, y), galley, theme::TEXT);
}

/// Line numbers, and a dot where there is a mark.
pub(super) fn gutter(ui: &Ui, rect: Rect, top: f32, row_height: f32, buffer: &Buffer, look: &Look<'_>) {
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    painter.rect_filled(rect, 0.0, theme::BACKGROUND);
    let first = ((rect.top() - top) / row_height).max(0.0) as usize;
    let last = (((rect.bottom() - top) / row_height).ceil().max(0.0) as usize).min(buffer.line_count());
    let caret_line = buffer.line_of(buffer.selection().head);
    let font = FontId::monospace((look.font_size - 1.0).max(7.0));
    for line in first..last {
        let middle = top + (line as f32 + 0.5) * row_height;
        let worst = look.marks.iter().filter(|m| m.line == line).map(|m| m.severity).max();
        let tint = match worst {
            Some(severity) => color(severity),
            None if line == caret_line => theme::TEXT,
            None => Color32::from_rgb(98, 106, 121),
        };
        painter.text(pos2(rect.right() - 10.0, middle), Align2::RIGHT_CENTER, line + 1, font.clone(), tint);
        if worst.is_some() {
            painter.circle_filled(pos2(rect.left() + 8.0, middle), 3.5, tint);
        }
    }
    painter.vline(rect.right() - 1.0, rect.y_range(), Stroke::new(1.0, theme::RAISED));
}

/// Whole messages over the text.
pub(super) fn popup(ui: &Ui, within: Rect, popup: &Popup) {
    let width = (within.width() - 40.0).clamp(120.0, 520.0);
    egui::Area::new(ui.scope_id().with("marks"))
        .order(egui::Order::Tooltip)
        .fixed_pos(popup.at)
        .pivot(if popup.below { Align2::LEFT_TOP } else { Align2::LEFT_BOTTOM })
        .constrain_to(within.expand(40.0))
        .interactable(false)
        .show(ui.ctx(), |ui| {
            egui::Frame::popup(ui.style()).show(ui, |ui| {
                ui.set_max_width(width);
                for mark in &popup.marks {
                    ui.colored_label(color(mark.severity), &mark.message);
                    for hint in &mark.hints {
                        ui.colored_label(theme::WEAK, hint);
                    }
                }
            });
        });
}
