//! Texture files: KTX2 (Khronos, KTX File Format Specification 2.0) and DDS (Microsoft, Programming Guide for DDS).
//!
//! The first mip level is read. Values are as stored: they are not linearised.

mod masks;

use self::masks::Masks;
use super::{cube, flipped, volume};
use crate::Texels;
use eddy_project::limits;
use eddy_texture::{Dimension, TexelFormat};
use image_dds::{
    ImageFormat, Surface,
    ddsfile::{Caps2, Dds},
};
use ktx2::{Format, SupercompressionScheme};
use std::{borrow::Cow, io::Read};

const KTX2: &[u8] = b"\xabKTX 20\xbb";
const DDS: &[u8] = b"DDS ";

/// Returns the format of a texture file by its first bytes.
pub(super) fn kind(bytes: &[u8]) -> Option<&'static str> {
    [(KTX2, "KTX2"), (DDS, "DDS")].iter().find(|(magic, _)| bytes.starts_with(magic)).map(|(_, kind)| *kind)
}

/// Reads a file as a texture of `dimension`, which may take `room` bytes while it is decoded. Rows of volumes stay in
/// the file's order; those of pictures and faces start at the top.
pub(super) fn read(bytes: &[u8], dimension: Dimension, vflip: bool, room: u64) -> Result<Texels, String> {
    let file = if bytes.starts_with(KTX2) { File::ktx2(bytes, room)? } else { File::dds(bytes, room)? };
    let held = file.dimension;
    let mut layers = file.layers()?;
    match (dimension, layers.len()) {
        (Dimension::D2, 1) => {
            let picture = layers.remove(0);
            Ok(if vflip { flipped(picture) } else { picture })
        }
        (Dimension::Cube, 1) => cube::of_picture(layers.remove(0), vflip),
        (Dimension::Cube, 6) if held == Dimension::Cube => {
            cube::of_faces(layers.try_into().expect("there are six"), vflip)
        }
        (Dimension::D3, _) if held != Dimension::Cube => volume::of_slices(layers, room),
        _ => Err(match held {
            Dimension::Cube => "it has the faces of a cubemap: read it with kind = \"cubemap\"".into(),
            Dimension::D3 => "it has the slices of a volume: read it with kind = \"volume\"".into(),
            Dimension::D2 => format!("it has {} layers, and a picture has one", layers.len()),
        }),
    }
}

/// The first level of a file. A layer is a picture: a face of a cubemap, a slice of a volume, or an element of an
/// array.
struct File {
    dimension: Dimension,
    width: u32,
    height: u32,
    texels: Stored,
    layers: Vec<Vec<u8>>,
}

/// The format of texels in a file.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Stored {
    /// Three bytes, red first.
    Rgb8,
    /// Integers whose bit fields are channels.
    Masked(Masks),
    Other(ImageFormat),
}

impl Stored {
    /// Returns the side lengths of a block of texels and its size in bytes.
    fn block(self) -> (u32, u64) {
        use ImageFormat as F;
        match self {
            Stored::Rgb8 | Stored::Other(F::Bgr8Unorm) => (1, 3),
            Stored::Masked(masks) => (1, u64::from(masks.bytes)),
            Stored::Other(format) => match format {
                F::BC1RgbaUnorm | F::BC1RgbaUnormSrgb | F::BC4RUnorm | F::BC4RSnorm => (4, 8),
                F::BC2RgbaUnorm
                | F::BC2RgbaUnormSrgb
                | F::BC3RgbaUnorm
                | F::BC3RgbaUnormSrgb
                | F::BC5RgUnorm
                | F::BC5RgSnorm
                | F::BC6hRgbUfloat
                | F::BC6hRgbSfloat
                | F::BC7RgbaUnorm
                | F::BC7RgbaUnormSrgb => (4, 16),
                F::R8Unorm | F::R8Snorm => (1, 1),
                F::Rgba16Float | F::Rgba16Unorm | F::Rgba16Snorm | F::Rg32Float => (1, 8),
                F::Rgba32Float => (1, 16),
                F::Rgb32Float => (1, 12),
                F::Rg8Unorm
                | F::Rg8Snorm
                | F::Bgra4Unorm
                | F::Bgr5A1Unorm
                | F::R16Unorm
                | F::R16Snorm
                | F::R16Float => (1, 2),
                _ => (1, 4),
            },
        }
    }

    fn layer_bytes(self, width: u32, height: u32) -> u64 {
        let (side, bytes) = self.block();
        u64::from(width.div_ceil(side)) * u64::from(height.div_ceil(side)) * bytes
    }

    /// Returns the format of the decoded texels. Formats without an equal [`TexelFormat`] become four bytes, or four
    /// floats if bytes would lose precision.
    fn kept(self) -> TexelFormat {
        use ImageFormat as F;
        match self {
            Stored::Rgb8 => TexelFormat::Rgba8,
            Stored::Masked(masks) => masks.kept(),
            Stored::Other(format) => match format {
                F::R8Unorm | F::BC4RUnorm => TexelFormat::R8,
                F::Rg8Unorm | F::BC5RgUnorm => TexelFormat::Rg8,
                F::R16Float => TexelFormat::R16f,
                F::Rg16Float => TexelFormat::Rg16f,
                F::Rgba16Float => TexelFormat::Rgba16f,
                F::R32Float => TexelFormat::R32f,
                F::Rg32Float => TexelFormat::Rg32f,
                F::Rgba32Float
                | F::Rgb32Float
                | F::BC6hRgbUfloat
                | F::BC6hRgbSfloat
                | F::R8Snorm
                | F::Rg8Snorm
                | F::Rgba8Snorm
                | F::BC4RSnorm
                | F::BC5RgSnorm
                | F::R16Unorm
                | F::R16Snorm
                | F::Rg16Unorm
                | F::Rg16Snorm
                | F::Rgba16Unorm
                | F::Rgba16Snorm => TexelFormat::Rgba32f,
                _ => TexelFormat::Rgba8,
            },
        }
    }
}

impl File {
    fn ktx2(bytes: &[u8], room: u64) -> Result<Self, String> {
        let damaged = |error: ktx2::ParseError| format!("the KTX2 file is damaged ({error})");
        let reader = ktx2::Reader::new(bytes).map_err(damaged)?;
        let header = reader.header();
        let format = header.format.ok_or(
            "its texels are in Basis Universal; write them uncompressed, as BC1 to BC7, or with --zcmp (Zstandard)",
        )?;
        let texels = of_vulkan(format).ok_or_else(|| format!("its format {format:?} cannot be read; {READ}"))?;
        let (depth, faces, array) = (header.pixel_depth, header.face_count.max(1), header.layer_count.max(1));
        let dimension = match (depth, faces) {
            (0, 6) => Dimension::Cube,
            (0, _) => Dimension::D2,
            _ => Dimension::D3,
        };
        let (width, height) = (header.pixel_width, header.pixel_height.max(1));
        let count = u64::from(depth.max(1)) * u64::from(faces) * u64::from(array);
        let layer = checked(width, height, count, texels, room)?;
        let level = reader.levels().next().ok_or("it has no level")?;
        let whole = layer * count as usize;
        let data: Cow<[u8]> = match header.supercompression_scheme {
            None => level.data.into(),
            Some(SupercompressionScheme::Zstandard) => unpacked(level.data, whole)?.into(),
            Some(other) => {
                return Err(format!(
                    "it is packed by {other:?}, which cannot be read; pack it by Zstandard or not at all"
                ));
            }
        };
        if data.len() < whole {
            return Err(format!("its first level should have {whole} bytes, and has {}", data.len()));
        }
        let layers = match data {
            Cow::Owned(mut data) if count == 1 => {
                data.truncate(whole);
                vec![data]
            }
            data => data[..whole].chunks_exact(layer).map(<[u8]>::to_vec).collect(),
        };
        Ok(Self { dimension, width, height, texels, layers })
    }

    fn dds(bytes: &[u8], room: u64) -> Result<Self, String> {
        let dds = Dds::read(bytes).map_err(|error| format!("the DDS file is damaged ({error})"))?;
        let mut surface = match (Surface::from_dds(&dds), Masks::of(bytes)) {
            (Ok(surface), _) => surface,
            (Err(_), Some(masks)) => return Self::masked(&dds, masks, room),
            (Err(_), None) => return Err(format!("its format {} cannot be read; {READ}", dds_format(&dds))),
        };
        // The crate allocates a list for the number of levels in the file.
        surface.mipmaps = surface.mipmaps.clamp(1, levels(surface.width, surface.height, surface.depth));
        let is_cube = dds.header.caps2.contains(Caps2::CUBEMAP)
            || dds.header10.as_ref().is_some_and(|h| h.misc_flag == image_dds::ddsfile::MiscFlag::TEXTURECUBE);
        if is_cube && surface.layers == 1 {
            surface.layers = 6;
        }
        let dimension = match (is_cube, surface.depth) {
            (true, _) => Dimension::Cube,
            (false, 0 | 1) => Dimension::D2,
            (false, _) => Dimension::D3,
        };
        let texels = Stored::Other(surface.image_format);
        let count = u64::from(surface.depth) * u64::from(surface.layers);
        let layer = checked(surface.width, surface.height, count, texels, room)?;
        let mut layers = Vec::new();
        for (n, z) in (0..surface.layers).flat_map(|n| (0..surface.depth).map(move |z| (n, z))) {
            let data = surface.get(n, z, 0).filter(|data| data.len() >= layer);
            let data = data.ok_or_else(|| format!("the file ends before layer {}", n * surface.depth + z))?;
            layers.push(data[..layer].to_vec());
        }
        Ok(Self { dimension, width: surface.width, height: surface.height, texels, layers })
    }

    /// Reads a file of Direct3D 9 without a FourCC: a picture, a volume, or six faces that are each followed by their
    /// mip levels.
    fn masked(dds: &Dds, masks: Masks, room: u64) -> Result<Self, String> {
        let (width, height, depth) = (dds.get_width(), dds.get_height(), dds.get_depth().max(1));
        let is_cube = dds.header.caps2.contains(Caps2::CUBEMAP);
        let (faces, depth) = if is_cube { (6u32, 1) } else { (1, depth) };
        let texels = Stored::Masked(masks);
        let layer = checked(width, height, u64::from(faces) * u64::from(depth), texels, room)?;
        let levels = dds.get_num_mipmap_levels().clamp(1, levels(width, height, depth));
        let level = |n: u32| {
            let side = |side: u32| u64::from((side >> n).max(1));
            side(width) * side(height) * side(depth) * u64::from(masks.bytes)
        };
        let stride: u64 = (0..levels).map(level).sum();
        let mut layers = Vec::new();
        for (face, slice) in (0..u64::from(faces)).flat_map(|face| (0..depth as usize).map(move |slice| (face, slice)))
        {
            let from = usize::try_from(face * stride).map_err(|_| "its faces are too large")? + slice * layer;
            let data = dds.data.get(from..from + layer);
            layers.push(data.ok_or_else(|| format!("the file ends before layer {}", layers.len()))?.to_vec());
        }
        let dimension = match (is_cube, depth) {
            (true, _) => Dimension::Cube,
            (false, 1) => Dimension::D2,
            (false, _) => Dimension::D3,
        };
        Ok(Self { dimension, width, height, texels, layers })
    }

    fn layers(self) -> Result<Vec<Texels>, String> {
        let (width, height) = (self.width, self.height);
        let decode = |layer: Vec<u8>| {
            let bytes = decoded(self.texels, width, height, layer)?;
            Ok(Texels::flat(width, height, self.texels.kept(), bytes))
        };
        self.layers.into_iter().map(decode).collect()
    }
}

/// Returns the number of mip levels down to a single texel.
fn levels(width: u32, height: u32, depth: u32) -> u32 {
    width.max(height).max(depth).max(1).ilog2() + 1
}

const READ: &str = "8-bit and float formats and BC1 to BC7 can be";

/// Checks the size of a texture before memory is allocated, and returns the bytes per layer.
fn checked(width: u32, height: u32, layers: u64, texels: Stored, room: u64) -> Result<usize, String> {
    if width == 0 || height == 0 || layers == 0 {
        return Err("it has no texels".into());
    } else if width.max(height) > limits::PICTURE_SIDE {
        return Err(format!("it has {width}x{height} texels, and the limit per side is {}", limits::PICTURE_SIDE));
    }
    let layer = texels.layer_bytes(width, height);
    let kept = u64::from(width) * u64::from(height) * texels.kept().bytes().max(4);
    let needed = (layer + kept).saturating_mul(layers);
    if needed > room.min(limits::PICTURE_BYTES) {
        return Err(format!("its {layers} layers of {width}x{height} texels take {needed} bytes, which is too much"));
    }
    Ok(layer as usize)
}

/// Decompresses Zstandard (RFC 8878) to at most `size` bytes.
fn unpacked(packed: &[u8], size: usize) -> Result<Vec<u8>, String> {
    let damaged = |error: &dyn std::fmt::Display| format!("its Zstandard data are damaged ({error})");
    let mut decoder = ruzstd::decoding::StreamingDecoder::new(packed).map_err(|e| damaged(&e))?;
    let mut bytes = Vec::with_capacity(size);
    decoder.by_ref().take(size as u64).read_to_end(&mut bytes).map_err(|e| damaged(&e))?;
    Ok(bytes)
}

fn dds_format(dds: &Dds) -> String {
    match (dds.get_dxgi_format(), dds.get_d3d_format(), &dds.header.spf.fourcc) {
        (Some(format), ..) => format!("{format:?}"),
        (_, Some(format), _) => format!("{format:?}"),
        (.., Some(code)) => String::from_utf8_lossy(&code.0.to_le_bytes()).into_owned(),
        _ => "of unknown name".into(),
    }
}

fn of_vulkan(format: Format) -> Option<Stored> {
    use ImageFormat as F;
    Some(Stored::Other(match format {
        Format::R8G8B8_UNORM | Format::R8G8B8_SRGB => return Some(Stored::Rgb8),
        Format::R8_UNORM | Format::R8_SRGB => F::R8Unorm,
        Format::R8G8_UNORM | Format::R8G8_SRGB => F::Rg8Unorm,
        Format::R8G8B8A8_UNORM | Format::R8G8B8A8_SRGB => F::Rgba8Unorm,
        Format::B8G8R8A8_UNORM | Format::B8G8R8A8_SRGB => F::Bgra8Unorm,
        Format::B8G8R8_UNORM | Format::B8G8R8_SRGB => F::Bgr8Unorm,
        Format::R16_SFLOAT => F::R16Float,
        Format::R16G16_SFLOAT => F::Rg16Float,
        Format::R16G16B16A16_SFLOAT => F::Rgba16Float,
        Format::R32_SFLOAT => F::R32Float,
        Format::R32G32_SFLOAT => F::Rg32Float,
        Format::R32G32B32_SFLOAT => F::Rgb32Float,
        Format::R32G32B32A32_SFLOAT => F::Rgba32Float,
        Format::R16_UNORM => F::R16Unorm,
        Format::R16G16_UNORM => F::Rg16Unorm,
        Format::R16G16B16A16_UNORM => F::Rgba16Unorm,
        Format::BC1_RGB_UNORM_BLOCK
        | Format::BC1_RGB_SRGB_BLOCK
        | Format::BC1_RGBA_UNORM_BLOCK
        | Format::BC1_RGBA_SRGB_BLOCK => F::BC1RgbaUnorm,
        Format::BC2_UNORM_BLOCK | Format::BC2_SRGB_BLOCK => F::BC2RgbaUnorm,
        Format::BC3_UNORM_BLOCK | Format::BC3_SRGB_BLOCK => F::BC3RgbaUnorm,
        Format::BC4_UNORM_BLOCK => F::BC4RUnorm,
        Format::BC4_SNORM_BLOCK => F::BC4RSnorm,
        Format::BC5_UNORM_BLOCK => F::BC5RgUnorm,
        Format::BC5_SNORM_BLOCK => F::BC5RgSnorm,
        Format::BC6H_UFLOAT_BLOCK => F::BC6hRgbUfloat,
        Format::BC6H_SFLOAT_BLOCK => F::BC6hRgbSfloat,
        Format::BC7_UNORM_BLOCK | Format::BC7_SRGB_BLOCK => F::BC7RgbaUnorm,
        _ => return None,
    }))
}

/// Decodes the texels of a layer.
fn decoded(stored: Stored, width: u32, height: u32, layer: Vec<u8>) -> Result<Vec<u8>, String> {
    let kept = stored.kept();
    let image_format = match stored {
        Stored::Rgb8 => return Ok(layer.chunks_exact(3).flat_map(|rgb| [rgb[0], rgb[1], rgb[2], 255]).collect()),
        Stored::Masked(masks) => return Ok(masks.decoded(&layer)),
        Stored::Other(format) => format,
    };
    if stored.block() == (1, kept.bytes()) && !is_reordered(image_format) {
        return Ok(layer);
    }
    let surface = Surface { width, height, depth: 1, layers: 1, mipmaps: 1, image_format, data: &*layer };
    let failed = |error: image_dds::error::SurfaceError| format!("its texels cannot be decoded ({error})");
    match kept {
        TexelFormat::Rgba32f => {
            let data = surface.decode_rgbaf32().map_err(failed)?.data;
            // The decoder shows formats of one or two channels as grey. OpenGL reads the missing ones as 0.
            let missing = match image_format {
                ImageFormat::R8Snorm | ImageFormat::BC4RSnorm | ImageFormat::R16Unorm | ImageFormat::R16Snorm => 2,
                ImageFormat::Rg8Snorm | ImageFormat::BC5RgSnorm | ImageFormat::Rg16Unorm | ImageFormat::Rg16Snorm => 1,
                _ => 0,
            };
            let value = |i: usize, value: f32| if (3 - missing..3).contains(&(i % 4)) { 0.0 } else { value };
            Ok(data.iter().enumerate().flat_map(|(i, v)| value(i, *v).to_le_bytes()).collect())
        }
        _ => {
            let data = surface.decode_rgba8().map_err(failed)?.data;
            let channels = kept.components();
            Ok(data.chunks_exact(4).flat_map(|texel| &texel[..channels]).copied().collect())
        }
    }
}

/// Returns whether a format has the size of the decoded one, but its channels in another order.
fn is_reordered(format: ImageFormat) -> bool {
    matches!(format, ImageFormat::Bgra8Unorm | ImageFormat::Bgra8UnormSrgb | ImageFormat::Rgba8Snorm)
}

#[cfg(test)]
mod tests;
