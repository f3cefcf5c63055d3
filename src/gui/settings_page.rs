//! The page of settings: the rows of the table of settings, each with its widget. Changes are written to the file at
//! once.

use super::{
    accessible,
    actions::Action,
    fonts,
    settings::{Change, Kind, MIDI_ALL, MIDI_OFF, Number, Overrides, Plain, SETTINGS, Setting, SettingsFile},
    theme,
    ui_output::{Pick, ShellCommand, UiOutput},
};
use crate::{
    project::expand_home,
    session::{ControlCommand, Session, SoundCommand},
};
use egui::{
    Align, Button, ComboBox, DragValue, Frame, Id, Layout, Margin, Modal, RichText, Role, ScrollArea, TextEdit, Ui,
    vec2,
};
use std::time::{Duration, Instant};

/// The width of a title and its widget.
const WIDTH: f32 = 620.0;
/// The width of the widgets.
const CONTROL: f32 = 250.0;
/// The interval at which the file is checked while the page is open: another program may write it.
const INTERVAL: Duration = Duration::from_millis(500);

/// The page while it is open.
#[derive(Debug, Default)]
pub(super) struct SettingsPage {
    is_new: bool,
    /// The height of the dialog in the newest frame.
    height: f32,
    checked_at: Option<Instant>,
    /// The setting whose number is being dragged, and the number.
    dragged: Option<(&'static str, f64)>,
    /// The setting whose text is being typed, and the text.
    typed: Option<(&'static str, String)>,
    /// The setting whose text is invalid, and why.
    error: Option<(&'static str, String)>,
}

impl SettingsPage {
    pub(super) fn new() -> Self {
        Self { is_new: true, ..Self::default() }
    }

    /// Returns whether the file is to be checked now.
    pub(super) fn is_check_due(&mut self, ui: &Ui, now: Instant) -> bool {
        ui.ctx().request_repaint_after(INTERVAL);
        let is_due = self.checked_at.is_none_or(|at| now.saturating_duration_since(at) >= INTERVAL);
        if is_due {
            self.checked_at = Some(now);
        }
        is_due
    }

    /// Returns the change to a text that was typed or chosen for a setting. Returns `None` if it is invalid, which the
    /// page then shows.
    pub(super) fn enter(&mut self, setting: &'static Setting, text: &str) -> Option<Change> {
        let kind = &setting.row.kind;
        let checked = kind.check(text).map_err(|why| format!("{} {why}", setting.row.title));
        let checked = checked.and_then(|()| match kind {
            Kind::FontFile if !text.is_empty() => fonts::check(text),
            Kind::Folder if !text.is_empty() && !expand_home(text).is_dir() => {
                Err(format!("{text} is not a folder: choose one that exists"))
            }
            _ => Ok(()),
        });
        match checked {
            Ok(()) => {
                (self.typed, self.error) = (None, None);
                (setting.change)(&Plain::Text(text.to_owned()))
            }
            Err(why) => {
                (self.typed, self.error) = (Some((setting.key, text.to_owned())), Some((setting.key, why)));
                None
            }
        }
    }

    /// Shows the page; returns false when it is closed.
    pub(super) fn show(
        &mut self,
        ui: &Ui,
        session: &Session,
        file: &SettingsFile,
        overrides: &Overrides,
        out: &mut UiOutput,
    ) -> bool {
        if self.is_new && session.controls_view().has_midi {
            out.ask(ControlCommand::ListMidiDevices);
        }
        if self.is_new && session.output_view().is_some() {
            out.ask(SoundCommand::ListAudioDevices);
        }
        let window = ui.ctx().content_rect();
        let mut is_open = true;
        let modal = Modal::new(Id::unique("settings")).frame(theme::dialog(ui.style())).show(ui.ctx(), |ui| {
            ui.set_width((window.width() - 60.0).min(WIDTH));
            ui.set_max_height(window.height() - 60.0);
            ui.horizontal(|ui| {
                ui.heading("Settings");
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    if out.clicked("button:close-settings", &ui.button("Close").on_hover_text("Escape")) {
                        is_open = false;
                    }
                });
            });
            ui.separator();
            let height = (window.height() - 190.0).max(60.0);
            let list = ScrollArea::vertical().id_salt("settings").max_height(height).auto_shrink([false, true]);
            let shown = list.show(ui, |ui| {
                ui.set_max_width(ui.available_width() - 12.0);
                trouble(ui, file, out);
                for setting in SETTINGS.iter().filter(|setting| setting.is_shown(session)) {
                    let note = match setting.overridden(overrides) {
                        Some(option) => Some(format!("This window was started with {option}, which overrides it")),
                        None => setting.row.note.and_then(|note| note(session)),
                    };
                    ui.add_enabled_ui(file.trouble().is_none(), |ui| {
                        self.row(ui, session, setting, file, note.as_deref(), out);
                    });
                }
            });
            out.place("settings:page", shown.inner_rect);
            ui.separator();
            files(ui, file, out);
        });
        self.is_new = false;
        // A dialog is centred by the height of the frame before: another zoom would leave its top outside of the window.
        let height = modal.response.rect.height();
        if std::mem::replace(&mut self.height, height) != height {
            ui.ctx().request_repaint();
        }
        is_open && !modal.should_close()
    }

    /// Shows a setting: its title and help, and its widget at the right.
    fn row(
        &mut self,
        ui: &mut Ui,
        session: &Session,
        setting: &'static Setting,
        file: &SettingsFile,
        note: Option<&str>,
        out: &mut UiOutput,
    ) {
        let p = theme::of(ui);
        ui.add_space(6.0);
        let is_wide = ui.available_width() > CONTROL + 200.0;
        let words = |ui: &mut Ui| {
            ui.spacing_mut().item_spacing.y = 2.0;
            ui.label(RichText::new(setting.row.title).color(p.strong));
            ui.label(RichText::new(setting.row.help).size(12.0).color(p.weak));
            if let Some(note) = note {
                ui.label(RichText::new(note).size(12.0).color(p.warning));
            }
        };
        if is_wide {
            ui.horizontal_top(|ui| {
                let width = ui.available_width() - CONTROL - 12.0;
                ui.allocate_ui(vec2(width, 0.0), |ui| {
                    ui.vertical(|ui| {
                        ui.set_width(width);
                        words(ui);
                    });
                });
                ui.vertical(|ui| self.control(ui, session, setting, file, out));
            });
        } else {
            words(ui);
            self.control(ui, session, setting, file, out);
        }
        ui.add_space(4.0);
    }

    /// Shows the widget of a setting's kind, and a button that restores the default.
    fn control(
        &mut self,
        ui: &mut Ui,
        session: &Session,
        setting: &'static Setting,
        file: &SettingsFile,
        out: &mut UiOutput,
    ) {
        let settings = file.settings();
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            let plain = setting.plain(settings);
            let wanted = match (&setting.row.kind, &plain) {
                (Kind::Switch, Plain::Switch(is_on)) => switch(ui, setting, *is_on, out),
                (Kind::Choice(choices), Plain::Text(name)) => choice(ui, setting, (choices, name), self.is_new, out),
                (Kind::Number(number), Plain::Number(now)) => self.number(ui, setting, number, *now, out),
                (Kind::FontFile | Kind::Folder | Kind::Adapter | Kind::Address, Plain::Text(now)) => {
                    self.text(ui, setting, now, out)
                }
                (_, Plain::Text(now)) => combo(ui, setting, &devices(&setting.row.kind, session), now, out),
                _ => None,
            };
            out.shell_commands.extend(wanted.map(ShellCommand::Set));
            if !setting.is_default(settings) {
                let tip = format!("Default: {}", setting.default_text());
                let reset = ui.add(Button::new("Reset").frame(false)).on_hover_text(tip);
                accessible::name(&reset, Role::Button, format!("Reset {}", setting.row.title.to_lowercase()));
                if out.clicked(&format!("setting:{}:reset", setting.key), &reset) {
                    (self.typed, self.error) = (None, None);
                    out.shell_commands.push(ShellCommand::Set(setting.default_change()));
                }
            }
        });
        if let Some((_, why)) = self.error.as_ref().filter(|(key, _)| *key == setting.key) {
            let label = ui.label(RichText::new(why).size(12.0).color(theme::of(ui).error));
            out.place(format!("setting:{}:error", setting.key), label.rect);
        }
    }

    /// Shows a number between two buttons. The setting does not change during a drag: the window would move below the
    /// pointer.
    fn number(
        &mut self,
        ui: &mut Ui,
        setting: &'static Setting,
        number: &Number,
        now: f64,
        out: &mut UiOutput,
    ) -> Option<Change> {
        let [now, least, most, step] = [now, number.least, number.most, number.step].map(|x| x * number.scale);
        let mut wanted = None;
        let mut button = |ui: &mut Ui, sign: &str, name: &str, to: f64| {
            let is_there = to >= least - 1e-6 && to <= most + 1e-6;
            let button = ui.add_enabled(is_there, Button::new(sign).min_size(vec2(26.0, 24.0)));
            accessible::name(&button, Role::Button, format!("{name} {}", setting.row.title.to_lowercase()));
            if button.clicked() {
                wanted = Some(to);
            }
            button.rect
        };
        let less = button(ui, "−", "Decrease", now - step);
        let mut value = self.dragged.filter(|(key, _)| *key == setting.key).map_or(now, |(_, value)| value);
        let field = DragValue::new(&mut value)
            .range(least..=most)
            .speed(step * 0.2)
            .max_decimals(if number.is_whole { 0 } else { 2 })
            .suffix(number.unit)
            .update_while_editing(false);
        let response = ui.add_sized(vec2(76.0, 24.0), field);
        accessible::name(&response, Role::SpinButton, setting.row.title);
        let more = button(ui, "+", "Increase", now + step);
        if response.dragged() {
            self.dragged = Some((setting.key, value));
        } else if response.drag_stopped() || response.changed() {
            self.dragged = None;
            wanted = wanted.or(Some(value));
        }
        out.place(format!("setting:{}:less", setting.key), less);
        out.place(format!("setting:{}", setting.key), response.rect);
        out.place(format!("setting:{}:more", setting.key), more);
        (setting.change)(&Plain::Number(wanted?.clamp(least, most) / number.scale))
    }

    /// Shows a text field. The setting changes when the field loses the keyboard focus.
    fn text(&mut self, ui: &mut Ui, setting: &'static Setting, now: &str, out: &mut UiOutput) -> Option<Change> {
        let (hint, chooses) = match setting.row.kind {
            Kind::FontFile => ("Built-in", Some(("Choose a font file", Pick::CodeFont))),
            Kind::Adapter => ("The fastest", None),
            Kind::Folder => ("None", Some(("Choose a folder", Pick::LibraryFolder))),
            _ => ("", None),
        };
        let typed = self.typed.as_ref().filter(|(key, _)| *key == setting.key);
        let mut text = typed.map_or(now, |(_, text)| text).to_owned();
        let field = TextEdit::singleline(&mut text)
            .hint_text(hint)
            .desired_width(if chooses.is_some() { 130.0 } else { 150.0 })
            .background_color(theme::of(ui).button);
        let field = ui.add(field.margin(Margin::symmetric(6, 3)));
        accessible::name(&field, Role::TextInput, setting.row.title);
        out.place(format!("setting:{}", setting.key), field.rect);
        if field.changed() {
            (self.typed, self.error) = (Some((setting.key, text)), None);
        }
        // Escape closes the page without changing the setting.
        let is_cancelled = ui.input(|i| i.key_pressed(egui::Key::Escape));
        let entered = self.typed.take_if(|(key, _)| *key == setting.key && field.lost_focus());
        let entered = entered.map(|(_, text)| text.trim().to_owned()).filter(|text| !is_cancelled && text != now);
        let change = entered.and_then(|text| self.enter(setting, &text));
        if let Some((tip, pick)) = chooses {
            let choose = ui.button("Choose…").on_hover_text(tip);
            out.on_click(&format!("setting:{}:choose", setting.key), &choose, ShellCommand::Pick(pick));
        }
        change
    }
}

fn switch(ui: &mut Ui, setting: &Setting, mut is_on: bool, out: &mut UiOutput) -> Option<Change> {
    let before = is_on;
    let response = ui.checkbox(&mut is_on, if before { "On" } else { "Off" });
    accessible::choice(&response, Role::CheckBox, is_on, setting.row.title);
    let is_clicked = out.clicked(&format!("setting:{}", setting.key), &response);
    is_clicked.then(|| (setting.change)(&Plain::Switch(is_on))).flatten()
}

/// Shows buttons for names, each with its title. The selected one takes the keyboard focus if `takes_focus`.
fn choice(
    ui: &mut Ui,
    setting: &Setting,
    (choices, now): (&[(&str, &str)], &str),
    takes_focus: bool,
    out: &mut UiOutput,
) -> Option<Change> {
    let mut wanted = None;
    for (name, title) in choices {
        let is_on = *name == now;
        let response = ui.add(Button::selectable(is_on, *title));
        accessible::choice(&response, Role::RadioButton, is_on, format!("{}: {title}", setting.row.title));
        if takes_focus && is_on {
            response.request_focus();
        }
        if out.clicked(&format!("setting:{}:{name}", setting.key), &response) {
            wanted = (setting.change)(&Plain::Text((*name).to_owned()));
        }
    }
    wanted
}

/// Returns the devices of this machine that a setting may name, each with its title.
fn devices(kind: &Kind, session: &Session) -> Vec<(String, String)> {
    let named = |name: &str, title: &str| (name.to_owned(), title.to_owned());
    let (mut choices, names) = match kind {
        Kind::MidiDevices => {
            let choices = vec![named(MIDI_OFF, "Off"), named(MIDI_ALL, "All devices")];
            (choices, session.controls_view().midi.names)
        }
        _ => {
            let (outputs, inputs) = session.audio_devices();
            let names = if matches!(kind, Kind::SoundInput) { inputs } else { outputs };
            (vec![named("", "System default")], names)
        }
    };
    choices.extend(names.iter().flatten().map(|name| named(name, name)));
    choices
}

/// Shows a list of values, each with its title. A device that is not available stays chosen: it may come back.
fn combo(
    ui: &mut Ui,
    setting: &Setting,
    choices: &[(String, String)],
    now: &str,
    out: &mut UiOutput,
) -> Option<Change> {
    let missing = (now.to_owned(), now.to_owned());
    let is_missing = choices.iter().all(|(value, _)| value != now);
    let all = || choices.iter().chain(is_missing.then_some(&missing));
    let title = all().find(|(value, _)| value == now).map_or(now, |(_, title)| title);
    let combo = ComboBox::from_id_salt(setting.key).width(200.0).selected_text(title).truncate();
    let mut wanted = None;
    let shown = combo.show_ui(ui, |ui| {
        for (n, (value, title)) in all().enumerate() {
            let entry = ui.selectable_label(value == now, title);
            if out.clicked(&format!("setting:{}:{n}", setting.key), &entry) {
                wanted = (setting.change)(&Plain::Text(value.clone()));
            }
        }
    });
    accessible::name(&shown.response, Role::ComboBox, setting.row.title);
    out.place(format!("setting:{}", setting.key), shown.response.rect);
    wanted
}

/// Shows what is wrong in the file, and what happens to changes.
fn trouble(ui: &mut Ui, file: &SettingsFile, out: &mut UiOutput) {
    if file.errors().is_empty() {
        return;
    }
    let p = theme::of(ui);
    let frame = Frame::NONE
        .fill(p.background)
        .stroke(egui::Stroke::new(1.0, p.line))
        .corner_radius(4)
        .inner_margin(Margin::symmetric(10, 8));
    let shown = frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        for error in file.errors() {
            ui.colored_label(p.error, error);
        }
        let what = match file.trouble() {
            Some(_) => "Fix the file to change settings here. Eddy reads it again as soon as it is saved.",
            None => "These lines are not used. Changes made here leave them as they are.",
        };
        ui.label(what);
    });
    out.place("settings:trouble", shown.response.rect);
}

/// Shows the paths of the files.
fn files(ui: &mut Ui, file: &SettingsFile, out: &mut UiOutput) {
    ui.horizontal_wrapped(|ui| {
        for (name, action) in [("settings:file", Action::SettingsFile), ("settings:keys", Action::KeyFile)] {
            out.on_click(name, &ui.button(action.title()), action);
        }
    });
    if let Some(path) = file.path() {
        ui.label(RichText::new(path.display().to_string()).size(12.0).color(theme::of(ui).weak));
    }
}
