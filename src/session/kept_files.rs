//! Folders that contain a file per project, named by a hash of the project's path, from which the oldest are removed.

use eddy_project::Origin;
use std::{
    fs,
    hash::{DefaultHasher, Hash, Hasher},
    path::{Path, PathBuf},
    time::SystemTime,
};

/// Returns the path of a project; `None` if it is not stored in a file.
pub(super) fn path_of(origin: &Origin) -> Option<&Path> {
    let (Origin::Folder { path, .. } | Origin::File(path) | Origin::Json(path)) = origin else { return None };
    Some(path)
}

/// Returns the file name for a project, independent of how its path was written.
pub(super) fn name(path: &Path, extension: &str) -> String {
    let mut hasher = DefaultHasher::new();
    path.canonicalize().unwrap_or_else(|_| path.to_owned()).hash(&mut hasher);
    format!("{:016x}.{extension}", hasher.finish())
}

/// Removes the oldest files if there are more than `most`.
pub(super) fn sweep(folder: &Path, extension: &str, most: usize) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    let is_ours = |path: &PathBuf| path.extension().is_some_and(|e| e == extension);
    let files = entries.flatten().map(|entry| entry.path()).filter(is_ours);
    let written = |path: &PathBuf| path.metadata().and_then(|meta| meta.modified()).unwrap_or(SystemTime::UNIX_EPOCH);
    let mut files: Vec<(SystemTime, PathBuf)> = files.map(|path| (written(&path), path)).collect();
    files.sort();
    for (_, path) in files.iter().take(files.len().saturating_sub(most)) {
        if let Err(e) = fs::remove_file(path) {
            log::warn!("cannot remove {}: {e}", path.display());
        }
    }
}
