//! A text of a project, and its file.

use std::{path::PathBuf, sync::Arc};

/// A text of the project, and its file.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// The name in diagnostics and tabs: the file's name (`buffer_a.glsl`) or the tab's (`Buffer A`).
    pub name: String,
    /// The file, if it has its own.
    pub path: Option<PathBuf>,
    pub text: Arc<str>,
}

impl Source {
    /// The name of its current file, if its pass was renamed and it will get another one: relative to the project's
    /// folder, like [`Source::name`].
    pub(super) fn renamed_from(&self) -> Option<String> {
        let there = self.path.as_ref()?.file_name()?.to_str()?;
        let (folder, wanted) = self.name.rsplit_once('/').map_or(("", &*self.name), |(folder, name)| (folder, name));
        let slash = if folder.is_empty() { "" } else { "/" };
        (there != wanted).then(|| format!("{folder}{slash}{there}"))
    }
}

/// A file that some text names in an `#include` line.
#[derive(Clone, Debug, PartialEq)]
pub struct Included {
    /// The text; its name is the path from the project's folder, with `/`.
    pub source: Source,
    /// The reason why it has no text, if it has none.
    pub trouble: Option<String>,
    /// True if the failure is a limit of the whole project: files named after it were not looked for.
    pub is_limit: bool,
    /// True if the text was edited here and is not saved yet, so it differs from the file. Reading does not replace it.
    pub is_edited: bool,
}
