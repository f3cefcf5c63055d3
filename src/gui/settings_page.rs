//! The page of settings: every row of the settings file with its widget. Changes are written to the file at once.

use super::{
    accessible,
    actions::Action,
    fonts,
    settings::{ADDRESS, Change, Control, GAMEPADS, KEYS, Key, Number, SettingsFile, Theme},
    theme,
    ui_output::{Pick, ShellCommand, UiOutput},
};
use crate::{
    control::{midi::MidiChoice, osc::OscState},
    session::{ControlCommand, ControlsView, Session, SoundCommand},
};
use egui::{
    Align, Button, ComboBox, DragValue, Frame, Id, Layout, Margin, Modal, RichText, Role, ScrollArea, TextEdit, Ui,
    vec2,
};
use std::{
    net::IpAddr,
    time::{Duration, Instant},
};

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
    looked_at: Option<Instant>,
    /// The value of the number being dragged, and its setting.
    dragged: Option<(&'static str, f64)>,
    /// The font's path while it is typed.
    typed: Option<String>,
    /// The reason why the font that was last typed is not used.
    font_trouble: Option<String>,
    /// The address while it is typed, and whether it is invalid.
    address: Option<String>,
    is_no_address: bool,
}

/// Settings that the command line overrides.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Overridden {
    pub frame_limit: bool,
    pub osc: bool,
}

impl SettingsPage {
    pub(super) fn new() -> Self {
        Self { is_new: true, ..Self::default() }
    }

    /// Returns whether the file is to be checked now.
    pub(super) fn looks(&mut self, ui: &Ui, now: Instant) -> bool {
        ui.ctx().request_repaint_after(INTERVAL);
        let is_due = self.looked_at.is_none_or(|at| now.saturating_duration_since(at) >= INTERVAL);
        if is_due {
            self.looked_at = Some(now);
        }
        is_due
    }

    /// Applies the path of a chosen font. Returns `None` if it cannot be used, which the page then says.
    pub(super) fn choose_font(&mut self, path: &str) -> Option<Change> {
        match fonts::check(path) {
            Ok(()) => {
                (self.typed, self.font_trouble) = (None, None);
                Some(Change::CodeFont(Some(path.to_owned())))
            }
            Err(why) => {
                (self.typed, self.font_trouble) = (Some(path.to_owned()), Some(why));
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
        overridden: Overridden,
        out: &mut UiOutput,
    ) -> bool {
        let controls = session.controls_view();
        if self.is_new && controls.has_midi {
            out.ask(ControlCommand::ListMidiDevices);
        }
        if self.is_new && session.output_view().is_some() {
            out.ask(SoundCommand::ListAudioDevices);
        }
        // A machine without sound has no devices to choose from.
        let is_shown = |key: &Key| match key.control {
            Control::Device { .. } => session.output_view().is_some(),
            Control::Midi => controls.has_midi,
            Control::Recorder => false,
            _ if key.name == GAMEPADS => controls.has_gamepads,
            _ => true,
        };
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
                for key in KEYS.iter().filter(|key| is_shown(key)) {
                    let note = self.note(key, &controls, overridden);
                    ui.add_enabled_ui(file.trouble().is_none(), |ui| {
                        self.row(ui, session, key, file, note.as_deref(), out);
                    });
                }
            });
            out.place("settings:page", shown.inner_rect);
            ui.separator();
            files(ui, file, out);
        });
        self.is_new = false;
        is_open && !modal.should_close()
    }

    /// Returns a note about a setting in addition to its help.
    fn note(&self, key: &Key, controls: &ControlsView, overridden: Overridden) -> Option<String> {
        let started = |option: &str| format!("This window was started with {option}, which overrides it");
        match key.name {
            "frame-timeout" if overridden.frame_limit => Some(started("--frame-timeout")),
            "osc" | "osc-port" | "osc-address" if overridden.osc => Some(started("--osc")),
            "osc" => match controls.osc.as_ref()? {
                OscState::Missing(why) => Some(format!("OSC cannot listen: {why}")),
                OscState::Starting | OscState::Listening(_) => None,
            },
            "osc-address" if self.is_no_address => Some(format!("The address {ADDRESS}")),
            "osc-address" if controls.is_osc_public => {
                Some("Anybody on the network can move the uniforms of the open project".into())
            }
            "midi" => controls.midi.missing.clone().filter(|_| controls.choice != MidiChoice::Off),
            GAMEPADS => controls.gamepads.as_ref()?.trouble.clone(),
            _ => None,
        }
    }

    /// Shows a setting: its title and help, and its widget at the right.
    fn row(
        &mut self,
        ui: &mut Ui,
        session: &Session,
        key: &'static Key,
        file: &SettingsFile,
        note: Option<&str>,
        out: &mut UiOutput,
    ) {
        let p = theme::of(ui);
        ui.add_space(6.0);
        let wide = ui.available_width() > CONTROL + 200.0;
        let words = |ui: &mut Ui| {
            ui.spacing_mut().item_spacing.y = 2.0;
            ui.label(RichText::new(key.title).color(p.strong));
            ui.label(RichText::new(key.help).size(12.0).color(p.weak));
            if let Some(note) = note {
                ui.label(RichText::new(note).size(12.0).color(p.warning));
            }
        };
        if wide {
            ui.horizontal_top(|ui| {
                let width = ui.available_width() - CONTROL - 12.0;
                ui.allocate_ui(vec2(width, 0.0), |ui| {
                    ui.vertical(|ui| {
                        ui.set_width(width);
                        words(ui);
                    });
                });
                ui.vertical(|ui| self.control(ui, session, key, file, out));
            });
        } else {
            words(ui);
            self.control(ui, session, key, file, out);
        }
        ui.add_space(4.0);
    }

    fn control(&mut self, ui: &mut Ui, session: &Session, key: &'static Key, file: &SettingsFile, out: &mut UiOutput) {
        let settings = file.settings();
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            match &key.control {
                Control::Theme => {
                    for theme in Theme::ALL {
                        let title = match theme {
                            Theme::System => "System",
                            Theme::Dark => "Dark",
                            Theme::Light => "Light",
                        };
                        let is_on = settings.theme == theme;
                        let choice = ui.add(Button::selectable(is_on, title));
                        accessible::choice(&choice, Role::RadioButton, is_on, format!("{}: {title}", key.title));
                        if self.is_new && is_on {
                            choice.request_focus();
                        }
                        if out.clicked(&format!("setting:theme:{}", theme.name()), &choice) {
                            out.shell_commands.push(ShellCommand::Set(Change::Theme(theme)));
                        }
                    }
                }
                Control::Switch { get, change } => {
                    let mut is_on = get(settings);
                    let title = if is_on { "On" } else { "Off" };
                    let switch = ui.checkbox(&mut is_on, title);
                    accessible::choice(&switch, Role::CheckBox, is_on, key.title);
                    if out.clicked(&format!("setting:{}", key.name), &switch) {
                        out.shell_commands.push(ShellCommand::Set(change(is_on)));
                    }
                }
                Control::Number(number) => self.number(ui, key, number, (number.get)(settings), out),
                Control::Device { is_input, get, change } => {
                    let (outputs, inputs) = session.audio_devices();
                    let known = if *is_input { inputs } else { outputs };
                    device(ui, key, get(settings), known.as_deref().unwrap_or_default(), *change, out);
                }
                Control::Font => self.font(ui, key, settings.code_font.as_deref().unwrap_or_default(), out),
                Control::Address => self.address(ui, key, settings.osc_address, out),
                Control::Midi => midi(ui, key, &settings.midi, &session.controls_view(), out),
                Control::Recorder => {}
            }
            if !key.is_usual(settings) {
                let reset = ui.add(Button::new("Reset").frame(false)).on_hover_text(format!("Default: {}", key.usual));
                accessible::name(&reset, Role::Button, format!("Reset {}", key.title.to_lowercase()));
                if out.clicked(&format!("setting:{}:reset", key.name), &reset) {
                    (self.typed, self.font_trouble) = (None, None);
                    (self.address, self.is_no_address) = (None, false);
                    out.shell_commands.push(ShellCommand::Set(key.usual_change()));
                }
            }
        });
        if let (Control::Font, Some(why)) = (&key.control, &self.font_trouble) {
            let said = ui.label(RichText::new(why).size(12.0).color(theme::of(ui).error));
            out.place("setting:code-font:error", said.rect);
        }
    }

    /// Shows a number between two buttons. The setting does not change during a drag: the window would move below the
    /// pointer.
    fn number(&mut self, ui: &mut Ui, key: &'static Key, number: &Number, now: f64, out: &mut UiOutput) {
        let mut set = |value: f64| {
            out.shell_commands.push(ShellCommand::Set((number.change)(value.clamp(number.least, number.most))));
        };
        let mut wanted = None;
        let mut step = |ui: &mut Ui, sign: &str, name: &str, to: f64| {
            let is_there = to >= number.least - 1e-6 && to <= number.most + 1e-6;
            let button = ui.add_enabled(is_there, Button::new(sign).min_size(vec2(26.0, 24.0)));
            accessible::name(&button, Role::Button, format!("{name} {}", key.title.to_lowercase()));
            if button.clicked() {
                wanted = Some(to);
            }
            button.rect
        };
        let less = step(ui, "−", "Decrease", now - number.step);
        let mut value = self.dragged.filter(|(name, _)| *name == key.name).map_or(now, |(_, value)| value);
        let field = DragValue::new(&mut value).range(number.least..=number.most).speed(number.step * 0.2);
        // A number without a unit is an integer.
        let field = field
            .max_decimals(if number.unit.is_empty() { 0 } else { 2 })
            .suffix(number.unit)
            .update_while_editing(false);
        let response = ui.add_sized(vec2(76.0, 24.0), field);
        accessible::name(&response, Role::SpinButton, key.title);
        let more = step(ui, "+", "Increase", now + number.step);
        if response.dragged() {
            self.dragged = Some((key.name, value));
        } else if response.drag_stopped() {
            self.dragged = None;
            set(value);
        } else if response.changed() {
            set(value);
        }
        if let Some(to) = wanted {
            set(to);
        }
        out.place(format!("setting:{}:less", key.name), less);
        out.place(format!("setting:{}", key.name), response.rect);
        out.place(format!("setting:{}:more", key.name), more);
    }

    fn address(&mut self, ui: &mut Ui, key: &Key, now: IpAddr, out: &mut UiOutput) {
        let mut text = self.address.clone().unwrap_or_else(|| now.to_string());
        let field = TextEdit::singleline(&mut text).desired_width(150.0).background_color(theme::of(ui).button);
        let field = ui.add(field.margin(Margin::symmetric(6, 3)));
        accessible::name(&field, Role::TextInput, key.title);
        out.place(format!("setting:{}", key.name), field.rect);
        if field.changed() {
            (self.address, self.is_no_address) = (Some(text), false);
        }
        // Escape closes the page without changing the address.
        let is_given_up = ui.input(|i| i.key_pressed(egui::Key::Escape));
        let Some(typed) = (if field.lost_focus() { self.address.take() } else { None }) else { return };
        match typed.trim().parse() {
            _ if is_given_up => {}
            Ok(address) if address != now => out.shell_commands.push(ShellCommand::Set(Change::OscAddress(address))),
            Ok(_) => {}
            Err(_) => (self.address, self.is_no_address) = (Some(typed), true),
        }
    }

    fn font(&mut self, ui: &mut Ui, key: &Key, now: &str, out: &mut UiOutput) {
        let mut text = self.typed.clone().unwrap_or_else(|| now.to_owned());
        let field = TextEdit::singleline(&mut text)
            .hint_text("Built-in")
            .desired_width(130.0)
            .background_color(theme::of(ui).button);
        let field = ui.add(field.margin(Margin::symmetric(6, 3)));
        accessible::name(&field, Role::TextInput, key.title);
        out.place("setting:code-font", field.rect);
        if field.changed() {
            (self.typed, self.font_trouble) = (Some(text.clone()), None);
        }
        // Escape closes the page without changing the font.
        let is_given_up = ui.input(|i| i.key_pressed(egui::Key::Escape));
        let left = if field.lost_focus() { self.typed.take() } else { None };
        if left.is_some_and(|typed| !is_given_up && typed.trim() != now) {
            let change = match text.trim() {
                "" => Some(Change::CodeFont(None)),
                path => self.choose_font(path),
            };
            out.shell_commands.extend(change.map(ShellCommand::Set));
        }
        let choose = ui.button("Choose…").on_hover_text("Choose a font file");
        if out.clicked("setting:code-font:choose", &choose) {
            out.shell_commands.push(ShellCommand::Pick(Pick::CodeFont));
        }
    }
}

/// Shows a choice of the available devices. A chosen device that is not available stays chosen: it may come back.
fn device(
    ui: &mut Ui,
    key: &Key,
    now: Option<&str>,
    known: &[String],
    change: fn(Option<String>) -> Change,
    out: &mut UiOutput,
) {
    const DEFAULT: &str = "System default";
    let shown = ComboBox::from_id_salt(key.name).width(200.0).selected_text(now.unwrap_or(DEFAULT)).truncate().show_ui(
        ui,
        |ui| {
            let is_gone = |name: &&str| known.iter().all(|known| known != name);
            let gone = now.filter(is_gone).map(str::to_owned);
            let names = known.iter().cloned().chain(gone).map(Some);
            for (n, name) in std::iter::once(None).chain(names).enumerate() {
                let entry = ui.selectable_label(name.as_deref() == now, name.as_deref().unwrap_or(DEFAULT));
                if out.clicked(&format!("setting:{}:{n}", key.name), &entry) {
                    out.shell_commands.push(ShellCommand::Set(change(name)));
                }
            }
        },
    );
    accessible::name(&shown.response, Role::ComboBox, key.title);
    out.place(format!("setting:{}", key.name), shown.response.rect);
}

/// Shows a choice of the MIDI devices: none, all, or one. A chosen device that is not available stays chosen.
fn midi(ui: &mut Ui, key: &Key, now: &MidiChoice, controls: &ControlsView, out: &mut UiOutput) {
    let title = |choice: &MidiChoice| match choice {
        MidiChoice::Off => "Off".to_owned(),
        MidiChoice::All => "All devices".to_owned(),
        MidiChoice::Named(name) => name.clone(),
    };
    let combo = ComboBox::from_id_salt(key.name).width(200.0).selected_text(title(now)).truncate();
    let shown = combo.show_ui(ui, |ui| {
        let mut choices = vec![MidiChoice::Off, MidiChoice::All];
        choices.extend(controls.midi.names.iter().flatten().cloned().map(MidiChoice::Named));
        if !choices.contains(now) {
            choices.push(now.clone());
        }
        for (n, choice) in choices.into_iter().enumerate() {
            let entry = ui.selectable_label(choice == *now, title(&choice));
            if out.clicked(&format!("setting:{}:{n}", key.name), &entry) {
                out.shell_commands.push(ShellCommand::Set(Change::Midi(choice)));
            }
        }
    });
    accessible::name(&shown.response, Role::ComboBox, key.title);
    out.place(format!("setting:{}", key.name), shown.response.rect);
}

/// Shows what is wrong in the file, and what happens to changes.
fn trouble(ui: &mut Ui, file: &SettingsFile, out: &mut UiOutput) {
    if file.mistakes().is_empty() {
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
        for mistake in file.mistakes() {
            ui.colored_label(p.error, mistake);
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
            if out.clicked(name, &ui.button(action.title())) {
                out.act(action);
            }
        }
    });
    if let Some(path) = file.path() {
        ui.label(RichText::new(path.display().to_string()).size(12.0).color(theme::of(ui).weak));
    }
}
