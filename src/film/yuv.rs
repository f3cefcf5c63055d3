//! Pictures as luma and chroma planes, by ITU-R BT.709-6: matrix of section 3.2 and 3.3, codes of section 4.6; for the
//! full range the codes of ITU-T H.273, section 8.3.
//!
//! A pass's values are taken as R', G' and B', as displayed: they are not linearised. They are converted from floats,
//! so they are rounded once. Chroma of 4:2:0 and 4:2:2 is sited at the left of two pixels and, for 4:2:0, between two
//! rows, as decoders expect by default (H.264, figure E-1, type 0): it is filtered by (1 2 1)/4 across and (1 1)/2
//! down.

use super::values::{Chroma, ColorRange};
use eddy_engine::Pixels;

/// The layout of the planes. Planes follow each other, the top row first, without padding; codes of more than 8 bits
/// are 16-bit words, little endian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct YuvFormat {
    pub chroma: Chroma,
    /// Bits per code: 8 or 10.
    pub depth: u32,
    pub range: ColorRange,
}

impl YuvFormat {
    /// Returns ffmpeg's name.
    pub fn name(self) -> String {
        let chroma = match self.chroma {
            Chroma::C420 => "yuv420p",
            Chroma::C422 => "yuv422p",
            Chroma::C444 => "yuv444p",
        };
        if self.depth == 8 { chroma.into() } else { format!("{chroma}{}le", self.depth) }
    }

    /// Returns whether the width, and the height, has to be even for every player.
    pub fn halves(self) -> (bool, bool) {
        (self.chroma != Chroma::C444, self.chroma == Chroma::C420)
    }

    /// Appends a picture to `out`.
    pub fn write(self, pixels: &Pixels, out: &mut Vec<u8>) {
        let (width, height) = (pixels.width as usize, pixels.height as usize);
        let codes = Codes::new(self);
        let mut blue = vec![0.0f32; width * height];
        let mut red = vec![0.0f32; width * height];
        for (y, row) in pixels.texels.chunks_exact(width).rev().enumerate() {
            for (x, texel) in row.iter().enumerate() {
                // NaN is 0.
                let [r, g, b] = [texel[0], texel[1], texel[2]].map(|v| if v > 0.0 { v.min(1.0) } else { 0.0 });
                let luma = 0.2126 * r + 0.7152 * g + 0.0722 * b;
                blue[y * width + x] = (b - luma) / 1.8556;
                red[y * width + x] = (r - luma) / 1.5748;
                codes.push(out, luma * codes.luma.0 + codes.luma.1);
            }
        }
        for plane in [&blue, &red] {
            self.write_chroma(plane, (width, height), codes, out);
        }
    }

    fn write_chroma(self, plane: &[f32], (width, height): (usize, usize), codes: Codes, out: &mut Vec<u8>) {
        let code = |difference: f32| difference * codes.chroma.0 + codes.chroma.1;
        if self.chroma == Chroma::C444 {
            plane.iter().for_each(|difference| codes.push(out, code(*difference)));
            return;
        }
        let rows = if self.chroma == Chroma::C420 { 2 } else { 1 };
        for y in (0..height).step_by(rows) {
            let other = if rows == 2 { (y + 1).min(height - 1) } else { y };
            let at = |x: usize| 0.5 * (plane[y * width + x] + plane[other * width + x]);
            for x in (0..width).step_by(2) {
                let (left, right) = (at(x.saturating_sub(1)), at((x + 1).min(width - 1)));
                codes.push(out, code(0.25 * (left + right) + 0.5 * at(x)));
            }
        }
    }
}

/// The scale and the offset of codes.
#[derive(Clone, Copy)]
struct Codes {
    luma: (f32, f32),
    chroma: (f32, f32),
    most: f32,
    is_wide: bool,
}

impl Codes {
    fn new(format: YuvFormat) -> Codes {
        let (unit, most) = ((1u32 << (format.depth - 8)) as f32, ((1u32 << format.depth) - 1) as f32);
        let (luma, chroma) = match format.range {
            ColorRange::Limited => ((219.0 * unit, 16.0 * unit), (224.0 * unit, 128.0 * unit)),
            ColorRange::Full => ((most, 0.0), (most, 128.0 * unit)),
        };
        Codes { luma, chroma, most, is_wide: format.depth > 8 }
    }

    fn push(self, out: &mut Vec<u8>, value: f32) {
        let code = (value + 0.5).clamp(0.0, self.most) as u16;
        if self.is_wide { out.extend(code.to_le_bytes()) } else { out.push(code as u8) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn planes(chroma: Chroma, depth: u32, range: ColorRange, width: u32, texels: Vec<[f32; 4]>) -> Vec<u8> {
        let pixels = Pixels { width, height: texels.len() as u32 / width, texels };
        let mut out = Vec::new();
        YuvFormat { chroma, depth, range }.write(&pixels, &mut out);
        out
    }

    #[test]
    fn colours_are_the_codes_of_bt_709() {
        let one = |color: [f32; 3], range| planes(Chroma::C444, 8, range, 1, vec![[color[0], color[1], color[2], 0.5]]);
        // ITU-R BT.709-6, table of 4.6: black 16, white 235; pure blue has Cb 240, pure red has Cr 240.
        for (color, limited, full) in [
            ([0.0, 0.0, 0.0], [16, 128, 128], [0, 128, 128]),
            ([1.0, 1.0, 1.0], [235, 128, 128], [255, 128, 128]),
            ([1.0, 0.0, 0.0], [63, 102, 240], [54, 99, 255]),
            ([0.0, 1.0, 0.0], [173, 42, 26], [182, 30, 12]),
            ([0.0, 0.0, 1.0], [32, 240, 118], [18, 255, 116]),
            ([f32::NAN, -3.0, 7.0], [32, 240, 118], [18, 255, 116]),
        ] {
            assert_eq!(one(color, ColorRange::Limited), limited, "{color:?}");
            assert_eq!(one(color, ColorRange::Full), full, "{color:?}");
        }
        let wide = planes(Chroma::C444, 10, ColorRange::Limited, 1, vec![[1.0; 4]]);
        assert_eq!(wide, [172, 3, 0, 2, 0, 2], "940, 512, 512");
    }

    #[test]
    fn chroma_is_sited_left_and_the_top_row_is_first() {
        // Row 0 is the bottom. Three columns and rows, so that the sides are odd.
        let texels = (0..9).map(|n| if n == 8 { [0.0, 0.0, 1.0, 1.0] } else { [0.0, 0.0, 0.0, 1.0] }).collect();
        let out = planes(Chroma::C420, 8, ColorRange::Limited, 3, texels);
        assert_eq!(out.len(), 9 + 4 + 4);
        assert_eq!(out[..9], [16, 16, 32, 16, 16, 16, 16, 16, 16], "blue is at the right of the top row");
        // Cb of blue is 112 more than 128. The last column is repeated for the missing one: 1/2 + 1/4, of two rows.
        assert_eq!(out[9..13], [128, 128 + 42, 128, 128]);
        let texels = vec![[0.0, 0.0, 1.0, 1.0], [0.0; 4], [0.0; 4], [0.0; 4]];
        let out = planes(Chroma::C422, 8, ColorRange::Limited, 4, texels);
        assert_eq!(out[4..6], [128 + 84, 128], "the first column stands for the one that is missing");
    }

    #[test]
    fn names_equal_those_of_ffmpeg() {
        let name = |chroma, depth| YuvFormat { chroma, depth, range: ColorRange::Full }.name();
        assert_eq!(name(Chroma::C420, 8), "yuv420p");
        assert_eq!(name(Chroma::C422, 10), "yuv422p10le");
    }
}
