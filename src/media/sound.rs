//! The music of a channel: the project's own files, and replacements for those of Shadertoy.

use super::{
    MediaError,
    gather::{bytes_of, room_of},
};
use eddy_audio::{AudioError, Limits, SAMPLE_RATE, Sound, decode};
use eddy_project::{Media, confine, limits};
use eddy_video::{Tools, sound_of};
use std::{
    path::{Path, PathBuf},
    time::Duration,
};

/// File extensions that are tried for a file of Shadertoy, after its own.
const ENDINGS: [&str; 7] = ["wav", "mp3", "ogg", "flac", "m4a", "aac", "opus"];

/// Loads at most this many seconds of a sound, for a preview.
pub fn sound_preview(media: &Media, base: Option<&Path>, seconds: u32) -> Result<Sound, MediaError> {
    load(media, base, None, bytes_of(seconds))
}

/// Loads a sound that may take `room` bytes. Formats that are not decoded here, and the sound of videos, are decoded by
/// ffmpeg if it is installed.
pub(super) fn load(
    media: &Media,
    base: Option<&Path>,
    media_dir: Option<&Path>,
    room: u64,
) -> Result<Sound, MediaError> {
    let (folder, path) = match media {
        Media::Builtin(name) => return Err(MediaError::NoStandIn { path: name.clone() }),
        Media::File(path) => (Some(base.ok_or_else(|| MediaError::NoFolder { path: path.clone() })?), path.clone()),
        Media::Picked(path) => (None, path.clone()),
        Media::Site { path, .. } => {
            let found = media_dir.and_then(|folder| stand_in(folder, path));
            (None, found.ok_or_else(|| MediaError::NoStandIn { path: path.clone() })?)
        }
    };
    let shown = folder.map_or(path.clone(), |folder| folder.join(&path));
    let seconds = u64::from(limits::SOUND_SECONDS).min(room_of(room)) as u32;
    let by_ffmpeg = || {
        let (file, real) = match folder {
            Some(folder) => confine::open(folder, &path, limits::VIDEO_FILE)?,
            None => confine::open_own(&path, limits::VIDEO_FILE)?,
        };
        let frames = sound_of(&file, &real, (SAMPLE_RATE, seconds), &Tools::default());
        let mut frames = frames.map_err(|source| MediaError::Video { path: shown.clone(), source })?;
        let most = seconds as usize * SAMPLE_RATE as usize;
        let truncated = frames.len() > most;
        frames.truncate(most);
        Ok(Sound { frames, truncated })
    };
    let read = match folder {
        Some(folder) => confine::read(folder, &path, limits::MEDIA_FILE),
        None => confine::read_own(&path, limits::MEDIA_FILE),
    };
    let bytes = match read {
        // A video may be larger.
        Err(error) if error.is_too_large() => return by_ffmpeg(),
        read => read?,
    };
    let ending = path.extension().and_then(|ending| ending.to_str());
    let patience = Duration::from_secs(limits::SOUND_DECODE_SECONDS);
    let limits = Limits { seconds, patience, ..Limits::default() };
    decode(bytes.into(), ending, &limits).or_else(|source| {
        let failed = MediaError::Sound { path: shown.clone(), source: source.clone() };
        match source {
            AudioError::Unknown(_) | AudioError::Unsupported(_) | AudioError::NoTrack | AudioError::Damaged(_) => {
                by_ffmpeg().map_err(|_| failed)
            }
            _ => Err(failed),
        }
    })
}

/// Returns the local file that replaces one of Shadertoy: with the same name, or with another extension.
fn stand_in(folder: &Path, path: &str) -> Option<PathBuf> {
    let name = path.rsplit('/').next().filter(|name| !name.is_empty())?;
    let own = folder.join(name);
    let others = ENDINGS.iter().map(|ending| own.with_extension(ending));
    std::iter::once(own.clone()).chain(others).find(|path| path.is_file())
}
