//! Texels as floats, and the next level of a volume's mip chain.

use super::Texels;
use eddy_texture::{TexelFormat, TextureShape};
use half::f16;

impl Texels {
    /// Returns the next coarser level: each texel is the trilinear read of this one at its centre, which is the mean of
    /// eight for even sides. GL drivers' `glGenerateMipmap` does the same.
    #[must_use]
    pub fn halved(&self) -> Texels {
        let [width, height, depth] = self.shape.level(1);
        let shape = TextureShape { width, height, depth, ..self.shape }.without_mips();
        let components = self.shape.format.components();
        let mut bytes = Vec::with_capacity(shape.bytes() as usize);
        let along = |n: u32, coarse: u32, fine: u32| {
            let centre = (n as f32 + 0.5) * fine as f32 / coarse as f32 - 0.5;
            let low = centre.floor();
            let clamped = |i: f32| (i.max(0.0) as u32).min(fine - 1);
            (clamped(low), clamped(low + 1.0), centre - low)
        };
        for z in 0..depth {
            let (z0, z1, fz) = along(z, depth, self.shape.depth);
            for y in 0..height {
                let (y0, y1, fy) = along(y, height, self.shape.height);
                for x in 0..width {
                    let (x0, x1, fx) = along(x, width, self.shape.width);
                    for c in 0..components {
                        let at = |x, y, z| self.component([x, y, z], c);
                        let mix = |a: f32, b: f32, f: f32| a + (b - a) * f;
                        let row = |y, z| mix(at(x0, y, z), at(x1, y, z), fx);
                        let slice = |z| mix(row(y0, z), row(y1, z), fy);
                        push(shape.format, mix(slice(z0), slice(z1), fz), &mut bytes);
                    }
                }
            }
        }
        Texels { shape, bytes }
    }

    /// Returns the texels as a shader reads them: bytes divided by 255, missing components as 0, alpha as 1.
    pub fn floats(&self) -> Vec<[f32; 4]> {
        let TextureShape { width, height, format, .. } = self.shape;
        let is_bytes = matches!(format, TexelFormat::R8 | TexelFormat::Rg8 | TexelFormat::Rgba8);
        let scale = if is_bytes { 255.0 } else { 1.0 };
        let count = self.bytes.len() as u32 / format.bytes() as u32;
        let texel = |i: u32| {
            let at = [i % width, i / width % height, i / width / height];
            let mut texel = [0.0, 0.0, 0.0, 1.0];
            for (c, value) in texel.iter_mut().enumerate().take(format.components()) {
                *value = self.component(at, c) / scale;
            }
            texel
        };
        (0..count).map(texel).collect()
    }

    /// Returns a component of a texel, as stored.
    fn component(&self, [x, y, z]: [u32; 3], component: usize) -> f32 {
        let TextureShape { width, height, format, .. } = self.shape;
        let index = ((z * height + y) * width + x) as usize * format.components() + component;
        match format {
            TexelFormat::R8 | TexelFormat::Rg8 | TexelFormat::Rgba8 => f32::from(self.bytes[index]),
            TexelFormat::R16f | TexelFormat::Rg16f | TexelFormat::Rgba16f => {
                f16::from_le_bytes([self.bytes[2 * index], self.bytes[2 * index + 1]]).to_f32()
            }
            TexelFormat::R32f | TexelFormat::Rg32f | TexelFormat::Rgba32f => {
                bytemuck::pod_read_unaligned(&self.bytes[4 * index..][..4])
            }
        }
    }
}

fn push(format: TexelFormat, value: f32, bytes: &mut Vec<u8>) {
    match format {
        TexelFormat::R8 | TexelFormat::Rg8 | TexelFormat::Rgba8 => bytes.push((value + 0.5) as u8),
        TexelFormat::R16f | TexelFormat::Rg16f | TexelFormat::Rgba16f => {
            bytes.extend(f16::from_f32(value).to_le_bytes());
        }
        TexelFormat::R32f | TexelFormat::Rg32f | TexelFormat::Rgba32f => bytes.extend(value.to_le_bytes()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_is_the_mean_of_eight() {
        let shape = TextureShape::volume(2, 2, 2, TexelFormat::R8);
        let halved = Texels { shape, bytes: vec![0, 1, 2, 3, 4, 5, 6, 9] }.halved();
        assert_eq!((halved.shape.level(0), halved.bytes), ([1, 1, 1], vec![4]));
    }

    #[test]
    fn three_texels_become_their_middle_one() {
        let shape = TextureShape::volume(3, 1, 1, TexelFormat::R16f);
        let bytes = [1.0, 5.0, 100.0].iter().flat_map(|v| f16::from_f32(*v).to_le_bytes()).collect();
        assert_eq!(Texels { shape, bytes }.halved().bytes, f16::from_f32(5.0).to_le_bytes());
    }
}
