//! Numbered image files as a video: `walk/0001.png`, `walk/0002.png` and so on.

use super::{Decode, FileLocation, Film, ReadFile, VideoError, VideoInfo, check_size, process::Stop};
use eddy_project::{limits, next_numbered};
use image::{ImageReader, Limits};
use std::{
    io::Cursor,
    path::{Path, PathBuf},
};

/// The default frames per second of a sequence.
const FRAME_RATE: f64 = 25.0;

/// Returns the frames per second from the end of the name of a sequence's folder: `walk-12fps`, `walk_29.97fps`. Other
/// folders have 25.
pub fn frame_rate_of(path: &Path) -> f64 {
    let folder = path.parent().and_then(Path::file_name).and_then(|name| name.to_str()).unwrap_or_default();
    let number = folder.strip_suffix("fps").map(|rest| {
        let start = rest.rfind(|c: char| !c.is_ascii_digit() && c != '.').map_or(0, |at| at + 1);
        &rest[start..]
    });
    let rate = number.and_then(|number| number.parse::<f64>().ok());
    rate.filter(|rate| (0.01..=1000.0).contains(rate)).unwrap_or(FRAME_RATE)
}

pub(crate) struct Sequence {
    first: PathBuf,
    read: ReadFile,
    info: VideoInfo,
    count: usize,
}

impl Sequence {
    pub(crate) fn open(place: &FileLocation<'_>, first: &[u8]) -> Result<Self, VideoError> {
        let (width, height) = reader(first)?.into_dimensions().map_err(damaged)?;
        check_size(width, height)?;
        let frame_rate = frame_rate_of(place.path);
        let (mut count, mut last) = (1, place.path.to_owned());
        while let Some(next) = next_numbered(&last).filter(|next| (place.read)(next).is_ok()) {
            count += 1;
            last = next;
            if count > limits::VIDEO_IMAGES {
                return Err(VideoError::TooMany);
            }
        }
        let seconds = count as f64 / frame_rate;
        if seconds > f64::from(limits::VIDEO_SECONDS) {
            return Err(VideoError::TooLong { seconds });
        }
        let info = VideoInfo { width, height, seconds, frame_rate, tolerance: 1e-6 };
        Ok(Self { first: place.path.to_owned(), read: place.read.clone(), info, count })
    }
}

fn damaged(error: impl std::fmt::Display) -> VideoError {
    VideoError::Damaged(error.to_string())
}

fn reader(bytes: &[u8]) -> Result<ImageReader<Cursor<&[u8]>>, VideoError> {
    let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(damaged)?;
    let mut allowed = Limits::no_limits();
    allowed.max_alloc = Some(4 * limits::VIDEO_FRAME_BYTES);
    reader.limits(allowed);
    Ok(reader)
}

impl Film for Sequence {
    fn info(&self) -> &VideoInfo {
        &self.info
    }

    fn start(&self, from: f64, _: &Stop) -> Result<Box<dyn Decode>, VideoError> {
        let start = ((from * self.info.frame_rate + 1e-6) as usize).min(self.count - 1);
        let mut path = self.first.clone();
        for _ in 0..start {
            path = next_numbered(&path).ok_or(VideoError::NoPicture)?;
        }
        let Self { read, info, count, .. } = self;
        Ok(Box::new(Run { path: Some(path), read: read.clone(), info: *info, next: start, count: *count, last: None }))
    }
}

struct Run {
    path: Option<PathBuf>,
    read: ReadFile,
    info: VideoInfo,
    next: usize,
    count: usize,
    last: Option<Vec<u8>>,
}

impl Run {
    fn decode(&self, path: &Path) -> Result<Vec<u8>, VideoError> {
        let bytes = (self.read)(path).map_err(damaged)?;
        let (width, height) = reader(&bytes)?.into_dimensions().map_err(damaged)?;
        if (width, height) != (self.info.width, self.info.height) {
            let reason = format!("{} has another size than the first image", path.display());
            return Err(VideoError::Damaged(reason));
        }
        Ok(reader(&bytes)?.decode().map_err(damaged)?.into_rgba8().into_raw())
    }
}

impl Decode for Run {
    fn next(&mut self) -> Result<Option<(f64, Vec<u8>)>, VideoError> {
        let Some(path) = self.path.take().filter(|_| self.next < self.count) else { return Ok(None) };
        // An image that cannot be read is replaced by the previous one.
        let texels = match (self.decode(&path), self.last.take()) {
            (Ok(texels), _) => texels,
            (Err(error), Some(last)) => {
                log::warn!("a frame is left out: {error}");
                last
            }
            (Err(error), None) => return Err(error),
        };
        let seconds = self.next as f64 / self.info.frame_rate;
        self.next += 1;
        self.path = next_numbered(&path);
        self.last = Some(texels.clone());
        Ok(Some((seconds, texels)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folder_names_determine_the_frame_rate() {
        for (path, rate) in [
            ("walk-12fps/1.png", 12.0),
            ("walk_29.97fps/1.png", 29.97),
            ("24fps/1.png", 24.0),
            ("walk/1.png", 25.0),
            ("0fps/1.png", 25.0),
            ("xfps/1.png", 25.0),
            ("1.png", 25.0),
        ] {
            assert_eq!(frame_rate_of(Path::new(path)), rate, "{path}");
        }
    }
}
