//! One picture as a file.

use super::rgb;
use eddy_engine::Pixels;
use eddy_playback::{
    capture,
    scene::{ATTRIBUTE, Scene},
};
use eddy_texture::TexelFormat;
use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Encoding, FlatSamples, Image, Layer, LayerAttributes, SmallVec, Text,
    WritableImage,
};
use half::f16;
use std::io::{self, Cursor, Seek, Write};

/// The file format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Still {
    /// RGBA with 8 or 16 bits per component, as displayed.
    Png { depth: u32 },
    /// OpenEXR with the unmodified values of the texels, losslessly compressed (ZIP): channels R, G, B and A, or as
    /// many of them as the texels have. Texels of 16-bit floats are written as such, all others as 32-bit floats. The
    /// top row is the first, as everywhere in OpenEXR, so that other programs show the picture upright.
    Exr,
    /// A NumPy array: 32-bit floats, height x width x 4, row 0 at the bottom.
    Npy,
}

impl Still {
    pub fn extension(self) -> &'static str {
        match self {
            Still::Png { .. } => "png",
            Still::Exr => "exr",
            Still::Npy => "npy",
        }
    }

    /// Writes the whole file. `texels` is the format of the texels that were read.
    pub fn write(self, out: &mut (impl Write + Seek), pixels: &Pixels, texels: TexelFormat) -> io::Result<()> {
        match self {
            Still::Png { depth: 8 } => capture::encode(out, pixels, capture::Format::Png),
            Still::Png { depth } => png(out, pixels, depth),
            Still::Npy => capture::encode(out, pixels, capture::Format::Npy),
            Still::Exr => exr(out, pixels, texels, None),
        }
    }
}

impl Still {
    /// Does the same and embeds the scene, if the format supports it.
    pub fn write_scene(
        self,
        out: &mut (impl Write + Seek),
        pixels: &Pixels,
        texels: TexelFormat,
        scene: Option<&Scene>,
    ) -> io::Result<()> {
        match (self, scene) {
            (Still::Png { .. }, Some(scene)) => {
                let mut file = Cursor::new(Vec::new());
                self.write(&mut file, pixels, texels)?;
                out.write_all(&scene.embed(file.into_inner())?)
            }
            (Still::Exr, Some(scene)) => exr(out, pixels, texels, Some(scene.attribute()?)),
            _ => self.write(out, pixels, texels),
        }
    }
}

fn png(out: &mut impl Write, pixels: &Pixels, depth: u32) -> io::Result<()> {
    let mut encoder = png::Encoder::new(out, pixels.width, pixels.height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(if depth == 8 { png::BitDepth::Eight } else { png::BitDepth::Sixteen });
    let mut bytes = Vec::new();
    rgb::write(pixels, 4, depth, u16::to_be_bytes, &mut bytes);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&bytes)?;
    Ok(writer.finish()?)
}

fn exr(out: &mut (impl Write + Seek), pixels: &Pixels, texels: TexelFormat, scene: Option<String>) -> io::Result<()> {
    let rows = || pixels.texels.chunks_exact(pixels.width as usize).rev().flatten();
    let channel = |index: usize| {
        let values = rows().map(|texel| texel[index]);
        let samples = match texels.is_small_float() {
            true => FlatSamples::F16(values.map(f16::from_f32).collect()),
            false => FlatSamples::F32(values.collect()),
        };
        AnyChannel::new(["R", "G", "B", "A"][index], samples)
    };
    let channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = (0..texels.components()).map(channel).collect();
    let size = (pixels.width as usize, pixels.height as usize);
    // ZIP compresses blocks of 16 lines.
    let layer = Layer::new(size, exr_attributes(scene), Encoding::SMALL_LOSSLESS, AnyChannels::sort(channels));
    Image::from_layer(layer).write().non_parallel().to_buffered(out).map_err(exr_failed)
}

/// Returns the attributes of a picture with this scene.
pub(super) fn exr_attributes(scene: Option<String>) -> LayerAttributes {
    let mut attributes = LayerAttributes::default();
    if let Some(scene) = scene {
        attributes.other.insert(Text::from(ATTRIBUTE), AttributeValue::Text(Text::from(scene.as_str())));
    }
    attributes
}

pub(super) fn exr_failed(error: exr::error::Error) -> io::Error {
    match error {
        exr::error::Error::Io(error) => error,
        other => io::Error::other(other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixels() -> Pixels {
        let texels = vec![[1.0, 0.5, -0.25, 1.0], [1e-8, 65_504.0, f32::INFINITY, 0.1], [0.2; 4], [3.5, 0.0, 1.0, 0.0]];
        Pixels { width: 2, height: 2, texels }
    }

    fn file(still: Still, texels: TexelFormat) -> Vec<u8> {
        let mut out = Cursor::new(Vec::new());
        still.write(&mut out, &pixels(), texels).unwrap();
        out.into_inner()
    }

    #[test]
    fn an_exr_has_the_floats_of_the_texels() {
        let bytes = file(Still::Exr, TexelFormat::Rgba32f);
        let image = image::load_from_memory(&bytes).unwrap().into_rgba32f();
        for (x, y, texel) in [(0, 1, 0), (1, 1, 1), (0, 0, 2), (1, 0, 3)] {
            assert_eq!(image.get_pixel(x, y).0, pixels().texels[texel], "{x},{y}");
        }
    }

    #[test]
    fn an_exr_has_the_channels_and_the_width_of_the_texels() {
        use exr::prelude::{ReadChannels, ReadLayers, read};
        for (format, names) in [
            (TexelFormat::Rg16f, &["G", "R"][..]),
            (TexelFormat::R32f, &["R"]),
            (TexelFormat::Rgba8, &["A", "B", "G", "R"]),
        ] {
            let reader =
                read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer().all_attributes();
            let image = reader.from_buffered(Cursor::new(file(Still::Exr, format))).unwrap();
            let channels = &image.layer_data.channel_data.list;
            let found: Vec<String> = channels.iter().map(|channel| channel.name.to_string()).collect();
            assert_eq!(found, names);
            let is_half = |samples: &FlatSamples| matches!(samples, FlatSamples::F16(_));
            assert!(channels.iter().all(|c| is_half(&c.sample_data) == format.is_small_float()), "{format:?}");
            let red = &channels.last().unwrap().sample_data;
            let red: Vec<f32> = red.values_as_f32().collect();
            let stored = |value: f32| if format.is_small_float() { f16::from_f32(value).to_f32() } else { value };
            assert_eq!(red, [0.2, 3.5, 1.0, 1e-8].map(stored));
        }
    }

    #[test]
    fn a_16_bit_png_has_more_levels() {
        let bytes = file(Still::Png { depth: 16 }, TexelFormat::Rgba32f);
        let image = image::load_from_memory(&bytes).unwrap();
        assert_eq!(image.color(), image::ColorType::Rgba16);
        assert_eq!(image.into_rgba16().get_pixel(0, 0).0, [13_107; 4]);
        let eight = file(Still::Png { depth: 8 }, TexelFormat::Rgba32f);
        assert_eq!(image::load_from_memory(&eight).unwrap().into_rgba8().into_raw(), pixels().to_rgba8());
    }
}
