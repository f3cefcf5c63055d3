//! Decoded texels of 1 to 4 components become four bytes each in the buffer that they were decoded into, so that a picture
//! is in memory once.

use crate::Texels;
use eddy_texture::TexelFormat;
use image::{ColorType, ImageDecoder, ImageResult};

/// Returns whether [`read`] reads texels of a kind.
pub(super) fn fits(color: ColorType) -> bool {
    color.bytes_per_pixel() <= 4 && matches!(color, ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8)
}

/// Decodes a picture whose texels [`fits`] says are read. The memory is that of the result, and what the decoder itself
/// takes.
pub(super) fn read(decoder: impl ImageDecoder) -> ImageResult<Texels> {
    let (width, height) = decoder.dimensions();
    let components = usize::from(decoder.color_type().bytes_per_pixel());
    let count = width as usize * height as usize;
    let mut bytes = vec![0; 4 * count];
    // At the end of the buffer: a texel is never written over one that is still to be read.
    let from = (4 - components) * count;
    decoder.read_image(&mut bytes[from..])?;
    if components < 4 {
        for n in 0..count {
            let texel = &bytes[from + n * components..][..components];
            let wide = match *texel {
                [l] => [l, l, l, 255],
                [l, a] => [l, l, l, a],
                [r, g, b] => [r, g, b, 255],
                _ => unreachable!("texels of four components stay"),
            };
            bytes[4 * n..4 * n + 4].copy_from_slice(&wide);
        }
    }
    Ok(Texels::flat(width, height, TexelFormat::Rgba8, bytes))
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{DynamicImage, ImageFormat, codecs::png::PngDecoder};
    use std::io::Cursor;

    #[test]
    fn every_number_of_components_gives_the_texels_of_the_image_crate() {
        let rgba = image::RgbaImage::from_fn(7, 5, |x, y| image::Rgba([x as u8 * 9, y as u8 * 31, 200, 255 - x as u8]));
        let rgba = DynamicImage::from(rgba);
        let kinds = [rgba.to_luma8().into(), rgba.to_luma_alpha8().into(), rgba.to_rgb8().into(), rgba.clone()];
        for image in kinds {
            let mut png = Cursor::new(Vec::new());
            image.write_to(&mut png, ImageFormat::Png).unwrap();
            let decoder = PngDecoder::new(Cursor::new(png.into_inner())).unwrap();
            assert!(fits(decoder.color_type()));
            assert_eq!(read(decoder).unwrap().bytes, image.to_rgba8().into_raw(), "{:?}", image.color());
        }
    }
}
