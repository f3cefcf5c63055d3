//! A colour: a field that opens the picker, its numbers from 0 to 1, and its hex code.

use super::{
    cells, hex,
    parts::{child, split_right},
    picker,
};
use crate::{
    gui::{accessible, theme, ui_output::UiOutput},
    project::CustomUniform,
};
use egui::{Color32, Popup, PopupCloseBehavior, Rect, Role, Sense, Stroke, StrokeKind, TextEdit, Ui, vec2};

const SWATCH: f32 = 34.0;
const HEX: f32 = 70.0;
/// The minimum width for three numbers; if there is less, they are only in the picker.
const CELLS: f32 = 150.0;

/// Shows it; returns true for a double click on the colour field.
pub(super) fn show(ui: &mut Ui, custom_uniform: &CustomUniform, all: &mut [f64], out: &mut UiOutput) -> bool {
    let whole = ui.max_rect();
    let place = Rect::from_min_size(whole.left_top() + vec2(0.0, 2.0), vec2(SWATCH, whole.height() - 4.0));
    let response = ui.interact(place, ui.scope_id().with("colour"), Sense::click());
    accessible::name(&response, Role::ColorWell, format!("{}, colour", custom_uniform.name));
    out.place(format!("uniform:{}", custom_uniform.name), place);
    let is_double = response.double_clicked();
    let stroke = if response.hovered() || response.has_focus() { theme::of(ui).accent } else { theme::of(ui).line };
    ui.painter().rect(place, 4.0, shown(all), Stroke::new(1.0, stroke), StrokeKind::Inside);
    let response = response.on_hover_text("Open colour picker");
    let opened = Popup::menu(&response).close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
        picker::show(ui, all);
        ui.add_space(4.0);
        let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 24.0), Sense::hover());
        cells::show(&mut child(ui, rect), custom_uniform, all, &mut UiOutput::default());
        ui.add_space(2.0);
        let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 24.0), Sense::hover());
        field(ui, rect, custom_uniform, all);
    });
    if let Some(opened) = opened {
        out.place(format!("picker:{}", custom_uniform.name), opened.response.rect);
    }
    let rest = whole.with_min_x(place.right() + 6.0);
    let (hex, cells) = split_right(rest, HEX);
    if cells.width() >= CELLS {
        cells::show(&mut child(ui, cells), custom_uniform, all, out);
    }
    if hex.width() >= HEX - 1.0 {
        field(ui, hex, custom_uniform, all);
        out.place(format!("uniform:hex:{}", custom_uniform.name), hex);
    }
    is_double
}

/// Returns the colour as a screen shows it.
fn shown(all: &[f64]) -> Color32 {
    let [r, g, b] = [all[0], all[1], all[2]].map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8);
    Color32::from_rgb(r, g, b)
}

/// Shows the hex code, which is applied as soon as it is valid.
fn field(ui: &mut Ui, place: Rect, custom_uniform: &CustomUniform, all: &mut [f64]) {
    let id = ui.scope_id().with(("hex", &custom_uniform.name));
    let now = hex::written([all[0], all[1], all[2]]);
    let typed: Option<String> = ui.data(|d| d.get_temp(id));
    let mut text = typed.unwrap_or_else(|| now.clone());
    let color = if hex::read(&text).is_some() { theme::of(ui).text } else { theme::of(ui).error };
    let field = TextEdit::singleline(&mut text).id(id.with("field")).font(egui::FontId::monospace(12.0));
    let place = Rect::from_center_size(place.center(), vec2(place.width(), 21.0));
    let field = field.text_color(color).desired_width(place.width()).margin(egui::Margin::symmetric(5, 2));
    let field = field.align(egui::Align2::LEFT_CENTER);
    let response = ui.name_inputs(format!("{}, hex", custom_uniform.name), |ui| ui.put(place, field));
    let response = response.on_hover_text("#rrggbb or #rgb");
    if response.changed()
        && let Some(rgb) = hex::read(&text).filter(|rgb| hex::written(*rgb) != now)
    {
        all[..3].copy_from_slice(&rgb);
    }
    // Typed text is kept until the field loses the focus.
    match response.has_focus() {
        true => drop(ui.data_mut(|d| d.insert_temp(id, text))),
        false => ui.data_mut(|d| d.remove::<String>(id)),
    }
}
