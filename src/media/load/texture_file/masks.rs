//! Texels of DDS files whose channels are bit fields of an integer (Microsoft, DDS_PIXELFORMAT structure): the formats
//! of Direct3D 9 without a FourCC, including luminance and alpha.

use eddy_texture::TexelFormat;
use image_dds::ddsfile::PixelFormatFlags;

/// The bit masks of red, green, blue and alpha.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Masks {
    /// Bytes per texel, 1 to 4.
    pub bytes: u32,
    channels: [u32; 4],
}

impl Masks {
    /// Returns the masks of a file, if it has any. The pixel format is parsed here, as the `ddsfile` crate ignores
    /// masks for luminance.
    pub(super) fn of(file: &[u8]) -> Option<Masks> {
        let field = |at: usize| Some(u32::from_le_bytes(file.get(at..at + 4)?.try_into().ok()?));
        let flags = PixelFormatFlags::from_bits_truncate(field(80)?);
        let has = |flag| flags.intersects(flag);
        let (bits, [red, green, blue, alpha]) = (field(88)?, [field(92)?, field(96)?, field(100)?, field(104)?]);
        let alpha = if has(PixelFormatFlags::ALPHA_PIXELS | PixelFormatFlags::ALPHA) { alpha } else { 0 };
        let channels =
            match (has(PixelFormatFlags::FOURCC), has(PixelFormatFlags::RGB), has(PixelFormatFlags::LUMINANCE)) {
                (false, true, false) => [red, green, blue, alpha],
                (false, false, true) => [red, red, red, alpha],
                (false, false, false) if alpha != 0 => [0, 0, 0, alpha],
                _ => return None,
            };
        if !matches!(bits, 8 | 16 | 24 | 32) {
            return None;
        }
        let all = u32::MAX >> (32 - bits);
        let fits = channels != [0; 4] && channels.iter().all(|mask| mask & !all == 0);
        fits.then_some(Masks { bytes: bits / 8, channels })
    }

    /// Returns the format of the decoded texels: bytes if no channel has more bits.
    pub(super) fn kept(self) -> TexelFormat {
        let most = self.channels.iter().map(|mask| mask.count_ones()).max();
        if most > Some(8) { TexelFormat::Rgba32f } else { TexelFormat::Rgba8 }
    }

    /// Decodes the texels of a layer. A channel without bits is 0, and alpha 1.
    pub(super) fn decoded(self, layer: &[u8]) -> Vec<u8> {
        let kept = self.kept();
        let mut out = Vec::with_capacity(layer.len() / self.bytes as usize * kept.bytes() as usize);
        for texel in layer.chunks_exact(self.bytes as usize) {
            let number = texel.iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte));
            for (channel, mask) in self.channels.into_iter().enumerate() {
                let value = match mask {
                    0 => f64::from(u8::from(channel == 3)),
                    mask => {
                        f64::from((number & mask) >> mask.trailing_zeros()) / f64::from(mask >> mask.trailing_zeros())
                    }
                };
                match kept {
                    TexelFormat::Rgba32f => out.extend((value as f32).to_le_bytes()),
                    _ => out.push((value * 255.0).round() as u8),
                }
            }
        }
        out
    }
}
