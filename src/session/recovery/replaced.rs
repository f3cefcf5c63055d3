//! Files of other projects that a save has replaced are kept for a while, below the recovery files.
//!
//! Owns their place and their lifetime. [`project::save`](eddy_project::save) copies them before anything is written.

use eddy_playback::capture::file_stem;
use std::{
    fs,
    path::{Path, PathBuf},
    time::{Duration, SystemTime},
};

/// The number of days for which they are kept.
pub const KEPT_DAYS: u64 = 30;
/// The folder of all of them, in the folder of the recovery files.
const ALL: &str = "replaced";

/// Returns a new folder for the files to be replaced at `target`: below the recovery files, or next to the target if
/// recovery is off (`NAME.replaced-0001`, which is never removed automatically).
pub fn place_for_replaced(recovery: Option<&Path>, target: &Path) -> PathBuf {
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    let (folder, stem) = match recovery {
        Some(recovery) => (recovery.join(ALL), file_stem(&name)),
        None => (target.parent().unwrap_or(Path::new("")).to_owned(), format!("{name}.replaced")),
    };
    let free = |n: u32| Some(folder.join(format!("{stem}-{n:04}"))).filter(|path| path.symlink_metadata().is_err());
    (1..).find_map(free).unwrap_or(folder)
}

/// Removes expired folders.
pub(super) fn sweep(recovery: &Path, now: SystemTime) {
    let Ok(entries) = fs::read_dir(recovery.join(ALL)) else { return };
    let old = now.checked_sub(Duration::from_secs(KEPT_DAYS * 24 * 60 * 60));
    for path in entries.flatten().map(|entry| entry.path()) {
        // A folder is as old as the newest file in it; a link is not followed.
        let meta = path.symlink_metadata();
        let written = meta.ok().filter(fs::Metadata::is_dir).and_then(|meta| meta.modified().ok());
        if written.zip(old).is_some_and(|(written, old)| written < old)
            && let Err(e) = fs::remove_dir_all(&path)
        {
            log::warn!("cannot remove {}: {e}", path.display());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replaced_files_are_removed_after_thirty_days() {
        let dir = tempfile::tempdir().unwrap();
        let place = || place_for_replaced(Some(dir.path()), Path::new("/work/sea shore"));
        let kept = [place(), {
            fs::create_dir_all(place()).unwrap();
            place()
        }];
        fs::create_dir_all(&kept[1]).unwrap();
        assert_ne!(kept[0], kept[1]);
        kept.iter().for_each(|path| fs::write(path.join("image.glsl"), "precious").unwrap());
        let other = dir.path().join("work-1.json");
        fs::write(&other, "{}").unwrap();
        let days = |n: u64| SystemTime::now() + Duration::from_secs(n * 24 * 60 * 60);
        sweep(dir.path(), days(29));
        assert!(kept.iter().all(|path| path.join("image.glsl").exists()));
        fs::File::open(&kept[1]).unwrap().set_modified(days(5)).unwrap();
        sweep(dir.path(), days(31));
        assert_eq!(kept.each_ref().map(|path| path.exists()), [false, true]);
        assert!(other.exists());
        let beside = place_for_replaced(None, &dir.path().join("mine"));
        assert_eq!(beside, dir.path().join("mine.replaced-0001"));
    }
}
