//! A project as it was in a revision of its git repository.

use anyhow::{Context, bail};
use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};
use tempfile::TempDir;

/// Writes a project's files as a revision has them into a folder that lasts as long as the first that is returned; the
/// second is the project in it. Fails for a project that is no file or folder of a git repository, and where there is
/// no `git`.
pub fn at(project: &str, revision: &str) -> anyhow::Result<(TempDir, PathBuf)> {
    let path = Path::new(project);
    if !path.exists() {
        bail!("{project} is no file or folder: only these have revisions");
    }
    let file = path.is_file().then(|| path.file_name().unwrap_or_default());
    let folder = if file.is_some() { path.parent().unwrap_or(path) } else { path };
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let listed = git(folder, &["ls-tree", "-r", "-z", "--name-only", revision, "--", "."], project)?;
    let copy = tempfile::tempdir().context("cannot make a folder for the revision")?;
    let listed = String::from_utf8_lossy(&listed.stdout).into_owned();
    let mut names = listed.split('\0').filter(|name| !name.is_empty()).peekable();
    if names.peek().is_none() {
        bail!("{revision} has no file of {project}");
    }
    for name in names {
        let out = copy.path().join(name);
        let contents = git(folder, &["show", &format!("{revision}:./{name}")], project)?.stdout;
        out.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::write(&out, contents))?;
    }
    let there = file.map_or_else(|| copy.path().to_owned(), |file| copy.path().join(file));
    if !there.exists() {
        bail!("{revision} has no {project}");
    }
    Ok((copy, there))
}

fn git(folder: &Path, arguments: &[&str], project: &str) -> anyhow::Result<Output> {
    let output = Command::new("git").arg("-C").arg(folder).args(arguments).output();
    let output = output.context("revisions are read by the program git, which cannot be run")?;
    if !output.status.success() {
        bail!("git has no such revision of {project}: {}", String::from_utf8_lossy(&output.stderr).trim());
    }
    Ok(output)
}
