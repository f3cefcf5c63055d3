//! `settings.toml`, which the window reads and changes line by line.

use super::{
    file,
    rows::{Change, Settings},
};
use crate::gui::config_file::{ConfigError, ConfigFile, Content};

/// The settings in the file, if it exists.
pub(crate) type SettingsFile = ConfigFile<Settings>;

impl Content for Settings {
    const NAME: &str = "settings.toml";
    const STAYS: &str = "The settings stay as they are.";

    fn read(text: &str) -> (Self, Vec<ConfigError>) {
        file::read(text)
    }

    fn template() -> String {
        file::template()
    }
}

impl SettingsFile {
    pub(crate) fn settings(&self) -> &Settings {
        self.content()
    }

    /// Changes a setting here and in the file. Returns why it could not be saved; it then applies until the window
    /// closes.
    pub(crate) fn change(&mut self, change: Change) -> Result<(), String> {
        let change = change.fitted();
        change.apply(self.content_mut());
        self.edit(|text| file::change(text, &change), "The setting applies until the window closes.")
    }

    /// Returns why no setting can be written: the file cannot be read or parsed.
    pub(crate) fn trouble(&self) -> Option<&str> {
        let is_broken = self.text().is_some_and(|text| toml_edit::Document::parse(text).is_err());
        let why = self.errors().first().filter(|_| is_broken || self.is_unreadable());
        why.map(String::as_str)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        control::midi::MidiChoice,
        gui::settings::{Theme, rows::SETTINGS},
    };
    use std::fs;

    #[test]
    fn a_change_is_saved_and_external_edits_are_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("eddy").join(Settings::NAME);
        let mut file = SettingsFile::at(Some(path.clone()));
        assert_eq!((file.refresh(), file.settings()), (vec![], &Settings::default()));
        file.change(Change::Theme(Theme::Light)).unwrap();
        let mut next = SettingsFile::at(Some(path.clone()));
        assert_eq!(next.refresh(), [""; 0]);
        assert_eq!(next.settings().theme, Theme::Light);
        fs::write(&path, "zoom = 2.0 # mine\nthem = 1\n").unwrap();
        let messages = file.refresh();
        assert!(
            messages.len() == 1 && messages[0].starts_with(&format!("{}:2: unknown setting", path.display())),
            "{messages:?}"
        );
        assert_eq!((file.settings().zoom, file.settings().theme), (2.0, Theme::System));
        assert_eq!(file.refresh(), [""; 0], "told once");
        assert_eq!((file.trouble(), file.errors().len()), (None, 1));
        // A change that another program wrote takes effect and is not overwritten by a change here.
        fs::write(&path, "zoom = 3.0 # theirs\ncode-size = 20.0\n").unwrap();
        file.change(Change::WordWrap(true)).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "zoom = 3.0 # theirs\ncode-size = 20.0\nword-wrap = true\n");
        let now = file.settings();
        assert_eq!((now.zoom, now.code_size, now.word_wrap), (3.0, 20.0, true));
        assert!(file.errors().is_empty());
        file.change(Change::WordWrap(false)).unwrap();
        fs::write(&path, "zoom = = 2\n").unwrap();
        let why = file.change(Change::WordWrap(true)).unwrap_err();
        assert!(why.starts_with(&format!("{}:1: ", path.display())), "{why}");
        assert!(file.settings().word_wrap, "it holds all the same");
        assert_eq!(fs::read_to_string(&path).unwrap(), "zoom = = 2\n", "a file that is not understood stays as it is");
        assert_eq!(file.refresh().len(), 1);
        assert!(file.trouble().is_some_and(|why| why.starts_with(&format!("{}:1: ", path.display()))));
    }

    #[test]
    fn settings_of_earlier_versions_are_read_and_written_the_same() {
        let all = include_str!("../../../tests/saved/settings/all.toml");
        let (settings, errors) = file::read(all);
        assert_eq!(errors, []);
        for setting in SETTINGS {
            assert!(!setting.is_default(&settings), "{} is not in the file", setting.key);
            assert_eq!(file::change(all, &(setting.current)(&settings)).unwrap(), all, "{}", setting.key);
        }
        let (settings, errors) = file::read(include_str!("../../../tests/saved/settings/few.toml"));
        assert_eq!(errors, []);
        assert_eq!((settings.theme, settings.midi), (Theme::Light, MidiChoice::All));
    }
}
