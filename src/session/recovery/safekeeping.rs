//! A session's unsaved work, as far as its recovery file knows it.

use super::{keeper::Recovery, left::Left};
use std::{io, path::PathBuf, sync::Arc};

/// Unsaved work and its recovery file.
#[derive(Default)]
pub(crate) struct Safekeeping {
    /// `None`: this session keeps nothing.
    pub recovery: Option<Recovery>,
    /// The revision of the documents that the file was last told of.
    pub kept: Option<u64>,
    /// Work that was found and that a question stands for.
    pub found: Vec<Left>,
}

impl Safekeeping {
    /// Looks at once for what was left behind.
    pub fn new(folder: Option<PathBuf>, wake: &Arc<dyn Fn() + Send + Sync>) -> io::Result<Safekeeping> {
        let recovery = folder.map(|folder| Recovery::new(folder, wake.clone())).transpose()?;
        recovery.iter().for_each(Recovery::scan);
        Ok(Safekeeping { recovery, ..Safekeeping::default() })
    }
}
