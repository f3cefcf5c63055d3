//! Noises and ordered patterns: textures of values rather than images.

use crate::Texels;
use eddy_texture::{TexelFormat, TextureShape};

/// One round of the PCG hash (O'Neill 2014; as a hash: Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT
/// 2020).
pub(super) fn hash(x: u32) -> u32 {
    let state = x.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

/// Returns a hash of a place and a seed.
pub(super) fn hash2(x: u32, y: u32, seed: u32) -> u32 {
    hash(x.wrapping_add(hash(y.wrapping_add(hash(seed)))))
}

/// Returns independent, evenly distributed bytes.
pub(super) fn white(size: u32, format: TexelFormat, seed: u32) -> Texels {
    let count = size * size * format.bytes() as u32;
    let bytes = (0..count).map(|i| (hash2(i, 0, seed) >> 24) as u8).collect();
    Texels::flat(size, size, format, bytes)
}

/// The same in 3D.
pub(super) fn white_volume(side: u32, format: TexelFormat, seed: u32) -> Texels {
    let shape = TextureShape::volume(side, side, side, format);
    let bytes = (0..shape.bytes() as u32).map(|i| (hash2(i, 0, seed) >> 24) as u8).collect();
    Texels { shape, bytes }
}

/// Bayer's 8x8 matrix of thresholds (1973): the interleaved bits of column and row, the lowest bit being the most
/// significant.
pub(super) fn bayer() -> Texels {
    let bytes = (0..64u32)
        .map(|i| {
            let (x, y) = (i % 8, i / 8);
            let rank = (0..3).fold(0, |rank, bit| {
                let (xb, yb) = (x >> bit & 1, y >> bit & 1);
                rank << 2 | (xb ^ yb) << 1 | yb
            });
            // The centre of one of 64 equal steps.
            ((2 * rank + 1) * 255 / 128) as u8
        })
        .collect();
    Texels::flat(8, 8, TexelFormat::R8, bytes)
}

const TILE: usize = 64;

/// Blue noise of 64x64, four channels.
pub(super) fn blue_tile() -> Texels {
    repeat_tile(TILE)
}

/// The 64x64 tile repeated to 1024x1024 as on Shadertoy: equally free of low frequencies, but of period 64.
pub(super) fn blue() -> Texels {
    repeat_tile(1024)
}

/// Each channel has the same ranks at other places: rotated, mirrored and shifted, which keeps them blue.
fn repeat_tile(size: usize) -> Texels {
    let ranks = void_and_cluster();
    let at = |x: usize, y: usize| (ranks[(y % TILE) * TILE + x % TILE] * 256 / (TILE * TILE)) as u8;
    let mut bytes = Vec::with_capacity(size * size * 4);
    for y in 0..size {
        for x in 0..size {
            let (flip_x, flip_y) = (TILE - 1 - x % TILE, TILE - 1 - y % TILE);
            bytes.extend([at(x, y), at(y + 17, flip_x + 29), at(flip_x + 41, flip_y + 11), at(flip_y + 7, x + 47)]);
        }
    }
    Texels::flat(size as u32, size as u32, TexelFormat::Rgba8, bytes)
}

/// Ranks 0..4096 of a 64x64 torus by Ulichney's method ("The void-and-cluster method for dither array generation", SPIE
/// 1993), with integer energies so that every machine breaks ties the same way.
fn void_and_cluster() -> Vec<usize> {
    let mut field = Energy::new();
    // A tenth of the places at random; then the tightest cluster is moved into the largest void until nothing changes.
    let mut seed = 0;
    while field.count < TILE * TILE / 10 {
        let at = hash2(seed, 0, 77) as usize % (TILE * TILE);
        if !field.is_set[at] {
            field.set(at, true);
        }
        seed += 1;
    }
    loop {
        let cluster = field.extreme(true);
        field.set(cluster, false);
        let void = field.extreme(false);
        field.set(void, true);
        if void == cluster {
            break;
        }
    }
    let start = field.clone();
    let mut ranks = vec![0; TILE * TILE];
    for rank in (0..start.count).rev() {
        let cluster = field.extreme(true);
        field.set(cluster, false);
        ranks[cluster] = rank;
    }
    let mut field = start;
    while field.count < TILE * TILE {
        let void = field.extreme(false);
        ranks[void] = field.count;
        field.set(void, true);
    }
    ranks
}

/// The places that are set, and the energy of every place: how crowded it is by them.
#[derive(Clone)]
struct Energy {
    is_set: Vec<bool>,
    energy: Vec<i64>,
    weights: Vec<i64>,
    count: usize,
}

impl Energy {
    const REACH: usize = 9;

    fn new() -> Energy {
        // exp(-r²/2σ²) with σ = 1.5, by powers of exp(-1/4.5) in 2^-32, rounded down so that all machines agree.
        let step: i64 = 3_439_140_958;
        let mut powers = vec![1i64 << 32];
        for i in 0..2 * Self::REACH * Self::REACH {
            powers.push(((i128::from(powers[i]) * i128::from(step)) >> 32) as i64);
        }
        let side = 2 * Self::REACH + 1;
        let weights = (0..side * side)
            .map(|i| {
                let (dx, dy) = ((i % side).abs_diff(Self::REACH), (i / side).abs_diff(Self::REACH));
                powers[dx * dx + dy * dy]
            })
            .collect();
        Energy { is_set: vec![false; TILE * TILE], energy: vec![0; TILE * TILE], weights, count: 0 }
    }

    fn set(&mut self, at: usize, on: bool) {
        self.is_set[at] = on;
        if on {
            self.count += 1;
        } else {
            self.count -= 1;
        }
        let side = 2 * Self::REACH + 1;
        for (i, weight) in self.weights.iter().enumerate() {
            let x = (at % TILE + TILE + i % side - Self::REACH) % TILE;
            let y = (at / TILE + TILE + i / side - Self::REACH) % TILE;
            self.energy[y * TILE + x] += if on { *weight } else { -*weight };
        }
    }

    /// Returns the tightest cluster among the set places, or the largest void among the others.
    fn extreme(&self, of_set: bool) -> usize {
        let places = (0..TILE * TILE).filter(|&i| self.is_set[i] == of_set);
        let found = if of_set {
            places.max_by_key(|&i| (self.energy[i], std::cmp::Reverse(i)))
        } else {
            places.min_by_key(|&i| (self.energy[i], i))
        };
        found.unwrap_or(0)
    }
}
