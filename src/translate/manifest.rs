//! The file that describes how to run the shaders of a translation: see `docs/command-line.md`.

use serde::Serialize;

use crate::bindings::BindingInfo;

/// The version of the format; it is increased by changes that old readers cannot read.
pub(crate) const VERSION: u32 = 1;

/// Everything that a program needs to draw a project.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Manifest {
    /// The name of the format, `eddy-translation`.
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
    /// The order of a frame: the passes of a run in order, `steps` times, then the next run.
    pub runs: Vec<RunInfo>,
    /// In drawing order; the sound pass last.
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

/// A custom uniform, in its slot of the buffer of the kind `custom_uniforms`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CustomUniformInfo {
    pub name: String,
    /// The type as spelled in an `#iUniform` line. A bool is a `uint` of 0 or 1 in the buffer.
    #[serde(rename = "type")]
    pub ty: &'static str,
    /// In bytes from the start of the buffer.
    pub offset: u32,
    /// The value set by the project, a number for each component.
    pub value: Vec<f64>,
    /// The value that the caller sets in each frame, for a uniform of the program that the texts are written for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub meaning: Option<String>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TargetInfo {
    pub pass: String,
    /// The index among the targets of its pass, from 0: the location of the fragment's output.
    pub index: usize,
    /// `2d`, or `cube` with six layers.
    pub dimension: &'static str,
    pub size: SizeInfo,
    pub format: &'static str,
    /// True if it is double-buffered, because some pass reads the previous frame.
    pub doubled: bool,
    /// True if mip levels are generated after each draw.
    pub mips: bool,
}

/// The size of a target in texels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum SizeInfo {
    /// The resolution times this factor, rounded, at least 1.
    Canvas {
        canvas: f64,
    },
    Fixed {
        width: u32,
        height: u32,
    },
    Sides {
        width: SideInfo,
        height: SideInfo,
    },
}

/// A side of a target, as in [`SizeInfo`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum SideInfo {
    Canvas {
        canvas: f64,
    },
    /// The resolution times this factor, rounded down, at least 1.
    Floor {
        floor: f64,
    },
    Fixed {
        texels: u32,
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
    /// True if the target keeps its content where nothing is drawn; otherwise it may be cleared.
    pub keeps_content: bool,
    /// The condition by which it is drawn: an expression over the custom uniforms, `width` and `height`. While it is
    /// false, the targets have their content from before frame 0.
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

/// The only texels that are drawn, from the bottom left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct RegionInfo {
    pub x: u32,
    pub y: u32,
    pub width: u32,
    pub height: u32,
}

/// A camera as specified in `eddy.toml`, angles in degrees.
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
    /// True if the top row of an image file is at v = 1.
    pub vflip: bool,
}

/// The texture of a channel.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "input", rename_all = "snake_case")]
pub enum ReadFrom {
    /// A target, as drawn in this frame or in the previous one.
    Target { target: usize, frame: &'static str },
    /// A texture that is not drawn by a pass: a file, one of Eddy's own textures, the keyboard, a device.
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

/// A mesh and its render state.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MeshInfo {
    pub mesh: String,
    pub cull: &'static str,
    /// The winding of a front face, in the terms of the language's API.
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
