//! The errors of opening and playing a video, with hints for fixing them.

use eddy_project::limits;

/// An error of playing a video. Its text is complete except for the file name.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum VideoError {
    #[error("the program {program} is not installed, and Eddy needs it for videos, films and cameras")]
    NoProgram { program: String },
    #[error("cannot start {program}: {reason}")]
    Start { program: String, reason: String },
    #[error("{program} gave no answer for {} s and was stopped", limits::VIDEO_DECODE_SECONDS)]
    Hangs { program: String },
    #[error("there is no video in the file")]
    NoPicture,
    #[error("there is no sound in the file")]
    NoSound,
    #[error("the sound is damaged, or of a kind that is not supported ({0})")]
    Sound(String),
    #[error("the video is damaged, or of a kind that is not supported ({0})")]
    Damaged(String),
    #[error(
        "the video has frames of {width}x{height} texels; the limit for a frame is {}",
        limits::in_bytes(limits::VIDEO_FRAME_BYTES)
    )]
    TooLarge { width: u32, height: u32 },
    #[error("the video plays for {seconds:.0} s; the limit is {} s", limits::VIDEO_SECONDS)]
    TooLong { seconds: f64 },
    #[error("there are more than {} frames, the limit", limits::VIDEO_IMAGES)]
    TooMany,
    #[error("{program} could not write the film:\n{said}")]
    Encoder { program: String, said: String },
    #[error("the camera gives no pictures ({0})")]
    Camera(String),
}

impl VideoError {
    /// Returns a hint for fixing it.
    pub fn hint(&self) -> &'static str {
        match self {
            VideoError::NoProgram { .. } if cfg!(target_os = "macos") => "install it: brew install ffmpeg",
            VideoError::NoProgram { .. } if cfg!(windows) => "install it: winget install ffmpeg",
            VideoError::NoProgram { .. } => "install it: apt-get install ffmpeg",
            VideoError::Start { .. } => "check that ffmpeg runs in a terminal: ffmpeg -version",
            VideoError::Hangs { .. } | VideoError::Damaged(_) => "encode it again: ffmpeg -i FILE video.webm",
            VideoError::NoPicture => "use a file with a video in it; for sound write kind = \"music\"",
            VideoError::NoSound => "use a file with sound in it",
            VideoError::Sound(_) => "encode it again: ffmpeg -i FILE music.ogg",
            VideoError::TooLarge { .. } => "scale it down: ffmpeg -i FILE -vf scale=1920:-2 video.webm",
            VideoError::TooLong { .. } | VideoError::TooMany => "cut it: ffmpeg -i FILE -t 60 video.webm",
            VideoError::Encoder { .. } => "check the disk, and that this ffmpeg can encode: ffmpeg -encoders",
            VideoError::Camera(_) => "check that it is plugged in and that no other program uses it",
        }
    }
}
