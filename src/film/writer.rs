//! The writer of a run's pictures, as single files or as a film.

use super::{Cancel, Encoding, Film, FilmError, Output, Shape, Stills};
use eddy_engine::Pixels;
use eddy_playback::scene::Scene;
use eddy_texture::TexelFormat;
use eddy_video::Tools;
use std::{io::Write, path::PathBuf};

/// Writes pictures one by one, or all of them into a film.
pub enum Writer {
    Stills(Stills),
    Film(Film),
}

/// The sound of a film.
#[derive(Clone, Copy, Debug)]
pub enum FilmSound<'s> {
    None,
    /// Samples of the film's length, at [`eddy_audio::SAMPLE_RATE`].
    Known(&'s [[i16; 2]]),
    /// It follows after the frames, if there is any: see [`Film::sound`].
    Later,
}

/// The destination of a writer.
pub enum Destination {
    /// Pictures go to the files that they are pushed with, which the user named.
    Pictures,
    /// The same, in a folder and under names that Eddy chooses: links out of it are not followed.
    PicturesWithin,
    /// All bytes go to a pipe.
    Pipe(Box<dyn Write + Send>),
    /// A film goes to a file.
    Film(Output),
}

impl Writer {
    /// Starts writing pictures of `texels`. `sound` is that of a film.
    pub fn start(
        encoding: &Encoding,
        shape: Shape,
        texels: TexelFormat,
        sound: FilmSound<'_>,
        to: Destination,
        cancel: &Cancel,
    ) -> Result<Writer, FilmError> {
        let (film, output) = match (encoding, to) {
            (Encoding::Still(still), to) => {
                let is_within = matches!(to, Destination::PicturesWithin);
                let pipe = match to {
                    Destination::Pipe(pipe) => Some(pipe),
                    Destination::Pictures | Destination::PicturesWithin | Destination::Film(_) => None,
                };
                let size = (shape.width, shape.height);
                return Ok(Writer::Stills(Stills::start(*still, texels, size, pipe, is_within)?));
            }
            (Encoding::Film(film), Destination::Pipe(pipe)) => (film, Output::Pipe(pipe)),
            (Encoding::Film(film), Destination::Film(output)) => (film, output),
            (Encoding::Film(_), Destination::Pictures | Destination::PicturesWithin) => return Err(FilmError::NoFile),
        };
        Film::start_with(film, shape, sound, output, (&Tools::default(), cancel)).map(Writer::Film)
    }

    /// Writes a picture, and blocks while the queue is full. `path` and `scene` are for pictures in files of their own;
    /// without a path they go to the pipe.
    pub fn push(&mut self, path: Option<PathBuf>, pixels: Pixels, scene: Option<Scene>) -> Result<(), FilmError> {
        match (self, path) {
            (Writer::Film(film), _) => film.push(pixels),
            (Writer::Stills(stills), Some(path)) => stills.push(path, pixels, scene),
            (Writer::Stills(stills), None) => stills.pipe(pixels),
        }
    }

    /// Writes a picture to a file, or returns it if the queue is full.
    pub fn try_push(&mut self, path: PathBuf, pixels: Pixels) -> Result<Option<Pixels>, FilmError> {
        match self {
            Writer::Film(film) => film.try_push(pixels),
            Writer::Stills(stills) => stills.try_push(path, pixels),
        }
    }

    /// Adds the sound of a film that was started with [`FilmSound::Later`].
    pub fn sound(&mut self, sound: Vec<[i16; 2]>) -> Result<(), FilmError> {
        match self {
            Writer::Stills(_) => Ok(()),
            Writer::Film(film) => film.sound(sound),
        }
    }

    /// Waits until everything is written.
    pub fn finish(self) -> Result<(), FilmError> {
        match self {
            Writer::Stills(stills) => stills.finish(),
            Writer::Film(film) => film.finish(),
        }
    }
}
