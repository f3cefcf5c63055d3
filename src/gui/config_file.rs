//! Files that people write and the window follows: each is read when the window opens, and again when the window gets
//! the keyboard focus and the file has changed.

use crate::project::confine;
use std::{
    fs,
    io::{self, Write},
    path::{Path, PathBuf},
};

/// An error in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ConfigError {
    /// The line, counted from 1.
    pub line: usize,
    /// The problem and how to fix it.
    pub text: String,
}

/// The parsed content of such a file. The default applies if there is no file.
pub(super) trait Content: Default {
    const NAME: &str;
    /// A sentence appended to the error of a file that cannot be read.
    const STAYS: &str;

    /// Parses a text. Invalid lines are ignored.
    fn read(text: &str) -> (Self, Vec<ConfigError>);

    /// Returns a text that lists everything and changes nothing.
    fn template() -> String;
}

/// A file in the folder for settings, with its content as last read.
#[derive(Debug)]
pub(super) struct ConfigFile<T> {
    /// `None` if the system has no folder for settings.
    path: Option<PathBuf>,
    /// The text as last read.
    text: Option<String>,
    content: T,
    /// The errors in it, one line each.
    errors: Vec<String>,
    /// It could not be read the last time.
    is_unreadable: bool,
}

impl<T: Content> ConfigFile<T> {
    /// Locates the file in the platform's folder for settings without reading it.
    pub(super) fn new() -> Self {
        Self::at(dirs::config_dir().map(|folder| folder.join("eddy").join(T::NAME)))
    }

    pub(super) fn at(path: Option<PathBuf>) -> Self {
        Self { path, text: None, content: T::default(), errors: Vec::new(), is_unreadable: false }
    }

    pub(super) fn content(&self) -> &T {
        &self.content
    }

    pub(super) fn content_mut(&mut self) -> &mut T {
        &mut self.content
    }

    /// Reads the file if it has changed. Returns the errors in it, one line each.
    pub(super) fn refresh(&mut self) -> Vec<String> {
        let Some(path) = &self.path else { return Vec::new() };
        let text = match read(path) {
            Ok(text) => text,
            Err(error) => {
                let errors = vec![format!("{}: {error}. {}", path.display(), T::STAYS)];
                let is_known = std::mem::replace(&mut self.is_unreadable, true) && self.errors == errors;
                self.errors = errors;
                return if is_known { Vec::new() } else { self.errors.clone() };
            }
        };
        if !std::mem::take(&mut self.is_unreadable) && text == self.text {
            return Vec::new();
        }
        let (content, errors) = text.as_deref().map(T::read).unwrap_or_default();
        (self.content, self.text) = (content, text);
        self.errors = errors.iter().map(|error| with_place(path, error)).collect();
        self.errors.clone()
    }

    /// Returns whether an error that was reported for the file is fixed.
    pub(super) fn is_fixed(&self, message: &str) -> bool {
        let path = self.path.as_ref().map(|path| path.display().to_string());
        path.is_some_and(|path| message.starts_with(&format!("{path}:"))) && !self.errors.iter().any(|m| m == message)
    }

    /// Changes the text of the file, or of the template if there is no file. Returns why it could not be changed, with
    /// an explanation appended to an error of the disk.
    pub(super) fn edit(
        &mut self,
        edit: impl FnOnce(&str) -> Result<String, ConfigError>,
        otherwise: &str,
    ) -> Result<(), String> {
        let Some(path) = &self.path else { return Ok(()) };
        let failed = |error: io::Error| format!("{}: {error}. {otherwise}", path.display());
        let there = read(path).map_err(failed)?;
        let is_known = there == self.text;
        let text = edit(&there.unwrap_or_else(T::template)).map_err(|error| with_place(path, &error))?;
        write(path, &text).map_err(failed)?;
        // Another program may have written the file meanwhile: then the whole file is read again, and its errors are
        // reported.
        let (content, errors) = T::read(&text);
        self.errors = errors.iter().map(|error| with_place(path, error)).collect();
        (self.content, self.text) = (content, is_known.then_some(text));
        Ok(())
    }

    pub(super) fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Returns the text as last read.
    pub(super) fn text(&self) -> Option<&str> {
        self.text.as_deref()
    }

    /// Returns the errors in it, one line each.
    pub(super) fn errors(&self) -> &[String] {
        &self.errors
    }

    /// Returns whether it could not be read the last time.
    pub(super) fn is_unreadable(&self) -> bool {
        self.is_unreadable
    }

    /// Returns the path of the file, after writing the template if the file is missing.
    pub(super) fn write_if_missing(&self) -> Result<&Path, String> {
        let Some(path) = &self.path else { return Err("this system has no folder for settings".into()) };
        if !path.exists() {
            write(path, &T::template()).map_err(|error| format!("{}: {error}", path.display()))?;
        }
        Ok(path)
    }
}

/// Reads a file; returns `None` if it does not exist.
fn read(path: &Path) -> io::Result<Option<String>> {
    confine::read_state_toml(path)
}

fn with_place(path: &Path, error: &ConfigError) -> String {
    format!("{}:{}: {}", path.display(), error.line, error.text)
}

/// Writes a file atomically.
pub(super) fn write(path: &Path, text: &str) -> io::Result<()> {
    // People keep such files elsewhere: if it is a symbolic link, its target is written.
    let path = &path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let folder = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder)?;
    let mut new = tempfile::NamedTempFile::new_in(folder)?;
    new.write_all(text.as_bytes())?;
    new.persist(path)?;
    Ok(())
}
