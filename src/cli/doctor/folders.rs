//! The folders that Eddy keeps files in, and whether they can be written.

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
    /// `None`: the system has no such folder.
    pub path: Option<String>,
    pub state: FolderState,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum FolderState {
    Writable,
    /// It is there, and no file can be made in it.
    ReadOnly,
    /// It is not there yet; Eddy makes it when it needs it, which the folder above allows.
    CanBeMade,
    /// It is not there, and cannot be made.
    CannotBeMade,
    Unknown,
}

/// Lists them. A file is made in each that is there, and removed.
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

/// Returns the reports of panics that are there, the newest last.
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
    fn a_folder_that_is_there_is_writable_and_left_as_it_was() {
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
