//! `keybindings.toml`, which assigns other keys to actions.

use super::{Keymap, file};
use crate::gui::config_file::{ConfigError, ConfigFile, Content};
use std::sync::Arc;

/// The keys in the file, if it exists.
pub(crate) type KeyFile = ConfigFile<Arc<Keymap>>;

impl Content for Arc<Keymap> {
    const NAME: &str = "keybindings.toml";
    const STAYS: &str = "The keyboard shortcuts stay as they are.";

    fn read(text: &str) -> (Self, Vec<ConfigError>) {
        let (keymap, errors) = file::read(text);
        (Arc::new(keymap), errors)
    }

    fn template() -> String {
        file::template()
    }
}

impl KeyFile {
    pub(crate) fn keymap(&self) -> &Arc<Keymap> {
        self.content()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::actions::Action;
    use std::fs;

    #[test]
    fn the_file_is_created_once_reread_on_change_and_errors_are_reported() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("eddy").join(Arc::<Keymap>::NAME);
        let mut keys = KeyFile::at(Some(path.clone()));
        assert_eq!(keys.refresh(), [""; 0]);
        assert_eq!(keys.write_if_missing(), Ok(path.as_path()));
        assert_eq!(keys.refresh(), [""; 0]);
        assert_eq!(keys.keymap().hint(Action::Help), "F1");
        fs::write(&path, "help = \"F9\"\nhelp-me = \"F1\"\n").unwrap();
        let messages = keys.refresh();
        assert!(
            messages.len() == 1 && messages[0].starts_with(&format!("{}:2: unknown action", path.display())),
            "{messages:?}"
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
