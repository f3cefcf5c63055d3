//! Cubemaps: six pictures, or one picture with the layout of six.
//!
//! Seen from inside the cube, the pictures of the sides are upright.

use crate::Texels;
use eddy_texture::{Face, TexelFormat, TextureShape};
use half::f16;

/// Makes a cubemap from a function of the direction, which is not normalised.
pub(crate) fn of_directions(side: u32, format: TexelFormat, mut texel: impl FnMut([f32; 3], &mut Vec<u8>)) -> Texels {
    let shape = TextureShape::cube(side, format);
    let mut bytes = Vec::with_capacity(shape.bytes() as usize);
    let center = |i: u32| f64::from(2 * i + 1) / f64::from(side) - 1.0;
    for face in Face::ALL {
        for y in 0..side {
            for x in 0..side {
                texel(face.direction(center(x), center(y)).map(|c| c as f32), &mut bytes);
            }
        }
    }
    Texels { shape, bytes }
}

/// Joins six pictures, first row at the top, in the order of [`Face::ALL`]. `vflip`: see [`turned`].
pub(crate) fn of_faces(faces: [Texels; 6], vflip: bool) -> Result<Texels, String> {
    let first = faces[0].shape;
    if first.width != first.height {
        return Err(format!("a face must be square, and this one has {}x{} texels", first.width, first.height));
    }
    for (face, texels) in Face::ALL.iter().zip(&faces) {
        let TextureShape { width, height, format, .. } = texels.shape;
        if (width, height) != (first.width, first.height) {
            return Err(format!("all six faces must have one size; face {} has {width}x{height} texels", face.name()));
        } else if format != first.format {
            return Err(format!("all six faces must have bytes, or all floats; face {} differs", face.name()));
        }
    }
    let shape = TextureShape::cube(first.width, first.format);
    let mut bytes = Vec::with_capacity(6 * faces[0].bytes.len());
    // Each face is freed once it is copied.
    faces.into_iter().for_each(|face| bytes.extend_from_slice(&face.bytes));
    let cube = small_floats(Texels { shape, bytes });
    Ok(if vflip { turned(cube) } else { cube })
}

/// Turns a cubemap as Shadertoy does: each face is upside down, and the top and the bottom are swapped.
pub(crate) fn turned(cube: Texels) -> Texels {
    let (row, face) = (cube.row_bytes(), cube.bytes.len() / 6);
    let faces: Vec<&[u8]> = cube.bytes.chunks_exact(face).collect();
    let order = [Face::PlusX, Face::MinusX, Face::MinusY, Face::PlusY, Face::PlusZ, Face::MinusZ];
    let mut bytes = Vec::with_capacity(cube.bytes.len());
    order.iter().flat_map(|f| faces[*f as usize].chunks_exact(row).rev()).for_each(|row| bytes.extend_from_slice(row));
    Texels { shape: cube.shape, bytes }
}

/// Cuts a picture, first row at the top, into a cubemap. Its aspect ratio determines the layout: 4:3 and 3:4 are
/// crosses with the front, +Z, in the middle, 6:1 and 1:6 strips in the order of [`Face::ALL`], and 2:1 is a panorama
/// in latitude and longitude with +X in its middle and +Z a quarter to the right.
pub(crate) fn of_picture(picture: Texels, vflip: bool) -> Result<Texels, String> {
    let (width, height) = (picture.shape.width, picture.shape.height);
    let is = |across: u32, up: u32| width.is_multiple_of(across) && width / across * up == height;
    let cut = |side: u32, at: [(u32, u32); 6]| at.map(|(x, y)| part(&picture, (x * side, y * side), side));
    let horizontal = [(2, 1), (0, 1), (1, 0), (1, 2), (1, 1), (3, 1)];
    if is(4, 3) {
        of_faces(cut(width / 4, horizontal), vflip)
    } else if is(3, 4) {
        let mut faces = cut(width / 3, [(2, 1), (0, 1), (1, 0), (1, 2), (1, 1), (1, 3)]);
        // The back is attached below the bottom, so it is upside down.
        turn(&mut faces[Face::MinusZ as usize]);
        of_faces(faces, vflip)
    } else if is(6, 1) {
        of_faces(cut(height, std::array::from_fn(|i| (i as u32, 0))), vflip)
    } else if is(1, 6) {
        of_faces(cut(width, std::array::from_fn(|i| (0, i as u32))), vflip)
    } else if is(2, 1) {
        let cube = small_floats(panorama(&picture));
        Ok(if vflip { turned(cube) } else { cube })
    } else {
        Err(format!(
            "the image has {width}x{height} texels, which is not a layout of a cubemap: a cross is 4:3 or 3:4, a strip \
             6:1 or 1:6, a panorama 2:1"
        ))
    }
}

/// Returns a square part of a picture.
fn part(picture: &Texels, (left, top): (u32, u32), side: u32) -> Texels {
    let (texel, row) = (picture.texel_bytes(), picture.row_bytes());
    let start = left as usize * texel;
    let rows = picture.bytes.chunks_exact(row).skip(top as usize).take(side as usize);
    let bytes = rows.flat_map(|row| &row[start..start + side as usize * texel]).copied().collect();
    Texels::flat(side, side, picture.shape.format, bytes)
}

/// Rotates a picture by half a turn.
fn turn(picture: &mut Texels) {
    let texel = picture.texel_bytes();
    let mut bytes = Vec::with_capacity(picture.bytes.len());
    picture.bytes.chunks_exact(texel).rev().for_each(|texel| bytes.extend_from_slice(texel));
    picture.bytes = bytes;
}

/// Samples a panorama by direction, bilinearly. A face gets the texels of a quarter of the horizon.
fn panorama(picture: &Texels) -> Texels {
    use std::f32::consts::{PI, TAU};
    let (width, height) = (picture.shape.width, picture.shape.height);
    let side = (width / 4).max(1);
    let is_float = picture.shape.format == TexelFormat::Rgba32f;
    let texel = |x: i64, y: i64| -> [f32; 4] {
        let (x, y) = (x.rem_euclid(width.into()) as usize, y.clamp(0, i64::from(height) - 1) as usize);
        let start = (y * width as usize + x) * picture.texel_bytes();
        let bytes = &picture.bytes[start..start + picture.texel_bytes()];
        match is_float {
            true => bytemuck::pod_read_unaligned(bytes),
            false => std::array::from_fn(|i| bytes.get(i).map_or(0.0, |b| f32::from(*b))),
        }
    };
    let format = if is_float { TexelFormat::Rgba32f } else { picture.shape.format };
    of_directions(side, format, |[x, y, z], bytes| {
        let latitude = y.atan2((x * x + z * z).sqrt());
        let u = (z.atan2(x) / TAU + 0.5) * width as f32 - 0.5;
        let v = (0.5 - latitude / PI) * height as f32 - 0.5;
        let (column, row) = (u.floor(), v.floor());
        let mix = |a: [f32; 4], b: [f32; 4], f: f32| -> [f32; 4] { std::array::from_fn(|i| a[i] + (b[i] - a[i]) * f) };
        let (x, y) = (column as i64, row as i64);
        let upper = mix(texel(x, y), texel(x + 1, y), u - column);
        let lower = mix(texel(x, y + 1), texel(x + 1, y + 1), u - column);
        let value = mix(upper, lower, v - row);
        match is_float {
            true => bytes.extend_from_slice(bytemuck::bytes_of(&value)),
            false => bytes.extend(value.iter().take(picture.texel_bytes()).map(|c| c.round() as u8)),
        }
    })
}

/// Converts to 16-bit floats, as in the cubemap pass: not every device filters 32-bit floats.
pub(super) fn small_floats(texels: Texels) -> Texels {
    let format = match texels.shape.format {
        TexelFormat::Rgba32f => TexelFormat::Rgba16f,
        TexelFormat::Rg32f => TexelFormat::Rg16f,
        TexelFormat::R32f => TexelFormat::R16f,
        _ => return texels,
    };
    let small = |bytes: &[u8]| {
        let value: f32 = bytemuck::pod_read_unaligned(bytes);
        f16::from_f32(value.clamp(-65504.0, 65504.0)).to_le_bytes()
    };
    let mut bytes = Vec::with_capacity(texels.bytes.len() / 2);
    texels.bytes.chunks_exact(4).for_each(|float| bytes.extend(small(float)));
    Texels { shape: TextureShape { format, ..texels.shape }, bytes }
}

/// Returns the texels of a cubemap's face.
#[cfg(test)]
fn face(cube: &Texels, face: Face) -> &[u8] {
    assert_eq!(cube.shape.dimension, eddy_texture::Dimension::Cube);
    let length = cube.bytes.len() / 6;
    &cube.bytes[face as usize * length..][..length]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(side: u32, value: u8) -> Texels {
        Texels::flat(side, side, TexelFormat::R8, vec![value; (side * side) as usize])
    }

    /// Returns a picture whose texels name the grid cell that contains them.
    fn cells(side: u32, across: u32, up: u32) -> Texels {
        let cell = |x: u32, y: u32| (10 * (y / side) + x / side) as u8;
        let (width, height) = (across * side, up * side);
        let bytes = (0..height).flat_map(|y| (0..width).map(move |x| cell(x, y))).collect();
        Texels::flat(width, height, TexelFormat::R8, bytes)
    }

    #[test]
    fn layouts_are_cut_into_their_faces() {
        let of = |across, up| {
            let cube = of_picture(cells(2, across, up), false).unwrap();
            Face::ALL.map(|f| face(&cube, f)[0])
        };
        assert_eq!(of(4, 3), [12, 10, 1, 21, 11, 13]);
        assert_eq!(of(3, 4), [12, 10, 1, 21, 11, 31]);
        assert_eq!(of(6, 1), [0, 1, 2, 3, 4, 5]);
        assert_eq!(of(1, 6), [0, 10, 20, 30, 40, 50]);
        let error = of_picture(cells(2, 5, 3), false).unwrap_err();
        assert!(error.contains("10x6") && error.contains("4:3"), "{error}");
    }

    #[test]
    fn a_flip_turns_each_face_and_swaps_top_and_bottom() {
        let mut faces = [0, 1, 2, 3, 4, 5].map(|i| plain(2, i));
        faces[4].bytes = vec![7, 7, 8, 8];
        let cube = of_faces(faces, true).unwrap();
        assert_eq!(Face::ALL.map(|f| face(&cube, f)[0]), [0, 1, 3, 2, 8, 5]);
    }

    #[test]
    fn faces_of_different_sizes_are_rejected() {
        let mut faces = [0; 6].map(|i| plain(2, i));
        faces[3] = plain(4, 0);
        assert!(of_faces(faces, false).unwrap_err().contains("face -y has 4x4"));
        let wide = Texels::flat(2, 1, TexelFormat::R8, vec![0, 0]);
        assert!(of_faces([0; 6].map(|_| wide.clone()), false).unwrap_err().contains("square"));
    }

    /// A panorama of the direction itself reads back as the direction, within the curvature of a texel.
    #[test]
    fn a_panorama_is_read_by_direction() {
        let (width, height) = (256u32, 128u32);
        let mut bytes = Vec::new();
        for y in 0..height {
            let latitude = (0.5 - (y as f32 + 0.5) / height as f32) * std::f32::consts::PI;
            for x in 0..width {
                let longitude = ((x as f32 + 0.5) / width as f32 - 0.5) * std::f32::consts::TAU;
                let c = latitude.cos();
                let texel = [c * longitude.cos(), latitude.sin(), c * longitude.sin(), 1.0];
                bytes.extend_from_slice(bytemuck::bytes_of(&texel));
            }
        }
        let cube = of_picture(Texels::flat(width, height, TexelFormat::Rgba32f, bytes), false).unwrap();
        assert_eq!((cube.shape.width, cube.shape.format), (64, TexelFormat::Rgba16f));
        let mut worst = 0f32;
        for (i, f) in Face::ALL.iter().enumerate() {
            for y in 0..64u32 {
                for x in 0..64u32 {
                    let center = |n: u32| f64::from(2 * n + 1) / 64.0 - 1.0;
                    let d = f.direction(center(x), center(y)).map(|c| c as f32);
                    let length = d.iter().map(|c| c * c).sum::<f32>().sqrt();
                    for (axis, value) in d.iter().enumerate() {
                        let at = ((i as u32 * 64 + y) * 64 + x) as usize * 8 + 2 * axis;
                        let got = f16::from_le_bytes([cube.bytes[at], cube.bytes[at + 1]]).to_f32();
                        worst = worst.max((got - value / length).abs());
                    }
                }
            }
        }
        // The last rows at the poles are half a texel away from them.
        assert!(worst < 0.015, "{worst}");
    }
}
