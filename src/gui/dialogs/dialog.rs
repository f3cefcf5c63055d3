//! A file dialog as any desktop has it, and how it can end.

use std::path::PathBuf;

/// A dialog to be shown.
#[derive(Clone, Debug)]
pub(crate) struct Dialog {
    pub title: &'static str,
    pub kind: Kind,
    /// The folder that it begins in.
    pub start: Option<PathBuf>,
}

#[derive(Clone, Debug)]
pub(crate) enum Kind {
    OpenFolder,
    /// The name of the kind of files, and their endings.
    OpenFile(&'static str, &'static [&'static str]),
    /// A path that need not be there, with a name to begin with.
    Save(String),
}

/// The end of a dialog.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    Path(PathBuf),
    Cancelled,
    /// The desktop has none, or it broke; nobody has chosen anything.
    Unavailable,
}
