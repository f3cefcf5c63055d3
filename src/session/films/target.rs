//! The files of a film: chosen before it starts, and removed if it fails.

use eddy_film::{Destination, Format, Output, picture_name};
use std::{
    fs,
    path::{Path, PathBuf},
};

/// The largest number that is tried.
const MOST: u32 = 999_999;

/// The place of a film.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Target {
    File {
        path: PathBuf,
        replaces: bool,
    },
    /// A folder for pictures, and the prefix of their names.
    Folder {
        path: PathBuf,
        stem: String,
        extension: &'static str,
    },
}

impl Target {
    /// Returns the place with the first free number.
    pub(super) fn numbered(folder: &Path, stem: &str, format: Format) -> Result<Target, String> {
        for n in 1..=MOST {
            let name =
                if format.is_still() { format!("{stem}-{n:04}") } else { format!("{stem}-{n:04}.{}", format.name()) };
            let path = folder.join(name);
            if path.symlink_metadata().is_err() {
                return Ok(Self::named(path, stem, format, false));
            }
        }
        Err(format!("{} has all numbers up to {MOST} for {stem}; move some files away", folder.display()))
    }

    pub(super) fn named(path: PathBuf, stem: &str, format: Format, replaces: bool) -> Target {
        match format.is_still() {
            true => Target::Folder { path, stem: stem.to_owned(), extension: format.name() },
            false => Target::File { path, replaces },
        }
    }

    pub(super) fn path(&self) -> &Path {
        match self {
            Target::File { path, .. } | Target::Folder { path, .. } => path,
        }
    }

    /// Returns the file of a frame's picture; for a film, the film.
    pub(super) fn picture(&self, frame: u32, last: u32) -> PathBuf {
        match self {
            Target::File { path, .. } => path.clone(),
            Target::Folder { path, stem, extension } => path.join(picture_name(stem, frame, last, extension)),
        }
    }

    /// Removes a film unless it replaced a file.
    pub(super) fn discard(&self) {
        if let Target::File { path, replaces: false } = self {
            let _ = fs::remove_file(path);
        }
    }

    pub(super) fn destination(&self) -> Destination {
        match self {
            Target::File { path, replaces: true } => Destination::Film(Output::File(path.clone())),
            Target::File { path, replaces: false } => Destination::Film(Output::NewFile(path.clone())),
            Target::Folder { .. } => Destination::PicturesWithin,
        }
    }
}

/// The pictures that a run has written, which are removed when dropped unless kept.
pub(super) struct Pictures {
    folder: PathBuf,
    made: bool,
    new: Vec<PathBuf>,
    is_kept: bool,
}

impl Pictures {
    /// Returns `None` for a single film file.
    pub(super) fn new(target: &Target) -> Option<Self> {
        let Target::Folder { path, .. } = target else { return None };
        Some(Self { made: !path.exists(), folder: path.clone(), new: Vec::new(), is_kept: false })
    }

    /// Records that a picture is about to be written.
    pub(super) fn note(&mut self, path: &Path) {
        if path.symlink_metadata().is_err() {
            self.new.push(path.to_owned());
        }
    }

    /// Keeps the pictures.
    pub(super) fn keep(mut self) {
        self.is_kept = true;
    }
}

impl Drop for Pictures {
    fn drop(&mut self) {
        if self.is_kept {
            return;
        }
        for path in &self.new {
            let _ = fs::remove_file(path);
        }
        if self.made {
            // A folder with other files stays.
            let _ = fs::remove_dir(&self.folder);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn taken_names_are_skipped() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("a-0001.mp4"), "").unwrap();
        fs::create_dir(folder.path().join("a-0001")).unwrap();
        let target = |format| Target::numbered(folder.path(), "a", format).unwrap();
        assert_eq!(target(Format::Mp4).path(), folder.path().join("a-0002.mp4"));
        assert_eq!(target(Format::Gif).path(), folder.path().join("a-0001.gif"));
        let pictures = target(Format::Png);
        assert_eq!(pictures.picture(3, 10), folder.path().join("a-0002/a_0003.png"));
    }

    #[test]
    fn failed_run_removes_only_its_own_pictures() {
        let home = tempfile::tempdir().unwrap();
        let target = Target::named(home.path().join("a"), "a", Format::Png, true);
        let write = |pictures: &mut Pictures, frame| {
            let path = target.picture(frame, 0);
            pictures.note(&path);
            fs::create_dir_all(target.path()).unwrap();
            fs::write(path, "").unwrap();
        };
        let mut pictures = Pictures::new(&target).unwrap();
        write(&mut pictures, 0);
        drop(pictures);
        assert!(!target.path().exists());
        let mut pictures = Pictures::new(&target).unwrap();
        write(&mut pictures, 0);
        pictures.keep();
        let mut pictures = Pictures::new(&target).unwrap();
        write(&mut pictures, 0);
        write(&mut pictures, 1);
        drop(pictures);
        assert_eq!(fs::read_dir(target.path()).unwrap().count(), 1, "the first one was there");
    }
}
