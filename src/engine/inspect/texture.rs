//! A texture in memory, and how a sampler reads it: sections 3.8.10 and 3.8.11 of the OpenGL ES 3.0 specification, in
//! double precision. A device may weigh texels with as few as 8 bits.

use eddy_glsl::walk::Lod;
use eddy_project::{Filter, Wrap};

/// One mip level. Row 0 is the bottom.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    pub width: u32,
    pub height: u32,
    pub texels: Vec<[f32; 4]>,
}

/// Says what the level of a read follows from, where the read says none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LevelBy {
    /// The specification has each pixel's own differences, and the logarithm to base 2.
    #[default]
    Pixel,
    /// llvmpipe has those of a quad's first row and column (`lp_bld_sample.c`, `lp_build_rho`), and half the logarithm
    /// of the squared length, which between two powers of two is taken for a line: up to 0.043 less
    /// (`lp_build_lod_selector`).
    Quad,
}

/// A two-dimensional texture, and how a channel reads it.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureCopy {
    /// One at least; the others if the channel's reads may reach them.
    pub levels: Vec<Level>,
    pub filter: Filter,
    pub wrap: Wrap,
    pub level_by: LevelBy,
}

impl LevelBy {
    /// The level at which texels are as far apart as pixels, which are so many texels of the finest level apart.
    fn level(self, texels: f64) -> f64 {
        let square = texels * texels;
        match self {
            LevelBy::Pixel => texels.log2(),
            LevelBy::Quad => {
                let whole = square.log2().floor();
                0.5 * (whole + square / whole.exp2() - 1.0)
            }
        }
    }
}

impl TextureCopy {
    /// Returns what a channel with nothing in it reads: one opaque black texel.
    pub fn black() -> Self {
        let level = Level { width: 1, height: 1, texels: vec![[0.0, 0.0, 0.0, 1.0]] };
        Self { levels: vec![level], filter: Filter::Nearest, wrap: Wrap::Clamp, level_by: LevelBy::Pixel }
    }

    /// A texel; zeros outside of the texture.
    pub fn fetch(&self, [x, y]: [i32; 2], level: i32) -> [f32; 4] {
        let level = usize::try_from(level).ok().and_then(|level| self.levels.get(level));
        level.and_then(|level| level.at(x, y)).unwrap_or([0.0; 4])
    }

    /// A filtered read at a coordinate from 0 to 1 across the texture; `offset` is in texels.
    pub fn sample(&self, at: [f64; 2], lod: Lod, offset: [i32; 2]) -> [f64; 4] {
        let lod = match self.filter {
            Filter::Mipmap => self.lod(lod),
            Filter::Nearest | Filter::Linear => 0.0,
        };
        let finer = lod.floor();
        let weight = lod - finer;
        let read = |level: f64| self.read(&self.levels[level as usize], at, offset);
        if weight == 0.0 {
            return read(finer);
        }
        let (near, far) = (read(finer), read(finer + 1.0));
        std::array::from_fn(|i| near[i] + weight * (far[i] - near[i]))
    }

    /// The level between 0 and the last, with a fraction.
    fn lod(&self, lod: Lod) -> f64 {
        let (width, height) = (f64::from(self.levels[0].width), f64::from(self.levels[0].height));
        let lod = match lod {
            Lod::Exact(level) => level,
            Lod::Derivatives { x, y, bias } => {
                let length = |d: [f64; 3]| (d[0] * width).hypot(d[1] * height);
                self.level_by.level(length(x).max(length(y))) + bias
            }
        };
        let last = (self.levels.len() - 1) as f64;
        // Of a coordinate that does not change, and of NaN, the finest.
        if lod > 0.0 { lod.min(last) } else { 0.0 }
    }

    fn read(&self, level: &Level, at: [f64; 2], offset: [i32; 2]) -> [f64; 4] {
        let size = [f64::from(level.width), f64::from(level.height)];
        let place: [f64; 2] = std::array::from_fn(|i| at[i] * size[i] + f64::from(offset[i]));
        if self.filter == Filter::Nearest {
            return self.texel(level, place.map(f64::floor));
        }
        let corner = place.map(|x| (x - 0.5).floor());
        let weight: [f64; 2] = std::array::from_fn(|i| place[i] - 0.5 - corner[i]);
        let texel = |dx: f64, dy: f64| self.texel(level, [corner[0] + dx, corner[1] + dy]);
        let [a, b, c, d] = [texel(0.0, 0.0), texel(1.0, 0.0), texel(0.0, 1.0), texel(1.0, 1.0)];
        std::array::from_fn(|i| {
            let bottom = a[i] + weight[0] * (b[i] - a[i]);
            let top = c[i] + weight[0] * (d[i] - c[i]);
            bottom + weight[1] * (top - bottom)
        })
    }

    fn texel(&self, level: &Level, at: [f64; 2]) -> [f64; 4] {
        let wrapped = |at: f64, size: u32| match self.wrap {
            Wrap::Clamp => at.clamp(0.0, f64::from(size - 1)) as i32,
            Wrap::Repeat => at.rem_euclid(f64::from(size)) as i32,
        };
        let texel = level.at(wrapped(at[0], level.width), wrapped(at[1], level.height));
        texel.unwrap_or([0.0; 4]).map(f64::from)
    }
}

impl Level {
    fn at(&self, x: i32, y: i32) -> Option<[f32; 4]> {
        let (x, y) = (u32::try_from(x).ok()?, u32::try_from(y).ok()?);
        let is_inside = x < self.width && y < self.height;
        is_inside.then(|| self.texels[(y * self.width + x) as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2 x 2 texels whose red is 0, 1, 2, 3; then one of 10.
    fn texture(filter: Filter, wrap: Wrap) -> TextureCopy {
        let texels = (0..4).map(|i| [i as f32, 0.0, 0.0, 1.0]).collect();
        let coarse = Level { width: 1, height: 1, texels: vec![[10.0, 0.0, 0.0, 1.0]] };
        let levels = vec![Level { width: 2, height: 2, texels }, coarse];
        TextureCopy { levels, filter, wrap, level_by: LevelBy::Pixel }
    }

    fn red(texture: &TextureCopy, at: [f64; 2], lod: f64) -> f64 {
        texture.sample(at, Lod::Exact(lod), [0, 0])[0]
    }

    #[test]
    fn texels_are_weighed_by_distance_and_wrapped() {
        let linear = texture(Filter::Linear, Wrap::Clamp);
        assert_eq!([red(&linear, [0.25, 0.25], 0.0), red(&linear, [0.5, 0.5], 5.0)], [0.0, 1.5]);
        assert_eq!([red(&linear, [-3.0, 0.25], 0.0), red(&linear, [0.375, 9.0], 0.0)], [0.0, 2.25]);
        let repeat = texture(Filter::Linear, Wrap::Repeat);
        assert_eq!([red(&repeat, [1.0, 0.25], 0.0), red(&repeat, [-0.25, 1.25], 0.0)], [0.5, 1.0]);
        let nearest = texture(Filter::Nearest, Wrap::Repeat);
        assert_eq!([red(&nearest, [0.49, 0.51], 1.0), red(&nearest, [1.1, -0.1], 0.0)], [2.0, 2.0]);
        assert_eq!(nearest.sample([0.25, 0.25], Lod::Exact(0.0), [1, 1])[0], 3.0);
    }

    #[test]
    fn a_level_is_chosen_by_the_larger_derivative() {
        let mipmap = texture(Filter::Mipmap, Wrap::Clamp);
        let at = |x: f64, bias| {
            let lod = Lod::Derivatives { x: [x, 0.0, 0.0], y: [0.0, x / 4.0, 0.0], bias };
            mipmap.sample([0.25, 0.25], lod, [0, 0])[0]
        };
        // One texel a pixel, two, and half a level between.
        assert_eq!(
            [at(0.5, 0.0), at(1.0, 0.0), at(0.5, 0.5), at(0.0, 0.0), at(99.0, 0.0)],
            [0.0, 10.0, 5.0, 0.0, 10.0]
        );
        assert_eq!([red(&mipmap, [0.25, 0.25], 0.25), red(&mipmap, [0.25, 0.25], -1.0)], [2.5, 0.0]);
    }

    #[test]
    fn a_level_by_lines_is_exact_at_powers_of_two_of_the_square() {
        let levels = |by: LevelBy| [1.0, 2.0, 8.0, 0.5, 2.0f64.sqrt()].map(|texels| by.level(texels));
        assert!(levels(LevelBy::Quad).iter().zip(levels(LevelBy::Pixel)).all(|(a, b)| (a - b).abs() < 1e-12));
        let apart = |texels: f64| LevelBy::Pixel.level(texels) - LevelBy::Quad.level(texels);
        let most = (0..1000).map(|i| apart(2.0 + f64::from(i) / 100.0)).fold(0.0, f64::max);
        assert!((most - 0.043).abs() < 1e-4, "{most}");
        // Of a coordinate that does not change, the finest.
        let mipmap = TextureCopy { level_by: LevelBy::Quad, ..texture(Filter::Mipmap, Wrap::Clamp) };
        let still = Lod::Derivatives { x: [0.0; 3], y: [0.0; 3], bias: 0.0 };
        assert_eq!(mipmap.sample([0.25, 0.25], still, [0, 0])[0], 0.0);
    }

    #[test]
    fn outside_of_a_texture_a_fetch_is_zero() {
        let texture = texture(Filter::Nearest, Wrap::Repeat);
        assert_eq!([texture.fetch([1, 1], 0)[0], texture.fetch([0, 0], 1)[0]], [3.0, 10.0]);
        for (at, level) in [([2, 0], 0), ([-1, 0], 0), ([0, 0], 2), ([0, 0], -1), ([1, 0], 1)] {
            assert_eq!(texture.fetch(at, level), [0.0; 4]);
        }
    }
}
