//! The gutter left of the text: line numbers, signs of marks and fold arrows.

use super::{
    buffer::Buffer,
    highlight::Highlight,
    line_cost,
    look::{Debug, Look},
    nesting::Bracket,
    rows::Rows,
};
use crate::{
    diag::Severity,
    gui::theme::{self, Palette},
};
use egui::{Align2, Color32, FontId, Id, Pos2, Rect, Sense, Shape, Stroke, Ui, pos2, vec2};

/// The width of the gutter without its digits.
pub(super) const BESIDE: f32 = 34.0;

pub(super) struct Gutter<'a> {
    pub rect: Rect,
    /// The position of the first row, which may be out of view.
    pub top: f32,
    pub row_height: f32,
    pub index: &'a Highlight,
    pub rows: &'a Rows,
}

/// A click in the gutter, with the line from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Clicked {
    /// The arrow that folds the block.
    Fold(usize),
    /// The line number, or the space left of it.
    Line(usize),
}

impl Gutter<'_> {
    /// Shows the gutter, and returns a click in it.
    pub(super) fn show(&self, ui: &Ui, id: Id, buffer: &Buffer, look: &Look<'_>) -> Option<Clicked> {
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
        // Folding has its own keys.
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
            let line_area = Rect::from_center_size(pos2(rect.center().x, middle), vec2(rect.width(), row_height));
            let is_over = pointer.is_some_and(|p| line_area.contains(p));
            let column = line_cost::column(look.costs);
            line_cost::paint(&painter, ui, look.costs, line, pos2(rect.left(), middle), row_height);
            let sign = pos2(rect.left() + column + 8.0, middle);
            debugged(&painter, sign, line, look.debug, is_over && worst.is_none(), p);
            if let Some(severity) = worst {
                let is_on_breakpoint = look.debug.breakpoints.iter().any(|(of, ..)| *of == line);
                marked(&painter, sign, severity, if is_on_breakpoint { p.background.to_opaque() } else { tint });
            }
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

/// Paints the sign of a problem: a cross for an error, a triangle for a warning, a bar for a note. Breakpoints are
/// round.
fn marked(painter: &egui::Painter, at: Pos2, severity: Severity, color: Color32) {
    let stroke = Stroke::new(2.0, color);
    match severity {
        Severity::Error => {
            painter.line_segment([at - vec2(3.0, 3.0), at + vec2(3.0, 3.0)], stroke);
            painter.line_segment([at + vec2(-3.0, 3.0), at + vec2(3.0, -3.0)], stroke);
        }
        Severity::Warning => {
            let points = [vec2(0.0, -3.5), vec2(4.0, 3.0), vec2(-4.0, 3.0)].map(|v| at + v);
            painter.add(Shape::convex_polygon(points.to_vec(), color, Stroke::NONE));
        }
        Severity::Note => drop(painter.line_segment([at - vec2(0.0, 3.5), at + vec2(0.0, 3.5)], stroke)),
    }
}

/// Paints a breakpoint and the line about to run.
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

/// Paints the fold arrow: to the right if the block is folded, else down.
fn arrow(painter: &egui::Painter, area: Rect, is_folded: bool, color: Color32) {
    let c = area.center();
    let points = match is_folded {
        true => [vec2(-1.5, -3.5), vec2(2.0, 0.0), vec2(-1.5, 3.5)],
        false => [vec2(-3.5, -1.5), vec2(0.0, 2.0), vec2(3.5, -1.5)],
    };
    painter.add(Shape::line(points.iter().map(|v| c + *v).collect(), Stroke::new(1.5, color)));
}

#[cfg(test)]
mod tests {
    use super::super::{
        CodeEditor,
        look::{Mark, NO_DEBUG},
    };
    use super::*;
    use egui::{Context, RawInput};

    /// Counts the round signs and the others in the gutter.
    fn signs(marks: &[Mark], debug: &Debug) -> (usize, usize) {
        let ctx = Context::default();
        let mut editor = CodeEditor::new("a\nb\nc\nd\n");
        let look = Look {
            name: "Code",
            font_size: 13.0,
            wraps: false,
            marks,
            matches: &[],
            shared: "",
            help: None,
            debug,
            costs: &[],
        };
        let screen = Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(400.0, 200.0)));
        let mut output = Default::default();
        for _ in 0..2 {
            let input = RawInput { screen_rect: screen, ..RawInput::default() };
            output = ctx.run_ui(input, |ui| {
                editor.show(ui, Id::unique("editor"), look, &|_| None);
            });
            output.textures_delta.clear();
        }
        let at = |p: Pos2| p.x < 20.0;
        let (mut round, mut other) = (0, 0);
        for clipped in &output.shapes {
            match &clipped.shape {
                Shape::Circle(circle) if at(circle.center) => round += 1,
                Shape::LineSegment { points, .. } if at(points[0]) => other += 1,
                Shape::Path(path) if path.points.first().is_some_and(|p| at(*p)) => other += 1,
                _ => {}
            }
        }
        (round, other)
    }

    #[test]
    fn problem_signs_differ_from_breakpoints() {
        let mark = |severity| Mark {
            line: 1,
            range: 2..3,
            severity,
            message: "wrong".into(),
            hints: Vec::new(),
            has_fix: false,
        };
        for severity in [Severity::Error, Severity::Warning, Severity::Note] {
            let (round, other) = signs(&[mark(severity)], &NO_DEBUG);
            assert!(round == 0 && other > 0, "{severity:?}: {round} round, {other} others");
        }
        let debug = Debug { breakpoints: vec![(1, true, false)], ..NO_DEBUG };
        assert_eq!(signs(&[], &debug), (1, 0));
        // Both signs of one line are visible.
        let (round, other) = signs(&[mark(Severity::Error)], &debug);
        assert!(round == 1 && other > 0);
    }
}
