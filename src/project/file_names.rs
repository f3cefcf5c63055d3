//! A file is a pass by its name; the convention is in [`super::folder`].

use super::PassId;
use eddy_diag::Diagnostic;
use std::{ffi::OsStr, path::Path};

pub(super) fn is_glsl_extension(extension: &OsStr) -> bool {
    ["glsl", "frag", "fs"].iter().any(|e| extension.eq_ignore_ascii_case(e))
}

/// The endings of vertex shaders, which are no passes.
pub(super) fn is_vertex_extension(extension: &OsStr) -> bool {
    ["vert", "vs", "vertex"].iter().any(|e| extension.eq_ignore_ascii_case(e))
}

/// The pass a file is by its stem; `None` for Common and for files that are not of the convention.
pub(super) fn pass_of_stem(stem: &str) -> Option<PassId> {
    match PassId::parse(stem)? {
        PassId::Buffer(name) => is_buffer(stem).then_some(PassId::Buffer(name)),
        other => Some(other),
    }
}

fn is_buffer(stem: &str) -> bool {
    let lower = stem.to_lowercase();
    lower.strip_prefix("buffer").is_some_and(|rest| !rest.is_empty())
        || lower.strip_prefix("buf").is_some_and(|rest| rest.len() == 1 || rest.starts_with([' ', '_', '-']))
}

/// Returns what is wrong with a file that would be a buffer if its name were one.
pub(super) fn misnamed(file: &str) -> Option<Diagnostic> {
    let path = Path::new(file);
    let stem = path.file_stem()?.to_str().filter(|stem| is_buffer(stem) && PassId::parse(stem).is_none())?;
    path.extension().filter(|e| is_glsl_extension(e))?;
    let message = format!("{file} is not a pass: \"{}\" is not a valid buffer name", stem.escape_debug());
    Some(Diagnostic::warning(None, message).hint(PassId::NAMES))
}

/// Says which text of a project a file is by convention.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Role {
    Common,
    Pass(PassId),
}

pub(super) fn role_of_file(name: &str) -> Option<Role> {
    let path = Path::new(name);
    if !path.extension().is_some_and(is_glsl_extension) {
        return None;
    }
    let stem = path.file_stem()?.to_str()?;
    if stem.eq_ignore_ascii_case("common") { Some(Role::Common) } else { pass_of_stem(stem).map(Role::Pass) }
}
