//! The author's own uniforms: sliders, numbers, colours, switches.

use super::{outbox::Outbox, theme, uniform_row};
use crate::session::{Command, Session};
use egui::{Button, RichText, ScrollArea, Ui};

const ROW: f32 = uniform_row::HEIGHT;
/// Three lines of text.
const EMPTY: f32 = 62.0;

/// Height of all of them.
pub fn height(session: &Session) -> f32 {
    match session.custom_uniforms().len() {
        0 => EMPTY,
        n => ROW * n as f32 + 8.0,
    }
}

/// Shows at the right end of the panel's row what concerns them all.
pub fn tools(ui: &mut Ui, session: &Session, out: &mut Outbox) {
    let custom_uniforms = session.custom_uniforms();
    if custom_uniforms.iter().any(|k| session.custom_uniform_value(k) != k.default) {
        let reset = ui.add(Button::new("Reset all").small()).on_hover_text("Reset all uniforms to their defaults");
        if out.clicked("uniforms:reset", &reset) {
            out.ask(Command::ResetCustomUniforms);
        }
    }
}

pub fn show(ui: &mut Ui, session: &Session, out: &mut Outbox) {
    out.stop("uniforms", ui);
    let custom_uniforms = session.custom_uniforms();
    ui.spacing_mut().item_spacing.y = 3.0;
    ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
        if custom_uniforms.is_empty() {
            ui.colored_label(theme::of(ui).weak, "Add a line like this to get a slider:");
            let line = "#iUniform float speed = 1.0 in { 0.0, 4.0 }";
            ui.add(egui::Label::new(RichText::new(line).monospace()).selectable(true));
        }
        for custom_uniform in custom_uniforms {
            ui.push_id(&custom_uniform.name, |ui| uniform_row::show(ui, session, custom_uniform, out));
        }
    });
}
