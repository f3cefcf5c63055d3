//! A text of a project, and the file it lives in.

use std::{path::PathBuf, sync::Arc};

/// A text of the project, and the file it lives in.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// The name in diagnostics and tabs: the file's name (`buffer_a.glsl`) or the tab's (`Buffer A`).
    pub name: String,
    /// The file, where there is one of its own.
    pub path: Option<PathBuf>,
    pub text: Arc<str>,
}

impl Source {
    /// The name of the file that it is in, where its pass was renamed and it shall have another: from the project's
    /// folder, as [`Source::name`] is.
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
    /// Called by its path from the project's folder, with `/`.
    pub source: Source,
    /// The reason why it has no text, if it has none.
    pub trouble: Option<String>,
    /// The trouble is a limit of the whole project: what is named after it was not looked for.
    pub is_limit: bool,
    /// The text is not the file's: it was edited here and is not saved yet. Reading leaves it as it is.
    pub is_edited: bool,
}
