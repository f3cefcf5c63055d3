//! The unmodified files of channels, for passing them to another program.

use super::MediaError;
use eddy_project::{InputKind, Media, confine, limits};
use std::path::{Path, PathBuf};

/// File extensions that are tried for a sound or a video of Shadertoy, after its own.
const SOUNDS: [&str; 6] = ["wav", "mp3", "ogg", "flac", "m4a", "aac"];
const VIDEOS: [&str; 3] = ["mp4", "webm", "ogv"];

/// Reads the file of a channel, and returns its bytes and its name. A file of the project is in its folder `base`, see
/// [`confine`]; one of Shadertoy is looked up in `media_dir`. Eddy's own textures have no file.
pub fn original(
    media: &Media,
    kind: InputKind,
    base: Option<&Path>,
    media_dir: Option<&Path>,
) -> Result<(Vec<u8>, PathBuf), MediaError> {
    match media {
        Media::Builtin(name) => Err(MediaError::NoStandIn { path: name.clone() }),
        Media::File(path) => {
            let Some(base) = base else { return Err(MediaError::NoFolder { path: path.clone() }) };
            Ok((confine::read(base, path, limits::MEDIA_FILE)?, path.clone()))
        }
        Media::Picked(path) => Ok((confine::read_own(path, limits::MEDIA_FILE)?, path.clone())),
        Media::Site { path, .. } => {
            let name = path.rsplit('/').next().filter(|name| !name.is_empty());
            let own = media_dir.zip(name).map(|(folder, name)| folder.join(name));
            let endings = match kind {
                InputKind::Music => &SOUNDS[..],
                InputKind::Video => &VIDEOS,
                _ => &[],
            };
            let others = own.iter().flat_map(|own| endings.iter().map(|ending| own.with_extension(ending)));
            let found = own.iter().cloned().chain(others).find(|path| path.is_file());
            let found = found.ok_or_else(|| MediaError::NoStandIn { path: path.clone() })?;
            Ok((confine::read_own(&found, limits::MEDIA_FILE)?, found))
        }
    }
}
