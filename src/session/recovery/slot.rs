//! A slot is a recovery file with the lock that marks its owner.
//!
//! Slots are taken, found and released under a lock of the whole folder that is held briefly: so no two processes take
//! one slot, and none removes a lock that another is about to hold.

use eddy_playback::capture::file_stem;
use eddy_project::{Origin, Project};
use std::{
    fs::{self, DirBuilder, File, TryLockError},
    hash::{DefaultHasher, Hash, Hasher},
    io,
    path::{Path, PathBuf},
};

const DATA: &str = "json";
const LOCK: &str = "lock";
/// The lock of the folder.
const TURN: &str = ".turn";

/// A recovery file that this process owns as long as the value lives.
#[derive(Debug)]
pub(super) struct Slot {
    pub data: PathBuf,
    /// `None` on a file system without locks.
    _lock: Option<File>,
}

impl Slot {
    /// Takes a new slot for a project.
    pub(super) fn take(folder: &Path, project: &Project) -> io::Result<Slot> {
        let _turn = turn(folder)?;
        let key = key(project);
        for n in 1.. {
            let data = folder.join(format!("{key}-{n}.{DATA}"));
            // It belongs to another window, or is an orphan.
            if data.exists() {
                continue;
            }
            if let Lock::Acquired(lock) = acquire(&data)? {
                return Ok(Slot { data, _lock: lock });
            }
        }
        unreachable!("numbers do not end")
    }

    /// Returns every slot whose process has ended; this process owns them from now on.
    pub(super) fn left_over(folder: &Path) -> io::Result<Vec<Slot>> {
        let entries = match fs::read_dir(folder) {
            Ok(entries) => entries,
            Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(e) => return Err(e),
        };
        let _turn = turn(folder)?;
        let mut slots = Vec::new();
        for path in entries.flatten().map(|entry| entry.path()) {
            let extension = path.extension().unwrap_or_default();
            if extension == DATA && path.is_file() {
                if let Lock::Acquired(lock) = acquire(&path)? {
                    slots.push(Slot { data: path, _lock: lock });
                }
            } else if extension == LOCK && !path.with_extension(DATA).exists() {
                // Its process ended before it wrote anything.
                if let Lock::Acquired(_lock) = acquire(&path.with_extension(DATA))? {
                    remove(&path)?;
                }
            }
        }
        Ok(slots)
    }

    /// Removes the file and releases the slot.
    pub(super) fn end(self, folder: &Path) -> io::Result<()> {
        let _turn = turn(folder)?;
        remove(&self.data)?;
        remove(&self.data.with_extension(LOCK))
    }
}

enum Lock {
    /// `None` on a file system without locks.
    Acquired(Option<File>),
    /// Another process holds it.
    Taken,
}

/// Opens a lock file after checking its type: opening a pipe would block until there is a reader.
fn open_lock(path: &Path) -> io::Result<File> {
    if fs::metadata(path).is_ok_and(|there| !there.is_file()) {
        let what = format!("{} is not a regular file; remove it", path.display());
        return Err(io::Error::new(io::ErrorKind::InvalidInput, what));
    }
    File::options().create(true).truncate(false).write(true).open(path)
}

/// Takes the lock of a slot if no other process holds it.
fn acquire(data: &Path) -> io::Result<Lock> {
    let file = open_lock(&data.with_extension(LOCK))?;
    match file.try_lock() {
        Ok(()) => Ok(Lock::Acquired(Some(file))),
        Err(TryLockError::WouldBlock) => Ok(Lock::Taken),
        // A file system without locks: storing without a lock is better than not storing.
        Err(TryLockError::Error(_)) => Ok(Lock::Acquired(None)),
    }
}

/// Waits for the lock of the folder, which is created if necessary: readable by its owner only, as texts are private. On
/// Windows it inherits the access of the user's folder of local data, which is private.
fn turn(folder: &Path) -> io::Result<File> {
    let mut builder = DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(folder)?;
    let file = open_lock(&folder.join(TURN))?;
    if let Err(e) = file.lock() {
        log::debug!("no lock in {}: {e}", folder.display());
    }
    Ok(file)
}

fn remove(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(e) if e.kind() != io::ErrorKind::NotFound => Err(e),
        Ok(()) | Err(_) => Ok(()),
    }
}

/// A readable name that is distinct for two projects with the same name.
fn key(project: &Project) -> String {
    let place = match &project.origin {
        Origin::Unsaved => String::new(),
        Origin::Preset(name) => name.clone(),
        Origin::Folder { path, .. } | Origin::File(path) | Origin::Json(path) => {
            path.canonicalize().unwrap_or_else(|_| path.clone()).display().to_string()
        }
    };
    let mut hasher = DefaultHasher::new();
    place.hash(&mut hasher);
    format!("{}-{:08x}", file_stem(&project.name), hasher.finish() as u32)
}
