//! The fields of the panel, each with its title before it and its error below it.

use super::Recorder;
use crate::{
    film::{Codec, Format},
    gui::{accessible, theme, ui_output::UiOutput},
    session::{CheckedForm, FilmFacts, FilmField, FilmForm},
};
use egui::{Align, ComboBox, Label, Layout, Margin, RichText, Role, TextEdit, Ui, vec2};

/// The widths of the titles, of a narrow field and of a wide one.
const TITLES: f32 = 78.0;
const NARROW: f32 = 132.0;
const WIDE: f32 = 260.0;
const QUALITIES: [(&str, &str); 4] = [("low", "Low"), ("medium", "Medium"), ("high", "High"), ("lossless", "Lossless")];

/// A row of the form while it is shown.
struct Row<'a> {
    field: FilmField,
    title: &'static str,
    checked: &'a CheckedForm,
}

impl Row<'_> {
    /// Shows the title, the contents and the error.
    fn show(&self, ui: &mut Ui, out: &mut UiOutput, contents: impl FnOnce(&mut Ui, &mut UiOutput)) {
        ui.horizontal_wrapped(|ui| {
            let layout = Layout::left_to_right(Align::Center);
            ui.allocate_ui_with_layout(vec2(TITLES, 24.0), layout, |ui| {
                ui.set_min_width(TITLES);
                ui.label(self.title);
            });
            contents(ui, out);
        });
        if let Some(why) = self.checked.error(self.field) {
            error(ui, &name(self.field), why, out);
        }
    }
}

/// Shows an error below the fields.
pub(super) fn error(ui: &mut Ui, name: &str, why: &str, out: &mut UiOutput) {
    ui.horizontal_top(|ui| {
        ui.add_space(TITLES + ui.spacing().item_spacing.x);
        let mut text = why.to_owned();
        if let Some(first) = text.get(..1).map(str::to_uppercase) {
            text.replace_range(..1, &first);
        }
        let response = ui.add(Label::new(RichText::new(text).size(12.0).color(theme::of(ui).error)).wrap());
        out.place(format!("film:error:{name}"), response.rect);
    });
}

/// Returns the frame rate of a format: the typed one, or the format's limit if the default rate exceeds it. A rate
/// that the user typed is kept, and an error is shown at its field.
fn fitting_rate(format: Format, fps: &str) -> String {
    match format.max_fps() {
        Some(fastest) if fps == FilmForm::default().fps => fastest.to_string(),
        _ => fps.to_owned(),
    }
}

fn name(field: FilmField) -> String {
    format!("{field:?}").to_lowercase()
}

/// Shows a text field. Returns whether it has the keyboard focus.
fn text(
    ui: &mut Ui,
    (field, title): (FilmField, &str),
    value: &mut String,
    (hint, width): (&str, f32),
    out: &mut UiOutput,
) -> bool {
    let width = width.min(ui.available_width()).max(60.0);
    let edit = TextEdit::singleline(value).hint_text(hint).desired_width(width - 12.0).margin(Margin::symmetric(6, 3));
    let response = ui.add(edit.background_color(theme::of(ui).button));
    accessible::name(&response, Role::TextInput, title);
    out.place(format!("film:{}", name(field)), response.rect);
    response.has_focus()
}

/// Shows a list of choices on a button.
fn combo<T: Copy + PartialEq>(
    ui: &mut Ui,
    (name, title): (&str, &str),
    now: T,
    choices: &[(T, String)],
    out: &mut UiOutput,
) -> Option<T> {
    let shown = choices.iter().find(|(choice, _)| *choice == now).map_or("", |(_, title)| title);
    let mut chosen = None;
    let response = ComboBox::from_id_salt(("film", name))
        .width(NARROW)
        .height(320.0)
        .selected_text(shown)
        .show_ui(ui, |ui| {
            for (n, (choice, title)) in choices.iter().enumerate() {
                let entry = ui.selectable_label(*choice == now, title);
                if out.clicked(&format!("film:{name}:{n}"), &entry) {
                    chosen = Some(*choice);
                }
            }
        })
        .response;
    accessible::name(&response, Role::ComboBox, title);
    out.place(format!("film:{name}"), response.rect);
    chosen
}

/// Shows all fields. Returns whether one is being typed in.
pub(super) fn show(
    recorder: &mut Recorder,
    ui: &mut Ui,
    (checked, facts): (&CheckedForm, &FilmFacts),
    out: &mut UiOutput,
) -> bool {
    let mut form = recorder.form.clone();
    let mut types = false;
    let row = |field, title| Row { field, title, checked };
    row(FilmField::Range, "Range").show(ui, out, |ui, out| {
        types |= text(ui, (FilmField::Range, "Range"), &mut form.range, ("0-599", NARROW), out);
        hint(ui, "0-599, 0-599:2, 600 or 2.5s-10s");
    });
    row(FilmField::Size, "Size").show(ui, out, |ui, out| {
        let (width, height) = facts.shown;
        let as_shown = format!("{width}x{height}");
        types |= text(ui, (FilmField::Size, "Size in pixels"), &mut form.size, (&as_shown, NARROW), out);
        hint(ui, "Width x height. Empty: size of the picture");
    });
    row(FilmField::Rate, "Frame rate").show(ui, out, |ui, out| {
        types |= text(ui, (FilmField::Rate, "Frames per second"), &mut form.fps, ("60", NARROW), out);
        hint(ui, "Frames per second");
    });
    row(FilmField::Format, "Format").show(ui, out, |ui, out| {
        let choices = Format::ALL.map(|format| (format, format.title().to_owned()));
        if let Some(format) = combo(ui, ("format", "Format"), form.format, &choices, out) {
            // Drop choices that the other format does not support.
            let codec = form.codec.filter(|codec| format.codecs().contains(codec));
            let has_codecs = !format.codecs().is_empty();
            let quality = if has_codecs { form.quality.clone() } else { String::new() };
            let fade = if format.is_still() { String::new() } else { form.fade.clone() };
            let fps = fitting_rate(format, &form.fps);
            form = FilmForm { format, codec, quality, fade, fps, ..form.clone() };
        }
    });
    let codecs = form.format.codecs();
    if !codecs.is_empty() {
        row(FilmField::Codec, "Codec").show(ui, out, |ui, out| {
            let usual = format!("Default ({})", codecs[0].title());
            let mut choices: Vec<(Option<Codec>, String)> = vec![(None, usual)];
            choices.extend(codecs.iter().map(|codec| (Some(*codec), codec.title().to_owned())));
            if let Some(codec) = combo(ui, ("codec", "Codec"), form.codec, &choices, out) {
                form.codec = codec;
            }
        });
        row(FilmField::Quality, "Quality").show(ui, out, |ui, out| {
            types |= quality(ui, &mut form, codecs[0], out);
        });
    }
    if !form.format.is_still() {
        row(FilmField::Fade, "Loop").show(ui, out, |ui, out| {
            types |= text(ui, (FilmField::Fade, "Seconds that a loop fades"), &mut form.fade, ("No loop", NARROW), out);
            hint(ui, "Crossfade in seconds");
        });
    }
    if form.format.has_sound() {
        below(ui, |ui| {
            let sound = ui.checkbox(&mut form.with_sound, "With sound");
            let sound = sound.on_hover_text("Music and the sound pass, where the project has them; for ranges only");
            out.place("film:sound", sound.rect);
        });
    }
    row(FilmField::File, "File").show(ui, out, |ui, out| {
        types |= text(ui, (FilmField::File, "File"), &mut form.file, ("Next free number", WIDE), out);
    });
    if checked.is_taken {
        below(ui, |ui| {
            let replace = ui.checkbox(&mut recorder.replaces, "Overwrite");
            out.place("film:replace", replace.rect);
        });
    }
    recorder.set(form);
    types
}

/// Shows something without a title, aligned with the fields.
fn below(ui: &mut Ui, contents: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        ui.add_space(TITLES + ui.spacing().item_spacing.x);
        contents(ui);
    });
}

/// Shows what a field accepts, if there is room next to it.
fn hint(ui: &mut Ui, text: &str) {
    let color = theme::of(ui).weak;
    let galley = ui.painter().layout_no_wrap(text.to_owned(), egui::FontId::proportional(12.0), color);
    if galley.size().x < ui.available_size_before_wrap().x {
        ui.label(RichText::new(text).size(12.0).color(color));
    }
}

/// Shows the list of qualities, and a field for a number of the encoder. Returns whether it is being typed in.
fn quality(ui: &mut Ui, form: &mut FilmForm, usual: Codec, out: &mut UiOutput) -> bool {
    let words: Vec<(&str, String)> = std::iter::once(("", "Default".to_owned()))
        .chain(QUALITIES.map(|(word, title)| (word, title.to_owned())))
        .chain([(NUMBER, "Number".to_owned())])
        .collect();
    let now = words.iter().map(|(word, _)| *word).find(|word| *word == form.quality).unwrap_or(NUMBER);
    let (least, most) = form.codec.unwrap_or(usual).numbers();
    match combo(ui, ("quality-word", "Quality"), now, &words, out) {
        Some(NUMBER) if now != NUMBER => form.quality = ((least + most) / 2).to_string(),
        Some(word) if word != NUMBER => form.quality = word.to_owned(),
        _ => {}
    }
    if words.iter().any(|(word, _)| *word == form.quality) {
        return false;
    }
    let types = text(ui, (FilmField::Quality, "Quality as a number"), &mut form.quality, ("20", 60.0), out);
    hint(ui, &format!("{least} (best) to {most}"));
    types
}

/// The entry for a number in the list of qualities.
const NUMBER: &str = "number";
