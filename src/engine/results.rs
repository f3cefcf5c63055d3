//! Times, counts and texels of frames.

use eddy_project::PassName;

/// The time of one pass in one frame.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTime {
    pub pass: PassName,
    pub gpu_millis: f64,
}

/// The work of one frame.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FrameStats {
    /// The number of passes drawn in this frame, counting every step of a group.
    pub passes_drawn: u64,
    /// The number of passes skipped because their inputs have not changed since they were drawn, and the bytes of
    /// texels whose writes this saved.
    pub passes_cached: u64,
    pub bytes_cached: u64,
}

/// A pass's texels. Row 0 is the bottom; no padding.
#[derive(Clone, Debug, PartialEq)]
pub struct Pixels {
    pub width: u32,
    pub height: u32,
    pub texels: Vec<[f32; 4]>,
}

impl Pixels {
    /// Returns the bytes of the picture for a PNG: clamped to 0..1, rounded to 8 bits, NaN as 0, the top row first.
    /// This is the only conversion of a picture to bytes: screenshots, `eddy render` and the golden tests share it.
    pub fn to_rgba8(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.texels.len() * 4);
        for row in self.texels.chunks_exact(self.width as usize).rev() {
            // `as` converts NaN to 0.
            bytes.extend(row.iter().flatten().map(|v| (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8));
        }
        bytes
    }
}

/// A picture for a screen: red, green, blue and alpha of 8 bits each, the top row first, no padding.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    pub width: u32,
    pub height: u32,
    pub bytes: Vec<u8>,
}

/// A thumbnail of a target.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Miniature {
    /// The picture, whose size does not depend on the target's shape.
    pub picture: Picture,
    /// The positions of NaN or infinite texels of the target, as runs: from one column of the picture to before the
    /// other, and the row from the top.
    pub nonfinite: Vec<(u32, u32, u32)>,
    /// The size of the target in texels, across and up.
    pub of: (u32, u32),
}

impl Miniature {
    /// `marked` has an alpha of 0 where a texel is NaN or infinite.
    pub(super) fn new(marked: Picture, of: (u32, u32)) -> Self {
        let mut picture = marked;
        let mut nonfinite: Vec<(u32, u32, u32)> = Vec::new();
        for (at, alpha) in picture.bytes.iter_mut().skip(3).step_by(4).enumerate() {
            if std::mem::replace(alpha, 255) == 0 {
                let (x, y) = (at as u32 % picture.width, at as u32 / picture.width);
                match nonfinite.last_mut() {
                    Some((_, end, row)) if (*end, *row) == (x, y) => *end += 1,
                    _ => nonfinite.push((x, x + 1, y)),
                }
            }
        }
        Self { picture, nonfinite, of }
    }
}

/// A texel of a target.
#[derive(Clone, Debug, PartialEq)]
pub struct TexelAt {
    pub pass: PassName,
    /// The index among the targets of the pass.
    pub index: usize,
    /// The position of the texel, from the left and from the bottom.
    pub texel: (u32, u32),
    /// The number of stored components of the value; missing ones read as 0, alpha as 1.
    pub components: u8,
    pub value: [f32; 4],
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marked_texels_are_reported_in_runs_and_shown_opaque() {
        let alphas = [255, 0, 0, 0, 0, 255];
        let bytes = alphas.iter().flat_map(|alpha| [10, 20, 30, *alpha]).collect();
        let made = Miniature::new(Picture { width: 3, height: 2, bytes }, (640, 360));
        assert_eq!(made.nonfinite, [(1, 3, 0), (0, 2, 1)]);
        assert_eq!(made.picture.bytes, [10, 20, 30, 255].repeat(6));
    }
}
