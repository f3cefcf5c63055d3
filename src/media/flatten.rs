//! Cubemaps and volumes as flat pictures, for previews.

use super::Texels;
use eddy_texture::{Dimension, TextureShape};

/// The cells of the faces in a cross of 4:3, from its top left.
const CROSS: [(usize, usize); 6] = [(2, 1), (0, 1), (1, 0), (1, 2), (1, 1), (3, 1)];

impl Texels {
    /// Returns a picture of it, row 0 at the bottom: a cubemap as a cross of 4:3, a volume by its middle slice.
    pub fn flattened(&self) -> Texels {
        let TextureShape { dimension, width, height, depth, format, .. } = self.shape;
        match dimension {
            Dimension::D2 => self.clone(),
            Dimension::D3 => {
                let slice = self.bytes.len() / depth as usize;
                let bytes = self.bytes[depth as usize / 2 * slice..][..slice].to_vec();
                Texels::flat(width, height, format, bytes)
            }
            Dimension::Cube => {
                let (side, row) = (height as usize, self.row_bytes());
                let mut bytes = vec![0; 12 * side * row];
                for (face, texels) in self.bytes.chunks_exact(side * row).enumerate() {
                    let (column, line) = CROSS[face];
                    for (y, from) in texels.chunks_exact(row).enumerate() {
                        let up = 3 * side - 1 - (line * side + y);
                        bytes[up * 4 * row + column * row..][..row].copy_from_slice(from);
                    }
                }
                Texels::flat(4 * width, 3 * height, format, bytes)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_texture::TexelFormat;

    #[test]
    fn a_cube_becomes_a_cross_and_a_volume_a_slice() {
        let cube = Texels { shape: TextureShape::cube(1, TexelFormat::R8), bytes: vec![1, 2, 3, 4, 5, 6] };
        assert_eq!(cube.flattened().bytes, [0, 4, 0, 0, 2, 5, 1, 6, 0, 3, 0, 0]);
        let volume = Texels { shape: TextureShape::volume(1, 1, 3, TexelFormat::R8), bytes: vec![7, 8, 9] };
        assert_eq!(volume.flattened().bytes, [8]);
    }
}
