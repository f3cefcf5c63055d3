//! The media of channels, except buffers: pictures, cubemaps, volumes, sounds, the keyboard, Eddy's own textures.
//!
//! Decodes files to texels, without access to the GPU. Row 0 is the bottom: `vflip` has already been applied to all
//! results.

pub mod builtin;
mod error;
mod film;
mod flatten;
mod gamepads;
mod gather;
mod halve;
pub mod keyboard;
mod load;
pub mod mesh;
mod music;
mod npy;
mod original;
mod played;
mod site;
mod sound;

pub use error::MediaError;
pub use film::first_frame;
pub use gamepads::Gamepads;
pub use gather::{diagnose, files, fills, gather, meshes, unrecorded};
pub use keyboard::Keyboard;
pub use load::load;
pub use music::{ChannelSound, sounds};
pub use npy::{bytes as npy_bytes, header as npy_header};
pub use original::original;
pub use sound::sound_preview;

use eddy_audio::Sound;
use eddy_diag::Diagnostic;
use eddy_project::{Channel, Fill, FillKind, Media, MeshDraw, MeshSource, Normals, Pass, Project};
use eddy_texture::{Dimension, TexelFormat, TextureShape};
use eddy_video::{Camera, CameraFrame, Pace, Video};
use mesh::{Loaded, Mesh, MeshError, MeshWarning};
use std::{
    collections::{HashMap, HashSet},
    path::{Path, PathBuf},
    sync::Arc,
};

/// A decoded texture of one level, alpha not premultiplied. `bytes` contains, face by face or slice by slice, `height`
/// rows of `width` texels, row 0 at v = 0, without padding.
#[derive(Clone, Debug, PartialEq)]
pub struct Texels {
    pub shape: TextureShape,
    pub bytes: Vec<u8>,
}

impl Texels {
    /// Returns a 2D picture.
    pub fn flat(width: u32, height: u32, format: TexelFormat, bytes: Vec<u8>) -> Self {
        Self { shape: TextureShape::flat(width, height, format), bytes }
    }

    /// Returns the bytes per texel.
    pub fn texel_bytes(&self) -> usize {
        self.shape.format.bytes() as usize
    }

    /// Returns the bytes per row.
    pub fn row_bytes(&self) -> usize {
        self.shape.width as usize * self.texel_bytes()
    }
}

/// The loaded files that a project needs in addition to its texts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MediaSet {
    /// Keyed by the channel's source, its dimension and whether it is flipped.
    pictures: HashMap<MediaKey, Arc<Texels>>,
    sounds: HashMap<Media, Arc<Sound>>,
    videos: HashMap<Media, Arc<Video>>,
    /// The camera, if the user has turned one on.
    camera: Option<Camera>,
    /// The time that drawing waits for a frame of a video.
    pace: Pace,
    /// The reason why the picture of a fill is missing, and a hint for fixing it.
    missing_fills: HashMap<PathBuf, (String, String)>,
    meshes: HashMap<MeshKey, Result<Arc<Mesh>, MeshError>>,
    mesh_warnings: HashMap<MeshKey, Vec<MeshWarning>>,
}

impl MediaSet {
    pub fn new() -> Self {
        Self::default()
    }

    pub fn get(&self, key: &MediaKey) -> Option<&Arc<Texels>> {
        self.pictures.get(key)
    }

    pub fn insert(&mut self, key: MediaKey, texels: Arc<Texels>) {
        self.pictures.insert(key, texels);
    }

    /// Returns a checksum of all texels and sounds, to tell two sets apart. Videos are not read for it.
    pub fn checksum(&self) -> u32 {
        let pictures = self.pictures.iter().map(|(key, texels)| (format!("{key:?}"), texels.bytes.as_slice()));
        let sounds = self.sounds.iter().map(|(key, sound)| (format!("{key:?}"), bytemuck::cast_slice(&sound.frames)));
        let mut all: Vec<(String, &[u8])> = pictures.chain(sounds).collect();
        all.sort();
        let mut crc = flate2::Crc::new();
        for (name, bytes) in all {
            crc.update(name.as_bytes());
            crc.update(bytes);
        }
        crc.sum()
    }

    /// Returns the sound of a music channel.
    pub fn sound(&self, media: &Media) -> Option<&Arc<Sound>> {
        self.sounds.get(media)
    }

    /// Returns the video of a channel.
    pub fn video(&self, media: &Media) -> Option<&Arc<Video>> {
        self.videos.get(media)
    }

    /// Returns the camera for webcam channels, if one is on.
    pub fn camera(&self) -> Option<&Camera> {
        self.camera.as_ref()
    }

    pub fn set_camera(&mut self, camera: Option<Camera>) {
        self.camera = camera;
    }

    /// Makes webcam channels read one picture: that of another engine in the frame that is drawn again. `None` reads as
    /// black.
    pub fn set_camera_picture(&mut self, picture: Option<CameraFrame>) {
        self.camera = picture.map(Camera::still);
    }

    /// Returns how long drawing waits for a frame of a video.
    pub fn pace(&self) -> Pace {
        self.pace
    }

    pub fn set_pace(&mut self, pace: Pace) {
        self.pace = pace;
    }

    /// Returns the texels of a file that fills a pass, as loaded by [`fills`].
    pub fn fill(&self, path: &Path) -> Option<&Arc<Texels>> {
        self.get(&MediaKey::of_fill(path))
    }

    /// Sets the texels of a fill's file.
    pub fn insert_fill(&mut self, path: &Path, texels: Arc<Texels>) {
        self.insert(MediaKey::of_fill(path), texels);
    }

    /// Returns one error for each missing file of the project's fills.
    pub fn fill_errors(&self, project: &Project) -> Vec<Diagnostic> {
        let error = |(pass, kind, fill): (usize, FillKind, &Fill)| {
            let path = fill.value.path()?;
            if self.fill(path).is_some() {
                return None;
            }
            let (why, hint) = self.missing_fills.get(path).cloned().unwrap_or_else(|| {
                (format!("{} is not loaded", path.display()), "put the file there, or choose another".into())
            });
            let message = format!("{} of {}: {why}", kind.key(), project.passes[pass].id.title());
            Some(Diagnostic::error(project.fill_span(pass, kind), message).hint(hint))
        };
        project.fills().filter_map(error).collect()
    }

    /// Returns the number of pictures.
    pub fn len(&self) -> usize {
        self.pictures.len()
    }

    pub fn is_empty(&self) -> bool {
        self.pictures.is_empty()
    }

    /// Returns a mesh that was gathered, or one of Eddy's own; otherwise the error.
    pub fn mesh(&self, draw: &MeshDraw) -> Result<Arc<Mesh>, MeshError> {
        let make = || mesh::load(&draw.mesh, draw.normals, None).map(Arc::new);
        self.meshes.get(&MeshKey::of(draw)).cloned().unwrap_or_else(make)
    }

    fn insert_mesh(&mut self, key: MeshKey, loaded: Result<Loaded, MeshError>) {
        let mesh = loaded.map(|Loaded { mesh, warnings }| {
            self.mesh_warnings.insert(key.clone(), warnings);
            Arc::new(mesh)
        });
        self.meshes.insert(key, mesh);
    }

    /// Returns one error for each model of the project that cannot be drawn.
    pub fn mesh_errors(&self, project: &Project) -> Vec<Diagnostic> {
        let error = |(pass, n, draw): (&Pass, usize, &MeshDraw)| {
            let error = self.mesh(draw).err()?;
            let message = format!("draw {n} of {}: {error}", pass.id.title());
            Some(Diagnostic::error(None, message).hint(error.hint()))
        };
        first_draws(project).filter_map(error).collect()
    }

    /// Returns one warning for each part of the project's models that is not drawn as its author may expect.
    pub fn mesh_warnings(&self, project: &Project) -> Vec<Diagnostic> {
        let warnings = |(pass, n, draw): (&Pass, usize, &MeshDraw)| {
            let place = format!("draw {n} of {}: {}", pass.id.title(), draw.mesh.name());
            let said = self.mesh_warnings.get(&MeshKey::of(draw)).into_iter().flatten();
            let warning = |said: &MeshWarning| {
                Diagnostic::warning(None, format!("{place}: {}", said.message)).hint(said.hint.clone())
            };
            said.map(warning).collect::<Vec<_>>()
        };
        first_draws(project).flat_map(warnings).collect()
    }
}

/// Returns the first draw of each model of the project, with its pass and its index there.
fn first_draws(project: &Project) -> impl Iterator<Item = (&Pass, usize, &MeshDraw)> {
    let mut seen: HashSet<&MeshSource> = HashSet::new();
    let all = project.passes.iter().flat_map(|pass| {
        let draws = pass.body.draws().iter().enumerate();
        draws.map(move |(n, draw)| (pass, n, draw))
    });
    all.filter(move |(.., draw)| seen.insert(&draw.mesh))
}

/// The key of a loaded mesh.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct MeshKey {
    source: MeshSource,
    normals: Option<Normals>,
}

impl MeshKey {
    fn of(draw: &MeshDraw) -> MeshKey {
        MeshKey { source: draw.mesh.clone(), normals: draw.normals }
    }
}

/// The key of a loaded picture.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct MediaKey {
    pub media: eddy_project::Media,
    /// The same file may be read as a picture and as a cubemap.
    pub dimension: Dimension,
    pub vflip: bool,
}

impl MediaKey {
    /// Returns the key of a channel; `None` if it reads nothing that is loaded.
    pub fn of_channel(channel: &Channel) -> Option<MediaKey> {
        let Channel { input, sampler } = channel;
        let vflip = sampler.vflip && input.row().has_vflip;
        Some(MediaKey { media: input.media()?.clone(), dimension: input.row().dimension, vflip })
    }

    /// A fill's picture is upright.
    pub fn of_fill(path: &Path) -> MediaKey {
        MediaKey { media: Media::File(path.to_owned()), dimension: Dimension::D2, vflip: true }
    }
}
