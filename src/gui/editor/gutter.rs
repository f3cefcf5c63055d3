//! The strip left of the text: line numbers, a dot where there is a mark, a sign where a block can be folded.

use super::{
    buffer::Buffer,
    highlight::Highlight,
    look::{Debug, Look},
    nesting::Bracket,
    rows::Rows,
};
use crate::gui::theme::{self, Palette};
use egui::{Align2, Color32, FontId, Id, Pos2, Rect, Sense, Shape, Stroke, Ui, pos2, vec2};

/// Says how wide it is beside its digits.
pub(super) const BESIDE: f32 = 34.0;

pub(super) struct Gutter<'a> {
    pub rect: Rect,
    /// Says where the first row is, which may be out of sight.
    pub top: f32,
    pub row_height: f32,
    pub index: &'a Highlight,
    pub rows: &'a Rows,
}

/// A click, with the line from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Clicked {
    /// The sign that folds its block.
    Fold(usize),
    /// Its number, or what is left of it.
    Line(usize),
}

impl Gutter<'_> {
    /// Shows it. A click in it comes back.
    pub fn show(&self, ui: &Ui, id: Id, buffer: &Buffer, look: &Look<'_>) -> Option<Clicked> {
        let Gutter { rect, top, row_height, .. } = *self;
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        let p = theme::of(ui);
        painter.rect_filled(rect, 0.0, p.background);
        let end = top + self.rows.len(buffer) as f32 * row_height;
        painter.rect_filled(rect.with_max_y(end.clamp(rect.top(), rect.bottom())), 0.0, p.code.row);
        let first = ((rect.top() - top) / row_height).max(0.0) as usize;
        let last = (((rect.bottom() - top) / row_height).ceil().max(0.0) as usize).min(self.rows.len(buffer));
        let caret_line = buffer.line_of(buffer.selection().head);
        let font = FontId::monospace((look.font_size - 1.0).max(7.0));
        // Folding has keys of its own.
        let response = ui.interact(rect, id.with("gutter"), Sense::CLICK);
        let pointer = response.hover_pos();
        let mut clicked = None;
        for row in first..last {
            let (line, number) = self.rows.line_at(buffer, row);
            if number > 0 {
                continue;
            }
            let middle = (f64::from(top) + (row as f64 + 0.5) * f64::from(row_height)) as f32;
            let worst = look.marks.iter().filter(|m| m.line == line).map(|m| m.severity).max();
            let tint = match worst {
                Some(severity) => theme::of(ui).of_severity(severity),
                None if line == caret_line => theme::of(ui).text,
                None => theme::of(ui).code.numbers,
            };
            painter.text(pos2(rect.right() - 18.0, middle), Align2::RIGHT_CENTER, line + 1, font.clone(), tint);
            if worst.is_some() {
                painter.circle_filled(pos2(rect.left() + 8.0, middle), 3.5, tint);
            }
            let line_area = Rect::from_center_size(pos2(rect.center().x, middle), vec2(rect.width(), row_height));
            let is_over = pointer.is_some_and(|p| line_area.contains(p));
            debugged(&painter, pos2(rect.left() + 8.0, middle), line, look.debug, is_over, p);
            if response.clicked() && is_over {
                clicked = Some(Clicked::Line(line));
            }
            let is_folded = self.rows.is_folded(line);
            let opens = self.index.nesting(line).of(Bracket::Curly).opened() > 0;
            if is_folded || (opens && pointer.is_some()) {
                let center = pos2(rect.right() - 9.0, middle);
                let area = Rect::from_center_size(center, vec2(16.0, row_height));
                let is_over = pointer.is_some_and(|p| area.contains(p));
                arrow(&painter, area, is_folded, if is_over { theme::of(ui).strong } else { theme::of(ui).weak });
                if response.clicked() && is_over {
                    clicked = Some(Clicked::Fold(line));
                }
            }
        }
        if p.background != Color32::TRANSPARENT {
            painter.vline(rect.right() - 1.0, rect.y_range(), Stroke::new(1.0, p.raised));
        }
        clicked
    }
}

/// A breakpoint, and where one is.
fn debugged(painter: &egui::Painter, at: Pos2, line: usize, debug: &Debug, is_over: bool, p: &Palette) {
    match debug.breakpoints.iter().find(|(of, ..)| *of == line) {
        Some((_, is_on, is_conditional)) => {
            let color = if *is_on { p.error } else { p.weak };
            painter.circle_filled(at, 5.0, color);
            if *is_conditional {
                let stroke = Stroke::new(1.5, p.background.to_opaque());
                painter.line_segment([at - vec2(2.5, 1.5), at + vec2(2.5, -1.5)], stroke);
                painter.line_segment([at - vec2(2.5, -1.5), at + vec2(2.5, 1.5)], stroke);
            }
        }
        None if is_over => drop(painter.circle_filled(at, 4.0, p.error.gamma_multiply(0.3))),
        None => {}
    }
    if debug.line == Some(line) {
        let points = [vec2(-4.0, -5.0), vec2(5.0, 0.0), vec2(-4.0, 5.0)].map(|v| at + v);
        painter.add(Shape::convex_polygon(points.to_vec(), p.warning, Stroke::new(1.0, p.background)));
    }
}

/// To the right where something is folded away, else down.
fn arrow(painter: &egui::Painter, area: Rect, is_folded: bool, color: Color32) {
    let c = area.center();
    let points = match is_folded {
        true => [vec2(-1.5, -3.5), vec2(2.0, 0.0), vec2(-1.5, 3.5)],
        false => [vec2(-3.5, -1.5), vec2(0.0, 2.0), vec2(3.5, -1.5)],
    };
    painter.add(Shape::line(points.iter().map(|v| c + *v).collect(), Stroke::new(1.5, color)));
}
