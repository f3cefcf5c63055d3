//! Holds everything that one draw of a pass reads.

use super::texture::{LevelBy, TextureCopy};
use eddy_glsl::{
    SLOTS,
    interface::{GeometryBlock, UniformBlock},
    walk::{Lod, World},
};
use eddy_media::mesh::Mesh;
use eddy_project::Filter;
use std::sync::Arc;

/// The uniforms and textures that a draw reads, as they were when it began.
#[derive(Clone, Debug, PartialEq)]
pub struct PassInputs {
    pub uniforms: UniformBlock,
    /// The author's own, by their slots.
    pub custom_uniforms: Vec<[u32; 4]>,
    pub channels: [TextureCopy; SLOTS],
    /// The texels that are drawn, across and up.
    pub size: (u32, u32),
    /// The face of a cubemap that is walked, in the order of [`eddy_texture::Face::ALL`]; 0 for any other pass.
    pub face: u32,
    /// The further inputs of each draw of a pass that draws meshes, in drawing order; empty for any other pass.
    pub meshes: Vec<MeshInputs>,
}

/// A mesh, and the matrices that it is drawn with.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshInputs {
    pub mesh: Arc<Mesh>,
    pub geometry: GeometryBlock,
}

impl PassInputs {
    /// Returns what the programs of a draw read; `None` for the one of a pass that draws no meshes.
    pub fn of_draw(&self, draw: Option<usize>) -> DrawInputs<'_> {
        let mesh = draw.and_then(|draw| self.meshes.get(draw));
        DrawInputs { pass: self, geometry: mesh.map_or_else(GeometryBlock::default, |mesh| mesh.geometry) }
    }
}

/// The inputs of a pass as the programs of one of its draws read them.
#[derive(Clone, Copy, Debug)]
pub struct DrawInputs<'i> {
    pass: &'i PassInputs,
    geometry: GeometryBlock,
}

impl DrawInputs<'_> {
    /// Returns whether it matters for a channel which level of its texture a read asks for.
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
        // Levels that a texture does not have included (`glsl/emit/expression.rs`).
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

    fn has_one_level_a_quad(&self, channel: u8) -> bool {
        self.pass.channels[usize::from(channel)].level_by == LevelBy::Quad
    }

    fn sample(&self, channel: u8, at: [f64; 3], lod: Lod, offset: [i32; 3]) -> [f64; 4] {
        self.pass.channels[usize::from(channel)].sample(at, lod, offset)
    }
}
