//! Crash recovery: unsaved changes are stored in a recovery file within a second.
//!
//! Owns the folder of these files, their ownership, and the thread that writes them: the session passes on a project
//! and does not wait. There is one file per open project with unsaved changes, written atomically, and removed once
//! nothing is unsaved. A file belongs to the process that holds the lock next to it; a lock ends with its process, so a
//! file without a locked lock belonged to a process that was killed. This module asks no questions: unsaved work is
//! returned as [`Left`]. Files that a save has replaced are kept in the same folder for a while.

mod actions;
mod keeper;
mod left;
mod replaced;
mod slot;

pub(super) use actions::UnsavedWork;
use keeper::{News, Recovery};
use left::Left;
pub use replaced::{KEPT_DAYS, place_for_replaced};
use std::{env, path::PathBuf};

/// Returns the folder for recovery files: in `XDG_STATE_HOME` if that is set, otherwise in the platform's state folder.
/// `None` if there is none.
pub fn folder() -> Option<PathBuf> {
    let asked = env::var_os("XDG_STATE_HOME").map(PathBuf::from).filter(|path| path.is_absolute());
    let state = asked.or_else(dirs::state_dir).or_else(dirs::data_local_dir)?;
    Some(state.join("eddy").join("recovery"))
}

#[cfg(test)]
mod tests;
