//! Maps file names to passes; the convention is in [`super::folder`].

use super::PassName;
use eddy_diag::Diagnostic;
use std::{ffi::OsStr, path::Path};

pub(super) fn is_glsl_extension(extension: &OsStr) -> bool {
    ["glsl", "frag", "fs"].iter().any(|e| extension.eq_ignore_ascii_case(e))
}

/// The extensions of vertex shaders, which are not passes.
pub(super) fn is_vertex_extension(extension: &OsStr) -> bool {
    ["vert", "vs", "vertex"].iter().any(|e| extension.eq_ignore_ascii_case(e))
}

/// Returns the pass that a file stem names; `None` for Common and for other files.
pub(super) fn pass_of_stem(stem: &str) -> Option<PassName> {
    PassName::parse(stem).filter(|pass| !pass.is_buffer() || is_buffer(stem))
}

fn is_buffer(stem: &str) -> bool {
    let lower = stem.to_lowercase();
    lower.strip_prefix("buffer").is_some_and(|rest| !rest.is_empty())
        || lower.strip_prefix("buf").is_some_and(|rest| rest.len() == 1 || rest.starts_with([' ', '_', '-']))
}

/// Returns the error for a file that would be a buffer if its name were valid.
pub(super) fn misnamed(file: &str) -> Option<Diagnostic> {
    let path = Path::new(file);
    let stem = path.file_stem()?.to_str().filter(|stem| is_buffer(stem) && PassName::parse(stem).is_none())?;
    path.extension().filter(|e| is_glsl_extension(e))?;
    let message = format!("{file} is not a pass: \"{}\" is not a valid buffer name", stem.escape_debug());
    Some(Diagnostic::warning(None, message).hint(PassName::NAMES))
}

/// The role that a file's name gives to its text.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum FileRole {
    Common,
    Pass(PassName),
}

pub(super) fn role_of_file(name: &str) -> Option<FileRole> {
    let path = Path::new(name);
    if !path.extension().is_some_and(is_glsl_extension) {
        return None;
    }
    let stem = path.file_stem()?.to_str()?;
    if stem.eq_ignore_ascii_case("common") { Some(FileRole::Common) } else { pass_of_stem(stem).map(FileRole::Pass) }
}

/// Returns whether a file's name makes it the Image pass.
pub(super) fn is_image_file(name: &str) -> bool {
    matches!(role_of_file(name), Some(FileRole::Pass(pass)) if pass.is_image())
}
