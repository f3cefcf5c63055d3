//! The ruler over the scroll bar, with the positions of errors, matches and carets in the whole text.

use super::{buffer::Buffer, look::Look, rows::Rows};
use crate::{diag::Severity, gui::theme};
use egui::{Color32, Rect, Ui, pos2};

const WIDTH: f32 = 9.0;
/// The height of a mark in points: a line of a long text is less than a point high.
const MARK: f32 = 3.0;

/// Looks for marks at each point of the ruler, not for each match: there may be many thousands of matches.
pub(super) fn show(ui: &Ui, text_rect: Rect, buffer: &Buffer, rows: &Rows, look: &Look<'_>, has_focus: bool) {
    let rect = Rect::from_min_max(pos2(text_rect.right() - WIDTH, text_rect.top()), text_rect.max);
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    // Short texts are not stretched over the whole ruler.
    let all = (rows.len(buffer) as f32).max(rect.height() / 20.0);
    let y = |line: usize| rect.top() + (rows.of_line(line) as f32 + 0.5) / all * rect.height();
    let mark = |line: usize, left: f32, right: f32, color: Color32| {
        let place = Rect::from_x_y_ranges(
            rect.left() + left..=rect.left() + right,
            y(line) - MARK / 2.0..=y(line) + MARK / 2.0,
        );
        painter.rect_filled(place, 1.0, color);
    };
    let mut from = 0;
    let count = rect.height().max(1.0) as usize;
    for i in 1..=count {
        let to = buffer.line_count() * i / count;
        if to > from && !look.matches.is_empty() {
            let bytes = buffer.line_range(from).start..buffer.line_range(to - 1).end;
            let first = look.matches.partition_point(|m| m.start < bytes.start);
            if let Some(found) = look.matches.get(first).filter(|m| m.start <= bytes.end) {
                mark(buffer.line_of(found.start), 3.0, WIDTH, theme::of(ui).found);
            }
        }
        from = to;
    }
    if has_focus {
        for s in buffer.carets().list() {
            mark(buffer.line_of(s.head), 0.0, WIDTH, theme::of(ui).weak);
        }
    }
    for severity in [Severity::Note, Severity::Warning, Severity::Error] {
        for m in look.marks.iter().filter(|m| m.severity == severity) {
            mark(m.line, 0.0, WIDTH, theme::of(ui).of_severity(severity));
        }
    }
}
