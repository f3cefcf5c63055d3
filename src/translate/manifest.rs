//! The file that says how the shaders of a translation are run: `docs/command-line.md` describes it.

use serde::Serialize;

use crate::bindings::BindingInfo;

/// The form of the file; a change that old readers cannot read gets the next number.
pub(crate) const VERSION: u32 = 1;

/// All that a program needs to draw a project.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Manifest {
    /// The name of the form, `eddy-translation`.
    pub format: &'static str,
    pub version: u32,
    /// The version of Eddy that wrote it.
    pub eddy: &'static str,
    pub project: String,
    pub language: &'static str,
    pub language_version: Option<&'static str>,
    /// The vertex shader of passes that draw the whole target: three vertices, no attributes.
    pub full_screen: EntryPoint,
    pub custom_uniforms: Vec<CustomUniformInfo>,
    /// Textures that passes draw into.
    pub targets: Vec<TargetInfo>,
    /// The order of a frame: the passes of a run one after the other, so often, then the next run.
    pub runs: Vec<RunInfo>,
    /// In the order in which they are drawn; the sound pass last.
    pub passes: Vec<PassInfo>,
    /// Passes that the picture does not need, which have no files.
    pub skipped: Vec<String>,
}

/// A function of a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct EntryPoint {
    pub file: String,
    pub entry_point: String,
}

/// A uniform of the author's own, in its slot of the buffer of the kind `custom_uniforms`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CustomUniformInfo {
    pub name: String,
    /// As an `#iUniform` line spells it. A bool is a `uint` of 0 or 1 in the buffer.
    #[serde(rename = "type")]
    pub ty: &'static str,
    /// In bytes from the beginning of the buffer.
    pub offset: u32,
    /// The value that the project has it at, a number for each component.
    pub value: Vec<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TargetInfo {
    pub pass: String,
    /// The place among the targets of its pass, from 0: the location of the fragment's output.
    pub index: usize,
    /// `2d`, or `cube` with six layers.
    pub dimension: &'static str,
    pub size: SizeInfo,
    pub format: &'static str,
    /// Two textures that take turns: some pass reads the picture of the frame before.
    pub doubled: bool,
    /// Mip levels are made after each draw.
    pub mips: bool,
}

/// The size of a target in texels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum SizeInfo {
    /// That of the canvas times this, rounded, at least 1.
    Canvas {
        canvas: f64,
    },
    Fixed {
        width: u32,
        height: u32,
    },
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RunInfo {
    pub passes: Vec<String>,
    pub steps: u32,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PassInfo {
    pub pass: String,
    pub title: String,
    /// Indices into [`Manifest::targets`].
    pub targets: Vec<usize>,
    /// The target keeps what it held where nothing is drawn; else it may be cleared.
    pub keeps_content: bool,
    /// The condition by which it is drawn: an expression over the custom uniforms, `width` and `height`. While it is
    /// false, the targets hold what they hold before frame 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub when: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub region: Option<RegionInfo>,
    /// The camera that meshes are drawn with.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<CameraInfo>,
    pub channels: Vec<ChannelInfo>,
    pub programs: Vec<ProgramInfo>,
    /// Programs that are drawn before frame 0, and at the edge after each draw.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub fills: Vec<FillInfo>,
}

/// Texels that alone are drawn, from the bottom left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct RegionInfo {
    pub x: u32,
    pub y: u32,
    pub width: u32,
    pub height: u32,
}

/// A camera as `eddy.toml` has it, angles in degrees.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CameraInfo {
    pub yaw: f64,
    pub pitch: f64,
    pub distance: f64,
    pub target: [f64; 3],
    pub fov: f64,
    pub near: f64,
    pub far: f64,
}

/// A channel that the pass reads.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChannelInfo {
    pub channel: usize,
    #[serde(flatten)]
    pub from: ReadFrom,
    /// `nearest`, `linear` or `mipmap`.
    pub filter: &'static str,
    /// `clamp` or `repeat`.
    pub wrap: &'static str,
    /// The top row of an image file lies at v = 1.
    pub vflip: bool,
}

/// The texture of a channel.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "input", rename_all = "snake_case")]
pub enum ReadFrom {
    /// A target, as it was drawn in this frame or in the one before.
    Target { target: usize, frame: &'static str },
    /// Something that no pass draws: a file, one of Eddy's own textures, the keyboard, a device.
    External { kind: &'static str, name: Option<String> },
    /// Opaque black, of size 0.
    Nothing,
}

/// A program of a pass.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProgramInfo {
    /// Without a vertex stage the full-screen one is used.
    pub stages: Vec<StageInfo>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<MeshInfo>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StageInfo {
    /// `vertex` or `fragment`.
    pub stage: &'static str,
    #[serde(flatten)]
    pub entry: EntryPoint,
    pub bindings: Vec<BindingInfo>,
    /// Attributes of a vertex.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub attributes: Vec<VertexInput>,
}

/// An attribute of a vertex, 32-bit floats.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct VertexInput {
    pub name: &'static str,
    pub location: u32,
    pub components: u8,
}

/// A mesh and the state that it is drawn with.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MeshInfo {
    pub mesh: String,
    pub cull: &'static str,
    /// The way in which the corners of a front face turn, in the terms of the language's API.
    pub front_face: &'static str,
    pub depth: &'static str,
    pub depth_write: bool,
    pub color_write: bool,
    pub scale: f64,
    pub rotation: [f64; 3],
    pub position: [f64; 3],
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FillInfo {
    /// `initial` or `boundary`.
    pub fill: &'static str,
    /// Texels at the edge that a boundary overwrites.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width: Option<u32>,
    /// The image file that channel 0 reads.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    pub program: ProgramInfo,
}
