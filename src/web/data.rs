//! The description of a project for the player, as JSON. The names of members are those that `player/` uses.

use eddy_project::SLOTS;
use serde::Serialize;
use std::collections::BTreeMap;

#[derive(Serialize)]
pub(crate) struct ProjectData {
    pub name: String,
    #[serde(skip_serializing_if = "String::is_empty")]
    pub author: String,
    #[serde(skip_serializing_if = "String::is_empty")]
    pub description: String,
    pub uniforms: Vec<UniformData>,
    /// Values of uniforms that a text declares by GLSL's `uniform`.
    pub values: BTreeMap<String, Vec<f64>>,
    /// Names of texts by the source string numbers of `#line` directives.
    pub texts: Vec<String>,
    /// GLSL of Common, then of passes and stages.
    pub codes: Vec<String>,
    /// Indices into `uniforms` of those that Common declares.
    pub shared: Vec<usize>,
    pub passes: Vec<PassData>,
    pub runs: Vec<RunData>,
    pub media: Vec<MediaData>,
    pub meshes: Vec<MeshData>,
}

/// A uniform of an `#iUniform` line.
#[derive(Serialize)]
pub(crate) struct UniformData {
    pub name: String,
    #[serde(rename = "type")]
    pub ty: &'static str,
    pub value: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub step: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "String::is_empty")]
    pub about: String,
    #[serde(skip_serializing_if = "String::is_empty")]
    pub group: String,
}

#[derive(Serialize)]
pub(crate) struct RunData {
    pub passes: Vec<usize>,
    pub steps: u32,
}

#[derive(Serialize)]
pub(crate) struct PassData {
    pub title: String,
    /// `buffer`, `cubemap`, `image` or `sound`.
    pub kind: &'static str,
    /// True if the picture does not need it.
    #[serde(skip_serializing_if = "is_false")]
    pub skip: bool,
    pub size: SizeData,
    pub formats: Vec<&'static str>,
    /// True if mip levels are generated after each draw, by target.
    pub mips: Vec<bool>,
    /// True if it is double-buffered.
    #[serde(skip_serializing_if = "is_false")]
    pub doubled: bool,
    /// True if it is skipped while nothing that it reads has changed.
    #[serde(skip_serializing_if = "is_false")]
    pub cached: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub region: Option<[u32; 4]>,
    /// The condition by which it is drawn: a number, a name, or an operator with its terms.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub when: Option<serde_json::Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub initial: Option<FillData>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub boundary: Option<FillData>,
    /// An index into `codes`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub code: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub draws: Option<Vec<DrawData>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<CameraData>,
    pub channels: [Option<ChannelData>; SLOTS],
    /// Indices into `uniforms`.
    pub uniforms: Vec<usize>,
}

/// A factor of the resolution, or texels.
#[derive(Serialize)]
#[serde(untagged)]
pub(crate) enum SizeData {
    Canvas(f64),
    Fixed([u32; 2]),
    Sides([SideData; 2]),
}

/// A side in texels, or as a fraction of the picture's, which the page reads from a string.
#[derive(Serialize)]
#[serde(untagged)]
pub(crate) enum SideData {
    Canvas(String),
    Fixed(u32),
}

#[derive(Serialize)]
pub(crate) struct FillData {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width: Option<u32>,
    pub code: String,
    /// An index into `media`, which channel 0 reads.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub m: Option<usize>,
}

#[derive(Serialize)]
pub(crate) struct ChannelData {
    /// `pass`, `media`, `zero`, `none`, or the name of a device.
    #[serde(rename = "in")]
    pub from: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pass: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub m: Option<usize>,
    pub filter: &'static str,
    pub wrap: &'static str,
    /// `3d` or `cube`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dim: Option<&'static str>,
    #[serde(skip_serializing_if = "is_false")]
    pub flip: bool,
    #[serde(skip_serializing_if = "is_false")]
    pub read: bool,
}

#[derive(Serialize)]
pub(crate) struct DrawData {
    /// An index into `meshes`.
    pub mesh: usize,
    /// Indices into `codes`.
    pub vertex: usize,
    pub fragment: usize,
    pub cull: &'static str,
    pub depth: &'static str,
    pub depth_write: bool,
    pub color_write: bool,
    pub scale: f64,
    pub rotation: [f64; 3],
    pub position: [f64; 3],
}

#[derive(Serialize)]
pub(crate) struct CameraData {
    pub yaw: f64,
    pub pitch: f64,
    pub distance: f64,
    pub target: [f64; 3],
    pub fov: f64,
    pub near: f64,
    pub far: f64,
    pub orbit: bool,
}

/// Compressed by zlib, in base64: 16 32-bit floats for each vertex, and 32-bit indices.
#[derive(Serialize)]
pub(crate) struct MeshData {
    pub v: String,
    pub i: String,
}

#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub(crate) enum MediaData {
    /// Texels in WebGL's layout, compressed by zlib, in base64.
    Texels {
        name: String,
        dim: &'static str,
        format: &'static str,
        w: u32,
        h: u32,
        d: u32,
        data: String,
    },
    /// An image file that the browser decodes.
    Picture(FileData),
    Music(FileData),
    Video(FileData),
}

/// A file's unchanged bytes, in base64.
#[derive(Serialize)]
pub(crate) struct FileData {
    pub name: String,
    #[serde(rename = "type")]
    pub mime: &'static str,
    #[serde(skip_serializing_if = "is_false")]
    pub flip: bool,
    pub data: String,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
fn is_false(value: &bool) -> bool {
    !value
}
