//! Paints the editor: lines of code, the selection, marks, numbers.

use super::{
    buffer::Buffer,
    line_cost,
    lines::{Lines, MARGIN, touching},
    look::{Look, Mark},
    selection::Selection,
};
use crate::gui::{
    inline_code::{self, Inline},
    theme,
};
use egui::{Align2, Color32, FontId, Pos2, Rect, Shape, Stroke, StrokeKind, Ui, emath::GuiRounding as _, pos2, vec2};
use std::ops::Range;

/// The caret's state for painting.
#[derive(Clone, Copy)]
pub(super) struct Caret<'a> {
    pub has_focus: bool,
    /// The caret is in the visible phase of its blinking.
    pub is_lit: bool,
    /// The uses of the name at the caret.
    pub uses: &'a [Range<usize>],
    /// The bracket at the caret, and its partner.
    pub brackets: Option<[usize; 2]>,
}

/// Places found while painting.
#[derive(Debug)]
pub(super) struct Painted {
    pub caret: Rect,
    /// The whole painted area.
    pub whole: Rect,
    pub popup: Option<Popup>,
    /// Visible lines with a mark, and their places.
    pub marked: Vec<(usize, Rect)>,
}

/// Messages to show over the text.
#[derive(Debug)]
pub(super) struct Popup {
    at: Pos2,
    /// It is below its point; otherwise it is above it.
    below: bool,
    marks: Vec<Mark>,
}

impl Default for Painted {
    fn default() -> Self {
        Self { caret: Rect::ZERO, whole: Rect::ZERO, popup: None, marked: Vec::new() }
    }
}

/// Paints the visible lines and what is painted below and next to them.
pub(super) fn text(
    ui: &Ui,
    lines: &Lines<'_>,
    buffer: &Buffer,
    look: &Look<'_>,
    caret: Caret<'_>,
    shown: Rect,
) -> Painted {
    let painter = ui.painter();
    let Caret { has_focus, is_lit, uses, brackets } = caret;
    let caret = lines.caret_rect(buffer);
    let caret_line = buffer.line_of(buffer.selection().head);
    let hovered = ui.ctx().pointer_latest_pos().filter(|p| shown.contains(*p) && !ui.ctx().any_popup_open());
    let mut painted = Painted { caret, whole: shown, popup: None, marked: Vec::new() };
    for (i, laid_out) in lines.rows.iter().enumerate() {
        let row = lines.first + i;
        let part = &laid_out.part;
        let line = part.line;
        let area = Rect::from_min_size(pos2(shown.left(), lines.top(row)), vec2(shown.width(), lines.row_height));
        let box_of_row = theme::of(ui).code.row;
        if box_of_row != Color32::TRANSPARENT && !part.bytes.is_empty() {
            let right = lines.end(laid_out) + 5.0;
            painter.rect_filled(area.with_max_x(right.clamp(shown.left(), shown.right())), 0.0, box_of_row);
        }
        let marks: Vec<&Mark> = look.marks.iter().filter(|m| m.line == line).collect();
        let worst = marks.iter().max_by_key(|m| m.severity);
        if let Some(worst) = worst {
            painter.rect_filled(area, 0.0, theme::of(ui).of_severity(worst.severity).gamma_multiply(0.13));
            if part.is_first {
                painted.marked.push((line, area));
            }
        } else if has_focus && line == caret_line {
            painter.rect_filled(area, 0.0, theme::of(ui).code.caret_line);
        }
        if look.debug.line == Some(line) {
            painter.rect_filled(area, 0.0, theme::of(ui).warning.gamma_multiply(0.08));
            if let Some(range) = &look.debug.range {
                fill_range(ui, lines, buffer, row, range, theme::of(ui).warning.gamma_multiply(0.06));
            }
        }
        let in_sight = laid_out.bytes().unwrap_or(0..0);
        for used in touching(uses, &in_sight) {
            fill_range(ui, lines, buffer, row, used, theme::of(ui).code.uses);
        }
        for found in touching(look.matches, &in_sight) {
            fill_range(ui, lines, buffer, row, found, theme::of(ui).code.found);
        }
        let fills = &theme::of(ui).code;
        let selection = if has_focus { fills.selection } else { fills.selection_idle };
        for s in touching_selections(buffer.carets().list(), &part.bytes) {
            fill_range(ui, lines, buffer, row, &s.range(), selection);
        }
        for at in brackets.into_iter().flatten() {
            frame_letter(ui, lines, buffer, row, at);
        }
        let cost = line_cost::of(look.costs, line);
        for run in &laid_out.runs {
            let at = lines.run_pos(row, run);
            match cost.is_some_and(|cost| !cost.is_reached) {
                true => painter.galley_with_override_text_color(
                    at,
                    run.galley.clone(),
                    theme::of(ui).weak.gamma_multiply(0.6),
                ),
                false => painter.galley(at, run.galley.clone(), theme::of(ui).text),
            };
        }
        for mark in &marks {
            underline(ui, lines, buffer, row, mark);
        }
        let mut end = lines.end(laid_out);
        if part.is_last && lines.folding.is_folded(line) {
            end = folded(ui, pos2(end + 8.0, area.center().y), lines);
        }
        let iterations = cost.and_then(|cost| cost.iterations.as_ref()).filter(|_| part.is_last && worst.is_none());
        if let Some(words) = iterations {
            let size = (lines.font.size - 1.5).max(8.0);
            let at = pos2(end + 24.0, area.center().y);
            painter.text(at, Align2::LEFT_CENTER, words, FontId::proportional(size), theme::of(ui).accent);
        }
        if let Some(worst) = worst {
            let room = shown.right() - end - 40.0;
            if part.is_last && room > 60.0 {
                beside(ui, lines, pos2(end + 28.0, area.top()), worst, marks.len(), room);
            }
            if hovered.is_some_and(|p| area.contains(p)) {
                let x = lines.rect_of(buffer, part.bytes.start).left().max(shown.left() + MARGIN);
                // Above the caret, so that the text being written stays visible.
                let below = area.top() - 60.0 < shown.top();
                let y = if below { area.bottom() + 2.0 } else { area.top() - 2.0 };
                painted.popup = Some(Popup { at: pos2(x, y), below, marks: marks.into_iter().cloned().collect() });
            }
        }
    }
    if is_lit {
        let first = lines.rows.first().map_or(0, |row| row.part.bytes.start);
        let last = lines.rows.last().map_or(0, |row| row.part.bytes.end);
        for s in touching_selections(buffer.carets().list(), &(first..last)) {
            let caret = lines.rect_of(buffer, s.head);
            let x = caret.left().round_to_pixels(ui.pixels_per_point());
            let place = Rect::from_min_size(pos2(x - 0.5, caret.top()), vec2(2.0, caret.height()));
            painter.rect_filled(place, 0.0, theme::of(ui).strong);
        }
    }
    painted
}

/// Returns the selections that touch a range of bytes.
fn touching_selections<'s>(list: &'s [Selection], bytes: &Range<usize>) -> &'s [Selection] {
    let first = list.partition_point(|s| s.range().end < bytes.start);
    let count = list[first..].partition_point(|s| s.range().start <= bytes.end);
    &list[first..first + count]
}

/// Paints a sign for folded lines, and returns where it ends.
fn folded(ui: &Ui, left: Pos2, lines: &Lines<'_>) -> f32 {
    let rect = Rect::from_min_size(left - vec2(0.0, lines.row_height * 0.3), vec2(22.0, lines.row_height * 0.6));
    ui.painter().rect_filled(rect, 3.0, theme::of(ui).button);
    for x in [-5.0, 0.0, 5.0] {
        ui.painter().circle_filled(rect.center() + vec2(x, 0.0), 1.2, theme::of(ui).text);
    }
    rect.right()
}

/// Paints a frame round a letter, if it is in this row.
fn frame_letter(ui: &Ui, lines: &Lines<'_>, buffer: &Buffer, row: usize, at: usize) {
    if lines.row(row).is_none_or(|r| !r.part.bytes.contains(&at)) {
        return;
    }
    let Some((left, right)) = lines.span(buffer, row, &(at..at + 1)) else { return };
    let rect = Rect::from_min_max(pos2(left, lines.top(row)), pos2(right, lines.top(row) + lines.row_height));
    ui.painter().rect(rect, 2.0, theme::of(ui).code.bracket, Stroke::new(1.0, theme::of(ui).weak), StrokeKind::Inside);
}

/// Fills the part of a range of the text that is in a row.
fn fill_range(ui: &Ui, lines: &Lines<'_>, buffer: &Buffer, row: usize, range: &Range<usize>, fill: Color32) {
    let Some(part) = lines.row(row).map(|r| &r.part) else { return };
    if range.is_empty() || range.end < part.bytes.start || range.start > part.bytes.end {
        return;
    }
    let Some((left, mut right)) = lines.span(buffer, row, range) else { return };
    if range.end > part.bytes.end && part.is_last {
        // The line end is selected too.
        right += lines.glyph;
    }
    let rect = Rect::from_min_max(pos2(left, lines.top(row)), pos2(right, lines.top(row) + lines.row_height));
    ui.painter().rect_filled(rect, 2.0, fill);
}

/// Paints a wavy line under the range of a mark in a row.
fn underline(ui: &Ui, lines: &Lines<'_>, buffer: &Buffer, row: usize, mark: &Mark) {
    let Some(part) = lines.row(row).map(|r| &r.part) else { return };
    let is_elsewhere = mark.range.end < part.bytes.start || mark.range.start > part.bytes.end;
    if is_elsewhere && !(part.is_first && part.is_last) {
        return;
    }
    let start = mark.range.start.clamp(part.bytes.start, part.bytes.end);
    let end = mark.range.end.clamp(start, part.bytes.end);
    let Some((left, right)) = lines.span(buffer, row, &(start..end)) else { return };
    let right = right.max(left + lines.glyph);
    let y = lines.top(row) + lines.row_height - 2.0;
    let steps = ((right - left) / 2.0).ceil() as usize;
    let wave =
        (0..=steps).map(|i| pos2((left + i as f32 * 2.0).min(right), if i % 2 == 0 { y } else { y - 2.0 })).collect();
    ui.painter().add(Shape::line(wave, Stroke::new(1.0, theme::of(ui).of_severity(mark.severity))));
}

/// Paints the message right of the code, as much of it as fits.
fn beside(ui: &Ui, lines: &Lines<'_>, at: Pos2, mark: &Mark, count: usize, room: f32) {
    let more = if count > 1 { format!("  (+{})", count - 1) } else { String::new() };
    let text = format!("{}{more}", mark.message);
    let size = (lines.font.size - 0.5).max(9.0);
    let palette = theme::of(ui);
    let inline = Inline { size, color: palette.of_severity(mark.severity), palette };
    let galley = ui.painter().layout_job(inline.line(&text, room));
    let y = at.y + (lines.row_height - galley.size().y) / 2.0;
    ui.painter().galley(pos2(at.x, y), galley, theme::of(ui).text);
}

/// Shows whole messages over the text.
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
                    inline_code::label(ui, theme::of(ui).of_severity(mark.severity), &mark.message);
                    for hint in &mark.hints {
                        inline_code::label(ui, theme::of(ui).weak, hint);
                    }
                }
            });
        });
}
