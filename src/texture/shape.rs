//! The dimension, size and mip levels of a texture.

use super::TexelFormat;

/// The coordinates by which a texture is read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Dimension {
    /// u and v.
    #[default]
    D2,
    /// u, v and w.
    D3,
    /// A direction, which points to one of six square faces: +x, -x, +y, -y, +z, -z.
    Cube,
}

impl Dimension {
    /// Returns the number of pictures per level: the faces of a cube.
    pub const fn layers(self) -> u32 {
        match self {
            Dimension::D2 | Dimension::D3 => 1,
            Dimension::Cube => 6,
        }
    }
}

/// The description of a texture without its texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TextureShape {
    /// The kind of texture.
    pub dimension: Dimension,
    /// The width of level 0 in texels; of each face for a cube.
    pub width: u32,
    /// The height of level 0 in texels.
    pub height: u32,
    /// The depth of level 0 of a 3D texture in texels; otherwise 1.
    pub depth: u32,
    /// The number of levels in the mip chain, at least 1.
    pub levels: u32,
    /// The format of its texels.
    pub format: TexelFormat,
}

impl TextureShape {
    /// Returns a 2D texture of one level.
    pub const fn flat(width: u32, height: u32, format: TexelFormat) -> Self {
        Self { dimension: Dimension::D2, width, height, depth: 1, levels: 1, format }
    }

    /// Returns a 3D texture of one level.
    pub const fn volume(width: u32, height: u32, depth: u32, format: TexelFormat) -> Self {
        Self { dimension: Dimension::D3, width, height, depth, levels: 1, format }
    }

    /// Returns a cube of one level.
    pub const fn cube(side: u32, format: TexelFormat) -> Self {
        Self { dimension: Dimension::Cube, ..Self::flat(side, side, format) }
    }

    /// Returns the same shape with all levels down to one texel: floor(log2(longest side)) + 1 of them.
    #[must_use]
    pub fn with_mips(self) -> Self {
        Self { levels: self.width.max(self.height).max(self.depth).max(1).ilog2() + 1, ..self }
    }

    /// Returns the same shape with only level 0.
    #[must_use]
    pub fn without_mips(self) -> Self {
        Self { levels: 1, ..self }
    }

    /// Returns the number of pictures per level.
    pub const fn layers(self) -> u32 {
        self.dimension.layers()
    }

    /// Returns the width, height and depth of a level in texels.
    pub fn level(self, level: u32) -> [u32; 3] {
        [self.width, self.height, self.depth].map(|side| (side >> level).max(1))
    }

    /// Returns the bytes of a level with all its layers, without padding.
    pub fn level_bytes(self, level: u32) -> u64 {
        let [width, height, depth] = self.level(level).map(u64::from);
        width * height * depth * u64::from(self.layers()) * self.format.bytes()
    }

    /// Returns the bytes of all levels and layers.
    pub fn bytes(self) -> u64 {
        (0..self.levels).map(|level| self.level_bytes(level)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chain_goes_down_to_one_texel() {
        let levels = |(width, height)| TextureShape::flat(width, height, TexelFormat::R8).with_mips().levels;
        assert_eq!([(1, 1), (2, 1), (3, 3), (1, 4096), (1920, 1080)].map(levels), [1, 2, 2, 13, 11]);
        let volume = TextureShape::volume(2, 4, 9, TexelFormat::R8).with_mips();
        assert_eq!((volume.levels, volume.level(1), volume.level(3)), (4, [1, 2, 4], [1, 1, 1]));
    }

    #[test]
    fn bytes_count_every_level_and_layer() {
        let flat = TextureShape::flat(4, 2, TexelFormat::Rgba32f);
        assert_eq!((flat.bytes(), flat.with_mips().bytes()), (8 * 16, (8 + 2 + 1) * 16));
        assert_eq!(TextureShape::cube(4, TexelFormat::Rg8).with_mips().bytes(), 6 * (16 + 4 + 1) * 2);
        assert_eq!(TextureShape::volume(2, 2, 2, TexelFormat::R8).with_mips().bytes(), 8 + 1);
    }
}
