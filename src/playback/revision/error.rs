//! Errors of reading a revision.

use eddy_project::confine::{FileError, Reason};
use std::{io, path::Path};

/// The revision of a project does not exist, or is not read. The text is complete: the error, the reason and the fix.
#[derive(Debug, thiserror::Error)]
pub enum RevisionError {
    #[error("{0} is not a file or folder: only these have revisions")]
    NotOnDisk(String),
    #[error("{revision} has no {what}; choose a revision that has it")]
    Missing { revision: String, what: String },
    #[error("git has no such revision: {said}; {hint}")]
    NoSuch { said: String, hint: String },
    /// The repository is damaged, exceeds a limit, or is not read for another reason.
    #[error("{said}; {hint}")]
    Refused { said: String, hint: String },
    #[error("cannot write the revision to a temporary folder: {0}; free disk space there")]
    Write(#[from] io::Error),
}

/// The fix for a revision that git reads but Eddy does not.
pub(super) const WITH_GIT: &str = "if you trust the repository, write the revision to a folder with `git worktree add \
                            FOLDER REVISION` and compare with that folder";

impl RevisionError {
    pub(super) fn no_such(said: impl Into<String>, hint: impl Into<String>) -> Self {
        Self::NoSuch { said: said.into(), hint: hint.into() }
    }

    pub(super) fn refused(said: impl Into<String>, hint: impl Into<String>) -> Self {
        Self::Refused { said: said.into(), hint: hint.into() }
    }

    /// A file of the repository that git would not have written.
    pub(super) fn damaged(what: impl std::fmt::Display, why: impl std::fmt::Display) -> Self {
        Self::refused(format!("{what} is damaged: {why}"), "clone the repository again")
    }

    /// A file of the repository in `folder` that is not read.
    pub(super) fn file(folder: &Path, error: &FileError) -> Self {
        let hint = match &error.reason {
            Reason::Link => {
                let said = format!("{} in {} is a link that leads out of it", error.file, folder.display());
                return Self::refused(said, "Eddy reads only the repository's own folder: put the file there");
            }
            Reason::NotAFile(_) => "git creates regular files: clone the repository again",
            Reason::TooLarge(_) | Reason::TooMuch(_) => WITH_GIT,
            _ => return Self::refused(error.to_string(), error.hint()),
        };
        Self::refused(error.to_string(), hint)
    }
}
