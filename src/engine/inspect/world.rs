//! All inputs of one draw of a pass.

use super::texture::{LevelBy, TextureCopy};
use eddy_glsl::{
    MAX_CHANNELS,
    interface::{GeometryBlock, UniformBlock},
    walk::{Lod, World},
};
use eddy_media::mesh::Mesh;
use eddy_project::Filter;
use std::sync::Arc;

/// The uniforms and textures that a draw reads, as they were at its start.
#[derive(Clone, Debug, PartialEq)]
pub struct PassInputs {
    pub uniforms: UniformBlock,
    /// The author's own, in slot order.
    pub custom_uniforms: Vec<[u32; 4]>,
    pub channels: [TextureCopy; MAX_CHANNELS],
    /// The drawn texels, across and up.
    pub size: (u32, u32),
    /// The selected face of a cubemap, in the order of [`eddy_texture::Face::ALL`]; 0 for any other pass.
    pub face: u32,
    /// The further inputs of each draw of a pass with meshes, in drawing order; empty for any other pass.
    pub meshes: Vec<MeshInputs>,
}

/// A mesh and its matrices.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshInputs {
    pub mesh: Arc<Mesh>,
    pub geometry: GeometryBlock,
}

impl PassInputs {
    /// Returns the inputs of a draw's programs; `None` for the one draw of a pass without meshes.
    pub fn of_draw(&self, draw: Option<usize>) -> DrawInputs<'_> {
        let mesh = draw.and_then(|draw| self.meshes.get(draw));
        DrawInputs { pass: self, geometry: mesh.map_or_else(GeometryBlock::default, |mesh| mesh.geometry) }
    }
}

/// The inputs of a pass for the programs of one of its draws.
#[derive(Clone, Copy, Debug)]
pub struct DrawInputs<'i> {
    pass: &'i PassInputs,
    geometry: GeometryBlock,
}

impl DrawInputs<'_> {
    /// Returns whether the level of a read from a channel affects its result.
    pub fn is_of_levels(&self, channel: u8) -> bool {
        let texture = &self.pass.channels[usize::from(channel)];
        texture.filter == Filter::Mipmap && texture.levels.len() > 1
    }
}

impl World for DrawInputs<'_> {
    fn uniforms(&self) -> &UniformBlock {
        &self.pass.uniforms
    }

    fn geometry(&self) -> GeometryBlock {
        self.geometry
    }

    fn custom_uniform(&self, slot: u16) -> [u32; 4] {
        self.pass.custom_uniforms.get(usize::from(slot)).copied().unwrap_or_default()
    }

    fn cube_face(&self) -> u32 {
        self.pass.face
    }

    fn size(&self, channel: u8, level: i32) -> [i32; 3] {
        let base = self.pass.channels[usize::from(channel)].levels.first();
        // Also for levels that a texture does not have (`glsl/emit/expression.rs`).
        let shift = (level as u32).min(31);
        let of_level = |side: u32| (side >> shift).max(1) as i32;
        base.map_or([0; 3], |base| [base.width, base.height, base.depth].map(of_level))
    }

    fn levels(&self, channel: u8) -> u32 {
        self.pass.channels[usize::from(channel)].levels.len() as u32
    }

    fn fetch(&self, channel: u8, at: [i32; 3], level: i32) -> [f32; 4] {
        self.pass.channels[usize::from(channel)].fetch(at, level)
    }

    fn has_one_level_per_quad(&self, channel: u8) -> bool {
        self.pass.channels[usize::from(channel)].level_by == LevelBy::Quad
    }

    fn sample(&self, channel: u8, at: [f64; 3], lod: Lod, offset: [i32; 3]) -> [f64; 4] {
        self.pass.channels[usize::from(channel)].sample(at, lod, offset)
    }
}
