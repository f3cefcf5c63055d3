//! A picture that is written while it is drawn, in strips of whole rows, so that it is never in memory as a whole.

use super::{
    FilmError,
    queue::{Job, Output, Queue},
    rgb,
    still::{Still, exr_attributes, exr_failed},
};
use eddy_engine::Pixels;
use eddy_playback::{npy, scene::Scene};
use eddy_project::Staged;
use eddy_texture::TexelFormat;
use exr::{
    block::{UncompressedBlock, enumerate_ordered_header_block_indices, writer::ChunksWriter},
    meta::{BlockDescription, attribute::SampleType, header::Header},
    prelude::{ChannelDescription, Compression, LineOrder, SmallVec, Text},
};
use half::f16;
use std::{
    io::{self, BufWriter, Seek, Write},
    sync::mpsc::Receiver,
};

/// The number of strips that wait for the encoder.
const WAITING: usize = 1;

/// A picture that is being written. If it is dropped before [`StripWriter::finish`], it is abandoned and no file is
/// left.
pub struct StripWriter {
    queue: Queue<Pixels>,
}

/// The properties of a picture without its texels.
struct Picture {
    still: Still,
    /// The format of the texels that are read.
    texels: TexelFormat,
    size: (u32, u32),
    scene: Option<Scene>,
}

impl Still {
    /// Returns whether strips are written from the top; otherwise from the bottom.
    pub fn is_top_first(self) -> bool {
        !matches!(self, Still::Npy)
    }

    /// Returns whether strips can be written to a pipe.
    pub fn is_for_pipes_in_strips(self) -> bool {
        !matches!(self, Still::Exr)
    }
}

impl StripWriter {
    /// Starts a picture of `size`, and embeds the scene if the format supports it. The file is moved to its place once
    /// it is complete; an existing file stays until then.
    pub fn start(
        still: Still,
        texels: TexelFormat,
        size: (u32, u32),
        output: Output,
        scene: Option<Scene>,
    ) -> Result<StripWriter, FilmError> {
        let picture = Picture { still, texels, size, scene };
        let work = move |jobs: Receiver<Job<Pixels>>| {
            let mut strips = Strips { jobs, is_stopped: false };
            let written = match output {
                Output::File(path) => {
                    picture.write_file(Staged::new(&path), &mut strips, Staged::commit).map_err(FilmError::io(&path))
                }
                Output::Within(path) => {
                    picture.write_file(Staged::within(&path), &mut strips, Staged::commit).map_err(FilmError::io(&path))
                }
                Output::NewFile(path) => picture
                    .write_file(Staged::new(&path), &mut strips, Staged::commit_new)
                    .map_err(FilmError::io(&path)),
                Output::Pipe(mut pipe) => {
                    let written = picture.write_to_pipe(&mut pipe, &mut strips);
                    written.and_then(|()| pipe.flush()).and_then(|()| strips.finish()).map_err(FilmError::pipe)
                }
            };
            if strips.is_stopped { Err(FilmError::Stopped) } else { written }
        };
        Ok(StripWriter { queue: Queue::start(WAITING, work)? })
    }

    /// Adds the next strip, in the order of [`Still::is_top_first`], and blocks while the queue is full.
    pub fn push(&mut self, strip: Pixels) -> Result<(), FilmError> {
        self.queue.push(Job::Next(strip))
    }

    /// Waits until the picture is complete and in its place.
    pub fn finish(mut self) -> Result<(), FilmError> {
        self.queue.finish()
    }
}

/// The strips as they arrive.
struct Strips {
    jobs: Receiver<Job<Pixels>>,
    is_stopped: bool,
}

impl Strips {
    fn stopped(&mut self) -> io::Error {
        self.is_stopped = true;
        io::Error::other("the picture was stopped")
    }

    fn next(&mut self) -> io::Result<Pixels> {
        match self.jobs.recv() {
            Ok(Job::Next(strip)) => Ok(strip),
            Ok(Job::Finish) => Err(io::Error::other("rows of the picture are missing")),
            Err(_) => Err(self.stopped()),
        }
    }

    /// Fails if the picture was abandoned.
    fn finish(&mut self) -> io::Result<()> {
        match self.jobs.recv() {
            Ok(Job::Finish) => Ok(()),
            Ok(Job::Next(_)) => Err(io::Error::other("the picture has more rows than were said")),
            Err(_) => Err(self.stopped()),
        }
    }

    /// Passes all strips of a picture to `take`.
    fn each(&mut self, height: u32, mut take: impl FnMut(&Pixels) -> io::Result<()>) -> io::Result<()> {
        let mut rows = 0;
        while rows < height {
            let strip = self.next()?;
            rows += strip.height;
            take(&strip)?;
        }
        Ok(())
    }
}

impl Picture {
    /// Writes a file next to its destination, where `commit` moves it once it is complete.
    fn write_file(
        &self,
        staged: io::Result<Staged>,
        strips: &mut Strips,
        commit: impl FnOnce(Staged) -> io::Result<()>,
    ) -> io::Result<()> {
        let mut staged = staged?;
        let mut out = BufWriter::new(staged.file());
        self.write(&mut out, strips)?;
        out.flush()?;
        strips.finish()?;
        drop(out);
        commit(staged)
    }

    fn write(&self, out: &mut (impl Write + Seek), strips: &mut Strips) -> io::Result<()> {
        match self.still {
            Still::Exr => self.exr(out, strips),
            Still::Png { .. } | Still::Npy => self.write_to_pipe(out, strips),
        }
    }

    fn write_to_pipe(&self, out: &mut impl Write, strips: &mut Strips) -> io::Result<()> {
        match self.still {
            Still::Png { depth } => self.png(out, depth, strips),
            Still::Npy => {
                npy::write_header(out, self.size)?;
                strips.each(self.size.1, |strip| npy::write_texels(out, &strip.texels))
            }
            Still::Exr => Err(io::Error::other("an OpenEXR file cannot be written to a pipe in strips")),
        }
    }

    fn png(&self, out: &mut impl Write, depth: u32, strips: &mut Strips) -> io::Result<()> {
        let mut encoder = png::Encoder::new(out, self.size.0, self.size.1);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(if depth == 8 { png::BitDepth::Eight } else { png::BitDepth::Sixteen });
        encoder.set_compression(png::Compression::Fast);
        encoder.set_filter(png::Filter::Adaptive);
        let mut writer = encoder.write_header()?;
        if let Some(scene) = &self.scene {
            writer.write_chunk(png::chunk::iTXt, &scene.png_text()?)?;
        }
        let mut stream = writer.stream_writer()?;
        let mut bytes = Vec::new();
        strips.each(self.size.1, |strip| {
            bytes.clear();
            rgb::write(strip, 4, depth, u16::to_be_bytes, &mut bytes);
            stream.write_all(&bytes)
        })?;
        stream.finish()?;
        Ok(writer.finish()?)
    }

    fn exr(&self, out: &mut (impl Write + Seek), strips: &mut Strips) -> io::Result<()> {
        let is_half = self.texels.is_small_float();
        let sample = if is_half { SampleType::F16 } else { SampleType::F32 };
        // Sorted by name, as the file requires.
        let mut components: Vec<(&str, usize)> =
            ["R", "G", "B", "A"].into_iter().zip(0..self.texels.components()).collect();
        components.sort_unstable();
        let channels: SmallVec<[ChannelDescription; 5]> =
            components.iter().map(|(name, _)| ChannelDescription::named(*name, sample)).collect();
        let attribute = self.scene.as_ref().map(Scene::attribute).transpose()?;
        let size = (self.size.0 as usize, self.size.1 as usize);
        let header = Header::new(Text::new_or_panic(""), size, channels)
            .with_encoding(Compression::ZIP16, BlockDescription::ScanLines, LineOrder::Increasing)
            .with_attributes(exr_attributes(attribute));
        let mut rows: Vec<[f32; 4]> = Vec::new();
        let written = exr::block::write(out, SmallVec::from_iter([header]), true, |meta, chunks| {
            let mut compressor = chunks.sequential_blocks_compressor(&meta);
            for (index, block) in enumerate_ordered_header_block_indices(&meta.headers) {
                let texels = block.pixel_size.0 * block.pixel_size.1;
                while rows.len() < texels {
                    let strip = strips.next()?;
                    rows.extend(strip.texels.chunks_exact(size.0).rev().flatten());
                }
                let mut data = Vec::with_capacity(texels * components.len() * if is_half { 2 } else { 4 });
                for line in rows[..texels].chunks_exact(size.0) {
                    for (_, component) in &components {
                        let values = line.iter().map(|texel| texel[*component]);
                        if is_half {
                            data.extend(values.flat_map(|value| f16::from_f32(value).to_ne_bytes()));
                        } else {
                            data.extend(values.flat_map(f32::to_ne_bytes));
                        }
                    }
                }
                rows.drain(..texels);
                compressor.compress_block(index, UncompressedBlock { index: block, data })?;
            }
            Ok(())
        });
        written.map_err(exr_failed)
    }
}

#[cfg(test)]
mod tests;
