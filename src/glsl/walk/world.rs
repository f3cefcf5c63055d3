//! Everything that a program reads outside its own memory.

use crate::{
    builtins::Uniform,
    interface::{GeometryBlock, UniformBlock},
};

/// The mip level of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lod {
    /// This level.
    Exact(f64),
    /// From the derivatives of the coordinate along x and along y, plus a bias (section 3.8.11 of the OpenGL ES 3.0
    /// specification).
    Derivatives { x: [f64; 3], y: [f64; 3], bias: f64 },
}

/// Uniforms, textures and inputs of a frame.
pub trait World {
    /// Returns Shadertoy's uniforms.
    fn uniforms(&self) -> &UniformBlock;
    /// Returns the matrices and the camera that a mesh is drawn with; zeros for a pass that draws none, whose program
    /// does not use them.
    fn geometry(&self) -> GeometryBlock;
    /// Returns the words of the custom uniform in a slot.
    fn custom_uniform(&self, slot: u16) -> [u32; 4];
    /// Returns the face of the cube map that is being drawn, 0 to 5.
    fn cube_face(&self) -> u32;
    /// Returns width, height and depth of a level of a channel's texture; zeros if it has no texture.
    fn size(&self, channel: u8, level: i32) -> [i32; 3];
    fn levels(&self, channel: u8) -> u32;
    /// Returns a texel of a level; zeros outside of the texture.
    fn fetch(&self, channel: u8, at: [i32; 3], level: i32) -> [f32; 4];
    /// Returns whether a read without an explicit level uses one level for all four pixels of a quad, from the
    /// differences along its first row and its first column. GLSL ES 3.00 does not define this (section 8.8); otherwise
    /// each pixel has its own.
    fn has_one_level_per_quad(&self, _channel: u8) -> bool {
        false
    }
    /// Returns a filtered read. `offset` is in texels.
    fn sample(&self, channel: u8, at: [f64; 3], lod: Lod, offset: [i32; 3]) -> [f64; 4];
}

/// Returns the words of one of Shadertoy's uniforms, in memory order.
pub(super) fn uniform_words(world: &dyn World, uniform: Uniform) -> Vec<u32> {
    let block = world.uniforms();
    let floats = |numbers: &[f32]| numbers.iter().map(|number| number.to_bits()).collect();
    let first = |slots: &[[f32; 4]; 4], count: usize| -> Vec<u32> {
        slots.iter().flat_map(|slot| slot[..count].iter().map(|number| number.to_bits())).collect()
    };
    match uniform {
        Uniform::Resolution => floats(&block.resolution),
        Uniform::Time => floats(&[block.time]),
        Uniform::Mouse => floats(&block.mouse),
        Uniform::Date => floats(&block.date),
        Uniform::TimeDelta => floats(&[block.time_delta]),
        Uniform::FrameRate => floats(&[block.frame_rate]),
        Uniform::SampleRate => floats(&[block.sample_rate]),
        Uniform::Frame => vec![block.frame as u32],
        Uniform::ChannelTime => first(&block.channel_time, 1),
        Uniform::ChannelResolution => first(&block.channel_resolution, 3),
        Uniform::TimeOffset => floats(&[block.time_offset]),
        Uniform::SampleOffset => vec![block.sample_offset as u32],
        Uniform::ChannelLoaded => block.channel_loaded.map(|loaded| loaded as u32).to_vec(),
        Uniform::Model => floats(world.geometry().model.as_flattened()),
        Uniform::View => floats(world.geometry().view.as_flattened()),
        Uniform::Projection => floats(world.geometry().projection.as_flattened()),
        Uniform::NormalMatrix => {
            let columns = world.geometry().normal.map(|[x, y, z, _]| [x, y, z]);
            floats(columns.as_flattened())
        }
        Uniform::CameraPosition => floats(&world.geometry().camera[..3]),
    }
}
