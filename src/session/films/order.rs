//! A requested film, and the state of one in progress.

use eddy_film::{Encoding, Format, Rate};
use std::{path::PathBuf, time::Duration};

/// A valid film or sequence of pictures. [`FilmForm::check`](super::FilmForm::check) returns one.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmOrder {
    /// The frames of the run that are drawn offline, in ascending order; `None`: the frames that the window draws from
    /// now on.
    pub frames: Option<Vec<u32>>,
    /// Pixels of the picture.
    pub size: (u32, u32),
    /// Frames per second of `iTime`.
    pub fps: f64,
    /// Frames per second of the film.
    pub rate: Rate,
    pub format: Format,
    pub encoding: Encoding,
    /// With the project's sound, if it has any and the file format supports it.
    pub with_sound: bool,
    /// Seconds at the start that are cross-faded with the frames after the end; `None`: no loop.
    pub fade_secs: Option<f64>,
    pub place: FilmPlace,
}

/// The place that a film is written to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FilmPlace {
    /// Next to the project's pictures, with the first free number.
    Numbered,
    /// A file, or a folder for pictures.
    Named {
        path: PathBuf,
        /// An existing file may be replaced.
        replaces: bool,
    },
}

/// A step of making a film.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FilmStage {
    /// The project is compiled, and its sound is computed.
    #[default]
    Preparing,
    Drawing,
    /// All frames are drawn, and the encoder completes the file.
    Completing,
}

/// The progress of a film.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FilmProgress {
    pub stage: FilmStage,
    /// The number of frames drawn, and the film's total.
    pub done: u32,
    pub of: u32,
    /// The remaining time, once it can be estimated.
    pub left: Option<Duration>,
}

/// A complete film.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmDone {
    /// The file, or the folder of the pictures.
    pub path: PathBuf,
    pub frames: u32,
    /// The film's duration in seconds.
    pub secs: f64,
    /// An additional sentence about it.
    pub note: Option<String>,
}

/// A live recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LiveView {
    pub frames: u32,
    /// The film's duration so far in seconds.
    pub secs: f64,
    /// The speed of the picture relative to real time; `None` before it is known. Below 1, drawing or encoding takes
    /// longer than the film.
    pub speed: Option<f64>,
    /// The picture waits for the encoder.
    pub waits: bool,
    /// Time is paused, so nothing is recorded.
    pub is_paused: bool,
}

/// A film as front ends show it.
#[derive(Clone, Debug, PartialEq)]
pub enum FilmView<'f> {
    Live(LiveView),
    UnderWay(FilmProgress),
    Done(&'f FilmDone),
    Failed(&'f str),
    Cancelled,
}
