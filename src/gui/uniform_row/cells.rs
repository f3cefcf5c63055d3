//! Numbers in cells: each has its component's name at the left, the number at the right, and a fill that shows where
//! the number is in its range.

use super::parts::{HEIGHT, components};
use crate::{
    gui::{theme, ui_output::UiOutput},
    project::{CustomUniform, CustomUniformType},
};
use egui::{Align, Color32, DragValue, FontId, Layout, Rect, Stroke, StrokeKind, Ui, UiBuilder, pos2, vec2};

const GAP: f32 = 4.0;
/// The distance between the edge of a cell and its text.
const PADDING: f32 = 6.0;

/// Shows all components side by side, in equal parts of the available room.
pub(super) fn show(ui: &mut Ui, custom_uniform: &CustomUniform, all: &mut [f64], out: &mut UiOutput) {
    let whole = ui.max_rect();
    let names = components(custom_uniform.ty);
    let width = (whole.width() - GAP * (names.len() - 1) as f32) / names.len() as f32;
    for (i, component) in names.iter().enumerate() {
        let left = whole.left() + i as f32 * (width + GAP);
        let place = Rect::from_min_size(pos2(left, whole.center().y - 10.5), vec2(width, 21.0));
        fill(ui, place, custom_uniform, all[i], i);
        let name = format!("{}.{component}", custom_uniform.name);
        let number = number(ui, place, custom_uniform, all, i, &name);
        let label = ui.painter().layout_no_wrap((*component).into(), FontId::monospace(11.0), theme::of(ui).text);
        // In a narrow panel only the number has room.
        let at = place.left_center() + vec2(PADDING, -label.size().y / 2.0);
        if at.x + label.size().x <= number.left() + PADDING {
            ui.painter().galley(at, label, Color32::PLACEHOLDER);
        }
        out.place(format!("uniform:value:{}.{component}", custom_uniform.name), place);
    }
}

/// Fills the cell up to the number's place in its range.
fn fill(ui: &Ui, place: Rect, custom_uniform: &CustomUniform, x: f64, i: usize) {
    let radius = 4.0;
    ui.painter().rect_filled(place, radius, theme::of(ui).button);
    let part = custom_uniform.range.map(|r| ((x - r.min[i]) / (r.max[i] - r.min[i])).clamp(0.0, 1.0));
    if let Some(part) = part.filter(|p| *p > 0.0) {
        let filled = place.with_max_x(place.left() + place.width() * part as f32);
        ui.painter().with_clip_rect(filled.intersect(ui.clip_rect())).rect_filled(
            place,
            radius,
            theme::of(ui).accent_fill,
        );
    }
    ui.painter().rect_stroke(place, radius, Stroke::new(1.0, theme::of(ui).line), StrokeKind::Inside);
}

/// Shows a number to drag or type, at the right of its place, and returns its rectangle. Dragging moves it by the
/// author's step, else by a part of the range, else of its own magnitude.
pub(super) fn number(
    ui: &mut Ui,
    place: Rect,
    custom_uniform: &CustomUniform,
    all: &mut [f64],
    i: usize,
    name: &str,
) -> Rect {
    let span = custom_uniform.range.map(|r| (r.max[i] - r.min[i]) / 200.0);
    let step = custom_uniform.step.map(|s| s[i]).or(span).unwrap_or_else(|| (all[i].abs() * 0.01).max(0.01));
    let range = custom_uniform.range.map_or(f64::NEG_INFINITY..=f64::INFINITY, |r| r.min[i]..=r.max[i]);
    let mut field = DragValue::new(&mut all[i]).speed(step).range(range).clip_text(true);
    field = match custom_uniform.ty {
        CustomUniformType::Int => field.speed(0.1).fixed_decimals(0),
        _ => field.max_decimals(4).min_decimals(decimals(custom_uniform, i)),
    };
    let layout = Layout::right_to_left(Align::Center);
    let mut ui = ui.new_child(UiBuilder::new().max_rect(place).layout(layout).id_salt(("number", i)));
    let visuals = &mut ui.visuals_mut().widgets;
    visuals.inactive.weak_bg_fill = Color32::TRANSPARENT;
    visuals.inactive.bg_fill = Color32::TRANSPARENT;
    visuals.hovered.weak_bg_fill = Color32::from_white_alpha(16);
    ui.spacing_mut().button_padding = vec2(PADDING, 2.0);
    ui.spacing_mut().interact_size = vec2(10.0, HEIGHT - 6.0);
    let font = FontId::monospace(12.0);
    ui.style_mut().override_font_id = Some(font);
    let response = ui.name_inputs(name, |ui| {
        // A number being typed gets the whole cell, not the minimum width of a number.
        let id = ui.next_auto_id();
        if ui.memory(|m| m.has_focus(id)) {
            ui.spacing_mut().interact_size.x = place.width() - 2.0;
        }
        ui.add(field)
    });
    response.on_hover_text("Drag, or click to type").rect
}

/// Returns the number of decimals of the step, so that numbers keep their width during a drag.
fn decimals(custom_uniform: &CustomUniform, i: usize) -> usize {
    let step = custom_uniform.step.map(|s| s[i]).or(custom_uniform.range.map(|r| (r.max[i] - r.min[i]) / 200.0));
    step.filter(|s| *s > 0.0).map_or(2, |s| (-s.log10()).ceil().clamp(0.0, 3.0) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        diag::{SourceId, Span},
        project::CustomUniformValue,
    };
    use egui::{Context, RawInput, Shape};

    /// Returns the texts of cells of this width.
    fn written(width: f32) -> Vec<String> {
        let uniform = CustomUniform {
            name: "tint".into(),
            ty: CustomUniformType::Color3,
            default: CustomUniformValue::Vector(vec![1.0, 0.8, 0.6]),
            range: None,
            step: Some([0.001; 4]),
            about: String::new(),
            group: String::new(),
            span: Span::new(SourceId::NONE, 0..0),
            declared_in: Vec::new(),
            is_declared: false,
        };
        let mut output = Context::default().run_ui(RawInput::default(), |ui| {
            let place = Rect::from_min_size(pos2(10.0, 10.0), vec2(width, HEIGHT));
            let mut ui = ui.new_child(UiBuilder::new().max_rect(place));
            show(&mut ui, &uniform, &mut [1.0, 0.8, 0.6], &mut UiOutput::default());
        });
        output.textures_delta.clear();
        let texts = output.shapes.iter().filter_map(|shape| match &shape.shape {
            Shape::Text(text) => Some(text.galley.text().to_owned()),
            _ => None,
        });
        texts.collect()
    }

    #[test]
    fn narrow_cells_omit_names() {
        let mut wide = written(300.0);
        wide.sort();
        assert_eq!(wide, ["0.600", "0.800", "1.000", "b", "g", "r"]);
        let mut narrow = written(140.0);
        narrow.sort();
        assert_eq!(narrow, ["0.600", "0.800", "1.000"]);
    }
}
