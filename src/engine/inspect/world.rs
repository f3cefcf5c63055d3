//! What one draw of a pass reads.

use super::texture::TextureCopy;
use crate::glsl::{
    interface::UniformBlock,
    walk::{Lod, World},
};

/// The uniforms and textures that a draw reads, as they were when it began.
#[derive(Clone, Debug, PartialEq)]
pub struct PassInputs {
    pub uniforms: UniformBlock,
    /// The author's own, by their slots.
    pub custom_uniforms: Vec<[u32; 4]>,
    pub channels: [TextureCopy; 4],
    /// The texels that are drawn, across and up.
    pub size: (u32, u32),
}

impl World for PassInputs {
    fn uniforms(&self) -> &UniformBlock {
        &self.uniforms
    }

    fn custom_uniform(&self, slot: u16) -> [u32; 4] {
        self.custom_uniforms.get(usize::from(slot)).copied().unwrap_or_default()
    }

    fn cube_face(&self) -> u32 {
        0
    }

    fn size(&self, channel: u8, level: i32) -> [i32; 3] {
        let levels = &self.channels[usize::from(channel)].levels;
        let level = usize::try_from(level).ok().and_then(|level| levels.get(level));
        level.map_or([0; 3], |level| [level.width as i32, level.height as i32, 1])
    }

    fn levels(&self, channel: u8) -> u32 {
        self.channels[usize::from(channel)].levels.len() as u32
    }

    fn fetch(&self, channel: u8, at: [i32; 3], level: i32) -> [f32; 4] {
        self.channels[usize::from(channel)].fetch([at[0], at[1]], level)
    }

    fn sample(&self, channel: u8, at: [f64; 3], lod: Lod, offset: [i32; 3]) -> [f64; 4] {
        self.channels[usize::from(channel)].sample([at[0], at[1]], lod, [offset[0], offset[1]])
    }
}
