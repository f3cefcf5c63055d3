//! The layout of the row.

use super::{
    cells, color, control,
    parts::{HEIGHT, child, split_right},
    scalar,
};
use crate::{
    gui::{
        icons::{self, Icon},
        ui_output::UiOutput,
    },
    project::{CustomUniform, CustomUniformType, CustomUniformValue},
    session::{EditCommand, Session},
};
use egui::{Label, Rect, RichText, Sense, Ui, vec2};

/// The width at the right of every row for the reset button, shown if the value is not the default.
const RESET: f32 = 30.0;
/// The gap between the name and the widget.
const GAP: f32 = 8.0;

pub(crate) fn show(ui: &mut Ui, session: &Session, custom_uniform: &CustomUniform, out: &mut UiOutput) {
    let now = session.custom_uniform_value(custom_uniform);
    let (row, whole) = ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT - 3.0), Sense::hover());
    let name_width = (row.width() * 0.28).clamp(56.0, 150.0);
    let (name, rest) = row.split_left_right_at_x(row.left() + name_width);
    let (control, reset) = rest.split_left_right_at_x(rest.right() - RESET);
    let mut control = control.with_min_x(control.left() + GAP);
    // In a narrow panel only the menu shows it.
    if let Some(text) = control::text(session, custom_uniform).filter(|_| control.width() > 2.5 * control::WIDTH) {
        let (place, rest) = split_right(control, control::WIDTH);
        control::label(ui, session, custom_uniform, &text, place, out);
        control = rest;
    }

    let mut wants_default = title(ui, custom_uniform, name);
    let mut all = now.components();
    let mut ui_ = child(ui, control);
    let before = all.clone();
    wants_default |= match custom_uniform.ty {
        CustomUniformType::Bool => scalar::switch(&mut ui_, custom_uniform, &mut all, out),
        CustomUniformType::Int | CustomUniformType::Float => scalar::number(&mut ui_, custom_uniform, &mut all, out),
        CustomUniformType::Vec2 | CustomUniformType::Vec3 | CustomUniformType::Vec4 => {
            out.place(format!("uniform:{}", custom_uniform.name), control);
            cells::show(&mut ui_, custom_uniform, &mut all, out);
            false
        }
        CustomUniformType::Color3 => color::show(&mut ui_, custom_uniform, &mut all, out),
    };
    let value = CustomUniformValue::new(custom_uniform.ty, &all);
    if before != all && value != now {
        out.ask(EditCommand::SetCustomUniform { name: custom_uniform.name.clone(), value: Some(value) });
    }
    if now != custom_uniform.default {
        let place = Rect::from_center_size(reset.center() + vec2(3.0, 0.0), vec2(24.0, 22.0));
        let label = format!("Reset {}", custom_uniform.name);
        let button = icons::button(&mut child(ui, place), Icon::Reset, &label);
        let tip = format!(
            "Reset to {}\n(or double-click the name or the slider)",
            custom_uniform.default.glsl(custom_uniform.ty)
        );
        wants_default |= out.clicked(&format!("uniform:reset:{}", custom_uniform.name), &button.on_hover_text(tip));
    }
    if wants_default && now != custom_uniform.default {
        // After the changes of the clicks themselves.
        out.ask(EditCommand::SetCustomUniform { name: custom_uniform.name.clone(), value: None });
    }
    control::menu(&whole, session, custom_uniform, out);
}

/// Shows the name; returns true for a double click on it.
fn title(ui: &mut Ui, custom_uniform: &CustomUniform, place: Rect) -> bool {
    let text = RichText::new(&custom_uniform.name).monospace().size(12.0);
    let label = Label::new(text).truncate().sense(Sense::CLICK);
    child(ui, place).add(label).on_hover_text(tip(custom_uniform)).double_clicked()
}

/// Returns the author's description, then the line's declaration.
fn tip(custom_uniform: &CustomUniform) -> String {
    let mut text = if custom_uniform.about.is_empty() { String::new() } else { format!("{}\n", custom_uniform.about) };
    text += &format!(
        "{} {}, default {}",
        custom_uniform.ty.name(),
        custom_uniform.name,
        custom_uniform.default.glsl(custom_uniform.ty)
    );
    if let Some(range) = custom_uniform.range {
        let n = custom_uniform.ty.components();
        let (min, max) = (
            CustomUniformValue::new(custom_uniform.ty, &range.min[..n]),
            CustomUniformValue::new(custom_uniform.ty, &range.max[..n]),
        );
        text.push_str(&format!(", range {} to {}", min.glsl(custom_uniform.ty), max.glsl(custom_uniform.ty)));
    }
    text
}
