//! Unsaved work outlives the process: what differs from the disk is kept in a recovery file within a second.
//!
//! Owns the folder of these files, whose they are, and the thread that writes them: the session hands over a project
//! and goes on. There is one file for each project that is open with something unsaved, written whole or not at all,
//! and gone once nothing is unsaved. A file belongs to the process that holds the lock beside it; a lock ends with its
//! process, so a file that nobody holds was left behind by one that was killed. Knows nothing of questions: what was
//! left behind is handed out as [`Left`]. What a save has replaced is kept in the same folder for a while.

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

/// Returns the folder for recovery files: in `XDG_STATE_HOME` where that is set, else where the platform keeps such
/// things. `None` where there is no such place.
pub fn folder() -> Option<PathBuf> {
    let asked = env::var_os("XDG_STATE_HOME").map(PathBuf::from).filter(|path| path.is_absolute());
    let state = asked.or_else(dirs::state_dir).or_else(dirs::data_local_dir)?;
    Some(state.join("eddy").join("recovery"))
}

#[cfg(test)]
mod tests;
