//! Values of one number: a rail filled up to its handle with the number at the right, or a switch.

use super::{cells, parts::split_right};
use crate::{
    gui::{accessible, theme, ui_output::UiOutput},
    project::{CustomUniform, CustomUniformType},
};
use egui::{Align2, FontId, PointerButton, Role, Sense, Slider, Ui, vec2};

/// The width of a number at the right end.
const NUMBER: f32 = 66.0;
/// The minimum width of a usable rail.
const MIN_RAIL: f32 = 40.0;

/// Shows the number; returns true for a double click on the rail.
pub(super) fn number(ui: &mut Ui, custom_uniform: &CustomUniform, all: &mut [f64], out: &mut UiOutput) -> bool {
    let is_whole = custom_uniform.ty == CustomUniformType::Int;
    let (value, rail) = split_right(ui.max_rect(), NUMBER);
    let rail = rail.shrink2(vec2(2.0, 0.0));
    let mut is_reset = false;
    let mut rect = ui.max_rect();
    if let Some(range) = custom_uniform.range.filter(|_| rail.width() >= MIN_RAIL) {
        let before = all[0];
        let mut slider = Slider::new(&mut all[0], range.min[0]..=range.max[0]).show_value(false).trailing_fill(true);
        if let Some(step) = custom_uniform.step.map(|s| s[0]).or(is_whole.then_some(1.0)) {
            slider = slider.step_by(step);
        }
        ui.spacing_mut().slider_width = rail.width();
        ui.visuals_mut().selection.bg_fill = theme::of(ui).accent_fill;
        let response = ui.name_inputs(&custom_uniform.name, |ui| ui.put(rail, slider));
        // Any button moves a slider; the right one also opens the menu of the row.
        let menu = PointerButton::Secondary;
        if ui.input(|i| i.pointer.button_down(menu) || i.pointer.button_released(menu)) {
            all[0] = before;
        }
        // In addition to dragging, which the slider handles.
        is_reset = ui.interact(rail, response.id.with("default"), Sense::CLICK).double_clicked();
        rect = rail;
    }
    out.place(format!("uniform:{}", custom_uniform.name), rect);
    let name = format!("{}, number", custom_uniform.name);
    cells::number(ui, value, custom_uniform, all, 0, &name);
    out.place(format!("uniform:value:{}", custom_uniform.name), value);
    is_reset
}

/// Shows the switch; returns true for a double click on its word.
pub(super) fn switch(ui: &mut Ui, custom_uniform: &CustomUniform, all: &mut [f64], out: &mut UiOutput) -> bool {
    let (word, place) = split_right(ui.max_rect(), NUMBER);
    let place = place.with_max_x((place.left() + 38.0).min(place.right()));
    let mut is_on = all[0] >= 0.5;
    let response = ui.interact(place.expand2(vec2(0.0, 2.0)), ui.scope_id().with("switch"), Sense::click());
    if response.clicked() {
        is_on = !is_on;
        all[0] = f64::from(u8::from(is_on));
    }
    accessible::choice(&response, Role::Switch, is_on, &custom_uniform.name);
    out.place(format!("uniform:{}", custom_uniform.name), place);
    let visuals = *ui.style().interact(&response);
    let part = ui.ctx().animate_bool_with_time(response.id, is_on, 0.08);
    let track = egui::Rect::from_center_size(place.left_center() + vec2(17.0, 0.0), vec2(30.0, 16.0));
    let fill = if is_on { theme::of(ui).accent_fill } else { visuals.bg_fill };
    ui.painter().rect(track, 8.0, fill, visuals.bg_stroke, egui::StrokeKind::Inside);
    let x = egui::lerp(track.left() + 8.0..=track.right() - 8.0, part);
    ui.painter().circle_filled(egui::pos2(x, track.center().y), 5.0, visuals.fg_stroke.color);
    let text = if is_on { "on" } else { "off" };
    let at = word.right_center() - vec2(6.0, 0.0);
    ui.painter().text(at, Align2::RIGHT_CENTER, text, FontId::proportional(12.0), theme::of(ui).weak);
    ui.interact(word, response.id.with("default"), Sense::CLICK).double_clicked()
}
