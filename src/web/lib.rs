//! Exports a project as one HTML file that plays it in a browser by WebGL 2.
//!
//! Owns the player (`player/`), the GLSL that it compiles, the description of passes that it draws by, and the page
//! with its content security policy. The GLSL is the author's own: only lines that are not GLSL are replaced. Writes no
//! files, and reads only those that `media` reads.
//!
//! The page loads nothing: texts, meshes, image files and sounds are embedded. The same project results in the same
//! bytes.

mod data;
mod describe;
mod inline;
mod page;
#[cfg(test)]
mod tests;
mod texts;

use eddy_diag::{self as diag, Diagnostic};
use eddy_engine::{CompiledPass, Sources, pass_kind};
use eddy_glsl::{Driver, PassKind};
use eddy_media::{MediaSet, gather};
use eddy_project::{Dialect, FillKind, Pass, Project};
use std::path::Path;

/// The size limit of the page without texts, meshes and media.
pub const PLAYER_BYTES: usize = 40_000;

/// A page, and diagnostics for its author.
#[derive(Debug)]
pub struct Page {
    pub html: String,
    /// Warnings of the compiler, and about features that the page does not support.
    pub diagnostics: Vec<Diagnostic>,
    /// The bytes of the page for image files, sounds, videos and meshes.
    pub media_bytes: usize,
}

/// Exports a project with the media that it names. `media_dir` contains the user's own copies of Shadertoy's files.
/// Returns the errors of the compiler and of files, each with its place.
pub fn export(project: &Project, media_dir: Option<&Path>) -> Result<Page, Vec<Diagnostic>> {
    if project.dialect == Dialect::Ghostty {
        let message = "the page has no terminal, and none of the uniforms that Ghostty sets";
        return Err(vec![
            Diagnostic::error(None, message).hint("render a film in its place: eddy render --as ghostty"),
        ]);
    }
    let is_main = |pass: &Pass| matches!(pass_kind(project, pass), PassKind::Main(_));
    if project.passes.iter().any(is_main) {
        let title = project.dialect.row().title;
        let message = format!("the page runs the GLSL of Shadertoy, and this is a shader of {title}");
        let hint = "translate it with `eddy translate --to glsl`, or render a film with `eddy render`";
        return Err(vec![Diagnostic::error(None, message).hint(hint)]);
    }
    let texts = Sources::new(project);
    let mut found = texts.diagnostics.clone();
    let mut passes = Vec::new();
    for index in 0..project.passes.len() {
        for kind in FillKind::ALL {
            match texts.compile_fill(index, kind, false, Driver::default()) {
                Some(Ok(mut fill)) => diag::append(&mut found, fill.diagnostics.drain(..)),
                Some(Err(errors)) => diag::append(&mut found, errors),
                None => {}
            }
        }
        match texts.compile_pass(index, Driver::default()) {
            Ok(mut compiled) => {
                diag::append(&mut found, compiled.diagnostics.drain(..));
                passes.push(compiled);
            }
            Err(errors) => diag::append(&mut found, errors),
        }
    }
    if found.iter().any(Diagnostic::is_error) {
        return Err(found);
    }
    let (media, warnings) = gather(project, media_dir);
    found.extend(warnings);
    found.extend(media.fill_errors(project));
    found.extend(media.mesh_errors(project));
    if found.iter().any(Diagnostic::is_error) {
        return Err(found);
    }
    Ok(written(project, (&texts, &passes), (&media, media_dir), found))
}

fn written(
    project: &Project,
    (texts, passes): (&Sources<'_>, &[CompiledPass]),
    (media, media_dir): (&MediaSet, Option<&Path>),
    mut found: Vec<Diagnostic>,
) -> Page {
    let mut inlined = inline::Inlined::new(project, media, media_dir);
    let described = describe::describe(project, (texts, passes), &mut inlined);
    found.append(&mut inlined.warnings);
    let html = page::page(project, &described);
    Page { html, diagnostics: found, media_bytes: inlined.bytes }
}
