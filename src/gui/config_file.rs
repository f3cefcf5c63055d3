//! Files that a person writes and the window follows: each is read when the window opens, and again when the window
//! gets the keyboard and the file has changed.

use crate::project::confine;
use std::{
    fs,
    io::{self, Write},
    path::{Path, PathBuf},
};

/// Names something in a file that cannot be done as it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ConfigError {
    /// The line, counted from 1.
    pub line: usize,
    /// Says what is wrong and how to mend it.
    pub text: String,
}

/// The meaning of such a file. The default is that of no file.
pub(super) trait Content: Default {
    const NAME: &str;
    /// A sentence behind the error of a file that cannot be read.
    const STAYS: &str;

    /// Reads a text. Lines with mistakes mean nothing.
    fn read(text: &str) -> (Self, Vec<ConfigError>);

    /// Returns a text that lists everything and changes nothing.
    fn template() -> String;
}

/// A file in the folder for settings, and its content as it was read last.
#[derive(Debug)]
pub(super) struct ConfigFile<T> {
    /// `None` where the system has no place for settings.
    path: Option<PathBuf>,
    /// The text that was read last.
    text: Option<String>,
    content: T,
    /// Says what is wrong in it, one line each.
    mistakes: Vec<String>,
    /// It could not be read when it was looked at last.
    is_unreadable: bool,
}

impl<T: Content> ConfigFile<T> {
    /// Names the file in the platform's folder for settings. It is not read yet.
    pub(super) fn new() -> Self {
        Self::at(dirs::config_dir().map(|folder| folder.join("eddy").join(T::NAME)))
    }

    pub(super) fn at(path: Option<PathBuf>) -> Self {
        Self { path, text: None, content: T::default(), mistakes: Vec::new(), is_unreadable: false }
    }

    pub(super) fn content(&self) -> &T {
        &self.content
    }

    pub(super) fn content_mut(&mut self) -> &mut T {
        &mut self.content
    }

    /// Reads the file if it is not what it was. What is wrong in it comes back, one line each.
    pub(super) fn refresh(&mut self) -> Vec<String> {
        let Some(path) = &self.path else { return Vec::new() };
        let text = match read(path) {
            Ok(text) => text,
            Err(error) => {
                let mistakes = vec![format!("{}: {error}. {}", path.display(), T::STAYS)];
                let is_known = std::mem::replace(&mut self.is_unreadable, true) && self.mistakes == mistakes;
                self.mistakes = mistakes;
                return if is_known { Vec::new() } else { self.mistakes.clone() };
            }
        };
        if !std::mem::take(&mut self.is_unreadable) && text == self.text {
            return Vec::new();
        }
        let (content, mistakes) = text.as_deref().map(T::read).unwrap_or_default();
        (self.content, self.text) = (content, text);
        self.mistakes = mistakes.iter().map(|mistake| with_place(path, mistake)).collect();
        self.mistakes.clone()
    }

    /// Returns whether a text was said of the file and is true no more.
    pub(super) fn is_fixed(&self, said: &str) -> bool {
        let path = self.path.as_ref().map(|path| path.display().to_string());
        path.is_some_and(|path| said.starts_with(&format!("{path}:"))) && !self.mistakes.iter().any(|m| m == said)
    }

    /// Changes the text of the file, or of the template where there is none. Err: why it stays as it was, with a
    /// sentence behind an error of the disk.
    pub(super) fn edit(
        &mut self,
        edit: impl FnOnce(&str) -> Result<String, ConfigError>,
        otherwise: &str,
    ) -> Result<(), String> {
        let Some(path) = &self.path else { return Ok(()) };
        let failed = |error: io::Error| format!("{}: {error}. {otherwise}", path.display());
        let there = read(path).map_err(failed)?;
        let is_known = there == self.text;
        let text = edit(&there.unwrap_or_else(T::template)).map_err(|mistake| with_place(path, &mistake))?;
        write(path, &text).map_err(failed)?;
        // Another program may have written it meanwhile: then it is read as a whole once more, and mistakes are told.
        let (content, mistakes) = T::read(&text);
        self.mistakes = mistakes.iter().map(|mistake| with_place(path, mistake)).collect();
        (self.content, self.text) = (content, is_known.then_some(text));
        Ok(())
    }

    pub(super) fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Returns the text that was read last.
    pub(super) fn text(&self) -> Option<&str> {
        self.text.as_deref()
    }

    /// Returns what is wrong in it, one line each.
    pub(super) fn mistakes(&self) -> &[String] {
        &self.mistakes
    }

    /// It could not be read when it was looked at last.
    pub(super) fn is_unreadable(&self) -> bool {
        self.is_unreadable
    }

    /// Returns where the file is, after writing the template if there is none.
    pub(super) fn write_if_missing(&self) -> Result<&Path, String> {
        let Some(path) = &self.path else { return Err("this system has no folder for settings".into()) };
        if !path.exists() {
            write(path, &T::template()).map_err(|error| format!("{}: {error}", path.display()))?;
        }
        Ok(path)
    }
}

/// Reads a file; `None` where there is none.
fn read(path: &Path) -> io::Result<Option<String>> {
    confine::read_state_toml(path)
}

fn with_place(path: &Path, mistake: &ConfigError) -> String {
    format!("{}:{}: {}", path.display(), mistake.line, mistake.text)
}

/// Writes a file whole or not at all.
pub(super) fn write(path: &Path, text: &str) -> io::Result<()> {
    // People keep such files elsewhere: where it is a link, what it leads to is written.
    let path = &path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let folder = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder)?;
    let mut new = tempfile::NamedTempFile::new_in(folder)?;
    new.write_all(text.as_bytes())?;
    new.persist(path)?;
    Ok(())
}
