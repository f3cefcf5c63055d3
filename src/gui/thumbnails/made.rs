//! Makes each thumbnail on the thread of thumbnails.

use super::ThumbnailSource;
use crate::project::{confine, limits};
use crate::{
    media::{self, Texels},
    project::{TexelFormat, presets},
};
use egui::{Color32, ColorImage};
use std::{
    io::{Cursor, Read as _},
    path::Path,
};

/// The longest side of a texture's thumbnail.
const SWATCH: usize = 96;
/// The columns and rows of a sound's thumbnail.
const WAVE: (usize, usize) = (96, 64);
/// The number of seconds of a sound that are decoded for its thumbnail.
const WAVE_SECONDS: u32 = 60;
/// The maximum bytes of a recent project's picture, and the maximum pixels of a side.
const RECENT_BYTES: u64 = 1 << 20;
const RECENT_SIDE: u32 = 1024;

pub(super) fn make(subject: &ThumbnailSource) -> Result<ColorImage, String> {
    match subject {
        ThumbnailSource::Preset(name) => preset(name),
        ThumbnailSource::Recent(file, _) => recent(file),
        ThumbnailSource::Texture(key, folder) => {
            let texels = media::load(key, folder.as_deref(), None).map_err(|e| e.to_string())?;
            Ok(swatch(&texels.flattened()))
        }
        ThumbnailSource::Video(media, folder) => {
            let texels = media::first_frame(media, folder.as_deref()).map_err(|e| e.to_string())?;
            Ok(swatch(&texels))
        }
        ThumbnailSource::Sound(media, folder) => {
            let sound = media::sound_preview(media, folder.as_deref(), WAVE_SECONDS).map_err(|e| e.to_string())?;
            Ok(wave(&sound.outline(WAVE.0)))
        }
    }
}

/// Returns a waveform in white, which is tinted where it is shown.
fn wave(outline: &[f32]) -> ColorImage {
    let (width, height) = (outline.len(), WAVE.1);
    let mut image = ColorImage::filled([width, height], Color32::TRANSPARENT);
    for (x, level) in outline.iter().enumerate() {
        let half = (level * (height / 2 - 2) as f32).round() as usize;
        for y in height / 2 - half..=height / 2 + half {
            image.pixels[y * width + x] = Color32::WHITE;
        }
    }
    image
}

/// Returns the built-in picture.
fn preset(name: &str) -> Result<ColorImage, String> {
    let bytes = presets::thumbnail(name).ok_or_else(|| format!("{name} has no thumbnail"))?;
    let image = image::load_from_memory(bytes).map_err(|e| e.to_string())?.to_rgba8();
    let size = [image.width() as usize, image.height() as usize];
    Ok(ColorImage::from_rgba_unmultiplied(size, image.as_raw()))
}

/// Returns the picture of a recent project. Other programs can write to its folder: no more is read than one of Eddy's
/// own pictures has.
fn recent(file: &Path) -> Result<ColorImage, String> {
    let file = confine::open_state(file, limits::MEDIA_FILE).map_err(|e| e.to_string())?;
    let mut bytes = Vec::new();
    file.take(RECENT_BYTES).read_to_end(&mut bytes).map_err(|e| e.to_string())?;
    let mut reader = image::ImageReader::with_format(Cursor::new(bytes), image::ImageFormat::Jpeg);
    let mut limits = image::Limits::default();
    (limits.max_image_width, limits.max_image_height) = (Some(RECENT_SIDE), Some(RECENT_SIDE));
    reader.limits(limits);
    let image = reader.decode().map_err(|e| e.to_string())?.to_rgba8();
    let size = [image.width() as usize, image.height() as usize];
    Ok(ColorImage::from_rgba_unmultiplied(size, image.as_raw()))
}

/// Returns a texture as a small opaque picture, its top row first.
fn swatch(texels: &Texels) -> ColorImage {
    let (width, height) = (texels.shape.width.max(1) as usize, texels.shape.height.max(1) as usize);
    let step = width.max(height).div_ceil(SWATCH).max(1);
    let size = [width.div_ceil(step), height.div_ceil(step)];
    let mut bytes = Vec::with_capacity(size[0] * size[1] * 4);
    for y in 0..size[1] {
        for x in 0..size[0] {
            // Row 0 is the bottom.
            bytes.extend(texel(texels, x * step, height - 1 - y * step));
        }
    }
    ColorImage::from_rgba_unmultiplied(size, &bytes)
}

fn texel(texels: &Texels, x: usize, y: usize) -> [u8; 4] {
    let at = (y * texels.shape.width as usize + x) * texels.texel_bytes();
    let Some(bytes) = texels.bytes.get(at..at + texels.texel_bytes()) else { return [0, 0, 0, 255] };
    match texels.shape.format {
        TexelFormat::R8 => [bytes[0], bytes[0], bytes[0], 255],
        TexelFormat::Rgba8 => [bytes[0], bytes[1], bytes[2], 255],
        TexelFormat::Rgba32f => {
            let channel = |i: usize| {
                let value = bytes[4 * i..4 * i + 4].try_into().map_or(0.0, f32::from_le_bytes);
                (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
            };
            [channel(0), channel(1), channel(2), 255]
        }
        // Pictures are never decoded to other formats.
        _ => [0, 0, 0, 255],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_has_a_picture() {
        for name in presets::names() {
            let image = preset(name).unwrap_or_else(|e| panic!("{name}: {e}"));
            assert_eq!(image.size, [320, 180], "{name}");
        }
        assert!(preset("no-such-preset").is_err());
    }

    #[test]
    fn missing_damaged_and_oversized_recent_pictures_are_rejected() {
        let dir = tempfile::tempdir().unwrap();
        let path = |name: &str| dir.path().join(name);
        let save = |name: &str, side: u32| image::RgbImage::new(side, 4).save(path(name)).unwrap();
        save("good.jpg", 320);
        save("large.jpg", RECENT_SIDE + 1);
        assert_eq!(recent(&path("good.jpg")).unwrap().size, [320, 4]);
        let bytes = std::fs::read(path("good.jpg")).unwrap();
        std::fs::write(path("half.jpg"), &bytes[..bytes.len() / 4]).unwrap();
        std::fs::write(path("none.jpg"), "no picture").unwrap();
        std::fs::write(path("empty.jpg"), "").unwrap();
        for bad in ["missing.jpg", "large.jpg", "half.jpg", "none.jpg", "empty.jpg"] {
            assert!(recent(&path(bad)).is_err(), "{bad}");
        }
    }

    #[test]
    fn waveform_height_matches_loudness() {
        let image = wave(&[0.0, 0.5, 1.0]);
        let lit = |x: usize| (0..WAVE.1).filter(|y| image.pixels[y * 3 + x] == Color32::WHITE).count();
        assert_eq!((image.size, [0, 1, 2].map(lit)), ([3, WAVE.1], [1, 31, 61]));
    }

    #[test]
    fn swatches_are_upright_and_opaque() {
        let bytes = [[1, 2, 3, 0], [4, 5, 6, 0], [7, 8, 9, 0], [10, 11, 12, 0]].concat();
        let image = swatch(&Texels::flat(2, 2, TexelFormat::Rgba8, bytes));
        assert_eq!(image.size, [2, 2]);
        assert_eq!(image.pixels[0].to_array(), [7, 8, 9, 255]);
        let wide = Texels::flat(300, 1, TexelFormat::R8, vec![9; 300]);
        assert_eq!(swatch(&wide).size, [75, 1]);
    }
}
