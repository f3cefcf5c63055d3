//! The inputs of projects that were closed while paused, from which the next start draws the shown frame again.
//!
//! Owns the files, one per project, in the folder for state that is kept between runs. Each is a recording
//! ([`Recording`]). A project whose passes do not read the last frame needs none.

use super::kept_files;
use eddy_playback::recording::{EXTENSION, RecordedFrame, Recording};
use eddy_playback::run::Frame;
use eddy_playback::scene::LONGEST;
use eddy_project::{self as project, Origin, confine, limits};
use std::{
    fs,
    io::{self, BufReader, BufWriter, Write},
    path::{Path, PathBuf},
    sync::Arc,
};

/// The maximum number of stored runs; the oldest are removed.
const MOST: usize = 50;

/// The folder of the runs.
pub(super) struct Runs {
    /// `None`: nothing is stored.
    folder: Option<PathBuf>,
}

impl Runs {
    /// `state_dir`: the folder for state that is kept between runs.
    pub(crate) fn new(state_dir: Option<&Path>) -> Self {
        Self { folder: state_dir.map(|dir| dir.join("runs")) }
    }

    /// Returns whether a run of this many frames is stored for a project.
    pub(crate) fn takes(&self, origin: &Origin, frames: u64) -> bool {
        frames <= LONGEST as u64 && self.file(origin).is_some()
    }

    /// Stores a run from its first frame.
    pub(crate) fn keep(&self, origin: &Origin, project: String, frames: Vec<Frame>) -> io::Result<()> {
        let Some(path) = self.file(origin) else { return Ok(()) };
        let one = |(index, frame): (usize, Frame)| RecordedFrame {
            inputs: frame.inputs,
            size: frame.size,
            values: Arc::unwrap_or_clone(frame.values),
            reset: index == 0,
        };
        let recording = Recording { project, frames: frames.into_iter().enumerate().map(one).collect() };
        let folder = path.parent().unwrap_or(Path::new(""));
        project::make_private(folder)?;
        let new = tempfile::NamedTempFile::new_in(folder)?;
        let mut out = BufWriter::new(new);
        recording.write(&mut out)?;
        out.flush()?;
        out.into_inner().map_err(io::IntoInnerError::into_error)?.persist(&path)?;
        kept_files::sweep(folder, EXTENSION, MOST);
        Ok(())
    }

    /// Removes the run of a project.
    pub(crate) fn forget(&self, origin: &Origin) {
        let Some(path) = self.file(origin) else { return };
        match fs::remove_file(&path) {
            Err(e) if e.kind() != io::ErrorKind::NotFound => log::warn!("cannot remove {}: {e}", path.display()),
            Ok(()) | Err(_) => {}
        }
    }

    /// Returns the frames of a project's run, if one is stored and readable.
    pub(crate) fn of(&self, origin: &Origin) -> Option<Vec<Frame>> {
        let path = self.file(origin)?;
        let file = confine::open_state(&path, limits::RUN).ok()?;
        let recording = Recording::read_within(BufReader::new(file), limits::RUN, limits::RUN_BYTES)
            .inspect_err(|e| log::warn!("cannot read {}: {e}", path.display()))
            .ok()?;
        if recording.frames.len() > LONGEST {
            return None;
        }
        let mut values = Arc::default();
        let one = |frame: RecordedFrame| {
            // Frames with the same values share them.
            if *values != frame.values {
                values = Arc::new(frame.values);
            }
            Frame { inputs: frame.inputs, values: values.clone(), size: frame.size }
        };
        Some(recording.frames.into_iter().map(one).collect())
    }

    fn file(&self, origin: &Origin) -> Option<PathBuf> {
        let path = kept_files::path_of(origin)?;
        Some(self.folder.as_ref()?.join(kept_files::name(path, EXTENSION)))
    }
}
