//! Devices that see, hear or listen to the network: the button that turns one on, and the light that shows that it is on.

use super::{
    accessible, theme,
    ui_output::{ShellCommand, UiOutput},
};
use crate::{
    control::osc::OscState,
    project::InputKind,
    session::{CameraState, Command, Session},
};
use egui::{Button, RichText, Ui, vec2};

/// The width that [`light`] takes at most.
const WIDTH: f32 = 112.0;

/// Shows the light of a camera that is on, which turns it off; where a channel reads one that is off, a button to use it.
pub fn light(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let kind = InputKind::Webcam;
    let state = session.device_state(kind);
    if state == CameraState::Off && !session.reads_device(kind) {
        return;
    }
    let p = theme::of(ui);
    let (text, tip) = match state {
        CameraState::Off => {
            (RichText::new("Use the camera"), "A channel reads the webcam; it is black until you turn the camera on")
        }
        CameraState::Starting => (RichText::new("● Camera…").color(p.warning), "The camera starts; click to stop it"),
        CameraState::On => (RichText::new("● Camera on").color(p.error), "Click to turn the camera off"),
    };
    let button = ui.add(Button::new(text.size(12.0)).min_size(vec2(WIDTH.min(ui.available_width()), 24.0)));
    let name = if state == CameraState::Off { "Use the camera" } else { "Turn the camera off" };
    accessible::name(&button, egui::Role::Button, name);
    let place = match state {
        CameraState::Off => "button:camera",
        CameraState::Starting => "light:camera-starting",
        CameraState::On => "light:camera",
    };
    if out.clicked(place, &button.on_hover_text(tip)) {
        out.ask(Command::UseDevice { kind, on: state == CameraState::Off });
    }
}

/// The same in the popup of a channel that reads the webcam, with a choice among several cameras.
pub fn choose(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let kind = InputKind::Webcam;
    let is_off = session.device_state(kind) == CameraState::Off;
    ui.horizontal_wrapped(|ui| {
        let name = if is_off { "Use the camera" } else { "Turn the camera off" };
        if out.clicked("choose:camera", &ui.button(name)) {
            out.ask(Command::UseDevice { kind, on: is_off });
        }
        let (cameras, now) = session.cameras();
        for camera in cameras.iter().filter(|_| cameras.len() > 1) {
            let is_on = now.is_some_and(|source| source.to_string() == camera.id);
            let item = ui.selectable_label(is_on, &camera.name).on_hover_text(&camera.id);
            if out.clicked(&format!("choose:camera:{}", camera.id), &item) && !is_on {
                out.ask(Command::ChooseCamera(camera.id.clone()));
            }
        }
    });
}

/// Shows that OSC comes in from the network, and not from this computer alone; a click turns it off.
pub fn network_light(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let view = session.controls_view();
    let Some(OscState::Listening(at)) = view.osc.filter(|_| view.is_osc_public) else { return };
    let text = RichText::new("● OSC open").color(theme::of(ui).error).size(12.0);
    let button = ui.add(Button::new(text).min_size(vec2(WIDTH.min(ui.available_width()), 24.0)));
    accessible::name(&button, egui::Role::Button, "Turn OSC off");
    let tip = format!("OSC is heard from the network at {at}; click to turn it off");
    if out.clicked("light:osc", &button.on_hover_text(tip)) {
        out.shell_commands.push(ShellCommand::StopOsc);
    }
}
