//! Plain shaders of GLSL ES 3.00: `void main()` with the uniforms, samplers, inputs and outputs that the text declares.
//!
//! Owns their layout ([`PlainOptions`]) and its description ([`ShaderInterface`]):
//!
//! - All resources of a stage are in one bind group, [`PlainOptions::group`]. Binding 0 is a uniform buffer with all
//!   uniforms outside of blocks, in the order of their declarations. The following bindings are samplers and uniform
//!   blocks, also in that order: a sampler takes two, its texture and, one higher, its sampler; a block takes one. A
//!   resource that the entry point does not use keeps its number, so that an edit does not move others, but the module
//!   does not declare it.
//! - Buffers follow std140 (section 2.12.6.4 of the OpenGL ES 3.0 specification). A `bool` takes 4 bytes, 0 is false.
//! - Inputs and outputs are at their `layout(location = ..)`, otherwise in the order of their declarations. A matrix
//!   takes a location for each column. With a [`Link`](crate::Link) to the vertex stage, the inputs of a fragment stage
//!   are matched by name.
//! - Outputs of a fragment are vectors of four in the module; shorter ones are padded with 0, 0, 1.
//! - `gl_FragCoord` is `@builtin(position)`: its y grows downwards where row 0 of the target is the top, as in WebGPU,
//!   and upwards where the vertex stage negates y and row 0 is taken for the bottom ([`ClipSpace::flip_y`]).
//! - Constant tables are part of the module: [`Compiled::tables`](crate::Compiled::tables) is empty.

mod reflect;
mod resources;
pub(crate) mod std140;

#[cfg(test)]
mod tests;

pub(crate) use self::{
    reflect::{members, texture, variable},
    resources::{Resources, resources},
};
use super::{PassKind, reflection::ChannelUse};

/// The mapping of a plain shader to WebGPU.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PlainOptions {
    /// The bind group of all resources: by default 0 for a fragment shader and 1 for a vertex shader, so that both fit
    /// into one pipeline.
    pub group: u32,
    pub clip_space: ClipSpace,
}

impl PlainOptions {
    pub(crate) fn of(kind: PassKind) -> Self {
        Self { group: u32::from(kind.is_vertex()), clip_space: ClipSpace::default() }
    }
}

/// Changes that a vertex shader makes to the author's `gl_Position` before it is passed to WebGPU.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ClipSpace {
    /// Negates y. The picture is then upside down in the texture: row 0 is its bottom, as in OpenGL, and triangles that
    /// are counter-clockwise in OpenGL are clockwise.
    pub flip_y: bool,
    /// Moves depth from OpenGL's -w..w to WebGPU's 0..w.
    pub map_depth: bool,
}

impl ClipSpace {
    /// Leaves clip space unchanged, for matrices made for WebGPU.
    pub const UNCHANGED: ClipSpace = ClipSpace { flip_y: false, map_depth: false };
    /// Produces textures in OpenGL's orientation: row 0 is the bottom.
    pub const GL_TEXTURE: ClipSpace = ClipSpace { flip_y: true, map_depth: true };
}

impl Default for ClipSpace {
    /// For matrices made for OpenGL, and a picture that is upright on the screen.
    fn default() -> Self {
        ClipSpace { flip_y: false, map_depth: true }
    }
}

/// The inputs, outputs and resources of a plain shader that its entry point uses.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ShaderInterface {
    /// Uniform buffers, by their bindings. The one of the uniforms outside of blocks has binding 0.
    pub buffers: Vec<UniformBuffer>,
    /// Samplers, by their bindings.
    pub textures: Vec<TextureBinding>,
    /// The attributes of a vertex, or the inputs of a fragment from the vertex stage, by their locations.
    pub inputs: Vec<ShaderVariable>,
    /// The outputs of a vertex, or the targets that a fragment writes, by their locations.
    pub outputs: Vec<ShaderVariable>,
}

/// A uniform buffer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UniformBuffer {
    /// The name of the block; empty for the buffer of the uniforms outside of blocks.
    pub name: String,
    pub group: u32,
    pub binding: u32,
    /// The minimum size of the buffer in bytes, a multiple of 16.
    pub size: u32,
    /// The members that are read, with structures and arrays of them flattened: `light.color` and `lights[1].color` are
    /// separate members, as in `glGetActiveUniform`.
    pub members: Vec<UniformMember>,
}

/// A number, vector or matrix in a [`UniformBuffer`], or an array of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UniformMember {
    pub name: String,
    /// The GLSL spelling: `vec3`, `mat4[2]`.
    pub ty: String,
    /// In bytes from the start of the buffer.
    pub offset: u32,
    /// In bytes; elements of an array are padded to 16, and so are columns of a matrix.
    pub size: u32,
    /// Bytes from one element of an array to the next; 0 if it is not an array.
    pub array_stride: u32,
}

/// A sampler of the author's: a texture and a sampler in WebGPU.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextureBinding {
    pub name: String,
    /// The GLSL spelling: `sampler2D`.
    pub ty: String,
    pub group: u32,
    pub texture_binding: u32,
    pub sampler_binding: u32,
    /// The parts of it that the module declares.
    pub used: ChannelUse,
}

/// An input or output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShaderVariable {
    pub name: String,
    /// The GLSL spelling.
    pub ty: String,
    /// The first of its locations.
    pub location: u32,
    /// True if it is not interpolated.
    pub flat: bool,
}
