//! The layout of the panel.

use super::{Recorder, fields};
use crate::{
    gui::{
        accessible,
        panels::{Content, DefaultPlace, MARGIN, PanelRow},
        theme,
        ui_output::UiOutput,
    },
    session::{CheckedForm, Command, FilmCommand, FilmForm, FilmOrder, FilmPreset, FilmView, Session},
};
use egui::{Button, Label, ProgressBar, Response, RichText, Role, ScrollArea, Ui, vec2};

pub(crate) const PANEL: PanelRow = PanelRow::new(
    "recorder",
    "Recorder",
    DefaultPlace::BelowCodeLarge,
    Content::Within(MARGIN, |ui, context| {
        show(context.recorder, ui, &context.settings.recorder, context.session, context.out)
    }),
)
.action(
    "Panel: Recorder (films, GIFs and image sequences)",
    &["Shift+Alt+R"],
    "record video movie gif mp4 webm render export capture screen sequence",
);

/// The text below the first button.
const LIVE: &str = "Every frame that the window draws while you play with mouse, keys and sliders. No frame is left out: \
                    where drawing or encoding takes longer, the picture runs slower. The sound is that of the times that \
                    the frames show, also after a pause or a jump, and is computed at the end.";
/// The text below the second one.
const RANGE: &str = "The frames of the range, from frame 0 without input, as eddy render writes them. You can go on working \
                     meanwhile.";

/// Shows the panel. `settings` are the last choices.
fn show(recorder: &mut Recorder, ui: &mut Ui, settings: &FilmForm, session: &Session, out: &mut UiOutput) {
    out.stop("recorder", ui);
    ui.spacing_mut().item_spacing = vec2(6.0, 5.0);
    recorder.follow(settings);
    let facts = session.film_facts();
    if facts.encoders.is_none() && !std::mem::replace(&mut recorder.has_asked, true) {
        out.ask(FilmCommand::FindEncoders);
    }
    let film = session.film();
    let is_busy = film.as_ref().is_some_and(FilmView::is_busy);
    let checked = recorder.form.check(&facts, recorder.replaces);
    ScrollArea::vertical().id_salt("recorder").auto_shrink(false).show(ui, |ui| {
        // The scroll bar of the list covers what is below it.
        ui.set_max_width(ui.available_width() - 10.0);
        if let Some(film) = &film {
            status(ui, session, film, out);
        }
        let types = ui
            .add_enabled_ui(!is_busy, |ui| {
                presets(recorder, ui, out);
                let types = fields::show(recorder, ui, (&checked, &facts), out);
                if matches!(facts.encoders, Some(Err(_))) {
                    look_again(ui, session, out);
                }
                types
            })
            .inner;
        out.shell_commands.extend(recorder.change(types, !checked.errors.is_empty()));
        if !is_busy {
            ui.add_space(2.0);
            buttons(recorder, ui, &checked, out);
        }
    });
}

/// Buttons that set several fields at once.
fn presets(recorder: &mut Recorder, ui: &mut Ui, out: &mut UiOutput) {
    ui.horizontal_wrapped(|ui| {
        for preset in FilmPreset::ALL {
            let is_on = preset.apply(&recorder.form) == recorder.form;
            let button = ui.add(Button::new(preset.title()).selected(is_on)).on_hover_text(preset.about());
            if out.clicked(&format!("film:preset:{preset:?}"), &button) {
                let form = preset.apply(&recorder.form);
                recorder.set(form);
            }
        }
    });
}

fn look_again(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let button = ui.add_enabled(!session.looks_for_encoders(), Button::new("Look for ffmpeg again"));
    out.on_click("film:look-again", &button, Command::Film(FilmCommand::FindEncoders));
}

fn buttons(recorder: &mut Recorder, ui: &mut Ui, checked: &CheckedForm, out: &mut UiOutput) {
    let p = theme::of(ui);
    let why = |order: &Option<FilmOrder>, other: Option<&str>| match order {
        Some(_) => None,
        None => Some(other.map_or("Fix the fields in red first", |why| why).to_owned()),
    };
    let mut entry =
        |ui: &mut Ui, name: &str, title: &str, about: &str, order: &Option<FilmOrder>, why: Option<String>| {
            let text = RichText::new(title).color(p.strong);
            let button = Button::new(text).fill(p.accent_fill).min_size(vec2(190.0, 28.0));
            let response = ui.add_enabled(order.is_some(), button);
            let response = match &why {
                Some(why) => response.on_disabled_hover_text(why),
                None => response,
            };
            if let (true, Some(order)) = (out.clicked(name, &response), order) {
                out.ask(FilmCommand::MakeFilm(Box::new(order.clone())));
                return true;
            }
            let note = why.filter(|_| checked.errors.is_empty());
            let color = if note.is_some() { p.error } else { p.weak };
            let note = note.unwrap_or_else(|| about.to_owned());
            ui.add(Label::new(RichText::new(note).size(12.0).color(color)).wrap());
            ui.add_space(4.0);
            false
        };
    let live = why(&checked.live, checked.not_live.as_deref());
    let is_started = entry(ui, "film:live", "Record live", LIVE, &checked.live, live)
        | entry(ui, "film:range-exactly", "Render range", RANGE, &checked.range, why(&checked.range, None));
    if is_started {
        recorder.replaces = false;
    }
}

/// Shows the progress or the result of the film, with the buttons that stop it.
fn status(ui: &mut Ui, session: &Session, film: &FilmView<'_>, out: &mut UiOutput) {
    let p = theme::of(ui);
    let color = match film {
        FilmView::Live(live) if live.speed.is_some_and(|speed| speed < 0.95) => p.warning,
        FilmView::Failed(_) => p.error,
        FilmView::Done(_) => p.good,
        _ => p.text,
    };
    // Above the words, which grow by a line while it runs: a button must not move away from the pointer.
    if film.is_busy() {
        ui.horizontal_wrapped(|ui| {
            if matches!(film, FilmView::Live(_)) {
                let stop = ui.add(Button::new(RichText::new("Stop and save").color(p.strong)).fill(p.accent_fill));
                out.on_click("film:stop", &stop, Command::Film(FilmCommand::StopFilm));
            }
            if cancel(ui, out) {
                out.ask(FilmCommand::CancelFilm);
            }
        });
    }
    if let Some(part) = film.part() {
        let bar = ProgressBar::new(part).desired_height(16.0).fill(p.accent_fill).corner_radius(4);
        let bar = ui.add(bar.text(RichText::new(format!("{:.0} %", part * 100.0)).size(11.5).color(p.strong)));
        out.place("film:progress", bar.rect);
    }
    let words = film.words();
    let label = ui.add(Label::new(RichText::new(&words).color(color)).wrap().selectable(true));
    out.place("film:status", label.rect);
    if session.closes_after_film() {
        ui.label("Eddy closes when the film is complete.");
    }
    ui.separator();
}

fn cancel(ui: &mut Ui, out: &mut UiOutput) -> bool {
    let button: Response = ui.button("Cancel").on_hover_text("Ends it and leaves no file");
    accessible::name(&button, Role::Button, "Cancel the film");
    out.clicked("film:cancel", &button)
}
