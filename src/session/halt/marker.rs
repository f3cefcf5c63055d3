//! A marker file that names the project whose new code is on the device. If it is found at the next start, that code
//! hung the picture or crashed the process.

use eddy_project::{Origin, Project, write_into};
use std::{
    fs,
    io::Write,
    path::{Path, PathBuf},
};

#[derive(Default)]
pub(super) struct Marker {
    /// The folder of marker files; `None`: none are written.
    folder: Option<PathBuf>,
    written: Option<PathBuf>,
}

impl Marker {
    /// `state_dir`: the folder for state that is kept between runs.
    pub(super) fn new(state_dir: Option<&Path>) -> Self {
        Self { folder: state_dir.map(|dir| dir.join("drawing")), written: None }
    }

    /// Records that new code of a project is on the device, and its first frame is not drawn yet.
    pub(super) fn set(&mut self, project: &Project) {
        let Some((file, path)) = self.file(project) else { return };
        if self.written.as_ref() == Some(&file) {
            return;
        }
        self.clear();
        let folder = file.parent().unwrap_or(Path::new(""));
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        match write_into(folder, &name, |out| writeln!(out, "{}", path.display())) {
            Ok(()) => self.written = Some(file),
            // The picture is drawn all the same: only the next start cannot detect a crash.
            Err(e) => log::warn!("cannot write {}: {e}", file.display()),
        }
    }

    /// Removes the marker: the code works.
    pub(super) fn clear(&mut self) {
        if let Some(file) = self.written.take()
            && let Err(e) = fs::remove_file(&file)
        {
            log::warn!("cannot remove {}, the marker of a frozen project: {e}", file.display());
        }
    }

    /// Leaves the marker for the next start.
    pub(super) fn leave(&mut self) {
        self.written = None;
    }

    /// Returns whether a project hung or crashed the process when it was last open, and takes over its file.
    pub(super) fn find(&mut self, project: &Project) -> bool {
        let found = self.file(project).map(|(file, _)| file).filter(|file| file.exists());
        let is_found = found.is_some();
        if is_found {
            self.written = found;
        }
        is_found
    }

    /// Returns a project's marker file and the path of the project; `None` for a project that is not stored in a file.
    fn file(&self, project: &Project) -> Option<(PathBuf, PathBuf)> {
        let path = match &project.origin {
            Origin::Folder { path, .. } | Origin::File(path) | Origin::Json(path) => path,
            Origin::Unsaved | Origin::Preset(_) => return None,
        };
        let path = path.canonicalize().unwrap_or_else(|_| path.clone());
        let name = format!("{:016x}.txt", hash(path.as_os_str().as_encoded_bytes()));
        Some((self.folder.as_ref()?.join(name), path))
    }
}

/// FNV-1a of 64 bits, which is stable across versions of Eddy.
fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marker_exists_until_first_frame_is_drawn() {
        let dir = tempfile::tempdir().unwrap();
        let mut project = crate::template::project();
        let mut marker = Marker::new(Some(dir.path()));
        marker.set(&project);
        assert!(!marker.find(&project), "what lies nowhere has no file");
        project.origin = Origin::File(dir.path().join("a.glsl"));
        let mut other = project.clone();
        other.origin = Origin::File(dir.path().join("b.glsl"));
        marker.set(&project);
        let mut next = Marker::new(Some(dir.path()));
        assert!(next.find(&project) && !next.find(&other));
        next.clear();
        assert!(!Marker::new(Some(dir.path())).find(&project));
        assert_eq!(hash(b"a"), 0xaf63_dc4c_8601_ec8c);
        Marker::new(None).set(&project);
    }
}
