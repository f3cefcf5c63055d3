//! NumPy's `.npy` as texels: an array of shape (height, width) or (height, width, components), row 0 at the bottom.
//!
//! Format: <https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html>, versions 1 to 3, C order. Missing
//! components are 0, a missing alpha is 1. Bytes (uint8) are divided by 255, as in a picture.

use super::{MediaError, Texels};
use eddy_project::limits;
use eddy_texture::{TexelFormat, TextureShape};
use std::path::Path;

const MAGIC: &[u8] = b"\x93NUMPY";

/// Returns the texels of the array in the file `path`, which may take `room` bytes.
pub(super) fn read(bytes: &[u8], path: &Path, room: u64) -> Result<Texels, MediaError> {
    decode(bytes, room).map_err(|reason| MediaError::Npy { path: path.to_owned(), reason })
}

/// Returns the header of an `.npy` file of version 1.0 for rows of numbers of the type `descr` in C order. The data
/// that follow start at a multiple of 64.
pub fn header(descr: &str, shape: &[u32]) -> Vec<u8> {
    let shape: String = shape.iter().map(|n| format!("{n}, ")).collect();
    let shape = shape.trim_end_matches(", ");
    let mut text = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({shape}), }}");
    // Magic, version and length take 10 bytes; the header ends in a line break.
    let padding = (64 - (10 + text.len() + 1) % 64) % 64;
    text.extend(std::iter::repeat_n(' ', padding));
    text.push('\n');
    [MAGIC, b"\x01\x00", &(text.len() as u16).to_le_bytes(), text.as_bytes()].concat()
}

/// Returns 2D texels as a whole file, of shape (height, width, components): uint8, float16 or float32 by their format.
pub fn bytes(texels: &Texels) -> Vec<u8> {
    let TextureShape { width, height, format, .. } = texels.shape;
    let components = format.components();
    let number = texels.texel_bytes() / components;
    let descr = if number == 1 { "|u1".to_owned() } else { format!("<f{number}") };
    let mut file = header(&descr, &[height, width, components as u32]);
    if cfg!(target_endian = "big") {
        file.extend(texels.bytes.chunks_exact(number).flat_map(|number| number.iter().rev()));
    } else {
        file.extend_from_slice(&texels.bytes);
    }
    file
}

#[derive(Clone, Copy)]
enum Number {
    U8,
    F32,
    F64,
}

fn decode(bytes: &[u8], room: u64) -> Result<Texels, String> {
    let cut = || "the file is truncated".to_owned();
    let rest = bytes.strip_prefix(MAGIC).ok_or("not an .npy file: it does not start with \\x93NUMPY")?;
    let &[major, _, ref rest @ ..] = rest else { return Err(cut()) };
    let (length, rest) = match major {
        1 => rest.split_first_chunk::<2>().map(|(n, rest)| (usize::from(u16::from_le_bytes(*n)), rest)),
        2 | 3 => rest.split_first_chunk::<4>().map(|(n, rest)| (u32::from_le_bytes(*n) as usize, rest)),
        _ => return Err(format!("version {major} of the format is not supported; versions 1 to 3 are")),
    }
    .ok_or_else(cut)?;
    let (header, data) = rest.split_at_checked(length).ok_or_else(cut)?;
    let header = String::from_utf8_lossy(header);
    let number = match text(&header, "descr").ok_or("its header has no number type")? {
        "<f4" => Number::F32,
        "<f8" => Number::F64,
        "|u1" => Number::U8,
        other => return Err(format!("an array of type {other}, not <f4, <f8 or |u1")),
    };
    if entry(&header, "fortran_order").is_some_and(|value| value.starts_with("True")) {
        return Err("an array in Fortran order; numpy.ascontiguousarray converts it".into());
    }
    let shape = shape(&header).ok_or("its header has no shape")?;
    let (height, width, components) = match shape[..] {
        [height, width] => (height, width, 1),
        [height, width, components] if (1..=4).contains(&components) => (height, width, components),
        _ => return Err(format!("an array of shape {shape:?}, not (height, width) or (height, width, 1 to 4)")),
    };
    if height == 0 || width == 0 {
        return Err("the array has no texels".into());
    }
    let most = (limits::PICTURE_BYTES.min(room) / TexelFormat::Rgba32f.bytes()) as usize;
    let texels = height.checked_mul(width).filter(|n| *n <= most);
    let texels = texels.ok_or_else(|| format!("{width}x{height} texels; the limit here is {most}"))?;
    let size = match number {
        Number::U8 => 1,
        Number::F32 => 4,
        Number::F64 => 8,
    };
    let data = data.get(..texels * components * size).ok_or_else(cut)?;
    let value = |i: usize| match number {
        Number::U8 => f32::from(data[i]) / 255.0,
        Number::F32 => bytemuck::pod_read_unaligned(&data[4 * i..4 * i + 4]),
        Number::F64 => bytemuck::pod_read_unaligned::<f64>(&data[8 * i..8 * i + 8]) as f32,
    };
    let mut out = Vec::with_capacity(texels * 16);
    for texel in 0..texels {
        let mut rgba = [0.0, 0.0, 0.0, 1.0f32];
        for (c, component) in rgba.iter_mut().enumerate().take(components) {
            *component = value(texel * components + c);
        }
        out.extend_from_slice(bytemuck::bytes_of(&rgba));
    }
    Ok(Texels::flat(width as u32, height as u32, TexelFormat::Rgba32f, out))
}

/// Returns the text after a key of the header, which is a Python dictionary.
fn entry<'h>(header: &'h str, key: &str) -> Option<&'h str> {
    let at = [format!("'{key}'"), format!("\"{key}\"")].iter().find_map(|k| Some(header.find(k)? + k.len()))?;
    Some(header[at..].trim_start().strip_prefix(':')?.trim_start())
}

fn text<'h>(header: &'h str, key: &str) -> Option<&'h str> {
    let value = entry(header, key)?;
    let quote = value.chars().next().filter(|c| matches!(c, '\'' | '"'))?;
    value[1..].split(quote).next()
}

fn shape(header: &str) -> Option<Vec<usize>> {
    let inner = entry(header, "shape")?.strip_prefix('(')?.split(')').next()?;
    inner.split(',').map(str::trim).filter(|n| !n.is_empty()).map(|n| n.parse().ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(header: &str, data: &[u8]) -> Vec<u8> {
        let mut out = MAGIC.to_vec();
        out.extend([1, 0]);
        out.extend((header.len() as u16).to_le_bytes());
        out.extend(header.as_bytes());
        out.extend(data);
        out
    }

    fn floats(texels: &Texels) -> Vec<f32> {
        bytemuck::pod_collect_to_vec::<u8, f32>(&texels.bytes)
    }

    #[test]
    fn every_type_and_shape_is_read() {
        let f4: Vec<u8> = [1.0f32, 2.0, 3.0, 4.0].iter().flat_map(|x| x.to_le_bytes()).collect();
        let read =
            decode(&file("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2, 2), }\n", &f4), u64::MAX).unwrap();
        assert_eq!((read.shape.width, read.shape.height), (2, 1));
        assert_eq!(floats(&read), [1.0, 2.0, 0.0, 1.0, 3.0, 4.0, 0.0, 1.0]);
        let f8: Vec<u8> = [0.5f64, -1.0].iter().flat_map(|x| x.to_le_bytes()).collect();
        let read = decode(&file("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 1), }", &f8), u64::MAX).unwrap();
        assert_eq!(floats(&read), [0.5, 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 1.0]);
        let read =
            decode(&file("{\"descr\": \"|u1\", 'fortran_order': False, 'shape': (1,1,4)}", &[255, 0, 51, 0]), u64::MAX);
        assert_eq!(floats(&read.unwrap()), [1.0, 0.0, 0.2, 0.0]);
    }

    #[test]
    fn unsupported_arrays_are_errors() {
        let good = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2), }";
        let f4 = [0u8; 8];
        for (bytes, expected) in [
            (file(good, &f4)[..40].to_vec(), "truncated"),
            (file(good, &f4[..7]), "truncated"),
            (b"\x93NUMPY".to_vec(), "truncated"),
            (b"hello".to_vec(), "does not start"),
            (file(&good.replace("<f4", "<i8"), &f4), "type <i8"),
            (file(&good.replace("False", "True"), &f4), "Fortran"),
            (file(&good.replace("(1, 2)", "(2,)"), &f4), "shape [2]"),
            (file(&good.replace("(1, 2)", "(1, 2, 5)"), &f4), "shape [1, 2, 5]"),
            (file(&good.replace("(1, 2)", "(0, 2)"), &f4), "no texels"),
            (file(&good.replace("(1, 2)", "(4294967296, 4294967296)"), &f4), "the limit here is"),
            (file(&good.replace("(1, 2)", "(-1, 2)"), &f4), "no shape"),
        ] {
            let error = decode(&bytes, u64::MAX).unwrap_err();
            assert!(error.contains(expected), "{error}");
        }
    }
}
