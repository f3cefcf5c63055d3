//! One picture, from its file or its generator to texels.

use super::{TexelFormat, Texels, builtin, site};
use crate::project::{Media, listed, nearest};
use image::{DynamicImage, ImageError, ImageReader};
use std::{
    io,
    path::{Path, PathBuf},
};

/// Why a picture is not to be had. Its text is complete but for the pass and the channel.
#[derive(Debug, thiserror::Error)]
pub enum MediaError {
    #[error("cannot read {}: {source}", path.display())]
    Io { path: PathBuf, source: io::Error },
    #[error("{}: {}", path.display(), reason(source))]
    Decode { path: PathBuf, source: ImageError },
    #[error("{}: {reason}", path.display())]
    Npy { path: PathBuf, reason: String },
    #[error("{}: the picture has no texels", path.display())]
    Empty { path: PathBuf },
    #[error("{} is relative, and the project has no folder yet to start from", path.display())]
    NoFolder { path: PathBuf },
    #[error("there is no built-in texture {name}{}", near.as_ref().map(|n| format!(" (did you mean {n}?)")).unwrap_or_default())]
    UnknownBuiltin { name: String, near: Option<String> },
    #[error("the site's {path} has no stand-in")]
    NoStandIn { path: String },
}

fn reason(error: &ImageError) -> String {
    match error {
        ImageError::Limits(_) => format!("the picture needs more memory than decoding may take ({error})"),
        ImageError::Unsupported(_) => format!("not a picture of a known kind ({error}); known are {}", listed(&KNOWN)),
        ImageError::IoError(e) if e.kind() == io::ErrorKind::UnexpectedEof => "the picture is cut short".into(),
        _ => format!("the picture is damaged ({error})"),
    }
}

const KNOWN: [&str; 8] = ["PNG", "JPEG", "WebP", "BMP", "TGA", "GIF", "HDR", "NPY"];

impl MediaError {
    /// How to mend it.
    pub fn hint(&self) -> String {
        match self {
            MediaError::Io { source, .. } if source.kind() == io::ErrorKind::NotFound => {
                "put the picture there, or name another".into()
            }
            MediaError::Io { .. } => "check the file's permissions".into(),
            MediaError::Decode { source: ImageError::Limits(_), .. } => "scale the picture down".into(),
            MediaError::Decode { .. } | MediaError::Empty { .. } => "save the picture anew, for instance as PNG".into(),
            MediaError::Npy { .. } => {
                "write it with numpy.save: float32, float64 or uint8, shape (height, width) or (height, width, 1 to 4)"
                    .into()
            }
            MediaError::NoFolder { .. } => "save the project first, or name the picture by its whole path".into(),
            MediaError::UnknownBuiltin { .. } => format!("there are {}", listed(&builtin::names())),
            MediaError::NoStandIn { .. } => "put a file of that name into a folder and name it with --media".into(),
        }
    }
}

/// Loads a 2D picture. `vflip`: its top row comes to lie at v = 1. A relative file starts from `base`. For a stock file of
/// the site, a file of the same name in `media_dir` wins over the built-in stand-in.
pub fn load(media: &Media, vflip: bool, base: Option<&Path>, media_dir: Option<&Path>) -> Result<Texels, MediaError> {
    match media {
        Media::Builtin(name) => {
            let texels = builtin::make(name).ok_or_else(|| MediaError::UnknownBuiltin {
                name: name.clone(),
                near: nearest(name, builtin::names()).map(str::to_owned),
            })?;
            Ok(upright(texels, vflip))
        }
        Media::File(path) => {
            let path = match base {
                _ if path.is_absolute() => path.clone(),
                Some(base) => base.join(path),
                None => return Err(MediaError::NoFolder { path: path.clone() }),
            };
            file(&path, vflip)
        }
        Media::Site { id, path } => {
            let stock = site::stock(id, path);
            let name = path.rsplit('/').next().unwrap_or_default();
            if let Some(found) = media_dir.map(|d| d.join(name)).filter(|p| !name.is_empty() && p.is_file()) {
                let texels = file(&found, vflip)?;
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
    texels.bytes = texels.bytes.chunks_exact(row).rev().flatten().copied().collect();
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

fn file(path: &Path, vflip: bool) -> Result<Texels, MediaError> {
    let io = |source| MediaError::Io { path: path.to_owned(), source };
    if path.is_dir() {
        return Err(io(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder, not a picture")));
    }
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("npy")) {
        return super::npy::read(path);
    }
    // The reader's own limits hold (512 MiB of memory), so that a small file cannot ask for all there is.
    let reader = ImageReader::open(path).and_then(ImageReader::with_guessed_format).map_err(io)?;
    let image = reader.decode().map_err(|source| MediaError::Decode { path: path.to_owned(), source })?;
    if image.width() == 0 || image.height() == 0 {
        return Err(MediaError::Empty { path: path.to_owned() });
    }
    let texels = texels(image);
    // A picture's first row is its top.
    Ok(if vflip { flipped(texels) } else { texels })
}

/// Texels in the picture's own order of rows. Values as stored: no colour space is undone and alpha is not multiplied in.
fn texels(image: DynamicImage) -> Texels {
    let (width, height) = (image.width(), image.height());
    match image {
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => {
            let floats = image.into_rgba32f().into_raw();
            Texels { width, height, format: TexelFormat::Rgba32Float, bytes: bytemuck::cast_slice(&floats).to_vec() }
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
            (write("large.png", &with_size(20000, 20000)), "more memory"),
            (dir.path().join("missing.png"), "cannot read"),
            (dir.path().to_owned(), "folder"),
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
