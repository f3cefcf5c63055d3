//! One picture, from its file or its generator to texels.

mod apng;
mod kinds;
mod radiance;
#[cfg(test)]
mod tests;

use super::{MediaError, Texels, builtin, error::Excess, npy, played::Played, site};
use eddy_project::{Media, confine, limits, nearest};
use eddy_texture::TexelFormat;
use image::{ColorType, DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits, metadata::Orientation};
use std::{io::Cursor, path::Path};

/// Loads a 2D picture. `vflip`: its top row comes to lie at v = 1. A file lies in the project's folder `base`, see
/// [`confine`]. For a texture of the site, a file of the same name in `media_dir` wins over the built-in fallback.
pub fn load(media: &Media, vflip: bool, base: Option<&Path>, media_dir: Option<&Path>) -> Result<Texels, MediaError> {
    load_within(media, vflip, base, media_dir, limits::MEDIA_BYTES)
}

/// The same where pictures and models may take `room` bytes more.
pub(super) fn load_within(
    media: &Media,
    vflip: bool,
    base: Option<&Path>,
    media_dir: Option<&Path>,
    room: u64,
) -> Result<Texels, MediaError> {
    match media {
        Media::Builtin(name) => {
            let texels = builtin::make(name).ok_or_else(|| MediaError::UnknownBuiltin {
                name: name.clone(),
                near: nearest(name, builtin::names()).map(str::to_owned),
            })?;
            Ok(upright(texels, vflip))
        }
        Media::File(path) => {
            let Some(base) = base else { return Err(MediaError::NoFolder { path: path.clone() }) };
            let bytes = confine::read(base, path, limits::MEDIA_FILE)?;
            decoded(bytes, &base.join(path), vflip, room)
        }
        Media::Picked(path) => decoded(confine::read_own(path, limits::MEDIA_FILE)?, path, vflip, room),
        Media::Site { id, path } => {
            let texture = site::site_texture(id, path);
            let name = path.rsplit('/').next().unwrap_or_default();
            if let Some(found) = media_dir.map(|d| d.join(name)).filter(|p| !name.is_empty() && p.is_file()) {
                let texels = decoded(confine::read_own(&found, limits::MEDIA_FILE)?, &found, vflip, room)?;
                return Ok(if texture.is_some_and(|t| t.is_grey) { red_only(texels) } else { texels });
            }
            let texels = texture
                .and_then(|t| builtin::make(t.fallback))
                .ok_or_else(|| MediaError::NoStandIn { path: path.clone() })?;
            Ok(upright(texels, vflip))
        }
    }
}

/// Built-in textures come with their top row at v = 1.
fn upright(texels: Texels, vflip: bool) -> Texels {
    if vflip { texels } else { flipped(texels) }
}

fn flipped(mut texels: Texels) -> Texels {
    let row = texels.row_bytes();
    let rows = texels.shape.height as usize;
    for y in 0..rows / 2 {
        let (below, above) = texels.bytes.split_at_mut((rows - 1 - y) * row);
        below[y * row..(y + 1) * row].swap_with_slice(&mut above[..row]);
    }
    texels
}

/// Returns the red channel alone, as the site uploads its four grey pictures.
fn red_only(texels: Texels) -> Texels {
    match texels.shape.format {
        TexelFormat::Rgba8 => {
            let red = texels.bytes.iter().copied().step_by(4).collect();
            Texels::flat(texels.shape.width, texels.shape.height, TexelFormat::R8, red)
        }
        _ => texels,
    }
}

/// Decodes the picture file `path`, whose size is looked at first: a few kilobytes can ask for gigabytes.
fn decoded(bytes: Vec<u8>, path: &Path, vflip: bool, room: u64) -> Result<Texels, MediaError> {
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("npy")) {
        return npy::read(&bytes, path, room);
    }
    if let Some(played) = Played::of(&bytes, path) {
        return Err(MediaError::NotPlayed { path: path.to_owned(), played });
    }
    let failed = |source| MediaError::Decode { path: path.to_owned(), source };
    if let Some(kind) = kinds::unread(&bytes) {
        return Err(MediaError::Unread { path: path.to_owned(), kind });
    }
    let radiance = radiance::header(&bytes).transpose();
    let radiance = radiance.map_err(|reason| MediaError::Radiance { path: path.to_owned(), reason })?;
    let bytes = radiance.as_ref().map(|header| header.plain(&bytes)).unwrap_or(bytes);
    let mut reader = ImageReader::new(Cursor::new(&*bytes));
    // The ending counts where the content says nothing, as with TGA.
    if let Ok(format) = ImageFormat::from_path(path) {
        reader.set_format(format);
    }
    let mut reader = reader.with_guessed_format().map_err(|e| failed(e.into()))?;
    let mut allowed = Limits::no_limits();
    allowed.max_alloc = Some(limits::PICTURE_BYTES);
    reader.limits(allowed.clone());
    let format = reader.format();
    let mut decoder = reader.into_decoder().map_err(failed)?;
    let orientation = match (radiance, format) {
        (Some(header), _) => header.orientation,
        // As Chromium has it, which leaves that of a WebP aside.
        (None, Some(ImageFormat::Jpeg | ImageFormat::Png)) => decoder.orientation().map_err(failed)?,
        (None, _) => Orientation::NoTransforms,
    };
    let (width, height) = decoder.dimensions();
    if width == 0 || height == 0 {
        return Err(MediaError::Empty { path: path.to_owned() });
    }
    let is_other_animation = format == Some(ImageFormat::Png) && apng::begins_behind(&bytes);
    let is_float = matches!(decoder.color_type(), ColorType::Rgb32F | ColorType::Rgba32F);
    let texel_format = if is_float { TexelFormat::Rgba32f } else { TexelFormat::Rgba8 };
    // A decoded texel of 16 bits a channel takes more than the one that Eddy keeps.
    let needed = decoder.total_bytes().max(u64::from(width) * u64::from(height) * texel_format.bytes());
    let too_large = |excess| Err(MediaError::TooLarge { path: path.to_owned(), width, height, excess });
    if width.max(height) > limits::PICTURE_SIDE {
        return too_large(Excess::Side);
    } else if needed > limits::PICTURE_BYTES {
        return too_large(Excess::Bytes { bytes: needed });
    } else if needed > room {
        return too_large(Excess::Project);
    }
    let image =
        if is_other_animation { apng::first_frame(&bytes, allowed) } else { DynamicImage::from_decoder(decoder) };
    let mut image = image.map_err(failed)?;
    image.apply_orientation(orientation);
    let texels = texels(image);
    // A picture's first row is its top.
    Ok(if vflip { flipped(texels) } else { texels })
}

/// Texels in the picture's own order of rows. Values as stored: no colour space is undone and alpha is not multiplied
/// in.
fn texels(image: DynamicImage) -> Texels {
    let (width, height) = (image.width(), image.height());
    match image {
        DynamicImage::ImageRgb32F(image) => {
            let mut bytes =
                Vec::with_capacity(width as usize * height as usize * TexelFormat::Rgba32f.bytes() as usize);
            for texel in image.as_raw().chunks_exact(3) {
                bytes.extend_from_slice(bytemuck::bytes_of(&[texel[0], texel[1], texel[2], 1.0]));
            }
            Texels::flat(width, height, TexelFormat::Rgba32f, bytes)
        }
        DynamicImage::ImageRgba32F(image) => {
            let bytes = bytemuck::cast_slice(image.as_raw()).to_vec();
            Texels::flat(width, height, TexelFormat::Rgba32f, bytes)
        }
        _ => Texels::flat(width, height, TexelFormat::Rgba8, image.into_rgba8().into_raw()),
    }
}
