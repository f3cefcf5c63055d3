//! A small picture of each project as it was last seen, for the list of recent projects.
//!
//! Owns the files, one per project, in the cache folder: a limited number of limited size. A picture is written when
//! its project is closed, or covered by that list.

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
/// The maximum size in pixels, across and up.
const SIZE: (u32, u32) = (320, 180);
/// The number of pictures that are kept; the oldest are removed.
const MOST: usize = 60;

/// The folder of these pictures.
pub(super) struct LastPictures {
    /// `None`: no pictures are kept.
    folder: Option<PathBuf>,
    /// Counts the pictures that were written.
    written: u64,
    /// The open project's picture is to be written when the engine is free.
    is_due: bool,
    pub ticket: Ticket<Result<Picture, EngineError>>,
}

impl LastPictures {
    pub(crate) fn new(cache_dir: Option<&Path>) -> Self {
        Self { folder: cache_dir.map(|dir| dir.join("pictures")), written: 0, is_due: false, ticket: Ticket::default() }
    }

    /// Requests a picture of the open project, which stays open.
    pub(crate) fn want(&mut self) {
        self.is_due = self.folder.is_some();
    }

    /// Adds the read-back of a requested picture, if the project's own picture is shown.
    pub(crate) fn request(&mut self, is_of_project: bool, tasks: &mut Tasks) {
        if std::mem::take(&mut self.is_due) && is_of_project {
            self.ticket = tasks.add(ReadPicture);
        }
    }

    pub(crate) fn written(&self) -> u64 {
        self.written
    }

    /// Returns the file of a project's picture. It may not exist.
    pub(crate) fn file(&self, project: &Path) -> Option<PathBuf> {
        Some(self.folder.as_ref()?.join(kept_files::name(project, EXTENSION)))
    }

    /// Returns whether pictures are kept.
    pub(crate) fn is_kept(&self) -> bool {
        self.folder.is_some()
    }

    /// Writes a project's picture atomically.
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

/// Returns a picture scaled to fit the maximum size, keeping its aspect ratio. `None` if it is empty.
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
    fn pictures_are_scaled_keeping_aspect_ratio() {
        let size = |width, height| small(&picture(width, height, [9, 8, 7, 0])).unwrap().dimensions();
        let sizes = [size(1920, 1080), size(1080, 1920), size(64, 36), size(8000, 1)];
        assert_eq!(sizes, [(320, 180), (101, 180), (64, 36), (320, 1)]);
        assert_eq!(small(&picture(4, 4, [200, 100, 50, 0])).unwrap().get_pixel(1, 1).0, [200, 100, 50]);
        assert!(small(&picture(0, 4, [0; 4])).is_none());
    }

    #[test]
    fn oldest_pictures_beyond_the_limit_are_removed() {
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
