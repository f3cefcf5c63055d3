//! The author's own uniforms: sliders, numbers, colours, switches, between the editor and the channels.

use super::{
    icons::{self, Icon},
    outbox::Outbox,
    theme,
};
use crate::{
    project::{Knob, KnobType, KnobValue},
    session::{Command, Session},
};
use egui::{Button, DragValue, Id, Response, RichText, ScrollArea, Slider, Ui};

const HEADER: f32 = 26.0;
const ROW: f32 = 27.0;

fn open_id() -> Id {
    Id::unique("knobs open")
}

fn is_open(ui: &Ui) -> bool {
    ui.data(|d| d.get_temp(open_id()).unwrap_or(true))
}

/// Height of the panel; `None` for a project without any.
pub fn height(ui: &Ui, session: &Session, window: f32) -> Option<f32> {
    let rows = session.knobs().len() as f32;
    let whole = if is_open(ui) { HEADER + ROW * rows + 6.0 } else { HEADER };
    (rows > 0.0).then(|| whole.min((window * 0.3).max(HEADER + 2.0 * ROW)))
}

pub fn show(ui: &mut Ui, session: &Session, out: &mut Outbox) {
    let knobs = session.knobs();
    let open = is_open(ui);
    ui.spacing_mut().item_spacing.y = 3.0;
    ui.allocate_ui(egui::vec2(ui.available_width(), HEADER - 3.0), |ui| {
        ui.horizontal_centered(|ui| {
            let title = format!("    Uniforms ({})", knobs.len());
            let header = ui.add(Button::new(RichText::new(title).color(theme::WEAK)).frame(false));
            arrow(ui, header.rect.left_center() + egui::vec2(6.0, 0.0), open);
            if out.clicked("knobs:header", &header.on_hover_text("What #iUniform lines declare")) {
                ui.data_mut(|d| d.insert_temp(open_id(), !open));
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let turned = knobs.iter().any(|k| session.knob_value(k) != k.default);
                let reset = ui.add_enabled(turned, Button::new("Reset all").small());
                if out.clicked("knobs:reset", &reset.on_hover_text("Every uniform to its default")) {
                    out.ask(Command::ResetKnobs);
                }
            });
        });
    });
    if !open {
        return;
    }
    ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
        for knob in knobs {
            ui.push_id(&knob.name, |ui| row(ui, session, knob, out));
        }
    });
}

/// A triangle that points down where the list is open; fonts differ in whether they have one.
fn arrow(ui: &Ui, at: egui::Pos2, open: bool) {
    let points = if open {
        [egui::vec2(-4.0, -2.5), egui::vec2(4.0, -2.5), egui::vec2(0.0, 3.0)]
    } else {
        [egui::vec2(-2.5, -4.0), egui::vec2(3.0, 0.0), egui::vec2(-2.5, 4.0)]
    };
    let points = points.map(|p| at + p).to_vec();
    ui.painter().add(egui::Shape::convex_polygon(points, theme::WEAK, egui::Stroke::NONE));
}

fn row(ui: &mut Ui, session: &Session, knob: &Knob, out: &mut Outbox) {
    let now = session.knob_value(knob);
    let width = ui.available_width();
    ui.allocate_ui(egui::vec2(width, ROW - 3.0), |ui| {
        ui.horizontal_centered(|ui| {
            let name_width = (width * 0.3).clamp(60.0, 160.0);
            let label = egui::Label::new(RichText::new(&knob.name).monospace().size(12.0)).truncate();
            ui.allocate_ui_with_layout(
                egui::vec2(name_width, ROW - 3.0),
                egui::Layout::left_to_right(egui::Align::Center),
                |ui| {
                    ui.set_min_width(name_width);
                    ui.add(label).on_hover_text(tip(knob));
                },
            );
            let mut all = now.components();
            let mut changed = false;
            let control = control(ui, knob, &mut all, &mut changed, width - name_width - 110.0);
            out.place(format!("knob:{}", knob.name), control.rect);
            let value = KnobValue::new(knob.ty, &all);
            if changed && value != now {
                out.ask(Command::SetKnob { name: knob.name.clone(), value: Some(value) });
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                ui.add_enabled_ui(now != knob.default, |ui| {
                    let reset = icons::button(ui, Icon::Reset, "Default");
                    let shown = format!("Back to {}", knob.default.glsl(knob.ty));
                    if out.clicked(&format!("knob:reset:{}", knob.name), &reset.on_hover_text(shown)) {
                        out.ask(Command::SetKnob { name: knob.name.clone(), value: None });
                    }
                });
            });
        });
    });
}

/// The widget that changes the value's numbers.
fn control(ui: &mut Ui, knob: &Knob, all: &mut [f64], changed: &mut bool, slider_width: f32) -> Response {
    let range = |i: usize| knob.range.map(|r| r.min[i]..=r.max[i]);
    let response = match knob.ty {
        KnobType::Bool => {
            let mut on = all[0] >= 0.5;
            let response = ui.checkbox(&mut on, "");
            all[0] = f64::from(u8::from(on));
            response
        }
        KnobType::Color3 => {
            let mut color = [all[0] as f32, all[1] as f32, all[2] as f32];
            let before = color;
            // Components as GLSL has them: what a screen shows, neither linear nor premultiplied.
            let mut shown = color.map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8);
            let response = ui.color_edit_button_srgb(&mut shown);
            if response.changed() {
                color = shown.map(|c| f32::from(c) / 255.0);
            }
            if color != before {
                // As short as eight bits allow, for the file it is saved in.
                all.iter_mut().zip(color).for_each(|(a, c)| *a = (f64::from(c) * 1e4).round() / 1e4);
            }
            response
        }
        KnobType::Int | KnobType::Float => {
            let whole = knob.ty == KnobType::Int;
            match range(0) {
                Some(range) => {
                    ui.spacing_mut().slider_width = slider_width.max(40.0);
                    let mut slider = Slider::new(&mut all[0], range);
                    if let Some(step) = knob.step.map(|s| s[0]).or(whole.then_some(1.0)) {
                        slider = slider.step_by(step);
                    }
                    if whole {
                        slider = slider.fixed_decimals(0);
                    }
                    ui.add(slider)
                }
                None => ui.add(number(&mut all[0], knob, 0)),
            }
        }
        KnobType::Vec2 | KnobType::Vec3 | KnobType::Vec4 => {
            ui.spacing_mut().item_spacing.x = 3.0;
            let mut joined: Option<Response> = None;
            for (i, x) in all.iter_mut().enumerate() {
                let mut field = number(x, knob, i);
                if let Some(range) = range(i) {
                    field = field.range(range);
                }
                let response = ui.add(field);
                joined = Some(joined.map_or(response.clone(), |j| j | response));
            }
            joined.expect("a vector has components")
        }
    };
    *changed |= response.changed();
    response
}

/// A number to drag or to type; it moves by the author's step, else by a hundredth of the range, else of its own size.
fn number<'a>(x: &'a mut f64, knob: &Knob, i: usize) -> DragValue<'a> {
    let span = knob.range.map(|r| (r.max[i] - r.min[i]) / 200.0);
    let speed = knob.step.map(|s| s[i]).or(span).unwrap_or_else(|| (x.abs() * 0.01).max(0.01));
    let field = DragValue::new(x).speed(speed);
    if knob.ty == KnobType::Int { field.speed(0.1).fixed_decimals(0) } else { field.max_decimals(4) }
}

fn tip(knob: &Knob) -> String {
    let mut text = format!("{} {}, at first {}", knob.ty.name(), knob.name, knob.default.glsl(knob.ty));
    if let Some(range) = knob.range {
        let n = knob.ty.components();
        let (min, max) = (KnobValue::new(knob.ty, &range.min[..n]), KnobValue::new(knob.ty, &range.max[..n]));
        text.push_str(&format!(", from {} to {}", min.glsl(knob.ty), max.glsl(knob.ty)));
    }
    text
}
