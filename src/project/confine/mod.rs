//! Resolves the names of files that a project mentions. No other code does.
//!
//! A project may be a stranger's, so it reads only files in its own folder: pass files, Common, stages, included files,
//! pictures, models and the files that models name. A name is relative to the folder, with `/`. It may not be absolute,
//! nor lead above the folder, even through links, which are resolved first. It must lead to a regular file: a device
//! may never reach its end and a pipe may never deliver a byte. Reading is bounded.
//!
//! [`relative`] checks the name alone, [`resolve`] checks the disk, and [`read`] reads. [`read_own`] is for a path that
//! the user gives, who may name any regular file.

use super::{
    file_names::is_glsl_extension,
    limits::{self, Limit},
};
use std::{
    fs::{self, File},
    io::{self, Read},
    path::{Path, PathBuf},
};

/// An error when reading a file. The text names the file and the reason; [`FileError::hint`] returns the fix.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.message())]
pub struct FileError {
    /// The file as the project names it, or the system's path if the project's name is valid.
    pub file: String,
    pub reason: Reason,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The name is empty.
    Empty,
    /// The name starts at a root or a drive.
    Absolute,
    /// `..` leads above the project's folder.
    Above,
    /// It contains `\`.
    Backslash,
    /// It contains a character that no file name may have, or is not Unicode.
    Characters,
    /// It is the name of a Windows device.
    Reserved,
    /// A link on the path leads out of the folder.
    Link,
    /// The file does not exist.
    Missing,
    /// It exists but is not a regular file: "a folder", "a pipe".
    NotAFile(&'static str),
    TooLarge(Limit),
    /// With the bytes read before, it exceeds the limit.
    TooMuch(Limit),
    /// The system returned an error.
    Io(String),
}

impl FileError {
    fn new(file: impl Into<String>, reason: Reason) -> Self {
        FileError { file: file.into(), reason }
    }

    fn io(path: &Path, error: &io::Error) -> Self {
        let reason = match error.kind() {
            io::ErrorKind::NotFound => Reason::Missing,
            _ => Reason::Io(error.to_string()),
        };
        FileError::new(path.display().to_string(), reason)
    }

    /// Returns the error for a failed operation of the system on a file.
    pub fn of_machine(path: &Path, error: &io::Error) -> Self {
        FileError::io(path, error)
    }

    fn message(&self) -> String {
        let file = self.file.escape_debug().to_string().replace("\\\\", "\\").replace("\\'", "'").replace("\\\"", "\"");
        match &self.reason {
            Reason::Empty => "a file without a name".into(),
            Reason::Absolute => format!("{file} is an absolute path and leads out of the project's folder"),
            Reason::Above => format!("{file} leads out of the project's folder"),
            Reason::Backslash => {
                format!("{file} has a \\ in it, which leads out of the project's folder on some systems")
            }
            Reason::Characters => format!("{file} contains characters that are not allowed in file names"),
            Reason::Reserved => format!("{file} is the name of a device on Windows"),
            Reason::Link => format!("{file} is a link that leads out of the project's folder"),
            Reason::Missing => format!("cannot read {file}: there is no such file"),
            Reason::NotAFile(kind) => format!("cannot read {file}: it is {kind}, not a regular file"),
            Reason::TooLarge(limit) => format!("{file} is larger than {limit}"),
            Reason::TooMuch(limit) => format!("with {file} it is more than {limit}"),
            Reason::Io(why) => format!("cannot read {file}: {why}"),
        }
    }

    /// Returns how to fix it.
    pub fn hint(&self) -> String {
        match &self.reason {
            Reason::Empty => "write the file name, relative to the project's folder".into(),
            Reason::Absolute | Reason::Above | Reason::Link => {
                "copy the file into the project's folder, and write its path relative to that folder, with /".into()
            }
            Reason::Backslash => "write / between folders and files".into(),
            Reason::Characters | Reason::Reserved => "rename the file".into(),
            Reason::Missing => "put the file there, or choose another".into(),
            Reason::NotAFile(_) => "use a regular file".into(),
            Reason::TooLarge(_) => "make the file smaller".into(),
            Reason::TooMuch(_) => "split the project in two, or make its files smaller".into(),
            Reason::Io(_) => "check the file's permissions".into(),
        }
    }

    /// Returns whether the system refused, for lack of permission or because of a fault: the project itself is correct.
    pub fn is_of_machine(&self) -> bool {
        matches!(self.reason, Reason::Io(_))
    }

    pub fn is_too_large(&self) -> bool {
        matches!(self.reason, Reason::TooLarge(_))
    }

    pub fn is_missing(&self) -> bool {
        self.reason == Reason::Missing
    }
}

/// The name, from the project's folder and with `/`, of the file that the project's file `from` calls `name`. `from` is
/// itself a name from the folder; an empty one means a file directly in it. Checks only the text of the names.
pub fn relative(from: &str, name: &str) -> Result<String, FileError> {
    relative_above(from, name, 0)
}

/// Does the same for a GLSL file that a complete fragment shader includes, which may be in a folder at most
/// [`limits::FOLDERS_ABOVE`] above the project's: the name then starts with `../`.
pub(super) fn included(from: &str, name: &str) -> Result<String, FileError> {
    let is_glsl = Path::new(name).extension().is_some_and(is_glsl_extension);
    relative_above(from, name, if is_glsl { limits::FOLDERS_ABOVE } else { 0 })
}

/// Reads a file whose name may start with `../`. Links are resolved: the file is within the folder that the name leads
/// to.
pub(super) fn read_included(folder: &Path, name: &str, limit: Limit) -> Result<Vec<u8>, FileError> {
    let above = name.split('/').take_while(|part| *part == "..").count();
    if above == 0 {
        return read(folder, name, limit);
    }
    let start = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let real = start.canonicalize().map_err(|error| FileError::io(start, &error))?;
    let refuse = || FileError::new(name, Reason::Above);
    let base = real.ancestors().nth(above).ok_or_else(refuse)?;
    read(base, name.trim_start_matches("../"), limit)
}

/// The names of [`relative`], which may lead this number of folders above the project's.
fn relative_above(from: &str, name: &str, above: usize) -> Result<String, FileError> {
    let refuse = |reason| Err(FileError::new(name, reason));
    let bytes = name.as_bytes();
    if name.trim().is_empty() {
        return refuse(Reason::Empty);
    }
    if name.chars().any(char::is_control) {
        return refuse(Reason::Characters);
    }
    let has_drive = bytes.len() >= 2 && bytes[0].is_ascii_alphabetic() && bytes[1] == b':';
    if name.starts_with(['/', '\\']) || has_drive {
        return refuse(Reason::Absolute);
    }
    if name.contains('\\') {
        return refuse(Reason::Backslash);
    }
    // An alternate data stream of NTFS.
    if cfg!(windows) && name.contains(':') {
        return refuse(Reason::Characters);
    }
    let mut parts: Vec<&str> = from.rsplit_once('/').map_or(Vec::new(), |(folder, _)| folder.split('/').collect());
    for part in name.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                if parts.last().is_some_and(|last| *last != "..") {
                    parts.pop();
                } else if parts.len() < above {
                    parts.push("..");
                } else {
                    return refuse(Reason::Above);
                }
            }
            // Windows drops trailing dots and blanks of a name.
            part if part.trim_end_matches(['.', ' ']).is_empty() => return refuse(Reason::Characters),
            part if cfg!(windows) && is_reserved(part) => return refuse(Reason::Reserved),
            part => parts.push(part),
        }
    }
    if parts.is_empty() {
        return refuse(Reason::NotAFile("a folder"));
    }
    Ok(parts.join("/"))
}

/// Returns whether Windows treats this name, with any extension, as a device.
pub fn is_reserved(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or_default().trim_end().to_ascii_uppercase();
    match stem.as_str() {
        "CON" | "PRN" | "AUX" | "NUL" | "CONIN$" | "CONOUT$" => true,
        _ => ["COM", "LPT"].iter().any(|device| {
            let digit = stem.strip_prefix(device).unwrap_or_default();
            matches!(digit, "0" | "1" | "2" | "3" | "4" | "5" | "6" | "7" | "8" | "9" | "¹" | "²" | "³")
        }),
    }
}

/// The file that a project in `folder` calls `name`: a regular file within the folder, after resolving links. The
/// returned path starts with `folder` as given. An empty `folder` is the current one.
pub fn resolve(folder: &Path, name: impl AsRef<Path>) -> Result<PathBuf, FileError> {
    find(folder, name.as_ref()).map(|found| found.called)
}

/// Reads the file that a project in `folder` calls `name`, at most `limit` bytes of it.
pub fn read(folder: &Path, name: impl AsRef<Path>, limit: Limit) -> Result<Vec<u8>, FileError> {
    let found = find(folder, name.as_ref())?;
    read_regular(&found.real, &found.called, limit)
}

/// Opens the file that a project in `folder` calls `name`, which has at most `limit` bytes, for streaming. Returns its
/// path, after resolving links, with it.
pub fn open(folder: &Path, name: impl AsRef<Path>, limit: Limit) -> Result<(File, PathBuf), FileError> {
    let found = find(folder, name.as_ref())?;
    Ok((open_checked(&found.real, &found.called, limit)?.0, found.real))
}

/// Opens a file that the user named, for streaming.
pub fn open_own(path: &Path, limit: Limit) -> Result<(File, PathBuf), FileError> {
    let real = path.canonicalize().map_err(|e| FileError::io(path, &e))?;
    check_kind(path, &real)?;
    Ok((open_checked(&real, path, limit)?.0, real))
}

/// Reads a file that the user named: any regular file, at most `limit` bytes of it.
pub fn read_own(path: &Path, limit: Limit) -> Result<Vec<u8>, FileError> {
    let real = path.canonicalize().map_err(|e| FileError::io(path, &e))?;
    check_kind(path, &real)?;
    read_regular(&real, path, limit)
}

/// Reads one of Eddy's own text files, such as settings: a regular file, at most `limit` bytes of it. `None` if it does
/// not exist. Errors do not name the file.
pub fn read_state(path: &Path, limit: Limit) -> io::Result<Option<String>> {
    let text = |bytes| String::from_utf8(bytes).map_err(|e| io::Error::new(io::ErrorKind::InvalidData, e));
    read_state_bytes(path, limit)?.map(text).transpose()
}

/// Reads one of Eddy's own TOML files likewise. It has at most [`limits::STATE_FILE`] bytes and
/// [`limits::STATE_VALUES`] values: a parsed value takes a hundred times the memory of its text.
pub fn read_state_toml(path: &Path) -> io::Result<Option<String>> {
    let Some(text) = read_state(path, limits::STATE_FILE)? else { return Ok(None) };
    if limits::toml_values(&text) > limits::STATE_VALUES {
        return Err(io::Error::other(format!("it has more than {} values, the limit", limits::STATE_VALUES)));
    }
    Ok(Some(text))
}

/// Does the same for a binary file.
pub fn read_state_bytes(path: &Path, limit: Limit) -> io::Result<Option<Vec<u8>>> {
    match read_own(path, limit) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(e) if e.is_missing() => Ok(None),
        Err(FileError { reason: Reason::NotAFile(kind), .. }) => {
            Err(io::Error::other(format!("it is {kind}, not a regular file; remove it")))
        }
        Err(FileError { reason: Reason::TooLarge(limit), .. }) => {
            Err(io::Error::other(format!("it is larger than {limit}")))
        }
        Err(FileError { reason: Reason::Io(why), .. }) => Err(io::Error::other(why)),
        Err(e) => Err(io::Error::other(e)),
    }
}

/// Opens one of Eddy's own files for streaming, if it is a regular file of at most `limit` bytes.
pub fn open_state(path: &Path, limit: Limit) -> Result<File, FileError> {
    let real = path.canonicalize().map_err(|e| FileError::io(path, &e))?;
    check_kind(path, &real)?;
    open_checked(&real, path, limit).map(|(file, _)| file)
}

/// A limit for a file that should have this number of bytes: a longer one is a different file.
pub(super) fn exactly(bytes: usize) -> Limit {
    Limit { bytes: bytes as u64, of: "a file of the same content" }
}

struct Found {
    /// The path from the folder as given.
    called: PathBuf,
    /// The path after resolving links.
    real: PathBuf,
}

fn find(folder: &Path, name: &Path) -> Result<Found, FileError> {
    let Some(text) = name.to_str() else {
        return Err(FileError::new(name.to_string_lossy(), Reason::Characters));
    };
    let name = relative("", text)?;
    let called = folder.join(&name);
    let start = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let home = start.canonicalize().map_err(|e| FileError::io(folder, &e))?;
    let real = home.join(&name).canonicalize().map_err(|e| FileError::io(&called, &e))?;
    if !real.starts_with(&home) {
        return Err(FileError::new(name, Reason::Link));
    }
    check_kind(&called, &real)?;
    Ok(Found { called, real })
}

/// Checks the kind before the file is opened: opening a pipe waits for a writer, and opening a device may have side
/// effects.
fn check_kind(called: &Path, real: &Path) -> Result<(), FileError> {
    let metadata = fs::symlink_metadata(real).map_err(|e| FileError::io(called, &e))?;
    match kind(&metadata.file_type()) {
        None => Ok(()),
        Some(kind) => Err(FileError::new(called.display().to_string(), Reason::NotAFile(kind))),
    }
}

/// Returns the kind of a file that is not regular.
fn kind(file: &fs::FileType) -> Option<&'static str> {
    if file.is_file() {
        return None;
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if file.is_fifo() {
            return Some("a pipe");
        }
        if file.is_socket() {
            return Some("a socket");
        }
        if file.is_char_device() || file.is_block_device() {
            return Some("a device");
        }
    }
    Some(if file.is_dir() { "a folder" } else { "something else" })
}

/// Opens a file, and checks the kind of what was actually opened. Returns its length with it.
fn open_checked(real: &Path, called: &Path, limit: Limit) -> Result<(File, u64), FileError> {
    let failed = |e: io::Error| FileError::io(called, &e);
    let refuse = |reason| Err(FileError::new(called.display().to_string(), reason));
    let file = open_regular(real).map_err(failed)?;
    let metadata = file.metadata().map_err(failed)?;
    if let Some(kind) = kind(&metadata.file_type()) {
        return refuse(Reason::NotAFile(kind));
    }
    if metadata.len() > limit.bytes {
        return refuse(Reason::TooLarge(limit));
    }
    Ok((file, metadata.len()))
}

fn read_regular(real: &Path, called: &Path, limit: Limit) -> Result<Vec<u8>, FileError> {
    let (file, length) = open_checked(real, called, limit)?;
    let mut bytes = Vec::with_capacity(length as usize);
    // A file may grow while it is read, and some report length 0 whatever they contain.
    let read = file.take(limit.bytes.saturating_add(1)).read_to_end(&mut bytes);
    read.map_err(|e| FileError::io(called, &e))?;
    if bytes.len() as u64 > limit.bytes {
        return Err(FileError::new(called.display().to_string(), Reason::TooLarge(limit)));
    }
    Ok(bytes)
}

/// Opens for reading without blocking, in case the path has become a pipe since it was checked.
#[cfg(unix)]
fn open_regular(real: &Path) -> io::Result<File> {
    use rustix::fs::{Mode, OFlags};
    let flags = OFlags::RDONLY | OFlags::NONBLOCK | OFlags::NOCTTY | OFlags::NOFOLLOW | OFlags::CLOEXEC;
    Ok(File::from(rustix::fs::open(real, flags, Mode::empty())?))
}

/// Opens for reading, and refuses a link that has replaced a part of the path since it was resolved: the opened file has
/// another path then. Not to follow links (`FILE_FLAG_OPEN_REPARSE_POINT`) would also open files of cloud folders as
/// something else than their content.
#[cfg(windows)]
fn open_regular(real: &Path) -> io::Result<File> {
    let file = File::open(real)?;
    if final_path(&file)? != real {
        return Err(io::Error::other("it was replaced by a link while it was opened"));
    }
    Ok(file)
}

/// Returns the path of an open file without links, in the form of [`Path::canonicalize`].
#[cfg(windows)]
fn final_path(file: &File) -> io::Result<PathBuf> {
    use std::{
        ffi::OsString,
        os::windows::{ffi::OsStringExt, io::AsRawHandle},
    };
    use windows_sys::Win32::Storage::FileSystem::{FILE_NAME_NORMALIZED, GetFinalPathNameByHandleW};
    // The longest path that Windows has.
    let mut path = vec![0; 1 << 15];
    let (buffer, length) = (path.as_mut_ptr(), path.len() as u32);
    // SAFETY: the file is open, and the buffer has this length.
    let length = unsafe { GetFinalPathNameByHandleW(file.as_raw_handle(), buffer, length, FILE_NAME_NORMALIZED) };
    match path.get(..length as usize) {
        Some(path) if length > 0 => Ok(OsString::from_wide(path).into()),
        Some(_) | None => Err(io::Error::last_os_error()),
    }
}

#[cfg(test)]
mod tests;
