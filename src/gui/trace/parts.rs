//! Shared parts of the panel: titles, names with values, colours of vectors.

use super::moment::words;
use crate::{
    debugger::trace::Value,
    gui::{
        theme,
        ui_output::{Request, UiOutput},
    },
};
use egui::{Color32, Label, Rect, RichText, Sense, StrokeKind, Ui, vec2};

/// Shows a title over a part.
pub(super) fn title(ui: &mut Ui, text: &str) {
    ui.add_space(4.0);
    ui.label(RichText::new(text).size(11.5).color(theme::of(ui).weak));
}

/// Shows a name and its value in a line. `is_changed`: marked.
pub(super) fn value(ui: &mut Ui, name: &str, value: &Value, is_changed: bool) -> Rect {
    let p = theme::of(ui);
    let color = if is_changed { p.accent } else { p.text };
    let row = ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 6.0;
        ui.label(RichText::new(name).monospace().color(p.strong));
        swatch(ui, value);
        let text = RichText::new(words(value)).monospace().color(color);
        let label = ui.add(Label::new(text).truncate());
        label.on_hover_text(format!("{} {name}{}", value.type_text, if is_changed { ", changed" } else { "" }));
    });
    row.response.rect
}

/// Shows the colour of a vector, if it is one.
pub(super) fn swatch(ui: &mut Ui, value: &Value) {
    if !value.is_vector {
        return;
    }
    let part = |i: usize| value.numbers.get(i).map_or(0.0, |n| n.as_f64()).clamp(0.0, 1.0);
    let [r, g, b] = [part(0), part(1), part(2)].map(|x| (x * 255.0).round() as u8);
    let (rect, _) = ui.allocate_exact_size(vec2(12.0, 12.0), Sense::hover());
    ui.painter().rect(rect, 2.0, Color32::from_rgb(r, g, b), (1.0, theme::of(ui).line), StrokeKind::Inside);
}

/// Shows a small button with a text, which makes a request.
pub(super) fn button(
    ui: &mut Ui,
    place: &str,
    (text, tip): (&str, &str),
    request: impl Into<Request>,
    out: &mut UiOutput,
) {
    let response = ui.small_button(text).on_hover_text(tip);
    out.on_click(place, &response, request);
}
