//! `settings.toml` on disk: read when the window opens, and again when the window gets the keyboard and it has changed.

use super::{
    file,
    keys::{Change, Settings},
};
use std::{
    fs,
    io::{self, Write},
    path::{Path, PathBuf},
};

const NAME: &str = "settings.toml";

#[derive(Debug)]
pub struct SettingsFile {
    /// `None` where the system has no place for settings.
    path: Option<PathBuf>,
    /// The text that was read last.
    text: Option<String>,
    settings: Settings,
}

impl SettingsFile {
    /// In the platform's folder for settings.
    pub fn new() -> Self {
        Self::at(dirs::config_dir().map(|folder| folder.join("eddy").join(NAME)))
    }

    fn at(path: Option<PathBuf>) -> Self {
        Self { path, text: None, settings: Settings::default() }
    }

    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Reads the file if it is not what it was. What is wrong in it comes back, one line each.
    pub fn refresh(&mut self) -> Vec<String> {
        let Some(path) = &self.path else { return Vec::new() };
        let text = match fs::read_to_string(path) {
            Ok(text) => Some(text),
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(error) => return vec![format!("{}: {error}. The settings stay as they are.", path.display())],
        };
        if text == self.text {
            return Vec::new();
        }
        let (settings, mistakes) = text.as_deref().map(file::read).unwrap_or_default();
        self.settings = settings;
        self.text = text;
        mistakes.iter().map(|m| format!("{}:{}: {}", path.display(), m.line, m.text)).collect()
    }

    /// Changes a setting, here and in the file. Err: why it is not in the file, and so holds until the window closes.
    pub fn change(&mut self, change: Change) -> Result<(), String> {
        change.apply(&mut self.settings);
        let Some(path) = self.path.clone() else { return Ok(()) };
        let failed =
            |error: io::Error| format!("{}: {error}. The setting holds until the window closes.", path.display());
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == io::ErrorKind::NotFound => file::template(),
            Err(error) => return Err(failed(error)),
        };
        let text = file::change(&text, change).map_err(|m| format!("{}:{}: {}", path.display(), m.line, m.text))?;
        write(&path, &text).map_err(failed)?;
        self.text = Some(text);
        Ok(())
    }

    /// Returns where the file is, after writing one that lists every setting if there is none.
    pub fn write_if_missing(&self) -> Result<&Path, String> {
        let Some(path) = &self.path else { return Err("this system names no folder for settings".into()) };
        if !path.exists() {
            write(path, &file::template()).map_err(|error| format!("{}: {error}", path.display()))?;
        }
        Ok(path)
    }
}

/// Writes a file whole or not at all.
pub(super) fn write(path: &Path, text: &str) -> io::Result<()> {
    // Where it is a link, to what it leads to: people keep such files elsewhere.
    let path = &path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let folder = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder)?;
    let mut new = tempfile::NamedTempFile::new_in(folder)?;
    new.write_all(text.as_bytes())?;
    new.persist(path)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::settings::Theme;

    #[test]
    fn a_change_is_kept_and_what_a_person_writes_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("eddy").join(NAME);
        let mut file = SettingsFile::at(Some(path.clone()));
        assert_eq!((file.refresh(), file.settings()), (vec![], &Settings::default()));
        file.change(Change::Theme(Theme::Light)).unwrap();
        let mut next = SettingsFile::at(Some(path.clone()));
        assert_eq!(next.refresh(), [""; 0]);
        assert_eq!(next.settings().theme, Theme::Light);
        fs::write(&path, "zoom = 2.0 # mine\nthem = 1\n").unwrap();
        let told = file.refresh();
        assert!(
            told.len() == 1 && told[0].starts_with(&format!("{}:2: there is no setting", path.display())),
            "{told:?}"
        );
        assert_eq!((file.settings().zoom, file.settings().theme), (2.0, Theme::System));
        assert_eq!(file.refresh(), [""; 0], "told once");
        fs::write(&path, "zoom = = 2\n").unwrap();
        let why = file.change(Change::WordWrap(true)).unwrap_err();
        assert!(why.starts_with(&format!("{}:1: ", path.display())), "{why}");
        assert!(file.settings().word_wrap, "it holds all the same");
        assert_eq!(fs::read_to_string(&path).unwrap(), "zoom = = 2\n", "a file that is not understood stays as it is");
    }
}
