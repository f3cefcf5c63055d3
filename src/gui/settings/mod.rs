//! The user's settings, and the window's state saved between runs.
//!
//! Both are files that people can read. `settings.toml` in the folder for settings is written by people and by the
//! window's menus, which change one line and leave the rest; `window.toml` in the folder for saved state has the
//! window's place and its layout.

mod file;
mod keys;
mod settings_file;
mod window_file;

pub(super) use keys::{ADDRESS, Change, Control, GAMEPADS, KEYS, Key, Number, Settings, Theme};
pub(super) use settings_file::SettingsFile;
pub(super) use window_file::{UsualSizes, WindowFile, WindowPlace, WindowState};
