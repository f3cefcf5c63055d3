//! The place of the open project, and its new place after it was renamed.

use eddy_project::Origin;
use std::{
    fs,
    path::{Path, PathBuf},
    time::SystemTime,
};

/// The number of entries of a folder that are searched for a renamed project.
const SEARCHED: usize = 10_000;

/// The file or folder of a project, as it was when it was last read or written.
#[derive(Clone, Debug)]
pub(super) struct Home {
    path: PathBuf,
    is_folder: bool,
    /// `None` on systems that do not number files.
    identity: Option<Identity>,
}

/// Identifies a file or folder whatever its name: the device, the inode, and the time of creation where the file system
/// records it, because the inode of a deleted file is used for new ones.
type Identity = (u64, u64, Option<SystemTime>);

#[cfg(unix)]
fn identity(path: &Path) -> Option<Identity> {
    use std::os::unix::fs::MetadataExt;
    let metadata = fs::metadata(path).ok()?;
    Some((metadata.dev(), metadata.ino(), metadata.created().ok()))
}

/// The standard library does not offer the file index of Windows yet: a renamed project is reported as moved.
#[cfg(not(unix))]
fn identity(_: &Path) -> Option<Identity> {
    None
}

impl Home {
    /// `None` for a project that is not stored in files.
    pub(super) fn of(origin: &Origin) -> Option<Home> {
        let (path, is_folder) = match origin {
            Origin::Folder { path, .. } => (path, true),
            Origin::File(path) | Origin::Json(path) => (path, false),
            Origin::Unsaved | Origin::Preset(_) => return None,
        };
        // Relative to where Eddy was started: the search needs the names of the folders above.
        let path = std::path::absolute(path).unwrap_or_else(|_| path.clone());
        Some(Home { identity: identity(&path), path, is_folder })
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    pub(super) fn is_folder(&self) -> bool {
        self.is_folder
    }

    /// Returns whether the project is where it was. `files`: the files that it consists of. A folder of the same name
    /// without any of them is another one, such as the mount point of a drive that was unmounted.
    pub(super) fn is_there<'a>(&self, mut files: impl Iterator<Item = &'a Path>) -> bool {
        let is_same = self.identity.is_some() && identity(&self.path) == self.identity;
        let is_kind = self.path.exists() && self.path.is_dir() == self.is_folder;
        is_kind && (is_same || !self.is_folder || files.any(Path::exists))
    }

    /// Returns the new place of a project that was renamed, or that is in a folder that was renamed.
    pub(super) fn renamed(&self) -> Option<PathBuf> {
        let wanted = self.identity?;
        let (mut missing, mut below) = (self.path.as_path(), PathBuf::new());
        let parent = loop {
            let parent = missing.parent()?;
            if parent.is_dir() {
                break parent;
            }
            below = Path::new(missing.file_name()?).join(&below);
            missing = parent;
        };
        let entries = fs::read_dir(parent).ok()?.flatten().take(SEARCHED);
        let candidates = entries.map(|entry| match below.as_os_str().is_empty() {
            true => entry.path(),
            false => entry.path().join(&below),
        });
        let is_it = |path: &PathBuf| path.extension() == self.path.extension() || self.is_folder;
        candidates.filter(is_it).find(|path| identity(path) == Some(wanted))
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn home(path: &Path) -> Home {
        Home::of(&Origin::Folder { path: path.to_owned(), has_manifest: false }).unwrap()
    }

    #[test]
    fn a_renamed_folder_and_one_in_a_renamed_folder_are_found() {
        let dir = tempfile::tempdir().unwrap();
        let at = |name: &str| dir.path().join(name);
        fs::create_dir_all(at("a/b/project")).unwrap();
        let home = home(&at("a/b/project"));
        assert!(home.is_there(std::iter::empty()));
        fs::rename(at("a/b/project"), at("a/b/other")).unwrap();
        fs::create_dir(at("a/b/bystander")).unwrap();
        assert_eq!((home.is_there(std::iter::empty()), home.renamed()), (false, Some(at("a/b/other"))));
        fs::rename(at("a/b/other"), at("a/b/project")).unwrap();
        fs::rename(at("a"), at("c")).unwrap();
        assert_eq!(home.renamed(), Some(at("c/b/project")));
        fs::remove_dir_all(at("c")).unwrap();
        assert_eq!(home.renamed(), None);
    }

    #[test]
    fn an_empty_folder_of_the_same_name_is_another_one() {
        let dir = tempfile::tempdir().unwrap();
        let (path, file) = (dir.path().join("project"), dir.path().join("project/image.glsl"));
        fs::create_dir(&path).unwrap();
        let home = home(&path);
        // The new one exists before the old one is removed, so that it has another inode.
        fs::create_dir(dir.path().join("new")).unwrap();
        fs::remove_dir(&path).unwrap();
        fs::rename(dir.path().join("new"), &path).unwrap();
        assert!(!home.is_there([file.as_path()].into_iter()), "a mount point, after its drive was unmounted");
        fs::write(&file, "x").unwrap();
        assert!(home.is_there([file.as_path()].into_iter()), "a copy of the project");
    }
}
