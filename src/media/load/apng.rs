//! Animated PNGs whose first frame differs from the default image for readers without support for animations.

use image::{AnimationDecoder, DynamicImage, ImageError, ImageResult, Limits, codecs::png::PngDecoder};
use std::io::Cursor;

/// Returns whether the default image of an animated PNG is not part of its animation: it has one, but there is no frame
/// control before it (PNG specification, third edition, section 11.3.6.2).
pub(super) fn begins_behind(png: &[u8]) -> bool {
    const SIGNATURE: usize = 8;
    let (mut at, mut is_animated) = (SIGNATURE, false);
    while let Some([a, b, c, d, kind @ ..]) = png.get(at..).and_then(|rest| rest.first_chunk::<8>()) {
        match kind {
            b"acTL" => is_animated = true,
            b"fcTL" => return false,
            b"IDAT" => return is_animated,
            _ => {}
        }
        // Its length, its type, its content and a checksum.
        at = at.saturating_add(u32::from_be_bytes([*a, *b, *c, *d]) as usize).saturating_add(12);
    }
    false
}

/// Returns the first frame of an animation, which a browser uploads to a texture.
pub(super) fn first_frame(png: &[u8], limits: Limits) -> ImageResult<DynamicImage> {
    let frames = PngDecoder::with_limits(Cursor::new(png), limits)?.apng()?.into_frames();
    let cut = || ImageError::IoError(std::io::ErrorKind::UnexpectedEof.into());
    Ok(frames.into_iter().next().ok_or_else(cut)??.into_buffer().into())
}
