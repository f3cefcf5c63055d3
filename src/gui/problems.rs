//! The line under the editor that says how the last compile went, and the list of what is wrong.

use super::{code, outbox::Outbox, theme};
use crate::{
    diag::Severity,
    session::{Outcome, Session, TabDiagnostic},
};
use egui::{Align2, FontId, Rect, ScrollArea, Sense, Stroke, Ui, pos2, vec2};

const ROW: f32 = 22.0;

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
    let list = session.diagnostics();
    if list.is_empty() {
        return;
    }
    ScrollArea::vertical().id_salt("problem list").max_height(limit).auto_shrink([false, true]).show_rows(
        ui,
        ROW,
        list.len(),
        |ui, rows| {
            ui.spacing_mut().item_spacing.y = 0.0;
            for i in rows {
                row(ui, i, &list[i], out);
            }
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
    let (errors, warnings) = code::counts(session);
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

fn row(ui: &mut Ui, index: usize, d: &TabDiagnostic, out: &mut Outbox) {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
    if response.hovered() {
        ui.painter().rect_filled(rect, 0.0, theme::RAISED);
    }
    let color = match d.severity {
        Severity::Error => theme::ERROR,
        Severity::Warning => theme::WARNING,
        Severity::Note => theme::ACCENT,
    };
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    painter.circle_filled(pos2(rect.left() + 13.0, rect.center().y), 3.0, color);
    let text = d.tab.as_ref().map(crate::project::Tab::title).or_else(|| d.file.clone());
    let place = match (text, d.line) {
        (None, _) => String::new(),
        (Some(text), 0) => text,
        (Some(text), line) => format!("{text} {line}:{}", d.column),
    };
    let mut x = rect.left() + 25.0;
    if !place.is_empty() {
        let end =
            painter.text(pos2(x, rect.center().y), Align2::LEFT_CENTER, place, FontId::proportional(12.0), theme::WEAK);
        x = end.right() + 10.0;
    }
    let mut job =
        egui::text::LayoutJob::simple_singleline(d.message.replace('\n', " "), FontId::proportional(12.5), theme::TEXT);
    job.wrap = egui::text::TextWrapping::truncate_at_width((rect.right() - x - 8.0).max(20.0));
    let galley = painter.layout_job(job);
    let place = Rect::from_min_size(pos2(x, rect.center().y - galley.size().y / 2.0), galley.size());
    painter.galley(place.min, galley, theme::TEXT);
    if out.clicked(&format!("problem:{index}"), &response)
        && let Some(wish) = code::wish_of(d)
    {
        out.wishes.push(wish);
    }
    response.on_hover_cursor(egui::CursorIcon::PointingHand).on_hover_ui(|ui| {
        ui.colored_label(color, &d.message);
        for hint in &d.hints {
            ui.label(hint);
        }
    });
}
