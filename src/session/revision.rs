//! A project as it was in a revision of its git repository.

use std::{
    fs, io,
    path::{Path, PathBuf},
    process::{Command, Output},
};
use tempfile::TempDir;

/// There is no such revision of a project.
#[derive(Debug, thiserror::Error)]
pub enum RevisionError {
    #[error("{0} is no file or folder: only these have revisions")]
    NotOnDisk(String),
    #[error("{revision} has no {what}")]
    Missing { revision: String, what: String },
    #[error("revisions are read by the program git, which cannot be run: {0}")]
    NoGit(io::Error),
    #[error("git has no such revision of {project}: {said}")]
    Git { project: String, said: String },
    #[error("cannot make a folder for the revision: {0}")]
    Copy(#[from] io::Error),
}

/// Writes a project's files as a revision has them into a folder that lasts as long as the first that is returned; the
/// second is the project in it. Fails for a project that is no file or folder of a git repository, and where there is
/// no `git`.
pub fn at(project: &str, revision: &str) -> Result<(TempDir, PathBuf), RevisionError> {
    let path = Path::new(project);
    if !path.exists() {
        return Err(RevisionError::NotOnDisk(project.to_owned()));
    }
    let missing = |what: String| RevisionError::Missing { revision: revision.to_owned(), what };
    let file = path.is_file().then(|| path.file_name().unwrap_or_default());
    let folder = if file.is_some() { path.parent().unwrap_or(path) } else { path };
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let listed = git(folder, &["ls-tree", "-r", "-z", "--name-only", revision, "--", "."], project)?;
    let copy = tempfile::tempdir()?;
    let listed = String::from_utf8_lossy(&listed.stdout).into_owned();
    let mut names = listed.split('\0').filter(|name| !name.is_empty()).peekable();
    if names.peek().is_none() {
        return Err(missing(format!("file of {project}")));
    }
    for name in names {
        let out = copy.path().join(name);
        let contents = git(folder, &["show", &format!("{revision}:./{name}")], project)?.stdout;
        out.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::write(&out, contents))?;
    }
    let there = file.map_or_else(|| copy.path().to_owned(), |file| copy.path().join(file));
    if !there.exists() {
        return Err(missing(project.to_owned()));
    }
    Ok((copy, there))
}

fn git(folder: &Path, arguments: &[&str], project: &str) -> Result<Output, RevisionError> {
    let output = Command::new("git").arg("-C").arg(folder).args(arguments).output().map_err(RevisionError::NoGit)?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr).trim().to_owned();
        return Err(RevisionError::Git { project: project.to_owned(), said });
    }
    Ok(output)
}
