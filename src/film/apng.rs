//! Animated PNG (PNG Specification, third edition, section 4.9), without alpha: a film is opaque as on a screen.

use super::{
    FilmError,
    queue::{Shape, Sink},
    rgb,
};
use eddy_engine::Pixels;
use std::io::Write;

/// A film in which every frame is a separate picture.
pub(crate) struct Apng<W: Write> {
    /// `None` once the film is complete.
    writer: Option<png::Writer<W>>,
    depth: u32,
    bytes: Vec<u8>,
    failed: fn(std::io::Error) -> FilmError,
}

impl<W: Write> Apng<W> {
    /// `failed` maps an I/O error to one that names the output.
    pub(crate) fn new(
        out: W,
        shape: Shape,
        depth: u32,
        failed: fn(std::io::Error) -> FilmError,
    ) -> Result<Apng<W>, FilmError> {
        let mut encoder = png::Encoder::new(out, shape.width, shape.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(if depth == 8 { png::BitDepth::Eight } else { png::BitDepth::Sixteen });
        // Loop forever.
        let frames = shape.frames.ok_or(FilmError::NoLength { format: "apng" })?;
        let animated = encoder.set_animated(frames, 0);
        let (seconds, parts) = (shape.rate.denominator as u16, shape.rate.numerator as u16);
        let header =
            animated.and_then(|()| encoder.set_frame_delay(seconds, parts)).and_then(|()| encoder.write_header());
        Ok(Apng { writer: Some(header.map_err(|e| failed(e.into()))?), depth, bytes: Vec::new(), failed })
    }
}

impl<W: Write + Send> Sink for Apng<W> {
    fn frame(&mut self, pixels: &Pixels) -> Result<(), FilmError> {
        self.bytes.clear();
        rgb::write(pixels, 3, self.depth, u16::to_be_bytes, &mut self.bytes);
        let Some(writer) = &mut self.writer else { return Ok(()) };
        writer.write_image_data(&self.bytes).map_err(|e| (self.failed)(e.into()))
    }

    fn finish(&mut self) -> Result<(), FilmError> {
        self.writer.take().map_or(Ok(()), |writer| writer.finish().map_err(|e| (self.failed)(e.into())))
    }
}
