//! Pasted text: Shadertoy JSON, GLSL, the name of a file, or an address.

use crate::{Loaded, Project, ProjectError, Role, folder, json, limits, presets, unescaped};
use eddy_diag::Diagnostic;
use std::path::Path;

/// A recognised text.
#[derive(Debug)]
pub enum TextImport {
    /// The text is itself a project, which is not on disk.
    Project(Box<Loaded>),
    /// The text names a project, as [`crate::load`] accepts it, or a file of another kind.
    Place(String),
}

/// A text that cannot be imported.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    #[error("the clipboard is empty; copy the JSON of a shader, GLSL code or the path of a file first")]
    Empty,
    /// An address on Shadertoy, with the shader's id if it has one.
    #[error(
        "{address} is a web address, and Eddy does not download. Open the page in a browser, save the shader with \
         the bookmarklet (\"Open Shadertoy bookmarklet page\" in the command palette), and drop or paste the JSON here"
    )]
    Site { address: String },
    #[error("{address} is a web address, and Eddy does not download; save the file and drop it here")]
    Address { address: String },
    #[error("there is no file {0}")]
    NoFile(String),
    #[error(
        "the text is neither Shadertoy JSON (which starts with {{ or [), nor GLSL with a mainImage function, nor \
         the path of a file: it starts with \"{0}\""
    )]
    Unknown(String),
    #[error("{error}")]
    Project {
        #[from]
        error: Box<ProjectError>,
    },
}

/// Classifies a pasted text.
pub fn import_of_text(text: &str) -> Result<TextImport, ImportError> {
    let trimmed = text.trim_start_matches('\u{feff}').trim();
    if trimmed.is_empty() {
        return Err(ImportError::Empty);
    }
    if trimmed.starts_with(['{', '[']) {
        return of_json(trimmed).map_err(|e| Box::new(e).into());
    }
    let is_line = !trimmed.contains(['\n', '\r']);
    if is_line && let Some(found) = of_line(trimmed.trim_matches(['"', '\''])) {
        return found;
    }
    if has_main(trimmed) {
        return of_glsl(text).map_err(|e| Box::new(e).into());
    }
    let beginning: String = trimmed.chars().take(40).collect();
    Err(ImportError::Unknown(beginning.escape_debug().to_string()))
}

fn of_json(text: &str) -> Result<TextImport, ProjectError> {
    let (mut project, warnings) = json::import(text, "pasted.json")?;
    if matches!(project.name.trim(), "" | "pasted") {
        project.name = "Pasted shader".into();
    }
    project.read_includes();
    Ok(TextImport::Project(Box::new(Loaded { sources: project.sources(), project, warnings })))
}

/// A single line: an address, or the name of a file or a preset. `None` if it is neither.
fn of_line(line: &str) -> Option<Result<TextImport, ImportError>> {
    let lower = line.to_lowercase();
    if let Some(rest) = lower.starts_with("file://").then(|| &line["file://".len()..]) {
        let path = unescaped(rest.strip_prefix("localhost").unwrap_or(rest));
        let is_there = Path::new(&path).exists();
        return Some(if is_there { Ok(TextImport::Place(path)) } else { Err(ImportError::NoFile(path)) });
    }
    let bare = lower.trim_start_matches("https://").trim_start_matches("http://").trim_start_matches("www.");
    let is_address = lower.starts_with("http://") || lower.starts_with("https://");
    if bare.starts_with("shadertoy.com") {
        return Some(Err(ImportError::Site { address: shown(line) }));
    }
    if is_address {
        return Some(Err(ImportError::Address { address: shown(line) }));
    }
    let is_place = presets::names().contains(&line) || (line.len() < 4096 && Path::new(line).exists());
    if is_place {
        return Some(Ok(TextImport::Place(line.to_owned())));
    }
    let looks_like_path = line.starts_with(['/', '~']) && !line.starts_with("//") && !line.starts_with("/*");
    (looks_like_path && !has_main(line)).then(|| Err(ImportError::NoFile(shown(line))))
}

fn shown(line: &str) -> String {
    line.chars().take(120).collect()
}

/// Returns whether a text has the entry point of a pass.
fn has_main(text: &str) -> bool {
    Role::all().map(|kind| kind.row().entry).chain(["void main"]).any(|main| text.contains(main))
}

/// A project whose Image pass is the text; its `#iChannel` lines declare its inputs.
fn of_glsl(text: &str) -> Result<TextImport, ProjectError> {
    let too_large = |diagnostics: Vec<Diagnostic>, sources| {
        Err(ProjectError::Invalid { what: "the pasted text".into(), diagnostics, sources })
    };
    if text.len() as u64 > limits::GLSL_TEXT.bytes {
        let message = format!("the text is larger than {}", limits::GLSL_TEXT);
        return too_large(vec![Diagnostic::error(None, message).hint("shorten it")], Default::default());
    }
    let text = text.replace("\r\n", "\n");
    let mut project = Project::of_image("Pasted shader".into(), text);
    // Errors in such lines appear when the project is compiled.
    let warnings = folder::declare_channels(&mut project).into_iter().filter(|d| !d.is_error()).collect();
    project.read_includes();
    Ok(TextImport::Project(Box::new(Loaded { sources: project.sources(), project, warnings })))
}
