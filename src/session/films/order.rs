//! A film that is asked for, and what is known of one that is made.

use eddy_film::{Encoding, Format, Rate};
use std::{path::PathBuf, time::Duration};

/// A film or a row of pictures that can be made as it stands. [`FilmForm::check`](super::FilmForm::check) makes one.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmOrder {
    /// The frames of the run that are drawn offline, rising; `None`: the frames that the window draws from now on.
    pub frames: Option<Vec<u32>>,
    /// Pixels of the picture.
    pub size: (u32, u32),
    /// Frames per second of `iTime`.
    pub fps: f64,
    /// Frames per second of the film.
    pub rate: Rate,
    pub format: Format,
    pub encoding: Encoding,
    /// With the project's sound, where it has any and the file holds it.
    pub with_sound: bool,
    /// Seconds at the start that are faded with what follows the end; `None`: no loop.
    pub fade_secs: Option<f64>,
    pub place: FilmPlace,
}

/// Says where a film is written to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FilmPlace {
    /// Beside the project's pictures, by the first number that is free.
    Numbered,
    /// A file, or a folder for pictures.
    Named {
        path: PathBuf,
        /// A file that is there may be replaced.
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
    /// All frames are there, and the encoder completes the file.
    Completing,
}

/// Says how far a film is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FilmProgress {
    pub stage: FilmStage,
    /// Frames of the film that are drawn, and how many it has.
    pub done: u32,
    pub of: u32,
    /// The time that the rest will take, once that can be told.
    pub left: Option<Duration>,
}

/// A film that is complete.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmDone {
    /// The file, or the folder of the pictures.
    pub path: PathBuf,
    pub frames: u32,
    /// Seconds that the film lasts.
    pub secs: f64,
    /// A further sentence about it.
    pub note: Option<String>,
}

/// A recording of what the window draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LiveView {
    pub frames: u32,
    /// Seconds that the film lasts so far.
    pub secs: f64,
    /// The speed of the picture against real time; `None` before it is known. Below 1 drawing or encoding takes longer than
    /// the film.
    pub speed: Option<f64>,
    /// The picture waits for the encoder.
    pub waits: bool,
    /// Time stands still, so that nothing is recorded.
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
