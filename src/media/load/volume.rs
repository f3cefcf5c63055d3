//! Volumes: Shadertoy's files and stacks of pictures.

use super::cube::small_floats;
use crate::Texels;
use eddy_project::limits;
use eddy_texture::{TexelFormat, TextureShape};

/// The bytes before the texels of Shadertoy's file: signature, three sides, channels, layout, format.
const HEAD: usize = 20;

/// Reads a file in Shadertoy's format: a signature of 4 bytes, three sides (u32), the number of channels and the layout
/// (u8), the format (u16: 0 for bytes, 10 for floats), then the texels; all numbers are little-endian. `room` is the
/// number of bytes that it may take.
pub(super) fn read(file: &[u8], room: u64) -> Result<Texels, String> {
    let (head, texels) = file.split_at_checked(HEAD).ok_or("the file ends within its header of 20 bytes")?;
    if !head.starts_with(b"BIN\0") {
        return Err("it does not begin with the letters BIN and a zero".into());
    }
    let side = |at: usize| u32::from_le_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]);
    let [width, height, depth] = [side(4), side(8), side(12)];
    let (channels, kind) = (head[16], u16::from_le_bytes([head[18], head[19]]));
    let format = match (kind, channels) {
        (0, 1) => TexelFormat::R8,
        (0, 4) => TexelFormat::Rgba8,
        (10, 1) => TexelFormat::R32f,
        (10, 4) => TexelFormat::Rgba32f,
        (0 | 10, _) => return Err(format!("it has {channels} channels; 1 or 4 can be read")),
        _ => return Err(format!("its format is {kind}; 0 (bytes) and 10 (floats) can be read")),
    };
    let shape = checked(width, height, depth, format, room)?;
    let needed = shape.bytes() as usize;
    let bytes = texels.get(..needed).ok_or_else(|| {
        format!("it should hold {needed} bytes of {width}x{height}x{depth} texels, and has {}", texels.len())
    })?;
    Ok(small_floats(Texels { shape, bytes: bytes.to_vec() }))
}

/// Joins slices of one size and format, in the order of w.
pub(super) fn of_slices(slices: Vec<Texels>, room: u64) -> Result<Texels, String> {
    let Some(first) = slices.first().map(|slice| slice.shape) else { return Err("there are no slices".into()) };
    if let Some(n) = slices.iter().position(|slice| slice.shape != first) {
        let TextureShape { width, height, .. } = slices[n].shape;
        let (across, up) = (first.width, first.height);
        return Err(format!("slice {n} has {width}x{height} texels, and the first {across}x{up}; they must be alike"));
    }
    let shape = checked(first.width, first.height, slices.len() as u32, first.format, room)?;
    let mut bytes = Vec::with_capacity(shape.bytes() as usize);
    slices.into_iter().for_each(|slice| bytes.extend_from_slice(&slice.bytes));
    Ok(small_floats(Texels { shape, bytes }))
}

fn checked(width: u32, height: u32, depth: u32, format: TexelFormat, room: u64) -> Result<TextureShape, String> {
    let sides = [width, height, depth];
    if sides.contains(&0) {
        return Err(format!("it has {width}x{height}x{depth} texels: none"));
    } else if sides.iter().any(|side| *side > limits::VOLUME_SIDE) {
        return Err(format!(
            "it has {width}x{height}x{depth} texels, and the limit per side is {}",
            limits::VOLUME_SIDE
        ));
    }
    let shape = TextureShape::volume(width, height, depth, format);
    if shape.bytes() > room.min(limits::PICTURE_BYTES) {
        return Err(format!("its {width}x{height}x{depth} texels take {} bytes, which is too much", shape.bytes()));
    }
    Ok(shape)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(sides: [u32; 3], channels: u8, kind: u16, texels: &[u8]) -> Vec<u8> {
        let mut file = b"BIN\0".to_vec();
        file.extend(sides.iter().flat_map(|side| side.to_le_bytes()));
        file.extend([channels, 0]);
        file.extend(kind.to_le_bytes());
        file.extend(texels);
        file
    }

    #[test]
    fn files_of_shadertoy_are_read() {
        let texels = read(&file([2, 1, 3], 1, 0, &[1, 2, 3, 4, 5, 6]), 100).unwrap();
        assert_eq!(
            texels,
            Texels { shape: TextureShape::volume(2, 1, 3, TexelFormat::R8), bytes: vec![1, 2, 3, 4, 5, 6] }
        );
        let color = read(&file([1, 1, 1], 4, 0, &[1, 2, 3, 4]), 100).unwrap();
        assert_eq!(color.shape.format, TexelFormat::Rgba8);
        let float = read(&file([1, 1, 1], 1, 10, &1.5f32.to_le_bytes()), 100).unwrap();
        assert_eq!(
            (float.shape.format, float.bytes),
            (TexelFormat::R16f, half::f16::from_f32(1.5).to_le_bytes().to_vec())
        );
    }

    #[test]
    fn damaged_files_are_rejected_before_memory_is_allocated() {
        for (bytes, says) in [
            (b"BIN".to_vec(), "within its header"),
            (vec![7; 64], "letters BIN"),
            (file([2, 2, 2], 1, 0, &[0; 7]), "8 bytes of 2x2x2"),
            (file([2, 2, 2], 3, 0, &[0; 99]), "3 channels"),
            (file([2, 2, 2], 1, 5, &[0; 99]), "format is 5"),
            (file([0, 2, 2], 1, 0, &[]), "none"),
            (file([u32::MAX; 3], 4, 10, &[]), "limit per side"),
            (file([2048, 2048, 2048], 4, 10, &[]), "too much"),
        ] {
            let error = read(&bytes, u64::MAX).unwrap_err();
            assert!(error.contains(says), "{error}");
        }
    }

    #[test]
    fn slices_are_stacked() {
        let slice = |value| Texels::flat(2, 1, TexelFormat::R8, vec![value; 2]);
        let texels = of_slices(vec![slice(1), slice(2)], 100).unwrap();
        assert_eq!((texels.shape, texels.bytes), (TextureShape::volume(2, 1, 2, TexelFormat::R8), vec![1, 1, 2, 2]));
        let other = Texels::flat(1, 1, TexelFormat::R8, vec![0]);
        assert!(of_slices(vec![slice(1), other], 100).unwrap_err().contains("slice 1 has 1x1"));
        assert!(of_slices(vec![], 100).is_err());
    }
}
