//! Widens or narrows decoded texels of 1 to 4 components of 8 or 16 bits to four bytes each, in the buffer that they
//! were decoded into, so that a picture is in memory only once.

use crate::Texels;
use eddy_texture::TexelFormat;
use image::{ColorType, ImageDecoder, ImageResult};

/// Returns whether [`read`] supports this colour type.
pub(super) fn fits(color: ColorType) -> bool {
    use ColorType as C;
    matches!(color, C::L8 | C::La8 | C::Rgb8 | C::Rgba8 | C::L16 | C::La16 | C::Rgb16 | C::Rgba16)
}

/// Decodes a picture whose colour type [`fits`]. It takes the memory of the decoded picture, at least 4 bytes per
/// texel, in addition to the decoder's own memory.
pub(super) fn read(decoder: impl ImageDecoder) -> ImageResult<Texels> {
    let (width, height) = decoder.dimensions();
    let color = decoder.color_type();
    let stored = usize::from(color.bytes_per_pixel());
    let count = width as usize * height as usize;
    let mut bytes = vec![0; stored.max(4) * count];
    // Narrow texels are read to the end of the buffer and widened from the first one on; larger ones are narrowed in
    // the same order. So no texel is overwritten before it is read.
    let from = bytes.len() - stored * count;
    decoder.read_image(&mut bytes[from..])?;
    let components = usize::from(color.channel_count());
    if stored > components {
        for n in 0..count {
            let texel = &bytes[from + n * stored..][..stored];
            let mut narrow = [0; 4];
            for (to, value) in narrow.iter_mut().zip(texel.chunks_exact(2)) {
                *to = eight_bits(u16::from_ne_bytes([value[0], value[1]]));
            }
            bytes[4 * n..4 * n + 4].copy_from_slice(&wide(&narrow[..components]));
        }
        bytes.truncate(4 * count);
        bytes.shrink_to_fit();
    } else if components < 4 {
        for n in 0..count {
            let texel = wide(&bytes[from + n * stored..][..stored]);
            bytes[4 * n..4 * n + 4].copy_from_slice(&texel);
        }
    }
    Ok(Texels::flat(width, height, TexelFormat::Rgba8, bytes))
}

/// Returns the nearest value of 8 bits, as the image crate does: 65,535 is 255 times 257.
fn eight_bits(value: u16) -> u8 {
    ((u32::from(value) + 128) / 257) as u8
}

fn wide(texel: &[u8]) -> [u8; 4] {
    match *texel {
        [l] => [l, l, l, 255],
        [l, a] => [l, l, l, a],
        [r, g, b] => [r, g, b, 255],
        [r, g, b, a] => [r, g, b, a],
        _ => unreachable!("texels have 1 to 4 components"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{DynamicImage, ImageFormat, codecs::png::PngDecoder};
    use std::io::Cursor;

    #[test]
    fn conversions_equal_those_of_the_image_crate() {
        let rgba = image::RgbaImage::from_fn(7, 5, |x, y| image::Rgba([x as u8 * 9, y as u8 * 31, 200, 255 - x as u8]));
        let rgba = DynamicImage::from(rgba);
        // It contains every 16-bit value.
        let deep = image::ImageBuffer::<image::Rgba<u16>, _>::from_fn(256, 64, |x, y| {
            image::Rgba([0u16, 1, 2, 3].map(|n| 4 * (256 * y as u16 + x as u16) + n))
        });
        let deep = DynamicImage::from(deep);
        let kinds = [
            rgba.to_luma8().into(),
            rgba.to_luma_alpha8().into(),
            rgba.to_rgb8().into(),
            rgba.clone(),
            deep.to_luma16().into(),
            deep.to_luma_alpha16().into(),
            deep.to_rgb16().into(),
            deep,
        ];
        for image in kinds {
            let mut png = Cursor::new(Vec::new());
            image.write_to(&mut png, ImageFormat::Png).unwrap();
            let decoder = PngDecoder::new(Cursor::new(png.into_inner())).unwrap();
            assert!(fits(decoder.color_type()));
            assert_eq!(read(decoder).unwrap().bytes, image.to_rgba8().into_raw(), "{:?}", image.color());
        }
    }
}
