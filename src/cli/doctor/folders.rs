//! The folders that Eddy stores files in, and whether they are writable.

use crate::session::{self, home_as_tilde};
use serde::Serialize;
use std::{
    env, fs,
    path::{Path, PathBuf},
};

/// A folder and its state.
#[derive(Debug, PartialEq, Eq, Serialize)]
pub(super) struct FolderLine {
    pub what: &'static str,
    /// `None` if the system has no such folder.
    pub path: Option<String>,
    pub state: FolderState,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum FolderState {
    Writable,
    /// It exists, but no file can be created in it.
    ReadOnly,
    /// It does not exist; Eddy creates it when needed, which the parent folder allows.
    CanBeMade,
    /// It does not exist, and cannot be created.
    CannotBeMade,
    Unknown,
}

/// Lists them. Creates and removes a file in each that exists.
pub(super) fn all() -> Vec<FolderLine> {
    let eddy = |folder: Option<PathBuf>| folder.map(|folder| folder.join("eddy"));
    [
        ("settings", eddy(dirs::config_dir())),
        ("cache", eddy(dirs::cache_dir())),
        ("state", eddy(dirs::state_dir().or_else(dirs::data_local_dir))),
        ("recovery", session::recovery_folder()),
        ("reports", session::report_folder()),
        ("screenshots", dirs::picture_dir().or_else(dirs::home_dir)),
        ("temporary files", Some(env::temp_dir())),
    ]
    .into_iter()
    .map(|(what, path)| FolderLine {
        what,
        state: path.as_deref().map_or(FolderState::Unknown, state),
        path: path.map(|path| home_as_tilde(&path.display().to_string())),
    })
    .collect()
}

fn state(folder: &Path) -> FolderState {
    if folder.is_dir() {
        return if can_write(folder) { FolderState::Writable } else { FolderState::ReadOnly };
    }
    let above = folder.ancestors().skip(1).find(|above| above.exists());
    if above.is_some_and(|above| above.is_dir() && can_write(above)) {
        FolderState::CanBeMade
    } else {
        FolderState::CannotBeMade
    }
}

fn can_write(folder: &Path) -> bool {
    tempfile::Builder::new().prefix(".eddy-doctor").tempfile_in(folder).is_ok()
}

/// Returns the existing reports of panics, the newest last.
pub(super) fn reports() -> Vec<String> {
    let Some(folder) = session::report_folder() else { return Vec::new() };
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut all: Vec<String> = entries.map(|entry| home_as_tilde(&entry.path().display().to_string())).collect();
    all.retain(|path| path.ends_with(".txt"));
    all.sort();
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_existing_folder_is_writable_and_left_unchanged() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(state(folder.path()), FolderState::Writable);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
        assert_eq!(state(&folder.path().join("a/b")), FolderState::CanBeMade);
        assert!(!folder.path().join("a").exists());
        let file = folder.path().join("file");
        fs::write(&file, "").unwrap();
        assert_eq!(state(&file.join("below")), FolderState::CannotBeMade);
    }
}
