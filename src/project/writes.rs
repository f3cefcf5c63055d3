//! Collects and checks the files that a save writes. No other code writes files of projects.
//!
//! Everything that one save writes is collected here by its name relative to the destination, checked, and written
//! together. A name comes from the project, which may be a stranger's: it may not lead out of the destination, even
//! through links there, and a new file must be of a kind that projects contain. Files that already belong to the
//! project keep their names.

use super::{
    ProjectError,
    atomic::{self, Content},
    confine::{self, FileError},
    file_names::is_glsl_extension,
    files::MANIFEST,
};
use std::{
    collections::{BTreeMap, BTreeSet},
    fs, io,
    path::{Path, PathBuf},
};

/// The policy for files in the way that do not belong to this project.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overwrite<'a> {
    /// Fail with [`ProjectError::WouldOverwrite`] without writing anything.
    Refuse,
    Allow,
    /// Replace them, after copying each into this folder before anything is written. The folder is created if there is
    /// something to keep, and contains nothing else.
    KeepIn(&'a Path),
}

/// Extensions of texts besides those of passes.
const TEXTS: [&str; 16] = [
    "vert", "comp", "geom", "tesc", "tese", "vs", "gs", "fsh", "vsh", "glslf", "glslv", "glslh", "inc", "h", "hlsl",
    "txt",
];
/// Extensions of pictures, music, videos, models, and the files that these name.
const MEDIA: [&str; 37] = [
    "png", "jpg", "jpeg", "webp", "bmp", "tga", "gif", "hdr", "exr", "ktx", "ktx2", "dds", "glb", "gltf", "obj", "mtl",
    "bin", "npy", "mp3", "ogg", "oga", "opus", "wav", "flac", "m4a", "aac", "aif", "aiff", "mp4", "webm", "ogv", "mkv",
    "mov", "m4v", "avi", "mpg", "mpeg",
];

/// Returns whether a new file of this name may be a text of a project.
pub(super) fn is_text(name: &str) -> bool {
    let extension = Path::new(name).extension().unwrap_or_default();
    is_glsl_extension(extension) || TEXTS.iter().any(|e| extension.eq_ignore_ascii_case(e))
}

/// Returns whether a new file of this name may be a picture or a model of a project, or a file that a model names.
pub(super) fn is_media(name: &str) -> bool {
    let extension = Path::new(name).extension().unwrap_or_default();
    MEDIA.iter().any(|e| extension.eq_ignore_ascii_case(e))
}

/// Files to be written into one folder.
pub(super) struct Writes {
    folder: PathBuf,
    /// By name relative to the folder.
    files: BTreeMap<String, Content>,
    /// Names of files that already belong to the project.
    own: BTreeSet<String>,
}

impl Writes {
    pub(crate) fn into(folder: &Path, own: BTreeSet<String>) -> Self {
        Self { folder: folder.to_owned(), files: BTreeMap::new(), own }
    }

    /// Returns the name under which `name` would be written, or why it must not be written. It may not lead out of the
    /// folder; a new file also needs the extension of a project's file and a name that no system reserves.
    pub(crate) fn checked(&self, name: &str) -> Result<String, ProjectError> {
        let refuse = |why: String| Err(ProjectError::Unwritable { path: self.folder.join(name), why });
        let name = match confine::relative("", name) {
            Ok(name) => name,
            Err(e) => return Err(ProjectError::Unwritable { path: PathBuf::from(name), why: with_hint(&e) }),
        };
        if self.own.contains(&name) || name == MANIFEST {
            return Ok(name);
        }
        if let Some(part) = name.split('/').find(|part| confine::is_reserved(part)) {
            return refuse(format!("{part} is the name of a device on Windows; rename the file"));
        }
        if !is_text(&name) && !is_media(&name) {
            return refuse("a project cannot have a file with this extension; rename it, for example to .glsl".into());
        }
        Ok(name)
    }

    /// Returns whether `content` may have this name: no other file of this save has it, even on a file system that
    /// ignores case.
    pub(crate) fn is_free(&self, name: &str, content: &[u8]) -> bool {
        match self.files.get(name) {
            Some(Content::Bytes(there)) => there == content,
            Some(Content::CopyOf(..)) => false,
            None => {
                let folded = name.to_lowercase();
                let is_own = self.own.contains(name);
                is_own || self.files.keys().all(|other| other.to_lowercase() != folded)
            }
        }
    }

    /// Adds `content` under a name that [`Writes::checked`] accepts.
    pub(crate) fn add(&mut self, name: &str, content: Content) -> Result<(), ProjectError> {
        let name = self.checked(name)?;
        self.files.insert(name, content);
        Ok(())
    }

    /// Adds `content` for the file that the user named.
    pub(crate) fn add_named(&mut self, file_name: String, content: Content) {
        self.files.insert(file_name, content);
    }

    /// Texts by name.
    pub(crate) fn texts(&self) -> impl Iterator<Item = (&String, &Vec<u8>)> {
        self.files.iter().filter_map(|(name, content)| match content {
            Content::Bytes(bytes) => Some((name, bytes)),
            Content::CopyOf(..) => None,
        })
    }

    /// Checks that no foreign file is in the way and that every file stays within the folder, then writes everything.
    pub(crate) fn write(self, overwrite: Overwrite<'_>) -> Result<(), ProjectError> {
        let (mut changed, mut foreign) = (Vec::new(), Vec::new());
        for (name, content) in self.files {
            let path = self.folder.join(&name);
            stays_within(&self.folder, &path)?;
            match atomic::compare(&path, &content)? {
                atomic::FileComparison::Same => continue,
                atomic::FileComparison::Different if !self.own.contains(&name) => foreign.push(name),
                atomic::FileComparison::Different | atomic::FileComparison::Absent => {}
            }
            changed.push((path, content));
        }
        match overwrite {
            Overwrite::Refuse if !foreign.is_empty() => {
                let paths = foreign.iter().map(|name| self.folder.join(name)).collect();
                return Err(ProjectError::WouldOverwrite { paths });
            }
            Overwrite::KeepIn(kept) => foreign.iter().try_for_each(|name| keep(&self.folder, name, kept))?,
            Overwrite::Refuse | Overwrite::Allow => {}
        }
        atomic::write_all(changed)
    }
}

/// Atomically writes one file that the user named. An existing file with the same bytes is not in the way.
pub fn write_named(path: &Path, bytes: Vec<u8>, overwrite: Overwrite<'_>) -> Result<(), ProjectError> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut writes = Writes::into(folder, BTreeSet::new());
    writes.add_named(path.file_name().unwrap_or_default().to_string_lossy().into_owned(), Content::Bytes(bytes));
    writes.write(overwrite)
}

/// Copies a file of `folder` into `kept`, under the same name. Existing copies stay.
fn keep(folder: &Path, name: &str, kept: &Path) -> Result<(), ProjectError> {
    let (from, to) = (folder.join(name), kept.join(name));
    let copy = || {
        make_private(to.parent().unwrap_or(kept))?;
        let mut new = fs::File::create_new(&to)?;
        io::copy(&mut fs::File::open(&from)?, &mut new)?;
        new.sync_all()
    };
    copy().map_err(ProjectError::io("keep what would be replaced in", &to))
}

/// Creates a folder that only its owner may read, for private data. On Windows it inherits the access of the folder that
/// it is in, and those of a user are private.
pub fn make_private(folder: &Path) -> io::Result<()> {
    let mut builder = fs::DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(folder)
}

/// Atomically writes one file into a folder that the user named. Existing files in the folder may be a stranger's: see
/// [`check_within`]. Errors do not name the file.
pub fn write_into(folder: &Path, name: &str, write: impl FnOnce(&mut fs::File) -> io::Result<()>) -> io::Result<()> {
    atomic::write_over(&place_within(folder, name)?, write)
}

/// Returns the path of a file of a folder after resolving links, none of which leads out of the folder. Do not resolve
/// it again: another link may have been created since.
pub(super) fn place_within(folder: &Path, name: &str) -> io::Result<PathBuf> {
    check_within(folder, name)?;
    let path = folder.join(name);
    if !path.is_symlink() {
        return Ok(path);
    }
    let (real, home) = (path.canonicalize()?, folder.canonicalize()?);
    if real.starts_with(home) { Ok(real) } else { Err(io::Error::other("the file became a link meanwhile")) }
}

/// Checks that a file of a folder, if it exists, is a regular one, and that no link leads from the folder to a file
/// elsewhere, which would be read or written instead.
pub fn check_within(folder: &Path, name: &str) -> io::Result<()> {
    let path = folder.join(name);
    stays_within(folder, &path).map_err(|e| match e {
        ProjectError::Unwritable { why, .. } => io::Error::new(io::ErrorKind::PermissionDenied, why),
        other => io::Error::other(other),
    })?;
    match fs::metadata(&path) {
        Ok(there) if !there.is_file() => Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            format!("{name} exists and is not a regular file; remove it, or choose another folder"),
        )),
        _ => Ok(()),
    }
}

fn with_hint(error: &FileError) -> String {
    format!("{error}; {}", error.hint())
}

/// Returns whether the path to a file, and the file itself if it is a link, stays within the folder.
fn stays_within(folder: &Path, path: &Path) -> Result<(), ProjectError> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    // A folder that does not exist yet contains no links.
    let Ok(home) = folder.canonicalize() else { return Ok(()) };
    let there = path.ancestors().find(|p| p.symlink_metadata().is_ok()).unwrap_or(folder);
    let there = if there.as_os_str().is_empty() { Path::new(".") } else { there };
    match there.canonicalize() {
        Ok(real) if real.starts_with(&home) => Ok(()),
        Ok(_) => {
            let why = format!("a link leads out of {}; remove the link, or choose another folder", folder.display());
            Err(ProjectError::Unwritable { path: path.to_owned(), why })
        }
        Err(_) => {
            let why = format!("{} is a broken link; remove it", there.display());
            Err(ProjectError::Unwritable { path: path.to_owned(), why })
        }
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use crate::{Staged, write_with};
    use std::{io::Write, os::unix::fs::symlink};

    #[test]
    fn no_link_leads_out_of_a_folder() {
        let dir = tempfile::tempdir().unwrap();
        let (folder, outside) = (dir.path().join("states"), dir.path().join("precious"));
        fs::create_dir(&folder).unwrap();
        for path in [&outside, &folder.join("notes")] {
            fs::write(path, "precious").unwrap();
        }
        let at = |name: &str| folder.join(name);
        symlink("../precious", at("out")).unwrap();
        symlink("notes", at("inside")).unwrap();
        symlink("../gone", at("broken")).unwrap();
        for name in ["out", "broken"] {
            let why = write_into(&folder, name, |file| file.write_all(b"new")).unwrap_err().to_string();
            assert!(why.contains("link"), "{why}");
            assert!(Staged::within(&at(name)).is_err(), "{name}");
        }
        write_into(&folder, "inside", |file| file.write_all(b"new")).unwrap();
        // A link that the user made.
        assert!(at("inside").is_symlink());
        assert_eq!(fs::read_to_string(at("notes")).unwrap(), "new");
        assert_eq!(fs::read_to_string(&outside).unwrap(), "precious");
        assert!(!dir.path().join("gone").exists());
        // A link that the user named stays a link.
        write_with(&at("out"), |file| file.write_all(b"named")).unwrap();
        assert_eq!(fs::read_to_string(&outside).unwrap(), "named");
    }
}
