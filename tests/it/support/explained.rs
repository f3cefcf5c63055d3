//! Reasons why a walked pixel differs from the one drawn by a device, as far as the walker can find them.

use super::walked::{all_pixels, is_same};
use eddy::{
    debugger::{
        audit::{Class, add_jitter, audit},
        trace::{Extent, Tracer},
    },
    engine::{LevelBy, PassInputs, Sources, TextureCopy},
    project::Filter,
};

/// The limit of statements per pixel.
pub(crate) const STATEMENTS: u64 = 3_000_000;
/// A step of 8 bits, the smallest difference on a screen.
pub(crate) const VISIBLE: f64 = 1.0 / 255.0;

/// The number of patterns that move texels by steps of 8 bits.
const PATTERNS: u64 = 8;

/// A pass of a drawn frame, whose pixels are to be explained.
pub(crate) struct Explained<'p> {
    pub sources: &'p Sources<'p>,
    pub index: usize,
    pub read: &'p PassInputs,
}

impl Explained<'_> {
    /// Returns the reason why a pixel differs by `difference`, as far as the walker can find it.
    pub(crate) fn why(&self, pixel: (u32, u32), difference: f64) -> String {
        let Ok(audit) = audit(self.sources, self.index, self.read, &[pixel], STATEMENTS) else {
            return "not audited".into();
        };
        let of = |class: Class| {
            let finding = audit.findings.iter().find(|finding| finding.kind.class() == class);
            finding.map(|finding| format!("{}, {}", finding.kind.name(), finding.kind.message()))
        };
        if audit.pixels.iter().any(|audited| audited.error >= difference / 16.0) {
            return "rounding: the error of single precision is as large".into();
        }
        if self.is_ill_conditioned(pixel, difference) {
            return "ill-conditioned: changed last bits move the value as far".into();
        }
        if let Some(why) = self.is_filtered(pixel, difference) {
            return why.into();
        }
        let has_none = |texture: &TextureCopy| !texture.levels[0].texels.iter().flatten().all(|x| x.is_finite());
        if !difference.is_finite() && self.read.channels.iter().any(has_none) {
            return "nonfinite, a texel that is read is not finite".into();
        }
        let left = of(Class::Undefined).or_else(|| of(Class::Nonfinite)).or_else(|| of(Class::Decided));
        left.unwrap_or_else(|| "not explained".into())
    }

    fn value(&self, read: &PassInputs, pixel: (u32, u32)) -> Option<[f32; 4]> {
        let extent = Extent { statements: STATEMENTS, steps: 0 };
        Tracer::new(self.sources, self.index, read, extent).ok()?.trace(pixel).ok()?.value
    }

    /// Returns how filtering explains the difference: the value changes with the weights of texels.
    fn is_filtered(&self, pixel: (u32, u32), difference: f64) -> Option<&'static str> {
        let mut read = self.read.clone();
        read.channels.iter_mut().for_each(|texture| texture.filter = Filter::Nearest);
        if self.moves_by(&read, pixel)? >= difference {
            return Some("filtered: the filtered texels differ as much");
        }
        let mut by_quads = self.read.clone();
        by_quads.channels.iter_mut().for_each(|texture| texture.level_by = LevelBy::Quad);
        if self.moves_by(&by_quads, pixel)? >= difference / 2.0 {
            return Some("filtered: the level of the quad, as a device computes it, moves the value as far");
        }
        // llvmpipe filters 8-bit textures in 8-bit numbers and rounds in each of three steps: a read value may be off
        // by three steps, differently each time (`walker_textures::texels_of_8_bits_are_mixed_in_8_bits`).
        for pattern in 0..PATTERNS {
            let mut moved = by_quads.clone();
            let mut random = pattern;
            for texture in moved.channels.iter_mut().filter(|texture| has_8_bits(texture)) {
                for x in texture.levels.iter_mut().flat_map(|level| &mut level.texels).flatten() {
                    // The generator of Knuth's MMIX.
                    random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    *x += ((random >> 33) % 7) as f32 / 255.0 - 3.0 / 255.0;
                }
            }
            if self.moves_by(&moved, pixel)? >= difference / 2.0 {
                return Some("filtered in 8 bits: errors of three steps move the value as far");
            }
        }
        // The mip level follows from derivatives, which are undefined where neighbours take other branches (8.8).
        let mut coarser = self.read.clone();
        coarser.channels.iter_mut().filter(|texture| texture.filter == Filter::Mipmap).for_each(read_coarser);
        let changes_with_level = self.moves_by(&coarser, pixel)? >= difference;
        changes_with_level.then_some("filtered: the texels of the next level move the value as far")
    }

    /// Returns the distance of the walker's value from the one with other inputs.
    fn moves_by(&self, read: &PassInputs, pixel: (u32, u32)) -> Option<f64> {
        let (own, other) = (self.value(self.read, pixel)?, self.value(read, pixel)?);
        Some(own.iter().zip(other).map(|(&a, b)| f64::from(a - b).abs()).fold(0.0, f64::max))
    }

    /// Returns whether the walker's own value moves as far with randomly changed roundings, or if time and resolution
    /// change in the last bits: a point at the edge of a texel moves by these alone.
    fn is_ill_conditioned(&self, pixel: (u32, u32), difference: f64) -> bool {
        let Some(own) = self.value(self.read, pixel) else { return false };
        let is_far = |other: [f32; 4]| {
            own.iter().zip(other).any(|(&a, b)| {
                let distance = f64::from(a - b).abs();
                !is_same(a, b) && (distance >= difference / 4.0 || distance.is_nan())
            })
        };
        let jittered = |seed| add_jitter(self.sources, self.index, self.read, pixel, (STATEMENTS, seed)).ok();
        let moved = |by: i32| {
            let moved = |x: f32| f32::from_bits(x.to_bits().wrapping_add_signed(by));
            let mut read = self.read.clone();
            read.uniforms.time = moved(read.uniforms.time);
            read.uniforms.resolution = read.uniforms.resolution.map(moved);
            self.value(&read, pixel)
        };
        (0..16).filter_map(jittered).any(is_far)
            || [1, 2, 3, 5, 8, -1, -2, -5].into_iter().filter_map(moved).any(is_far)
    }
}

/// Replaces each level's texels by those of the next level.
fn read_coarser(texture: &mut TextureCopy) {
    for i in 1..texture.levels.len() {
        let [level, next] = [i - 1, i].map(|i| texture.levels[i].clone());
        let halved = |at: u32, size: u32| (at / 2).min(size - 1);
        let at =
            |(x, y): (u32, u32)| next.texels[(halved(y, next.height) * next.width + halved(x, next.width)) as usize];
        texture.levels[i - 1].texels = all_pixels((level.width, level.height)).into_iter().map(at).collect();
    }
}

/// Returns whether a texture is filtered and has 8 bits.
fn has_8_bits(texture: &TextureCopy) -> bool {
    let mut texels = texture.levels[0].texels.iter().flatten();
    texture.filter != Filter::Nearest && texels.all(|x| (x * 255.0 - (x * 255.0).round()).abs() < 1e-3)
}
