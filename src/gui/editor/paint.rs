//! Paints the editor: lines of code, the selection, marks, numbers.

use super::{
    buffer::Buffer,
    lines::{Lines, MARGIN, touching},
    look::{Look, Mark},
};
use crate::{diag::Severity, gui::theme};
use egui::{
    Align2, Color32, FontId, Pos2, Rect, Shape, Stroke, Ui, emath::GuiRounding as _, pos2, text::LayoutJob, vec2,
};
use std::ops::Range;

/// The caret's part in the picture.
#[derive(Clone, Copy)]
pub(super) struct Caret<'a> {
    pub has_focus: bool,
    /// It is in the lit half of its blinking.
    pub is_lit: bool,
    /// Places of the name it is on.
    pub uses: &'a [Range<usize>],
}

/// The places that painting found.
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

/// Paints the lines in sight and what lies behind and beside them.
pub(super) fn text(
    ui: &Ui,
    lines: &Lines<'_>,
    buffer: &Buffer,
    look: &Look<'_>,
    caret: Caret<'_>,
    shown: Rect,
) -> Painted {
    let painter = ui.painter();
    let Caret { has_focus, is_lit, uses } = caret;
    let caret = lines.caret_rect(buffer);
    let caret_line = buffer.line_of(buffer.selection().head);
    let hovered = ui.ctx().pointer_latest_pos().filter(|p| shown.contains(*p) && !ui.ctx().any_popup_open());
    let mut painted = Painted { caret, popup: None, marked: Vec::new() };
    for (i, laid_out) in lines.rows.iter().enumerate() {
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
        let in_sight = laid_out.bytes().unwrap_or(0..0);
        for used in touching(uses, &in_sight) {
            fill_range(ui, lines, buffer, line, used, Color32::from_rgb(52, 60, 74));
        }
        for found in touching(look.matches, &in_sight) {
            fill_range(ui, lines, buffer, line, found, Color32::from_rgb(94, 80, 36));
        }
        let selection = if has_focus { Color32::from_rgb(44, 84, 136) } else { Color32::from_rgb(50, 68, 96) };
        fill_range(ui, lines, buffer, line, &buffer.selection().range(), selection);
        for run in &laid_out.runs {
            painter.galley(lines.run_pos(line, run), run.galley.clone(), theme::TEXT);
        }
        for mark in &marks {
            underline(ui, lines, buffer, mark);
        }
        if let Some(worst) = worst {
            let end = lines.end(laid_out);
            let room = shown.right() - end - 40.0;
            let fits = room > 140.0;
            if fits {
                beside(ui, lines, pos2(end + 28.0, lines.top(line)), worst, marks.len(), room);
            }
            let under_pointer = hovered.is_some_and(|p| row.contains(p));
            if under_pointer || (!fits && has_focus && line == caret_line) {
                let start = buffer.line_range(line).start;
                let x = lines.x(buffer, line, start).max(shown.left() + MARGIN);
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
fn fill_range(ui: &Ui, lines: &Lines<'_>, buffer: &Buffer, line: usize, range: &Range<usize>, fill: Color32) {
    let of_line = buffer.line_range(line);
    if range.is_empty() || range.end < of_line.start || range.start > of_line.end {
        return;
    }
    let Some((left, mut right)) = lines.span(buffer, line, range) else { return };
    if range.end > of_line.end {
        // The line's end is taken too.
        right += lines.glyph;
    }
    let rect = Rect::from_min_max(pos2(left, lines.top(line)), pos2(right, lines.top(line) + lines.row_height));
    ui.painter().rect_filled(rect, 2.0, fill);
}

/// A wave under what a mark is about.
fn underline(ui: &Ui, lines: &Lines<'_>, buffer: &Buffer, mark: &Mark) {
    let of_line = buffer.line_range(mark.line);
    let start = mark.range.start.clamp(of_line.start, of_line.end);
    let end = mark.range.end.clamp(start, of_line.end);
    let Some((left, right)) = lines.span(buffer, mark.line, &(start..end)) else { return };
    let right = right.max(left + lines.glyph);
    let y = lines.top(mark.line) + lines.row_height - 2.0;
    let steps = ((right - left) / 2.0).ceil() as usize;
    let wave =
        (0..=steps).map(|i| pos2((left + i as f32 * 2.0).min(right), if i % 2 == 0 { y } else { y - 2.0 })).collect();
    ui.painter().add(Shape::line(wave, Stroke::new(1.0, color(mark.severity))));
}

/// The message right of the code, as much of it as fits.
fn beside(ui: &Ui, lines: &Lines<'_>, at: Pos2, mark: &Mark, count: usize, room: f32) {
    let more = if count > 1 { format!("  (+{})", count - 1) } else { String::new() };
    let text = format!("{}{more}", mark.message.replace('\n', " "));
    let size = (lines.font.size - 0.5).max(9.0);
    let mut job = LayoutJob::simple_singleline(text, FontId::proportional(size), color(mark.severity));
    job.wrap = egui::text::TextWrapping::truncate_at_width(room);
    let galley = ui.painter().layout_job(job);
    let y = at.y + (lines.row_height - galley.size().y) / 2.0;
    ui.painter().galley(pos2(at.x, y), galley, theme::TEXT);
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
        let middle = (f64::from(top) + (line as f64 + 0.5) * f64::from(row_height)) as f32;
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
