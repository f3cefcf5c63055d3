//! Projects in a revision of their git repository.
//!
//! The repository may be untrusted, and the program git runs commands that a repository's configuration names: to fetch
//! a missing object, to filter a file, to watch for changes, to show text. Therefore git is not run. Objects and refs
//! are read here, by libraries that run nothing and fetch nothing, and the configuration is ignored.
//!
//! [`repository`] finds the folders of the repository and reads nothing outside them, [`refs`] and [`spec`] resolve a
//! revision's name to a commit, [`objects`] reads the commit's content within limits, and [`checkout`] writes the
//! project's folder, and only that, into a temporary one.

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

/// Writes a project's files from a revision into a folder that exists as long as the [`Checkout`]. For a single-file
/// project this is its whole folder. `revision` has git's syntax: a branch, a tag, a hash or its prefix, `origin/main`,
/// `HEAD~1`, `v1^{}`, `HEAD@{1}`. Fails for a project that is not a file or folder of a git repository, for a revision
/// that does not exist or has no such project, and for a repository that is damaged, exceeds a limit, or stores part of
/// its objects elsewhere.
pub fn at(project: &str, revision: &str) -> Result<Checkout, RevisionError> {
    let path = Path::new(project);
    let real = path.canonicalize().map_err(|_| RevisionError::NotOnDisk(project.to_owned()))?;
    let (folder, file) = if real.is_file() {
        // The name as given, if it is a link.
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
