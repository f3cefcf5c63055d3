//! Cameras, microphones and the network: the button that turns one on, and the light that shows that it is on.

use super::{
    accessible, theme,
    ui_output::{ShellCommand, UiOutput},
};
use crate::{
    control::osc::OscState,
    project::InputKind,
    session::{CameraCommand, CameraState, Command, Session},
};
use egui::{Button, Color32, FontId, Response, RichText, Ui, vec2};

/// The width of the light of the camera or the network, in points.
const WIDTH: f32 = 112.0;
/// The width of the shortest text of a light, and the gap after it.
pub(super) const LEAST: f32 = 32.0 + 4.0;

/// Adds a button of the width `wide` if there is enough room, otherwise a narrower one. It shows the first of `texts`
/// that fits, or the last with less padding.
pub(super) fn indicator(ui: &mut Ui, texts: &[&str], color: Color32, (wide, room): (f32, f32)) -> Response {
    let font = FontId::proportional(12.0);
    let padding = 2.0 * ui.spacing().button_padding.x;
    let width = |text: &str| ui.painter().layout_no_wrap(text.to_owned(), font.clone(), color).size().x + padding;
    let fits = texts.iter().find(|text| width(text) <= room);
    let text = fits.or(texts.last()).map_or("", |text| *text);
    let least = if wide <= room { wide } else { 0.0 };
    ui.scope(|ui| {
        if fits.is_none() {
            ui.spacing_mut().button_padding.x = 4.0;
        }
        ui.add(Button::new(RichText::new(text).font(font).color(color)).min_size(vec2(least, 24.0)))
    })
    .inner
}

/// Returns whether the camera is on, or a channel reads it.
fn is_used(session: &Session) -> bool {
    session.device_state(InputKind::Webcam) != CameraState::Off || session.reads_device(InputKind::Webcam)
}

/// Returns the minimum width of [`light`].
pub(super) fn least(session: &Session) -> f32 {
    if is_used(session) { LEAST } else { 0.0 }
}

/// Shows the light of a camera that is on, which turns it off; if a channel reads a camera that is off, a button that
/// turns it on.
pub(super) fn light(ui: &mut Ui, session: &Session, room: f32, out: &mut UiOutput) {
    if !is_used(session) {
        return;
    }
    let kind = InputKind::Webcam;
    let state = session.device_state(kind);
    let p = theme::of(ui);
    let (texts, color, tip): (&[&str], _, _) = match state {
        CameraState::Off => {
            let tip = "A channel reads the webcam; it is black until you turn the camera on";
            (&["Use camera", "Camera", "Cam"], p.text, tip)
        }
        CameraState::Starting => (&["● Camera…", "●"], p.warning, "The camera starts; click to stop it"),
        CameraState::On => (&["● Camera on", "● Camera", "●"], p.error, "Click to turn the camera off"),
    };
    let button = indicator(ui, texts, color, (WIDTH, room));
    let name = if state == CameraState::Off { "Use camera" } else { "Turn the camera off" };
    accessible::name(&button, egui::Role::Button, name);
    let place = match state {
        CameraState::Off => "button:camera",
        CameraState::Starting => "light:camera-starting",
        CameraState::On => "light:camera",
    };
    out.on_click(
        place,
        &button.on_hover_text(tip),
        Command::Camera(CameraCommand::UseDevice { kind, on: state == CameraState::Off }),
    );
}

/// The same in the popup of a channel that reads the webcam, with a choice between several cameras.
pub(super) fn choose(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let kind = InputKind::Webcam;
    let is_off = session.device_state(kind) == CameraState::Off;
    ui.horizontal_wrapped(|ui| {
        let name = if is_off { "Use camera" } else { "Turn the camera off" };
        out.on_click("choose:camera", &ui.button(name), Command::Camera(CameraCommand::UseDevice { kind, on: is_off }));
        let (cameras, now) = session.cameras();
        for camera in cameras.iter().filter(|_| cameras.len() > 1) {
            let is_on = now.is_some_and(|source| source.to_string() == camera.id);
            let item = ui.selectable_label(is_on, &camera.name).on_hover_text(&camera.id);
            if out.clicked(&format!("choose:camera:{}", camera.id), &item) && !is_on {
                out.ask(CameraCommand::ChooseCamera(camera.id.clone()));
            }
        }
    });
}

/// Returns the minimum width of [`network_light`].
pub(super) fn network_least(session: &Session) -> f32 {
    let view = session.controls_view();
    let is_shown = view.is_osc_public && matches!(view.osc, Some(OscState::Listening(_)));
    if is_shown { LEAST } else { 0.0 }
}

/// Shows that OSC is received from the network, and not only from this computer; a click turns it off.
pub(super) fn network_light(ui: &mut Ui, session: &Session, room: f32, out: &mut UiOutput) {
    let view = session.controls_view();
    let Some(OscState::Listening(at)) = view.osc.filter(|_| view.is_osc_public) else { return };
    let button = indicator(ui, &["● OSC open", "● OSC", "●"], theme::of(ui).error, (WIDTH, room));
    accessible::name(&button, egui::Role::Button, "Turn OSC off");
    let tip = format!("OSC is heard from the network at {at}; click to turn it off");
    out.on_click("light:osc", &button.on_hover_text(tip), ShellCommand::StopOsc);
}
