//! Functions over the unit square from which materials are made. All of them are periodic, and exact on every machine.

use super::noise::hash2;
use crate::Texels;
use eddy_texture::TexelFormat;

pub(super) type Colour = [f32; 3];

/// Gradient noise after Perlin ("Improving Noise", SIGGRAPH 2002) on a periodic lattice of `columns` x `rows`.
pub(super) struct Noise {
    columns: u32,
    rows: u32,
    gradients: Vec<[f32; 2]>,
}

impl Noise {
    pub(super) fn new(columns: u32, rows: u32, seed: u32) -> Noise {
        let gradients = (0..rows * columns)
            .map(|i| {
                let bits = hash2(i % columns, i / columns, seed);
                let x = (bits & 0xffff) as f32 / 32767.5 - 1.0;
                let y = (bits >> 16) as f32 / 32767.5 - 1.0;
                let length = (x * x + y * y).sqrt().max(1e-3);
                [x / length, y / length]
            })
            .collect();
        Noise { columns, rows, gradients }
    }

    /// Returns a value in about -1..1.
    pub(super) fn at(&self, u: f32, v: f32) -> f32 {
        let (x, y) = (u * self.columns as f32, v * self.rows as f32);
        let (x0, y0) = (floor(x), floor(y));
        let (fx, fy) = (x - x0 as f32, y - y0 as f32);
        let (x0, y0) = (wrapped(x0, self.columns), wrapped(y0, self.rows));
        let next = |i: u32, count: u32| if i + 1 == count { 0 } else { i + 1 };
        let (x1, y1) = (next(x0, self.columns), next(y0, self.rows));
        let dot = |cx: u32, cy: u32, dx: f32, dy: f32| {
            let [gx, gy] = self.gradients[(cy * self.columns + cx) as usize];
            gx * dx + gy * dy
        };
        let fade_x = fx * fx * fx * (fx * (fx * 6.0 - 15.0) + 10.0);
        let fade_y = fy * fy * fy * (fy * (fy * 6.0 - 15.0) + 10.0);
        let low = mix(dot(x0, y0, fx, fy), dot(x1, y0, fx - 1.0, fy), fade_x);
        let high = mix(dot(x0, y1, fx, fy - 1.0), dot(x1, y1, fx - 1.0, fy - 1.0), fade_x);
        mix(low, high, fade_y) * 1.41
    }
}

/// `f32::floor` calls the C library in builds without SSE4.1, which would cost more than the rest of the noise.
#[inline(always)]
fn floor(x: f32) -> i32 {
    let whole = x as i32;
    whole - i32::from(whole as f32 > x)
}

#[inline(always)]
fn wrapped(cell: i32, count: u32) -> u32 {
    // Places are in the unit square or slightly outside; the division covers the rest.
    let count = count as i32;
    (if cell < 0 || cell >= count { cell.rem_euclid(count) } else { cell }) as u32
}

/// Octaves of noise, each twice as fine and half as strong as the previous one.
pub(super) struct Fractal(Vec<Noise>);

impl Fractal {
    pub(super) fn new(columns: u32, rows: u32, octaves: u32, seed: u32) -> Fractal {
        Fractal((0..octaves).map(|i| Noise::new(columns << i, rows << i, seed + i)).collect())
    }

    /// Returns a value in about -1..1.
    pub(super) fn at(&self, u: f32, v: f32) -> f32 {
        let mut weight = 0.5;
        let mut sum = 0.0;
        for octave in &self.0 {
            sum += octave.at(u, v) * weight;
            weight *= 0.5;
        }
        sum * 1.2
    }

    /// Returns sharp crests: 1 on a crest, towards 0 between them (Musgrave's ridges).
    pub(super) fn ridged(&self, u: f32, v: f32) -> f32 {
        let mut weight = 0.5;
        let mut sum = 0.0;
        for octave in &self.0 {
            let crest = 1.0 - octave.at(u, v).abs().min(1.0);
            sum += crest * crest * weight;
            weight *= 0.5;
        }
        sum
    }
}

/// One point in every cell of a periodic grid (Worley, "A Cellular Texture Basis Function", SIGGRAPH 1996).
pub(super) struct Cells {
    count: u32,
    points: Vec<[f32; 2]>,
    seed: u32,
}

/// The points nearest to a place. Distances are in cells.
pub(super) struct Nearest {
    pub first: f32,
    pub second: f32,
    /// A number per point, evenly distributed over 0..1.
    pub random: f32,
}

impl Cells {
    pub(super) fn new(count: u32, seed: u32) -> Cells {
        let points = (0..count * count)
            .map(|i| {
                let bits = hash2(i % count, i / count, seed);
                [(bits & 0xffff) as f32 / 65536.0, (bits >> 16) as f32 / 65536.0]
            })
            .collect();
        Cells { count, points, seed }
    }

    pub(super) fn at(&self, u: f32, v: f32) -> Nearest {
        let (x, y) = (u * self.count as f32, v * self.count as f32);
        let (x0, y0) = (floor(x), floor(y));
        let (fx, fy) = (x - x0 as f32, y - y0 as f32);
        let (mut first, mut second, mut which) = (9.0f32, 9.0f32, 0);
        for dy in -1..=1 {
            for dx in -1..=1 {
                let column = wrapped(x0 + dx, self.count);
                let index = wrapped(y0 + dy, self.count) * self.count + column;
                let [px, py] = self.points[index as usize];
                let (px, py) = (dx as f32 + px - fx, dy as f32 + py - fy);
                let square = px * px + py * py;
                if square < first {
                    (second, first, which) = (first, square, index);
                } else if square < second {
                    second = square;
                }
            }
        }
        Nearest { first: first.sqrt(), second: second.sqrt(), random: random(which, 7, self.seed) }
    }
}

/// Returns a random number from 0 up to 1 for a place.
pub(super) fn random(x: u32, y: u32, seed: u32) -> f32 {
    (hash2(x, y, seed) >> 8) as f32 / 16_777_216.0
}

#[inline(always)]
pub(super) fn mix(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

pub(super) fn mix3(a: Colour, b: Colour, t: f32) -> Colour {
    [mix(a[0], b[0], t), mix(a[1], b[1], t), mix(a[2], b[2], t)]
}

pub(super) fn scale(a: Colour, by: f32) -> Colour {
    a.map(|c| c * by)
}

pub(super) fn smoothstep(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Returns a wave of period 1 between 0 and 1, as smooth as a sine but made without one.
pub(super) fn wave(x: f32) -> f32 {
    let t = (x - x.floor()) * 2.0;
    let t = if t > 1.0 { 2.0 - t } else { t };
    t * t * (3.0 - 2.0 * t)
}

/// Interpolates between evenly spaced colours.
pub(super) fn ramp(t: f32, colours: &[Colour]) -> Colour {
    let last = colours.len() - 1;
    let x = t.clamp(0.0, 1.0) * last as f32;
    let i = (x as usize).min(last - 1);
    mix3(colours[i], colours[i + 1], x - i as f32)
}

/// Returns a colour from hexadecimal digits as in a style sheet.
pub(super) const fn rgb(hex: u32) -> Colour {
    [(hex >> 16) as f32 / 255.0, (hex >> 8 & 255) as f32 / 255.0, (hex & 255) as f32 / 255.0]
}

pub(super) fn byte(value: f32) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

/// Renders an opaque picture of a surface, lit from the top left. `surface` returns height and colour of a place;
/// `depth` is the size of a height of 1, in parts of the picture's width.
pub(super) fn lit(size: usize, depth: f32, surface: impl Fn(f32, f32) -> (f32, Colour) + Sync) -> Texels {
    let mut surfaces = vec![(0.0, [0.0; 3]); size * size];
    rows(&mut surfaces, size, |y, row| {
        for (x, out) in row.iter_mut().enumerate() {
            *out = surface(place(x, size), place(y, size));
        }
    });
    let height = |x: usize, y: usize| surfaces[(y % size) * size + x % size].0;
    let steep = depth * size as f32 / 2.0;
    let mut bytes = vec![0u8; size * size * 4];
    rows(&mut bytes, size * 4, |y, row| {
        for (x, out) in row.chunks_exact_mut(4).enumerate() {
            let dx = (height(x + 1, y) - height(x + size - 1, y)) * steep;
            let dy = (height(x, y + 1) - height(x, y + size - 1)) * steep;
            // Lambert's law with the light 50 degrees up; level ground keeps its colour.
            let light = (0.77 - 0.45 * dx - 0.45 * dy) / (1.0 + dx * dx + dy * dy).sqrt() / 0.77;
            let colour = scale(surfaces[y * size + x].1, 0.25 + 0.75 * light.clamp(0.0, 1.9));
            out.copy_from_slice(&[byte(colour[0]), byte(colour[1]), byte(colour[2]), 255]);
        }
    });
    Texels::flat(size as u32, size as u32, TexelFormat::Rgba8, bytes)
}

/// Returns the centre of texel `x` of `size`.
fn place(x: usize, size: usize) -> f32 {
    (x as f32 + 0.5) / size as f32
}

/// Fills rows of `width` items on all CPU cores. Rows are independent, so the result does not depend on the number of
/// cores.
fn rows<T: Send>(items: &mut [T], width: usize, fill: impl Fn(usize, &mut [T]) + Sync) {
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let share = (items.len() / width).div_ceil(workers).max(1);
    std::thread::scope(|scope| {
        for (i, part) in items.chunks_mut(share * width).enumerate() {
            let fill = &fill;
            scope.spawn(move || part.chunks_exact_mut(width).enumerate().for_each(|(y, row)| fill(i * share + y, row)));
        }
    });
}
