//! Music that a channel names: the project's own files, and stand-ins for those of the site.

use super::{
    MediaError,
    gather::{bytes_of, room_of},
};
use eddy_audio::{Limits, Sound, decode};
use eddy_project::{Media, confine, limits};
use std::{
    path::{Path, PathBuf},
    time::Duration,
};

/// Endings that are tried for a file of the site, after the one that it has there.
const ENDINGS: [&str; 6] = ["wav", "mp3", "ogg", "flac", "m4a", "aac"];

/// Loads at most so many seconds of a sound, for people to look at.
pub fn begin_of_sound(media: &Media, base: Option<&Path>, seconds: u32) -> Result<Sound, MediaError> {
    load(media, base, None, bytes_of(seconds))
}

/// Loads a sound that may take `room` bytes.
pub(super) fn load(
    media: &Media,
    base: Option<&Path>,
    media_dir: Option<&Path>,
    room: u64,
) -> Result<Sound, MediaError> {
    let (bytes, path) = match media {
        Media::Builtin(name) => return Err(MediaError::NoStandIn { path: name.clone() }),
        Media::File(path) => {
            let Some(base) = base else { return Err(MediaError::NoFolder { path: path.clone() }) };
            (confine::read(base, path, limits::MEDIA_FILE)?, base.join(path))
        }
        Media::Picked(path) => (confine::read_own(path, limits::MEDIA_FILE)?, path.clone()),
        Media::Site { path, .. } => {
            let found = media_dir.and_then(|folder| stand_in(folder, path));
            let found = found.ok_or_else(|| MediaError::NoStandIn { path: path.clone() })?;
            (confine::read_own(&found, limits::MEDIA_FILE)?, found)
        }
    };
    let seconds = u64::from(limits::SOUND_SECONDS).min(room_of(room)) as u32;
    let ending = path.extension().and_then(|ending| ending.to_str());
    let patience = Duration::from_secs(limits::SOUND_DECODE_SECONDS);
    let limits = Limits { seconds, patience, ..Limits::default() };
    decode(bytes.into(), ending, &limits).map_err(|source| MediaError::Sound { path, source })
}

/// The file that stands in for one of the site: of the same name, or with another ending.
fn stand_in(folder: &Path, path: &str) -> Option<PathBuf> {
    let name = path.rsplit('/').next().filter(|name| !name.is_empty())?;
    let own = folder.join(name);
    let others = ENDINGS.iter().map(|ending| own.with_extension(ending));
    std::iter::once(own.clone()).chain(others).find(|path| path.is_file())
}
