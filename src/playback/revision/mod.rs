//! A project as it was in a revision of its git repository.
//!
//! The repository may be a stranger's, and the program git starts what a repository's configuration names: to fetch an
//! object that is missing, to filter a file, to watch for changes, to show text. So git is not started. Objects and
//! refs are read here, by libraries that start nothing and fetch nothing, and the configuration decides nothing.
//!
//! [`repository`] says which folders are the repository and reads nothing outside them, [`refs`] and [`spec`] lead from
//! a revision's name to a commit, [`objects`] reads what the commit holds, within limits, and [`checkout`] writes
//! the project's folder, and that alone, into a temporary one.

mod checkout;
mod error;
mod objects;
mod refs;
mod repository;
mod spec;

pub use checkout::{Checkout, SkippedName};
pub use error::RevisionError;

use objects::Objects;
use repository::Repository;
use std::path::Path;

/// Writes a project's files as a revision has them into a folder that lasts as long as the [`Checkout`]. A single file's
/// project is all that lies in its folder. `revision` is what git calls one: a branch, a tag, a hash or its beginning,
/// `origin/main`, `HEAD~1`, `v1^{}`, `HEAD@{1}`. Fails for a project that is no file or folder of a git repository, for a
/// revision that is not there or has no such project, and for a repository that is damaged, asks for too much, or has
/// part of what it holds elsewhere.
pub fn at(project: &str, revision: &str) -> Result<Checkout, RevisionError> {
    let path = Path::new(project);
    let real = path.canonicalize().map_err(|_| RevisionError::NotOnDisk(project.to_owned()))?;
    let (folder, file) = if real.is_file() {
        // The name by which it was called, where that is a link.
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        (folder.canonicalize().map_err(|_| RevisionError::NotOnDisk(project.to_owned()))?, path.file_name())
    } else if real.is_dir() {
        (real, None)
    } else {
        return Err(RevisionError::NotOnDisk(project.to_owned()));
    };
    let repository = Repository::of(&folder)?;
    let objects = Objects::open(&repository.common)?;
    let tree = spec::tree(&repository, &objects, revision)?;
    let missing = |what: String| RevisionError::Missing { revision: revision.to_owned(), what };
    let below = folder.strip_prefix(&repository.root).unwrap_or(Path::new(""));
    let tree = checkout::below(&objects, tree, below)?.ok_or_else(|| missing(format!("file of {project}")))?;
    let mut checkout = checkout::write(&objects, tree, revision)?;
    if checkout.is_empty() {
        return Err(missing(format!("file of {project}")));
    }
    if let Some(file) = file {
        checkout.project.push(file);
        if !checkout.project.is_file() {
            return Err(missing(project.to_owned()));
        }
    }
    Ok(checkout)
}

#[cfg(test)]
mod tests;
