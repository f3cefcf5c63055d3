//! Image files, sounds, videos and meshes embedded in the page as text.

use crate::data::{FileData, MediaData, MeshData};
use base64::prelude::{BASE64_STANDARD, Engine as _};
use eddy_diag::Diagnostic;
use eddy_media::{MediaKey, MediaSet, Texels, original};
use eddy_project::{Channel, InputKind, Media, MeshDraw, MeshSource, Normals, Project};
use eddy_texture::{Dimension, TexelFormat};
use flate2::{Compression, write::ZlibEncoder};
use std::{
    io::Write,
    path::{Path, PathBuf},
};

/// The identity of a medium, to embed it only once.
#[derive(PartialEq)]
enum Key {
    Texels(MediaKey),
    File(InputKind, Media, bool),
}

/// The media and meshes embedded in the page so far.
pub(crate) struct Inlined<'a> {
    project: &'a Project,
    media: &'a MediaSet,
    media_dir: Option<&'a Path>,
    keys: Vec<Key>,
    pub list: Vec<MediaData>,
    mesh_keys: Vec<(MeshSource, Option<Normals>)>,
    pub meshes: Vec<MeshData>,
    pub warnings: Vec<Diagnostic>,
    /// Their total size in the page in bytes.
    pub bytes: usize,
}

impl<'a> Inlined<'a> {
    pub(crate) fn new(project: &'a Project, media: &'a MediaSet, media_dir: Option<&'a Path>) -> Self {
        let (keys, list, mesh_keys, meshes) = Default::default();
        Self { project, media, media_dir, keys, list, mesh_keys, meshes, warnings: Vec::new(), bytes: 0 }
    }

    /// Returns the index of a channel's medium; `None` if it is missing or not playable in a browser. `place` names the
    /// channel for a warning.
    pub(crate) fn channel(&mut self, channel: &Channel, place: &str) -> Option<usize> {
        let kind = channel.input.kind();
        let name = channel.input.media()?.clone();
        let vflip = channel.sampler.vflip && channel.input.row().has_vflip;
        let key = match kind {
            InputKind::Music => Key::File(kind, name.clone(), false),
            InputKind::Video => Key::File(kind, name.clone(), vflip),
            _ => Key::Texels(MediaKey::of_channel(channel)?),
        };
        if let Some(at) = self.keys.iter().position(|known| *known == key) {
            return Some(at);
        }
        let made = match (&key, kind) {
            (Key::Texels(key), _) => {
                let texels = self.media.get(key)?;
                match kind {
                    InputKind::Texture => self.jpeg(&name, texels, vflip),
                    _ => None,
                }
                .unwrap_or_else(|| texels_data(texels, display_name(&name)))
            }
            (Key::File(..), InputKind::Music) => {
                self.media.sound(&name)?;
                MediaData::Music(self.file(&name, kind, false, &MUSIC, place)?)
            }
            (Key::File(..), _) => MediaData::Video(self.file(&name, kind, vflip, &VIDEOS, place)?),
        };
        Some(self.add(key, made))
    }

    /// Returns the index of the picture of a fill.
    pub(crate) fn fill(&mut self, path: &Path) -> Option<usize> {
        let key = Key::Texels(MediaKey::of_fill(path));
        if let Some(at) = self.keys.iter().position(|known| *known == key) {
            return Some(at);
        }
        let made = texels_data(self.media.fill(path)?, display_name(&Media::File(path.to_owned())));
        Some(self.add(key, made))
    }

    /// Returns the index of the mesh of a draw.
    pub(crate) fn mesh(&mut self, draw: &MeshDraw) -> Option<usize> {
        let key = (draw.mesh.clone(), draw.normals);
        if let Some(at) = self.mesh_keys.iter().position(|known| *known == key) {
            return Some(at);
        }
        let mesh = self.media.mesh(draw).ok()?;
        let data = MeshData {
            v: packed(bytemuck::cast_slice(&mesh.vertices)),
            i: packed(bytemuck::cast_slice(&mesh.indices)),
        };
        self.bytes += data.v.len() + data.i.len();
        self.mesh_keys.push(key);
        self.meshes.push(data);
        Some(self.meshes.len() - 1)
    }

    fn add(&mut self, key: Key, made: MediaData) -> usize {
        self.bytes += match &made {
            MediaData::Texels { data, .. } => data.len(),
            MediaData::Picture(file) | MediaData::Music(file) | MediaData::Video(file) => file.data.len(),
        };
        self.keys.push(key);
        self.list.push(made);
        self.list.len() - 1
    }

    /// Returns a photograph as its original file, which is smaller than its texels. One that must be rotated, or was
    /// converted to grey, is not left to the browser.
    fn jpeg(&self, name: &Media, texels: &Texels, flip: bool) -> Option<MediaData> {
        if texels.shape.format != TexelFormat::Rgba8 {
            return None;
        }
        let (bytes, _) = original(name, InputKind::Texture, self.project.origin.base_dir(), self.media_dir).ok()?;
        let has_exif = bytes.get(..bytes.len().min(65_536))?.windows(6).any(|part| part == b"Exif\0\0");
        let is_jpeg = bytes.starts_with(&[0xff, 0xd8, 0xff]) && !has_exif;
        is_jpeg.then(|| {
            MediaData::Picture(FileData {
                name: display_name(name),
                mime: "image/jpeg",
                flip,
                data: BASE64_STANDARD.encode(&bytes),
            })
        })
    }

    fn file(
        &mut self,
        name: &Media,
        kind: InputKind,
        flip: bool,
        known: &[(&str, &'static str)],
        place: &str,
    ) -> Option<FileData> {
        // Loading it has already reported why it cannot be read.
        let found = original(name, kind, self.project.origin.base_dir(), self.media_dir);
        let (bytes, path) = found.ok()?;
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        let Some((_, mime)) = known.iter().find(|(one, _)| *one == ending) else {
            let list: Vec<&str> = known.iter().map(|(one, _)| *one).collect();
            let message = format!("browsers do not play {}; the page shows the channel without it", display_name(name));
            let warning = Diagnostic::warning(None, format!("{place}: {message}"));
            self.warnings.push(warning.hint(format!("convert it to one of: {}", list.join(", "))));
            return None;
        };
        Some(FileData { name: display_name(name), mime, flip, data: BASE64_STANDARD.encode(&bytes) })
    }
}

/// File extensions of sounds that browsers decode, and their types.
const MUSIC: [(&str, &str); 8] = [
    ("mp3", "audio/mpeg"),
    ("ogg", "audio/ogg"),
    ("oga", "audio/ogg"),
    ("opus", "audio/ogg"),
    ("wav", "audio/wav"),
    ("flac", "audio/flac"),
    ("m4a", "audio/mp4"),
    ("aac", "audio/aac"),
];
/// File extensions of videos that browsers decode, and their types.
const VIDEOS: [(&str, &str); 4] =
    [("mp4", "video/mp4"), ("m4v", "video/mp4"), ("webm", "video/webm"), ("ogv", "video/ogg")];

fn texels_data(texels: &Texels, name: String) -> MediaData {
    let shape = texels.shape;
    let dim = match shape.dimension {
        Dimension::D2 => "2d",
        Dimension::D3 => "3d",
        Dimension::Cube => "cube",
    };
    let (w, h, d) = (shape.width, shape.height, shape.depth);
    MediaData::Texels { name, dim, format: shape.format.name(), w, h, d, data: packed(&texels.bytes) }
}

/// Returns the name of a file or texture without its folders.
fn display_name(media: &Media) -> String {
    let last = |path: &PathBuf| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    match media {
        Media::Builtin(name) => name.clone(),
        Media::File(path) | Media::Picked(path) => last(path),
        Media::Site { path, id } => if path.is_empty() { id } else { path }.clone(),
    }
}

/// Returns bytes compressed by zlib (RFC 1950), in base64.
fn packed(bytes: &[u8]) -> String {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    let out = encoder.write_all(bytes).and_then(|()| encoder.finish());
    BASE64_STANDARD.encode(out.expect("memory takes all bytes"))
}
