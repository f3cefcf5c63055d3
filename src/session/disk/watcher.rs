//! The watcher of a project's folders.
//!
//! It reports only that something changed. Reading the files finds out what, because editors save in place, by rename,
//! in bursts and in parts. Folders are watched instead of files: a file that is replaced by rename would be lost.

use notify::{EventKind, RecursiveMode, Watcher, event::AccessKind, event::AccessMode};
use std::{
    collections::BTreeSet,
    path::PathBuf,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

pub(super) struct FolderWatcher {
    // Dropping it ends the watch.
    _watcher: notify::RecommendedWatcher,
    folders: BTreeSet<PathBuf>,
    changed: Arc<AtomicBool>,
}

impl FolderWatcher {
    /// Watches each folder itself, without its subfolders. `wake` is called from the watcher's thread. Returns the
    /// folders that cannot be watched, with the reason.
    pub(super) fn new(
        folders: BTreeSet<PathBuf>,
        wake: Arc<dyn Fn() + Send + Sync>,
    ) -> Result<(FolderWatcher, Vec<(PathBuf, notify::Error)>), notify::Error> {
        let changed = Arc::new(AtomicBool::new(false));
        let flag = changed.clone();
        let mut watcher = notify::recommended_watcher(move |event: notify::Result<notify::Event>| {
            // An error may mean that events were lost, so check as well.
            if event.is_ok_and(|e| !e.need_rescan() && is_reading(&e.kind)) {
                return;
            }
            flag.store(true, Ordering::Release);
            wake();
        })?;
        let failed = folders
            .iter()
            .filter_map(|f| watcher.watch(f, RecursiveMode::NonRecursive).err().map(|e| (f.clone(), e)))
            .collect();
        Ok((FolderWatcher { _watcher: watcher, folders, changed }, failed))
    }

    pub(super) fn folders(&self) -> &BTreeSet<PathBuf> {
        &self.folders
    }

    /// Returns whether anything has happened since the last call.
    pub(super) fn take_changed(&self) -> bool {
        self.changed.swap(false, Ordering::Acquire)
    }
}

/// The session's own reads must not count as changes.
fn is_reading(kind: &EventKind) -> bool {
    matches!(kind, EventKind::Access(access) if *access != AccessKind::Close(AccessMode::Write))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::{
        fs,
        time::{Duration, Instant},
    };

    fn until(what: &str, mut condition: impl FnMut() -> bool) {
        let end = Instant::now() + Duration::from_secs(10);
        while !condition() {
            assert!(Instant::now() < end, "never: {what}");
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    #[test]
    fn every_way_of_saving_is_seen_and_own_reads_are_not() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("image.glsl");
        fs::write(&file, "a").unwrap();
        let (watch, failed) = FolderWatcher::new([dir.path().to_owned()].into(), Arc::new(|| ())).unwrap();
        assert!(failed.is_empty());
        fs::write(&file, "b").unwrap();
        until("a write in place", || watch.take_changed());
        fs::write(dir.path().join("image.glsl~"), "c").unwrap();
        until("a new file", || watch.take_changed());
        fs::rename(dir.path().join("image.glsl~"), &file).unwrap();
        until("a rename over it", || watch.take_changed());
        fs::remove_file(&file).unwrap();
        until("a removal", || watch.take_changed());
        fs::write(&file, "d").unwrap();
        until("a write after the removal", || watch.take_changed());
        // Wait until the events of that write have passed.
        until("quiet", || {
            std::thread::sleep(Duration::from_millis(50));
            !watch.take_changed()
        });
        for _ in 0..5 {
            fs::read(&file).unwrap();
            fs::read_dir(dir.path()).unwrap().count();
        }
        // Events that the reads could cause have been delivered by then.
        std::thread::sleep(Duration::from_millis(50));
        assert!(!watch.take_changed(), "reading is no change");
    }

    #[test]
    fn missing_folder_is_reported() {
        let dir = tempfile::tempdir().unwrap();
        let gone = dir.path().join("gone");
        let (_, failed) = FolderWatcher::new([gone.clone(), dir.path().to_owned()].into(), Arc::new(|| ())).unwrap();
        assert_eq!(failed.len(), 1);
        assert_eq!(failed[0].0, gone);
    }
}
