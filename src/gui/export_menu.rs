//! The menu of everything that can be exported to a file.
//!
//! An export is a row of [`ROWS`] and runs its action.

use super::{actions::Action, panels::Panel, ui_output::UiOutput};
use crate::session::Session;
use egui::{Button, Ui};

/// A row of the menu: its title, its action, and what it does. `None` is a separator between groups.
const ROWS: &[Option<(&str, Action, &str)>] = &[
    Some(("Screenshot (PNG)", Action::Screenshot, "Save the shown pass as a PNG at its own resolution")),
    Some((
        "Film, GIF or image sequence…",
        Action::Panel(Panel::Recorder),
        "Open the Recorder panel, which records what you do or renders a range of frames",
    )),
    Some(("Float texels (.npy)", Action::SaveTexels, "Save the shown pass as it is stored: 32-bit floats, for NumPy")),
    None,
    Some((
        "Shadertoy JSON…",
        Action::ExportJson,
        "Save the project as a JSON file that Shadertoy's tools and Eddy read",
    )),
    Some((
        "Convert to Shadertoy",
        Action::Convert,
        "Open this shader of another program as a new project with mainImage and iChannel0 to iChannel3",
    )),
    Some((
        "HTML page…",
        Action::ExportPage,
        "Save the project as one HTML file that plays it in a browser, with its images and sounds",
    )),
    None,
    Some((
        "Recording of input (.replay)",
        Action::Record,
        "Restart at frame 0 and record time, mouse, keys, resolution and uniforms of every frame; choose it again to \
         stop and save",
    )),
    Some(("Measurements (CSV)", Action::SaveMeasures, "Save what //@probe comments have measured so far")),
    Some(("Sound (WAV)", Action::SaveSound, "Save all 180 s of the sound pass")),
    Some(("Lab report…", Action::LabReport, "Write tables, plots and an HTML page of all results of the Lab panel")),
];

/// Shows the button and its menu. `has_lab_results`: there is something to report.
pub(super) fn show(ui: &mut Ui, session: &Session, has_lab_results: bool, out: &mut UiOutput) {
    let menu = ui.menu_button("Export", |ui| {
        ui.set_min_width(230.0);
        for row in ROWS {
            let Some((title, action, tip)) = row else {
                ui.separator();
                continue;
            };
            let why_not = why_not(session, has_lab_results, *action);
            let recorded = session.recorded_frames().filter(|_| *action == Action::Record);
            let title = match recorded {
                Some(frames) => format!("Stop recording and save ({frames} frames)"),
                None => (*title).to_owned(),
            };
            let entry = ui
                .add_enabled_ui(why_not.is_none(), |ui| {
                    ui.add(Button::new(title).shortcut_text(out.keys.hint(*action)))
                })
                .inner;
            let entry = entry.on_hover_text(*tip).on_disabled_hover_text(why_not.unwrap_or_default());
            out.on_menu_click(ui, &format!("export:{}", name(*action)), &entry, *action);
        }
    });
    out.place("button:export", menu.response.rect);
    menu.response.on_hover_text("Save pictures, recordings and data, or the project for Shadertoy and browsers");
}

/// Returns why something cannot be exported now.
fn why_not(session: &Session, has_lab_results: bool, action: Action) -> Option<&'static str> {
    let is_measured = || session.measures().iter().any(|measure| measure.record.newest().is_some());
    match action {
        Action::SaveMeasures if !is_measured() => {
            Some("Nothing has been measured yet: add a //@probe comment and open the Measurements panel")
        }
        Action::Convert if !session.project().dialect.has_main() => {
            Some("The project has Shadertoy's form already: this converts shaders with void main()")
        }
        Action::SaveSound => session.sound_unsaved(),
        Action::LabReport if !has_lab_results => Some("There are no results yet: start a study in the Lab panel"),
        _ => None,
    }
}

/// Returns the action's name in the key file.
fn name(action: Action) -> &'static str {
    super::actions::ACTIONS.iter().find(|entry| entry.action == action).map_or("", |entry| entry.name)
}
