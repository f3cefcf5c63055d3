//! Resolves a user's request into an encoding, with the defaults and the reasons why a request is not possible.

use super::{
    FilmError,
    coded::Coded,
    formats::{FormatKind, FormatRow},
    gif,
    rate::Rate,
    rgb,
    still::Still,
    values::{Chroma, Codec, ColorRange, Format, Quality},
    yuv::YuvFormat,
};
use eddy_engine::Pixels;
use eddy_video::Tools;

/// The user's choices for a file. [`Style::resolve`] chooses the fields that are `None`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Style {
    pub format: Format,
    pub codec: Option<Codec>,
    pub quality: Option<Quality>,
    pub range: Option<ColorRange>,
    pub chroma: Option<Chroma>,
    /// Bits per component.
    pub depth: Option<u32>,
}

/// A complete description of how pictures are written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Each picture is a file.
    Still(Still),
    /// All pictures are one file.
    Film(FilmEncoding),
}

/// A description of how a film is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FilmEncoding {
    /// An animated PNG with this number of bits per component.
    Apng(u32),
    Gif,
    /// Plain RGBA with this number of bits per component.
    Raw(u32),
    /// YUV4MPEG2, a format for pipes between programs.
    Y4m(YuvFormat),
    /// Encoded by ffmpeg.
    Coded(Coded),
}

/// The pixel format that an encoder receives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PixelFormat {
    /// Red, green and blue with this number of bits each.
    Rgb(u32),
    Yuv(YuvFormat),
}

impl PixelFormat {
    /// Returns ffmpeg's name.
    pub(super) fn name(self) -> String {
        match self {
            PixelFormat::Rgb(8) => "rgb24".into(),
            PixelFormat::Rgb(_) => "rgb48le".into(),
            PixelFormat::Yuv(format) => format.name(),
        }
    }

    pub(super) fn write(self, pixels: &Pixels, out: &mut Vec<u8>) {
        match self {
            PixelFormat::Rgb(depth) => rgb::write(pixels, 3, depth, u16::to_le_bytes, out),
            PixelFormat::Yuv(format) => format.write(pixels, out),
        }
    }
}

impl FilmEncoding {
    /// Returns whether ffmpeg writes it.
    pub fn needs_ffmpeg(&self) -> bool {
        matches!(self, FilmEncoding::Gif | FilmEncoding::Coded(_))
    }

    /// Returns whether the file contains sound.
    pub fn holds_sound(&self) -> bool {
        matches!(self, FilmEncoding::Coded(_))
    }

    /// Fails for a rate that the format does not support.
    pub fn check_rate(&self, rate: Rate) -> Result<(), FilmError> {
        match self {
            FilmEncoding::Gif => gif::check_rate(rate),
            _ => Ok(()),
        }
    }
}

/// Fails if a program that the encoding needs for pictures of this size is not installed, so that this is known before
/// hours of drawing.
pub fn check_tools(encoding: &Encoding, size: (u32, u32), tools: &Tools) -> Result<(), FilmError> {
    let Encoding::Film(film) = encoding else { return Ok(()) };
    if !film.needs_ffmpeg() {
        return Ok(());
    }
    check_encoders(encoding, size, &tools.encoders()?)
}

/// Does the same if the encoders of ffmpeg are known.
pub fn check_encoders(encoding: &Encoding, size: (u32, u32), there: &[String]) -> Result<(), FilmError> {
    match encoding {
        Encoding::Film(FilmEncoding::Coded(coded)) => coded.encoder(there, size).map(drop),
        _ => Ok(()),
    }
}

/// Fails for pictures of a size that the encoding does not support.
pub fn check_size(encoding: &Encoding, (width, height): (u32, u32)) -> Result<(), FilmError> {
    match encoding {
        Encoding::Film(FilmEncoding::Coded(coded)) => coded.check_size(width, height),
        _ => Ok(()),
    }
}

impl Style {
    /// Returns a style that leaves everything but the format open.
    pub fn new(format: Format) -> Style {
        Style { format, codec: None, quality: None, range: None, chroma: None, depth: None }
    }

    /// Returns the encoding, or an error message that lists what is possible.
    pub fn resolve(self) -> Result<Encoding, String> {
        let name = self.format.name();
        let refused = |what: &str, is_given: bool| match is_given {
            true => Err(format!("{what} cannot be chosen for {name} files")),
            false => Ok(()),
        };
        let FormatRow { kind, depths, .. } = self.format.row();
        let takes_codec = matches!(kind, FormatKind::Container(_));
        let takes_yuv = takes_codec || matches!(kind, FormatKind::YuvFilm);
        refused("a codec", self.codec.is_some() && !takes_codec)?;
        refused("a quality", self.quality.is_some() && !takes_codec)?;
        refused("a colour range", self.range.is_some() && !takes_yuv)?;
        refused("a chroma format", self.chroma.is_some() && !takes_yuv)?;
        let depth = |allowed: &[u32], what: &str| match self.depth {
            None => Ok(allowed[0]),
            Some(depth) if allowed.contains(&depth) => Ok(depth),
            Some(depth) => {
                let allowed: Vec<String> = allowed.iter().map(u32::to_string).collect();
                Err(format!("a depth of {depth} bits: {what} have {}", allowed.join(" or ")))
            }
        };
        // A container has those of its codec.
        let has_no_choice = depths.is_empty() && !takes_codec;
        refused("a depth", self.depth.is_some() && has_no_choice)?;
        let own_depth = || if has_no_choice { Ok(8) } else { depth(depths, &format!("{name} files")) };
        Ok(match kind {
            FormatKind::Still(still) => Encoding::Still(still(own_depth()?)),
            FormatKind::Film(film) => Encoding::Film(film(own_depth()?)),
            FormatKind::YuvFilm => {
                let (chroma, range) = (self.chroma.unwrap_or(Chroma::C420), self.range.unwrap_or(ColorRange::Limited));
                Encoding::Film(FilmEncoding::Y4m(YuvFormat { chroma, depth: own_depth()?, range }))
            }
            FormatKind::Container(container) => {
                Encoding::Film(FilmEncoding::Coded(self.coded(container.codecs, depth)?))
            }
        })
    }

    fn coded(self, codecs: &[Codec], depth: impl Fn(&[u32], &str) -> Result<u32, String>) -> Result<Coded, String> {
        let codec = self.codec.unwrap_or(codecs[0]);
        if !codecs.contains(&codec) {
            let names: Vec<&str> = codecs.iter().map(|codec| codec.name()).collect();
            return Err(format!("{} files hold no {}: use {}", self.format.name(), codec.title(), names.join(" or ")));
        }
        let quality = match (codec, self.quality) {
            (Codec::Ffv1, None) => Quality::Lossless,
            (Codec::Ffv1, Some(quality)) if quality != Quality::Lossless => {
                return Err("FFV1 is always lossless: leave the quality out".into());
            }
            (Codec::ProRes, Some(Quality::Lossless)) => {
                return Err("ProRes is never lossless: use FFV1, or the quality high".into());
            }
            (_, quality) => quality.unwrap_or(Quality::Medium),
        };
        if let (Quality::Number(number), (least, most)) = (quality, codec.numbers())
            && !(least..=most).contains(&number)
        {
            return Err(format!("a quality of {number}: numbers of {} are {least} to {most}", codec.title()));
        }
        if quality == Quality::Lossless {
            if self.chroma.is_some() || self.range.is_some() {
                return Err(
                    "a lossless film keeps red, green and blue, which have no chroma format and no range".into()
                );
            }
            let depths: &[u32] = if codec == Codec::Ffv1 { &[8, 16] } else { &[8] };
            let pixels = PixelFormat::Rgb(depth(depths, &format!("lossless films of {}", codec.title()))?);
            return Ok(Coded { container: self.format, codec, quality, pixels });
        }
        let (chromas, depths): (&[Chroma], &[u32]) = match codec {
            Codec::ProRes => (&[Chroma::C422, Chroma::C444], &[10]),
            _ => (&[Chroma::C420, Chroma::C444], &[8, 10]),
        };
        let chroma = self.chroma.unwrap_or(chromas[0]);
        if !chromas.contains(&chroma) {
            return Err(format!("{} has {} or {} here", codec.title(), chromas[0].title(), chromas[1].title()));
        }
        let range = self.range.unwrap_or(ColorRange::Limited);
        if codec == Codec::ProRes && range == ColorRange::Full {
            return Err("ProRes has the limited range alone".into());
        }
        let depth = depth(depths, &format!("films of {}", codec.title()))?;
        Ok(Coded {
            container: self.format,
            codec,
            quality,
            pixels: PixelFormat::Yuv(YuvFormat { chroma, depth, range }),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn impossible_styles_are_rejected_with_the_alternatives() {
        let style = Style::new;
        let codec = |format, codec| Style { codec: Some(codec), ..style(format) };
        for (style, says) in [
            (codec(Format::Png, Codec::H264), "a codec cannot be chosen for png files"),
            (codec(Format::Webm, Codec::H264), "use vp9 or av1"),
            (codec(Format::Mp4, Codec::Ffv1), "use h264 or"),
            (Style { depth: Some(12), ..style(Format::Png) }, "png files have 8 or 16"),
            (Style { depth: Some(8), ..style(Format::Exr) }, "a depth cannot be chosen"),
            (Style { depth: Some(8), ..style(Format::Mov) }, "films of ProRes have 10"),
            (Style { quality: Some(Quality::High), ..style(Format::Gif) }, "a quality cannot be chosen"),
            (Style { quality: Some(Quality::High), ..style(Format::Mkv) }, "always lossless"),
            (Style { quality: Some(Quality::Lossless), ..style(Format::Mov) }, "never lossless"),
            (Style { quality: Some(Quality::Number(52)), ..style(Format::Mp4) }, "0 to 51"),
            (Style { chroma: Some(Chroma::C422), ..style(Format::Mp4) }, "4:2:0 or 4:4:4"),
            (Style { range: Some(ColorRange::Full), ..style(Format::Mov) }, "limited range alone"),
            (
                Style { quality: Some(Quality::Lossless), chroma: Some(Chroma::C444), ..style(Format::Mp4) },
                "no chroma format",
            ),
        ] {
            let message = style.resolve().expect_err(says);
            assert!(message.contains(says), "{style:?}: {message}");
        }
    }

    #[test]
    fn every_format_has_defaults() {
        for format in Format::ALL {
            let encoding = Style::new(format).resolve().unwrap();
            assert_eq!(format.is_still(), matches!(encoding, Encoding::Still(_)), "{format:?}");
            if let Encoding::Film(film) = encoding {
                assert_eq!(film.holds_sound(), format.has_sound(), "{format:?}");
            }
        }
    }
}
