//! Times, counts and texels of frames.

use crate::project::PassId;

/// Time of one pass in one frame.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTime {
    pub pass: PassId,
    pub gpu_millis: f64,
}

/// The work of one frame.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FrameStats {
    /// Passes drawn in this frame, every step of a group counted.
    pub passes_drawn: u64,
    /// Passes left out because nothing they read has changed since they were drawn, and the bytes of texels that were
    /// not written for it.
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
    /// Returns the bytes that a PNG shows: clamped to 0..1, rounded to 8 bits, NaN as 0, the top row first. The one way
    /// from a picture to bytes: screenshots, `eddy render` and the golden tests share it.
    pub fn to_rgba8(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.texels.len() * 4);
        for row in self.texels.chunks_exact(self.width as usize).rev() {
            // `as` turns NaN into 0.
            bytes.extend(row.iter().flatten().map(|v| (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8));
        }
        bytes
    }
}

/// A picture as a screen shows it: red, green, blue and alpha of 8 bits each, the top row first, no padding.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    pub width: u32,
    pub height: u32,
    pub bytes: Vec<u8>,
}

/// A small picture of a target.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Miniature {
    /// Of one size, whatever the target's shape.
    pub picture: Picture,
    /// Texels of the target, across and up.
    pub of: (u32, u32),
}

/// A texel of a target.
#[derive(Clone, Debug, PartialEq)]
pub struct TexelAt {
    pub pass: PassId,
    /// Which of the pass's targets.
    pub index: usize,
    /// From the left, from the bottom.
    pub texel: (u32, u32),
    /// So many of the value's components are stored; what is missing reads as 0, alpha as 1.
    pub components: u8,
    pub value: [f32; 4],
}
