//! The legend next to the plot: the methods and the meaning of the signs.

use super::{colors::Ink, model::PlotData, plot};
use crate::{gui::theme, lab::report::Look};
use egui::{Color32, FontId, RichText, ScrollArea, Sense, Stroke, Ui, pos2, vec2};

/// The width of the legend.
pub(super) const WIDTH: f32 = 290.0;

/// Returns the method below the pointer.
pub(super) fn show(ui: &mut Ui, shown: &PlotData) -> Option<usize> {
    let mut hovered = None;
    ui.spacing_mut().item_spacing.y = 1.0;
    ScrollArea::vertical().id_salt("lab methods").auto_shrink(false).show(ui, |ui| {
        ui.set_width(WIDTH - 12.0);
        for n in 0..shown.methods.len() {
            if method(ui, shown, n) {
                hovered = Some(n);
            }
        }
        ui.label(
            RichText::new(format!("settings: {}", shown.table.study.parameter)).size(11.5).color(theme::of(ui).weak),
        );
        ui.add_space(5.0);
        key(ui, shown.table.study.is_contest);
    });
    hovered
}

/// Shows a line of text next to a sign, and returns a response whose rectangle has the place of the sign.
fn line(ui: &mut Ui, text: &str, size: f32, color: Color32) -> egui::Response {
    let width = ui.available_width();
    let mut job = egui::text::LayoutJob::simple_singleline(text.to_owned(), FontId::proportional(size), color);
    job.wrap = egui::text::TextWrapping::truncate_at_width(width - 26.0);
    let galley = ui.painter().layout_job(job);
    let (rect, response) = ui.allocate_exact_size(vec2(width, galley.size().y + 3.0), Sense::hover());
    ui.painter().galley(pos2(rect.left() + 24.0, rect.top() + 1.5), galley, color);
    response
}

fn method(ui: &mut Ui, shown: &PlotData, n: usize) -> bool {
    let method = shown.methods[n];
    let row = line(ui, method.title, 13.0, theme::of(ui).text);
    let color = Ink::of(ui).method(n);
    plot::sign(ui.painter(), pos2(row.rect.left() + 10.0, row.rect.center().y), n, 0.72, color, color);
    let settings: Vec<String> = shown.table.of(method).map(|r| r.point.setting.to_string()).collect();
    let without = shown.without_place(method).filter(|r| r.millis.is_some() || r.trouble.is_some()).count();
    let mut words = if settings.len() > 1 { settings.join(", ") } else { String::new() };
    if without > 0 {
        let comma = if words.is_empty() { "" } else { "; " };
        words += &format!("{comma}{without} of {} diverged", settings.len());
    }
    let mut is_hovered = row.hovered();
    if !words.is_empty() {
        is_hovered |= line(ui, &words, 11.0, theme::of(ui).weak).hovered();
    }
    is_hovered
}

fn key(ui: &mut Ui, is_contest: bool) {
    let ink = theme::of(ui).text;
    let looks = [
        (Some(Look::Full), "best at its cost (on the frontier)"),
        (Some(Look::Grey), "beaten: another is cheaper and more accurate"),
        (Some(Look::Hollow), "fails a hard case"),
        (None, "the frontier"),
    ];
    for (look, words) in looks.into_iter().filter(|(look, _)| is_contest || *look == Some(Look::Hollow)) {
        let row = line(ui, words, 11.5, theme::of(ui).weak).rect;
        let at = pos2(row.left() + 10.0, row.center().y);
        match look {
            Some(look) => plot::sign(ui.painter(), at, 0, 0.62, ink, Ink::of(ui).fill(look, ink)),
            None => {
                let ends = [at - vec2(8.0, 0.0), at + vec2(8.0, 0.0)];
                ui.painter().line_segment(ends, Stroke::new(5.0, Ink::of(ui).frontier()));
            }
        }
    }
    line(ui, "faint: the cost is still an estimate", 11.5, theme::of(ui).weak);
    ui.add_space(4.0);
    ui.label(
        RichText::new("Click a point to open its project. Drag to pan, scroll to zoom, double-click to see all.")
            .size(11.0)
            .color(theme::of(ui).weak),
    );
}
