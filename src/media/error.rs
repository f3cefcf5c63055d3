//! The errors of loading a picture, with hints for fixing them.

use super::{builtin, played::Played};
use eddy_audio::AudioError;
use eddy_project::{FileError, limits, listed};
use eddy_texture::Dimension;
use eddy_video::VideoError;
use image::ImageError;
use std::{io, path::PathBuf};

/// An error of loading a picture. Its text is complete except for the pass and the channel.
#[derive(Debug, thiserror::Error)]
pub enum MediaError {
    #[error(transparent)]
    File(#[from] FileError),
    #[error("{}: {}", path.display(), reason(source))]
    Decode { path: PathBuf, source: ImageError },
    #[error("{} is {played}", path.display())]
    NotPlayed { path: PathBuf, played: Played },
    #[error("{} is a {kind} image, which is not supported; supported are {}", path.display(), listed(&KNOWN))]
    Unread { path: PathBuf, kind: &'static str },
    #[error(
        "the content of {} is not that of a {}, or of another image that is supported; supported are {}",
        path.display(),
        path.extension().unwrap_or_default().to_string_lossy().to_uppercase(),
        listed(&KNOWN)
    )]
    OtherContent { path: PathBuf },
    #[error("{}: {reason}", path.display())]
    Radiance { path: PathBuf, reason: String },
    #[error("{}: {reason}", path.display())]
    Exr { path: PathBuf, reason: String },
    #[error("{}: {reason}", path.display())]
    Npy { path: PathBuf, reason: String },
    #[error("{}: {reason}", path.display())]
    Cubemap { path: PathBuf, reason: String },
    #[error("{}: {reason}", path.display())]
    TextureFile { path: PathBuf, kind: &'static str, reason: String },
    #[error("{}: {reason}", path.display())]
    Volume { path: PathBuf, reason: String },
    #[error("{}: {source}", path.display())]
    Sound { path: PathBuf, source: AudioError },
    #[error("{}: {source}", path.display())]
    Video { path: PathBuf, source: VideoError },
    #[error("{}: the image has no texels", path.display())]
    Empty { path: PathBuf },
    #[error("{}: the image has {width}x{height} texels, {excess}", path.display())]
    TooLarge { path: PathBuf, width: u32, height: u32, excess: Excess },
    #[error("{} is a relative path, but the project has no folder yet", path.display())]
    NoFolder { path: PathBuf },
    #[error(
        "there is no built-in texture {name}{}",
        near.as_ref().map(|n| format!(" (did you mean {n}?)")).unwrap_or_default()
    )]
    UnknownBuiltin { name: String, near: Option<String>, dimension: Dimension },
    #[error("Shadertoy's {path} has no built-in replacement")]
    NoStandIn { path: String },
}

/// The limit that a picture exceeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Excess {
    #[error("and the limit per side is {}", limits::PICTURE_SIDE)]
    Side,
    #[error("which take {bytes} bytes; the limit for an image is {}", limits::in_bytes(limits::PICTURE_BYTES))]
    Bytes { bytes: u64 },
    #[error(
        "with which the images and models of the project take more than the limit of {}",
        limits::in_bytes(limits::MEDIA_BYTES)
    )]
    Project,
}

fn reason(error: &ImageError) -> String {
    match error {
        ImageError::Limits(_) => format!("decoding the image needs too much memory ({error})"),
        ImageError::Unsupported(_) => format!("not a supported image ({error}); supported are {}", listed(&KNOWN)),
        ImageError::IoError(e) if e.kind() == io::ErrorKind::UnexpectedEof => "the image is truncated".into(),
        _ => format!("the image is damaged ({error})"),
    }
}

const KNOWN: [&str; 11] = ["PNG", "JPEG", "WebP", "BMP", "TGA", "GIF", "HDR", "EXR", "NPY", "KTX2", "DDS"];

impl MediaError {
    /// Returns a hint for fixing it.
    pub fn hint(&self) -> String {
        match self {
            MediaError::File(error) => error.hint(),
            MediaError::Decode { source: ImageError::Limits(_), .. } => "scale the image down".into(),
            MediaError::TooLarge { excess: Excess::Project, .. } => "use fewer or smaller images".into(),
            MediaError::TooLarge { .. } => "scale the image down".into(),
            MediaError::NotPlayed { played: Played::Sound, .. } => {
                "read it as music: add kind = \"music\" beside file in eddy.toml".into()
            }
            MediaError::NotPlayed { .. } => "read it as a video: add kind = \"video\" beside file in eddy.toml".into(),
            MediaError::Exr { .. } => "save it with the channels R, G, B and A, or Y".into(),
            MediaError::Radiance { .. } => "re-save the image as HDR in RGB, or as NPY of float32".into(),
            MediaError::Decode { .. }
            | MediaError::Empty { .. }
            | MediaError::Unread { .. }
            | MediaError::OtherContent { .. } => {
                "re-save the image, for example as PNG".into()
            }
            MediaError::Npy { .. } => {
                "write it with numpy.save: float32, float64 or uint8, shape (height, width) or (height, width, 1 to 4)"
                    .into()
            }
            MediaError::Cubemap { .. } => {
                "give six square images of one size (sky.png and sky_1.png to sky_5.png for +X, -X, +Y, -Y, +Z, -Z), a \
                 cross of 4:3 or 3:4, a strip of 6:1 or 1:6, or a panorama of 2:1"
                    .into()
            }
            MediaError::TextureFile { kind, .. } => format!("write the {kind} file again, or save the texture in another format"),
            MediaError::Volume { .. } => {
                "give the first of a stack of images of one size (brain_000.png, brain_001.png, ...), or a file of the site's \
                 kind: 20 bytes before the texels (BIN, a zero, three sides (u32), the number of channels (1 or 4), a \
                 zero, the format (u16: 0 for bytes, 10 for floats))"
                    .into()
            }
            MediaError::Sound { source, .. } => source.hint().into(),
            MediaError::Video { source, .. } => source.hint().into(),
            MediaError::NoFolder { .. } => "save the project first, and put the file into its folder".into(),
            MediaError::UnknownBuiltin { dimension, .. } => {
                format!("available: {}", listed(&builtin::names(*dimension).collect::<Vec<_>>()))
            }
            MediaError::NoStandIn { .. } => {
                "put a file of that name into a folder and pass that folder as --media".into()
            }
        }
    }
}
