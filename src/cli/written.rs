//! Files that a command writes into its own folder, all or none.

use crate::project::{self, ProjectError};
use std::{fs, io::Write, path::Path};

/// Creates the folder that `option` names, unless it exists.
pub(super) fn make_folder(option: &str, folder: &Path) -> anyhow::Result<()> {
    check_is_no_file(option, folder)?;
    fs::create_dir_all(folder)
        .map_err(|error| anyhow::anyhow!("{option} {}: the folder cannot be made: {error}", folder.display()))
}

fn check_is_no_file(option: &str, folder: &Path) -> anyhow::Result<()> {
    anyhow::ensure!(
        folder.is_dir() || !folder.exists(),
        "{option} {}: this is a file; give a folder",
        folder.display()
    );
    Ok(())
}

/// Writes files into a folder, which is created if necessary. An existing file with different content is an error,
/// unless `force` permits it; then nothing is written. The files must be regular ones within the folder.
pub(super) fn write_all<'a>(
    folder: &Path,
    files: impl IntoIterator<Item = (&'a str, &'a [u8])> + Clone,
    force: bool,
) -> anyhow::Result<()> {
    check_is_no_file("--out", folder)?;
    if !force {
        let is_other = |(name, bytes): &(&str, &[u8])| {
            let path = folder.join(name);
            path.symlink_metadata().is_ok() && fs::read(&path).ok().as_deref() != Some(*bytes)
        };
        let paths: Vec<_> = files.clone().into_iter().filter(is_other).map(|(name, _)| folder.join(name)).collect();
        if !paths.is_empty() {
            return Err(ProjectError::WouldOverwrite { paths }.into());
        }
    }
    make_folder("--out", folder)?;
    for (name, bytes) in files {
        project::write_into(folder, name, |file| file.write_all(bytes))
            .map_err(|error| anyhow::anyhow!("{}: {error}", folder.join(name).display()))?;
    }
    Ok(())
}
