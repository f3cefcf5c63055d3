//! The files of pictures and films. They are determined for all frames of all projects before anything is drawn, so
//! that no file of a call overwrites another one of it.

mod frames;
#[cfg(test)]
mod tests;

use super::{
    args::{RenderArgs, face_of},
    sweep,
    written::make_folder,
};
use crate::{
    engine::Pixels,
    film::{self, Encoding, Format, Rate},
    playback::{capture, shard::Shard},
    project,
    video::Tools,
};
use anyhow::Context;
use std::{
    collections::HashMap,
    fs,
    io::{BufWriter, Write},
    path::{Path, PathBuf},
};

/// The files that one call writes.
#[derive(Debug, PartialEq)]
pub(super) struct Targets {
    pub format: Format,
    pub encoding: Encoding,
    /// The frames to write of each project, in ascending order, without duplicates. Those of a film are evenly spaced.
    pub at: Vec<u32>,
    /// Frames to draw even if they are not written: from 0 to before this one.
    pub drawn: Option<u32>,
    /// Frames per second of a film.
    pub rate: Rate,
    /// True if existing files are kept.
    pub keeps: bool,
    /// The part of all frames of all projects that this call writes.
    pub shard: Shard,
    /// True if names contain frame numbers even for a single frame.
    is_numbered: bool,
    /// The assignments of each drawing of a project.
    pub sweep: Vec<Vec<String>>,
    projects: usize,
    place: Output,
}

#[derive(Debug, PartialEq, Eq)]
enum Output {
    Nowhere,
    /// Standard output.
    Pipe,
    /// One picture or film.
    File(PathBuf),
    /// A folder, and the stem of each project in it.
    Folder(PathBuf, Vec<String>),
}

/// Selects the rate of a film whose format does not support the default one, if the call does not set a rate. Errors in
/// the call are reported by [`Targets::of`].
pub(super) fn choose_rate(args: &mut RenderArgs) {
    let Ok((format, _)) = place(args) else { return };
    let (Some(fastest), Ok(asked)) = (format.max_fps(), frames::of(args, !format.is_still())) else { return };
    if args.run.fps.is_none() && args.run.fps() / f64::from(asked.step) > fastest {
        args.run.fps = Some(fastest * f64::from(asked.step));
        let name = format.name().to_uppercase();
        args.run.fps_note =
            Some(format!("a {name} has at most {fastest} frames per second: drawn as with --fps {}", args.run.fps()));
    }
}

impl Targets {
    /// Returns an error message if the options contradict each other.
    pub(super) fn of(args: &RenderArgs) -> Result<Targets, String> {
        face_of(&args.pass.pass, args.face)?;
        let sweep = sweep::combinations(&args.sweep)?;
        let (format, place) = place(args)?;
        let encoding = args.style.of(format).resolve()?;
        let asked = frames::of(args, !format.is_still())?;
        let rate = args.run.fps() / f64::from(asked.step);
        let rate = Rate::of(rate).ok_or_else(|| film::FilmError::Rate(rate).to_string());
        let rate = if format.is_still() { rate.unwrap_or(Rate { numerator: 60, denominator: 1 }) } else { rate? };
        if let Encoding::Film(encoding) = &encoding {
            encoding.check_rate(rate).map_err(|error| format!("--fps: {error}"))?;
            if args.shard.is_some() {
                return Err(format!(
                    "--shard: a {} file is written as a whole; write pictures, as with --format png, and join them",
                    format.name()
                ));
            }
        }
        if args.looped.is_some() && format.is_still() {
            return Err(format!("--loop is for films, and {} files hold one picture", format.name()));
        }
        let shard = args.shard.unwrap_or(Shard::WHOLE);
        let is_numbered = asked.is_range || asked.at.len() > 1;
        let files = args.project.len() * sweep.len() * if format.is_still() { asked.at.len() } else { 1 };
        match &place {
            Output::File(out) if files != 1 || args.shard.is_some() => {
                let (shown, what) = (out.display(), if format.is_still() { "pictures" } else { "films" });
                return Err(format!("--out {shown} is one file, but {files} {what} would be written: give a folder"));
            }
            Output::Pipe if args.project.len() * sweep.len() != 1 => {
                return Err("--out -: standard output takes one project alone".into());
            }
            Output::Pipe if args.json => {
                return Err("--out -: --json writes to standard output, too; leave one of them out".into());
            }
            _ => {}
        }
        let keeps = (asked.is_range || args.shard.is_some()) && !args.overwrite && matches!(place, Output::Folder(..));
        Ok(Targets {
            format,
            encoding,
            at: asked.at,
            drawn: asked.drawn,
            rate,
            keeps: keeps && format.is_still(),
            shard,
            is_numbered,
            sweep,
            projects: args.project.len(),
            place,
        })
    }

    /// Creates the folder, so that an unwritable location is detected before hours of drawing, and looks for the
    /// programs that pictures of this size need.
    pub(super) fn prepare(&self, size: (u32, u32)) -> anyhow::Result<()> {
        match &self.place {
            Output::Nowhere | Output::Pipe => {}
            Output::File(file) => check_folder(file)?,
            Output::Folder(folder, _) => make_folder("--out", folder)?,
        }
        if self.place != Output::Nowhere {
            film::check_size(&self.encoding, size)?;
            film::check_tools(&self.encoding, size, &Tools::default())?;
        }
        Ok(())
    }

    /// Returns the frames of a project, in the drawing of number `swept`, that this call writes.
    pub(super) fn part(&self, project: usize, swept: usize) -> &[u32] {
        let (projects, frames) = (self.projects as u64, self.at.len() as u64);
        let part = self.shard.part_of(projects * self.sweep.len() as u64 * frames);
        let first = (project * self.sweep.len() + swept) as u64 * frames;
        let within = |n: u64| n.clamp(first, first + frames).saturating_sub(first) as usize;
        &self.at[within(part.start)..within(part.end)]
    }

    /// Returns the number of frames of all projects that this call writes.
    pub(super) fn pictures(&self) -> usize {
        let parts = (0..self.projects).flat_map(|project| (0..self.sweep.len()).map(move |swept| (project, swept)));
        parts.map(|(project, swept)| self.part(project, swept).len()).sum()
    }

    /// Returns whether any files are written.
    pub(super) fn writes(&self) -> bool {
        self.place != Output::Nowhere
    }

    /// Returns whether pictures go to standard output.
    pub(super) fn is_pipe(&self) -> bool {
        self.place == Output::Pipe
    }

    /// Returns whether Eddy names the files, in a folder.
    pub(super) fn is_folder(&self) -> bool {
        matches!(self.place, Output::Folder(..))
    }

    /// Returns how a file is written: links in a folder are not followed.
    pub(super) fn output(&self, path: PathBuf) -> film::Output {
        if self.is_folder() { film::Output::Within(path) } else { film::Output::File(path) }
    }

    /// Fails if a file of a folder is a link out of it, which must not be written through.
    pub(super) fn check(&self, path: &Path) -> anyhow::Result<()> {
        if let Output::Folder(folder, _) = &self.place { check_within(folder, path) } else { Ok(()) }
    }

    /// Returns the file for a frame of a project, counted as on the command line, with the assignments `swept`. All
    /// frames of a film are in one file.
    pub(super) fn path(&self, project: usize, swept: &[String], frame: u32) -> Option<PathBuf> {
        match &self.place {
            Output::Nowhere | Output::Pipe => None,
            Output::File(file) => Some(file.clone()),
            Output::Folder(folder, stems) => {
                let (mut stem, extension) = (stems[project].clone(), self.format.name());
                swept.iter().for_each(|set| stem.push_str(&format!("_{set}")));
                Some(folder.join(match self.is_numbered && self.format.is_still() {
                    false => format!("{stem}.{extension}"),
                    // The names do not depend on the shard.
                    true => film::picture_name(&stem, frame, self.at.last().copied().unwrap_or_default(), extension),
                }))
            }
        }
    }
}

/// Returns the destination and the format of a call.
fn place(args: &RenderArgs) -> Result<(Format, Output), String> {
    let asked = args.style.format;
    let Some(out) = &args.out else { return Ok((asked.unwrap_or(Format::Png), Output::Nowhere)) };
    if out == Path::new("-") {
        let format = asked.unwrap_or(Format::Y4m);
        if !format.is_sequential() {
            return Err(format!("--out -: {} needs a file, as parts of it are written twice; use y4m", format.name()));
        }
        return Ok((format, Output::Pipe));
    }
    let named = out.extension().and_then(|ending| Format::of_name(&ending.to_string_lossy()));
    match (named.filter(|_| !out.is_dir()), asked) {
        (None, _) => {
            if let Some(why) = foreign_format(out) {
                return Err(why);
            }
            let stems = stems(&args.project, || tells_case_apart(out))?;
            Ok((asked.unwrap_or(Format::Png), Output::Folder(out.clone(), stems)))
        }
        // Animated PNG files often have the extension .png.
        (Some(Format::Png), Some(Format::Apng)) => Ok((Format::Apng, Output::File(out.clone()))),
        (Some(named), Some(asked)) if asked != named => {
            Err(format!("--out {} and --format {} do not agree", out.display(), asked.name()))
        }
        (Some(named), _) => Ok((named, Output::File(out.clone()))),
    }
}

/// Extensions of pictures and films that other programs write.
const FOREIGN: [&str; 27] = [
    "avi", "avif", "bmp", "dds", "flv", "hdr", "heic", "jpe", "jpeg", "jpg", "jxl", "ktx2", "m4v", "mpeg", "mpg",
    "ogv", "pdf", "pgm", "ppm", "psd", "svg", "tga", "tif", "tiff", "ts", "webp", "wmv",
];

/// Returns a fix for a name whose extension is that of an unsupported format. A name with any other extension, or with
/// a trailing slash, is a folder's.
fn foreign_format(out: &Path) -> Option<String> {
    let ending = out.extension()?.to_string_lossy().to_ascii_lowercase();
    let shown = out.display();
    if out.is_dir() || out.as_os_str().to_string_lossy().ends_with(std::path::is_separator) {
        return None;
    }
    if matches!(ending.as_str(), "wav" | "flac") {
        return Some(format!("--out {shown} is a sound: add --pass sound"));
    }
    FOREIGN.contains(&ending.as_str()).then(|| {
        let names = Format::pictures_first().map(|format| format!(".{}", format.name())).join(", ");
        format!("--out {shown}: .{ending} is not a format that is written; use {names}, or {shown}/ for a folder")
    })
}

/// Returns the name of each project's file without its extension.
///
/// `case_counts`: whether the file system distinguishes `Fluid.png` from `fluid.png`; called only if it matters.
pub(super) fn stems(projects: &[String], case_counts: impl Fn() -> bool) -> Result<Vec<String>, String> {
    let stems: Vec<String> = projects.iter().map(|p| project::stem(p)).collect();
    let twice = |key: fn(&str) -> String| {
        let mut first = HashMap::new();
        let mut pairs = projects.iter().zip(&stems);
        pairs.find_map(|(project, stem)| Some((first.insert(key(stem), project)?, project, stem)))
    };
    let clash = twice(str::to_owned).or_else(|| twice(|stem| stem.to_lowercase()).filter(|_| !case_counts()));
    if let Some((other, project, stem)) = clash {
        return Err(format!(
            "{other} and {project} would both be written as {stem}: render them in two calls, to two folders"
        ));
    }
    Ok(stems)
}

/// Returns whether files whose names differ only by case are two files in a folder that may not exist yet. This is
/// tested with a file, as one machine can have both kinds of file systems; false if no file can be written.
pub(super) fn tells_case_apart(folder: &Path) -> bool {
    let there =
        folder.ancestors().map(|p| if p.as_os_str().is_empty() { Path::new(".") } else { p }).find(|p| p.is_dir());
    let file = there.and_then(|there| tempfile::Builder::new().prefix(".eddy-Case-").tempfile_in(there).ok());
    file.is_some_and(|file| {
        let name = file.path().file_name().map(|n| n.to_string_lossy().to_lowercase());
        name.is_some_and(|name| !file.path().with_file_name(name).exists())
    })
}

/// Writes a picture atomically: a picture of the same name stays until the new one is complete.
pub(super) fn write(path: &Path, pixels: &Pixels, format: capture::Format) -> anyhow::Result<()> {
    let written = project::write_with(path, |file| {
        let mut out = BufWriter::new(file);
        capture::encode(&mut out, pixels, format)?;
        out.flush()
    });
    written.with_context(|| format!("cannot write {}", path.display()))
}

/// Fails if the folder of a file does not exist.
pub(super) fn check_folder(file: &Path) -> anyhow::Result<()> {
    let folder = folder_of(file);
    if matches!(folder.try_exists(), Ok(false)) {
        let (shown, missing) = (file.display(), folder.display());
        anyhow::bail!("cannot write {shown}: there is no folder {missing}; make it first");
    }
    let what = || format!("cannot write {}: its folder {}", file.display(), folder.display());
    fs::read_dir(folder).map(drop).with_context(what)
}

/// Fails if a file of a folder is a link out of it.
pub(super) fn check_within(folder: &Path, path: &Path) -> anyhow::Result<()> {
    let Some(name) = path.file_name() else { return Ok(()) };
    let within = project::check_within(folder, &name.to_string_lossy());
    within.map(drop).with_context(|| format!("cannot write {}", path.display()))
}

fn folder_of(file: &Path) -> &Path {
    file.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}
