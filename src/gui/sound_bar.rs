//! The sound controls in the bar below the picture: mute, volume, and the light of the microphone.

use super::{
    accessible,
    actions::Action,
    devices,
    icons::{self, Icon},
    settings::Change,
    theme,
    ui_output::{ShellCommand, UiOutput},
};
use crate::session::{DeviceState, MicrophoneView, OutputView, Session, SoundCommand};
use egui::{Id, Slider, Ui};

/// The width of the slider in points.
const SLIDER: f32 = 64.0;
/// The width of the mute button and the gap after it, in points.
const MUTE: f32 = icons::WIDTH + 4.0;
/// The width of the microphone's button in points.
const MICROPHONE: f32 = 116.0;

/// Shows the controls that the project needs. `room`: the maximum total width; the mute button is always shown.
pub(super) fn show(ui: &mut Ui, session: &Session, room: f32, out: &mut UiOutput) {
    let microphone = microphone(session);
    let left = microphone.as_ref().map_or(room, |_| room - MICROPHONE);
    let end = ui.cursor().min.x + room;
    if let Some(sound) = session.output_view().filter(|view| view.has_sound) {
        mute(ui, &sound, out);
        if left >= SLIDER + 40.0 {
            volume(ui, &sound, out);
        }
    }
    if let Some(view) = microphone {
        light(ui, &view, end - ui.cursor().min.x, out);
    }
}

/// Returns the minimum width of [`show`].
pub(super) fn least(session: &Session) -> f32 {
    let mute = session.output_view().filter(|view| view.has_sound).map_or(0.0, |_| MUTE);
    mute + microphone(session).map_or(0.0, |_| devices::LEAST)
}

/// Returns the microphone if the bar shows its light.
fn microphone(session: &Session) -> Option<MicrophoneView> {
    session.microphone_view().filter(|view| view.is_read || view.is_on)
}

fn mute(ui: &mut Ui, sound: &OutputView, out: &mut UiOutput) {
    let (icon, label) = match sound.is_muted {
        _ if sound.ended_before => (Icon::Muted, "Open the sound device again"),
        true => (Icon::Muted, "Unmute"),
        false => (Icon::Speaker, "Mute"),
    };
    let where_heard = match &sound.device {
        DeviceState::Open { name, .. } => format!(" ({name})"),
        DeviceState::Missing(why) => format!(" (no sound: {why})"),
        DeviceState::Closed => String::new(),
    };
    let button = icons::button(ui, icon, label);
    let tip = out.keys.tip(&format!("{label}{where_heard}"), Action::Mute);
    out.on_click("button:mute", &button.on_hover_text(tip), Action::Mute);
}

/// Shows the volume, which follows the pointer during a drag; the setting is written on release.
fn volume(ui: &mut Ui, sound: &OutputView, out: &mut UiOutput) {
    let mut percent = (sound.volume * 100.0).round();
    ui.spacing_mut().slider_width = SLIDER;
    let slider = Slider::new(&mut percent, 0.0..=100.0).step_by(1.0).show_value(false).trailing_fill(true);
    let slider = ui.add_enabled(!sound.is_muted, slider);
    accessible::name(&slider, egui::Role::Slider, "Volume");
    out.place("slider:volume", slider.rect);
    let dragged = Id::unique("volume that is dragged");
    if slider.changed() {
        out.ask(SoundCommand::SetVolume(percent / 100.0));
        ui.data_mut(|data| data.insert_temp(dragged, true));
    }
    let is_held = slider.dragged() || slider.is_pointer_button_down_on();
    if !is_held && ui.data_mut(|data| data.remove_temp::<bool>(dragged)).is_some() {
        out.shell_commands.push(ShellCommand::Set(Change::Volume(percent / 100.0)));
    }
    slider.on_hover_text(format!("Volume: {percent:.0} %"));
}

fn light(ui: &mut Ui, view: &MicrophoneView, room: f32, out: &mut UiOutput) {
    let p = theme::of(ui);
    let (texts, color, tip): (&[&str], _, _) = match (view.is_on, &view.device) {
        (false, _) => {
            let tip = "A channel reads the microphone; it shows a made-up spectrum until then";
            (&["Use microphone", "Microphone", "Mic"], p.text, tip)
        }
        (true, DeviceState::Missing(_)) => {
            (&["● No microphone", "● No mic", "●"], p.warning, "Click to stop looking for a microphone")
        }
        (true, _) => (&["● Microphone on", "● Mic on", "●"], p.error, "Click to turn the microphone off"),
    };
    let button = devices::indicator(ui, texts, color, (MICROPHONE, room));
    let name = if view.is_on { "Turn the microphone off" } else { "Use the microphone" };
    accessible::name(&button, egui::Role::Button, name);
    out.on_click("button:microphone", &button.on_hover_text(out.keys.tip(tip, Action::Microphone)), Action::Microphone);
}
