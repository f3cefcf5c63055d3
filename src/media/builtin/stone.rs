//! Materials of stone, earth and metal.

use super::field::{Cells, Fractal, Noise, byte, lit, mix, mix3, ramp, random, rgb, scale, smoothstep};
use crate::Texels;
use eddy_texture::TexelFormat;

/// Veins through folded stone.
pub(super) fn marble() -> Texels {
    let (fold_x, fold_y) = (Fractal::new(3, 3, 4, 11), Fractal::new(3, 3, 4, 31));
    let (body, vein) = (Fractal::new(4, 4, 6, 51), Fractal::new(3, 3, 5, 71));
    lit(1024, 0.012, |u, v| {
        let (u, v) = (u + 0.12 * fold_x.at(u, v), v + 0.12 * fold_y.at(u, v));
        let height = body.at(u, v);
        let base = ramp(
            0.5 + 0.85 * height,
            &[rgb(0x2b2430), rgb(0x5a4a4c), rgb(0x9a7a5e), rgb(0xc9a987), rgb(0xe6d7bd), rgb(0xb98f6d)],
        );
        let line = 1.0 - smoothstep(0.0, 0.07, vein.at(u, v).abs());
        (height, mix3(base, rgb(0xf2e8d8), 0.55 * line))
    })
}

/// A wall of bricks in running bond.
pub(super) fn brick() -> Texels {
    let (edge_x, edge_y) = (Fractal::new(16, 16, 3, 101), Fractal::new(16, 16, 3, 111));
    let (rough, stain) = (Fractal::new(24, 24, 4, 121), Fractal::new(4, 4, 4, 131));
    lit(512, 0.014, |u, v| {
        let (x, y) = (u + 0.004 * edge_x.at(u, v), v + 0.004 * edge_y.at(u, v));
        let y = y * 8.0;
        let row = y.floor();
        let x = x * 4.0 + if (row as i32).rem_euclid(2) == 1 { 0.5 } else { 0.0 };
        let column = x.floor();
        let (fx, fy) = (x - column, y - row);
        let inside = smoothstep(0.045, 0.11, (fx.min(1.0 - fx) * 2.0).min(fy.min(1.0 - fy)));
        let number = random((column as i32).rem_euclid(4) as u32, (row as i32).rem_euclid(8) as u32, 5);
        let rough = rough.at(u, v);
        let clay = ramp(number, &[rgb(0x6e3b2e), rgb(0x8d4a36), rgb(0xa65a3f), rgb(0x7c4a3c), rgb(0xb4704e)]);
        let clay = scale(clay, 1.0 + 0.35 * rough + 0.25 * stain.at(u, v));
        let mortar = scale(rgb(0xa59d90), 0.95 + 0.3 * rough);
        (inside * (0.8 + 0.2 * number) + 0.12 * rough * (0.4 + 0.6 * inside), mix3(mortar, clay, inside))
    })
}

/// Rounded stones, as one channel.
pub(super) fn pebbles() -> Texels {
    let stones = Cells::new(10, 141);
    let (bend_x, bend_y, grain) = (Noise::new(9, 9, 161), Noise::new(9, 9, 171), Fractal::new(24, 24, 4, 181));
    let lit = lit(512, 0.05, |u, v| {
        let grain = grain.at(u, v);
        let near = stones.at(u + 0.016 * bend_x.at(u, v), v + 0.016 * bend_y.at(u, v));
        // Steep at the rim and flat on top, like a stone rounded by water.
        let rim = ((near.second - near.first - 0.04) / 0.46).clamp(0.0, 1.0);
        let dome = (rim * (2.0 - rim)).sqrt();
        let sand = 0.1 + 0.05 * grain;
        let tone = 0.34 + 0.34 * near.random + 0.12 * grain;
        (dome.max(sand) + 0.012 * grain, [if rim > 0.0 { tone * (0.35 + 0.65 * dome) } else { sand * 0.7 }; 3])
    });
    let bytes = lit.bytes.iter().copied().step_by(4).collect();
    Texels::flat(lit.shape.width, lit.shape.height, TexelFormat::R8, bytes)
}

/// Grains of quartz, feldspar and mica.
pub(super) fn granite() -> Texels {
    let (coarse, middle, fine) = (Cells::new(48, 191), Cells::new(110, 201), Cells::new(220, 211));
    let (bend_x, bend_y) = (Fractal::new(32, 32, 2, 221), Fractal::new(32, 32, 2, 231));
    let cloud = Fractal::new(4, 4, 4, 241);
    lit(1024, 0.0035, |u, v| {
        let cloud = cloud.at(u, v);
        let (u, v) = (u + 0.008 * bend_x.at(u, v), v + 0.008 * bend_y.at(u, v));
        let near = coarse.at(u, v);
        let ground = ramp(near.random, &[rgb(0x8b5f52), rgb(0xb07c6a), rgb(0xc79a84), rgb(0xa98579)]);
        let is_quartz = middle.at(u, v).random > 0.62;
        let ground = if is_quartz { mix3(ground, rgb(0xcfc6bd), 0.75) } else { ground };
        let is_mica = fine.at(u, v).random + 0.25 * cloud > 0.86;
        let ground = if is_mica { mix3(ground, rgb(0x241f22), 0.82) } else { ground };
        (0.5 * near.random + 0.5 * cloud, scale(ground, 0.95 + 0.25 * cloud))
    })
}

/// Brushed steel with patches of rust.
pub(super) fn rust() -> Texels {
    let (brush, patch) = (Fractal::new(4, 96, 3, 251), Fractal::new(4, 4, 6, 261));
    let (grit, bloom) = (Fractal::new(40, 40, 3, 271), Fractal::new(9, 9, 5, 281));
    lit(512, 0.008, |u, v| {
        let (brush, bloom, grit) = (brush.at(u, v), bloom.at(u, v), grit.at(u, v));
        let amount = smoothstep(-0.12, 0.22, patch.at(u, v) + 0.25 * bloom);
        let steel = scale(rgb(0x77797c), 0.95 + 0.22 * brush + 0.1 * bloom);
        let t = 0.5 + 0.75 * bloom + 0.3 * grit;
        let oxide = ramp(t, &[rgb(0x2f1a14), rgb(0x5a2c19), rgb(0x8a4420), rgb(0xb5672c), rgb(0x7a4a33)]);
        (amount * (0.7 + 0.9 * grit) + 0.05 * brush, mix3(steel, oxide, amount))
    })
}

/// Rock with crusts of lichen, of two separate kinds.
pub(super) fn lichen() -> Texels {
    let (rock, crack) = (Fractal::new(6, 6, 5, 291), Fractal::new(5, 5, 5, 301));
    let (spread, frill) = (Fractal::new(7, 7, 5, 311), Fractal::new(28, 28, 4, 321));
    let (kind, spots) = (Noise::new(4, 4, 331), Cells::new(70, 335));
    lit(1024, 0.012, |u, v| {
        let (rock, frill) = (rock.at(u, v), frill.at(u, v));
        let stone = ramp(0.5 + 0.8 * rock, &[rgb(0x35322f), rgb(0x57534e), rgb(0x7b756c), rgb(0x98917f)]);
        let depth = spread.at(u, v) + 0.22 * frill;
        let cover = smoothstep(0.06, 0.14, depth.abs());
        // One kind where the field is high, another where it is low; bare rock between them.
        let young = 1.0 - smoothstep(0.14, 0.34, depth.abs());
        let spot = spots.at(u, v);
        let cup = if spot.random > 0.72 { 1.0 - smoothstep(0.2, 0.34, spot.first) } else { 0.0 };
        let warm = 0.5 + 0.7 * kind.at(u, v);
        let leaf = if depth > 0.0 {
            ramp(warm, &[rgb(0x8c9148), rgb(0xb8a63c), rgb(0xd3932e), rgb(0xb9702a)])
        } else {
            ramp(warm, &[rgb(0x7c8a7a), rgb(0x9da693), rgb(0xb6b9a4), rgb(0x8d9a8c)])
        };
        let leaf = scale(mix3(leaf, rgb(0x5a3a22), 0.75 * cup), 0.82 + 0.35 * young + 0.45 * frill);
        let height = crack.ridged(u, v) * 0.6 + 0.25 * rock + cover * (0.2 + 0.15 * young + 0.4 * frill + 0.12 * cup);
        (height, mix3(stone, leaf, cover * 0.92))
    })
}

/// Sand rippled by wind.
pub(super) fn dunes() -> Texels {
    let (bend, body, grain) = (Fractal::new(3, 3, 4, 331), Fractal::new(4, 4, 5, 341), Fractal::new(96, 96, 2, 351));
    lit(1024, 0.035, |u, v| {
        let (body, grain) = (body.at(u, v), grain.at(u, v));
        let along = v * 14.0 + u * 3.0 + 1.6 * bend.at(u, v);
        // A slow rise and a steep fall, like a wind ripple.
        let t = along - along.floor();
        let ripple = if t < 0.72 { smoothstep(0.0, 0.72, t) } else { 1.0 - smoothstep(0.72, 1.0, t) };
        let height = ripple * (0.35 + 0.3 * body) + 0.6 * body + 0.015 * grain;
        let tone = 0.45 + 0.22 * height + 0.05 * grain;
        (height, [tone, tone * 0.985, tone * 0.96])
    })
}

/// A night sky: a cloud of gas, near and far stars.
pub(super) fn stars() -> Texels {
    let (gas, dust) = (Fractal::new(3, 3, 6, 361), Fractal::new(4, 4, 6, 371));
    let layers = [(Cells::new(60, 381), 0.05, 0.7), (Cells::new(28, 391), 0.05, 1.0), (Cells::new(11, 401), 0.04, 1.5)];
    lit(512, 0.0, |u, v| {
        let dust = dust.at(u, v);
        let glow = smoothstep(-0.25, 0.75, gas.at(u + 0.1 * dust, v));
        let lane = smoothstep(0.0, 0.5, dust);
        let mut colour = ramp(glow, &[rgb(0x05060d), rgb(0x131433), rgb(0x3d2455), rgb(0x8a4a63), rgb(0xd99a7c)]);
        colour = scale(colour, 1.0 - 0.6 * lane);
        for (cells, radius, power) in &layers {
            let near = cells.at(u, v);
            let core = (1.0 - near.first / radius).max(0.0);
            let halo = power * 0.0016 / (near.first * near.first + 0.004);
            let bright = (core * core + halo * 0.4) * power * near.random * near.random;
            let tint = ramp(near.random * 7.3 % 1.0, &[rgb(0xffc9a0), rgb(0xfff4e8), rgb(0xa9c6ff)]);
            colour = [0, 1, 2].map(|i| colour[i] + tint[i] * bright);
        }
        (0.0, colour)
    })
}

/// Dark and light squares, eight per side.
pub(super) fn checkers() -> Texels {
    let size = 256u32;
    let bytes = (0..size * size)
        .flat_map(|i| {
            let is_light = ((i % size) / 32 + (i / size) / 32).is_multiple_of(2);
            let value = byte(mix(0.18, 0.82, if is_light { 1.0 } else { 0.0 }));
            [value, value, value, 255]
        })
        .collect();
    Texels::flat(size, size, TexelFormat::Rgba8, bytes)
}
