//! A file dialog of any desktop, and its possible results.

use std::path::PathBuf;

/// A dialog to be shown.
#[derive(Clone, Debug)]
pub(crate) struct Dialog {
    pub title: &'static str,
    pub kind: Kind,
    /// The folder in which it starts.
    pub start: Option<PathBuf>,
}

#[derive(Clone, Debug)]
pub(crate) enum Kind {
    OpenFolder,
    /// The name of the kind of files, and their extensions.
    OpenFile(&'static str, &'static [&'static str]),
    /// A path that need not exist, with a suggested name.
    Save(String),
}

/// The result of a dialog.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    Path(PathBuf),
    Cancelled,
    /// The desktop has no dialogs, or the dialog failed; nothing was chosen.
    #[cfg_attr(any(windows, target_os = "macos"), allow(dead_code, reason = "these systems always have dialogs"))]
    Unavailable,
}
