//! The table of devices that a channel can read: what the window shows of each, next to its row of inputs.

use super::{Live, sound};
use crate::{
    gui::{actions::Action, devices, theme, ui_output::UiOutput},
    project::{Input, InputKind},
    session::{Command, Session, SoundCommand},
};
use egui::{Rect, TextureHandle, Ui};

/// The parts of the window for a device.
pub(super) struct DeviceRow {
    kind: InputKind,
    /// Shows its controls in the popup of a channel that reads it.
    pub controls: fn(&mut Ui, &Session, &mut UiOutput),
    pub thumbnail: DeviceThumbnail,
}

/// The picture of a device in a channel's card.
pub(super) enum DeviceThumbnail {
    /// As a glyph.
    None,
    /// As a texture with its aspect ratio, if there is one.
    Texture(fn(&mut Live, &Ui, &Session) -> Option<(TextureHandle, f32)>),
    /// Painted into a place. Returns false if there is nothing to paint.
    Painted(fn(&Ui, &Session, Rect) -> bool),
}

/// Devices without a row need no consent, no setting and no thumbnail.
const DEVICES: [DeviceRow; 3] = [
    DeviceRow {
        kind: InputKind::Webcam,
        controls: devices::choose,
        thumbnail: DeviceThumbnail::Texture(|live, ui, session| live.camera(ui, session)),
    },
    DeviceRow {
        kind: InputKind::Microphone,
        controls: microphone,
        thumbnail: DeviceThumbnail::Painted(|ui, session, place| {
            let Some(view) = session.microphone_view().filter(|view| view.is_on) else { return false };
            sound::show_level(ui, place, view.level);
            true
        }),
    },
    DeviceRow { kind: InputKind::Gamepad, controls: gamepads, thumbnail: DeviceThumbnail::None },
];

/// Returns the row of the device that an input reads.
pub(super) fn of(input: &Input) -> Option<&'static DeviceRow> {
    const { &DEVICES }.iter().find(|row| *input == Input::Device(row.kind))
}

/// Shows the switch of the microphone, which no project can turn on.
fn microphone(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let Some(view) = session.microphone_view() else { return };
    let (text, note) = match view.is_on {
        true => ("Turn the microphone off", "The microphone is on."),
        false => ("Use the microphone", "The microphone is off: the channel shows a made-up spectrum."),
    };
    ui.horizontal_wrapped(|ui| {
        out.on_click(
            "choose:use-microphone",
            &ui.button(text),
            Command::Sound(SoundCommand::UseMicrophone(!view.is_on)),
        );
        ui.colored_label(theme::of(ui).weak, note);
    });
}

/// Explains how to read gamepads, which the settings switch on.
fn gamepads(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let view = session.controls_view();
    let note = match view.gamepads {
        _ if !view.has_gamepads => "This build of Eddy reads no gamepads: the channel is zero.".to_owned(),
        None => "Gamepads are off: the channel is zero.".to_owned(),
        Some(pads) if pads.connected.is_empty() => "No gamepad is connected.".to_owned(),
        Some(pads) => pads.connected.into_values().collect::<Vec<_>>().join(", "),
    };
    ui.horizontal_wrapped(|ui| {
        if view.has_gamepads {
            out.on_click("choose:gamepad-settings", &ui.button("Settings…"), Action::Settings);
        }
        ui.colored_label(theme::of(ui).weak, note);
    });
}
