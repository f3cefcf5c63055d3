//! Errors when reading and writing a project.

use super::{FileError, limits};
use eddy_diag::{Diagnostic, SourceMap, render_all};
use std::{
    io,
    path::{Path, PathBuf},
};

/// A failure of [`super::load`] or [`super::save`]. Its text is complete: file, location and fix.
#[derive(Debug, thiserror::Error)]
pub enum ProjectError {
    /// An error of the system: permissions, a full disk, a file that vanished.
    #[error("cannot {action} {}: {source}", path.display())]
    Io { action: &'static str, path: PathBuf, source: io::Error },
    /// An error of the author: the files are not a valid project. Contains at least one error.
    #[error("{what} is not a usable project\n{}", render_all(diagnostics, sources))]
    Invalid { what: String, diagnostics: Vec<Diagnostic>, sources: SourceMap },
    /// A name that does not resolve to a project.
    #[error(
        "{spec}: not a file, a folder or a preset{}; presets are {}",
        did_you_mean(near.as_deref()),
        presets_listed(presets)
    )]
    NotFound { spec: String, near: Option<String>, presets: Vec<String> },
    /// An existing file of a kind that is not a project.
    #[error(
        "{}: {}not a project file; a project is a folder, a .glsl file, a Shadertoy .json file or a preset's name",
        path.display(),
        foreign(path)
    )]
    UnknownKind { path: PathBuf },
    /// A file that must not be read: it is outside the folder, is not a regular file, or is too large.
    #[error("{error}; {}", error.hint())]
    File {
        #[from]
        error: FileError,
    },
    /// A name under which no file may be written.
    #[error("cannot write {}: {why}", path.display())]
    Unwritable { path: PathBuf, why: String },
    #[error("{} has more than {} files; choose a folder with only the project", path.display(), limits::FILES)]
    TooManyFiles { path: PathBuf },
    /// Saving would replace these files, which do not belong to this project; at least one.
    #[error("{}; choose another place or allow overwriting", in_the_way(paths))]
    WouldOverwrite { paths: Vec<PathBuf> },
    /// Saving in this form would lose something.
    #[error("{} cannot store {what}; save the project to a separate folder", path.display())]
    CannotHold { path: PathBuf, what: String },
}

fn did_you_mean(near: Option<&str>) -> String {
    near.map(|n| format!(" (did you mean {n}?)")).unwrap_or_default()
}

/// Formats the list of files in the way, by name.
fn in_the_way(paths: &[PathBuf]) -> String {
    let names: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
    let of_project = if names.len() == 1 { "exists and is" } else { "exist and are" };
    format!("{} {of_project} not part of this project", super::listed(&names))
}

fn presets_listed(presets: &[String]) -> String {
    if presets.is_empty() { "none in this build".into() } else { super::listed(presets) }
}

impl ProjectError {
    pub(super) fn io(action: &'static str, path: &Path) -> impl FnOnce(io::Error) -> ProjectError {
        let path = path.to_owned();
        move |source| ProjectError::Io { action, path, source }
    }

    /// Returns the diagnostics that the author has to fix, if there are any.
    pub fn diagnostics(&self) -> Option<(&[Diagnostic], &SourceMap)> {
        match self {
            ProjectError::Invalid { diagnostics, sources, .. } => Some((diagnostics, sources)),
            _ => None,
        }
    }
}

/// Describes a file of another tool, by its extension.
fn foreign(path: &Path) -> String {
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let is = match ending.as_str() {
        "wgsl" => "WGSL code",
        "hlsl" | "hlsli" | "cginc" | "usf" | "ush" => "HLSL code",
        "fx" | "fxh" => "an HLSL effect",
        "metal" | "msl" => "Metal code",
        "gdshader" | "gdshaderinc" => "a Godot shader",
        "shader" => "a Unity or OBS Studio shader",
        "slang" | "slangp" | "glslp" | "cgp" => "a RetroArch shader or Slang code",
        "osl" => "OSL code",
        "isf" => "an ISF shader",
        "kodeproj" => "a KodeLife project",
        "sprj" => "a SHADERed project",
        "toe" | "tox" => "a TouchDesigner file",
        "spv" => "a compiled shader",
        "replay" => "a recording of input (drop it on the window, or use --replay)",
        _ => return String::new(),
    };
    format!("{is}, ")
}
