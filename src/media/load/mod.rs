//! Loads one picture, cubemap or volume from its files, or generates it.

mod apng;
pub(crate) mod cube;
mod exr;
mod kinds;
mod radiance;
mod rows;
#[cfg(test)]
mod tests;
mod texture_file;
mod volume;

use super::{MediaError, MediaKey, Texels, builtin, error::Excess, npy, played::Played, site};
use eddy_project::{FileError, Media, confine, face_file, limits, nearest, next_numbered};
use eddy_texture::Dimension;
use eddy_texture::TexelFormat;
use image::{ColorType, DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits, metadata::Orientation};
use std::{io::Cursor, path::Path};

/// Loads the media of a key. A file is in the project's folder `base`, see [`confine`]. For a file of Shadertoy, one of
/// the same name in `media_dir` takes precedence over the built-in fallback.
pub fn load(key: &MediaKey, base: Option<&Path>, media_dir: Option<&Path>) -> Result<Texels, MediaError> {
    load_within(key, base, media_dir, limits::MEDIA_BYTES)
}

/// Does the same, but pictures and models may take `room` bytes more.
pub(super) fn load_within(
    key: &MediaKey,
    base: Option<&Path>,
    media_dir: Option<&Path>,
    room: u64,
) -> Result<Texels, MediaError> {
    let MediaKey { media, dimension, vflip } = key;
    let (dimension, vflip) = (*dimension, *vflip);
    match media {
        Media::Builtin(name) => builtin::make(name, dimension, vflip).ok_or_else(|| MediaError::UnknownBuiltin {
            name: name.clone(),
            near: nearest(name, builtin::names(dimension)).map(str::to_owned),
            dimension,
        }),
        Media::File(path) => {
            let Some(base) = base else { return Err(MediaError::NoFolder { path: path.clone() }) };
            let read = |path: &Path| confine::read(base, path, limits::MEDIA_FILE);
            Source { path, shown: &base.join(path), read: &read, room }.load(dimension, vflip)
        }
        Media::Picked(path) => Source { path, shown: path, read: &read_own, room }.load(dimension, vflip),
        Media::Site { id, path } => {
            let file = site::site_file(id, path);
            let name = path.rsplit('/').next().unwrap_or_default();
            if let Some(found) = media_dir.map(|d| d.join(name)).filter(|p| !name.is_empty() && p.is_file()) {
                let texels = Source { path: &found, shown: &found, read: &read_own, room }.load(dimension, vflip)?;
                return Ok(if file.is_some_and(|t| t.is_grey) { red_only(texels) } else { texels });
            }
            file.and_then(|t| builtin::make(t.fallback, dimension, vflip))
                .ok_or_else(|| MediaError::NoStandIn { path: path.clone() })
        }
    }
}

fn read_own(path: &Path) -> Result<Vec<u8>, FileError> {
    confine::read_own(path, limits::MEDIA_FILE)
}

/// A file to load, and access to it and to the files next to it.
struct Source<'a> {
    path: &'a Path,
    /// The path that messages show.
    shown: &'a Path,
    read: &'a dyn Fn(&Path) -> Result<Vec<u8>, FileError>,
    room: u64,
}

impl Source<'_> {
    fn load(&self, dimension: Dimension, vflip: bool) -> Result<Texels, MediaError> {
        let bytes = (self.read)(self.path)?;
        if let Some(kind) = texture_file::kind(&bytes) {
            let failed = |reason| MediaError::TextureFile { path: self.shown.to_owned(), kind, reason };
            return texture_file::read(&bytes, dimension, vflip, self.room).map_err(failed);
        }
        match dimension {
            Dimension::D2 => decoded(bytes, self.shown, vflip, self.room),
            Dimension::Cube => self.cube(bytes, vflip),
            Dimension::D3 => self.volume(bytes),
        }
    }

    /// Loads a volume in Shadertoy's format, or a stack of pictures with consecutive numbers, of which this is the
    /// first.
    fn volume(&self, first: Vec<u8>) -> Result<Texels, MediaError> {
        let failed = |reason| MediaError::Volume { path: self.shown.to_owned(), reason };
        if image::guess_format(&first).is_err() {
            return volume::read(&first, self.room).map_err(failed);
        }
        let (mut slices, mut path, mut room) = (Vec::new(), self.path.to_owned(), self.room / 2);
        let mut bytes = first;
        loop {
            let shown = self.shown.with_file_name(path.file_name().unwrap_or_default());
            let slice = decoded(bytes, &shown, true, room)?;
            room -= (slice.bytes.len() as u64).min(room);
            slices.push(slice);
            let Some(next) = next_numbered(&path).filter(|_| slices.len() < limits::VOLUME_SIDE as usize) else {
                break;
            };
            match (self.read)(&next) {
                Ok(read) => (bytes, path) = (read, next),
                Err(_) => break,
            }
        }
        volume::of_slices(slices, self.room / 2).map_err(failed)
    }

    /// Loads six files if there is one next to this with `_1` before its extension, as Shadertoy names them; otherwise
    /// the layout of this one.
    fn cube(&self, first: Vec<u8>, vflip: bool) -> Result<Texels, MediaError> {
        let failed = |reason| MediaError::Cubemap { path: self.shown.to_owned(), reason };
        let picture = |bytes, shown: &Path| decoded(bytes, shown, false, self.room / 2);
        let second = match (self.read)(&face_file(self.path, 1)) {
            Ok(bytes) => bytes,
            Err(_) => return cube::of_picture(picture(first, self.shown)?, vflip).map_err(failed),
        };
        let mut faces = vec![picture(first, self.shown)?, picture(second, &face_file(self.shown, 1))?];
        for n in 2..6 {
            let bytes = (self.read)(&face_file(self.path, n))?;
            faces.push(picture(bytes, &face_file(self.shown, n))?);
        }
        let faces: [Texels; 6] = faces.try_into().expect("two and four are six");
        cube::of_faces(faces, vflip).map_err(failed)
    }
}

/// Reverses the order of the rows in each layer.
pub(crate) fn flipped(mut texels: Texels) -> Texels {
    let row = texels.row_bytes();
    let rows = texels.shape.height as usize;
    for y in 0..rows / 2 {
        let (below, above) = texels.bytes.split_at_mut((rows - 1 - y) * row);
        below[y * row..(y + 1) * row].swap_with_slice(&mut above[..row]);
    }
    texels
}

/// Returns only the red channel, as Shadertoy uploads its four grey pictures.
fn red_only(texels: Texels) -> Texels {
    match texels.shape.format {
        TexelFormat::Rgba8 => {
            let red = texels.bytes.iter().copied().step_by(4).collect();
            Texels::flat(texels.shape.width, texels.shape.height, TexelFormat::R8, red)
        }
        _ => texels,
    }
}

/// Decodes the picture file `path`. Its size is checked first: a few kilobytes may decode to gigabytes.
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
    if exr::is_exr(&bytes) {
        let texels = exr::read(&bytes, path, room)?;
        return Ok(if vflip { flipped(texels) } else { texels });
    }
    let radiance = radiance::header(&bytes).transpose();
    let radiance = radiance.map_err(|reason| MediaError::Radiance { path: path.to_owned(), reason })?;
    let bytes = radiance.as_ref().map(|header| header.plain(&bytes)).unwrap_or(bytes);
    let mut reader = ImageReader::new(Cursor::new(&*bytes));
    // The extension counts if the content is ambiguous, as with TGA. The other formats start with bytes of their own.
    if let Ok(format) = ImageFormat::from_path(path) {
        if format != ImageFormat::Tga && !bytes.is_empty() && image::guess_format(&bytes).is_err() {
            return Err(MediaError::OtherContent { path: path.to_owned() });
        }
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
        // As in Chromium, which ignores the orientation of a WebP.
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
    // A decoded texel of 16 bits per channel takes more memory than the final one.
    let needed = decoder.total_bytes().max(u64::from(width) * u64::from(height) * texel_format.bytes());
    let too_large = |excess| Err(MediaError::TooLarge { path: path.to_owned(), width, height, excess });
    if width.max(height) > limits::PICTURE_SIDE {
        return too_large(Excess::Side);
    } else if needed > limits::PICTURE_BYTES {
        return too_large(Excess::Bytes { bytes: needed });
    } else if needed > room {
        return too_large(Excess::Project);
    }
    if !is_other_animation && orientation == Orientation::NoTransforms && rows::fits(decoder.color_type()) {
        let texels = rows::read(decoder).map_err(failed)?;
        return Ok(if vflip { flipped(texels) } else { texels });
    }
    let image =
        if is_other_animation { apng::first_frame(&bytes, allowed) } else { DynamicImage::from_decoder(decoder) };
    let mut image = image.map_err(failed)?;
    image.apply_orientation(orientation);
    let texels = texels(image);
    // A picture's first row is its top.
    Ok(if vflip { flipped(texels) } else { texels })
}

/// Returns the texels in the picture's own order of rows. Values are as stored: they are neither linearised nor
/// multiplied by alpha.
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
