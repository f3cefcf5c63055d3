//! The external interface of a generated module: entry point, bind groups, the bytes of the uniform block.
//!
//! - There is no vertex stage, except in programs that draw meshes (below): the caller draws a full-screen triangle
//!   with its own. `gl_FragCoord` is `@builtin(position)`; because row 0 of every target is the bottom of the picture,
//!   its y needs no flip.
//! - Fragment entry point [`ENTRY_POINT`], one `@location(0) vec4<f32>` result.
//! - Group 0, binding 0: the uniform block [`UniformBlock`], 16-byte aligned, std140. Absent when none of it is read.
//! - Group 0, binding 1: a read-only storage buffer with the author's large constant tables, whose bytes come with the
//!   module ([`crate::Compiled::tables`]). Absent when there are none.
//! - Group 0, binding 3: a uniform buffer with those constant tables that together fit into [`UNIFORM_TABLE_BYTES`]
//!   ([`crate::Compiled::uniform_tables`]). Absent when there are none.
//! - Group 0, binding 2: the custom uniforms ([`crate::CustomUniform`]), an array of `vec4<u32>`: each has a slot of 16
//!   bytes whose first words are its components, bit for bit (a bool as 0 or 1). Absent when none is read.
//! - Group 1, binding 2i: the texture of `iChannel`i, binding 2i+1: its sampler. Each is declared only if it is
//!   reachable from the entry point (see [`crate::Reflection::channels`]), so the bind group layout follows the
//!   reflection.
//!
//! Programs that draw meshes have one module per stage. Both read the groups above, and in group 0 at binding 4 the
//! [`GeometryBlock`]; the vertex stage has its constant tables in its own uniform buffer at binding 5, and none in a
//! storage buffer. Attributes are at the locations of [`crate::Attribute`], a fragment's outputs at those of the
//! targets, each a `vec4<f32>`. The source uses GL's clip space; the vertex stage flips y, as row 0 is the bottom, and
//! maps depth from -w..w to 0..w. A triangle that is counter-clockwise in GL is clockwise in WebGPU.

use bytemuck::{Pod, Zeroable};

/// Name of the fragment entry point.
pub const ENTRY_POINT: &str = "main";
/// Bind group of the uniform block.
pub const UNIFORM_GROUP: u32 = 0;
/// Binding of the storage buffer with constant tables in [`UNIFORM_GROUP`].
pub const TABLE_BINDING: u32 = 1;
/// Binding of the uniform buffer with constant tables in [`UNIFORM_GROUP`].
pub const UNIFORM_TABLE_BINDING: u32 = 3;
/// The maximum size of that buffer, which every device supports (OpenGL ES 3.0, table 6.31, `MAX_UNIFORM_BLOCK_SIZE`).
pub const UNIFORM_TABLE_BYTES: usize = 16384;
/// Binding of the custom uniforms in [`UNIFORM_GROUP`].
pub const CUSTOM_UNIFORM_BINDING: u32 = 2;
/// Bytes of a slot there.
pub const CUSTOM_UNIFORM_BYTES: u64 = 16;
/// Binding of the [`GeometryBlock`] in [`UNIFORM_GROUP`].
pub const GEOMETRY_BINDING: u32 = 4;
/// Binding of the uniform buffer with constant tables of a vertex stage in [`UNIFORM_GROUP`].
pub const VERTEX_TABLE_BINDING: u32 = 5;
/// The number of targets that a fragment stage can write at once.
pub const MAX_TARGETS: usize = 4;
/// Bind group of channel textures and samplers.
pub const CHANNEL_GROUP: u32 = 1;

/// Binding of a channel's texture in [`CHANNEL_GROUP`].
pub const fn texture_binding(channel: usize) -> u32 {
    channel as u32 * 2
}

/// Binding of a channel's sampler in [`CHANNEL_GROUP`].
pub const fn sampler_binding(channel: usize) -> u32 {
    channel as u32 * 2 + 1
}

/// The matrices and the camera that a mesh is drawn with, as bytes; matrices column by column.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct GeometryBlock {
    /// `mat4 iModel` at offset 0: from the mesh to the world.
    pub model: [[f32; 4]; 4],
    /// `mat4 iView` at 64: from the world to the camera, which looks along its -z.
    pub view: [[f32; 4]; 4],
    /// `mat4 iProjection` at 128: from the camera to GL's clip space.
    pub projection: [[f32; 4]; 4],
    /// `mat3 iNormalMatrix` at 192, columns 16 bytes apart: from the mesh's normals to those of the world, not
    /// normalised.
    pub normal: [[f32; 4]; 3],
    /// `vec3 iCameraPosition` at 240, in the world.
    pub camera: [f32; 4],
}

const _: () = assert!(size_of::<GeometryBlock>() == 256);

/// The uniform block as bytes, with the field order, offsets and names that the lowered module declares.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct UniformBlock {
    /// `vec3 iResolution` at offset 0, in pixels; z is the pixel aspect ratio, always 1.
    pub resolution: [f32; 3],
    /// `float iTime` at 12, seconds.
    pub time: f32,
    /// `vec4 iMouse` at 16, in pixels of the picture.
    pub mouse: [f32; 4],
    /// `vec4 iDate` at 32: year, month 0-11, day, seconds since midnight.
    pub date: [f32; 4],
    /// `float iTimeDelta` at 48, seconds.
    pub time_delta: f32,
    /// `float iFrameRate` at 52, frames per second.
    pub frame_rate: f32,
    /// `float iSampleRate` at 56, Hz.
    pub sample_rate: f32,
    /// `int iFrame` at 60.
    pub frame: i32,
    /// `float iChannelTime[4]` at 64, array stride 16: x is the value.
    pub channel_time: [[f32; 4]; 4],
    /// `vec3 iChannelResolution[4]` at 128, array stride 16.
    pub channel_resolution: [[f32; 4]; 4],
    /// `float iTimeOffset` at 192 (sound), seconds.
    pub time_offset: f32,
    /// `int iSampleOffset` at 196 (sound), samples.
    pub sample_offset: i32,
    /// The face that a cubemap pass draws, in the order of OpenGL ES 3.0, table 3.21, at 200; the second is padding, so
    /// that the next field is at a multiple of 16.
    pub cube_face: [i32; 2],
    /// `int loaded` of `iCh0` to `iCh3` at 208: 1 where the channel has a texture.
    pub channel_loaded: [i32; 4],
    /// The column and row in the picture of the target's first texel, at 224, in a pass that is drawn in tiles
    /// ([`crate::PassSource::tiled`]); the other two are padding.
    pub tile_origin: [i32; 4],
}

const _: () = assert!(size_of::<UniformBlock>() == 240);
const _: () = assert!(std::mem::offset_of!(UniformBlock, channel_loaded) == 208);
