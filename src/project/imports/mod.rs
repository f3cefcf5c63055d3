//! Imports: dropped files and pasted texts.
//!
//! Owns the classification of each: a project, an input of a pass, or unknown, with the reason. Does not use the
//! network: of an address only the name is read.

mod text;
mod wire;

pub use text::{ImportError, TextImport, import_of_text};
pub use wire::{Fit, new_for};

use super::{file_names, files::MANIFEST};
use std::path::Path;

/// The kind of a file that a user brings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A folder, a GLSL file, a Shadertoy JSON file, an `eddy.toml`.
    Project,
    /// A channel can read it.
    Picture,
    /// A pass can draw it.
    Model,
    /// Recorded input of a run, which is replayed in the open project.
    Recording,
    /// A channel can play it.
    Video,
    /// A channel can read it as music.
    Sound,
    Unknown,
}

/// File extensions of pictures that a channel can read.
pub const PICTURES: [&str; 11] = ["png", "jpg", "jpeg", "webp", "bmp", "tga", "gif", "hdr", "exr", "ktx2", "dds"];
/// File extensions of models that a pass can draw.
pub const MODELS: [&str; 3] = ["glb", "gltf", "obj"];
/// The file extension of recordings of input.
pub const RECORDING: &str = "replay";
/// File extensions of videos that a channel can play. Animated images have those of images.
pub const VIDEOS: [&str; 9] = ["mp4", "webm", "mkv", "mov", "m4v", "ogv", "avi", "mpg", "mpeg"];
/// File extensions of sounds that a channel can read as music.
pub const SOUNDS: [&str; 10] = ["mp3", "ogg", "oga", "opus", "wav", "flac", "m4a", "aac", "aif", "aiff"];

/// Classifies a file by its name, and folders by asking the disk.
pub fn kind_of_file(path: &Path) -> FileKind {
    let extension = path.extension().unwrap_or_default();
    let is_one_of = |list: &[&str]| list.iter().any(|e| extension.eq_ignore_ascii_case(e));
    let is_manifest = path.file_name().is_some_and(|n| n == MANIFEST);
    let is_text = extension.eq_ignore_ascii_case("json") || file_names::is_glsl_extension(extension);
    if path.is_dir() || is_manifest || is_text {
        FileKind::Project
    } else if is_one_of(&PICTURES) {
        FileKind::Picture
    } else if is_one_of(&MODELS) {
        FileKind::Model
    } else if is_one_of(&[RECORDING]) {
        FileKind::Recording
    } else if is_one_of(&SOUNDS) {
        FileKind::Sound
    } else if is_one_of(&VIDEOS) {
        FileKind::Video
    } else {
        FileKind::Unknown
    }
}

/// Returns the common folder if the files are parts of one project: one of them is its Image pass or its `eddy.toml`,
/// and the others are in the same folder.
pub fn folder_of_parts<'p>(paths: &[&'p Path]) -> Option<&'p Path> {
    let folder = paths.first()?.parent()?;
    let is_main = |path: &&Path| {
        let name = path.file_name().and_then(|n| n.to_str()).unwrap_or_default();
        name == MANIFEST || file_names::is_image_file(name)
    };
    let is_one = paths.len() > 1 && paths.iter().all(|path| path.parent() == Some(folder) && !path.is_dir());
    (is_one && paths.iter().any(is_main)).then_some(folder)
}

#[cfg(test)]
mod tests;
