//! A geometry pass draws meshes instead of a full-screen triangle: the meshes, each with its program and state, and the
//! camera that sees them.

use super::{Source, TexelFormat, confine, limits};
use serde::{
    Deserialize, Deserializer,
    de::{SeqAccess, Visitor},
};
use std::{
    borrow::Cow,
    fmt,
    path::{Path, PathBuf},
};

/// The number of targets that a pass may have at once: every device supports this many.
pub const MAX_TARGETS: usize = 4;

/// The meshes of a pass, drawn into its targets with a depth buffer that is cleared to the far plane each frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Geometry {
    /// In drawing order; at least one.
    pub draws: Vec<MeshDraw>,
    /// Formats of the targets after the first, whose format is [`super::PassSettings::format`].
    pub more_targets: Vec<TexelFormat>,
    pub camera: Camera,
    /// Texts of stages other than the pass's own text, each file once.
    pub stages: Vec<Source>,
}

impl Geometry {
    /// Drops the stages that no draw uses and sorts the others as when a manifest is read: in the order in which draws
    /// name them.
    pub fn drop_unused_stages(&mut self) {
        let all = std::mem::take(&mut self.stages);
        let mut order = Vec::new();
        for stage in self.draws.iter_mut().flat_map(|draw| [&mut draw.vertex, &mut draw.fragment]) {
            let Stage::File(at) = stage else { continue };
            let place = order.iter().position(|one| one == at).unwrap_or_else(|| {
                order.push(*at);
                order.len() - 1
            });
            *at = place;
        }
        self.stages = order.into_iter().filter_map(|at| all.get(at).cloned()).collect();
    }
}

/// The text of a stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// The pass's own text.
    Own,
    /// A text of [`Geometry::stages`], by its index.
    File(usize),
}

/// One mesh, drawn once with one program.
#[derive(Clone, PartialEq)]
pub struct MeshDraw {
    pub mesh: MeshSource,
    /// `None`: flat for glTF, as its specification requires (section 3.7.2.1), and smooth for OBJ.
    pub normals: Option<Normals>,
    pub vertex: Stage,
    pub fragment: Stage,
    pub cull: Cull,
    pub depth: DepthTest,
    /// True if texels that pass the test write their depth.
    pub depth_write: bool,
    /// True if colours are written to the targets; if not, only depth is.
    pub color_write: bool,
    /// `iModel`: scaled, then rotated about x, y and z in this order (degrees), then translated.
    pub scale: f64,
    pub rotation: [f64; 3],
    pub position: [f64; 3],
}

/// Formats a draw for a [`Fingerprint`](super::Fingerprint). Normals were added after results were stored: built-in
/// meshes have their own normals, and their text has not changed.
impl fmt::Debug for MeshDraw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let MeshDraw {
            mesh,
            normals,
            vertex,
            fragment,
            cull,
            depth,
            depth_write,
            color_write,
            scale,
            rotation,
            position,
        } = self;
        let mut text = f.debug_struct("MeshDraw");
        text.field("mesh", mesh);
        if normals.is_some() || !matches!(mesh, MeshSource::Builtin(_)) {
            text.field("normals", normals);
        }
        text.field("vertex", vertex).field("fragment", fragment).field("cull", cull).field("depth", depth);
        text.field("depth_write", depth_write).field("color_write", color_write);
        text.field("scale", scale).field("rotation", rotation).field("position", position).finish()
    }
}

/// The source of a mesh.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum MeshSource {
    /// A built-in mesh, by name: see `media::mesh`.
    Builtin(String),
    /// A glTF or OBJ file of the project, relative to its folder: see [`super::confine`].
    File(PathBuf),
    /// A file that the user picked, by its absolute path, wherever it is. Exists in memory only, like
    /// [`super::Media::Picked`].
    Picked(PathBuf),
}

impl MeshSource {
    const BUILTIN: &'static str = "builtin:";

    /// Parses the spelling of `eddy.toml`: `builtin:torus`, or a file's path.
    pub fn parse(text: &str) -> MeshSource {
        match text.strip_prefix(Self::BUILTIN) {
            Some(name) => MeshSource::Builtin(name.to_owned()),
            None => MeshSource::File(PathBuf::from(text)),
        }
    }

    /// The inverse of [`MeshSource::parse`], with forward slashes.
    pub fn name(&self) -> String {
        match self {
            MeshSource::Builtin(name) => format!("{}{name}", Self::BUILTIN),
            MeshSource::File(path) => {
                let path = path.to_string_lossy();
                if cfg!(windows) { path.replace('\\', "/") } else { path.into_owned() }
            }
            // The name that saving gives the copy, unless it is taken.
            MeshSource::Picked(path) => path.file_name().unwrap_or_default().to_string_lossy().into_owned(),
        }
    }
}

/// The normals that are generated if a model file has none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Normals {
    /// The triangle's own normal: edges are visible.
    Flat,
    /// The mean of the normals of the adjacent triangles: edges are smoothed.
    Smooth,
}

impl Normals {
    pub const ALL: [Normals; 2] = [Normals::Flat, Normals::Smooth];

    /// Returns the name in `eddy.toml`.
    pub fn name(self) -> &'static str {
        match self {
            Normals::Flat => "flat",
            Normals::Smooth => "smooth",
        }
    }
}

/// The triangles that are culled. The front is the side on which a triangle's corners turn counter-clockwise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Cull {
    #[default]
    Back,
    Front,
    None,
}

impl Cull {
    pub const ALL: [Cull; 3] = [Cull::Back, Cull::Front, Cull::None];

    /// Returns the name in `eddy.toml`.
    pub fn name(self) -> &'static str {
        match self {
            Cull::Back => "back",
            Cull::Front => "front",
            Cull::None => "none",
        }
    }
}

/// The comparison with the depth buffer that a fragment's depth must pass.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum DepthTest {
    #[default]
    Less,
    LessEqual,
    Equal,
    GreaterEqual,
    Greater,
    NotEqual,
    Always,
}

impl DepthTest {
    pub const ALL: [DepthTest; 7] = [
        DepthTest::Less,
        DepthTest::LessEqual,
        DepthTest::Equal,
        DepthTest::GreaterEqual,
        DepthTest::Greater,
        DepthTest::NotEqual,
        DepthTest::Always,
    ];

    /// Returns the name in `eddy.toml`.
    pub fn name(self) -> &'static str {
        match self {
            DepthTest::Less => "less",
            DepthTest::LessEqual => "less_equal",
            DepthTest::Equal => "equal",
            DepthTest::GreaterEqual => "greater_equal",
            DepthTest::Greater => "greater",
            DepthTest::NotEqual => "not_equal",
            DepthTest::Always => "always",
        }
    }
}

/// A perspective camera on a sphere around its target. The world's y axis is up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Degrees about the world's y axis; at 0 the camera is on the positive z side, at 90 on the positive x side.
    pub yaw: f64,
    /// Degrees above the horizon, within -89 and 89.
    pub pitch: f64,
    pub distance: f64,
    /// The point that the camera looks at.
    pub target: [f64; 3],
    /// The vertical field of view, in degrees.
    pub fov: f64,
    /// Distances of the clip planes.
    pub near: f64,
    pub far: f64,
    /// True if dragging with the mouse rotates it.
    pub orbit: bool,
}

impl Default for Camera {
    fn default() -> Self {
        Camera {
            yaw: 30.0,
            pitch: 20.0,
            distance: 4.0,
            target: [0.0; 3],
            fov: 45.0,
            near: 0.1,
            far: 100.0,
            orbit: true,
        }
    }
}

/// The files that a model needs besides itself: the buffers and pictures that a glTF file names, as names from the
/// project's `folder`, like `model`. Empty for a file that cannot be read, and without names that lead out of the
/// folder; loading the model reports the reason.
pub fn files_beside(folder: &Path, model: &str) -> Vec<String> {
    let is = |ending: &str| Path::new(model).extension().is_some_and(|e| e.eq_ignore_ascii_case(ending));
    if !is("gltf") && !is("glb") {
        return Vec::new();
    }
    let bytes = confine::read(folder, model, limits::MEDIA_FILE).unwrap_or_default();
    let named: Named = serde_json::from_slice(gltf_text(&bytes)).unwrap_or_default();
    let files = named.buffers.0.iter().chain(&named.images.0).map(|uri| unescaped(uri));
    files.filter_map(|file| confine::relative(model, &file).ok()).collect()
}

/// The JSON text of a glTF file: its first chunk if it is binary (glTF 2.0, section 4.4), whatever its name.
fn gltf_text(bytes: &[u8]) -> &[u8] {
    const TEXT: usize = 20;
    if !bytes.starts_with(b"glTF") {
        return bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    }
    let length = bytes.get(12..16).and_then(|length| length.try_into().ok()).map_or(0, u32::from_le_bytes);
    bytes.get(TEXT..).and_then(|text| text.get(..length as usize)).unwrap_or_default()
}

/// The URIs in a `.gltf`: the rest may be large.
#[derive(Default, Deserialize)]
#[serde(default)]
struct Named {
    buffers: Uris,
    images: Uris,
}

/// The URIs of files in a list; entries without one take no memory.
#[derive(Default)]
struct Uris(Vec<String>);

impl<'de> Deserialize<'de> for Uris {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        struct NamedFile<'a> {
            #[serde(borrow)]
            uri: Option<Cow<'a, str>>,
        }
        struct List;
        impl<'de> Visitor<'de> for List {
            type Value = Uris;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a list of files")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Uris, A::Error> {
                let mut uris = Vec::new();
                while let Some(file) = list.next_element::<NamedFile<'_>>()? {
                    uris.extend(file.uri.filter(|uri| !uri.contains(':')).map(Cow::into_owned));
                }
                Ok(Uris(uris))
            }
        }
        deserializer.deserialize_seq(List)
    }
}

/// A URI with its percent-encoding decoded.
pub fn unescaped(uri: &str) -> String {
    let bytes = uri.as_bytes();
    let (mut out, mut i) = (Vec::with_capacity(bytes.len()), 0);
    while i < bytes.len() {
        let hex = (bytes[i] == b'%').then(|| uri.get(i + 1..i + 3)).flatten();
        let escaped = hex.and_then(|hex| u8::from_str_radix(hex, 16).ok());
        out.push(escaped.unwrap_or(bytes[i]));
        i += if escaped.is_some() { 3 } else { 1 };
    }
    String::from_utf8_lossy(&out).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gltf_dependencies_are_listed() {
        let dir = tempfile::tempdir().unwrap();
        std::fs::create_dir(dir.path().join("m")).unwrap();
        let write = |text: &str| std::fs::write(dir.path().join("m/a.gltf"), text).unwrap();
        write(
            r#"{"buffers":[{"uri":"a%20b.bin"},{"uri":"data:;base64,AA"},{},{"uri":"../../x.bin"},{"uri":"/dev/zero"}],
                "images":[{"uri":"../tex/é.png"},{"uri":"%2e%2e/%2e%2e/x.png"}]}"#,
        );
        assert_eq!(files_beside(dir.path(), "m/a.gltf"), ["m/a b.bin", "tex/é.png"]);
        let text = "{\"buffers\":[{\"uri\":\"x.bin\"}]}";
        write(&format!("\u{feff}{text}"));
        assert_eq!(files_beside(dir.path(), "m/a.gltf"), ["m/x.bin"]);
        let header = [b"glTF\x02\0\0\0\0\0\0\0", &[text.len() as u8, 0, 0, 0][..], b"JSON", text.as_bytes()].concat();
        std::fs::write(dir.path().join("m/a.glb"), header).unwrap();
        assert_eq!(files_beside(dir.path(), "m/a.glb"), ["m/x.bin"]);
        write("{");
        assert!(files_beside(dir.path(), "m/a.gltf").is_empty());
        assert!(files_beside(dir.path(), "none.glb").is_empty());
    }

    #[test]
    fn mesh_names_round_trip() {
        for name in ["builtin:torus", "models/fox.glb", "/a/b.obj"] {
            assert_eq!(MeshSource::parse(name).name(), name);
        }
    }
}
