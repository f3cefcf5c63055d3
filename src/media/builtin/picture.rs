//! Pictures with a top and a bottom, which are not periodic.

use super::{
    field::{Colour, Fractal, lit, mix, mix3, ramp, rgb, scale, smoothstep, wave},
    noise::hash2,
};
use crate::Texels;
use eddy_texture::TexelFormat;

/// Red increases to the right and green upwards, so that the colour encodes the position; blue is one half.
pub(super) fn gradient() -> Texels {
    let size = 256u32;
    let bytes = (0..size * size).flat_map(|i| [(i % size) as u8, (255 - i / size) as u8, 128, 255]).collect();
    Texels::flat(size, size, TexelFormat::Rgba8, bytes)
}

/// A figure in six steps of a walk, 40 texels apart, on a transparent background.
pub(super) fn sprites() -> Texels {
    const WIDTH: i32 = 256;
    const HEIGHT: i32 = 32;
    let mut bytes = vec![0u8; (WIDTH * HEIGHT * 4) as usize];
    for frame in 0..6 {
        // It rises in the middle of a stride, and its feet alternate.
        let rise = [0, 1, 2, 2, 1, 0][frame as usize];
        let step = [-4, -2, 0, 2, 4, 0][frame as usize];
        for y in 0..HEIGHT {
            for x in 0..40 {
                let (dx, dy) = (x - 20, y - 15 + rise);
                let is_in = |cx: i32, cy: i32, rx: i32, ry: i32| {
                    let (a, b) = (dx - cx, dy - cy);
                    a * a * ry * ry + b * b * rx * rx < rx * rx * ry * ry
                };
                let foot = |cx: i32, lift: i32| {
                    let (a, b) = (x - 20 - cx, y - 28 + lift);
                    a * a + 2 * b * b <= 12
                };
                let colour: Option<[u8; 3]> = if is_in(5, -4, 3, 4) || is_in(10, -4, 3, 4) {
                    Some(if is_in(6, -4, 2, 2) || is_in(11, -4, 2, 2) { [25, 25, 40] } else { [250, 250, 250] })
                } else if dy == 3 && (5..=10).contains(&dx) {
                    Some([120, 40, 50])
                } else if is_in(0, 0, 14, 12) {
                    let is_rim = !is_in(0, 0, 13, 11);
                    let is_lit = is_in(-2, -3, 11, 8);
                    Some(if is_rim {
                        [40, 70, 95]
                    } else if is_lit {
                        [96, 196, 208]
                    } else {
                        [64, 150, 178]
                    })
                } else if foot(step, (4 - step.abs()) / 2) || foot(-step, 0) {
                    Some([40, 70, 95])
                } else {
                    None
                };
                if let Some([r, g, b]) = colour {
                    let at = ((y * WIDTH + frame * 40 + x) * 4) as usize;
                    bytes[at..at + 4].copy_from_slice(&[r, g, b, 255]);
                }
            }
        }
    }
    Texels::flat(WIDTH as u32, HEIGHT as u32, TexelFormat::Rgba8, bytes)
}

/// A street at dusk, seen along its length.
pub(super) fn street() -> Texels {
    let (cloud, rough) = (Fractal::new(3, 6, 5, 691), Fractal::new(32, 32, 4, 701));
    // Four samples per texel: edges that run to the vanishing point would show aliasing.
    let shift = 0.25 / 512.0;
    lit(512, 0.0, |u, v| {
        let (cloud, rough) = (cloud.at(u, v * 1.4), rough.at(u, v));
        let samples = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)];
        let colours = samples.map(|(x, y)| street_at(u + x * shift, v + y * shift, cloud, rough));
        (0.0, [0, 1, 2].map(|i| colours.iter().map(|c| c[i]).sum::<f32>() / 4.0))
    })
}

fn street_at(u: f32, v: f32, cloud: f32, rough: f32) -> Colour {
    let (vanish_u, horizon) = (0.52f32, 0.6f32);
    let sky = ramp(v / horizon, &[rgb(0x3b4a6b), rgb(0x6f7797), rgb(0xc59a8c), rgb(0xf2c48d)]);
    let sky = mix3(sky, rgb(0xf6dcc0), 0.5 * smoothstep(0.0, 0.5, cloud));
    let side = u - vanish_u;
    let is_right = side > 0.0;
    let grain = 1.0 + 0.25 * rough;
    // The depth of a house front at the street's edge is inversely proportional to its distance from the vanishing
    // point.
    let depth = 0.06 / side.abs().max(0.008);
    let near = 0.9 / depth;
    let hazy = |c: Colour| mix3(c, rgb(0xd9b193), smoothstep(0.5, 6.0, depth));
    // Along the fronts, in windows; four or five of them form a house.
    let along = depth * 22.0 + if is_right { 1.4 } else { 0.0 };
    let house = (along / 5.0).floor();
    let number = hash2(house as u32, u32::from(is_right), 711);
    let tall = 0.05 + 0.028 * (number & 3) as f32;
    let (top, kerb) = (horizon - tall * near, horizon + 0.012 * near);
    if v < top {
        return sky;
    }
    if v < kerb {
        let storey = (kerb - v) / near / 0.0155;
        let (fy, fx) = (storey - storey.floor(), along - along.floor());
        let paint = [rgb(0x6b4638), rgb(0x8a7564), rgb(0x5b5a63), rgb(0x9a7a5b), rgb(0x74594b)];
        let wall = scale(paint[(number >> 8) as usize % paint.len()], if is_right { 0.95 } else { 0.68 } * grain);
        let below_roof = (v - top) / near;
        let front = if below_roof < 0.003 {
            scale(wall, 0.55)
        } else if storey > 0.9 && fy > 0.2 && fy < 0.75 && fx > 0.22 && fx < 0.78 && below_roof > 0.006 {
            let is_frame = fx > 0.48 && fx < 0.52 || fy < 0.24;
            let is_lit = hash2(storey as u32, along as u32, number) & 3 == 0;
            match (is_frame, is_lit) {
                (true, _) => scale(wall, 1.35),
                (_, true) => mix3(rgb(0xffd98a), rgb(0xf0a850), fy),
                _ => mix3(rgb(0x2b3140), rgb(0x5c6480), fy),
            }
        } else if fy < 0.06 && storey > 0.9 {
            scale(wall, 1.2)
        } else {
            wall
        };
        return hazy(front);
    }
    let down = ((v - horizon) / (1.0 - horizon)).max(0.005);
    let across = (side / down).abs();
    let ground = if across > 0.62 { rgb(0x857a70) } else { rgb(0x44444a) };
    let is_dash = wave(0.6 / down) > 0.5 && across < 0.014;
    let ground = if is_dash { rgb(0xd8cfb6) } else { scale(ground, grain) };
    let kerb_line = 1.0 - smoothstep(0.0, 0.02, (across - 0.62).abs());
    let ground = mix3(scale(ground, mix(1.1, 0.8, down)), rgb(0xb9ada0), 0.6 * kerb_line);
    mix3(ground, rgb(0xd9b193), 0.8 * (1.0 - smoothstep(0.0, 0.25, down)))
}
