//! A person brings things from outside: files that are dropped, texts that are pasted.
//!
//! Owns what each of them is: a project, something that a pass reads, or nothing Eddy knows, with the reason. Asks no
//! network: of an address only the name is read.

mod text;
mod wire;

pub use text::{ImportError, TextImport, import_of_text};
pub use wire::{Fit, new_for};

use super::{file_names, files::MANIFEST};
use std::path::Path;

/// Says what a file is to who brings it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A folder, a GLSL file, a Shadertoy JSON file, an `eddy.toml`.
    Project,
    /// A channel reads it.
    Picture,
    /// A pass draws it.
    Model,
    /// The input of a run, which is played in the open project.
    Recording,
    /// A channel plays it.
    Video,
    /// A channel reads it as music.
    Sound,
    Unknown,
}

/// Endings of pictures that a channel can read.
pub const PICTURES: [&str; 11] = ["png", "jpg", "jpeg", "webp", "bmp", "tga", "gif", "hdr", "exr", "ktx2", "dds"];
/// Endings of models that a pass can draw.
pub const MODELS: [&str; 3] = ["glb", "gltf", "obj"];
/// Ending of recordings of input.
pub const RECORDING: &str = "replay";
/// Endings of videos that a channel can play. Animated images have those of images.
pub const VIDEOS: [&str; 9] = ["mp4", "webm", "mkv", "mov", "m4v", "ogv", "avi", "mpg", "mpeg"];
/// Endings of sounds that a channel can read as music.
pub const SOUNDS: [&str; 10] = ["mp3", "ogg", "oga", "opus", "wav", "flac", "m4a", "aac", "aif", "aiff"];

/// Says by its name what a file is; whether it is a folder is asked of the disk.
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

/// Returns whether the files are parts of one project, which is then their folder: one of them is its Image pass or its
/// `eddy.toml`, and the others lie beside it.
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
