//! The user's files, keyboard shortcuts and settings: reads them when the window is back, and puts settings into effect.

use crate::{
    gui::{
        actions::KeyFile,
        code::CodePanel,
        fonts,
        settings::{self, Overrides, Settings, SettingsFile, Theme},
    },
    session::{Command, Level, NoticeCommand},
};
use egui::Ui;

pub(super) struct Config {
    pub keys: KeyFile,
    pub settings_file: SettingsFile,
    pub overrides: Overrides,
    /// The settings last applied.
    in_effect: Option<Settings>,
    /// The window had the keyboard focus in the previous frame.
    was_focused: bool,
}

impl Config {
    pub(super) fn new() -> Self {
        Self {
            keys: KeyFile::new(),
            settings_file: SettingsFile::new(),
            overrides: Overrides::default(),
            in_effect: None,
            was_focused: false,
        }
    }

    pub(super) fn settings(&self) -> &Settings {
        self.settings_file.settings()
    }

    /// Returns whether the window has just received the keyboard focus.
    pub(super) fn is_back(&mut self, ui: &Ui) -> bool {
        let is_focused = ui.input(|i| i.focused);
        !std::mem::replace(&mut self.was_focused, is_focused) && is_focused
    }

    /// Reads the files, and returns the errors in them.
    pub(super) fn refresh(&mut self) -> Vec<String> {
        let mut errors = self.keys.refresh();
        errors.extend(self.settings_file.refresh());
        errors
    }

    /// Returns whether an error that was reported for one of the files is fixed.
    pub(super) fn is_fixed(&self, text: &str) -> bool {
        self.keys.is_fixed(text) || self.settings_file.is_fixed(text)
    }

    /// Applies the settings that have changed, and returns the commands for the session.
    pub(super) fn apply(&mut self, ctx: &egui::Context, code: &mut CodePanel) -> Vec<Command> {
        let settings = self.settings_file.settings();
        let before = self.in_effect.replace(settings.clone());
        if before.as_ref() == Some(settings) {
            return Vec::new();
        }
        ctx.set_theme(match settings.theme {
            Theme::System => egui::ThemePreference::System,
            Theme::Dark => egui::ThemePreference::Dark,
            Theme::Light => egui::ThemePreference::Light,
        });
        ctx.set_zoom_factor(settings.zoom);
        code.set_look(settings.code_size, settings.word_wrap);
        let mut commands = settings::commands(before.as_ref(), settings, &self.overrides);
        if before.as_ref().map(|before| &before.code_font) != Some(&settings.code_font)
            && let Err(text) = fonts::set(ctx, settings.code_font.as_deref())
        {
            commands.push(Command::Notice(NoticeCommand::Notify { level: Level::Error, text, path: None }));
        }
        ctx.request_repaint();
        commands
    }
}
