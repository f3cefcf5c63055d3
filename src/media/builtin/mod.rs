//! Eddy's own textures, computed when asked for.
//!
//! Owns noises, patterns and procedural materials: all made here, none copied. Only whole numbers and the operations
//! that IEEE 754 rounds correctly (+ - * / and the square root) go into a texel, so every machine makes the same bytes.
//! Every texture but `gradient`, `font`, `street` and `sprites` is seamless. Sizes and channels are those of the site's
//! textures that they stand in for.

mod field;
mod font;
mod grown;
mod noise;
mod picture;
mod stone;

use super::Texels;
use eddy_texture::TexelFormat;

/// Makes one texture, top row first.
type Maker = fn() -> Texels;

const ALL: [(&str, Maker); 25] = [
    ("noise-rgba-64", || noise::white(64, TexelFormat::Rgba8, 1)),
    ("noise-rgba-256", || noise::white(256, TexelFormat::Rgba8, 2)),
    ("noise-grey-64", || noise::white(64, TexelFormat::R8, 3)),
    ("noise-grey-256", || noise::white(256, TexelFormat::R8, 4)),
    ("blue-noise", noise::blue),
    ("blue-noise-64", noise::blue_tile),
    ("bayer-8", noise::bayer),
    ("checkers", stone::checkers),
    ("gradient", picture::gradient),
    ("font", font::atlas),
    ("wood", grown::wood),
    ("brick", stone::brick),
    ("pebbles", stone::pebbles),
    ("marble", stone::marble),
    ("granite", stone::granite),
    ("lichen", stone::lichen),
    ("rust", stone::rust),
    ("fabric", grown::fabric),
    ("grass", grown::grass),
    ("moss", grown::moss),
    ("coral", grown::coral),
    ("dunes", stone::dunes),
    ("stars", stone::stars),
    ("street", picture::street),
    ("sprites", picture::sprites),
];

/// Names of all built-in textures, in the order a list shows them.
pub fn names() -> [&'static str; ALL.len()] {
    ALL.map(|(name, _)| name)
}

/// Makes a texture by name. The picture's top row lies at v = 1.
pub fn make(name: &str) -> Option<Texels> {
    let (_, maker) = ALL.iter().find(|(n, _)| *n == name)?;
    let mut texels = maker();
    let row = texels.row_bytes();
    texels.bytes = texels.bytes.chunks_exact(row).rev().flatten().copied().collect();
    Some(texels)
}

#[cfg(test)]
mod tests;
