//! The bar below the picture: time, speed, size and the selected pass.

use super::{
    accessible,
    actions::Action,
    devices,
    geometry::Shape,
    icons::{self, Icon},
    menus,
    panels::Panel,
    replay, resolution, sound_bar, theme, timeline,
    ui_output::{Request, ShellCommand, UiOutput},
};
use crate::{
    project::Tab,
    session::{Command, EditCommand, FilmCommand, FilmView, Session, ViewCommand},
};
use egui::{Button, ComboBox, Popup, RichText, Ui, vec2};

/// The height of the bar.
pub(super) const HEIGHT: f32 = 40.0 + timeline::HEIGHT;

/// Widths in points: for the selected pass and the menu after it, and for the resolution.
const RIGHT_WIDTH: f32 = 116.0;
const SIZE: f32 = 108.0;
/// The width of the recording mark.
const RECORDING: f32 = 64.0;

/// Fills the available space. Returns true if the empty part of the bar is dragged.
pub(super) fn show(ui: &mut Ui, session: &Session, shape: Shape, out: &mut UiOutput) -> bool {
    out.stop("transport", ui);
    let transport = session.transport();
    // It also takes clicks, so that a click does not start a drag.
    let handle = ui.interact(ui.max_rect(), ui.scope_id().with("bar"), egui::Sense::CLICK | egui::Sense::DRAG);
    ui.spacing_mut().item_spacing = vec2(4.0, 0.0);
    timeline::show(ui, session, out);
    ui.horizontal_centered(|ui| {
        let (icon, tip) = if transport.playing { (Icon::Pause, "Pause") } else { (Icon::Play, "Play") };
        let play = icons::first(ui, icon, tip).on_hover_text(out.keys.tip(tip, Action::TogglePlay));
        out.on_click("button:play", &play, Action::TogglePlay);
        let mut button = |ui: &mut Ui, name: &str, icon: Icon, tip: &str, action: Action| {
            let response = icons::button(ui, icon, tip).on_hover_text(out.keys.tip(tip, action));
            out.on_click(name, &response, action);
        };
        button(ui, "button:reset", Icon::Reset, "Reset time and buffers", Action::Reset);
        // The resolution stays as long as the lights keep their dots. A recording fixes it.
        let played = session.replay();
        let roomy = played.is_none() && ui.available_width() >= RIGHT_WIDTH + SIZE + least_of_lights(session);
        let right = if roomy { RIGHT_WIDTH + SIZE } else { RIGHT_WIDTH };
        // In a narrow bar they are hidden in favour of the resolution, recording marks and device lights: they also have
        // keys.
        if ui.available_width() >= right + 3.0 * (icons::WIDTH + 4.0) + least_of_lights(session) {
            button(ui, "button:step-back", Icon::StepBack, "Step one frame back", Action::StepBack);
            button(ui, "button:step", Icon::Step, "Step one frame forward", Action::Step);
            button(
                ui,
                "button:screenshot",
                Icon::Camera,
                "Save screenshot of the shown pass (PNG)",
                Action::Screenshot,
            );
        }
        recording(ui, session, out);
        film(ui, session, out);
        // Later widgets keep room for themselves: for the lights, at least their dots.
        let sound = sound_bar::least(session);
        devices::light(ui, session, ui.available_width() - right - devices::network_least(session) - sound, out);
        devices::network_light(ui, session, ui.available_width() - right - sound, out);
        sound_bar::show(ui, session, ui.available_width() - right, out);
        // What does not fit is in the menu at the right, or in the table of costs.
        let gap = 8.0;
        ui.spacing_mut().item_spacing.x = gap;
        if let Some(played) = &played {
            replay::show(ui, played, transport.playing, RIGHT_WIDTH + gap, out);
        }
        let mut room = ui.available_width() - right;
        let mut fits = |width: f32| {
            let fits = played.is_none() && room >= width + gap;
            room -= if fits { width + gap } else { 0.0 };
            fits
        };
        let (shows_time, shows_cost) = (fits(56.0), fits(60.0));
        let (shows_fps, shows_frame) = (fits(58.0), fits(52.0));
        if shows_time {
            timeline::button(ui, 56.0, &format!("{} s", figure(transport.time_secs, 2, 5)), session, out);
        }
        if shows_frame {
            let text = match f64::from(transport.frame) {
                frame if frame < 1e6 => format!("#{frame}"),
                frame => format!("#{:.2}M", frame / 1e6),
            };
            value(ui, 52.0, &text, "Frame (iFrame)");
        }
        if shows_fps {
            let text = transport.fps.map_or_else(|| "– fps".to_owned(), |fps| format!("{} fps", figure(fps, 1, 4)));
            value(ui, 58.0, &text, "Frames per second, over the last half second");
        }
        if shows_cost {
            cost(ui, session, out);
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            options(ui, session, (!roomy).then_some(shape), out);
            shown_pass(ui, session, out);
            if roomy {
                resolution::button(ui, session, shape, out);
            }
        });
    });
    handle.drag_started()
}

/// Returns the minimum width of recording marks and device lights.
fn least_of_lights(session: &Session) -> f32 {
    let marks = [session.recorded_frames().is_some(), session.film().is_some_and(|film| film.is_busy())];
    let marks = marks.into_iter().filter(|is_there| *is_there).count() as f32 * (RECORDING + 4.0);
    marks + devices::least(session) + devices::network_least(session) + sound_bar::least(session)
}

/// Formats a number with this number of decimals, or as many as fit: it must not touch the number next to it.
fn figure(value: f64, digits: usize, letters: usize) -> String {
    let fits = |digits: &usize| format!("{value:.digits$}").len() <= letters;
    let digits = (0..=digits).rev().find(fits).unwrap_or(0);
    format!("{value:.digits$}")
}

/// While input is recorded, shows the number of frames on a button that stops it. It always has room, so that a
/// recording is not forgotten.
fn recording(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let Some(frames) = session.recorded_frames() else { return };
    let text = RichText::new(format!("● {frames}")).monospace().size(12.0).color(theme::of(ui).error);
    let tip = format!("{frames} frames of input recorded; click to stop and save");
    let button = ui.add(Button::new(text).min_size(vec2(RECORDING, 24.0)));
    accessible::name(&button, egui::Role::Button, "Stop recording input");
    out.on_click("button:recording", &button.on_hover_text(out.keys.tip(&tip, Action::Record)), Action::Record);
}

/// While a film is made, shows its progress on a button that stops a recording or opens the panel.
fn film(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let Some(film) = session.film().filter(FilmView::is_busy) else { return };
    let p = theme::of(ui);
    let is_live = matches!(film, FilmView::Live(_));
    let (text, color) = match &film {
        FilmView::Live(live) => (format!("● {:.0} s", live.secs), p.error),
        _ => (format!("{:.0} %", film.part().unwrap_or_default() * 100.0), p.text),
    };
    let button = Button::new(RichText::new(text).monospace().size(12.0).color(color));
    let button = ui.add(button.min_size(vec2(RECORDING, 24.0)));
    let (name, what, request) = match is_live {
        true => {
            ("Stop recording the film", "click to stop and save", Request::from(Command::Film(FilmCommand::StopFilm)))
        }
        false => ("Progress of the film", "click to open the Recorder panel", Action::Panel(Panel::Recorder).into()),
    };
    accessible::name(&button, egui::Role::Button, name);
    out.on_click("button:film", &button.on_hover_text(format!("{}; {what}", film.words())), request);
}

/// Shows a number that keeps its position while it changes.
fn value(ui: &mut Ui, width: f32, text: &str, tip: &str) {
    let (rect, response) = ui.allocate_exact_size(vec2(width, 24.0), egui::Sense::hover());
    let font = egui::FontId::monospace(12.0);
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    painter.text(rect.right_center(), egui::Align2::RIGHT_CENTER, text, font, theme::of(ui).text);
    response.on_hover_text(tip);
}

/// Shows the milliseconds per frame; on hover, how they are spent.
fn cost(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let transport = session.transport();
    let (text, of) = match (transport.gpu_millis, transport.cpu_micros) {
        (Some(millis), _) => (format!("{} ms", figure(millis, 2, 5)), "GPU"),
        (None, Some(micros)) => (format!("{} ms", figure(micros / 1000.0, 2, 5)), "processor"),
        (None, None) => ("– ms".to_owned(), "GPU"),
    };
    let (rect, response) = ui.allocate_exact_size(vec2(60.0, 24.0), egui::Sense::click());
    accessible::name(&response, egui::Role::Button, "Costs of each pass");
    out.on_click("button:costs", &response, Action::Panel(Panel::Costs));
    if response.hovered() {
        ui.painter().rect_filled(rect.expand2(vec2(4.0, 0.0)), 4.0, theme::of(ui).button);
    }
    ui.painter().text(
        rect.right_center(),
        egui::Align2::RIGHT_CENTER,
        text,
        egui::FontId::monospace(12.0),
        theme::of(ui).text,
    );
    response.on_hover_ui(|ui| {
        ui.label(format!("Frame time on the {of}"));
        if !transport.playing {
            ui.colored_label(theme::of(ui).weak, "Paused.");
            return;
        }
        egui::Grid::new("costs").num_columns(2).spacing([24.0, 3.0]).show(ui, |ui| {
            for time in session.pass_times() {
                ui.label(time.pass.title());
                ui.monospace(format!("{:.3} ms", time.gpu_millis));
                ui.end_row();
            }
            ui.label("CPU time of the engine");
            ui.monospace(format!("{:.0} µs", transport.cpu_micros.unwrap_or_default()));
            ui.end_row();
        });
        if session.pass_times().is_empty() {
            ui.colored_label(theme::of(ui).weak, "This GPU does not report times per pass.");
        }
        ui.colored_label(
            theme::of(ui).weak,
            out.keys.tip("Click to open the Costs panel", Action::Panel(Panel::Costs)),
        );
    });
}

fn shown_pass(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let shown = session.shown_pass();
    let response = ComboBox::from_id_salt("shown pass")
        .width(76.0)
        .selected_text(shown.title())
        .show_ui(ui, |ui| {
            for tab in session.tabs() {
                let Tab::Pass(id) = tab else { continue };
                if !id.is_picture() {
                    continue;
                }
                let entry = ui.selectable_label(id == *shown, id.title());
                out.on_click(&format!("pass:{}", id.title()), &entry, Command::View(ViewCommand::ShowPass(id)));
            }
        })
        .response
        .on_hover_text("Shown pass, also used for screenshots");
    accessible::name(&response, egui::Role::ComboBox, "Shown pass");
    out.place("combo:pass", response.rect);
}

/// Shows the menu at the right. `shape`: set if the bar has no room for the resolution, which is then in the menu.
fn options(ui: &mut Ui, session: &Session, shape: Option<Shape>, out: &mut UiOutput) {
    let more = icons::button(ui, Icon::More, "More");
    out.place("button:options", more.rect);
    Popup::menu(&more).show(|ui| {
        if let Some(shape) = shape {
            resolution::entry(ui, session, shape, out);
            ui.separator();
        }
        let reset = session.reset_on_reload();
        let switch = menus::switch(ui, reset, "Reset when a file is reloaded", String::new());
        out.on_click("switch:reset-on-reload", &switch, Command::Edit(EditCommand::SetResetOnReload(!reset)));
        ui.separator();
        let all = [
            Action::Screenshot,
            Action::SaveTexels,
            Action::Record,
            Action::PlayRecording,
            Action::ExportJson,
            Action::Audit,
            Action::CountCost,
            Action::Fullscreen,
            Action::Panel(Panel::Costs),
            Action::Compile,
        ];
        for action in all {
            if menus::entry(ui, action.title(), out.keys.hint(action)).clicked() {
                out.act(action);
                ui.close();
            }
        }
        ui.separator();
        let close = menus::entry(ui, "Close picture", String::new());
        out.on_click(
            "options:close-picture",
            &close.on_hover_text("Reopen it from the View menu"),
            ShellCommand::ClosePanel(Panel::Picture),
        );
    });
    if let Some(shape) = shape {
        resolution::opened(&more, session, shape, out);
    }
    more.on_hover_text("More");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_fit_their_width() {
        let all = [0.0, 9.996, 99.994, 99.996, 144.04, 999.96, 12345.0].map(|value| figure(value, 2, 5));
        assert_eq!(all, ["0.00", "10.00", "99.99", "100.0", "144.0", "1000", "12345"]);
        assert_eq!([59.94, 99.96, 240.3, 1000.0].map(|value| figure(value, 1, 4)), ["59.9", "100", "240", "1000"]);
    }
}
