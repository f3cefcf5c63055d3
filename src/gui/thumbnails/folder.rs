//! Lists the files of a project's folder that a channel can read.

use crate::project::{FileKind, kind_of_file};
use std::path::{Path, PathBuf};

/// The maximum number of folder entries that are visited, and of files that are listed: a folder of frames has
/// thousands.
const MAX_ENTRIES: usize = 4_000;
const LISTED: usize = 60;

/// A file that a channel can read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct FolderFile {
    /// Relative to the folder.
    pub path: PathBuf,
    pub kind: FileKind,
}

/// Returns the image, video and sound files of a folder and of its subfolders, sorted by name.
pub(super) fn files(folder: &Path) -> Vec<FolderFile> {
    let mut left = MAX_ENTRIES;
    let mut found = Vec::new();
    let folders = list_folder(folder, Path::new(""), &mut left, &mut found);
    for inner in folders {
        list_folder(&folder.join(&inner), &inner, &mut left, &mut found);
    }
    found.sort_by(|a, b| a.path.cmp(&b.path));
    found.truncate(LISTED);
    found
}

/// Adds the files of one folder, and returns its subfolders. Symbolic links are skipped: their targets may be
/// anywhere.
fn list_folder(folder: &Path, from: &Path, left: &mut usize, found: &mut Vec<FolderFile>) -> Vec<PathBuf> {
    let mut folders = Vec::new();
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let Some(rest) = left.checked_sub(1) else { break };
        *left = rest;
        let (name, Ok(ty)) = (entry.file_name(), entry.file_type()) else { continue };
        let path = from.join(&name);
        if name.as_encoded_bytes().starts_with(b".") {
            continue;
        } else if ty.is_dir() {
            folders.push(path);
        } else if ty.is_file() {
            let kind = kind_of_file(&path);
            if matches!(kind, FileKind::Picture | FileKind::Video | FileKind::Sound) {
                found.push(FolderFile { path, kind });
            }
        }
    }
    folders.sort();
    folders
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readable_files_are_found_one_folder_deep() {
        let dir = tempfile::tempdir().unwrap();
        std::fs::create_dir_all(dir.path().join("media/deep")).unwrap();
        for name in ["b.png", "image.glsl", "eddy.toml", "media/a.MP3", "media/deep/c.png", ".hidden.png", "clip.webm"]
        {
            std::fs::write(dir.path().join(name), "").unwrap();
        }
        let file = |path: &str, kind| FolderFile { path: path.into(), kind };
        let wanted = [
            file("b.png", FileKind::Picture),
            file("clip.webm", FileKind::Video),
            file("media/a.MP3", FileKind::Sound),
        ];
        assert_eq!(files(dir.path()), wanted);
        for n in 0..LISTED + 10 {
            std::fs::write(dir.path().join(format!("frame{n:03}.png")), "").unwrap();
        }
        assert_eq!(files(dir.path()).len(), LISTED);
        assert_eq!(files(&dir.path().join("missing")), []);
    }
}
