//! A map of the precision errors over the picture, and the worst pixels, each of which can be traced.

use super::{
    icons::{self, Icon},
    theme,
    ui_output::{ShellCommand, UiOutput},
};
use crate::session::{AuditMap, Command, Session, ToolCommand, WorstPixel};
use egui::{Area, Color32, Frame, Id, Margin, Order, Pos2, Rect, RichText, Ui, vec2};
use serde_json::{Value, json};

/// The error that is drawn fully transparent; an error of 1 is opaque.
const MIN_ERROR: f64 = 1e-8;
/// The smallest step that an 8-bit screen shows.
const VISIBLE: f64 = 1.0 / 255.0;

/// Paints the map over the picture of its pass.
pub(super) fn paint(ui: &Ui, session: &Session, picture: Rect) {
    let Some(map) = session.audit_map().filter(|map| map.pass == *session.shown_pass()) else { return };
    let painter = ui.painter().with_clip_rect(picture);
    let at = |[x, y]: [f32; 2]| -> Pos2 { picture.left_bottom() + vec2(x * picture.width(), -y * picture.height()) };
    for cell in &map.cells {
        let color = color(cell.error);
        if color != Color32::TRANSPARENT {
            painter.rect_filled(Rect::from_two_pos(at(cell.from), at(cell.to)), 0.0, color);
        }
    }
}

/// Lists the worst pixels over the picture's lower edge.
pub(super) fn show(ui: &Ui, session: &Session, area: Rect, out: &mut UiOutput) {
    let Some(map) = session.audit_map().filter(|map| map.pass == *session.shown_pass()) else { return };
    let legend = Area::new(Id::unique("audit"))
        .order(Order::Middle)
        .pivot(egui::Align2::LEFT_BOTTOM)
        .fixed_pos(area.left_bottom() + vec2(6.0, -6.0))
        .constrain_to(area);
    out.show_area("audit", legend, ui, |ui, out| {
        theme::put_over_picture(ui);
        let frame = Frame::NONE.fill(theme::of(ui).panel).corner_radius(6).inner_margin(Margin::symmetric(8, 5));
        frame.show(ui, |ui| {
            out.stop("audit", ui);
            ui.set_max_width((area.width() - 28.0).max(160.0));
            // Rows are packed tightly to cover little of the picture.
            let spacing = ui.spacing_mut();
            (spacing.item_spacing, spacing.button_padding) = (vec2(6.0, 2.0), vec2(4.0, 0.0));
            spacing.interact_size.y = 16.0;
            card(ui, map, out);
        });
    });
}

fn card(ui: &mut Ui, map: &AuditMap, out: &mut UiOutput) {
    let p = theme::of(ui);
    ui.horizontal(|ui| {
        ui.label(
            RichText::new(format!("Error against double precision ({} sampled pixels)", map.pixels))
                .color(p.strong)
                .size(12.5),
        );
        let close = icons::flat(ui, Icon::Close, "Hide the error map").on_hover_text("Hide the error map");
        out.on_click("audit:close", &close, Command::Tool(ToolCommand::HideAudit));
    });
    scale(ui, out);
    if map.worst.is_empty() {
        ui.colored_label(p.good, "No difference from double precision");
    }
    for (index, worst) in map.worst.iter().enumerate() {
        let WorstPixel { pixel: (x, y), error, device, double } = worst;
        let words = RichText::new(format!("{x},{y}   {error:.1e}")).monospace().size(12.0);
        let color = if *error > VISIBLE { p.warning } else { p.text };
        let list = |values: [f64; 4]| values.map(|x| format!("{x:.6}")).join(", ");
        let tip = format!(
            "GPU ({})\nDouble precision ({})\nClick to trace this pixel",
            list(device.map(f64::from)),
            list(*double)
        );
        let row = ui.selectable_label(false, words.color(color)).on_hover_text(tip);
        if out.clicked(&format!("audit:worst:{index}"), &row) {
            let part = |at: u32, of: u32| (at as f32 + 0.5) / of.max(1) as f32;
            out.shell_commands.push(ShellCommand::Trace([part(*x, map.size.0), part(*y, map.size.1)]));
        }
    }
}

/// Shows the legend of the colours.
fn scale(ui: &mut Ui, out: &mut UiOutput) {
    let p = theme::of(ui);
    let row = ui.horizontal(|ui| {
        ui.colored_label(p.weak, "1e-8");
        let (rect, _) = ui.allocate_exact_size(vec2(120.0, 9.0), egui::Sense::hover());
        const STEPS: u32 = 24;
        for step in 0..STEPS {
            let left = rect.left() + rect.width() * step as f32 / STEPS as f32;
            let part = Rect::from_min_size(Pos2::new(left, rect.top()), vec2(rect.width() / STEPS as f32, 9.0));
            let error = MIN_ERROR.powf(1.0 - f64::from(step + 1) / f64::from(STEPS));
            ui.painter().rect_filled(part, 0.0, color(error));
        }
        ui.colored_label(p.weak, "1");
    });
    out.place("audit:scale", row.response.rect);
}

/// Maps the error's logarithm from transparent over blue and red to yellow, so that the picture stays visible where it
/// is exact.
fn color(error: f64) -> Color32 {
    // A NaN on one side only counts as the largest error.
    let part = if error.is_finite() { (1.0 - error.max(MIN_ERROR).ln() / MIN_ERROR.ln()).clamp(0.0, 1.0) } else { 1.0 };
    if part <= 0.0 {
        return Color32::TRANSPARENT;
    }
    let stops = [[60.0, 90.0, 255.0], [255.0, 40.0, 90.0], [255.0, 235.0, 60.0]];
    let (from, weight) = if part < 0.5 { (0, part * 2.0) } else { (1, part * 2.0 - 1.0) };
    let mixed = |i: usize| (stops[from][i] + weight * (stops[from + 1][i] - stops[from][i])) as u8;
    Color32::from_rgba_unmultiplied(mixed(0), mixed(1), mixed(2), (60.0 + 150.0 * part) as u8)
}

/// Returns the report for scripts.
pub(super) fn report(session: &Session) -> Value {
    let Some(map) = session.audit_map() else { return Value::Null };
    let worst: Vec<Value> = map
        .worst
        .iter()
        .map(|worst| json!({ "pixel": [worst.pixel.0, worst.pixel.1], "error": worst.error }))
        .collect();
    json!({ "pass": map.pass.title(), "pixels": map.pixels, "cells": map.cells.len(), "worst": worst })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn larger_errors_are_more_visible() {
        assert_eq!(color(0.0), Color32::TRANSPARENT);
        assert_eq!(color(MIN_ERROR), Color32::TRANSPARENT);
        let seen = [1e-7, 1e-5, 1e-3, 1.0].map(|error| color(error).a());
        assert!(seen.is_sorted_by(|a, b| a < b), "{seen:?}");
        assert_eq!(color(f64::INFINITY), color(1.0));
    }
}
