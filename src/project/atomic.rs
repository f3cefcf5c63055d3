//! Atomic file writes.
//!
//! New content goes to a temporary file next to the old one, is flushed to the device and then renamed over the old
//! file. Several files are all staged before the first is renamed, so that a full disk is detected while every old file
//! still exists.
//!
//! A killed process leaves its temporary files in the folder. Each is locked while in use, and a lock ends with its
//! process: unlocked files are removed the next time Eddy opens or writes the folder (see [`sweep`]).

use super::{
    ProjectError,
    confine::{self, Reason},
    limits,
    writes::place_within,
};
use std::{
    collections::BTreeSet,
    fs,
    io::{self, Write},
    path::{Path, PathBuf},
};
use tempfile::NamedTempFile;

/// The prefix of a temporary file's name; six letters and digits follow.
const PREFIX: &str = ".eddy-save-";
const SUFFIX: &str = ".tmp";

pub(crate) enum Content {
    Bytes(Vec<u8>),
    /// A copy of a file of a project's folder: the folder, and the name in it.
    CopyOf(PathBuf, String),
}

impl Content {
    fn read(&self) -> Result<std::borrow::Cow<'_, [u8]>, ProjectError> {
        Ok(match self {
            Content::Bytes(bytes) => bytes.into(),
            Content::CopyOf(folder, name) => confine::read(folder, name, limits::MEDIA_FILE)?.into(),
        })
    }
}

pub(crate) enum FileComparison {
    Absent,
    Same,
    Different,
}

/// Compares the file at a path with the content to be written.
pub(crate) fn compare(path: &Path, content: &Content) -> Result<FileComparison, ProjectError> {
    let content = content.read()?;
    match confine::read_own(path, confine::exactly(content.len())) {
        Ok(bytes) => Ok(if *content == bytes { FileComparison::Same } else { FileComparison::Different }),
        Err(e) if e.is_missing() => Ok(FileComparison::Absent),
        Err(e) if matches!(e.reason, Reason::TooLarge(_)) => Ok(FileComparison::Different),
        Err(e) => Err(e.into()),
    }
}

/// Writes every file, creating folders as needed.
pub(crate) fn write_all(files: Vec<(PathBuf, Content)>) -> Result<(), ProjectError> {
    let folders: BTreeSet<PathBuf> = files.iter().map(|(path, _)| folder_of(path).to_owned()).collect();
    folders.iter().for_each(|folder| sweep(folder));
    let mut staged = Vec::new();
    for (path, content) in files {
        let path = real_path(path);
        let file = stage(&path, |file| file.write_all(&content.read().map_err(io::Error::other)?));
        staged.push((file.map_err(ProjectError::io("write", &path))?, path));
    }
    for (file, path) in staged {
        take_place(file, &path).map_err(ProjectError::io("write", &path))?;
    }
    Ok(())
}

/// Writes one file: the old content stays until the new content is complete. Errors do not name the file.
pub fn write_with(path: &Path, write: impl FnOnce(&mut fs::File) -> io::Result<()>) -> io::Result<()> {
    let path = real_path(path.to_owned());
    sweep(folder_of(&path));
    take_place(stage(&path, write)?, &path)
}

/// Writes one file whose path was checked. A link that has appeared at the path since is replaced, not followed.
pub(super) fn write_over(path: &Path, write: impl FnOnce(&mut fs::File) -> io::Result<()>) -> io::Result<()> {
    sweep(folder_of(path));
    take_place(stage(path, write)?, path)
}

/// A file that is being written next to the path it replaces when complete. If dropped before that, it is deleted and
/// the old file stays.
pub struct Staged {
    file: NamedTempFile,
    path: PathBuf,
}

impl Staged {
    /// Creates an empty file next to `path`, and the folder if it does not exist. Errors do not name the file.
    pub fn new(path: &Path) -> io::Result<Staged> {
        let path = real_path(path.to_owned());
        sweep(folder_of(&path));
        Ok(Staged { file: create_temporary(&path)?, path })
    }

    /// Does the same for a file in a folder whose name the user did not choose, like [`write_into`](super::write_into):
    /// no link leads out of the folder.
    pub fn within(path: &Path) -> io::Result<Staged> {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let path = place_within(folder_of(path), &name)?;
        sweep(folder_of(&path));
        Ok(Staged { file: create_temporary(&path)?, path })
    }

    /// The temporary file, open for writing.
    pub fn file(&mut self) -> &mut fs::File {
        // Bypass the wrapper, whose errors name the temporary file, which means nothing to users.
        self.file.as_file_mut()
    }

    /// The temporary file's path, for a program that writes it. On Windows no other process can write a locked file.
    pub fn path(&self) -> &Path {
        #[cfg(windows)]
        let _ = self.file.as_file().unlock();
        self.file.path()
    }

    /// Syncs the content to disk and renames the file to its path.
    pub fn commit(self) -> io::Result<()> {
        let file = complete(self.file, &self.path)?;
        take_place(file, &self.path)
    }

    /// Does the same if no file exists at the path, and fails otherwise.
    pub fn commit_new(self) -> io::Result<()> {
        let file = complete(self.file, &self.path)?;
        file.persist_noclobber(&self.path).map_err(|e| e.error)?;
        sync_folder(&self.path);
        Ok(())
    }
}

/// Returns the target of a symbolic link, so that the link stays a link.
fn real_path(path: PathBuf) -> PathBuf {
    if path.is_symlink() { path.canonicalize().unwrap_or(path) } else { path }
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn stage(path: &Path, write: impl FnOnce(&mut fs::File) -> io::Result<()>) -> io::Result<NamedTempFile> {
    let mut file = create_temporary(path)?;
    // Bypass the wrapper, whose errors name the temporary file, which means nothing to users.
    write(file.as_file_mut())?;
    complete(file, path)
}

/// Creates an empty temporary file for a path.
fn create_temporary(path: &Path) -> io::Result<NamedTempFile> {
    let folder = folder_of(path);
    fs::create_dir_all(folder)?;
    let old = fs::metadata(path).ok();
    // Renaming would replace a write-protected file without asking.
    if old.as_ref().is_some_and(|m| m.permissions().readonly()) {
        return Err(io::Error::new(io::ErrorKind::PermissionDenied, "the file is write-protected"));
    }
    temporary(folder, old.is_none())
}

/// Syncs the content to disk, with the permissions of the file that it replaces.
fn complete(file: NamedTempFile, path: &Path) -> io::Result<NamedTempFile> {
    if let Ok(old) = fs::metadata(path) {
        file.as_file().set_permissions(old.permissions())?;
    }
    file.as_file().sync_all()?;
    Ok(file)
}

/// Creates a locked file, which [`sweep`] ignores.
fn temporary(folder: &Path, is_new: bool) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX);
    #[cfg(unix)]
    if is_new {
        // The permissions that the user's umask gives any new file; a temporary file would be private to its owner.
        builder.permissions(<fs::Permissions as std::os::unix::fs::PermissionsExt>::from_mode(0o666));
    }
    #[cfg(not(unix))]
    let _ = is_new;
    loop {
        let file = builder.tempfile_in(folder).map_err(|e| io::Error::from(e.kind()))?;
        // Another Eddy process may have swept it before it was locked.
        if file.as_file().lock().is_err() || file.path().exists() {
            return Ok(file);
        }
    }
}

fn take_place(file: NamedTempFile, path: &Path) -> io::Result<()> {
    file.persist(path).map_err(|e| e.error)?;
    sync_folder(path);
    Ok(())
}

/// Removes the temporary files that a killed process left in a folder. Files that cannot be removed stay.
pub(crate) fn sweep(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.take(limits::FILES).flatten() {
        if is_temporary(&entry.file_name().to_string_lossy()) && entry.file_type().is_ok_and(|kind| kind.is_file()) {
            let path = entry.path();
            // No other process holds its lock: the process that wrote it has ended.
            if let Ok(file) = fs::OpenOptions::new().write(true).open(&path)
                && file.try_lock().is_ok()
                && let Err(e) = fs::remove_file(&path)
            {
                log::debug!("cannot remove {}: {e}", path.display());
            }
        }
    }
}

/// Replaces names of temporary files in a text by the names of the files they are written for: a program that writes
/// one reports the name it was given.
pub fn rename_temporary(text: &str, name: &str) -> String {
    let (mut out, mut rest) = (String::with_capacity(text.len()), text);
    while let Some(at) = rest.find(PREFIX) {
        let end = at + PREFIX.len() + 6 + SUFFIX.len();
        let is_one = rest.get(at..end).is_some_and(is_temporary);
        let end = if is_one { end } else { at + PREFIX.len() };
        out.push_str(&rest[..at]);
        out.push_str(if is_one { name } else { PREFIX });
        rest = &rest[end..];
    }
    out + rest
}

fn is_temporary(name: &str) -> bool {
    let random = name.strip_prefix(PREFIX).and_then(|rest| rest.strip_suffix(SUFFIX));
    random.is_some_and(|r| r.len() == 6 && r.bytes().all(|b| b.is_ascii_alphanumeric()))
}

/// Syncs the rename itself. Not every file system can; the content is safe either way. Windows has no such call: NTFS
/// writes renames to its journal.
fn sync_folder(path: &Path) {
    #[cfg(unix)]
    if let Err(e) = fs::File::open(folder_of(path)).and_then(|folder| folder.sync_all()) {
        log::debug!("cannot flush the folder of {}: {e}", path.display());
    }
    #[cfg(not(unix))]
    let _ = path;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_a_killed_save_are_swept_and_no_others() {
        let dir = tempfile::tempdir().unwrap();
        let write = |name: &str| fs::write(dir.path().join(name), "x").unwrap();
        let left = [".eddy-save-aB3xYz.tmp", ".eddy-save-000000.tmp"];
        let others = [".eddy-save-notes.tmp", ".eddy-backup", ".eddy-save-aB3xYz.tmp.bak", "a.tmp"];
        left.iter().chain(&others).for_each(|name| write(name));
        // A file that another process is writing.
        let busy = temporary(dir.path(), true).unwrap();
        write_with(&dir.path().join("new"), |file| file.write_all(b"new")).unwrap();
        for name in left {
            assert!(!dir.path().join(name).exists(), "{name}");
        }
        for name in others.iter().chain(&["new"]) {
            assert!(dir.path().join(name).exists(), "{name}");
        }
        assert!(busy.path().exists());
    }

    #[test]
    fn temporary_names_in_messages_are_replaced() {
        let said = "Error writing trailer of file:/a/.eddy-save-aB3xYz.tmp: full; .eddy-save-no, .eddy-save-";
        let right = "Error writing trailer of file:/a/b.mp4: full; .eddy-save-no, .eddy-save-";
        assert_eq!(rename_temporary(said, "b.mp4"), right);
    }

    #[test]
    fn errors_do_not_name_the_temporary_file() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("file");
        fs::write(&file, "").unwrap();
        let failed = write_with(&dir.path().join("out"), |_| Err(io::Error::from(io::ErrorKind::StorageFull)));
        let no_folder = write_with(&file.join("x"), |_| Ok(()));
        fs::create_dir(dir.path().join("folder")).unwrap();
        let a_folder = write_with(&dir.path().join("folder"), |_| Ok(()));
        for error in [failed.unwrap_err(), no_folder.unwrap_err(), a_folder.unwrap_err()] {
            assert!(!error.to_string().contains(".eddy"), "{error}");
        }
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 2);
    }
}
