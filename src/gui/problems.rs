//! The line under the editor that says how the last compile went, and the list of what is wrong.

use super::{
    outbox::{Outbox, Wish},
    theme,
};
use crate::{
    diag::Severity,
    session::{Outcome, Place, Session, TabDiagnostic},
};
use egui::{Align2, FontId, Rect, ScrollArea, Sense, Stroke, Ui, pos2, vec2};

const ROW: f32 = 22.0;
/// A further place stands so far to the right of its problem.
const INDENT: f32 = 14.0;

/// `limit`: how high the list may be.
pub fn show(ui: &mut Ui, session: &Session, limit: f32, out: &mut Outbox) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 24.0), Sense::hover());
    ui.painter().hline(rect.x_range(), rect.top() + 0.5, Stroke::new(1.0, theme::LINE));
    let (text, color) = state(session);
    let dot = pos2(rect.left() + 13.0, rect.center().y);
    ui.painter().circle_filled(dot, 4.0, color);
    let painter = ui.painter().with_clip_rect(rect);
    painter.text(
        pos2(rect.left() + 25.0, rect.center().y),
        Align2::LEFT_CENTER,
        text,
        FontId::proportional(12.0),
        theme::TEXT,
    );
    let includes: Vec<&str> = session.project().includes.iter().map(|i| i.source.name.as_str()).collect();
    if !includes.is_empty() {
        let shown = format!("with {}", crate::project::listed(&includes));
        let font = FontId::proportional(12.0);
        let end =
            painter.text(pos2(rect.right() - 8.0, rect.center().y), Align2::RIGHT_CENTER, shown, font, theme::WEAK);
        out.place("includes", end);
    }
    out.place("compile-state", rect);
    let rows: Vec<Row<'_>> = session.diagnostics().iter().enumerate().flat_map(|(i, d)| rows_of(i, d)).collect();
    if rows.is_empty() {
        return;
    }
    ScrollArea::vertical().id_salt("problem list").max_height(limit).auto_shrink([false, true]).show_rows(
        ui,
        ROW,
        rows.len(),
        |ui, seen| {
            ui.spacing_mut().item_spacing.y = 0.0;
            rows[seen].iter().for_each(|row| row.show(ui, out));
        },
    );
    ui.add_space(4.0);
}

pub fn state(session: &Session) -> (String, egui::Color32) {
    let state = session.compile_state();
    if state.compiling {
        return ("Compiling…".into(), theme::ACCENT);
    }
    let some = |n: usize, noun: &str| format!("{n} {noun}{}", if n == 1 { "" } else { "s" });
    let (errors, warnings) = counts(session);
    match &state.last {
        None => ("Nothing compiled yet".into(), theme::WEAK),
        Some(Outcome::Ok { millis, .. }) if warnings == 0 => (format!("Compiled in {millis:.0} ms"), theme::GOOD),
        Some(Outcome::Ok { millis, .. }) => {
            (format!("Compiled in {millis:.0} ms, {}", some(warnings, "warning")), theme::WARNING)
        }
        Some(Outcome::Failed { .. }) if warnings > 0 => {
            (format!("{}, {}", some(errors, "error"), some(warnings, "warning")), theme::ERROR)
        }
        Some(Outcome::Failed { .. }) => (some(errors, "error"), theme::ERROR),
    }
}

/// A line of the list: a problem, or below it a further place that it speaks of.
struct Row<'a> {
    name: String,
    problem: &'a TabDiagnostic,
    place: Option<&'a Place>,
    message: &'a str,
    is_label: bool,
}

fn rows_of(index: usize, problem: &TabDiagnostic) -> impl Iterator<Item = Row<'_>> {
    let place = problem.place.as_ref();
    let own = Row { name: format!("problem:{index}"), problem, place, message: &problem.message, is_label: false };
    let labels = problem.labels.iter().enumerate().map(move |(n, label)| {
        let place = Some(&label.place);
        Row { name: format!("problem:{index}:{n}"), problem, place, message: &label.message, is_label: true }
    });
    std::iter::once(own).chain(labels)
}

impl Row<'_> {
    fn show(&self, ui: &mut Ui, out: &mut Outbox) {
        let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
        if response.hovered() {
            ui.painter().rect_filled(rect, 0.0, theme::RAISED);
        }
        let color = match self.problem.severity {
            Severity::Error => theme::ERROR,
            Severity::Warning => theme::WARNING,
            Severity::Note => theme::ACCENT,
        };
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        let mut x = rect.left() + 25.0;
        if self.is_label {
            x += INDENT;
        } else {
            painter.circle_filled(pos2(rect.left() + 13.0, rect.center().y), 3.0, color);
        }
        if let Some(place) = self.place {
            let at = format!("{} {}:{}", place.title(), place.line, place.column);
            let font = FontId::proportional(12.0);
            let end = painter.text(pos2(x, rect.center().y), Align2::LEFT_CENTER, at, font, theme::WEAK);
            x = end.right() + 10.0;
        }
        let color_of_text = if self.is_label { theme::WEAK } else { theme::TEXT };
        let text = self.message.replace('\n', " ");
        let mut job = egui::text::LayoutJob::simple_singleline(text, FontId::proportional(12.5), color_of_text);
        job.wrap = egui::text::TextWrapping::truncate_at_width((rect.right() - x - 8.0).max(20.0));
        let galley = painter.layout_job(job);
        let text_rect = Rect::from_min_size(pos2(x, rect.center().y - galley.size().y / 2.0), galley.size());
        painter.galley(text_rect.min, galley, color_of_text);
        if out.clicked(&self.name, &response)
            && let Some(wish) = self.place.and_then(wish_of)
        {
            out.wishes.push(wish);
        }
        response.on_hover_cursor(egui::CursorIcon::PointingHand).on_hover_ui(|ui| {
            ui.colored_label(color, &self.problem.message);
            for hint in &self.problem.hints {
                ui.label(hint);
            }
        });
    }
}

/// Returns the way to a place; `None` for one that is in no tab.
fn wish_of(place: &Place) -> Option<Wish> {
    Some(Wish::GoTo(place.tab.clone()?, Some((place.line - 1, place.column - 1))))
}

/// Returns the numbers of errors and of warnings.
fn counts(session: &Session) -> (usize, usize) {
    let count = |s: Severity| session.diagnostics().iter().filter(|d| d.severity == s).count();
    (count(Severity::Error), count(Severity::Warning))
}
