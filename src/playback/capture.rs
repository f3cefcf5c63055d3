//! Writes pictures to disk, never over existing files.
//!
//! A project on disk stores its pictures in its own folder, next to its sources; any other (new, a preset) in the
//! user's pictures folder, or if there is none in the home folder. The file is `NAME-0001.png`, with the first free
//! number; NAME is the project's, with `-buffer_a` for a pass other than Image.

use crate::{npy, scene::Scene};
use eddy_engine::Pixels;
use eddy_project::{Origin, PassName, Project, confine};
use std::{
    fs::{self, File, OpenOptions},
    io::{self, BufWriter, Write},
    path::{Path, PathBuf},
};

/// The file format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// 8 bits per channel, as displayed.
    Png,
    /// The unconverted float texels.
    Npy,
}

impl Format {
    pub fn extension(self) -> &'static str {
        match self {
            Format::Png => "png",
            Format::Npy => "npy",
        }
    }
}

/// A picture could not be written. No existing file has been changed.
#[derive(Debug, thiserror::Error)]
pub enum CaptureError {
    #[error("cannot write {}: {source}", path.display())]
    Io { path: PathBuf, source: io::Error },
    #[error("{} already has all numbers up to {NAME_LIMIT} for {stem}; move some files away", folder.display())]
    NoNameLeft { folder: PathBuf, stem: String },
}

const NAME_LIMIT: u32 = 999_999;

/// Writes pixels in the given format to any writer: used by screenshots and `eddy render`.
pub fn encode(out: &mut impl Write, pixels: &Pixels, format: Format) -> io::Result<()> {
    match format {
        Format::Npy => npy::write(out, pixels),
        Format::Png => {
            use image::ImageEncoder;
            image::codecs::png::PngEncoder::new(out)
                .write_image(&pixels.to_rgba8(), pixels.width, pixels.height, image::ExtendedColorType::Rgba8)
                .map_err(|e| match e {
                    image::ImageError::IoError(e) => e,
                    other => io::Error::other(other),
                })
        }
    }
}

/// Does the same with the scene embedded in the file, if its format supports it.
pub fn encode_scene(out: &mut impl Write, pixels: &Pixels, format: Format, scene: Option<&Scene>) -> io::Result<()> {
    match scene {
        Some(scene) if format == Format::Png => {
            let mut png = Vec::new();
            encode(&mut png, pixels, format)?;
            out.write_all(&scene.embed(png)?)
        }
        _ => encode(out, pixels, format),
    }
}

/// Writes to a new numbered file in `folder` (created if necessary) and returns its path.
pub fn save_new(
    folder: &Path,
    stem: &str,
    pixels: &Pixels,
    format: Format,
    scene: Option<&Scene>,
) -> Result<PathBuf, CaptureError> {
    let name = |n| format!("{stem}-{n:04}.{}", format.extension());
    write_new(folder, name, stem, |out| encode_scene(out, pixels, format, scene))
}

/// Writes to the first of `name(1)`, `name(2)` … that does not exist.
pub fn write_new(
    folder: &Path,
    name: impl Fn(u32) -> String,
    stem: &str,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<PathBuf, CaptureError> {
    let failed = |path: &Path| {
        let path = path.to_owned();
        move |source| CaptureError::Io { path, source }
    };
    fs::create_dir_all(folder).map_err(failed(folder))?;
    for n in 1..=NAME_LIMIT {
        let path = folder.join(name(n));
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {}
            Err(e) => return Err(failed(&path)(e)),
            Ok(file) => {
                let mut out = BufWriter::new(file);
                let written = write(&mut out).and_then(|()| out.flush());
                drop(out);
                return match written {
                    Ok(()) => Ok(path),
                    Err(e) => {
                        // A partial picture is useless; no file of this name existed before.
                        let _ = fs::remove_file(&path);
                        Err(failed(&path)(e))
                    }
                };
            }
        }
    }
    Err(CaptureError::NoNameLeft { folder: folder.to_owned(), stem: stem.to_owned() })
}

/// The folder for pictures of this project; `pictures` if it has none of its own, or if its folder was deleted.
pub fn folder_for(project: &Project, pictures: &Path) -> PathBuf {
    base_folder(project).filter(|folder| folder.is_dir()).unwrap_or_else(|| pictures.to_owned())
}

/// The folder that contains a project on disk.
pub fn base_folder(project: &Project) -> Option<PathBuf> {
    let dir = match &project.origin {
        Origin::Unsaved | Origin::Preset(_) => return None,
        Origin::Folder { path, .. } => path.as_path(),
        Origin::File(path) | Origin::Json(path) => path.parent()?,
    };
    // The parent of a bare file name is the empty path, which means the current folder.
    Some(if dir.as_os_str().is_empty() { PathBuf::from(".") } else { dir.to_owned() })
}

/// The name of this project's pictures without their number, safe in any file system.
pub fn stem_for(project: &Project, pass: &PassName) -> String {
    let mut stem = file_stem(&project.name);
    if !pass.is_image() {
        stem.push('-');
        stem.push_str(&file_stem(pass.key()));
    }
    stem
}

/// A name that is valid in any file system: letters, digits, `-`, `_` and `.`; other runs become one `-`.
pub fn file_stem(name: &str) -> String {
    let mut stem = String::new();
    for c in name.chars().take(100) {
        if c.is_alphanumeric() || matches!(c, '_' | '.' | '-') {
            stem.push(c);
        } else if !stem.ends_with('-') {
            stem.push('-');
        }
    }
    let stem = stem.trim_matches(['-', '.']);
    let is_fit = !stem.is_empty() && !confine::is_reserved(stem);
    if is_fit { stem.into() } else { format!("picture{stem}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixels() -> Pixels {
        Pixels { width: 1, height: 2, texels: vec![[1.0, 0.0, 0.0, 1.0], [0.0, 2.0, f32::NAN, 1.0]] }
    }

    #[test]
    fn numbers_increase_and_nothing_is_overwritten() {
        let dir = tempfile::tempdir().unwrap();
        fs::write(dir.path().join("a-0001.png"), "mine").unwrap();
        fs::write(dir.path().join("a-0003.png"), "mine too").unwrap();
        let save = || save_new(dir.path(), "a", &pixels(), Format::Png, None).unwrap();
        let names: Vec<_> = [save(), save()].iter().map(|p| p.file_name().unwrap().to_owned()).collect();
        assert_eq!(names, ["a-0002.png", "a-0004.png"]);
        assert_eq!(fs::read_to_string(dir.path().join("a-0001.png")).unwrap(), "mine");
        assert_eq!(fs::read_to_string(dir.path().join("a-0003.png")).unwrap(), "mine too");
    }

    #[test]
    fn a_png_has_the_top_row_first() {
        let dir = tempfile::tempdir().unwrap();
        let path = save_new(&dir.path().join("new folder"), "a", &pixels(), Format::Png, None).unwrap();
        let image = image::open(path).unwrap().to_rgba8();
        assert_eq!(image.dimensions(), (1, 2));
        assert_eq!(image.as_raw()[..], [0, 255, 0, 255, 255, 0, 0, 255]);
    }

    #[test]
    fn failed_write_leaves_no_partial_file() {
        let dir = tempfile::tempdir().unwrap();
        let result = write_new(
            dir.path(),
            |n| format!("a-{n}"),
            "a",
            |out| {
                out.write_all(b"half")?;
                Err(io::Error::from(io::ErrorKind::StorageFull))
            },
        );
        assert!(matches!(result, Err(CaptureError::Io { .. })));
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 0);
        let file = dir.path().join("file");
        fs::write(&file, "").unwrap();
        assert!(save_new(&file, "a", &pixels(), Format::Png, None).is_err(), "a file is no folder");
    }

    #[test]
    fn file_stems_are_safe() {
        assert_eq!(file_stem("Fluid / Stars: 2"), "Fluid-Stars-2");
        assert_eq!(file_stem("../.."), "picture");
        assert_eq!(file_stem("nul.x"), "picturenul.x");
        assert_eq!(file_stem("Höhle"), "Höhle");
    }
}
