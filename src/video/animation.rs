//! Animated GIF, PNG and WebP files: frames are decoded by the `image` crate, their times are read from the file's
//! blocks.
//!
//! A delay of 10 ms or less counts as 100 ms, as in browsers (Blink, `BitmapImage` and `DeferredImageDecoder`).

use super::{Decode, Film, VideoError, VideoInfo, check_size, process::Stop};
use eddy_project::limits;
use image::{
    AnimationDecoder, Frames, ImageDecoder, ImageFormat, ImageResult, Limits,
    codecs::{gif::GifDecoder, png::PngDecoder, webp::WebPDecoder},
};
use std::{io::Cursor, sync::Arc};

/// Returns whether a file has a format that supports animation, by its first bytes.
pub fn is_animation(bytes: &[u8]) -> bool {
    matches!(image::guess_format(bytes), Ok(ImageFormat::Gif | ImageFormat::WebP))
        || matches!(image::guess_format(bytes), Ok(ImageFormat::Png)) && chunks(bytes).any(|(kind, _)| kind == b"acTL")
}

/// Returns whether a file contains more than one frame.
pub fn is_animated(bytes: &[u8]) -> bool {
    is_animation(bytes) && delays(bytes).len() > 1
}

/// A file with the times of its frames.
pub(crate) struct Animation {
    bytes: Arc<[u8]>,
    format: ImageFormat,
    /// The start time of each frame.
    times: Arc<[f64]>,
    info: VideoInfo,
}

fn damaged(error: impl std::fmt::Display) -> VideoError {
    VideoError::Damaged(error.to_string())
}

impl Animation {
    pub(crate) fn open(bytes: Vec<u8>) -> Result<Self, VideoError> {
        let bytes: Arc<[u8]> = bytes.into();
        let format = image::guess_format(&bytes).map_err(damaged)?;
        let delays = delays(&bytes);
        if delays.len() > limits::VIDEO_IMAGES {
            return Err(VideoError::TooMany);
        }
        let mut end = 0.0;
        let start = |delay: &f64| {
            end += delay;
            end - delay
        };
        let times: Arc<[f64]> = delays.iter().map(start).collect();
        if end > f64::from(limits::VIDEO_SECONDS) {
            return Err(VideoError::TooLong { seconds: end });
        }
        let (width, height) = size(&bytes, format).map_err(damaged)?;
        check_size(width, height)?;
        let seconds = if end > 0.0 { end } else { 1.0 };
        let frame_rate = times.len().max(1) as f64 / seconds;
        let info = VideoInfo { width, height, seconds, frame_rate, tolerance: 1e-6 };
        Ok(Self { bytes, format, times, info })
    }
}

fn allowed() -> Limits {
    let mut allowed = Limits::no_limits();
    // A canvas, a frame and the working memory of a decoder.
    allowed.max_alloc = Some(4 * limits::VIDEO_FRAME_BYTES);
    allowed
}

fn size(bytes: &[u8], format: ImageFormat) -> ImageResult<(u32, u32)> {
    let bytes = Cursor::new(bytes);
    Ok(match format {
        ImageFormat::Gif => GifDecoder::new(bytes)?.dimensions(),
        ImageFormat::WebP => WebPDecoder::new(bytes)?.dimensions(),
        _ => PngDecoder::with_limits(bytes, allowed())?.dimensions(),
    })
}

impl Film for Animation {
    fn info(&self) -> &VideoInfo {
        &self.info
    }

    /// Frames depend on the previous ones, so each run starts with the first.
    fn start(&self, _: f64, _: &Stop) -> Result<Box<dyn Decode>, VideoError> {
        let bytes = Cursor::new(self.bytes.clone());
        let frames = match self.format {
            ImageFormat::Gif => {
                let mut decoder = GifDecoder::new(bytes).map_err(damaged)?;
                decoder.set_limits(allowed()).map_err(damaged)?;
                Some(decoder.into_frames())
            }
            ImageFormat::WebP => {
                let decoder = WebPDecoder::new(bytes).map_err(damaged)?;
                decoder.has_animation().then(|| decoder.into_frames())
            }
            _ => {
                let decoder = PngDecoder::with_limits(bytes, allowed()).map_err(damaged)?;
                let is_animated = decoder.is_apng().map_err(damaged)?;
                if is_animated { Some(decoder.apng().map_err(damaged)?.into_frames()) } else { None }
            }
        };
        let still = match &frames {
            None => {
                let mut reader = image::ImageReader::with_format(Cursor::new(&*self.bytes), self.format);
                reader.limits(allowed());
                Some(reader.decode().map_err(damaged)?.into_rgba8().into_raw())
            }
            Some(_) => None,
        };
        let (times, frame_bytes) = (self.times.clone(), self.info.frame_bytes());
        Ok(Box::new(Run { frames, still, times, frame_bytes, next: 0 }))
    }
}

/// A pass over the frames of a file.
struct Run {
    frames: Option<Frames<'static>>,
    /// The only frame of a file that is not animated.
    still: Option<Vec<u8>>,
    times: Arc<[f64]>,
    frame_bytes: usize,
    next: usize,
}

impl Decode for Run {
    fn next(&mut self) -> Result<Option<(f64, Vec<u8>)>, VideoError> {
        let frame = match &mut self.frames {
            None => self.still.take().map(Ok),
            Some(frames) => frames.next().map(|frame| frame.map(|frame| frame.into_buffer().into_raw())),
        };
        let texels = match frame {
            None => return Ok(None),
            // A truncated file plays up to the point where it ends.
            Some(Err(_)) if self.next > 0 => return Ok(None),
            Some(Err(error)) => return Err(damaged(error)),
            Some(Ok(texels)) if texels.len() != self.frame_bytes => {
                return Err(VideoError::Damaged("a frame has another size".into()));
            }
            Some(Ok(texels)) => texels,
        };
        // A frame beyond those of the blocks has no time.
        let Some(&seconds) = self.times.get(self.next).or(self.times.first().filter(|_| self.next == 0)) else {
            return if self.next == 0 { Ok(Some((0.0, texels))) } else { Ok(None) };
        };
        self.next += 1;
        Ok(Some((seconds, texels)))
    }
}

/// Returns how long each frame is shown, in seconds.
fn delays(bytes: &[u8]) -> Vec<f64> {
    let millis = match image::guess_format(bytes) {
        Ok(ImageFormat::Gif) => gif_delays(bytes),
        Ok(ImageFormat::WebP) => webp_delays(bytes),
        Ok(ImageFormat::Png) => png_delays(bytes),
        _ => Vec::new(),
    };
    millis.into_iter().map(|millis| if millis <= 10.0 { 0.1 } else { millis / 1e3 }).collect()
}

/// Returns the milliseconds of each frame of a GIF (GIF89a specification, sections 17 to 26).
fn gif_delays(bytes: &[u8]) -> Vec<f64> {
    let mut delays = Vec::new();
    let mut at = 13;
    let table = |packed: u8| if packed & 0x80 != 0 { 3 << ((packed & 7) + 1) } else { 0_usize };
    at += table(bytes.get(10).copied().unwrap_or(0));
    let mut delay = 0.0;
    // Returns the position after a chain of sub-blocks.
    let after_blocks = |mut at: usize| {
        while let Some(&length) = bytes.get(at) {
            at += 1 + usize::from(length);
            if length == 0 {
                break;
            }
        }
        at
    };
    while delays.len() <= limits::VIDEO_IMAGES {
        match bytes.get(at) {
            Some(0x21) => {
                if let (Some(0xf9), Some([low, high])) = (bytes.get(at + 1), bytes.get(at + 4..at + 6)) {
                    delay = f64::from(u16::from_le_bytes([*low, *high])) * 10.0;
                }
                at = after_blocks(at + 2);
            }
            Some(0x2c) => {
                let packed = bytes.get(at + 9).copied().unwrap_or(0);
                at = after_blocks(at + 10 + table(packed) + 1);
                delays.push(std::mem::take(&mut delay));
            }
            _ => break,
        }
    }
    delays
}

/// Returns the complete chunks of a PNG: their kinds and contents.
fn chunks(bytes: &[u8]) -> impl Iterator<Item = (&[u8], &[u8])> {
    let mut at = 8;
    std::iter::from_fn(move || {
        let head: &[u8; 8] = bytes.get(at..)?.first_chunk()?;
        let length = u32::from_be_bytes([head[0], head[1], head[2], head[3]]) as usize;
        let content = bytes.get(at + 8..at.checked_add(8)?.checked_add(length)?)?;
        let kind = bytes.get(at + 4..at + 8)?;
        at += 12 + length;
        Some((kind, content))
    })
}

/// Returns the milliseconds of each frame of an animated PNG (PNG specification, third edition, section 11.3.6.2).
fn png_delays(bytes: &[u8]) -> Vec<f64> {
    let delay = |content: &[u8]| {
        let &[a, b, c, d] = content.get(20..24)?.first_chunk()?;
        let (numerator, denominator) = (u16::from_be_bytes([a, b]), u16::from_be_bytes([c, d]));
        Some(1e3 * f64::from(numerator) / f64::from(if denominator == 0 { 100 } else { denominator }))
    };
    let controls = chunks(bytes).filter(|(kind, _)| *kind == b"fcTL");
    controls.filter_map(|(_, content)| delay(content)).take(limits::VIDEO_IMAGES + 1).collect()
}

/// Returns the milliseconds of each frame of an animated WebP (WebP container specification, section "Animation").
fn webp_delays(bytes: &[u8]) -> Vec<f64> {
    let mut delays = Vec::new();
    let mut at = 12;
    while let Some(&[a, b, c, d, e, f, g, h]) = bytes.get(at..).and_then(|rest| rest.first_chunk::<8>())
        && delays.len() <= limits::VIDEO_IMAGES
    {
        let length = u32::from_le_bytes([e, f, g, h]) as usize;
        if [a, b, c, d] == *b"ANMF"
            && let Some(&[low, middle, high]) = bytes.get(at + 20..at + 23).and_then(|three| three.first_chunk())
        {
            delays.push(f64::from(u32::from_le_bytes([low, middle, high, 0])));
        }
        at = at.saturating_add(8).saturating_add(length.next_multiple_of(2));
    }
    delays
}
