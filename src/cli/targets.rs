//! The files that pictures are written to. They are worked out for all frames of all projects before anything is drawn,
//! so that no picture of a call is written over another one of it.

use super::{
    args::{RenderArgs, face_of, format_of},
    sweep,
};
use crate::{
    engine::Pixels,
    playback::capture::{self, Format},
    project,
};
use anyhow::Context;
use std::{
    collections::HashMap,
    fs,
    io::{BufWriter, Write},
    path::{Path, PathBuf},
};

/// Digits of a frame's number in a name, more where the last frame needs more.
const LEAST_DIGITS: usize = 4;

/// The files that one call writes pictures to.
#[derive(Debug, PartialEq, Eq)]
pub struct Targets {
    pub format: Format,
    /// Frames to write, rising, each once.
    pub at: Vec<u32>,
    /// Frames to draw: past the last one written.
    pub frames: u32,
    /// The assignments of each drawing of a project.
    pub sweep: Vec<Vec<String>>,
    place: Output,
}

#[derive(Debug, PartialEq, Eq)]
enum Output {
    Nowhere,
    /// One picture.
    File(PathBuf),
    /// A folder, and the stem of each project in it.
    Folder(PathBuf, Vec<String>),
}

impl Targets {
    /// Err: what was asked for cannot be meant.
    pub fn of(args: &RenderArgs) -> Result<Targets, String> {
        face_of(&args.pass.pass, args.face)?;
        let (at, frames) = frames(args)?;
        let sweep = sweep::combinations(&args.sweep)?;
        let Some(out) = &args.out else {
            let format = args.format.unwrap_or(Format::Png);
            return Ok(Targets { format, at, frames, sweep, place: Output::Nowhere });
        };
        let shown = out.display();
        let named = out.extension().and_then(|e| format_of(&e.to_string_lossy()));
        let named =
            if out.is_dir() { None } else { named.transpose().map_err(|why| format!("--out {shown}: {why}"))? };
        let Some(named) = named else {
            let place = Output::Folder(out.clone(), stems(&args.project, || tells_case_apart(out))?);
            return Ok(Targets { format: args.format.unwrap_or(Format::Png), at, frames, sweep, place });
        };
        if let Some(format) = args.format
            && format != named
        {
            return Err(format!("--out {shown} and --format {} do not agree", format.extension()));
        }
        let pictures = args.project.len() * sweep.len() * at.len();
        if pictures != 1 {
            return Err(format!("--out {shown} is one file, but {pictures} pictures would be written: give a folder"));
        }
        Ok(Targets { format: named, at, frames, sweep, place: Output::File(out.clone()) })
    }

    /// Makes the folder, so that a place nothing can be written to is known before hours of drawing.
    pub fn prepare(&self) -> anyhow::Result<()> {
        match &self.place {
            Output::Nowhere => Ok(()),
            Output::File(file) => check_folder(file),
            Output::Folder(folder, _) => {
                fs::create_dir_all(folder).with_context(|| format!("cannot create the folder {}", folder.display()))
            }
        }
    }

    /// Returns how many digits a frame's number has in a name: as many as the last one needs, so that names in their
    /// order are frames in theirs.
    fn digits(&self) -> usize {
        self.at.last().map_or(0, |last| last.to_string().len()).max(LEAST_DIGITS)
    }

    /// Writes a picture to where [`Targets::path`] says. In a folder, nothing is written through a link that leads out of
    /// it.
    pub fn write(&self, path: &Path, pixels: &Pixels) -> anyhow::Result<()> {
        if let Output::Folder(folder, _) = &self.place {
            check_within(folder, path)?;
        }
        write(path, pixels, self.format)
    }

    /// The file for a frame of a project, counted as on the command line, where `swept` is set.
    pub fn path(&self, project: usize, swept: &[String], frame: u32) -> Option<PathBuf> {
        match &self.place {
            Output::Nowhere => None,
            Output::File(file) => Some(file.clone()),
            Output::Folder(folder, stems) => {
                let (mut stem, extension) = (stems[project].clone(), self.format.extension());
                swept.iter().for_each(|set| stem.push_str(&format!("_{set}")));
                Some(folder.join(match self.at.len() {
                    1 => format!("{stem}.{extension}"),
                    _ => format!("{stem}_{frame:0digits$}.{extension}", digits = self.digits()),
                }))
            }
        }
    }
}

fn frames(args: &RenderArgs) -> Result<(Vec<u32>, u32), String> {
    let mut at = args.at.clone();
    at.sort_unstable();
    at.dedup();
    let needed = at.last().map_or(1, |last| last + 1);
    let all = if at.is_empty() { args.run.recorded().unwrap_or(needed) } else { needed };
    let frames = args.frames.unwrap_or(all);
    args.run.within_recording(frames)?;
    if frames < needed {
        return Err(format!("--at {}: with --frames {frames} the last frame is {}", needed - 1, frames - 1));
    }
    if at.is_empty() {
        at.push(frames - 1);
    }
    Ok((at, frames))
}

/// Returns the name of each project's file without its ending.
///
/// `case_counts`: whether the file system tells `Fluid.png` from `fluid.png`; asked only where it matters.
pub fn stems(projects: &[String], case_counts: impl Fn() -> bool) -> Result<Vec<String>, String> {
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

/// Returns whether files whose names differ by case alone are two files in a folder that may not be there yet. Tried
/// out, as one machine can have both kinds of file systems; where nothing can be written, no.
pub fn tells_case_apart(folder: &Path) -> bool {
    let there =
        folder.ancestors().map(|p| if p.as_os_str().is_empty() { Path::new(".") } else { p }).find(|p| p.is_dir());
    let file = there.and_then(|there| tempfile::Builder::new().prefix(".eddy-Case-").tempfile_in(there).ok());
    file.is_some_and(|file| {
        let name = file.path().file_name().map(|n| n.to_string_lossy().to_lowercase());
        name.is_some_and(|name| !file.path().with_file_name(name).exists())
    })
}

/// Writes a picture whole or not at all: a picture of the same name stays until the new one is complete.
pub fn write(path: &Path, pixels: &Pixels, format: Format) -> anyhow::Result<()> {
    let written = project::write_with(path, |file| {
        let mut out = BufWriter::new(file);
        capture::encode(&mut out, pixels, format)?;
        out.flush()
    });
    written.with_context(|| format!("cannot write {}", path.display()))
}

/// Fails for a file of a folder that is not there.
pub fn check_folder(file: &Path) -> anyhow::Result<()> {
    let folder = folder_of(file);
    let what = || format!("cannot write {}: its folder {}", file.display(), folder.display());
    fs::read_dir(folder).map(drop).with_context(what)
}

/// Fails for a file of a folder that is a link out of it.
pub fn check_within(folder: &Path, path: &Path) -> anyhow::Result<()> {
    let Some(name) = path.file_name() else { return Ok(()) };
    let within = project::check_within(folder, &name.to_string_lossy());
    within.map(drop).with_context(|| format!("cannot write {}", path.display()))
}

fn folder_of(file: &Path) -> &Path {
    file.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::args::{Cli, Command};
    use clap::Parser;

    fn targets(line: &str) -> Result<Targets, String> {
        match Cli::parse_from(["eddy", "render"].into_iter().chain(line.split(' '))).command {
            Some(Command::Render(args)) => Targets::of(&args),
            _ => unreachable!(),
        }
    }

    fn path(line: &str, project: usize, frame: u32) -> String {
        targets(line).unwrap().path(project, &[], frame).unwrap().to_string_lossy().into_owned()
    }

    #[test]
    fn one_frame_has_the_stem_and_several_have_numbers() {
        assert_eq!(path("fluid x/a.b.json --out o --frames 9", 0, 8), "o/fluid.png");
        assert_eq!(path("fluid x/a.b.json --out o --frames 9", 1, 8), "o/a.b.png");
        assert_eq!(path("fluid --out o --at 4,9999 --format npy", 0, 4), "o/fluid_0004.npy");
        assert_eq!(path("fluid --out o --at 12345,4 --format npy", 0, 4), "o/fluid_00004.npy");
        assert_eq!(path("fluid --out o --at 0,1000000 --frames 12345678", 0, 0), "o/fluid_0000000.png");
        assert_eq!(path("fluid --out o --at 4,12345 --format npy", 0, 12345), "o/fluid_12345.npy");
        assert_eq!(path("fluid --out a.v1/x.npy", 0, 0), "a.v1/x.npy");
        assert_eq!(path("src/ --out o", 0, 0), "o/src.png");
        assert_ne!(path(". --out o", 0, 0), "o/picture.png", "the folder's name is looked up");
        let swept = targets("fluid --out o --sweep a=0..1:3 --sweep b=1;2 --at 1,2").unwrap();
        let (last, folder) = (swept.sweep.last().unwrap(), Path::new("o"));
        assert_eq!(swept.sweep.len(), 6);
        assert_eq!(swept.path(0, last, 2).unwrap(), folder.join("fluid_a=1_b=2_0002.png"));
    }

    #[test]
    fn frames_follow_what_is_written() {
        let of = |line| targets(line).map(|t| (t.at, t.frames));
        assert_eq!(of("a --out o"), Ok((vec![0], 1)));
        assert_eq!(of("a --out o --frames 9"), Ok((vec![8], 9)));
        assert_eq!(of("a --out o --at 8,2,2"), Ok((vec![2, 8], 9)));
        assert_eq!(of("a --out o --at 2 --frames 9"), Ok((vec![2], 9)));
        assert!(of("a --out o --at 9 --frames 9").unwrap_err().contains("the last frame is 8"));
    }

    #[test]
    fn no_picture_is_written_over_another_of_the_same_call() {
        for (line, says) in [
            ("a b --out x.png", "2 pictures"),
            ("a --out x.png --at 1,2", "2 pictures"),
            ("a --out x.png --sweep b=1;2", "2 pictures"),
            ("a --out o --sweep b=1;2 --sweep b=3;4", "listed twice"),
            ("x/a.json y/a.json --out o", "x/a.json and y/a.json"),
            ("fluid fluid --out o", "would both be written"),
            ("a --out x.png --format npy", "do not agree"),
            ("a --out x.exr", "cannot write exr"),
        ] {
            let message = targets(line).expect_err(line);
            assert!(message.contains(says), "{line}: {message}");
        }
        assert_eq!(targets("fluid fluid --json").unwrap().path(0, &[], 0), None);
    }

    #[test]
    fn names_that_differ_by_case_alone_are_two_where_the_files_are() {
        let list = |names: &[&str]| -> Vec<String> { names.iter().map(|n| (*n).to_owned()).collect() };
        let pair = list(&["x/a.json", "x/A.json"]);
        assert_eq!(stems(&pair, || true), Ok(list(&["a", "A"])));
        assert!(stems(&pair, || false).unwrap_err().contains("would both be written as A"));
        let three = list(&["x/a.json", "x/A.json", "y/a.json"]);
        assert!(stems(&three, || true).unwrap_err().contains("x/a.json and y/a.json"));
        assert!(stems(&list(&["a", "b"]), || panic!("nothing to ask")).is_ok());

        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("a"), "1").unwrap();
        fs::write(folder.path().join("A"), "2").unwrap();
        let are_two = fs::read_to_string(folder.path().join("a")).unwrap() == "1";
        assert_eq!(tells_case_apart(&folder.path().join("not/there/yet")), are_two);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1 + usize::from(are_two), "nothing is left behind");
    }
}
