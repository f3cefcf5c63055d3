//! The picture of each project as it was seen last, small, for the list of recent projects.
//!
//! Owns the files, one a project, in the folder for what can be made again: so many of so many pixels at most. One is
//! written when its project is closed, or covered by that list.

use super::{
    drawing::{Tasks, Ticket},
    kept_files,
    read_back::ReadPicture,
};
use eddy_engine::{EngineError, Picture};
use eddy_project as project;
use image::{RgbImage, codecs::jpeg::JpegEncoder, imageops};
use std::{
    io,
    path::{Path, PathBuf},
};

const EXTENSION: &str = "jpg";
/// The most pixels across and up.
const SIZE: (u32, u32) = (320, 180);
/// So many projects have one; the oldest go.
const MOST: usize = 60;

/// The folder of these pictures.
pub(super) struct LastPictures {
    /// `None`: none are kept.
    folder: Option<PathBuf>,
    /// Counts those that were written.
    written: u64,
    /// The open project's is to be written when the engine has time.
    is_due: bool,
    pub ticket: Ticket<Result<Picture, EngineError>>,
}

impl LastPictures {
    pub(crate) fn new(cache_dir: Option<&Path>) -> Self {
        Self { folder: cache_dir.map(|dir| dir.join("pictures")), written: 0, is_due: false, ticket: Ticket::default() }
    }

    /// The open project's picture is wanted, and the project stays open.
    pub(crate) fn want(&mut self) {
        self.is_due = self.folder.is_some();
    }

    /// Asks for the picture where it is wanted, and is the project's own.
    pub(crate) fn request(&mut self, is_of_project: bool, tasks: &mut Tasks) {
        if std::mem::take(&mut self.is_due) && is_of_project {
            self.ticket = tasks.add(ReadPicture);
        }
    }

    pub(crate) fn written(&self) -> u64 {
        self.written
    }

    /// Returns the file of a project's picture. It may not be there.
    pub(crate) fn file(&self, project: &Path) -> Option<PathBuf> {
        Some(self.folder.as_ref()?.join(kept_files::name(project, EXTENSION)))
    }

    /// Returns whether pictures are kept.
    pub(crate) fn is_kept(&self) -> bool {
        self.folder.is_some()
    }

    /// Writes a project's picture, whole or not at all.
    pub(crate) fn keep(&mut self, project: &Path, picture: &Picture) -> io::Result<()> {
        let Some(path) = self.file(project) else { return Ok(()) };
        let Some(small) = small(picture) else { return Ok(()) };
        let folder = path.parent().unwrap_or(Path::new(""));
        project::make_private(folder)?;
        let mut new = tempfile::NamedTempFile::new_in(folder)?;
        JpegEncoder::new_with_quality(new.as_file_mut(), 88).encode_image(&small).map_err(io::Error::other)?;
        new.persist(&path)?;
        kept_files::sweep(folder, EXTENSION, MOST);
        self.written += 1;
        Ok(())
    }
}

/// Returns a picture in its own shape with as many pixels as are kept. `None`: it has none.
fn small(picture: &Picture) -> Option<RgbImage> {
    let rgb = picture.bytes.chunks_exact(4).flat_map(|texel| [texel[0], texel[1], texel[2]]).collect();
    let whole = RgbImage::from_raw(picture.width, picture.height, rgb).filter(|image| !image.is_empty())?;
    let (width, height) = whole.dimensions();
    let scale = (f64::from(SIZE.0) / f64::from(width)).min(f64::from(SIZE.1) / f64::from(height)).min(1.0);
    let side = |side: u32| ((f64::from(side) * scale).round() as u32).max(1);
    Some(imageops::thumbnail(&whole, side(width), side(height)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    fn picture(width: u32, height: u32, colour: [u8; 4]) -> Picture {
        Picture { width, height, bytes: colour.repeat((width * height) as usize) }
    }

    #[test]
    fn pictures_are_small_in_their_own_shape() {
        let size = |width, height| small(&picture(width, height, [9, 8, 7, 0])).unwrap().dimensions();
        let sizes = [size(1920, 1080), size(1080, 1920), size(64, 36), size(8000, 1)];
        assert_eq!(sizes, [(320, 180), (101, 180), (64, 36), (320, 1)]);
        assert_eq!(small(&picture(4, 4, [200, 100, 50, 0])).unwrap().get_pixel(1, 1).0, [200, 100, 50]);
        assert!(small(&picture(0, 4, [0; 4])).is_none());
    }

    #[test]
    fn so_many_are_kept_and_the_oldest_go() {
        let dir = tempfile::tempdir().unwrap();
        let mut kept = LastPictures::new(Some(dir.path()));
        let project = |n: usize| PathBuf::from(format!("/nowhere/{n}"));
        for n in 0..MOST + 5 {
            kept.keep(&project(n), &picture(1280, 720, [n as u8, 0, 0, 255])).unwrap();
            std::thread::sleep(Duration::from_millis(3));
        }
        let files: Vec<_> = std::fs::read_dir(dir.path().join("pictures")).unwrap().flatten().collect();
        assert_eq!(files.len(), MOST);
        assert!(files.iter().all(|file| file.metadata().unwrap().len() < 100_000));
        assert!(!kept.file(&project(0)).unwrap().exists() && kept.file(&project(MOST + 4)).unwrap().exists());
        let again = image::open(kept.file(&project(60)).unwrap()).unwrap().to_rgb8();
        assert_eq!(again.dimensions(), (320, 180));
        assert!(again.get_pixel(5, 5).0[0].abs_diff(60) < 6, "{:?}", again.get_pixel(5, 5));
        assert_eq!(LastPictures::new(None).file(&project(0)), None);
    }
}
