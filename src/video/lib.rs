//! Videos: files, animated image files, image sequences and cameras as frames with their times.
//!
//! A [`Video`] says how large its frames are and how long it plays; [`FrameSource::frame_at`] gives the frame at a position.
//! What cannot be decoded here is decoded by the programs ffmpeg and ffprobe, which get an opened file and never a name that
//! a project says. [`Encoder`] is ffmpeg as a program that encodes. Frames have 4 bytes a texel (RGBA, 8 bits each, alpha not premultiplied), top row first.

mod animation;
mod camera;
mod encoder;
mod error;
mod ffmpeg;
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

/// The facts of a video that are known before it is played.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VideoInfo {
    /// Texels across, as it is shown: after rotation, with square pixels.
    pub width: u32,
    pub height: u32,
    /// Seconds after which it starts again.
    pub seconds: f64,
    /// Frames a second, roughly: for how much memory all of them take.
    pub frame_rate: f64,
    /// A frame is shown so many seconds early: its time is rounded to the clock of the file. At most .5 ms.
    pub tolerance: f64,
}

impl VideoInfo {
    /// Bytes of a frame.
    pub fn frame_bytes(&self) -> usize {
        self.width as usize * self.height as usize * 4
    }
}

/// A frame. Two are the same where they share their texels.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Rows of RGBA, the top one first.
    pub texels: Arc<Vec<u8>>,
}

impl Frame {
    pub fn is(&self, other: &Frame) -> bool {
        Arc::ptr_eq(&self.texels, &other.texels)
    }
}

/// The answer of [`FrameSource::frame_at`].
#[derive(Clone, Debug)]
pub struct FrameLookup {
    /// The frame of the position; the newest that is there where that is late; none where there was never one.
    pub frame: Option<Frame>,
    /// The frame of the position is not decoded yet.
    pub is_late: bool,
}

/// The time that may be waited for a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Pace {
    /// Until it is there: pictures depend on the position alone.
    #[default]
    Exact,
    /// Not for long: while the position moves on less than where it jumps.
    Live,
}

/// A source of frames with their times, played in a loop from position 0 on.
pub trait FrameSource: Send + Sync {
    fn info(&self) -> VideoInfo;

    /// Returns the last frame whose time is at most a position, in seconds; the first one where there is none. Positions
    /// beyond the end are of later rounds. Waits as `pace` allows, and for a decoder that gives nothing at most
    /// [`VIDEO_DECODE_SECONDS`](eddy_project::limits::VIDEO_DECODE_SECONDS).
    fn frame_at(&self, seconds: f64, pace: Pace) -> FrameLookup;
}

/// The way to a file, and to those beside it.
pub struct FileLocation<'a> {
    pub path: &'a Path,
    /// Reads a file beside it: of a sequence each image, whenever its turn comes.
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
    /// Plays a file by ffmpeg. `real` is its path after links.
    pub fn of_file(path: &Path, file: File, real: PathBuf, tools: &Tools, pool: &Pool) -> Result<Video, VideoError> {
        Self::start(path, Arc::new(ffmpeg::FilmFile::open(file, real, tools)?), pool, tools.patience)
    }

    /// Plays the content of an animated GIF, PNG or WebP; see [`is_animation`].
    pub fn of_animation(path: &Path, bytes: Vec<u8>, pool: &Pool) -> Result<Video, VideoError> {
        Self::start(path, Arc::new(animation::Animation::open(bytes)?), pool, Tools::default().patience)
    }

    /// Plays numbered image files, of which `place` is the first and `first` its content.
    pub fn of_sequence(place: &FileLocation<'_>, first: &[u8], pool: &Pool) -> Result<Video, VideoError> {
        Self::start(place.path, Arc::new(numbered::Sequence::open(place, first)?), pool, Tools::default().patience)
    }

    fn start(path: &Path, film: Arc<dyn Film>, pool: &Pool, patience: Duration) -> Result<Video, VideoError> {
        let info = *film.info();
        let mut reader = Reader::new(film, pool.clone(), patience);
        // What cannot be decoded is told of now.
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

/// A video that can be decoded from any position on, as often as wanted.
trait Film: Send + Sync {
    fn info(&self) -> &VideoInfo;

    /// Begins a run through its frames. The first one lies at or before a position, or is the first of all.
    fn start(&self, from: f64, stop: &process::Stop) -> Result<Box<dyn Decode>, VideoError>;
}

/// A run through the frames of a video.
trait Decode {
    /// Returns the next frame with its time in seconds; none after the last.
    fn next(&mut self) -> Result<Option<(f64, Vec<u8>)>, VideoError>;
}

/// The longest wait for a frame of a live picture: while it moves on, and after a jump.
const PATIENCE: (Duration, Duration) = (Duration::from_millis(8), Duration::from_millis(150));

/// Says whether frames of a size may be decoded.
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
