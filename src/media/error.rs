//! Errors of loading a picture, with how to mend them.

use super::{builtin, played::Played};
use crate::project::{FileError, limits, listed};
use image::ImageError;
use std::{io, path::PathBuf};

/// An error of loading a picture. Its text is complete but for the pass and the channel.
#[derive(Debug, thiserror::Error)]
pub enum MediaError {
    #[error(transparent)]
    File(#[from] FileError),
    #[error("{}: {}", path.display(), reason(source))]
    Decode { path: PathBuf, source: ImageError },
    #[error("{} is {played}", path.display())]
    NotPlayed { path: PathBuf, played: Played },
    #[error("{} is a picture of the kind {kind}, which is not read; known are {}", path.display(), listed(&KNOWN))]
    Unread { path: PathBuf, kind: &'static str },
    #[error("{}: {reason}", path.display())]
    Radiance { path: PathBuf, reason: String },
    #[error("{}: {reason}", path.display())]
    Npy { path: PathBuf, reason: String },
    #[error("{}: the picture has no texels", path.display())]
    Empty { path: PathBuf },
    #[error("{}: the picture has {width}x{height} texels, {excess}", path.display())]
    TooLarge { path: PathBuf, width: u32, height: u32, excess: Excess },
    #[error("{} is relative, and the project has no folder yet to start from", path.display())]
    NoFolder { path: PathBuf },
    #[error(
        "there is no built-in texture {name}{}",
        near.as_ref().map(|n| format!(" (did you mean {n}?)")).unwrap_or_default()
    )]
    UnknownBuiltin { name: String, near: Option<String> },
    #[error("the site's {path} has no stand-in")]
    NoStandIn { path: String },
}

/// The limit that a picture exceeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Excess {
    #[error("and a side may have {}", limits::PICTURE_SIDE)]
    Side,
    #[error("which take {bytes} bytes; a picture may take {}", limits::in_bytes(limits::PICTURE_BYTES))]
    Bytes { bytes: u64 },
    #[error(
        "with which the pictures and models of the project take more than {}, which is all they may",
        limits::in_bytes(limits::MEDIA_BYTES)
    )]
    Project,
}

fn reason(error: &ImageError) -> String {
    match error {
        ImageError::Limits(_) => format!("the picture needs more memory than decoding may take ({error})"),
        ImageError::Unsupported(_) => format!("not a picture of a known kind ({error}); known are {}", listed(&KNOWN)),
        ImageError::IoError(e) if e.kind() == io::ErrorKind::UnexpectedEof => "the picture is cut short".into(),
        _ => format!("the picture is damaged ({error})"),
    }
}

const KNOWN: [&str; 8] = ["PNG", "JPEG", "WebP", "BMP", "TGA", "GIF", "HDR", "NPY"];

impl MediaError {
    /// Returns how to mend it.
    pub fn hint(&self) -> String {
        match self {
            MediaError::File(error) => error.hint(),
            MediaError::Decode { source: ImageError::Limits(_), .. } => "scale the picture down".into(),
            MediaError::TooLarge { excess: Excess::Project, .. } => "use fewer or smaller pictures".into(),
            MediaError::TooLarge { .. } => "scale the picture down".into(),
            MediaError::NotPlayed { .. } => {
                "until then the channel reads black; let it read a picture or a buffer".into()
            }
            MediaError::Radiance { .. } => "save the picture anew, as HDR in RGB, or as NPY of float32".into(),
            MediaError::Decode { .. } | MediaError::Empty { .. } | MediaError::Unread { .. } => {
                "save the picture anew, for instance as PNG".into()
            }
            MediaError::Npy { .. } => {
                "write it with numpy.save: float32, float64 or uint8, shape (height, width) or (height, width, 1 to 4)"
                    .into()
            }
            MediaError::NoFolder { .. } => "save the project first, and put the picture into its folder".into(),
            MediaError::UnknownBuiltin { .. } => format!("there are {}", listed(&builtin::names())),
            MediaError::NoStandIn { .. } => "put a file of that name into a folder and name it with --media".into(),
        }
    }
}
