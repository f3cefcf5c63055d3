//! The file of keys on disk: read when the window opens, and again when the window gets the keyboard and it has
//! changed.

use super::{Keymap, file};
use std::{
    fs, io,
    path::{Path, PathBuf},
    sync::Arc,
};

const NAME: &str = "keybindings.toml";

/// The keys as the file says, if there is one.
#[derive(Debug)]
pub struct KeyFile {
    /// `None` where the system has no place for settings.
    path: Option<PathBuf>,
    /// The text that was read last.
    text: Option<String>,
    keymap: Arc<Keymap>,
}

impl KeyFile {
    /// In the platform's folder for settings.
    pub fn new() -> Self {
        Self::at(dirs::config_dir().map(|folder| folder.join("eddy").join(NAME)))
    }

    fn at(path: Option<PathBuf>) -> Self {
        Self { path, text: None, keymap: Arc::default() }
    }

    pub fn keymap(&self) -> &Arc<Keymap> {
        &self.keymap
    }

    /// Reads the file if it is not what it was. What is wrong in it comes back, one line each.
    pub fn refresh(&mut self) -> Vec<String> {
        let Some(path) = &self.path else { return Vec::new() };
        let text = match fs::read_to_string(path) {
            Ok(text) => Some(text),
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(error) => return vec![format!("{}: {error}. The keys stay as they are.", path.display())],
        };
        if text == self.text {
            return Vec::new();
        }
        let (keymap, mistakes) = text.as_deref().map(file::read).unwrap_or_default();
        self.keymap = Arc::new(keymap);
        self.text = text;
        mistakes.iter().map(|m| format!("{}:{}: {}", path.display(), m.line, m.text)).collect()
    }

    /// Returns where the file is, after writing one that lists every action if there is none.
    pub fn write_if_missing(&self) -> Result<&Path, String> {
        let Some(path) = &self.path else { return Err("this system names no folder for settings".into()) };
        let failed = |error: io::Error| format!("{}: {error}", path.display());
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder).map_err(failed)?;
        }
        match fs::File::create_new(path) {
            Ok(mut new) => io::Write::write_all(&mut new, file::template().as_bytes()).map_err(failed)?,
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(failed(error)),
        }
        Ok(path)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::actions::Action;

    #[test]
    fn the_file_is_written_once_read_when_it_changed_and_told_of_when_wrong() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("eddy").join(NAME);
        let mut keys = KeyFile::at(Some(path.clone()));
        assert_eq!(keys.refresh(), [""; 0]);
        assert_eq!(keys.write_if_missing(), Ok(path.as_path()));
        assert_eq!(keys.refresh(), [""; 0]);
        assert_eq!(keys.keymap().hint(Action::Help), "F1");
        fs::write(&path, "help = \"F9\"\nhelp-me = \"F1\"\n").unwrap();
        let told = keys.refresh();
        assert!(
            told.len() == 1 && told[0].starts_with(&format!("{}:2: there is no action", path.display())),
            "{told:?}"
        );
        assert_eq!(keys.keymap().hint(Action::Help), "F9");
        assert_eq!(keys.refresh(), [""; 0], "told once");
        keys.write_if_missing().unwrap();
        assert!(fs::read_to_string(&path).unwrap().starts_with("help = "), "a file that is there stays as it is");
        fs::remove_file(&path).unwrap();
        keys.refresh();
        assert_eq!(keys.keymap().hint(Action::Help), "F1");
    }
}
