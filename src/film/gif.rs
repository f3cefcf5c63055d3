//! GIF by ffmpeg, with one palette for the whole film.
//!
//! The palette depends on all frames, and ffmpeg's filter that does both steps at once would keep all of them in
//! memory. So frames are first written losslessly to a temporary file, from which the palette and then the GIF are
//! made.

use super::{
    FilmError,
    queue::{Shape, Sink},
    rate::Rate,
    rgb,
    values::Format,
};
use eddy_engine::Pixels;
use eddy_project::Staged;
use eddy_video::{Encoder, Stop, Tools, file_name};
use std::{
    ffi::OsString,
    path::{Path, PathBuf},
};

/// A film whose frames are stored until its palette is known.
pub(crate) struct Gif {
    /// `None` once all frames have been pushed.
    frames: Option<Encoder>,
    kept: Staged,
    palette: Staged,
    to: PathBuf,
    tools: Tools,
    stop: Stop,
    bytes: Vec<u8>,
}

impl Gif {
    /// Starts an empty film. `to` is the final file; the temporary files are next to it.
    pub(crate) fn start(shape: Shape, to: &Path, (tools, stop): (&Tools, &Stop)) -> Result<Gif, FilmError> {
        check_rate(shape.rate)?;
        let kept = Staged::new(to).map_err(FilmError::io(to))?;
        let palette = Staged::new(to).map_err(FilmError::io(to))?;
        let size = format!("{}x{}", shape.width, shape.height);
        let rate = shape.rate.text('/');
        let mut arguments = list(&["-protocol_whitelist", "file,pipe", "-f", "rawvideo", "-pixel_format", "rgb24"]);
        arguments.extend(list(&["-video_size", &size, "-framerate", &rate, "-i", "pipe:0"]));
        arguments.extend(list(&["-c:v", "ffv1", "-pix_fmt", "bgr0", "-g", "1", "-f", "nut"]));
        arguments.push(named(kept.path())?);
        let frames = Some(Encoder::start(tools, &arguments, stop)?);
        let (tools, stop, to) = (tools.clone(), stop.clone(), to.to_owned());
        Ok(Gif { frames, kept, palette, to, tools, stop, bytes: Vec::new() })
    }

    fn run(&self, arguments: Vec<OsString>) -> Result<(), FilmError> {
        Ok(Encoder::start(&self.tools, arguments, &self.stop)?.finish()?)
    }
}

/// Fails for a rate that browsers cannot show.
pub(crate) fn check_rate(rate: Rate) -> Result<(), FilmError> {
    match rate.per_second() {
        fps if Format::Gif.max_fps().is_some_and(|fastest| fps > fastest) => Err(FilmError::GifRate(fps)),
        _ => Ok(()),
    }
}

fn list(arguments: &[&str]) -> Vec<OsString> {
    arguments.iter().map(OsString::from).collect()
}

fn named(path: &Path) -> Result<OsString, FilmError> {
    file_name(path).map_err(FilmError::io(path))
}

impl Sink for Gif {
    fn frame(&mut self, pixels: &Pixels) -> Result<(), FilmError> {
        self.bytes.clear();
        rgb::write(pixels, 3, 8, u16::to_le_bytes, &mut self.bytes);
        let Some(frames) = &mut self.frames else { return Ok(()) };
        Ok(frames.write(&self.bytes)?)
    }

    fn finish(&mut self) -> Result<(), FilmError> {
        let Some(frames) = self.frames.take() else { return Ok(()) };
        frames.finish()?;
        let input = |format: &str, path: &Path| {
            let mut input = list(&["-protocol_whitelist", "file,pipe", "-f", format, "-i"]);
            input.push(named(path)?);
            Ok::<_, FilmError>(input)
        };
        let kept = input("nut", self.kept.path())?;
        let mut palette = kept.clone();
        palette.extend(list(&["-vf", "palettegen=reserve_transparent=0", "-frames:v", "1", "-c:v", "png"]));
        palette.extend(list(&["-f", "image2pipe"]));
        palette.push(named(self.palette.path())?);
        self.run(palette)?;
        let mut gif = kept;
        gif.extend(input("png_pipe", self.palette.path())?);
        gif.extend(list(&["-lavfi", "paletteuse=dither=sierra2_4a:diff_mode=rectangle", "-loop", "0"]));
        gif.extend(list(&["-fflags", "+bitexact", "-f", "gif"]));
        gif.push(named(&self.to)?);
        self.run(gif)
    }
}
