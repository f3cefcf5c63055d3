//! Loads files as a [`Project`].

use super::{
    Dialect, Origin, Pass, PassName, Project, ProjectError, ShaderForm, Source,
    atomic::sweep,
    confine, dialect, file_names,
    files::{self, EditedTexts, Files, MANIFEST, Read},
    folder, includes, isf, json,
    limits::{self, Limit},
    manifest,
};
use eddy_diag::{Diagnostic, SourceMap};
use std::path::Path;

/// A folder's own name, also for `.` and `..`.
pub(super) fn folder_name(path: &Path) -> String {
    let name = |p: &Path| p.file_name().map(|n| n.to_string_lossy().into_owned());
    name(path)
        .or_else(|| name(&path.canonicalize().ok()?))
        .filter(|n| !n.is_empty())
        .unwrap_or_else(|| "project".into())
}

pub(super) fn load_folder(path: &Path) -> Result<Loaded, ProjectError> {
    sweep(path);
    of_folder(path, &Files::on_disk(path))
}

/// Loads a folder; texts of an editor override its files. Removes nothing from it.
pub(super) fn load_edited_folder(path: &Path, edited: &EditedTexts) -> Result<Loaded, ProjectError> {
    of_folder(path, &Files::edited(path, edited))
}

fn of_folder(path: &Path, files: &Files<'_>) -> Result<Loaded, ProjectError> {
    let has_manifest = files.exists(MANIFEST);
    let origin = Origin::Folder { path: path.to_owned(), has_manifest };
    load_files(&path.display().to_string(), folder_name(path), files, origin)
}

/// Loads a folder on disk or in the binary. `what` names it in errors.
pub(super) fn load_files(what: &str, name: String, files: &Files<'_>, origin: Origin) -> Result<Loaded, ProjectError> {
    let manifest_text = match files.read(MANIFEST, limits::MANIFEST) {
        Read::Refused(error) => return Err(error.into()),
        Read::Missing => return finish(what, by_convention(what, name, files, origin)?),
        Read::Text(text) => text,
        Read::NotUtf8(at, lossy) => {
            let mut sources = SourceMap::default();
            let diagnostics = vec![files::not_utf8(&mut sources, MANIFEST, at, lossy)];
            return Err(ProjectError::Invalid { what: what.to_owned(), diagnostics, sources });
        }
    };
    finish(what, manifest::project(what, name, &manifest_text, files, origin)?)
}

fn by_convention(what: &str, name: String, files: &Files<'_>, origin: Origin) -> Result<Loaded, ProjectError> {
    let mut texts = Vec::new();
    let mut sources = SourceMap::default();
    let mut diagnostics = Vec::new();
    let mut said = Vec::new();
    for file in files.names()? {
        if file_names::role_of_file(&file).is_none() {
            said.extend(file_names::misnamed(&file));
            continue;
        }
        if texts.len() == limits::PASSES {
            let message = format!("the project has more than {} passes, the limit", limits::PASSES);
            diagnostics.push(Diagnostic::error(None, message).hint("remove some of their files from the folder"));
            break;
        }
        match files.read(&file, limits::GLSL_TEXT) {
            Read::Refused(error) if error.is_of_machine() => return Err(error.into()),
            Read::Refused(error) => {
                diagnostics.push(Diagnostic::error(None, error.to_string()).hint(error.hint()));
            }
            Read::Text(text) => texts.push(Source { path: files.path(&file), name: file, text: text.into() }),
            Read::NotUtf8(at, lossy) => diagnostics.push(files::not_utf8(&mut sources, &file, at, lossy)),
            // Removed between the listing and the reading: treat it as missing.
            Read::Missing => {}
        }
    }
    if !diagnostics.is_empty() {
        return Err(ProjectError::Invalid { what: what.to_owned(), diagnostics, sources });
    }
    let (mut project, mut warnings) = folder::project(name, texts, origin, Some(files));
    warnings.extend(said);
    includes::read(&mut project, Some(files));
    Ok(Loaded { sources: project.sources(), project, warnings })
}

/// Loads the project of one GLSL file, ignoring the files that lines in it name.
pub(super) fn load_glsl_alone(path: &Path) -> Result<Loaded, ProjectError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let text = read_text(path, &name, limits::GLSL_TEXT)?;
    let project = of_glsl(path, name, text);
    Ok(Loaded { sources: project.sources(), project, warnings: Vec::new() })
}

fn of_glsl(path: &Path, name: String, text: String) -> Project {
    Project::new(
        path.file_stem().unwrap_or_default().to_string_lossy(),
        vec![Pass::new(PassName::image(), Source { name, path: Some(path.to_owned()), text: text.into() })],
        Origin::File(path.to_owned()),
    )
}

pub(super) fn load_glsl(path: &Path, edited: &EditedTexts) -> Result<Loaded, ProjectError> {
    let of_vertex = isf::isf_of_vertex_shader(path, edited);
    let path = of_vertex.as_deref().unwrap_or(path);
    let what = path.display().to_string();
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let text = match edited.get(path).filter(|text| text.len() as u64 <= limits::GLSL_TEXT.bytes) {
        Some(text) => text.to_string(),
        None => read_text(path, &name, limits::GLSL_TEXT)?,
    };
    let folder = path.parent().unwrap_or(Path::new(""));
    let files = Files::edited(folder, edited);
    if let Some(dialect) = ShaderForm::of(path, &text).main_dialect().filter(|dialect| *dialect != Dialect::Isf) {
        return dialect::load(path, (&name, &text), &files, dialect);
    }
    if let Some(isf) = isf::load(path, (&name, &text), &files) {
        return isf;
    }
    let mut project = of_glsl(path, name, text);
    let warnings = folder::channels(&mut project, &files);
    includes::read(&mut project, Some(&files));
    finish(&what, Loaded { sources: project.sources(), project, warnings })
}

/// Loads a Shadertoy JSON file. `wanted` selects one of several shaders, as in [`json::import_one`].
pub(super) fn load_json(path: &Path, wanted: Option<&str>) -> Result<Loaded, ProjectError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let folder = path.parent().unwrap_or(Path::new(""));
    let bytes = confine::read(folder, &name, limits::JSON)?;
    let text = match json::utf16(&bytes) {
        Some(text) => text,
        None => text_of(path, &name, bytes)?,
    };
    let (mut project, warnings) = json::import_one(&text, &name, wanted)?;
    if project.name.is_empty() {
        project.name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    }
    project.origin = Origin::Json(match wanted {
        // So that it can be opened again.
        Some(wanted) => json::one_of(path, wanted),
        None => path.to_owned(),
    });
    project.read_includes();
    Ok(Loaded { sources: project.sources(), project, warnings })
}

/// Reads the text of a project that is one file. Its folder is the file's own.
fn read_text(path: &Path, name: &str, limit: Limit) -> Result<String, ProjectError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    text_of(path, name, confine::read(folder, name, limit)?)
}

fn text_of(path: &Path, name: &str, bytes: Vec<u8>) -> Result<String, ProjectError> {
    match files::decode(bytes) {
        Read::Text(text) => Ok(text),
        Read::NotUtf8(at, lossy) => {
            let mut sources = SourceMap::default();
            let diagnostics = vec![files::not_utf8(&mut sources, name, at, lossy)];
            Err(ProjectError::Invalid { what: path.display().to_string(), diagnostics, sources })
        }
        Read::Missing | Read::Refused(_) => unreachable!("decode is given what was read"),
    }
}

/// Fails if there are errors among the diagnostics.
fn finish(what: &str, loaded: Loaded) -> Result<Loaded, ProjectError> {
    if loaded.warnings.iter().any(Diagnostic::is_error) {
        let Loaded { warnings: diagnostics, sources, .. } = loaded;
        return Err(ProjectError::Invalid { what: what.to_owned(), diagnostics, sources });
    }
    Ok(loaded)
}

/// A project and the diagnostics about it.
#[derive(Debug)]
pub struct Loaded {
    pub project: Project,
    /// Warnings and notes, never errors.
    pub warnings: Vec<Diagnostic>,
    /// [`Project::sources`], followed by the other files that `warnings` point into.
    pub sources: SourceMap,
}
