//! The text files of a project: in a folder on disk, embedded in the binary, or in memory.

use super::{
    FileError, ProjectError,
    confine::{self, Reason},
    include_folders,
    limits::{self, Limit},
};
use eddy_diag::{Diagnostic, SourceMap, Span};
use std::{
    cell::{Cell, OnceCell},
    collections::BTreeMap,
    ffi::OsStr,
    fs,
    path::{Path, PathBuf},
    sync::Arc,
};

/// The name of the file that describes a folder.
pub(super) const MANIFEST: &str = "eddy.toml";

/// Unsaved texts of an editor, by the paths of their files. They override the files on disk.
pub type EditedTexts = BTreeMap<PathBuf, Arc<str>>;

/// The text files of a project, by name relative to its folder.
pub(super) struct Files<'a> {
    place: Storage<'a>,
    edited: Option<&'a EditedTexts>,
    /// The remaining budget of bytes to read: see [`limits::ALL_TEXTS`].
    left: Cell<u64>,
    /// The [`include_folders`], once a file is looked for in them.
    libraries: OnceCell<Vec<PathBuf>>,
}

enum Storage<'a> {
    Disk(&'a Path),
    /// Embedded folders: a file is taken from the first that has it.
    Embedded(Vec<&'a include_dir::Dir<'a>>),
    /// A folder as it will be after saving.
    Memory(&'a BTreeMap<String, Vec<u8>>),
}

/// A text file's content, or the reason why it cannot be read.
pub(super) enum Read {
    Text(String),
    Missing,
    /// The offset of the first byte that is not UTF-8, and the text with every such byte replaced.
    NotUtf8(usize, String),
    Refused(FileError),
}

impl<'a> Files<'a> {
    pub(crate) fn on_disk(folder: &'a Path) -> Self {
        Self::of(Storage::Disk(folder))
    }

    /// The merged files of several folders. If two have a file of the same name, the first one wins.
    pub(crate) fn embedded(folders: Vec<&'a include_dir::Dir<'a>>) -> Self {
        Self::of(Storage::Embedded(folders))
    }

    pub(crate) fn in_memory(files: &'a BTreeMap<String, Vec<u8>>) -> Self {
        Self::of(Storage::Memory(files))
    }

    fn of(place: Storage<'a>) -> Self {
        Self { place, edited: None, left: Cell::new(limits::ALL_TEXTS.bytes), libraries: OnceCell::new() }
    }

    /// Reads a folder on disk; these texts override its files.
    pub(crate) fn edited(folder: &'a Path, edited: &'a EditedTexts) -> Self {
        Self { edited: Some(edited), ..Self::on_disk(folder) }
    }

    /// The editor's text of a file.
    fn in_editor(&self, name: &str) -> Option<&Arc<str>> {
        let (Storage::Disk(folder), Some(edited)) = (&self.place, self.edited) else { return None };
        edited.get(&folder.join(confine::relative("", name).ok()?))
    }

    /// The names of the files directly in the folder, sorted. Links count as files whatever their target. Fails for a
    /// folder of more than [`limits::FILES`].
    pub(crate) fn names(&self) -> Result<Vec<String>, ProjectError> {
        let mut names: Vec<String> = match self.place {
            Storage::Disk(path) => {
                let mut names = Vec::new();
                let start = if path.as_os_str().is_empty() { Path::new(".") } else { path };
                for entry in fs::read_dir(start).map_err(ProjectError::io("list", path))? {
                    let entry = entry.map_err(ProjectError::io("list", path))?;
                    // A name that is not UTF-8 cannot name a pass.
                    if let Ok(name) = entry.file_name().into_string()
                        && entry.file_type().is_ok_and(|kind| !kind.is_dir())
                    {
                        names.push(name);
                    }
                    if names.len() > limits::FILES {
                        return Err(ProjectError::TooManyFiles { path: path.to_owned() });
                    }
                }
                names
            }
            Storage::Embedded(ref folders) => {
                let files = folders.iter().flat_map(|dir| dir.files());
                files.filter_map(|f| f.path().file_name()?.to_str().map(str::to_owned)).collect()
            }
            Storage::Memory(files) => files.keys().cloned().collect(),
        };
        if let (Storage::Disk(folder), Some(edited)) = (&self.place, self.edited) {
            let here = edited.keys().filter(|path| path.parent() == Some(folder));
            names.extend(here.filter_map(|path| path.file_name()?.to_str().map(str::to_owned)));
        }
        names.sort();
        names.dedup();
        Ok(names)
    }

    /// Reads a text of at most `limit` bytes. One `Files` reads at most [`limits::ALL_TEXTS`] in total.
    pub(crate) fn read(&self, name: &str, limit: Limit) -> Read {
        self.read_by(name, limit, |folder, name, limit| confine::read(folder, name, limit))
    }

    /// Reads a text that an `#include` line names, which may be above the folder ([`confine::included`]) or in a folder
    /// of libraries.
    pub(crate) fn read_included(&self, name: &str, limit: Limit) -> Read {
        self.read_by(name, limit, |folder, name, limit| match confine::read_included(folder, name, limit) {
            Err(missing) if missing.is_missing() => match self.library_with(name) {
                Some(library) => confine::read(library, name, limit),
                None => Err(missing),
            },
            read => read,
        })
    }

    fn read_by(
        &self,
        name: &str,
        limit: Limit,
        read: impl Fn(&Path, &str, Limit) -> Result<Vec<u8>, FileError>,
    ) -> Read {
        if let Some(text) = self.in_editor(name) {
            let smaller = limit.bytes.min(self.left.get());
            return match text.len() as u64 > smaller {
                true => Read::Refused(FileError { file: name.to_owned(), reason: Reason::TooLarge(limit) }),
                false => {
                    self.left.set(self.left.get() - text.len() as u64);
                    Read::Text(text.to_string())
                }
            };
        }
        let bytes = match self.place {
            Storage::Disk(folder) => {
                let left = Limit { bytes: self.left.get(), ..limits::ALL_TEXTS };
                let smaller = if left.bytes < limit.bytes { left } else { limit };
                match read(folder, name, smaller) {
                    Ok(bytes) => bytes,
                    Err(e) if e.is_missing() => return Read::Missing,
                    Err(FileError { file, reason: Reason::TooLarge(l) }) if l.of == left.of => {
                        let reason = Reason::TooMuch(limits::ALL_TEXTS);
                        return Read::Refused(FileError { file, reason });
                    }
                    Err(e) => return Read::Refused(e),
                }
            }
            Storage::Embedded(ref folders) => {
                match folders.iter().find_map(|dir| dir.get_file(dir.path().join(name))) {
                    Some(file) => file.contents().to_vec(),
                    None => return Read::Missing,
                }
            }
            Storage::Memory(files) => match files.get(&confine::relative("", name).unwrap_or_default()) {
                Some(bytes) => bytes.clone(),
                None => return Read::Missing,
            },
        };
        self.left.set(self.left.get().saturating_sub(bytes.len() as u64));
        decode(bytes)
    }

    /// Returns whether a file exists, perhaps in a folder of libraries.
    pub(crate) fn can_read(&self, name: &str) -> bool {
        match self.place {
            Storage::Disk(_) if self.in_editor(name).is_some() => true,
            Storage::Disk(folder) => folder.join(name).is_file() || self.library_with(name).is_some(),
            Storage::Embedded(ref folders) => folders.iter().any(|dir| dir.get_file(dir.path().join(name)).is_some()),
            Storage::Memory(files) => files.contains_key(name),
        }
    }

    /// Returns whether an entry other than a folder has this name directly in the folder, even an unusable one: reading
    /// reports the reason.
    pub(crate) fn exists(&self, name: &str) -> bool {
        match self.place {
            Storage::Disk(_) if self.in_editor(name).is_some() => true,
            Storage::Disk(folder) => folder.join(name).symlink_metadata().is_ok_and(|m| !m.is_dir()),
            Storage::Embedded(ref folders) => {
                folders.iter().flat_map(|dir| dir.files()).any(|f| f.path().file_name() == Some(OsStr::new(name)))
            }
            Storage::Memory(files) => files.contains_key(name),
        }
    }

    /// Returns the first of the [`include_folders`] that has a file.
    fn library_with(&self, name: &str) -> Option<&PathBuf> {
        let folders = self.libraries.get_or_init(include_folders::all);
        folders.iter().find(|folder| confine::resolve(folder, name).is_ok())
    }

    /// The path of a file, if it is on disk.
    pub(crate) fn path(&self, name: &str) -> Option<PathBuf> {
        match self.place {
            Storage::Disk(folder) => {
                let own = folder.join(name);
                let library = if own.exists() { None } else { self.library_with(name) };
                Some(library.map_or(own, |library| library.join(name)))
            }
            Storage::Embedded(_) | Storage::Memory(_) => None,
        }
    }
}

pub(super) fn decode(bytes: Vec<u8>) -> Read {
    match String::from_utf8(bytes) {
        Ok(text) => Read::Text(text),
        Err(e) => Read::NotUtf8(e.utf8_error().valid_up_to(), String::from_utf8_lossy(e.as_bytes()).into_owned()),
    }
}

/// Returns the diagnostic for a text that is not UTF-8, and adds the text to `sources`.
pub(super) fn not_utf8(sources: &mut SourceMap, name: &str, at: usize, lossy: String) -> Diagnostic {
    let id = sources.add(name, lossy);
    Diagnostic::error(Span::new(id, at..at + '\u{fffd}'.len_utf8()), format!("{name} is not UTF-8 text"))
        .hint("save it as UTF-8 in your editor")
}
