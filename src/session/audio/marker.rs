//! A marker file that exists while the sound device is being opened. If it is found at the next start, a sound driver
//! crashed the program, and the device stays closed until the user opens it again.

use eddy_audio::host::{AudioHost, AudioIn, AudioOut, DeviceError, Events, Fill, Format, Opened};
use eddy_project::{confine, limits, write_into};
use std::{
    fs,
    io::Write,
    path::{Path, PathBuf},
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

/// The file's name in the state folder.
const FILE: &str = "opening-sound.txt";
/// The file's content for the system's default device.
const DEFAULT: &str = "default";

/// The marker file, shared by the session and the thread that opens devices.
#[derive(Clone, Debug, Default)]
pub(super) struct OutputMarker {
    /// `None`: no state is kept between runs.
    file: Option<PathBuf>,
    is_written: Arc<AtomicBool>,
}

/// The device that was being opened when the program ended; `None` is the system's default one.
pub(super) type UnfinishedOpen = Option<String>;

impl OutputMarker {
    pub(super) fn new(state_dir: Option<&Path>) -> Self {
        Self { file: state_dir.map(|dir| dir.join(FILE)), is_written: Arc::default() }
    }

    /// Returns the device that the previous run was opening when it ended, if there was one.
    pub(super) fn found(&self) -> Option<UnfinishedOpen> {
        let text = confine::read_state(self.file.as_ref()?, limits::STATE_FILE).ok()??;
        let name = text.trim_end_matches('\n');
        Some((name != DEFAULT).then(|| name.to_owned()))
    }

    fn set(&self, device: Option<&str>) {
        let Some(file) = &self.file else { return };
        let folder = file.parent().unwrap_or(Path::new(""));
        match write_into(folder, FILE, |out| writeln!(out, "{}", device.unwrap_or(DEFAULT))) {
            Ok(()) => self.is_written.store(true, Ordering::Release),
            // Sound plays all the same: only the next start cannot detect a crash.
            Err(e) => log::warn!("cannot write {}: {e}", file.display()),
        }
    }

    /// Removes the marker of this run: the device plays, or was refused.
    pub(super) fn clear(&self) {
        if self.is_written.swap(false, Ordering::AcqRel) {
            self.remove();
        }
    }

    /// Removes the marker that was found.
    pub(super) fn remove(&self) {
        if let Some(file) = &self.file
            && let Err(e) = fs::remove_file(file)
            && e.kind() != std::io::ErrorKind::NotFound
        {
            log::warn!("cannot remove {}, the marker of a sound device: {e}", file.display());
        }
    }
}

/// An audio host that writes the marker while it opens an output.
#[derive(Debug)]
pub(super) struct MarkedHost {
    pub host: Arc<dyn AudioHost>,
    pub marker: OutputMarker,
}

impl AudioHost for MarkedHost {
    fn output(&self) -> Box<dyn AudioOut> {
        Box::new(MarkingOutput { out: self.host.output(), marker: self.marker.clone() })
    }

    fn input(&self) -> Box<dyn AudioIn> {
        self.host.input()
    }
}

struct MarkingOutput {
    out: Box<dyn AudioOut>,
    marker: OutputMarker,
}

impl AudioOut for MarkingOutput {
    fn names(&mut self) -> Vec<String> {
        self.out.names()
    }

    fn open(
        &mut self,
        name: Option<&str>,
        fill: &mut dyn FnMut(Format) -> Fill,
        events: Events,
    ) -> Result<Opened, DeviceError> {
        self.marker.set(name);
        let opened = self.out.open(name, fill, events);
        // An opened device may still crash the program when it plays, so the session waits a moment before it clears
        // the marker.
        if opened.is_err() {
            self.marker.clear();
        }
        opened
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marker_exists_until_device_plays_or_fails() {
        let dir = tempfile::tempdir().unwrap();
        let state = dir.path().join("state");
        let marker = OutputMarker::new(Some(&state));
        assert_eq!(marker.found(), None);
        marker.set(None);
        assert_eq!(OutputMarker::new(Some(&state)).found(), Some(None));
        marker.set(Some("Loud speakers"));
        let next = OutputMarker::new(Some(&state));
        assert_eq!(next.found(), Some(Some("Loud speakers".into())));
        next.clear();
        assert!(next.found().is_some(), "it is of another run");
        next.remove();
        assert_eq!(next.found(), None);
        marker.clear();
        OutputMarker::new(None).set(None);
    }
}
