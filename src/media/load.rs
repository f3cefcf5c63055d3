//! One picture, from its file or its generator to texels.

use super::{MediaError, TexelFormat, Texels, builtin, error::Excess, npy, site};
use crate::project::{Media, confine, limits, nearest};
use image::{ColorType, DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use std::{io::Cursor, path::Path};

/// Loads a 2D picture. `vflip`: its top row comes to lie at v = 1. A file lies in the project's folder `base`, see
/// [`confine`]. For a stock file of the site, a file of the same name in `media_dir` wins over the built-in stand-in.
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
            let stock = site::stock(id, path);
            let name = path.rsplit('/').next().unwrap_or_default();
            if let Some(found) = media_dir.map(|d| d.join(name)).filter(|p| !name.is_empty() && p.is_file()) {
                let texels = decoded(confine::read_own(&found, limits::MEDIA_FILE)?, &found, vflip, room)?;
                return Ok(if stock.is_some_and(|s| s.is_grey) { red_only(texels) } else { texels });
            }
            let texels = stock
                .and_then(|s| builtin::make(s.stand_in))
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
    let row = texels.width as usize * texels.format.bytes();
    let rows = texels.height as usize;
    for y in 0..rows / 2 {
        let (below, above) = texels.bytes.split_at_mut((rows - 1 - y) * row);
        below[y * row..(y + 1) * row].swap_with_slice(&mut above[..row]);
    }
    texels
}

/// As the site uploads its four grey pictures: the red channel alone.
fn red_only(texels: Texels) -> Texels {
    match texels.format {
        TexelFormat::Rgba8 => {
            Texels { bytes: texels.bytes.iter().copied().step_by(4).collect(), format: TexelFormat::R8, ..texels }
        }
        TexelFormat::R8 | TexelFormat::Rgba32Float => texels,
    }
}

/// Decodes the picture file `path`, whose size is looked at first: a few kilobytes can ask for gigabytes.
fn decoded(bytes: Vec<u8>, path: &Path, vflip: bool, room: u64) -> Result<Texels, MediaError> {
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("npy")) {
        return npy::read(&bytes, path, room);
    }
    let failed = |source| MediaError::Decode { path: path.to_owned(), source };
    let mut reader = ImageReader::new(Cursor::new(bytes));
    // The ending counts where the content says nothing, as with TGA.
    if let Ok(format) = ImageFormat::from_path(path) {
        reader.set_format(format);
    }
    let mut reader = reader.with_guessed_format().map_err(|e| failed(e.into()))?;
    let mut allowed = Limits::no_limits();
    allowed.max_alloc = Some(limits::PICTURE_BYTES);
    reader.limits(allowed);
    let decoder = reader.into_decoder().map_err(failed)?;
    let (width, height) = decoder.dimensions();
    if width == 0 || height == 0 {
        return Err(MediaError::Empty { path: path.to_owned() });
    }
    let is_float = matches!(decoder.color_type(), ColorType::Rgb32F | ColorType::Rgba32F);
    let format = if is_float { TexelFormat::Rgba32Float } else { TexelFormat::Rgba8 };
    // A decoded texel of 16 bits a channel takes more than the one that Eddy keeps.
    let bytes = decoder.total_bytes().max(u64::from(width) * u64::from(height) * format.bytes() as u64);
    let too_large = |excess| Err(MediaError::TooLarge { path: path.to_owned(), width, height, excess });
    if width.max(height) > limits::PICTURE_SIDE {
        return too_large(Excess::Side);
    } else if bytes > limits::PICTURE_BYTES {
        return too_large(Excess::Bytes { bytes });
    } else if bytes > room {
        return too_large(Excess::Project);
    }
    let texels = texels(DynamicImage::from_decoder(decoder).map_err(failed)?);
    // A picture's first row is its top.
    Ok(if vflip { flipped(texels) } else { texels })
}

/// Texels in the picture's own order of rows. Values as stored: no colour space is undone and alpha is not multiplied
/// in.
fn texels(image: DynamicImage) -> Texels {
    let (width, height) = (image.width(), image.height());
    match image {
        DynamicImage::ImageRgb32F(image) => {
            let mut bytes = Vec::with_capacity(width as usize * height as usize * TexelFormat::Rgba32Float.bytes());
            for texel in image.as_raw().chunks_exact(3) {
                bytes.extend_from_slice(bytemuck::bytes_of(&[texel[0], texel[1], texel[2], 1.0]));
            }
            Texels { width, height, format: TexelFormat::Rgba32Float, bytes }
        }
        DynamicImage::ImageRgba32F(image) => {
            let bytes = bytemuck::cast_slice(image.as_raw()).to_vec();
            Texels { width, height, format: TexelFormat::Rgba32Float, bytes }
        }
        _ => Texels { width, height, format: TexelFormat::Rgba8, bytes: image.into_rgba8().into_raw() },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{ImageBuffer, Luma, Rgb, Rgba};

    fn load_file(path: &Path, vflip: bool) -> Result<Texels, MediaError> {
        load(&Media::File(path.file_name().unwrap().into()), vflip, path.parent(), None)
    }

    #[test]
    fn vflip_puts_the_top_row_at_v_one_and_no_value_is_changed() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.png");
        let pixels = vec![1, 2, 3, 4, 128, 129, 130, 0, 250, 251, 252, 253, 9, 8, 7, 6];
        ImageBuffer::<Rgba<u8>, _>::from_raw(2, 2, pixels.clone()).unwrap().save(&path).unwrap();
        let plain = load_file(&path, false).unwrap();
        assert_eq!((plain.width, plain.height, plain.format), (2, 2, TexelFormat::Rgba8));
        assert_eq!(plain.bytes, pixels);
        let flipped = load_file(&path, true).unwrap();
        assert_eq!(flipped.bytes, [&pixels[8..], &pixels[..8]].concat());
    }

    #[test]
    fn a_grey_file_is_still_rgba_and_sixteen_bits_become_eight() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("grey.png");
        ImageBuffer::<Luma<u16>, _>::from_raw(2, 1, vec![0x8080u16, 0xffff]).unwrap().save(&path).unwrap();
        assert_eq!(load_file(&path, false).unwrap().bytes, [128, 128, 128, 255, 255, 255, 255, 255]);
    }

    #[test]
    fn a_high_dynamic_range_picture_keeps_values_above_one() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.hdr");
        ImageBuffer::<Rgb<f32>, _>::from_raw(1, 1, vec![4.0f32, 0.5, 0.25]).unwrap().save(&path).unwrap();
        let texels = load_file(&path, true).unwrap();
        assert_eq!(texels.format, TexelFormat::Rgba32Float);
        assert_eq!(bytemuck::pod_collect_to_vec::<u8, f32>(&texels.bytes), [4.0, 0.5, 0.25, 1.0]);
    }

    #[test]
    fn broken_pictures_are_clear_errors() {
        let dir = tempfile::tempdir().unwrap();
        let write = |name: &str, bytes: &[u8]| {
            let path = dir.path().join(name);
            std::fs::write(&path, bytes).unwrap();
            path
        };
        std::fs::create_dir(dir.path().join("sub")).unwrap();
        let good = dir.path().join("good.png");
        ImageBuffer::<Rgba<u8>, _>::from_pixel(64, 64, Rgba([1u8, 2, 3, 4])).save(&good).unwrap();
        let whole = std::fs::read(&good).unwrap();
        // Width 0 and width 2^31-1 in the header, with its checksum made right.
        let with_size = |width: u32, height: u32| {
            let mut bytes = whole.clone();
            bytes[16..20].copy_from_slice(&width.to_be_bytes());
            bytes[20..24].copy_from_slice(&height.to_be_bytes());
            let crc = crc32(&bytes[12..29]);
            bytes[29..33].copy_from_slice(&crc.to_be_bytes());
            bytes
        };
        for (path, expected) in [
            (write("cut.png", &whole[..whole.len() / 2]), "cut.png"),
            (write("empty.png", b""), "cut short"),
            (write("text.png", b"hello, this is no picture at all"), "damaged"),
            (write("notes.txt", b"hello, this is no picture at all"), "not a picture of a known kind"),
            (write("zero.png", &with_size(0, 64)), "zero.png"),
            (write("huge.png", &with_size(0x7fff_ffff, 0x7fff_ffff)), "huge.png"),
            (
                write("large.png", &with_size(20000, 20000)),
                "large.png: the picture has 20000x20000 texels, which take 1600000000 bytes; a picture may take 512 \
                MiB",
            ),
            (write("long.png", &with_size(40000, 2)), "40000x2 texels, and a side may have 32768"),
            (dir.path().join("missing.png"), "cannot read"),
            (dir.path().join("sub"), "folder"),
        ] {
            let error = load_file(&path, false).expect_err(expected);
            assert!(error.to_string().contains(expected), "{path:?}: {error}");
            assert!(!error.hint().is_empty());
        }
    }

    fn crc32(bytes: &[u8]) -> u32 {
        !bytes.iter().fold(!0u32, |crc, b| {
            (0..8).fold(crc ^ u32::from(*b), |c, _| if c & 1 == 1 { 0xedb8_8320 ^ (c >> 1) } else { c >> 1 })
        })
    }

    #[test]
    fn a_file_of_the_sites_name_wins_over_the_stand_in_and_grey_ids_are_one_channel() {
        let dir = tempfile::tempdir().unwrap();
        let grey = Media::Site { id: "4sf3Rn".into(), path: "/media/a/0a40.png".into() };
        let stand_in = load(&grey, true, None, None).unwrap();
        assert_eq!((stand_in.width, stand_in.height, stand_in.format), (64, 64, TexelFormat::R8));
        ImageBuffer::<Rgba<u8>, _>::from_pixel(3, 1, Rgba([7u8, 2, 3, 4])).save(dir.path().join("0a40.png")).unwrap();
        let own = load(&grey, true, None, Some(dir.path())).unwrap();
        assert_eq!((own.width, own.height, own.format, own.bytes), (3, 1, TexelFormat::R8, vec![7, 7, 7]));
        let unknown = Media::Site { id: "zzz".into(), path: "/media/a/unknown.jpg".into() };
        assert!(matches!(load(&unknown, true, None, Some(dir.path())), Err(MediaError::NoStandIn { .. })));
    }

    #[test]
    fn an_unknown_built_in_names_the_nearest() {
        let error = load(&Media::Builtin("noise-rgb-256".into()), true, None, None).unwrap_err();
        assert!(error.to_string().contains("noise-rgba-256"), "{error}");
        assert!(matches!(load(&Media::File("a.png".into()), true, None, None), Err(MediaError::NoFolder { .. })));
    }
}
