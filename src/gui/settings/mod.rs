//! The user's settings, and the window's state saved between runs.
//!
//! Both are files that people can read. `settings.toml` in the folder for settings is written by people and by the
//! window's menus, which change one line and leave the rest; `window.toml` in the folder for saved state has the
//! window's place and its layout.

mod file;
mod kind;
mod rows;
mod settings_file;
mod values;
mod window_file;

pub(super) use kind::{Kind, Number};
pub(super) use rows::{Change, Overrides, SETTINGS, Setting, Settings, commands};
pub(super) use settings_file::SettingsFile;
pub(super) use values::{MIDI_ALL, MIDI_OFF, Plain, Theme};
pub(super) use window_file::{RestoredSizes, WindowFile, WindowPlace, WindowState};

#[cfg(test)]
mod tests;
