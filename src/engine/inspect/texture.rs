//! A texture in memory, and how a sampler reads it: sections 3.8.10 and 3.8.11 of the OpenGL ES 3.0 specification, in
//! double precision. A device may weight texels with as few as 8 bits.

use eddy_glsl::walk::Lod;
use eddy_project::{Filter, Wrap};
use eddy_texture::{Dimension, Face};

/// One mip level, face by face or slice by slice. Row 0 of a picture is the bottom.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    pub width: u32,
    pub height: u32,
    /// The slices of a volume, the six faces of a cube, else 1.
    pub depth: u32,
    pub texels: Vec<[f32; 4]>,
}

/// The method that computes the level of a read with implicit level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LevelBy {
    /// The specification uses each pixel's own differences, and the logarithm to base 2.
    #[default]
    Pixel,
    /// llvmpipe uses those of a quad's first row and column (`lp_bld_sample.c`, `lp_build_rho`), and half the logarithm
    /// of the squared length, interpolated linearly between powers of two: up to 0.043 less (`lp_build_lod_selector`).
    Quad,
}

/// A texture, and how a channel reads it.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureCopy {
    pub dimension: Dimension,
    /// At least one; the others if the channel's reads may reach them.
    pub levels: Vec<Level>,
    pub filter: Filter,
    pub wrap: Wrap,
    pub level_by: LevelBy,
}

impl LevelBy {
    /// Returns the level whose texel spacing equals that of the pixels, which is `texels` texels of the finest level.
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
    /// Returns the texture of an empty channel: one opaque black texel.
    pub fn black() -> Self {
        let level = Level { width: 1, height: 1, depth: 1, texels: vec![[0.0, 0.0, 0.0, 1.0]] };
        let (dimension, filter, wrap) = (Dimension::D2, Filter::Nearest, Wrap::Clamp);
        Self { dimension, levels: vec![level], filter, wrap, level_by: LevelBy::Pixel }
    }

    /// Returns a texel; zeros outside the texture.
    pub fn fetch(&self, [x, y, z]: [i32; 3], level: i32) -> [f32; 4] {
        let level = usize::try_from(level).ok().and_then(|level| self.levels.get(level));
        let slice = if self.dimension == Dimension::D3 { z } else { 0 };
        level.and_then(|level| level.at(x, y, slice)).unwrap_or([0.0; 4])
    }

    /// Samples the texture at a coordinate from 0 to 1, or a cube in a direction; `offset` is in texels.
    pub fn sample(&self, at: [f64; 3], lod: Lod, offset: [i32; 3]) -> [f64; 4] {
        let lod = match self.filter {
            Filter::Mipmap => self.lod(at, lod),
            Filter::Nearest | Filter::Linear => 0.0,
        };
        let finer = lod.floor();
        let weight = lod - finer;
        let read = |level: f64| {
            let level = &self.levels[level as usize];
            match self.dimension {
                Dimension::D2 => self.read(level, 0, at, offset),
                Dimension::D3 => self.read_volume(level, at, offset),
                Dimension::Cube => self.read_cube(level, at),
            }
        };
        if weight == 0.0 {
            return read(finer);
        }
        let (near, far) = (read(finer), read(finer + 1.0));
        std::array::from_fn(|i| near[i] + weight * (far[i] - near[i]))
    }

    /// Returns the level between 0 and the last, with a fraction.
    fn lod(&self, at: [f64; 3], lod: Lod) -> f64 {
        let [width, height, depth] = self.levels[0].sides();
        let lod = match lod {
            Lod::Exact(level) => level,
            Lod::Derivatives { x, y, bias } => {
                let length = |d: [f64; 3]| match self.dimension {
                    Dimension::D2 => (d[0] * width).hypot(d[1] * height),
                    Dimension::D3 => (d[0] * width).hypot(d[1] * height).hypot(d[2] * depth),
                    // The derivatives of the coordinates on the face, by the quotient rule.
                    Dimension::Cube => {
                        let face = Face::of(at);
                        let ([s, t, m], [ds, dt, dm]) = (face.components(at), face.components(d));
                        let along = |c: f64, dc: f64| 0.5 * width * (dc * m - c * dm) / (m * m);
                        along(s, ds).hypot(along(t, dt))
                    }
                };
                self.level_by.level(length(x).max(length(y))) + bias
            }
        };
        let last = (self.levels.len() - 1) as f64;
        // For a constant coordinate, and for NaN, the finest.
        if lod > 0.0 { lod.min(last) } else { 0.0 }
    }

    fn read_volume(&self, level: &Level, at: [f64; 3], offset: [i32; 3]) -> [f64; 4] {
        let place = at[2] * f64::from(level.depth) + f64::from(offset[2]);
        let slice = |z: f64| self.read(level, self.wrapped(z, level.depth), at, offset);
        if self.filter == Filter::Nearest {
            return slice(place.floor());
        }
        let near = (place - 0.5).floor();
        let weight = place - 0.5 - near;
        let (a, b) = (slice(near), slice(near + 1.0));
        std::array::from_fn(|i| a[i] + weight * (b[i] - a[i]))
    }

    fn read_cube(&self, level: &Level, at: [f64; 3]) -> [f64; 4] {
        let face = Face::of(at);
        let [s, t, axis] = face.components(at);
        let side = f64::from(level.width);
        let place = [s, t].map(|c| (0.5 * c / axis + 0.5) * side);
        if self.filter == Filter::Nearest {
            let [x, y] = place.map(|c| c.floor().clamp(0.0, side - 1.0) as i32);
            return level.at(x, y, face as i32).unwrap_or([0.0; 4]).map(f64::from);
        }
        let corner = place.map(|x| (x - 0.5).floor());
        let weight: [f64; 2] = std::array::from_fn(|i| place[i] - 0.5 - corner[i]);
        let texels = [[0, 0], [1, 0], [0, 1], [1, 1]]
            .map(|[dx, dy]| level.beyond_faces(face, corner[0] as i32 + dx, corner[1] as i32 + dy));
        // Three faces meet in a corner, where a fourth texel is missing: the mean of the others replaces it.
        let known: Vec<[f64; 4]> = texels.iter().flatten().copied().collect();
        let mean = std::array::from_fn(|i| known.iter().map(|t| t[i]).sum::<f64>() / known.len().max(1) as f64);
        let [a, b, c, d] = texels.map(|t| t.unwrap_or(mean));
        std::array::from_fn(|i| {
            let first = a[i] + weight[0] * (b[i] - a[i]);
            let second = c[i] + weight[0] * (d[i] - c[i]);
            first + weight[1] * (second - first)
        })
    }

    /// Samples a picture, or a slice of a volume.
    fn read(&self, level: &Level, slice: i32, at: [f64; 3], offset: [i32; 3]) -> [f64; 4] {
        let size = [f64::from(level.width), f64::from(level.height)];
        let place: [f64; 2] = std::array::from_fn(|i| at[i] * size[i] + f64::from(offset[i]));
        if self.filter == Filter::Nearest {
            return self.texel(level, slice, place.map(f64::floor));
        }
        let corner = place.map(|x| (x - 0.5).floor());
        let weight: [f64; 2] = std::array::from_fn(|i| place[i] - 0.5 - corner[i]);
        let texel = |dx: f64, dy: f64| self.texel(level, slice, [corner[0] + dx, corner[1] + dy]);
        let [a, b, c, d] = [texel(0.0, 0.0), texel(1.0, 0.0), texel(0.0, 1.0), texel(1.0, 1.0)];
        std::array::from_fn(|i| {
            let bottom = a[i] + weight[0] * (b[i] - a[i]);
            let top = c[i] + weight[0] * (d[i] - c[i]);
            bottom + weight[1] * (top - bottom)
        })
    }

    fn texel(&self, level: &Level, slice: i32, at: [f64; 2]) -> [f64; 4] {
        let texel = level.at(self.wrapped(at[0], level.width), self.wrapped(at[1], level.height), slice);
        texel.unwrap_or([0.0; 4]).map(f64::from)
    }

    fn wrapped(&self, at: f64, size: u32) -> i32 {
        match self.wrap {
            Wrap::Clamp => at.clamp(0.0, f64::from(size - 1)) as i32,
            Wrap::Repeat => at.rem_euclid(f64::from(size)) as i32,
        }
    }
}

impl Level {
    fn at(&self, x: i32, y: i32, slice: i32) -> Option<[f32; 4]> {
        let (x, y, slice) = (u32::try_from(x).ok()?, u32::try_from(y).ok()?, u32::try_from(slice).ok()?);
        let is_inside = x < self.width && y < self.height && slice < self.depth;
        is_inside.then(|| self.texels[((slice * self.height + y) * self.width + x) as usize])
    }

    fn sides(&self) -> [f64; 3] {
        [self.width, self.height, self.depth].map(f64::from)
    }

    /// Returns a texel of a face, or that of its neighbour across the edge; `None` beyond a corner.
    fn beyond_faces(&self, face: Face, x: i32, y: i32) -> Option<[f64; 4]> {
        let side = self.width as i32;
        let is_outside = |c: i32| c < 0 || c >= side;
        let texel = |face: Face, x, y| self.at(x, y, face as i32).map(|texel| texel.map(f64::from));
        match (is_outside(x), is_outside(y)) {
            (false, false) => texel(face, x, y),
            (true, true) => None,
            _ => {
                // Just beyond the edge, at the middle of the texel along it.
                let just = 1.0 + 1e-9;
                let coordinate = |c: i32| (f64::from(2 * c + 1) / f64::from(side) - 1.0).clamp(-just, just);
                let direction = face.direction(coordinate(x), coordinate(y));
                let other = Face::of(direction);
                let [s, t, axis] = other.components(direction);
                let place = |c: f64| (((0.5 * c / axis + 0.5) * f64::from(side)) as i32).clamp(0, side - 1);
                texel(other, place(s), place(t))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns 2 x 2 texels whose red is 0, 1, 2, 3; then one of 10.
    fn texture(filter: Filter, wrap: Wrap) -> TextureCopy {
        let texels = (0..4).map(|i| [i as f32, 0.0, 0.0, 1.0]).collect();
        let coarse = Level { width: 1, height: 1, depth: 1, texels: vec![[10.0, 0.0, 0.0, 1.0]] };
        let levels = vec![Level { width: 2, height: 2, depth: 1, texels }, coarse];
        TextureCopy { dimension: Dimension::D2, levels, filter, wrap, level_by: LevelBy::Pixel }
    }

    fn red(texture: &TextureCopy, at: [f64; 2], lod: f64) -> f64 {
        texture.sample([at[0], at[1], 0.0], Lod::Exact(lod), [0; 3])[0]
    }

    #[test]
    fn texels_are_weighted_by_distance_and_wrapped() {
        let linear = texture(Filter::Linear, Wrap::Clamp);
        assert_eq!([red(&linear, [0.25, 0.25], 0.0), red(&linear, [0.5, 0.5], 5.0)], [0.0, 1.5]);
        assert_eq!([red(&linear, [-3.0, 0.25], 0.0), red(&linear, [0.375, 9.0], 0.0)], [0.0, 2.25]);
        let repeat = texture(Filter::Linear, Wrap::Repeat);
        assert_eq!([red(&repeat, [1.0, 0.25], 0.0), red(&repeat, [-0.25, 1.25], 0.0)], [0.5, 1.0]);
        let nearest = texture(Filter::Nearest, Wrap::Repeat);
        assert_eq!([red(&nearest, [0.49, 0.51], 1.0), red(&nearest, [1.1, -0.1], 0.0)], [2.0, 2.0]);
        assert_eq!(nearest.sample([0.25, 0.25, 0.0], Lod::Exact(0.0), [1, 1, 0])[0], 3.0);
    }

    #[test]
    fn the_larger_derivative_selects_the_level() {
        let mipmap = texture(Filter::Mipmap, Wrap::Clamp);
        let at = |x: f64, bias| {
            let lod = Lod::Derivatives { x: [x, 0.0, 0.0], y: [0.0, x / 4.0, 0.0], bias };
            mipmap.sample([0.25, 0.25, 0.0], lod, [0; 3])[0]
        };
        // One texel per pixel, two, and half a level between.
        assert_eq!(
            [at(0.5, 0.0), at(1.0, 0.0), at(0.5, 0.5), at(0.0, 0.0), at(99.0, 0.0)],
            [0.0, 10.0, 5.0, 0.0, 10.0]
        );
        assert_eq!([red(&mipmap, [0.25, 0.25], 0.25), red(&mipmap, [0.25, 0.25], -1.0)], [2.5, 0.0]);
    }

    #[test]
    fn the_piecewise_linear_level_is_exact_at_powers_of_two() {
        let levels = |by: LevelBy| [1.0, 2.0, 8.0, 0.5, 2.0f64.sqrt()].map(|texels| by.level(texels));
        assert!(levels(LevelBy::Quad).iter().zip(levels(LevelBy::Pixel)).all(|(a, b)| (a - b).abs() < 1e-12));
        let apart = |texels: f64| LevelBy::Pixel.level(texels) - LevelBy::Quad.level(texels);
        let max_error = (0..1000).map(|i| apart(2.0 + f64::from(i) / 100.0)).fold(0.0, f64::max);
        assert!((max_error - 0.043).abs() < 1e-4, "{max_error}");
        // The finest for a constant coordinate.
        let mipmap = TextureCopy { level_by: LevelBy::Quad, ..texture(Filter::Mipmap, Wrap::Clamp) };
        let still = Lod::Derivatives { x: [0.0; 3], y: [0.0; 3], bias: 0.0 };
        assert_eq!(mipmap.sample([0.25, 0.25, 0.0], still, [0; 3])[0], 0.0);
    }

    #[test]
    fn fetches_outside_a_texture_return_zero() {
        let texture = texture(Filter::Nearest, Wrap::Repeat);
        assert_eq!([texture.fetch([1, 1, 0], 0)[0], texture.fetch([0, 0, 0], 1)[0]], [3.0, 10.0]);
        for (at, level) in [([2, 0], 0), ([-1, 0], 0), ([0, 0], 2), ([0, 0], -1), ([1, 0], 1)] {
            let [x, y] = at;
            assert_eq!(texture.fetch([x, y, 0], level), [0.0; 4]);
        }
    }

    /// A cube whose texels contain their own directions: a sample in any direction, across seams and corners too,
    /// returns about that direction.
    #[test]
    fn cubes_are_seamless() {
        let side = 16;
        let center = |n: u32| f64::from(2 * n + 1) / f64::from(side) - 1.0;
        let texels = Face::ALL.iter().flat_map(|face| {
            (0..side * side).map(move |i| {
                let d = face.direction(center(i % side), center(i / side));
                let length = d.iter().map(|c| c * c).sum::<f64>().sqrt();
                [d[0] / length, d[1] / length, d[2] / length, 1.0].map(|c| c as f32)
            })
        });
        let levels = vec![Level { width: side, height: side, depth: 6, texels: texels.collect() }];
        let cube = TextureCopy { dimension: Dimension::Cube, levels, ..texture(Filter::Linear, Wrap::Clamp) };
        for i in 0..2000 {
            let (a, b) = (f64::from(i) * 2.399963, f64::from(2 * i + 1) / 2000.0 - 1.0);
            let d = [(1.0 - b * b).sqrt() * a.cos(), b, (1.0 - b * b).sqrt() * a.sin()];
            let read = cube.sample(d, Lod::Exact(0.0), [0; 3]);
            let worst = (0..3).map(|c| (read[c] - d[c]).abs()).fold(0.0, f64::max);
            assert!(worst < 0.02, "{d:?}: {read:?}");
        }
    }

    #[test]
    fn volumes_are_interpolated_between_slices() {
        let texels = (0..8).map(|i| [i as f32, 0.0, 0.0, 1.0]).collect();
        let levels = vec![Level { width: 2, height: 2, depth: 2, texels }];
        let volume = TextureCopy { dimension: Dimension::D3, levels, ..texture(Filter::Linear, Wrap::Repeat) };
        let at = |at| volume.sample(at, Lod::Exact(0.0), [0; 3])[0];
        assert_eq!([at([0.25, 0.25, 0.75]), at([0.25, 0.25, 0.5]), at([0.25, 0.25, 0.0])], [4.0, 2.0, 2.0]);
        assert_eq!((volume.fetch([1, 1, 1], 0)[0], volume.fetch([0, 0, 2], 0)[0]), (7.0, 0.0));
    }
}
