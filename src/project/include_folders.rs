//! Folders of libraries, such as lygia, in which included files are found that the project's own folder lacks.

use std::{path::PathBuf, sync::OnceLock};

static FOLDERS: OnceLock<Vec<PathBuf>> = OnceLock::new();

/// Sets the folders, once for the process: from then on they do not change, so that every reading of a project finds the
/// same files. Later calls have no effect.
pub fn set_include_folders(folders: Vec<PathBuf>) {
    let _ = FOLDERS.set(folders);
}

/// Returns the folders in the order in which they are searched.
pub(super) fn all() -> &'static [PathBuf] {
    FOLDERS.get().map_or(&[], Vec::as_slice)
}
