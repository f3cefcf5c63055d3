//! A file that says which project's new code is on the device. Where one is found at the next start, the code froze the
//! picture or ended the process.

use eddy_project::{Origin, Project, write_into};
use std::{
    fs,
    io::Write,
    path::{Path, PathBuf},
};

#[derive(Default)]
pub(super) struct Marker {
    /// The folder of such files; without, none is written.
    folder: Option<PathBuf>,
    written: Option<PathBuf>,
}

impl Marker {
    /// `state_dir`: what is remembered between two starts lies there.
    pub(super) fn new(state_dir: Option<&Path>) -> Self {
        Self { folder: state_dir.map(|dir| dir.join("drawing")), written: None }
    }

    /// Says that code of a project is on the device whose first frame is not drawn yet.
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
            // The picture is drawn all the same: only the next start knows less.
            Err(e) => log::warn!("cannot write {}: {e}", file.display()),
        }
    }

    /// Says that all is well.
    pub(super) fn clear(&mut self) {
        if let Some(file) = self.written.take()
            && let Err(e) = fs::remove_file(&file)
        {
            log::warn!("cannot remove {}, the marker of a frozen project: {e}", file.display());
        }
    }

    /// Lets the file stay for the next start.
    pub(super) fn leave(&mut self) {
        self.written = None;
    }

    /// Returns whether a project froze or ended the process when it was open last, and takes over its file.
    pub(super) fn find(&mut self, project: &Project) -> bool {
        let found = self.file(project).map(|(file, _)| file).filter(|file| file.exists());
        let is_found = found.is_some();
        if is_found {
            self.written = found;
        }
        is_found
    }

    /// Returns a project's file, and the path that it is about; none for a project that lies in no file.
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

/// FNV-1a of 64 bits, which is the same in each version of Eddy.
fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_project_is_marked_until_all_is_well() {
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
