//! The folders of the repository that contains a project.
//!
//! A `.git` file or link names another folder, and so does `commondir`. In an untrusted repository it could name any
//! folder of the machine, so it is followed only if that folder agrees: it is in the same working tree, or it is the
//! enclosing repository, as for a submodule, or it is a working tree's entry that names this `.git` file, as `git
//! worktree` writes it. The owner of a folder does not matter, as nothing in it is run.

use super::error::{RevisionError, WITH_GIT};
use eddy_project::{confine, limits::Limit};
use std::{
    fs,
    path::{Path, PathBuf},
};

/// A file that contains a path.
const PATH: Limit = Limit { bytes: 16 << 10, of: "a path that git keeps" };

/// The folders of a repository, with links resolved.
pub(super) struct Repository {
    /// The working tree.
    pub root: PathBuf,
    /// The folder of this working tree alone, which contains `HEAD`.
    pub own: PathBuf,
    /// Objects and refs.
    pub common: PathBuf,
}

impl Repository {
    /// Returns the repository whose working tree contains a folder (with links resolved): the nearest `.git` from there
    /// up.
    pub(super) fn of(folder: &Path) -> Result<Self, RevisionError> {
        for root in folder.ancestors() {
            let dot_git = root.join(".git");
            let Ok(metadata) = dot_git.symlink_metadata() else { continue };
            let is_led = !metadata.is_dir();
            let own = if is_led { led(root, &dot_git)? } else { dot_git.clone() };
            let common = common(&own)?;
            if own.join("HEAD").symlink_metadata().is_ok() && common.join("objects").is_dir() {
                return Ok(Self { root: root.to_owned(), own, common });
            }
            if is_led {
                let said = format!("{} leads to {}, which is not a git repository", dot_git.display(), own.display());
                return Err(RevisionError::refused(said, "fix it with `git worktree repair` or a new clone"));
            }
        }
        let said = format!("neither {} nor a folder above it is a git repository", folder.display());
        Err(RevisionError::no_such(said, "create one with `git init`, and a revision with `git commit`"))
    }
}

/// Returns the folder that a `.git` file or link of a working tree leads to.
fn led(root: &Path, dot_git: &Path) -> Result<PathBuf, RevisionError> {
    let name = dot_git.display();
    let target = if dot_git.is_symlink() {
        dot_git.to_owned()
    } else {
        let text = text(root, ".git")?;
        let Some(target) = text.strip_prefix("gitdir:").map(str::trim).filter(|target| !target.is_empty()) else {
            return Err(RevisionError::damaged(name, "it does not say \"gitdir: FOLDER\""));
        };
        joined(root, target, dot_git)?
    };
    let Ok(target) = target.canonicalize() else {
        let said = format!("{name} leads to {}, which is not there", target.display());
        return Err(RevisionError::refused(said, "fix it with `git worktree repair` or a new clone"));
    };
    let is_around = || {
        let outer = root.ancestors().skip(1).map(|outer| outer.join(".git"));
        outer.filter(|git| !git.is_symlink()).any(|git| target.starts_with(git))
    };
    let is_registered = || {
        let named = text(&target, "gitdir").ok().map(|named| target.join(named.trim()));
        named.and_then(|named| named.canonicalize().ok()).is_some_and(|named| named == dot_git)
    };
    if target.is_dir() && (target.starts_with(root) || is_around() || !dot_git.is_symlink() && is_registered()) {
        return Ok(target);
    }
    let said = format!("{name} leads to {}, which does not name this working tree", target.display());
    Err(RevisionError::refused(said, "if the working tree was moved, run `git worktree repair`; otherwise clone again"))
}

/// Returns the folder with the objects and refs, given one that may be a working tree's entry.
fn common(own: &Path) -> Result<PathBuf, RevisionError> {
    if own.join("commondir").symlink_metadata().is_err() {
        return Ok(own.to_owned());
    }
    let named = text(own, "commondir")?;
    let common = joined(own, named.trim(), &own.join("commondir"))?.canonicalize().ok();
    common.filter(|common| own.parent() == Some(&common.join("worktrees"))).ok_or_else(|| {
        let said = format!("{} leads to another repository", own.join("commondir").display());
        RevisionError::refused(said, "clone the repository again")
    })
}

fn text(folder: &Path, name: &str) -> Result<String, RevisionError> {
    let bytes = confine::read(folder, name, PATH).map_err(|e| RevisionError::file(folder, &e))?;
    String::from_utf8(bytes).map_err(|_| RevisionError::damaged(folder.join(name).display(), "it is not Unicode"))
}

/// Resolves a path that the file `from` in `folder` contains.
fn joined(folder: &Path, path: &str, from: &Path) -> Result<PathBuf, RevisionError> {
    // Windows would connect to that machine, with the user's name and password.
    if cfg!(windows) && path.starts_with(['/', '\\']) && path[1..].starts_with(['/', '\\']) {
        let said = format!("{} leads to another machine", from.display());
        return Err(RevisionError::refused(said, "clone the repository to this one"));
    }
    Ok(folder.join(path))
}

/// Returns why the repository may lack an object, with the fix, if it declares that some are missing.
pub(super) fn why_missing(common: &Path) -> Option<String> {
    let is_there = |name: &str| common.join(name).symlink_metadata().is_ok();
    let has_alternates = ["objects/info/alternates", "objects/info/http-alternates"].into_iter().any(is_there);
    if has_alternates {
        let hint = "objects/info/alternates points to another folder, but Eddy reads only the repository's own \
                    folder; if you trust the repository, copy such objects into it with `git repack -a -d`";
        return Some(hint.into());
    }
    if is_there("shallow") {
        let hint = "the clone is shallow; if you trust the repository, get the rest with `git fetch --unshallow`";
        return Some(hint.into());
    }
    let is_partial = fs::read_dir(common.join("objects/pack"))
        .is_ok_and(|names| names.flatten().any(|n| n.path().extension().is_some_and(|e| e == "promisor")));
    // The configuration is read only to word this message.
    let config = confine::read(common, "config", Limit { bytes: 1 << 20, of: "git's configuration" });
    let config = String::from_utf8_lossy(&config.unwrap_or_default()).to_lowercase();
    let is_partial = is_partial || config.contains("partialclone") || config.contains("promisor");
    is_partial.then(|| format!("the clone is partial, and Eddy does not fetch; {WITH_GIT}"))
}
