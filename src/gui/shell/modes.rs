//! Modes in which the window shows something else than its panels, and what is open over them.

use crate::gui::{actions::KeyFocus, help::Help, palette::Palette, settings_page::SettingsPage};

/// Modes in which the window shows something else than its panels.
#[derive(Clone, Copy, Default)]
pub(super) struct Modes {
    /// The page of presets. It has priority over the others.
    pub gallery: bool,
    /// The code over a picture that fills the window.
    pub code_over_picture: bool,
    /// The picture alone.
    pub fullscreen: bool,
}

/// Dialogs over the panels.
#[derive(Default)]
pub(super) struct Overlays {
    pub help: Option<Help>,
    pub settings_page: Option<SettingsPage>,
    pub palette: Palette,
    /// The keyboard focus before one of them was opened, which the keys that they show are for.
    before: KeyFocus,
}

impl Overlays {
    /// Returns the keyboard focus below what is open. `now`: the current one.
    pub(super) fn focus_below(&mut self, now: KeyFocus) -> KeyFocus {
        if !self.is_any_open() {
            self.before = now;
        }
        self.before
    }

    pub(super) fn is_any_open(&self) -> bool {
        self.help.is_some() || self.settings_page.is_some() || self.palette.is_open()
    }
}
