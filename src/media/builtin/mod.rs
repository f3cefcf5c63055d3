//! Eddy's own textures, computed on demand.
//!
//! Noises, patterns and procedural materials: all made here, none copied. Texels are computed only with integers and
//! the operations that IEEE 754 rounds correctly (+ - * / and the square root), so every machine makes the same bytes.
//! Every texture but `gradient`, `font`, `street` and `sprites` is seamless. Sizes and channels are those of the
//! Shadertoy textures that they replace.

mod cubes;
mod field;
mod font;
mod grown;
mod noise;
mod picture;
mod stone;

use super::{
    Texels,
    load::{cube, flipped},
};
use eddy_texture::{Dimension, TexelFormat};

/// Makes one texture, top row first.
type Maker = fn() -> Texels;

const ALL: [(&str, Maker); 33] = [
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
    ("gallery", cubes::gallery),
    ("gallery-blurred", cubes::gallery_blurred),
    ("hall", cubes::hall),
    ("hall-blurred", cubes::hall_blurred),
    ("forest", cubes::forest),
    ("forest-blurred", cubes::forest_blurred),
    ("noise-grey-3d", || noise::white_volume(32, TexelFormat::R8, 5)),
    ("noise-rgba-3d", || noise::white_volume(32, TexelFormat::Rgba8, 6)),
];

/// Returns the dimension of a texture.
fn dimension(name: &str) -> Dimension {
    match name {
        _ if name.ends_with("-3d") => Dimension::D3,
        _ if ["gallery", "hall", "forest"].iter().any(|place| name.starts_with(place)) => Dimension::Cube,
        _ => Dimension::D2,
    }
}

/// Returns the names of the built-in textures of a dimension, in the order in which a list shows them.
pub fn names(wanted: Dimension) -> impl Iterator<Item = &'static str> {
    ALL.into_iter().map(|(name, _)| name).filter(move |name| dimension(name) == wanted)
}

/// Makes a texture by name. With `vflip` a picture's top row is at v = 1; a cubemap is turned as on Shadertoy.
pub fn make(name: &str, wanted: Dimension, vflip: bool) -> Option<Texels> {
    let (_, maker) = ALL.iter().find(|(n, _)| *n == name && dimension(n) == wanted)?;
    let texels = maker();
    Some(match wanted {
        Dimension::D2 if vflip => flipped(texels),
        Dimension::Cube if vflip => cube::turned(texels),
        _ => texels,
    })
}

#[cfg(test)]
mod tests;
