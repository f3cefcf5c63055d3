//! Pictures as rows of integers, the top row first.

use eddy_engine::Pixels;

/// Appends components of 8 or 16 bits to `out`; those of 16 bits in the byte order of `bytes`. Values are converted as
/// by [`Pixels::to_rgba8`]: clamped to 0 to 1, rounded, NaN as 0.
pub(crate) fn write(pixels: &Pixels, components: usize, depth: u32, bytes: fn(u16) -> [u8; 2], out: &mut Vec<u8>) {
    out.reserve(pixels.texels.len() * components * depth as usize / 8);
    for row in pixels.texels.chunks_exact(pixels.width as usize).rev() {
        let values = row.iter().flat_map(|texel| &texel[..components]);
        if depth == 8 {
            out.extend(values.map(|v| (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8));
        } else {
            out.extend(values.flat_map(|v| bytes((v.clamp(0.0, 1.0) * 65_535.0 + 0.5) as u16)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_row_is_first_and_values_are_rounded() {
        let texels = vec![[1.0, f32::NAN, -1.0, 0.5], [0.25, 2.0, 0.0, 1.0]];
        let pixels = Pixels { width: 1, height: 2, texels };
        let mut out = Vec::new();
        write(&pixels, 4, 8, u16::to_le_bytes, &mut out);
        assert_eq!(out, pixels.to_rgba8());
        assert_eq!(out, [64, 255, 0, 255, 255, 0, 0, 128]);
        out.clear();
        write(&pixels, 3, 16, u16::to_be_bytes, &mut out);
        assert_eq!(out, [0x40, 0, 0xff, 0xff, 0, 0, 0xff, 0xff, 0, 0, 0, 0]);
    }
}
