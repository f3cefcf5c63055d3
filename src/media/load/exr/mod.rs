//! OpenEXR pictures ("The OpenEXR File Layout"). The channels of the picture are chosen by "Technical Introduction to
//! OpenEXR", sections Channel Names and Layers: R, G, B and A, or Y for luminance, after the name of a layer and a
//! point if there is one.

use super::Excess;
use crate::{MediaError, Texels};
use eddy_project::{limits, listed};
use eddy_texture::TexelFormat;
use exr::{
    error::Error,
    math::Vec2,
    meta::{MetaData, header::Header},
    prelude::{ReadChannels, ReadLayers, ReadSpecificChannel, Text, read as reader},
};
use std::{collections::BTreeMap, io::Cursor, path::Path};

const MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// The maximum number of channels in a message.
const SHOWN: usize = 12;

pub(super) fn is_exr(bytes: &[u8]) -> bool {
    bytes.starts_with(&MAGIC)
}

/// The channels that are read, and their meaning.
#[derive(Debug, PartialEq)]
enum Chosen {
    /// The names of red, green, blue and alpha. A colour that the file lacks is 0, a missing alpha 1.
    Color([Text; 4]),
    /// A channel that is shown as grey, and the name of alpha.
    Grey(Text, Text),
}

/// Reads a picture, top row first, as floats. Pixels are placed in the display window; parts of it that the file lacks
/// are 0.
pub(super) fn read(bytes: &[u8], path: &Path, room: u64) -> Result<Texels, MediaError> {
    let failed = |reason: String| MediaError::Exr { path: path.to_owned(), reason };
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(|error| failed(reason(&error)))?;
    let (part, chosen) = chosen(&meta.headers).ok_or_else(|| failed(unread(&meta.headers)))?;
    let part = &meta.headers[part];
    if is_subsampled(part) {
        return Err(failed(unread(&meta.headers)));
    }
    let window = part.shared_attributes.display_window;
    let side = |side: usize| u32::try_from(side).unwrap_or(u32::MAX);
    let (width, height) = (side(window.size.width()), side(window.size.height()));
    if width == 0 || height == 0 {
        return Err(MediaError::Empty { path: path.to_owned() });
    }
    let needed = u64::from(width) * u64::from(height) * TexelFormat::Rgba32f.bytes();
    let too_large = |excess| Err(MediaError::TooLarge { path: path.to_owned(), width, height, excess });
    if width.max(height) > limits::PICTURE_SIDE {
        return too_large(Excess::Side);
    } else if needed > limits::PICTURE_BYTES {
        return too_large(Excess::Bytes { bytes: needed });
    } else if needed > room {
        return too_large(Excess::Project);
    }
    let picture = Picture {
        width: width as usize,
        height: height as usize,
        offset: part.own_attributes.layer_position - window.position,
    };
    let texels = picture.read(bytes, part, chosen).map_err(|error| failed(reason(&error)))?;
    Ok(Texels::flat(width, height, TexelFormat::Rgba32f, bytemuck::cast_slice(&texels).to_vec()))
}

/// The position of a part's pixels in the picture.
#[derive(Clone, Copy)]
struct Picture {
    width: usize,
    height: usize,
    offset: Vec2<i32>,
}

impl Picture {
    fn read(self, bytes: &[u8], part: &Header, chosen: Chosen) -> Result<Vec<f32>, Error> {
        let texels = || vec![0.0f32; self.width * self.height * 4];
        let flat = || reader().no_deep_data().largest_resolution_level();
        let bytes = Cursor::new(bytes);
        match chosen {
            Chosen::Color(names) => {
                let set = move |texels: &mut Vec<f32>, at: Vec2<usize>, (r, g, b, a): (f32, f32, f32, f32)| {
                    self.put(texels, at, [r, g, b, a]);
                };
                let [r, g, b, a] = names;
                let channels = flat().specific_channels().optional(r, 0.0f32).optional(g, 0.0f32).optional(b, 0.0f32);
                let channels = channels.optional(a, 1.0f32).collect_pixels(|_, _| texels(), set);
                let image = OfPart { part, channels }.first_valid_layer().all_attributes();
                let image = image.non_parallel().from_buffered(bytes)?;
                Ok(image.layer_data.channel_data.pixels)
            }
            Chosen::Grey(name, a) => {
                let set = move |texels: &mut Vec<f32>, at: Vec2<usize>, (y, a): (f32, f32)| {
                    self.put(texels, at, [y, y, y, a]);
                };
                let channels =
                    flat().specific_channels().required(name).optional(a, 1.0f32).collect_pixels(|_, _| texels(), set);
                let image = OfPart { part, channels }.first_valid_layer().all_attributes();
                let image = image.non_parallel().from_buffered(bytes)?;
                Ok(image.layer_data.channel_data.pixels)
            }
        }
    }

    fn put(self, texels: &mut [f32], at: Vec2<usize>, texel: [f32; 4]) {
        let place = |at: usize, offset: i32, side: usize| {
            let at = at as i64 + i64::from(offset);
            usize::try_from(at).ok().filter(|at| *at < side)
        };
        let x = place(at.x(), self.offset.x(), self.width);
        if let Some((x, y)) = x.zip(place(at.y(), self.offset.y(), self.height)) {
            let from = 4 * (y * self.width + x);
            texels[from..from + 4].copy_from_slice(&texel);
        }
    }
}

/// Reads only the channels of one part.
struct OfPart<'h, C> {
    part: &'h Header,
    channels: C,
}

impl<'s, C: ReadChannels<'s>> ReadChannels<'s> for OfPart<'_, C> {
    type Reader = C::Reader;

    fn create_channels_reader(&'s self, header: &Header) -> Result<Self::Reader, Error> {
        match header == self.part {
            true => self.channels.create_channels_reader(header),
            false => Err(Error::Invalid("another part".into())),
        }
    }
}

/// Returns the part that is read, and its channels: the first part with a colour picture, in the layer without a name
/// or in the first layer; otherwise one with some of red, green and blue; otherwise one with luminance; otherwise one
/// with a single channel.
fn chosen(parts: &[Header]) -> Option<(usize, Chosen)> {
    let flat = || parts.iter().enumerate().filter(|(_, part)| !part.deep);
    let layers: Vec<(usize, String, Vec<String>)> = flat()
        .flat_map(|(index, part)| layers(part).into_iter().map(move |(layer, names)| (index, layer, names)))
        .collect();
    let name = |part: usize, layer: &str, channel: &str| {
        let whole = if layer.is_empty() { channel.to_owned() } else { format!("{layer}.{channel}") };
        let there = parts[part].channels.list.iter().find(|channel| channel.name.to_string() == whole);
        // A name that does not exist in the file.
        there.map_or_else(|| Text::from(&*format!("absent {channel}")), |channel| channel.name.clone())
    };
    let color = |(part, layer, _): &(usize, String, Vec<String>)| {
        (*part, Chosen::Color(["R", "G", "B", "A"].map(|channel| name(*part, layer, channel))))
    };
    let has = |names: &[String], channel: &str| names.iter().any(|name| name == channel);
    let all = |names: &[String]| ["R", "G", "B"].iter().all(|channel| has(names, channel));
    let some = |names: &[String]| ["R", "G", "B"].iter().any(|channel| has(names, channel));
    let unnamed = layers.iter().find(|(_, layer, names)| layer.is_empty() && all(names));
    let colored = unnamed.or_else(|| layers.iter().find(|(.., names)| all(names)));
    if let Some(found) = colored.or_else(|| layers.iter().find(|(.., names)| some(names))) {
        return Some(color(found));
    }
    if let Some((part, layer, _)) = layers.iter().find(|(.., names)| has(names, "Y")) {
        return Some((*part, Chosen::Grey(name(*part, layer, "Y"), name(*part, layer, "A"))));
    }
    let alone = layers.iter().find(|(.., names)| names.iter().filter(|name| *name != "A").count() == 1);
    let (part, layer, names) = alone.filter(|_| layers.len() == 1)?;
    let channel = names.iter().find(|name| *name != "A")?;
    Some((*part, Chosen::Grey(name(*part, layer, channel), name(*part, layer, "A"))))
}

/// Returns the layers of a part, by their names, and the channels of each.
fn layers(part: &Header) -> BTreeMap<String, Vec<String>> {
    let mut layers: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for channel in &part.channels.list {
        let name = channel.name.to_string();
        let (layer, channel) = name.rsplit_once('.').unwrap_or(("", &name));
        layers.entry(layer.to_owned()).or_default().push(channel.to_owned());
    }
    layers
}

fn is_subsampled(part: &Header) -> bool {
    part.channels.list.iter().any(|channel| channel.sampling != Vec2(1, 1))
}

/// Describes the channels of a file that has no readable picture.
fn unread(parts: &[Header]) -> String {
    if parts.iter().all(|part| part.deep) {
        return "its pixels have several samples each (deep data), which is not supported".into();
    }
    let channels = parts.iter().filter(|part| !part.deep).flat_map(|part| &part.channels.list);
    let mut names: Vec<String> = channels
        .map(|channel| match channel.sampling {
            Vec2(1, 1) => channel.name.to_string(),
            Vec2(x, y) => format!("{} (of each {x}x{y} pixels)", channel.name),
        })
        .collect();
    if names.is_empty() {
        return "it has no channels".into();
    }
    let left = names.len().saturating_sub(SHOWN);
    names.truncate(SHOWN);
    if left > 0 {
        names.push(format!("{left} more"));
    }
    let why = match parts.iter().any(is_subsampled) {
        true => "channels with fewer samples than pixels are not supported",
        false => "none of them is a picture's",
    };
    format!("its channels are {}, and {why}", listed(&names))
}

fn reason(error: &Error) -> String {
    match error {
        Error::NotSupported(what) => format!("it has what is not supported ({what})"),
        Error::Io(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => "the image is truncated".into(),
        error => format!("the image is damaged ({error})"),
    }
}

#[cfg(test)]
mod tests;
