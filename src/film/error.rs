//! The errors of writing a picture or a film.

use eddy_project::rename_temporary;
use eddy_video::VideoError;
use std::{io, path::PathBuf};

/// An error of writing a picture or a film. An existing file is left as it was.
#[derive(Debug, thiserror::Error)]
pub enum FilmError {
    #[error("{error}; {}", error.hint())]
    Ffmpeg {
        #[from]
        error: VideoError,
    },
    #[error(
        "this ffmpeg cannot encode {codec}: it has no {encoders}; install a full build of ffmpeg, or choose another codec"
    )]
    NoEncoder { codec: &'static str, encoders: String },
    #[error("cannot write {}: {source}", path.display())]
    Io { path: PathBuf, source: io::Error },
    #[error("cannot write to standard output: {0}")]
    Pipe(io::Error),
    #[error("a film is written to one file, and none was named")]
    NoFile,
    /// The reader closed the pipe.
    #[error("the pipe was closed")]
    Closed,
    #[error("a frame of {}x{} pixels cannot be added to a film of {}x{}: all frames have one size", of.0, of.1, film.0, film.1)]
    Size { of: (u32, u32), film: (u32, u32) },
    #[error("{what} has an even width and height, not {width}x{height}: change the resolution, or use 4:4:4 chroma")]
    OddSize { what: String, width: u32, height: u32 },
    #[error(
        "a film of {what} has at least {least} pixels each way, not {width}x{height}: change the resolution or the codec"
    )]
    SmallSize { what: &'static str, least: u32, width: u32, height: u32 },
    #[error("{got} frames were drawn of the {wanted} of the film")]
    Frames { got: u32, wanted: u32 },
    #[error("a film cannot have {0} frames per second: use a rate from 1/65535 to 65535")]
    Rate(f64),
    #[error(
        "a GIF cannot have {0} frames per second: its frames last hundredths of a second, and browsers show none that is \
             shorter than two; use 50, 33.3, 25 or 20, or apng or webm"
    )]
    GifRate(f64),
    #[error("a film of more than 6 hours cannot have sound: leave the sound out, or write it in parts")]
    LongSound,
    #[error(
        "a file of {format} says at its start how many frames it has, which is not known yet: choose gif, webm, mp4 or png"
    )]
    NoLength { format: &'static str },
    #[error("cannot start a thread for encoding: {0}")]
    Thread(io::Error),
    #[error("the film was stopped")]
    Stopped,
}

impl FilmError {
    pub(super) fn io(path: &std::path::Path) -> impl FnOnce(io::Error) -> FilmError {
        let path = path.to_owned();
        move |source| FilmError::Io { path, source }
    }

    /// Replaces the temporary file, whose name is random, with the film in the error.
    pub(super) fn of_film(self, film: &std::path::Path) -> FilmError {
        match self {
            FilmError::Io { source, .. } => FilmError::Io { path: film.to_owned(), source },
            FilmError::Ffmpeg { error: VideoError::Encoder { program, said } } => {
                let name = film.file_name().unwrap_or_default().to_string_lossy();
                let said = rename_temporary(&said, &name);
                FilmError::Ffmpeg { error: VideoError::Encoder { program, said } }
            }
            other => other,
        }
    }

    /// Converts an error of writing to a pipe.
    pub(super) fn pipe(error: io::Error) -> FilmError {
        if error.kind() == io::ErrorKind::BrokenPipe { FilmError::Closed } else { FilmError::Pipe(error) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn errors_name_the_film_and_not_its_temporary_file() {
        let film = Path::new("/films/wave.mp4");
        let full = || io::Error::from(io::ErrorKind::StorageFull);
        let temporary = PathBuf::from("/films/.eddy-save-aB3xYz.tmp");
        let said = "Error writing trailer of file:/films/.eddy-save-aB3xYz.tmp: No space left on device".to_owned();
        let ffmpeg = VideoError::Encoder { program: "ffmpeg".into(), said };
        for error in [FilmError::Io { path: temporary, source: full() }, FilmError::Ffmpeg { error: ffmpeg }] {
            let said = error.of_film(film).to_string();
            assert!(said.contains("wave.mp4") && !said.contains(".eddy"), "{said}");
        }
    }
}
