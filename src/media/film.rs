//! Videos of a channel: the project's own files, and replacements for those of Shadertoy.

use super::{MediaError, Texels};
use eddy_project::{FileError, Media, confine, limits, next_numbered};
use eddy_texture::TexelFormat;
use eddy_video::{FileLocation, Frame, FrameSource, Pace, Pool, Tools, Video, VideoError, is_animation};
use std::{
    fs::File,
    io::Read,
    path::{Path, PathBuf},
    sync::Arc,
};

/// File extensions that are tried for a file of Shadertoy, after its own.
const ENDINGS: [&str; 6] = ["mp4", "webm", "ogv", "mov", "mkv", "gif"];

/// Opens a video. The frames of all videos of a project share the memory of `pool`.
pub(super) fn load(
    media: &Media,
    base: Option<&Path>,
    media_dir: Option<&Path>,
    pool: &Pool,
) -> Result<Video, MediaError> {
    let (folder, path) = match media {
        Media::Builtin(name) => return Err(MediaError::NoStandIn { path: name.clone() }),
        Media::File(path) => {
            let Some(base) = base else { return Err(MediaError::NoFolder { path: path.clone() }) };
            (Some(base.to_owned()), path.clone())
        }
        Media::Picked(path) => (None, path.clone()),
        Media::Site { path, .. } => {
            let found = media_dir.and_then(|folder| stand_in(folder, path));
            (None, found.ok_or_else(|| MediaError::NoStandIn { path: path.clone() })?)
        }
    };
    let shown = folder.as_ref().map_or(path.clone(), |folder| folder.join(&path));
    let (file, real) = match &folder {
        Some(folder) => confine::open(folder, &path, limits::VIDEO_FILE)?,
        None => confine::open_own(&path, limits::VIDEO_FILE)?,
    };
    let failed = |source| MediaError::Video { path: shown.clone(), source };
    let head = file_head(&file, &shown)?;
    if image::guess_format(&head).is_err() {
        return Video::of_file(&shown, file, real, &Tools::default(), pool).map_err(failed);
    }
    let read = move |path: &Path| match &folder {
        Some(folder) => confine::read(folder, path, limits::MEDIA_FILE),
        None => confine::read_own(path, limits::MEDIA_FILE),
    };
    let bytes = read(&path)?;
    let is_numbered = next_numbered(&path).is_some_and(|next| read(&next).is_ok());
    if is_numbered && !is_animation(&bytes) {
        let place = FileLocation { path: &path, read: Arc::new(read) };
        return Video::of_sequence(&place, &bytes, pool).map_err(failed);
    }
    if matches!(
        image::guess_format(&bytes),
        Ok(image::ImageFormat::Gif | image::ImageFormat::WebP | image::ImageFormat::Png)
    ) {
        return Video::of_animation(&shown, bytes, pool).map_err(failed);
    }
    Err(failed(VideoError::NoPicture))
}

/// Loads the first frame of a video, for a preview.
pub fn first_frame(media: &Media, base: Option<&Path>) -> Result<Texels, MediaError> {
    let video = load(media, base, None, &Pool::default())?;
    let (info, shown) = (video.info(), video.frame_at(0.0, Pace::Exact));
    let row = info.width as usize * 4;
    // Video frames have the top row first, textures have it last.
    let turned = |frame: Frame| frame.texels.rchunks_exact(row).flatten().copied().collect();
    let bytes = shown.frame.map_or_else(|| vec![0; info.frame_bytes()], turned);
    Ok(Texels::flat(info.width, info.height, TexelFormat::Rgba8, bytes))
}

/// Returns the first bytes of a file, which identify its format.
fn file_head(file: &File, shown: &Path) -> Result<Vec<u8>, FileError> {
    let mut head = Vec::new();
    let read = file.try_clone().and_then(|file| file.take(64).read_to_end(&mut head));
    read.map_err(|e| FileError::of_machine(shown, &e))?;
    Ok(head)
}

/// Returns the local file that replaces one of Shadertoy: with the same name, or with another extension.
fn stand_in(folder: &Path, path: &str) -> Option<PathBuf> {
    let name = path.rsplit('/').next().filter(|name| !name.is_empty())?;
    let own = folder.join(name);
    let others = ENDINGS.iter().map(|ending| own.with_extension(ending));
    std::iter::once(own.clone()).chain(others).find(|path| path.is_file())
}
