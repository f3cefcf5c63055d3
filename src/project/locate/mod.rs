//! Resolves a name on the command line to a [`Project`](super::Project).

use super::{
    Loaded, ProjectError, file_names,
    files::{EditedTexts, Files, MANIFEST},
    ghostty, json, limits,
    load::{folder_name, load_edited_folder, load_folder, load_glsl, load_glsl_alone, load_json},
    nearest, presets,
};
use std::{
    fs,
    path::{Path, PathBuf},
};

/// Loads a project by the name a user gives: a folder with `eddy.toml`, a folder of GLSL files (or one of these named
/// directly: `eddy.toml`), one GLSL file, a Shadertoy JSON file, a preset's name. A path takes precedence over a
/// preset, except that a bare preset's name does not resolve to a folder of that name without a project. In a JSON file
/// with several shaders, `FILE.json#ID` selects one, by its id, its number from 1 or its name. `ghostty:FILE.glsl` is a
/// custom shader of the terminal Ghostty, and `ghostty:CONFIG` the chain of those that its configuration names.
pub fn load(spec: &str) -> Result<Loaded, ProjectError> {
    if let Some(path) = of_ghostty(spec) {
        return load_ghostty(path);
    }
    match locate(spec)? {
        Location::Preset(name) => presets::load(name),
        Location::Folder(path) => load_folder(&path),
        Location::Glsl(path) => load_glsl(&path, &EditedTexts::new()),
        Location::Json(path, wanted) => load_json(&path, wanted.as_deref()),
    }
}

/// Returns the path after the prefix that marks a custom shader of Ghostty.
fn of_ghostty(spec: &str) -> Option<&Path> {
    spec.strip_prefix(ghostty::PREFIX).filter(|_| !Path::new(spec).exists()).map(Path::new)
}

/// Loads a custom shader of Ghostty, or those that a configuration names, and adds the terminal's prelude and picture.
fn load_ghostty(path: &Path) -> Result<Loaded, ProjectError> {
    if !path.exists() {
        let (spec, presets) = (path.display().to_string(), Vec::new());
        return Err(ProjectError::NotFound { spec, near: None, presets });
    }
    if path.is_dir() {
        return Err(ProjectError::UnknownKind { path: path.to_owned() });
    }
    if !file_names::is_glsl_extension(path.extension().unwrap_or_default()) {
        return ghostty::load_config(path);
    }
    let Loaded { mut project, .. } = load_glsl_alone(path)?;
    ghostty::dress(&mut project);
    Ok(Loaded { sources: project.sources(), project, warnings: Vec::new() })
}

/// Loads the project of a folder, or of one GLSL file, like [`load`]; texts of an editor override the files on disk.
/// Their paths start with `path`.
pub fn load_edited(path: &Path, edited: &EditedTexts) -> Result<Loaded, ProjectError> {
    let is_file = edited.contains_key(path) || fs::metadata(path).is_ok_and(|m| !m.is_dir());
    if is_file { load_glsl(path, edited) } else { load_edited_folder(path, edited) }
}

/// Returns the folder of the project that a file most likely belongs to: the nearest one with an `eddy.toml`, from the
/// file's own upwards; without one, the file's own folder if it contains the Image pass of a project.
pub fn folder_around(file: &Path) -> Option<PathBuf> {
    let folders = file.ancestors().skip(1).filter(|folder| !folder.as_os_str().is_empty());
    let described = folders.take(limits::FOLDERS_UP).find(|folder| Files::on_disk(folder).exists(MANIFEST));
    described.or_else(|| file.parent().filter(|folder| holds_project(folder))).map(Path::to_owned)
}

/// Returns the folder of the project that has this file among its texts: that of an `eddy.toml`, of a pass or of an
/// included file; texts of an editor override the files on disk. `None` for a standalone shader. Files next to an
/// `eddy.toml` with an error belong to it, so that the error is reported.
pub fn project_of(file: &Path, edited: &EditedTexts) -> Option<PathBuf> {
    if is_manifest(file) {
        return Some(file.parent().unwrap_or(Path::new("")).to_owned());
    }
    let folder = folder_around(file)?;
    let belongs = match load_edited(&folder, edited) {
        Ok(loaded) => {
            let includes = loaded.project.includes.iter().map(|included| &included.source);
            loaded.project.tab_sources().chain(includes).any(|source| source.path.as_deref() == Some(file))
        }
        Err(ProjectError::Invalid { .. }) => file.parent() == Some(&folder),
        Err(_) => false,
    };
    belongs.then_some(folder)
}

/// Returns whether a file of this name describes a project.
pub fn is_manifest(file: &Path) -> bool {
    file.file_name().is_some_and(|name| name == MANIFEST)
}

/// Returns the base name for outputs of `spec`: the preset's, the folder's or the file's name without its extension.
pub fn stem(spec: &str) -> String {
    let spec = of_ghostty(spec).and_then(Path::to_str).unwrap_or(spec);
    let path = match locate(spec) {
        Ok(Location::Preset(name)) => return name.to_owned(),
        Ok(Location::Folder(path)) => return folder_name(&path),
        Ok(Location::Glsl(path) | Location::Json(path, None)) => path,
        Ok(Location::Json(path, Some(wanted))) => {
            let letters = wanted.chars().map(|c| if c.is_alphanumeric() || c == '-' { c } else { '_' }).take(64);
            let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            return format!("{stem}_{}", letters.collect::<String>());
        }
        Err(_) => PathBuf::from(spec),
    };
    path.file_stem().map_or_else(|| "project".into(), |s| s.to_string_lossy().into_owned())
}

enum Location {
    Preset(&'static str),
    Folder(PathBuf),
    Glsl(PathBuf),
    /// A Shadertoy JSON file, and the selected shader if there is one.
    Json(PathBuf, Option<String>),
}

fn locate(spec: &str) -> Result<Location, ProjectError> {
    let path = Path::new(spec);
    let preset = presets::names().iter().copied().find(|n| *n == spec);
    let metadata = fs::metadata(path);
    if metadata.is_err()
        && let Some((path, wanted)) = json::of_several(spec)
    {
        return Ok(Location::Json(path, Some(wanted)));
    }
    let metadata = match metadata {
        Ok(metadata) => metadata,
        Err(e) if preset.is_none() && e.kind() != std::io::ErrorKind::NotFound && !spec.is_empty() => {
            return Err(ProjectError::Io { action: "read", path: path.to_owned(), source: e });
        }
        Err(_) => {
            return preset.map(Location::Preset).ok_or_else(|| ProjectError::NotFound {
                spec: spec.to_owned(),
                near: nearest(spec, presets::names().iter().copied()).map(str::to_owned),
                presets: presets::names().iter().map(|&n| n.to_owned()).collect(),
            });
        }
    };
    if metadata.is_dir() {
        return Ok(match preset {
            Some(name) if !holds_project(path) => Location::Preset(name),
            _ => Location::Folder(path.to_owned()),
        });
    }
    let extension = path.extension().unwrap_or_default();
    if path.file_name().is_some_and(|n| n == MANIFEST) {
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Ok(Location::Folder(folder.to_owned()))
    } else if extension.eq_ignore_ascii_case("json") {
        Ok(Location::Json(path.to_owned(), None))
    } else if file_names::is_glsl_extension(extension) || file_names::is_vertex_extension(extension) {
        Ok(Location::Glsl(path.to_owned()))
    } else {
        Err(ProjectError::UnknownKind { path: path.to_owned() })
    }
}

fn holds_project(path: &Path) -> bool {
    let files = Files::on_disk(path);
    files.exists(MANIFEST) || files.names().is_ok_and(|names| names.iter().any(|n| file_names::is_image_file(n)))
}

#[cfg(test)]
mod tests;
