//! Why a pixel that is walked differs from the one that a device draws: what the walker itself finds out.

use super::walked::{all_pixels, is_same};
use eddy::{
    debugger::{
        audit::{Class, add_jitter, audit},
        trace::{Extent, Tracer},
    },
    engine::{LevelBy, PassInputs, Sources, TextureCopy},
    project::Filter,
};

/// Statements of a pixel.
pub(crate) const STATEMENTS: u64 = 3_000_000;
/// A step of 8 bits: what a screen shows.
pub(crate) const VISIBLE: f64 = 1.0 / 255.0;

/// Ways to move texels by steps of 8 bits.
const PATTERNS: u64 = 8;

/// A pass of a frame that has been drawn, whose pixels are asked for reasons.
pub(crate) struct Explained<'p> {
    pub sources: &'p Sources<'p>,
    pub index: usize,
    pub read: &'p PassInputs,
}

impl Explained<'_> {
    /// Why a pixel differs by so much, as far as the walker finds out.
    pub(crate) fn why(&self, pixel: (u32, u32), apart: f64) -> String {
        let Ok(audit) = audit(self.sources, self.index, self.read, &[pixel], STATEMENTS) else {
            return "not audited".into();
        };
        let of = |class: Class| {
            let finding = audit.findings.iter().find(|finding| finding.kind.class() == class);
            finding.map(|finding| format!("{}, {}", finding.kind.name(), finding.kind.message()))
        };
        if audit.pixels.iter().any(|audited| audited.error >= apart / 16.0) {
            return "rounding: single precision is as far from double".into();
        }
        if self.is_touchy(pixel, apart) {
            return "ill-conditioned: other last bits move it as far".into();
        }
        if let Some(why) = self.is_filtered(pixel, apart) {
            return why.into();
        }
        let has_none = |texture: &TextureCopy| !texture.levels[0].texels.iter().flatten().all(|x| x.is_finite());
        if !apart.is_finite() && self.read.channels.iter().any(has_none) {
            return "nonfinite, texels that are read are no numbers".into();
        }
        let left = of(Class::Undefined).or_else(|| of(Class::Nonfinite)).or_else(|| of(Class::Decided));
        left.unwrap_or_else(|| "not explained".into())
    }

    fn value(&self, read: &PassInputs, pixel: (u32, u32)) -> Option<[f32; 4]> {
        let extent = Extent { statements: STATEMENTS, steps: 0 };
        Tracer::new(self.sources, self.index, read, extent).ok()?.trace(pixel).ok()?.value
    }

    /// Weights of texels matter: without filters another value comes out.
    fn is_filtered(&self, pixel: (u32, u32), apart: f64) -> Option<&'static str> {
        let mut read = self.read.clone();
        read.channels.iter_mut().for_each(|texture| texture.filter = Filter::Nearest);
        if self.moves_by(&read, pixel)? >= apart {
            return Some("filtered: it is of texels that differ as much");
        }
        let mut by_quads = self.read.clone();
        by_quads.channels.iter_mut().for_each(|texture| texture.level_by = LevelBy::Quad);
        if self.moves_by(&by_quads, pixel)? >= apart / 2.0 {
            return Some("filtered: the level of a quad, taken by lines, moves it as far");
        }
        // llvmpipe filters textures of 8 bits in numbers of 8 bits, so that each of three steps rounds: what is read may
        // be off by as many steps, each time otherwise (`walker_textures::texels_of_8_bits_are_mixed_in_8_bits`).
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
            if self.moves_by(&moved, pixel)? >= apart / 2.0 {
                return Some("filtered in 8 bits: three steps of them move it as far");
            }
        }
        // Which level is read follows from derivatives, which are undefined where neighbours go other ways (8.8).
        let mut coarser = self.read.clone();
        coarser.channels.iter_mut().filter(|texture| texture.filter == Filter::Mipmap).for_each(read_coarser);
        let is_of_levels = self.moves_by(&coarser, pixel)? >= apart;
        is_of_levels.then_some("filtered: texels of the next level move it as far")
    }

    /// How far the walker's value is from the one of other inputs.
    fn moves_by(&self, read: &PassInputs, pixel: (u32, u32)) -> Option<f64> {
        let (own, other) = (self.value(self.read, pixel)?, self.value(read, pixel)?);
        Some(own.iter().zip(other).map(|(&a, b)| f64::from(a - b).abs()).fold(0.0, f64::max))
    }

    /// The walker's own value moves as far where its roundings come out another way, by chance, or where the time and the
    /// canvas are others by some last bits: a place that lies on the edge of a texel moves by these alone.
    fn is_touchy(&self, pixel: (u32, u32), apart: f64) -> bool {
        let Some(own) = self.value(self.read, pixel) else { return false };
        let is_far = |other: [f32; 4]| {
            own.iter().zip(other).any(|(&a, b)| {
                let distance = f64::from(a - b).abs();
                !is_same(a, b) && (distance >= apart / 4.0 || distance.is_nan())
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

/// Puts the next level's texels in the place of each level's.
fn read_coarser(texture: &mut TextureCopy) {
    for i in 1..texture.levels.len() {
        let [level, next] = [i - 1, i].map(|i| texture.levels[i].clone());
        let beside = |at: u32, size: u32| (at / 2).min(size - 1);
        let at =
            |(x, y): (u32, u32)| next.texels[(beside(y, next.height) * next.width + beside(x, next.width)) as usize];
        texture.levels[i - 1].texels = all_pixels((level.width, level.height)).into_iter().map(at).collect();
    }
}

/// A filtered texture of 8 bits.
fn has_8_bits(texture: &TextureCopy) -> bool {
    let mut texels = texture.levels[0].texels.iter().flatten();
    texture.filter != Filter::Nearest && texels.all(|x| (x * 255.0 - (x * 255.0).round()).abs() < 1e-3)
}
