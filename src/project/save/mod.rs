//! Saves a project: as a folder, as one GLSL file, or as Shadertoy JSON.
//!
//! Owns the mapping of the project to files. The atomic writes are in `atomic`.

use super::{
    Dialect, FillValue, Media, MeshSource, Origin, Pass, Project, ProjectError, SamplerRules, Source,
    atomic::Content,
    confine, convert, dialect, file_names,
    files::{Files, MANIFEST},
    files_beside, folder, ghostty, json, limits,
    load::folder_name,
    manifest, media_files, picked,
    writes::{self, Overwrite, Writes},
};
use eddy_diag::Diagnostic;
use std::{
    collections::{BTreeMap, BTreeSet},
    path::{Path, PathBuf},
};

/// Writes the project to `target`: one file for a path that ends in `.json` or `.glsl` (which stores a lone Image
/// pass), else a folder, created if necessary. Returns the project as it is now read from there. The files that the
/// project came from are overwritten without asking, others as `overwrite` says; a picture in the old folder is copied
/// to a new one. Files are written atomically, and on failure every old one still exists; files with unchanged content
/// are not touched.
pub fn save(project: &Project, target: &Path, overwrite: Overwrite<'_>) -> Result<Project, ProjectError> {
    let extension = target.extension().unwrap_or_default();
    if project.dialect.has_main() && matches!(&project.origin, Origin::File(path) if is_same(path, target)) {
        return dialect::save(project, target, overwrite);
    }
    let is_own_file = matches!(&project.origin, Origin::File(path) if is_same(path, target));
    if project.dialect == Dialect::Ghostty && is_own_file && !file_names::is_glsl_extension(extension) {
        return save_chain(project, target, overwrite);
    }
    if target.is_dir() {
        save_folder(project, target, overwrite)
    } else if target.file_name().is_some_and(|n| n == MANIFEST) {
        save_folder(project, target.parent().unwrap_or(Path::new("")), overwrite)
    } else if extension.eq_ignore_ascii_case("json") {
        save_json(project, target, overwrite)
    } else if file_names::is_glsl_extension(extension) {
        save_glsl(project, target, overwrite)
    } else {
        save_folder(project, target, overwrite)
    }
}

/// Returns the name that a project gets when [`save`] writes it to `target`.
pub fn name_at(target: &Path) -> String {
    let extension = target.extension().unwrap_or_default();
    let is_file = extension.eq_ignore_ascii_case("json") || file_names::is_glsl_extension(extension);
    if target.file_name().is_some_and(|n| n == MANIFEST) && !target.is_dir() {
        folder_name(target.parent().unwrap_or(Path::new("")))
    } else if is_file && !target.is_dir() {
        target.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    } else {
        folder_name(target)
    }
}

fn save_json(project: &Project, target: &Path, overwrite: Overwrite<'_>) -> Result<Project, ProjectError> {
    let own = matches!(&project.origin, Origin::Json(path) if is_same(path, target));
    // The other shaders of the file are not part of this project, and would be lost.
    let own = own && !confine::read_own(target, limits::JSON).is_ok_and(|bytes| is_of_several(&bytes));
    if let Some(pass) = project.passes.iter().find(|p| !p.body.is_screen()) {
        let what = format!("{}, which draws meshes: Shadertoy has no such pass", pass.id.title());
        return Err(ProjectError::CannotHold { path: target.to_owned(), what });
    }
    if project.dialect == Dialect::Ghostty {
        let what = "the uniforms of the terminal Ghostty: Shadertoy has none of them".into();
        return Err(ProjectError::CannotHold { path: target.to_owned(), what });
    }
    if let Some(path) = picked::paths(project).next() {
        let what = format!("the image {}, which is in another folder", path.display());
        return Err(ProjectError::CannotHold { path: target.to_owned(), what });
    }
    let converted = match project.dialect.has_main() {
        true => Some(convert::to_shadertoy(project).map_err(|why| ProjectError::CannotHold {
            path: target.to_owned(),
            what: format!("a shader for {}: {why}", project.dialect.row().title),
        })?),
        false => None,
    };
    let text = json::export(converted.as_ref().map_or(project, |converted| &converted.project));
    let (mut saved, _) = json::import(&text, &target.display().to_string())?;
    write_one(target, text.into_bytes(), own, overwrite)?;
    saved.origin = Origin::Json(target.to_owned());
    Ok(saved)
}

fn is_of_several(bytes: &[u8]) -> bool {
    match json::utf16(bytes) {
        Some(text) => json::holds_several(&text),
        None => json::holds_several(&String::from_utf8_lossy(bytes)),
    }
}

fn save_glsl(project: &Project, target: &Path, overwrite: Overwrite<'_>) -> Result<Project, ProjectError> {
    let cannot = |what: &str| Err(ProjectError::CannotHold { path: target.to_owned(), what: what.into() });
    let own = matches!(&project.origin, Origin::File(path) if is_same(path, target));
    let base = target.parent().unwrap_or(Path::new(""));
    if project.dialect == Dialect::Ghostty {
        return save_ghostty(project, target, own, overwrite);
    }
    // Buffers that its lines name have their own files, which stay where they are.
    let is_beside = |p: &&Pass| own && p.source.path.as_deref() == Some(&*base.join(&p.source.name));
    let (images, others): (Vec<&Pass>, Vec<&Pass>) = project.passes.iter().partition(|p| p.id.is_image());
    if !others.iter().all(is_beside) {
        return cannot("more passes than Image");
    }
    let [image] = images.as_slice() else { return cannot("anything but Image") };
    if project.common.is_some() {
        return cannot("anything but Image");
    }
    if let Some(what) = beside_texts(project, &project.passes) {
        return cannot(what);
    }
    let mut saved = project.clone();
    folder::declare_channels(&mut saved);
    if saved.passes.iter().zip(&project.passes).any(|(read, pass)| read.bindings != pass.bindings) {
        return cannot("channels that its code does not declare in #iChannel lines");
    }
    let has_moved = project.origin.base_dir() != target.parent();
    if has_moved && !project.includes.is_empty() {
        return cannot("the files that its code includes");
    }
    let name = target.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut owned: BTreeSet<String> = others.iter().map(|p| p.source.name.clone()).collect();
    owned.extend(own.then(|| name.clone()));
    if own {
        owned.extend(edited_includes(project));
    }
    let mut writes = Writes::into(base, owned);
    writes.add_named(name.clone(), Content::Bytes(image.source.text.as_bytes().to_vec()));
    for other in others {
        writes.add(&other.source.name, Content::Bytes(other.source.text.as_bytes().to_vec()))?;
    }
    for included in project.includes.iter().filter(|i| i.is_edited) {
        writes.add(&included.source.name, Content::Bytes(included.source.text.as_bytes().to_vec()))?;
    }
    writes.write(overwrite)?;
    saved.includes.iter_mut().for_each(|i| i.is_edited = false);
    saved.name = target.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    saved.sampler_rules = SamplerRules::PerChannel;
    saved.origin = Origin::File(target.to_owned());
    if let Some(image) = saved.image_mut() {
        image.source.name = name;
        image.source.path = Some(target.to_owned());
    }
    Ok(saved)
}

/// Returns what a code-only file cannot store, if the project has it: settings of these passes or of the project.
fn beside_texts<'a>(project: &Project, passes: impl IntoIterator<Item = &'a Pass>) -> Option<&'static str> {
    if project.info != super::Info::default() {
        return Some("a description, an author or tags");
    }
    if passes.into_iter().any(|pass| pass.settings != Default::default() || !pass.body.is_screen()) {
        return Some("how its pass is drawn");
    }
    if !project.custom_uniform_values.is_empty() {
        return Some("values of sliders that are not their defaults");
    }
    (!project.controls.is_empty()).then_some("controls of sliders")
}

/// Saves a custom shader of Ghostty: the rest of the project is generated by Eddy, and must be unmodified.
fn save_ghostty(
    project: &Project,
    target: &Path,
    own: bool,
    overwrite: Overwrite<'_>,
) -> Result<Project, ProjectError> {
    let cannot = |what: &str| Err(ProjectError::CannotHold { path: target.to_owned(), what: what.into() });
    let Some(image) = project.image() else { return cannot("anything but Image") };
    let mut fresh = project.clone();
    fresh.passes.retain(|pass| pass.id.is_image());
    ghostty::dress(&mut fresh);
    if let Some(what) = beside_shaders(project, &fresh) {
        return cannot(what);
    }
    if let Some(what) = beside_texts(project, [image]) {
        return cannot(what);
    }
    write_one(target, image.source.text.as_bytes().to_vec(), own, overwrite)?;
    let mut saved = project.clone();
    saved.name = name_at(target);
    saved.origin = Origin::File(target.to_owned());
    if let Some(image) = saved.image_mut() {
        image.source.name = target.file_name().unwrap_or_default().to_string_lossy().into_owned();
        image.source.path = Some(target.to_owned());
    }
    Ok(saved)
}

/// Returns what the files of custom shaders cannot store of a project, if it has it. `fresh`: the project around the
/// same shaders, as Eddy generates it.
fn beside_shaders(project: &Project, fresh: &Project) -> Option<&'static str> {
    if project.passes.iter().map(|pass| &pass.id).ne(fresh.passes.iter().map(|pass| &pass.id)) {
        return Some("other passes than those of its shaders");
    }
    let text = |source: Option<&Source>| source.map(|source| source.text.clone());
    let is_drawn_the_same = |a: &Pass, b: &Pass| a.settings == b.settings && a.body == b.body;
    let is_shader = |pass: &Pass| pass.source.path.is_some() || pass.id.is_image();
    let is_same = |a: &Pass, b: &Pass| is_shader(a) || a.source.text == b.source.text && is_drawn_the_same(a, b);
    let around = project.passes.iter().zip(&fresh.passes).all(|(a, b)| is_same(a, b));
    if !around || text(project.common.as_ref()) != text(fresh.common.as_ref()) {
        return Some("changes of the terminal's picture or of Common");
    }
    let is_bound = project.passes.iter().zip(&fresh.passes).all(|(a, b)| a.bindings == b.bindings);
    (!is_bound).then_some("other channels than the picture before it in iChannel0")
}

/// Saves the custom shaders that a Ghostty configuration names, each to its own file.
fn save_chain(project: &Project, target: &Path, overwrite: Overwrite<'_>) -> Result<Project, ProjectError> {
    let fresh = ghostty::load_config(target)?.project;
    let settings = |project: &Project| project.passes.iter().map(|pass| pass.settings.clone()).collect::<Vec<_>>();
    let what = beside_shaders(project, &fresh).or_else(|| beside_texts(project, []));
    let what = what.or_else(|| (settings(project) != settings(&fresh)).then_some("how its passes are drawn"));
    if let Some(what) = what {
        return Err(ProjectError::CannotHold { path: target.to_owned(), what: what.into() });
    }
    for (pass, before) in project.passes.iter().zip(&fresh.passes) {
        let Some(path) = before.source.path.as_deref().filter(|_| pass.source.text != before.source.text) else {
            continue;
        };
        write_one(path, pass.source.text.as_bytes().to_vec(), true, overwrite)?;
    }
    Ok(ghostty::load_config(target)?.project)
}

fn save_folder(project: &Project, target: &Path, overwrite: Overwrite<'_>) -> Result<Project, ProjectError> {
    let target = if target.as_os_str().is_empty() { Path::new(".") } else { target };
    let (is_home, had_manifest) = match &project.origin {
        // A folder that was deleted is written as a new one, with everything that was read from it.
        Origin::Folder { path, has_manifest } if is_same(path, target) && target.is_dir() => (true, *has_manifest),
        _ => (false, false),
    };
    let mut saved = project.clone();
    let mut own: BTreeSet<String> = BTreeSet::new();
    if is_home {
        let texts = saved.tab_sources().filter(|s| s.path.is_some());
        let texts = texts.map(|s| s.renamed_from().unwrap_or_else(|| s.name.clone()));
        own.extend(texts.filter_map(|name| confine::relative("", &name).ok()));
        own.extend(had_manifest.then(|| MANIFEST.to_owned()));
        own.extend(edited_includes(project));
    }
    let mut writes = Writes::into(target, own);
    if let Some(common) = &mut saved.common {
        let name = usual(common, "common");
        place(common, name, is_home, target, &mut writes)?;
    }
    for pass in &mut saved.passes {
        let is_renamed = is_home && pass.source.renamed_from().is_some();
        let name = if is_renamed { pass.source.name.clone() } else { usual(&pass.source, pass.id.key()) };
        place(&mut pass.source, name, is_home, target, &mut writes)?;
        for stage in pass.body.stages_mut() {
            let name = with_ending(stage.name.clone());
            place(stage, name, is_home, target, &mut writes)?;
        }
    }
    // Under their own names, which the lines that include them contain.
    for included in project.includes.iter().filter(|i| i.is_edited || (!is_home && i.trouble.is_none())) {
        let text = included.source.text.as_bytes().to_vec();
        writes.add(&included.source.name, Content::Bytes(text))?;
    }
    if !is_home {
        copy_media(&saved, &mut writes)?;
    }
    picked::copy_in(&mut saved, target, &mut writes)?;
    picked::copy_models_in(&mut saved, target, &mut writes)?;
    picked::write_held(&mut saved, target, &mut writes)?;
    saved.origin = Origin::Folder { path: target.to_owned(), has_manifest: true };
    let name = folder_name(target);
    let after = folder_after(target, &writes);
    if is_home && !had_manifest && says_the_same(&saved, &name, &after) {
        saved.origin = Origin::Folder { path: target.to_owned(), has_manifest: false };
    } else {
        let old = had_manifest.then(|| confine::read(target, MANIFEST, limits::MANIFEST).ok()).flatten();
        let old =
            old.and_then(|bytes| String::from_utf8(bytes).ok()).map(|text| manifest::follow_renames(&text, project));
        let text = manifest_text(&saved, old.as_deref(), &name, target, &after)?;
        writes.add(MANIFEST, Content::Bytes(text.into_bytes()))?;
    }
    writes.write(overwrite)?;
    saved.includes.iter_mut().for_each(|i| i.is_edited = false);
    saved.read_includes();
    Ok(saved)
}

/// Removes the old files of renamed passes: `before` is the project as it was on disk, `renamed` the one that was
/// saved, `after` the result of saving. A file stays if something else in the project uses it, or if its content
/// differs from `before`. Returns the removed files.
pub fn remove_renamed(before: &Project, renamed: &Project, after: &Project) -> Vec<PathBuf> {
    let is_home = |(a, b): (&Path, &Path)| is_same(a, b);
    if !before.origin.base_dir().zip(after.origin.base_dir()).is_some_and(is_home) {
        return Vec::new();
    }
    let used = |path: &Path| {
        let included = after.includes.iter().map(|i| &i.source);
        after.tab_sources().chain(included).any(|s| s.path.as_deref().is_some_and(|p| is_same(p, path)))
    };
    let is_as_read = |path: &Path| {
        let text = before.tab_sources().find(|s| s.path.as_deref() == Some(path)).map(|s| s.text.as_bytes());
        text.is_some() && confine::read_own(path, limits::GLSL_TEXT).ok().as_deref() == text
    };
    let moved = renamed.tab_sources().filter(|s| s.renamed_from().is_some()).filter_map(|s| s.path.clone());
    let gone = moved.filter(|path| !used(path) && is_as_read(path));
    gone.filter(|path| std::fs::remove_file(path).inspect_err(|e| log::warn!("{}: {e}", path.display())).is_ok())
        .collect()
}

/// The included files that were edited: they were read from the project's folder, and belong to it.
fn edited_includes(project: &Project) -> impl Iterator<Item = String> {
    project.includes.iter().filter(|i| i.is_edited).filter_map(|i| confine::relative("", &i.source.name).ok())
}

/// Writes a project that is one file.
fn write_one(target: &Path, bytes: Vec<u8>, is_own: bool, overwrite: Overwrite<'_>) -> Result<(), ProjectError> {
    let name = target.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let own = if is_own { BTreeSet::from([name.clone()]) } else { BTreeSet::new() };
    let mut writes = Writes::into(target.parent().unwrap_or(Path::new("")), own);
    writes.add_named(name, Content::Bytes(bytes));
    writes.write(overwrite)
}

/// The file of a text in a new folder. A text that includes others keeps its path relative to them.
fn usual(source: &Source, key: &str) -> String {
    let includes = source.path.is_some() && source.text.contains("#include");
    if includes { with_ending(source.name.clone()) } else { format!("{key}.glsl") }
}

/// A text's name with a valid extension.
fn with_ending(name: String) -> String {
    if writes::is_text(&name) { name } else { format!("{name}.glsl") }
}

/// Assigns a file to a text: the one it has in this folder, else one with its name. Two passes may share a file if
/// their texts are equal.
fn place(
    source: &mut Source,
    usual: String,
    is_home: bool,
    target: &Path,
    writes: &mut Writes,
) -> Result<(), ProjectError> {
    let bytes = source.text.as_bytes();
    let is_old = is_home && source.path.is_some() && source.renamed_from().is_none();
    if !(is_old && writes.is_free(&writes.checked(&source.name)?, bytes)) {
        let mut name = writes.checked(&usual)?;
        let mut number = 2;
        while !writes.is_free(&name, bytes) {
            name = format!("{}_{number}.glsl", usual.trim_end_matches(".glsl"));
            number += 1;
        }
        source.name = name;
    }
    writes.add(&source.name, Content::Bytes(bytes.to_vec()))?;
    source.path = Some(target.join(&source.name));
    Ok(())
}

/// Copies the pictures and models of the old folder to the same places in the new one. Files that are missing, or
/// cannot be read or written, are omitted: they read as black in both.
fn copy_media(project: &Project, writes: &mut Writes) -> Result<(), ProjectError> {
    let Some(base) = project.origin.base_dir() else { return Ok(()) };
    let mut names: BTreeSet<String> = BTreeSet::new();
    let named = |path: &Path| path.to_str().and_then(|name| confine::relative("", name).ok());
    for draw in project.passes.iter().flat_map(|p| p.body.draws()) {
        let MeshSource::File(path) = &draw.mesh else { continue };
        if let Some(model) = named(path) {
            names.extend(files_beside(base, &model));
            names.insert(model);
        }
    }
    for channel in project.passes.iter().flat_map(|p| p.bindings.channels()) {
        if let Some(Media::File(path)) = channel.input.media() {
            let Some(name) = named(path) else { continue };
            names.extend(media_files::companions(base, &name, channel.input.kind()));
            names.insert(name);
        }
    }
    for (.., fill) in project.fills() {
        if let FillValue::File(path) = &fill.value {
            names.extend(named(path));
        }
    }
    for name in names {
        if writes::is_media(&name) && writes.checked(&name).is_ok() && confine::resolve(base, &name).is_ok() {
            writes.add(&name, Content::CopyOf(base.to_owned(), name.clone()))?;
        }
    }
    Ok(())
}

/// The text files of the folder after writing.
fn folder_after(target: &Path, writes: &Writes) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for name in Files::on_disk(target).names().unwrap_or_default() {
        if file_names::role_of_file(&name).is_some() {
            files.insert(name.clone(), confine::read(target, &name, limits::GLSL_TEXT).unwrap_or_default());
        }
    }
    files.extend(writes.texts().map(|(name, bytes)| (name.clone(), bytes.clone())));
    files
}

/// Returns whether the GLSL files alone, without `eddy.toml`, describe this project.
fn says_the_same(project: &Project, folder_name: &str, files: &BTreeMap<String, Vec<u8>>) -> bool {
    let texts = files
        .iter()
        .filter_map(|(name, bytes)| Some((name, String::from_utf8(bytes.clone()).ok()?)))
        .map(|(name, text)| Source { name: name.clone(), path: None, text: text.into() })
        .collect();
    let (read, diagnostics) = folder::project(folder_name.to_owned(), texts, Origin::Unsaved, None);
    !diagnostics.iter().any(Diagnostic::is_error) && is_equal_but_for_places(&read, project)
}

fn is_equal_but_for_places(a: &Project, b: &Project) -> bool {
    let bare = |p: &Project| {
        let mut p = p.clone();
        p.origin = Origin::Unsaved;
        p.includes.clear();
        for source in p.tab_sources_mut() {
            source.path = None;
        }
        p
    };
    bare(a) == bare(b)
}

/// Returns an `eddy.toml` that reads back as this project: the old one edited, or, if that is impossible, a new one.
fn manifest_text(
    project: &Project,
    old: Option<&str>,
    name: &str,
    target: &Path,
    files: &BTreeMap<String, Vec<u8>>,
) -> Result<String, ProjectError> {
    let has_common_file = files.keys().any(|name| file_names::role_of_file(name) == Some(file_names::FileRole::Common));
    for old in [old, None] {
        let text = manifest::write(project, old, name, has_common_file);
        let read = manifest::project("", name.to_owned(), &text, &Files::in_memory(files), Origin::Unsaved);
        if read.is_ok_and(|l| is_equal_but_for_places(&l.project, project)) {
            return Ok(text);
        }
    }
    // The only known case is a path that is not UTF-8, which TOML cannot express.
    Err(ProjectError::CannotHold {
        path: target.join(MANIFEST),
        what: "a file name in this project that is not Unicode".into(),
    })
}

/// Returns whether two paths refer to the same file, even if spelled differently.
fn is_same(a: &Path, b: &Path) -> bool {
    a == b || matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

#[cfg(test)]
mod tests;
