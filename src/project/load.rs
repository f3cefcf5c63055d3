//! From what a person names on the command line to a [`Project`].

use super::{
    Info, Origin, Pass, PassId, Project, ProjectError, SamplerRules, Source,
    atomic::sweep,
    confine,
    files::{self, Files, Read},
    folder, includes, json,
    limits::{self, Limit},
    manifest, nearest, presets,
};
use crate::diag::{Diagnostic, SourceMap};
use std::{
    fs,
    path::{Path, PathBuf},
};

/// A project and what there is to say of it.
#[derive(Debug)]
pub struct Loaded {
    pub project: Project,
    /// Warnings and notes, never an error.
    pub warnings: Vec<Diagnostic>,
    /// [`Project::sources`], and after them the files that `warnings` point into besides.
    pub sources: SourceMap,
}

/// Name of the file that describes a folder.
pub(super) const MANIFEST: &str = "eddy.toml";

/// Reads a project by what a person calls it: a folder with `eddy.toml`, a folder of GLSL files (or one of these named
/// directly: `eddy.toml`), one GLSL file, a Shadertoy JSON file, a preset's name. A path wins over a preset, except that a
/// bare preset's name is not taken for a folder of that name that holds no project.
pub fn load(spec: &str) -> Result<Loaded, ProjectError> {
    match locate(spec)? {
        Place::Preset(name) => presets::load(name),
        Place::Folder(path) => load_folder(&path),
        Place::Glsl(path) => load_glsl(&path),
        Place::Json(path) => load_json(&path),
    }
}

/// What an output of `spec` is named after: the preset's, the folder's or the file's name without its extension.
pub fn stem(spec: &str) -> String {
    let path = match locate(spec) {
        Ok(Place::Preset(name)) => return name.to_owned(),
        Ok(Place::Folder(path)) => return folder_name(&path),
        Ok(Place::Glsl(path) | Place::Json(path)) => path,
        Err(_) => PathBuf::from(spec),
    };
    path.file_stem().map_or_else(|| "project".into(), |s| s.to_string_lossy().into_owned())
}

enum Place {
    Preset(&'static str),
    Folder(PathBuf),
    Glsl(PathBuf),
    Json(PathBuf),
}

fn locate(spec: &str) -> Result<Place, ProjectError> {
    let path = Path::new(spec);
    let preset = presets::names().iter().copied().find(|n| *n == spec);
    let metadata = match fs::metadata(path) {
        Ok(metadata) => metadata,
        Err(e) if preset.is_none() && e.kind() != std::io::ErrorKind::NotFound && !spec.is_empty() => {
            return Err(ProjectError::Io { action: "read", path: path.to_owned(), source: e });
        }
        Err(_) => {
            return preset.map(Place::Preset).ok_or_else(|| ProjectError::NotFound {
                spec: spec.to_owned(),
                near: nearest(spec, presets::names().iter().copied()).map(str::to_owned),
                presets: presets::names().iter().map(|&n| n.to_owned()).collect(),
            });
        }
    };
    if metadata.is_dir() {
        return Ok(match preset {
            Some(name) if !holds_project(path) => Place::Preset(name),
            _ => Place::Folder(path.to_owned()),
        });
    }
    let extension = path.extension().unwrap_or_default();
    if path.file_name().is_some_and(|n| n == MANIFEST) {
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Ok(Place::Folder(folder.to_owned()))
    } else if extension.eq_ignore_ascii_case("json") {
        Ok(Place::Json(path.to_owned()))
    } else if folder::is_glsl_extension(extension) {
        Ok(Place::Glsl(path.to_owned()))
    } else {
        Err(ProjectError::UnknownKind { path: path.to_owned() })
    }
}

fn holds_project(path: &Path) -> bool {
    let files = Files::on_disk(path);
    files.exists(MANIFEST)
        || files
            .names()
            .is_ok_and(|names| names.iter().any(|n| folder::role_of_file(n) == Some(folder::Role::Pass(PassId::Image))))
}

/// A folder's own name, also for `.` and `..`.
pub(super) fn folder_name(path: &Path) -> String {
    let name = |p: &Path| p.file_name().map(|n| n.to_string_lossy().into_owned());
    name(path)
        .or_else(|| name(&path.canonicalize().ok()?))
        .filter(|n| !n.is_empty())
        .unwrap_or_else(|| "project".into())
}

fn load_folder(path: &Path) -> Result<Loaded, ProjectError> {
    sweep(path);
    let files = Files::on_disk(path);
    let has_manifest = files.exists(MANIFEST);
    let origin = Origin::Folder { path: path.to_owned(), has_manifest };
    load_files(&path.display().to_string(), folder_name(path), &files, origin)
}

/// A folder on disk or in the binary. `what` names it in errors.
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
        if folder::role_of_file(&file).is_none() {
            said.extend(folder::misnamed(&file));
            continue;
        }
        if texts.len() == limits::PASSES {
            let message = format!("there are more than {} passes, the most a project has", limits::PASSES);
            diagnostics.push(Diagnostic::error(None, message).hint("take some of their files out of the folder"));
            break;
        }
        match files.read(&file, limits::GLSL_TEXT) {
            Read::Refused(error) if error.is_of_machine() => return Err(error.into()),
            Read::Refused(error) => {
                diagnostics.push(Diagnostic::error(None, error.to_string()).hint(error.hint()));
            }
            Read::Text(text) => texts.push(Source { path: files.path(&file), name: file, text: text.into() }),
            Read::NotUtf8(at, lossy) => diagnostics.push(files::not_utf8(&mut sources, &file, at, lossy)),
            // Removed between the listing and the reading: not there, then.
            Read::Missing => {}
        }
    }
    if !diagnostics.is_empty() {
        return Err(ProjectError::Invalid { what: what.to_owned(), diagnostics, sources });
    }
    let (mut project, mut warnings) = folder::project(name, texts, origin);
    warnings.extend(said);
    includes::read(&mut project, Some(files));
    Ok(Loaded { sources: project.sources(), project, warnings })
}

fn load_glsl(path: &Path) -> Result<Loaded, ProjectError> {
    let what = path.display().to_string();
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let text = read_text(path, &name, limits::GLSL_TEXT)?;
    let mut project = Project {
        name: path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        info: Info::default(),
        common: None,
        passes: vec![Pass {
            id: PassId::Image,
            source: Source { name, path: Some(path.to_owned()), text: text.into() },
            channels: Default::default(),
            settings: Default::default(),
        }],
        sampler_rules: SamplerRules::PerChannel,
        knob_values: Default::default(),
        groups: Vec::new(),
        includes: Vec::new(),
        origin: Origin::File(path.to_owned()),
    };
    let warnings = folder::declare_channels(&mut project);
    project.read_includes();
    finish(&what, Loaded { sources: project.sources(), project, warnings })
}

fn load_json(path: &Path) -> Result<Loaded, ProjectError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let text = read_text(path, &name, limits::JSON)?;
    let (mut project, warnings) = json::import(&text, &name)?;
    if project.name.is_empty() {
        project.name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    }
    project.origin = Origin::Json(path.to_owned());
    project.read_includes();
    Ok(Loaded { sources: project.sources(), project, warnings })
}

/// The text of a project that is one file. Its folder is the file's own.
fn read_text(path: &Path, name: &str, limit: Limit) -> Result<String, ProjectError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    match files::decode(confine::read(folder, name, limit)?) {
        Read::Text(text) => Ok(text),
        Read::NotUtf8(at, lossy) => {
            let mut sources = SourceMap::default();
            let diagnostics = vec![files::not_utf8(&mut sources, name, at, lossy)];
            Err(ProjectError::Invalid { what: path.display().to_string(), diagnostics, sources })
        }
        Read::Missing | Read::Refused(_) => unreachable!("decode is given what was read"),
    }
}

/// Turns errors among the diagnostics into a refusal.
fn finish(what: &str, loaded: Loaded) -> Result<Loaded, ProjectError> {
    if loaded.warnings.iter().any(Diagnostic::is_error) {
        let Loaded { warnings: diagnostics, sources, .. } = loaded;
        return Err(ProjectError::Invalid { what: what.to_owned(), diagnostics, sources });
    }
    Ok(loaded)
}

#[cfg(test)]
#[path = "load_tests.rs"]
mod tests;
