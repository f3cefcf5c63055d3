//! Organic materials, and products made of them.

use super::field::{Cells, Colour, Fractal, Noise, byte, lit, mix3, ramp, random, rgb, scale, smoothstep, wave};
use crate::Texels;
use eddy_texture::TexelFormat;

/// Boards side by side, with their grain along them.
pub(super) fn wood() -> Texels {
    let (grain, fibre) = (Fractal::new(6, 2, 4, 501), Fractal::new(160, 6, 3, 511));
    let (sway, tone) = (Fractal::new(4, 3, 3, 521), Fractal::new(8, 4, 4, 531));
    lit(1024, 0.006, |u, v| {
        let x = u * 5.0;
        let column = x.floor();
        let number = random((column as i32).rem_euclid(5) as u32, 3, 9);
        let across = x - column;
        // Every board is shifted by a number of its own, so that no two of them match.
        let (gu, gv) = (u + number, v + number);
        let end = (gv - gv.floor()).min(1.0 - (gv - gv.floor())) * 60.0;
        let inside = smoothstep(0.12, 0.4, (across.min(1.0 - across) * 12.0).min(end));
        let fibre = fibre.at(gu, gv);
        let bent = grain.at(gu, gv) * 2.6 + sway.at(gu, gv) * (0.6 + number) + u * 26.0;
        let ring = wave(bent) * 0.65 + wave(bent * 2.7 + 0.3) * 0.35;
        let t = 0.25 + 0.5 * ring + 0.35 * tone.at(gu, gv) + 0.25 * fibre;
        let plank = ramp(t, &[rgb(0x9a673c), rgb(0x8a5530), rgb(0x6f4226), rgb(0x50301d)]);
        let plank = scale(plank, 0.85 + 0.35 * number);
        let height = inside * (0.8 + 0.1 * number) - 0.06 * ring * inside + 0.07 * fibre;
        (height, mix3(rgb(0x1d130d), plank, inside))
    })
}

/// Overlapping blades of grass.
pub(super) fn grass() -> Texels {
    const SIZE: i32 = 1024;
    const BLADES: u32 = 9_000;
    let mut pixels = vec![scale(rgb(0x1d2410), 0.6); (SIZE * SIZE) as usize];
    for blade in 0..BLADES {
        let r = |n: u32| random(blade, n, 541);
        // Later blades are higher and lighter.
        let height = blade as f32 / BLADES as f32;
        let (mut x, mut y) = (r(0) * SIZE as f32, r(1) * SIZE as f32);
        let length = 50.0 + 70.0 * r(2);
        // A direction from the unit square, normalised; and a slow turn.
        let (mut dx, mut dy) = (r(3) - 0.5, r(4) - 0.5);
        let turn = (r(5) - 0.5) * 0.035;
        let tint = ramp(r(6), &[rgb(0x3f5a1c), rgb(0x587a26), rgb(0x7d9438), rgb(0x9c9a4e), rgb(0x4d6b2c)]);
        let width = 2.2 + 2.6 * r(7);
        let mut gone = 0.0;
        while gone < length {
            let norm = (dx * dx + dy * dy).sqrt().max(1e-3);
            (dx, dy) = (dx / norm, dy / norm);
            let t = gone / length;
            let half = width * (1.0 - t * t);
            let shade = (0.3 + 0.75 * height) * (0.55 + 0.6 * t);
            let mut side = -half;
            while side <= half {
                // One half of a blade faces the light.
                let lit = if side * (dx - dy) > 0.0 { 1.12 } else { 0.86 };
                let (px, py) = ((x - dy * side) as i32, (y + dx * side) as i32);
                pixels[(py.rem_euclid(SIZE) * SIZE + px.rem_euclid(SIZE)) as usize] = scale(tint, shade * lit);
                side += 0.5;
            }
            (x, y) = (x + dx * 0.7, y + dy * 0.7);
            (dx, dy) = (dx - dy * turn, dy + dx * turn);
            gone += 0.7;
        }
    }
    opaque(SIZE as u32, &pixels)
}

fn opaque(size: u32, pixels: &[Colour]) -> Texels {
    let bytes = pixels.iter().flat_map(|c| [byte(c[0]), byte(c[1]), byte(c[2]), 255]).collect();
    Texels::flat(size, size, TexelFormat::Rgba8, bytes)
}

/// Cushions of moss.
pub(super) fn moss() -> Texels {
    let (cushion, tuft) = (Fractal::new(7, 7, 4, 551), Cells::new(90, 561));
    let (fine, damp) = (Fractal::new(48, 48, 3, 571), Fractal::new(4, 4, 4, 581));
    lit(1024, 0.03, |u, v| {
        let fine = fine.at(u, v);
        let near = tuft.at(u + 0.01 * fine, v - 0.01 * fine);
        let height = 0.9 * cushion.at(u, v) + 0.16 * (1.0 - near.first) + 0.12 * fine;
        let t = 0.35 + 0.5 * height + 0.35 * (near.random - 0.5) + 0.3 * damp.at(u, v);
        (height, ramp(t, &[rgb(0x20260f), rgb(0x3a4718), rgb(0x5c6b22), rgb(0x87913a), rgb(0xb0ad5e)]))
    })
}

/// The walls of a coral.
pub(super) fn coral() -> Texels {
    let (wide, narrow) = (Cells::new(14, 591), Cells::new(40, 601));
    let (bend_x, bend_y, fine) = (Fractal::new(8, 8, 3, 611), Fractal::new(8, 8, 3, 621), Fractal::new(40, 40, 4, 631));
    lit(1024, 0.022, |u, v| {
        let fine = fine.at(u, v);
        let (u, v) = (u + 0.035 * bend_x.at(u, v), v + 0.035 * bend_y.at(u, v));
        let (big, small) = (wide.at(u, v), narrow.at(u, v));
        let ridge = 1.0 - smoothstep(0.05, 0.4, big.second - big.first);
        let rib = 1.0 - smoothstep(0.0, 0.5, small.second - small.first);
        let height = ridge + 0.3 * rib * (1.0 - 0.5 * ridge) + 0.14 * fine;
        let t = 0.62 * ridge + 0.22 * rib + 0.2 * fine + 0.1 * big.random;
        (height, ramp(t, &[rgb(0x14211f), rgb(0x2c4038), rgb(0x6a5f45), rgb(0xa88a5c), rgb(0xd8c394)]))
    })
}

/// A plain weave.
pub(super) fn fabric() -> Texels {
    const THREADS: f32 = 40.0;
    let (loose_x, loose_y) = (Noise::new(9, 9, 641), Noise::new(9, 9, 651));
    let (fray, wear) = (Fractal::new(120, 120, 2, 661), Fractal::new(4, 4, 4, 671));
    lit(512, 0.008, |u, v| {
        let fray = fray.at(u, v);
        let (x, y) = ((u + 0.003 * loose_x.at(u, v)) * THREADS, (v + 0.003 * loose_y.at(u, v)) * THREADS);
        let (column, row) = (x.floor(), y.floor());
        let (fx, fy) = (x - column - 0.5, y - row - 0.5);
        let is_across = (column as i32 + row as i32).rem_euclid(2) == 0;
        let (along, aside) = if is_across { (fx, fy) } else { (fy, fx) };
        let round = (1.0 - aside * aside * 3.6).max(0.0) * (1.0 - along * along * 1.6);
        let index = (if is_across { row } else { column } as i32).rem_euclid(THREADS as i32);
        let number = random(index as u32, u32::from(is_across), 681);
        let dye = if is_across { rgb(0xa98a63) } else { rgb(0x86643f) };
        let ply = 0.92 + 0.12 * wave((u + v) * 260.0 + aside * 2.0);
        let worn = 1.0 + 0.2 * wear.at(u, v) + 0.12 * fray;
        (round + 0.1 * fray, scale(dye, (0.35 + 0.65 * round) * (0.85 + 0.3 * number) * ply * worn))
    })
}
