//! Videos: files, animated image files, image sequences and cameras as frames with their times.
//!
//! A [`Video`] provides the size of its frames and its length; [`FrameSource::frame_at`] returns the frame at a
//! position. Formats that are not decoded here are decoded by the programs ffmpeg and ffprobe, which get an opened file
//! and never a name from a project. [`Encoder`] runs ffmpeg as an encoder. Frames have 4 bytes per texel (RGBA, 8 bits
//! each, alpha not premultiplied), top row first.

mod animation;
mod camera;
mod encoder;
mod error;
mod ffmpeg;
#[cfg(windows)]
mod job;
mod numbered;
mod probe;
mod process;
mod reader;
mod sound;
#[cfg(test)]
mod tests;

pub use animation::{is_animated, is_animation};
pub use camera::{Camera, CameraDevice, CameraFrame, CameraSource, PLACEHOLDER, cameras};
pub use encoder::{Encoder, file_name};
pub use error::VideoError;
pub use numbered::frame_rate_of;
pub use process::{Stop, Tools};
pub use reader::Pool;
pub use sound::sound_of;

use eddy_project::FileError;
use reader::Reader;
use std::{
    fs::File,
    path::{Path, PathBuf},
    sync::{Arc, Mutex, PoisonError},
    time::Duration,
};

/// The properties of a video that are known before it is played.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VideoInfo {
    /// The width in texels as shown: after rotation, with square pixels.
    pub width: u32,
    pub height: u32,
    /// The length of the loop in seconds.
    pub seconds: f64,
    /// The approximate number of frames per second, to estimate how much memory all of them take.
    pub frame_rate: f64,
    /// A frame is shown up to this many seconds early: its time is rounded to the clock of the file. At most .5 ms.
    pub tolerance: f64,
}

impl VideoInfo {
    /// Returns the number of bytes of a frame.
    pub fn frame_bytes(&self) -> usize {
        self.width as usize * self.height as usize * 4
    }
}

/// A frame. Two are the same if they share their texels.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Rows of RGBA, the top row first.
    pub texels: Arc<Vec<u8>>,
}

impl Frame {
    pub fn is(&self, other: &Frame) -> bool {
        Arc::ptr_eq(&self.texels, &other.texels)
    }
}

/// The result of [`FrameSource::frame_at`].
#[derive(Clone, Debug)]
pub struct FrameLookup {
    /// The frame of the position; the newest available one if that is late; `None` if there was never one.
    pub frame: Option<Frame>,
    /// The frame of the position is not decoded yet.
    pub is_late: bool,
}

/// The time to wait for a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Pace {
    /// Until it is decoded: pictures depend on the position alone.
    #[default]
    Exact,
    /// Briefly: less while the position advances than after a jump.
    Live,
}

/// A source of frames with their times, played in a loop from position 0.
pub trait FrameSource: Send + Sync {
    fn info(&self) -> VideoInfo;

    /// Returns the last frame whose time is at most a position, in seconds; the first one if there is none. Positions
    /// beyond the end belong to later rounds. Waits as `pace` allows, and at most
    /// [`VIDEO_DECODE_SECONDS`](eddy_project::limits::VIDEO_DECODE_SECONDS) for a decoder that returns nothing.
    fn frame_at(&self, seconds: f64, pace: Pace) -> FrameLookup;
}

/// The path of a file, and access to files next to it.
pub struct FileLocation<'a> {
    pub path: &'a Path,
    /// Reads a file next to it: each image of a sequence, when it is needed.
    pub read: ReadFile,
}

/// Reads a file by its name.
pub type ReadFile = Arc<dyn Fn(&Path) -> Result<Vec<u8>, FileError> + Send + Sync>;

/// A video that is ready to play, with its first frame decoded.
pub struct Video {
    path: PathBuf,
    info: VideoInfo,
    reader: Mutex<Reader>,
}

impl Video {
    /// Opens a file with ffmpeg. `real` is its path after resolving links.
    pub fn of_file(path: &Path, file: File, real: PathBuf, tools: &Tools, pool: &Pool) -> Result<Video, VideoError> {
        Self::start(path, Arc::new(ffmpeg::FilmFile::open(file, real, tools)?), pool, tools.patience)
    }

    /// Opens the content of an animated GIF, PNG or WebP; see [`is_animation`].
    pub fn of_animation(path: &Path, bytes: Vec<u8>, pool: &Pool) -> Result<Video, VideoError> {
        Self::start(path, Arc::new(animation::Animation::open(bytes)?), pool, Tools::default().patience)
    }

    /// Opens numbered image files; `place` is the first and `first` its content.
    pub fn of_sequence(place: &FileLocation<'_>, first: &[u8], pool: &Pool) -> Result<Video, VideoError> {
        Self::start(place.path, Arc::new(numbered::Sequence::open(place, first)?), pool, Tools::default().patience)
    }

    fn start(path: &Path, film: Arc<dyn Film>, pool: &Pool, patience: Duration) -> Result<Video, VideoError> {
        let info = *film.info();
        let mut reader = Reader::new(film, pool.clone(), patience);
        // Errors of decoding are reported now.
        reader.first()?;
        Ok(Video { path: path.to_owned(), info, reader: Mutex::new(reader) })
    }
}

impl FrameSource for Video {
    fn info(&self) -> VideoInfo {
        self.info
    }

    fn frame_at(&self, seconds: f64, pace: Pace) -> FrameLookup {
        self.reader.lock().unwrap_or_else(PoisonError::into_inner).frame_at(seconds, pace)
    }
}

impl PartialEq for Video {
    fn eq(&self, other: &Self) -> bool {
        (&self.path, self.info) == (&other.path, other.info)
    }
}

impl std::fmt::Debug for Video {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Video").field("path", &self.path).field("info", &self.info).finish_non_exhaustive()
    }
}

/// A video that can be decoded repeatedly from any position.
trait Film: Send + Sync {
    fn info(&self) -> &VideoInfo;

    /// Starts a run through its frames. The first one is at or before a position, or is the first of all.
    fn start(&self, from: f64, stop: &process::Stop) -> Result<Box<dyn Decode>, VideoError>;
}

/// A pass over the frames of a video.
trait Decode {
    /// Returns the next frame with its time in seconds; `None` after the last.
    fn next(&mut self) -> Result<Option<(f64, Vec<u8>)>, VideoError>;
}

/// The longest wait for a frame of a live picture: while the position advances, and after a jump.
const PATIENCE: (Duration, Duration) = (Duration::from_millis(8), Duration::from_millis(150));

/// Fails if frames of this size may not be decoded.
fn check_size(width: u32, height: u32) -> Result<(), VideoError> {
    use eddy_project::limits;
    if width == 0 || height == 0 {
        return Err(VideoError::NoPicture);
    }
    if u64::from(width) * u64::from(height) * 4 > limits::VIDEO_FRAME_BYTES || width.max(height) > limits::PICTURE_SIDE
    {
        return Err(VideoError::TooLarge { width, height });
    }
    Ok(())
}
