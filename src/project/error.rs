//! Errors of reading and writing a project.

use super::{FileError, limits};
use eddy_diag::{Diagnostic, SourceMap, render_all};
use std::{
    io,
    path::{Path, PathBuf},
};

/// Failure of [`super::load`] or [`super::save`]. Its text is complete: file, place and mend.
#[derive(Debug, thiserror::Error)]
pub enum ProjectError {
    /// The machine's: permissions, a full disk, a file that vanished.
    #[error("cannot {action} {}: {source}", path.display())]
    Io { action: &'static str, path: PathBuf, source: io::Error },
    /// The author's: what the files say makes no project. Holds at least one error.
    #[error("{what} is not a usable project\n{}", render_all(diagnostics, sources))]
    Invalid { what: String, diagnostics: Vec<Diagnostic>, sources: SourceMap },
    /// A name that means nothing here.
    #[error(
        "{spec}: not a file, a folder or a preset{}; presets are {}",
        did_you_mean(near.as_deref()),
        presets_listed(presets)
    )]
    NotFound { spec: String, near: Option<String>, presets: Vec<String> },
    /// A file that is there, of a kind no project comes in.
    #[error(
        "{}: {}not a project file; a project is a folder, a .glsl file, a Shadertoy .json file or a preset's name",
        path.display(),
        foreign(path)
    )]
    UnknownKind { path: PathBuf },
    /// A file that may not be read: it lies outside the folder, is no regular file, or is too large.
    #[error("{error}; {}", error.hint())]
    File {
        #[from]
        error: FileError,
    },
    /// A name under which nothing may be written.
    #[error("cannot write {}: {why}", path.display())]
    Unwritable { path: PathBuf, why: String },
    #[error("{} has more than {} files; choose a folder with only the project", path.display(), limits::FILES)]
    TooManyFiles { path: PathBuf },
    /// Saving would replace these files, all that are not this project's; at least one.
    #[error("{}; choose another place or allow overwriting", in_the_way(paths))]
    WouldOverwrite { paths: Vec<PathBuf> },
    /// Saving in this form would lose something.
    #[error("{} cannot store {what}; save the project to a separate folder", path.display())]
    CannotHold { path: PathBuf, what: String },
}

fn did_you_mean(near: Option<&str>) -> String {
    near.map(|n| format!(" (did you mean {n}?)")).unwrap_or_default()
}

/// Says which files are in the way, each by its name.
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

    /// Returns what the author has to mend, where it is theirs.
    pub fn diagnostics(&self) -> Option<(&[Diagnostic], &SourceMap)> {
        match self {
            ProjectError::Invalid { diagnostics, sources, .. } => Some((diagnostics, sources)),
            _ => None,
        }
    }
}

/// Returns what a file of another tool is, by its ending.
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
