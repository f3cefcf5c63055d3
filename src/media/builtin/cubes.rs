//! Environments as cubemaps: a gallery, a hall and a forest, each sharp and blurred as a matt surface would reflect it.
//!
//! Each is a function of the direction as seen from the camera.

use super::noise::hash2;
use crate::{Texels, load::cube::of_directions};
use eddy_texture::{Face, TexelFormat};

/// The texels along a face of the sharp and of the blurred cubemaps.
const SIDES: (u32, u32) = (256, 64);

type Color = [f32; 3];

pub(super) fn gallery() -> Texels {
    sharp(gallery_color)
}

pub(super) fn hall() -> Texels {
    sharp(hall_color)
}

pub(super) fn forest() -> Texels {
    sharp(forest_color)
}

pub(super) fn gallery_blurred() -> Texels {
    blurred(gallery_color)
}

pub(super) fn hall_blurred() -> Texels {
    blurred(hall_color)
}

pub(super) fn forest_blurred() -> Texels {
    blurred(forest_color)
}

fn sharp(color: fn([f32; 3]) -> Color) -> Texels {
    // Two by two directions per texel, for smooth edges.
    let step = 0.5 / SIDES.0 as f32;
    of_directions(SIDES.0, TexelFormat::Rgba8, |[x, y, z], bytes| {
        let sum = [(-step, -step), (step, -step), (-step, step), (step, step)].map(|(a, b)| match () {
            () if x.abs() == 1.0 => color([x, y + a, z + b]),
            () if y.abs() == 1.0 => color([x + a, y, z + b]),
            () => color([x + a, y + b, z]),
        });
        bytes.extend(stored(std::array::from_fn(|i| sum.iter().map(|c| c[i]).sum::<f32>() / 4.0)));
    })
}

/// The irradiance of a matt surface, by direction of its normal: the mean over the hemisphere, weighted with the
/// cosine.
fn blurred(color: fn([f32; 3]) -> Color) -> Texels {
    const COARSE: u32 = 12;
    let lights: Vec<([f32; 3], Color)> = Face::ALL
        .iter()
        .flat_map(|face| (0..COARSE * COARSE).map(move |i| (face, i % COARSE, i / COARSE)))
        .map(|(face, x, y)| {
            let center = |n: u32| f64::from(2 * n + 1) / f64::from(COARSE) - 1.0;
            let [x, y, z] = face.direction(center(x), center(y)).map(|c| c as f32);
            let length = (x * x + y * y + z * z).sqrt();
            // A texel's solid angle is inversely proportional to the third power of its distance.
            let weight = 1.0 / (length * length * length);
            ([x / length * weight, y / length * weight, z / length * weight], color([x, y, z]))
        })
        .collect();
    of_directions(SIDES.1, TexelFormat::Rgba8, |[x, y, z], bytes| {
        let (mut sum, mut weights) = ([0.0f32; 3], 0.0f32);
        for ([a, b, c], light) in &lights {
            let cosine = a * x + b * y + c * z;
            if cosine > 0.0 {
                weights += cosine;
                sum = std::array::from_fn(|i| sum[i] + cosine * light[i]);
            }
        }
        bytes.extend(stored(sum.map(|c| c / weights)));
    })
}

fn stored(color: Color) -> [u8; 4] {
    let [r, g, b] = color.map(|c| (c.clamp(0.0, 1.0) * 255.0 + 0.5) as u8);
    [r, g, b, 255]
}

fn scaled(color: Color, by: f32) -> Color {
    color.map(|c| c * by)
}

fn mixed(a: Color, b: Color, by: f32) -> Color {
    let by = by.clamp(0.0, 1.0);
    std::array::from_fn(|i| a[i] + (b[i] - a[i]) * by)
}

/// Returns the point where the direction leaves a box around the camera, and the axis of the side that it hits.
fn leave_box([x, y, z]: [f32; 3], low: [f32; 3], high: [f32; 3]) -> ([f32; 3], usize) {
    let distance = |d: f32, low: f32, high: f32| match () {
        () if d > 0.0 => high / d,
        () if d < 0.0 => low / d,
        () => f32::INFINITY,
    };
    let t = [distance(x, low[0], high[0]), distance(y, low[1], high[1]), distance(z, low[2], high[2])];
    let axis = (0..3).fold(0, |best, i| if t[i] < t[best] { i } else { best });
    ([x * t[axis], y * t[axis], z * t[axis]], axis)
}

/// Returns the index of a grid cell, and the position in it, in 0 to 1.
fn cell(x: f32) -> (i32, f32) {
    (x.floor() as i32, x - x.floor())
}

/// Returns a random number in 0 to 1 for a cell.
fn random(x: i32, y: i32, seed: u32) -> f32 {
    (hash2(x as u32, y as u32, seed) >> 8) as f32 / (1 << 24) as f32
}

/// Value noise: random numbers at integer coordinates, smoothly interpolated.
fn smooth_noise(x: f32, y: f32, seed: u32) -> f32 {
    periodic_noise(x, y, i32::MAX, seed)
}

/// The same, repeating after `period` in x.
fn periodic_noise(x: f32, y: f32, period: i32, seed: u32) -> f32 {
    let ((column, s), (row, t)) = (cell(x), cell(y));
    let ease = |f: f32| f * f * (3.0 - 2.0 * f);
    let between = |a: f32, b: f32, f: f32| a + (b - a) * ease(f);
    let at = |i: i32, j: i32| random((column + i).rem_euclid(period), row + j, seed);
    between(between(at(0, 0), at(1, 0), s), between(at(0, 1), at(1, 1), s), t)
}

/// A long room with pictures on its walls under a glass roof.
fn gallery_color(direction: [f32; 3]) -> Color {
    let ([x, y, z], axis) = leave_box(direction, [-3.0, -1.5, -7.0], [3.0, 2.5, 7.0]);
    let far = 1.0 / (1.0 + 0.02 * (x * x + z * z));
    match axis {
        1 if y > 0.0 => {
            let (_, bar) = cell(z);
            let is_glass = x.abs() < 2.0 && (0.06..0.94).contains(&bar);
            if is_glass { [1.0, 1.0, 0.98] } else { [0.5, 0.48, 0.44] }
        }
        1 => {
            let ((column, s), (row, t)) = (cell(x), cell(z));
            let tile = if (column + row) % 2 == 0 { [0.62, 0.5, 0.38] } else { [0.3, 0.22, 0.17] };
            let is_joint = s < 0.02 || t < 0.02;
            // The reflection of the roof in the polished floor.
            let shine = if x.abs() < 1.4 { 0.16 } else { 0.0 };
            let color = scaled(tile, if is_joint { 0.5 } else { 0.7 + 0.3 * random(column, row, 11) });
            scaled(mixed(color, [1.0; 3], shine), 0.6 + 0.4 * far)
        }
        _ => {
            let (along, seed) = if axis == 0 { (z, 21) } else { (x, 22) };
            let ((n, s), light) = (cell(along / 2.0), 0.5 + 0.2 * y);
            let is_frame = (0.14..0.86).contains(&s) && (-0.55..1.25).contains(&y);
            let is_canvas = (0.19..0.81).contains(&s) && (-0.45..1.15).contains(&y);
            let painting = || {
                let tint: Color = std::array::from_fn(|i| 0.25 + 0.6 * random(n, i as i32, seed));
                scaled(tint, 0.4 + 0.9 * smooth_noise(9.0 * s, 4.0 * y, seed.wrapping_add(n as u32)))
            };
            let wall = match () {
                () if y < -1.2 => [0.3, 0.2, 0.14],
                () if is_canvas => painting(),
                () if is_frame => [0.75, 0.6, 0.25],
                () => [0.52, 0.2, 0.18],
            };
            scaled(wall, light.clamp(0.3, 1.0))
        }
    }
}

/// A high hall of stone: arches on both sides, a window at the end, a lit dome above.
fn hall_color(direction: [f32; 3]) -> Color {
    let ([x, y, z], axis) = leave_box(direction, [-4.0, -1.6, -9.0], [4.0, 6.0, 9.0]);
    let stone = [0.72, 0.66, 0.56];
    match axis {
        1 if y > 0.0 => {
            let radius = (x * x + z * z).sqrt();
            let (_, rib) = cell(radius * 1.5);
            let light = if radius < 1.0 { 1.3 } else { 0.75 - 0.04 * radius };
            scaled(stone, if rib < 0.1 { 0.7 * light } else { light })
        }
        1 => {
            let ((column, s), (row, t)) = (cell((x + z) / 1.5), cell((x - z) / 1.5));
            let tile = if (column ^ row) & 1 == 0 { [0.7, 0.66, 0.6] } else { [0.28, 0.2, 0.2] };
            scaled(tile, if s < 0.03 || t < 0.03 { 0.4 } else { 0.75 })
        }
        0 => {
            let (n, s) = cell(z / 3.0);
            let across = 2.0 * s - 1.0;
            // An opening with a half circle above it.
            let above = (y - 1.5).max(0.0) / 1.5;
            let is_opening = across * across / 0.49 + above * above < 1.0 && y < 3.1;
            let dark = 0.16 + 0.1 * random(n, 0, 31);
            if is_opening { scaled(stone, dark) } else { scaled(stone, 0.5 + 0.05 * y) }
        }
        _ => {
            let above = (y - 2.5).max(0.0) / 1.6;
            let is_window = x * x / 1.8 + above * above < 1.0 && y > -0.2 && y < 4.2;
            let (((column, s), (row, t)), end) = ((cell(2.0 * x), cell(2.0 * y)), z > 0.0);
            let is_lead = s < 0.08 || t < 0.08;
            let glass: Color = std::array::from_fn(|i| 0.45 + 0.55 * random(column, row, 41 + i as u32));
            match () {
                () if is_window && end => [1.2, 1.15, 1.0],
                () if is_window && !is_lead => glass,
                () if is_window => [0.08; 3],
                () => scaled(stone, 0.45 + 0.04 * y),
            }
        }
    }
}

/// Trunks around a clearing, ground in front of them, sky between leaves above.
fn forest_color([x, y, z]: [f32; 3]) -> Color {
    let flat = (x * x + z * z).sqrt();
    let up = y / (flat + y.abs());
    // The position along the horizon, in 0 to 8, on the edge of a diamond instead of a circle: this needs no arc
    // tangent.
    let diamond = x.abs() + z.abs();
    let around = if diamond == 0.0 {
        0.0
    } else {
        let quarter = z / diamond;
        if x >= 0.0 { 2.0 + 2.0 * quarter } else { 6.0 - 2.0 * quarter }
    };
    if up < -0.06 {
        let (s, t) = (6.0 * x / -y, 6.0 * z / -y);
        let grass = smooth_noise(s, t, 51) * 0.6 + smooth_noise(4.0 * s, 4.0 * t, 52) * 0.4;
        return scaled(mixed([0.2, 0.16, 0.08], [0.3, 0.4, 0.12], grass), 0.8 + 0.4 * grass);
    }
    // A circuit around the horizon is eight times the scale.
    let leaves = |scale: f32, seed: u32| {
        let octave = |by: f32, seed: u32| {
            let scale = by * scale;
            periodic_noise(around * scale, up * scale * 3.0, (8.0 * scale) as i32, seed)
        };
        0.6 * octave(1.0, seed) + 0.4 * octave(3.0, seed + 1)
    };
    let sky = mixed([0.85, 0.9, 0.95], [0.4, 0.6, 0.9], up);
    let mut color = mixed(sky, [0.16, 0.24, 0.1], 3.0 * (0.75 - up - 0.5 * leaves(6.0, 61)));
    // Far trunks first, near ones on top.
    for (layer, (count, width, dark)) in [(6.0, 0.16, 0.55), (3.0, 0.2, 0.4), (1.5, 0.17, 0.28)].into_iter().enumerate()
    {
        let (n, s) = cell(around * count);
        let seed = 71 + layer as u32;
        let center = 0.25 + 0.5 * random(n, 0, seed);
        let bark = smooth_noise(40.0 * (s - center), 30.0 * up + n as f32, seed);
        if (s - center).abs() < width * (1.0 - 0.4 * up) && random(n, 1, seed) < 0.7 {
            color = scaled([0.46, 0.36, 0.26], dark * (0.6 + 0.8 * bark));
        }
    }
    let crown = leaves(3.0, 81);
    if up + 0.35 * crown > 0.72 && up < 0.93 && crown > 0.42 {
        color = scaled([0.3, 0.46, 0.14], 0.5 + crown);
    }
    color
}
