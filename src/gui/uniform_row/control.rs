//! The MIDI or OSC control assigned to a uniform: its label in the row, and the menu that learns and removes it.

use super::parts::{child, components};
use crate::{
    gui::{accessible, actions::Action, menus, theme, ui_output::UiOutput},
    project::{ControlTarget, CustomUniform},
    session::{Command, ControlCommand, PickupSide, Session},
};
use egui::{Button, Key, Label, Rect, Response, RichText, Role, Sense, Ui};

/// The width of the label.
pub(super) const WIDTH: f32 = 84.0;

/// Returns what a control can move of a uniform: each component, with its name, or all of it.
fn targets(uniform: &CustomUniform) -> Vec<(ControlTarget, &'static str)> {
    let names = components(uniform.ty).iter();
    let target = |name: &&'static str| {
        let whole = || ControlTarget::whole(&uniform.name);
        (ControlTarget::of_component(&uniform.name, name).unwrap_or_else(whole), *name)
    };
    names.map(target).collect()
}

/// Returns the text of the label; `None` if no control is assigned and none is being learned.
pub(super) fn text(session: &Session, uniform: &CustomUniform) -> Option<String> {
    let names = targets(uniform).into_iter().filter_map(|(target, name)| {
        let control = match session.control_of(&target) {
            _ if session.is_learning(&target) => "Move a control…".to_owned(),
            control => match (control?.label(), session.control_waits(&target)) {
                (label, Some(PickupSide::Below)) => format!("turn up {label}"),
                (label, Some(PickupSide::Above)) => format!("turn down {label}"),
                (label, None) => label,
            },
        };
        Some(if name.is_empty() { control } else { format!("{name} {control}") })
    });
    let names: Vec<String> = names.collect();
    (!names.is_empty()).then(|| names.join(", "))
}

/// Shows the label. A click on it stops learning, as does Escape.
pub(super) fn label(
    ui: &mut Ui,
    session: &Session,
    uniform: &CustomUniform,
    text: &str,
    place: Rect,
    out: &mut UiOutput,
) {
    let p = theme::of(ui);
    let is_learning = targets(uniform).iter().any(|(target, _)| session.is_learning(target));
    let waits = targets(uniform).iter().any(|(target, _)| session.control_waits(target).is_some());
    let color = if is_learning || waits { p.warning } else { p.weak };
    let shown = RichText::new(text).size(11.0).color(color);
    let label = Label::new(shown).truncate().sense(if is_learning { Sense::CLICK } else { Sense::hover() });
    let response = child(ui, place).add(label);
    accessible::name(&response, Role::Label, format!("{}, {text}", uniform.name));
    out.place(format!("uniform:control:{}", uniform.name), place);
    let is_cancelled = is_learning && ui.input(|i| i.key_pressed(Key::Escape));
    let tip = match is_learning {
        true => "Move a knob, a fader or a key; Escape stops".to_owned(),
        false if waits => format!("{text}: the control takes over when it passes the slider's value"),
        false => text.to_owned(),
    };
    if response.on_hover_text(tip).clicked() || is_cancelled {
        out.ask(ControlCommand::LearnControl(None));
    }
}

/// Shows the row's menu while it is open.
pub(super) fn menu(row: &Response, session: &Session, uniform: &CustomUniform, out: &mut UiOutput) {
    menus::context_of_row(row, |ui| {
        let is_on = session.controls_view().is_on();
        for (target, name) in targets(uniform) {
            let of = if name.is_empty() { String::new() } else { format!(" of {name}") };
            let key = target.to_string();
            if session.is_learning(&target) {
                let stop = ui.button(format!("Stop learning the control{of}"));
                out.on_menu_click(
                    ui,
                    &format!("uniform-menu:stop:{key}"),
                    &stop,
                    Command::Control(ControlCommand::LearnControl(None)),
                );
            } else {
                let title = match name {
                    "" => "Learn MIDI or OSC control".to_owned(),
                    _ => format!("Learn MIDI or OSC control{of}"),
                };
                let learn = ui.add_enabled(is_on, Button::new(title));
                out.on_menu_click(
                    ui,
                    &format!("uniform-menu:learn:{key}"),
                    &learn,
                    Command::Control(ControlCommand::LearnControl(Some(target.clone()))),
                );
            }
            if let Some(control) = session.control_of(&target) {
                let forget = ui.button(format!("Forget control{of} ({})", control.label()));
                out.on_menu_click(
                    ui,
                    &format!("uniform-menu:forget:{key}"),
                    &forget,
                    Command::Control(ControlCommand::ForgetControl(target)),
                );
            }
        }
        if !is_on {
            ui.separator();
            let settings = ui.button("Switch on OSC or MIDI in Settings…");
            out.on_menu_click(ui, "uniform-menu:settings", &settings, Action::Settings);
        }
    });
}
