//! Uncompressed frames: raw, and YUV4MPEG2.
//!
//! The header of YUV4MPEG2 follows the MJPEG tools (`man yuv4mpeg`), with `XCOLORRANGE` as ffmpeg reads and writes it.
//! It has no field for the matrix, which is that of BT.709.

use super::{
    FilmError,
    queue::{Shape, Sink},
    rgb,
    values::{Chroma, ColorRange},
    yuv::YuvFormat,
};
use eddy_engine::Pixels;
use std::io::{self, Write};

/// A film that is written frame by frame.
pub(crate) struct Plain<W: Write> {
    out: W,
    /// `Err` for RGBA with this many bits per component.
    yuv: Result<YuvFormat, u32>,
    bytes: Vec<u8>,
    failed: fn(io::Error) -> FilmError,
}

impl<W: Write> Plain<W> {
    /// `yuv` is `Ok` for a film of YUV4MPEG2 and `Err` for raw RGBA with this many bits. `failed` maps an I/O error to
    /// one that names the output.
    pub(crate) fn new(
        mut out: W,
        shape: Shape,
        yuv: Result<YuvFormat, u32>,
        failed: fn(io::Error) -> FilmError,
    ) -> Result<Plain<W>, FilmError> {
        if let Ok(format) = yuv {
            out.write_all(header(shape, format).as_bytes()).map_err(failed)?;
        }
        Ok(Plain { out, yuv, bytes: Vec::new(), failed })
    }
}

impl<W: Write + Send> Sink for Plain<W> {
    fn frame(&mut self, pixels: &Pixels) -> Result<(), FilmError> {
        self.bytes.clear();
        match self.yuv {
            Ok(format) => {
                self.bytes.extend(b"FRAME\n");
                format.write(pixels, &mut self.bytes);
            }
            Err(depth) => rgb::write(pixels, 4, depth, u16::to_le_bytes, &mut self.bytes),
        }
        self.out.write_all(&self.bytes).map_err(self.failed)
    }

    fn finish(&mut self) -> Result<(), FilmError> {
        self.out.flush().map_err(self.failed)
    }
}

fn header(shape: Shape, format: YuvFormat) -> String {
    let colors = match (format.chroma, format.depth) {
        (Chroma::C420, 8) => "420mpeg2 XYSCSS=420MPEG2".to_owned(),
        (Chroma::C420, depth) => format!("420p{depth} XYSCSS=420P{depth}"),
        (Chroma::C422, 8) => "422 XYSCSS=422".to_owned(),
        (Chroma::C422, depth) => format!("422p{depth} XYSCSS=422P{depth}"),
        (Chroma::C444, 8) => "444 XYSCSS=444".to_owned(),
        (Chroma::C444, depth) => format!("444p{depth} XYSCSS=444P{depth}"),
    };
    let range = match format.range {
        ColorRange::Limited => "LIMITED",
        ColorRange::Full => "FULL",
    };
    let (width, height, rate) = (shape.width, shape.height, shape.rate.text(':'));
    format!("YUV4MPEG2 W{width} H{height} F{rate} Ip A1:1 C{colors} XCOLORRANGE={range}\n")
}
