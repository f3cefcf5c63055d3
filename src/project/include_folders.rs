//! Folders of libraries, such as lygia, in which included files are found that the project's own folder lacks.

use super::confine;
use std::{
    env,
    path::{Path, PathBuf},
};

/// The environment variable with these folders, separated as in `PATH`.
pub const INCLUDE_VARIABLE: &str = "EDDY_INCLUDE";

/// The setting with one more folder. It is in the file of the window's settings, and every command reads it, so that
/// the window, the command line and the language server find the same files.
pub const INCLUDE_SETTING: &str = "include-folder";

/// Returns the folders in the order in which they are searched.
pub(super) fn all() -> Vec<PathBuf> {
    let mut folders: Vec<PathBuf> =
        env::var_os(INCLUDE_VARIABLE).map_or_else(Vec::new, |folders| env::split_paths(&folders).collect());
    folders.extend(dirs::config_dir().and_then(|folder| of_settings(&folder.join("eddy").join("settings.toml"))));
    folders
}

/// Returns the folder that a file of settings names. An invalid file names none: the window reports its errors.
fn of_settings(file: &Path) -> Option<PathBuf> {
    let text = confine::read_state_toml(file).ok()??;
    let document = toml_edit::Document::parse(text).ok()?;
    let folder = document.get(INCLUDE_SETTING)?.as_str().filter(|folder| !folder.is_empty())?;
    Some(expand_home(folder))
}

/// Returns a path with the home folder in place of a `~/` at its start.
pub fn expand_home(path: &str) -> PathBuf {
    match (path.strip_prefix("~/"), env::home_dir()) {
        (Some(rest), Some(home)) => home.join(rest),
        _ => PathBuf::from(path),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn the_folder_is_read_from_the_file_of_settings() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("settings.toml");
        assert_eq!(of_settings(&file), None);
        let folder = |text: &str| {
            fs::write(&file, text).unwrap();
            of_settings(&file)
        };
        assert_eq!(folder("zoom = 2\ninclude-folder = \"/lib\" # lygia\n"), Some("/lib".into()));
        assert_eq!(folder("include-folder = \"~/lib\""), Some(env::home_dir().unwrap().join("lib")));
        for text in ["include-folder = \"\"", "include-folder = 3", "include-folder =", "# include-folder = \"/lib\""] {
            assert_eq!(folder(text), None, "{text}");
        }
    }
}
