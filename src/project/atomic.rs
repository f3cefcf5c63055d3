//! Files written whole or not at all.
//!
//! A new content goes to a temporary file beside the old one, is flushed to the device and takes its place by renaming.
//! Several files are all staged before the first takes its place, so that a full disk is found while every old file is there.

use super::ProjectError;
use std::{
    fs,
    io::{self, Write},
    path::{Path, PathBuf},
};
use tempfile::NamedTempFile;

pub enum Content {
    Bytes(Vec<u8>),
    CopyOf(PathBuf),
}

impl Content {
    fn read(&self) -> Result<std::borrow::Cow<'_, [u8]>, ProjectError> {
        Ok(match self {
            Content::Bytes(bytes) => bytes.into(),
            Content::CopyOf(path) => fs::read(path).map_err(ProjectError::io("read", path))?.into(),
        })
    }
}

pub enum OnDisk {
    Absent,
    Same,
    Different,
}

/// What stands at a path now, against what shall.
pub fn compare(path: &Path, content: &Content) -> Result<OnDisk, ProjectError> {
    match fs::read(path) {
        Ok(bytes) => Ok(if *content.read()? == bytes { OnDisk::Same } else { OnDisk::Different }),
        Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(OnDisk::Absent),
        Err(source) => Err(ProjectError::Io { action: "read", path: path.to_owned(), source }),
    }
}

/// Writes every file, making folders as needed.
pub fn write_all(files: Vec<(PathBuf, Content)>) -> Result<(), ProjectError> {
    let mut staged = Vec::new();
    for (path, content) in files {
        let path = real_path(path);
        let file = stage(&path, &content.read()?).map_err(ProjectError::io("write", &path))?;
        staged.push((path, file));
    }
    for (path, file) in staged {
        file.persist(&path).map_err(|e| ProjectError::Io { action: "write", path: path.clone(), source: e.error })?;
        sync_folder(&path);
    }
    Ok(())
}

/// Where a symbolic link leads, so that the link stays one.
fn real_path(path: PathBuf) -> PathBuf {
    if path.is_symlink() { path.canonicalize().unwrap_or(path) } else { path }
}

fn stage(path: &Path, bytes: &[u8]) -> io::Result<NamedTempFile> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    fs::create_dir_all(folder)?;
    let mut builder = tempfile::Builder::new();
    builder.prefix(".eddy-");
    let old = fs::metadata(path).ok();
    // Renaming would replace a write-protected file without asking.
    if old.as_ref().is_some_and(|m| m.permissions().readonly()) {
        return Err(io::Error::new(io::ErrorKind::PermissionDenied, "the file is write-protected"));
    }
    #[cfg(unix)]
    if old.is_none() {
        // What the user's umask gives any new file; a temporary one would be its owner's alone.
        builder.permissions(<fs::Permissions as std::os::unix::fs::PermissionsExt>::from_mode(0o666));
    }
    // Past the wrapper, whose errors name the temporary file: nobody has ever heard of that one.
    let file = builder.tempfile_in(folder)?;
    file.as_file().write_all(bytes)?;
    if let Some(old) = old {
        file.as_file().set_permissions(old.permissions())?;
    }
    file.as_file().sync_all()?;
    Ok(file)
}

/// Makes the renaming itself last. Not every file system can; the content is safe either way.
fn sync_folder(path: &Path) {
    #[cfg(unix)]
    if let Some(Ok(folder)) = path.parent().map(fs::File::open)
        && let Err(e) = folder.sync_all()
    {
        log::debug!("cannot flush the folder of {}: {e}", path.display());
    }
    #[cfg(not(unix))]
    let _ = path;
}
