//! Films that ffmpeg encodes: the encoder, its options and the colour tags.

use super::{
    FilmError, FilmSound,
    queue::{Shape, Sink, stage_sound},
    style::PixelFormat,
    values::{Chroma, Codec, ColorRange, Format, Quality},
};
use eddy_engine::Pixels;
use eddy_project::Staged;
use eddy_video::{Encoder, Stop, Tools, file_name};
use std::{
    ffi::OsString,
    path::{Path, PathBuf},
};

/// A description of a film that ffmpeg encodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coded {
    pub(super) container: Format,
    pub(super) codec: Codec,
    pub(super) quality: Quality,
    pub(super) pixels: PixelFormat,
}

impl Codec {
    /// Returns the smallest and the largest value of the quality scale.
    pub fn numbers(self) -> (u32, u32) {
        match self {
            Codec::H264 | Codec::H265 => (0, 51),
            Codec::Vp9 | Codec::Av1 => (0, 63),
            Codec::ProRes => (1, 32),
            Codec::Ffv1 => (0, 0),
        }
    }

    /// Returns the constant rate factors for the qualities low, medium and high; for ProRes, the profiles LT, standard
    /// and HQ.
    fn words(self) -> [u32; 3] {
        match self {
            Codec::H264 => [28, 20, 10],
            Codec::H265 => [30, 22, 10],
            Codec::Vp9 => [40, 28, 12],
            Codec::Av1 => [45, 30, 5],
            Codec::ProRes => [1, 2, 3],
            Codec::Ffv1 => [0, 0, 0],
        }
    }
}

impl Coded {
    fn is_lossless(self) -> bool {
        self.quality == Quality::Lossless
    }

    /// Returns the encoders that support it, in order of preference.
    fn candidates(self, size: (u32, u32)) -> &'static [&'static str] {
        let is_420 = matches!(self.pixels, PixelFormat::Yuv(format) if format.chroma == Chroma::C420);
        match self.codec {
            Codec::H264 if self.is_lossless() => &["libx264rgb"],
            Codec::H264 => &["libx264"],
            Codec::H265 => &["libx265"],
            Codec::Vp9 => &["libvpx-vp9"],
            // SVT-AV1 is several times as fast, but supports only 4:2:0 with even sides of at least 64 pixels.
            Codec::Av1
                if is_420 && size.0.min(size.1) >= 64 && size.0.is_multiple_of(2) && size.1.is_multiple_of(2) =>
            {
                &["libsvtav1", "libaom-av1"]
            }
            Codec::Av1 => &["libaom-av1"],
            Codec::ProRes => &["prores_ks"],
            Codec::Ffv1 => &["ffv1"],
        }
    }

    /// Returns the preferred encoder among the installed ones.
    pub(super) fn encoder(self, there: &[String], size: (u32, u32)) -> Result<&'static str, FilmError> {
        let candidates = self.candidates(size);
        let found = candidates.iter().find(|name| there.iter().any(|there| there == *name));
        let missing = || FilmError::NoEncoder { codec: self.codec.title(), encoders: candidates.join(" or ") };
        found.copied().ok_or_else(missing)
    }

    /// Returns the value that is passed to the encoder.
    fn number(self) -> u32 {
        let [low, medium, high] = self.codec.words();
        match self.quality {
            Quality::Low => low,
            Quality::Medium => medium,
            Quality::High => high,
            Quality::Lossless => 0,
            Quality::Number(number) => number,
        }
    }

    fn encoder_arguments(self, encoder: &str) -> Vec<String> {
        let number = self.number().to_string();
        let list = |arguments: &[&str]| arguments.iter().map(|text| (*text).to_owned()).collect::<Vec<_>>();
        let is_444 = matches!(self.pixels, PixelFormat::Yuv(format) if format.chroma == Chroma::C444);
        let mut arguments = match encoder {
            "libx264" => list(&["-preset", "medium", "-crf", &number]),
            "libx264rgb" => list(&["-preset", "medium", "-qp", "0"]),
            "libx265" if self.is_lossless() => list(&["-x265-params", "lossless=1:log-level=error"]),
            "libx265" => list(&["-preset", "medium", "-crf", &number, "-x265-params", "log-level=error"]),
            "libvpx-vp9" if self.is_lossless() => list(&["-lossless", "1", "-row-mt", "1", "-cpu-used", "2"]),
            "libvpx-vp9" => {
                list(&["-crf", &number, "-b:v", "0", "-row-mt", "1", "-deadline", "good", "-cpu-used", "2"])
            }
            "libaom-av1" if self.is_lossless() => {
                list(&["-aom-params", "lossless=1", "-row-mt", "1", "-cpu-used", "6"])
            }
            "libaom-av1" => list(&["-crf", &number, "-b:v", "0", "-row-mt", "1", "-cpu-used", "6"]),
            "libsvtav1" => list(&["-crf", &number, "-preset", "8"]),
            "prores_ks" => {
                // 4444 profiles use more bits than the profiles of the same name below; XQ is used for high quality.
                let profile = match (is_444, self.quality) {
                    (false, Quality::Number(_)) => "3".to_owned(),
                    (false, _) => number.clone(),
                    (true, Quality::High) => "5".to_owned(),
                    (true, _) => "4".to_owned(),
                };
                let mut arguments = list(&["-profile:v", &profile, "-vendor", "apl0"]);
                if let Quality::Number(_) = self.quality {
                    arguments.extend(list(&["-qscale:v", &number]));
                }
                arguments
            }
            _ => list(&["-level", "3", "-g", "1", "-slices", "4", "-slicecrc", "1"]),
        };
        // The planar RGB formats that these encoders accept; the samples are the same.
        let pixels = match (self.pixels, encoder) {
            (PixelFormat::Rgb(_), "libx264rgb") => "rgb24".to_owned(),
            (PixelFormat::Rgb(8), "ffv1") => "bgr0".to_owned(),
            (PixelFormat::Rgb(8), _) => "gbrp".to_owned(),
            (PixelFormat::Rgb(_), _) => "gbrp16le".to_owned(),
            (PixelFormat::Yuv(format), _) => format.name(),
        };
        arguments.extend(["-pix_fmt".to_owned(), pixels]);
        arguments
    }

    /// Returns the colour tags: matrix, range, primaries and transfer function.
    fn tags(self) -> (&'static str, &'static str, &'static str, &'static str) {
        match self.pixels {
            PixelFormat::Yuv(format) if format.range == ColorRange::Limited => ("bt709", "tv", "bt709", "bt709"),
            PixelFormat::Yuv(_) => ("bt709", "pc", "bt709", "bt709"),
            // The values are display values: sRGB.
            PixelFormat::Rgb(_) => ("gbr", "pc", "bt709", "iec61966-2-1"),
        }
    }

    /// Returns ffmpeg's arguments, without the name of the output.
    fn arguments(self, shape: Shape, encoder: &str, sound: Option<OsString>) -> Vec<OsString> {
        let mut all: Vec<OsString> = Vec::new();
        let mut add = |texts: &[&str]| all.extend(texts.iter().map(OsString::from));
        let size = format!("{}x{}", shape.width, shape.height);
        add(&["-protocol_whitelist", "file,pipe", "-f", "rawvideo", "-pixel_format", &self.pixels.name()]);
        add(&["-video_size", &size, "-framerate", &shape.rate.text('/'), "-i", "pipe:0"]);
        let has_sound = sound.is_some();
        if let Some(name) = sound {
            all.extend(["-protocol_whitelist", "file,pipe", "-f", "wav", "-i"].map(OsString::from));
            all.push(name);
        }
        let mut add = |texts: &[&str]| all.extend(texts.iter().map(OsString::from));
        add(&["-map", "0:v:0"]);
        if has_sound {
            add(&["-map", "1:a:0"]);
            add(self.sound_arguments());
        }
        let (matrix, range, primaries, transfer) = self.tags();
        // Set both as frame properties and as encoder options: versions of ffmpeg differ in which of them they honour.
        let frames =
            format!("setparams=range={range}:color_primaries={primaries}:color_trc={transfer}:colorspace={matrix}");
        let option = if matrix == "gbr" { "rgb" } else { matrix };
        add(&["-vf", &frames, "-c:v", encoder]);
        let own = self.encoder_arguments(encoder);
        add(&own.iter().map(String::as_str).collect::<Vec<_>>());
        add(&["-color_range", range, "-color_primaries", primaries, "-color_trc", transfer, "-colorspace", option]);
        add(&self.container_arguments());
        all
    }

    /// Returns the arguments for the sound codec.
    fn sound_arguments(self) -> &'static [&'static str] {
        self.container.container().map_or(&[], |container| container.sound)
    }

    /// Returns the arguments for the container.
    fn container_arguments(self) -> Vec<&'static str> {
        let mut all = Vec::new();
        let container = self.container.container();
        if container.is_some_and(|container| container.is_iso_media) {
            if self.codec == Codec::H265 {
                // The codec tag that QuickTime recognises.
                all.extend(["-tag:v", "hvc1"]);
            }
            all.extend(["-movflags", "+faststart+write_colr"]);
        }
        // No time stamp and no version, so that equal films have equal bytes.
        let muxer = container.map_or(self.container.name(), |container| container.muxer);
        all.extend(["-map_metadata", "-1", "-fflags", "+bitexact", "-f", muxer]);
        all
    }

    /// Returns ffmpeg's arguments for adding a sound, if there is one, to a film whose pictures are copied unchanged.
    fn join_arguments(self, film: OsString, sound: Option<OsString>) -> Vec<OsString> {
        let mut all: Vec<OsString> = ["-protocol_whitelist", "file,pipe", "-i"].map(OsString::from).into();
        all.push(film);
        let has_sound = sound.is_some();
        if let Some(sound) = sound {
            all.extend(["-protocol_whitelist", "file,pipe", "-f", "wav", "-i"].map(OsString::from));
            all.push(sound);
        }
        let mut add = |texts: &[&str]| all.extend(texts.iter().map(OsString::from));
        add(&["-map", "0:v:0", "-c:v", "copy"]);
        if has_sound {
            add(&["-map", "1:a:0"]);
            add(self.sound_arguments());
        }
        add(&self.container_arguments());
        all
    }

    /// Fails for a size that the format does not support. VP9 and AV1 support frames of any size; half of an odd side
    /// is rounded up (VP9 Bitstream Specification, section 7.2.6; AV1 Bitstream Specification, section 5.9.5).
    pub(super) fn check_size(self, width: u32, height: u32) -> Result<(), FilmError> {
        if matches!(self.codec, Codec::Vp9 | Codec::Av1) {
            return Ok(());
        }
        if self.codec == Codec::H265 && width.min(height) < SMALLEST_H265 {
            return Err(FilmError::SmallSize { what: self.codec.title(), least: SMALLEST_H265, width, height });
        }
        let PixelFormat::Yuv(format) = self.pixels else { return Ok(()) };
        let (across, down) = format.halves();
        let is_odd = (across && width % 2 == 1) || (down && height % 2 == 1);
        let what = || format!("{} with {} chroma", self.codec.title(), format.chroma.title());
        if is_odd {
            return Err(FilmError::OddSize { what: what(), width, height });
        }
        Ok(())
    }
}

/// The minimum width and height of a frame that ffmpeg passes to libx265 (`libavcodec/libx265.c`): its smallest block.
const SMALLEST_H265: u32 = 16;

/// A film that is being encoded.
pub(crate) struct CodedFilm {
    /// `None` once the film is complete.
    encoder: Option<Encoder>,
    pixels: PixelFormat,
    bytes: Vec<u8>,
    /// Kept alive until ffmpeg has read it.
    _sound: Option<Staged>,
    later: Option<PendingMux>,
}

/// A film whose sound is muxed in after all pictures are encoded.
struct PendingMux {
    coded: Coded,
    /// The encoded pictures.
    film: Staged,
    sound: Option<Vec<[i16; 2]>>,
    to: PathBuf,
    tools: Tools,
    stop: Stop,
}

impl PendingMux {
    fn finish(self) -> Result<(), FilmError> {
        let sound = self.sound.map(|sound| stage_sound(&self.to, &sound)).transpose()?;
        let wav = sound.as_ref().map(|sound| named(sound.path())).transpose()?;
        let mut arguments = self.coded.join_arguments(named(self.film.path())?, wav);
        arguments.push(named(&self.to)?);
        Ok(Encoder::start(&self.tools, &arguments, &self.stop)?.finish()?)
    }
}

fn named(path: &Path) -> Result<OsString, FilmError> {
    file_name(path).map_err(FilmError::io(path))
}

impl CodedFilm {
    /// Starts an ffmpeg process that writes `to`.
    pub(crate) fn start(
        coded: Coded,
        shape: Shape,
        sound: FilmSound<'_>,
        to: &Path,
        (tools, stop): (&Tools, &Stop),
    ) -> Result<CodedFilm, FilmError> {
        coded.check_size(shape.width, shape.height)?;
        let size = (shape.width, shape.height);
        // With a single candidate, ffmpeg itself reports that the encoder is missing; listing encoders takes a tenth of
        // a second.
        let encoder = match coded.candidates(size) {
            [only] => only,
            _ => coded.encoder(&tools.encoders()?, size)?,
        };
        let later = match sound {
            FilmSound::Later => {
                let film = Staged::new(to).map_err(FilmError::io(to))?;
                let (tools, stop, to) = (tools.clone(), stop.clone(), to.to_owned());
                Some(PendingMux { coded, film, sound: None, to, tools, stop })
            }
            _ => None,
        };
        let sound = match sound {
            FilmSound::Known(sound) => Some(stage_sound(to, sound)?),
            _ => None,
        };
        let wav = sound.as_ref().map(|sound| named(sound.path())).transpose()?;
        let mut arguments = coded.arguments(shape, encoder, wav);
        arguments.push(named(later.as_ref().map_or(to, |later| later.film.path()))?);
        let encoder = Encoder::start(tools, &arguments, stop)?;
        Ok(CodedFilm { encoder: Some(encoder), pixels: coded.pixels, bytes: Vec::new(), _sound: sound, later })
    }
}

impl Sink for CodedFilm {
    fn frame(&mut self, pixels: &Pixels) -> Result<(), FilmError> {
        self.bytes.clear();
        self.pixels.write(pixels, &mut self.bytes);
        let Some(encoder) = &mut self.encoder else { return Ok(()) };
        Ok(encoder.write(&self.bytes)?)
    }

    fn sound(&mut self, sound: Vec<[i16; 2]>) {
        if let Some(later) = &mut self.later {
            later.sound = Some(sound);
        }
    }

    fn finish(&mut self) -> Result<(), FilmError> {
        self.encoder.take().map_or(Ok(()), |encoder| encoder.finish())?;
        self.later.take().map_or(Ok(()), PendingMux::finish)
    }
}
