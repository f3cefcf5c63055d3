//! Writing a project: as a folder, as one GLSL file, or as Shadertoy JSON.
//!
//! Owns what goes into which file. The writing itself, which never leaves half a file behind, is in `atomic`.

use super::{
    FillKind, FillValue, Input, Media, MeshSource, Origin, PassId, Project, ProjectError, SamplerRules, Source,
    atomic::{self, Content},
    files_beside,
    folder::{self, Files},
    json,
    load::{MANIFEST, folder_name},
    manifest,
};
use crate::diag::Diagnostic;
use std::{
    collections::BTreeMap,
    fs,
    path::{Component, Path, PathBuf},
};

/// What to do about a file in the way that is not this project's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overwrite {
    /// Fail with [`ProjectError::WouldOverwrite`], having written nothing.
    Refuse,
    Allow,
}

/// Writes the project to `target`: one file for a path that ends in `.json` or `.glsl` (which holds a lone Image pass),
/// else a folder, made if need be. Returns the project as it is now read from there. Files the project came from are its
/// own and written without asking; a picture in the old folder is copied along into a new one. No file is ever seen half
/// written, and on failure every old one is still there; files whose content stays the same are not touched.
pub fn save(project: &Project, target: &Path, overwrite: Overwrite) -> Result<Project, ProjectError> {
    let extension = target.extension().unwrap_or_default();
    if target.is_dir() {
        save_folder(project, target, overwrite)
    } else if target.file_name().is_some_and(|n| n == MANIFEST) {
        save_folder(project, target.parent().unwrap_or(Path::new("")), overwrite)
    } else if extension.eq_ignore_ascii_case("json") {
        save_json(project, target, overwrite)
    } else if folder::is_glsl_extension(extension) {
        save_glsl(project, target, overwrite)
    } else {
        save_folder(project, target, overwrite)
    }
}

fn save_json(project: &Project, target: &Path, overwrite: Overwrite) -> Result<Project, ProjectError> {
    let own = matches!(&project.origin, Origin::Json(path) if is_same(path, target));
    if let Some(pass) = project.passes.iter().find(|p| p.settings.geometry.is_some()) {
        let what = format!("{}, which draws meshes: the site has no such pass", pass.id.title());
        return Err(ProjectError::CannotHold { path: target.to_owned(), what });
    }
    let text = json::export(project);
    let (mut saved, _) = json::import(&text, &target.display().to_string())?;
    write(BTreeMap::from([(target.to_owned(), Content::Bytes(text.into_bytes()))]), |_| own, overwrite)?;
    saved.origin = Origin::Json(target.to_owned());
    Ok(saved)
}

fn save_glsl(project: &Project, target: &Path, overwrite: Overwrite) -> Result<Project, ProjectError> {
    let cannot = |what: &str| Err(ProjectError::CannotHold { path: target.to_owned(), what: what.into() });
    let [image] = project.passes.as_slice() else { return cannot("more passes than Image") };
    if image.id != PassId::Image || project.common.is_some() {
        return cannot("anything but Image");
    }
    if project.info != super::Info::default() {
        return cannot("a description, an author or tags");
    }
    let mut saved = project.clone();
    folder::declare_channels(&mut saved);
    if saved.passes[0].channels != image.channels {
        return cannot("channels that its text does not declare in #iChannel lines");
    }
    if image.settings != Default::default() {
        return cannot("how its pass is drawn");
    }
    if !project.knob_values.is_empty() {
        return cannot("values of sliders that are not their defaults");
    }
    let has_moved = project.origin.base_dir() != target.parent();
    if has_moved && !project.includes.is_empty() {
        return cannot("the files that its text includes");
    }
    let own = matches!(&project.origin, Origin::File(path) if is_same(path, target));
    let bytes = image.source.text.as_bytes().to_vec();
    write(BTreeMap::from([(target.to_owned(), Content::Bytes(bytes))]), |_| own, overwrite)?;
    saved.name = target.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    saved.sampler_rules = SamplerRules::PerChannel;
    saved.origin = Origin::File(target.to_owned());
    let source = &mut saved.passes[0].source;
    source.name = target.file_name().unwrap_or_default().to_string_lossy().into_owned();
    source.path = Some(target.to_owned());
    Ok(saved)
}

fn save_folder(project: &Project, target: &Path, overwrite: Overwrite) -> Result<Project, ProjectError> {
    let target = if target.as_os_str().is_empty() { Path::new(".") } else { target };
    let (is_home, had_manifest) = match &project.origin {
        Origin::Folder { path, has_manifest } if is_same(path, target) => (true, *has_manifest),
        _ => (false, false),
    };
    let mut saved = project.clone();
    let mut own: Vec<String> = Vec::new();
    if is_home {
        own.extend(saved.tab_sources().filter(|s| s.path.is_some()).map(|s| s.name.clone()));
        own.extend(had_manifest.then(|| MANIFEST.to_owned()));
    }
    let mut texts: BTreeMap<String, Vec<u8>> = BTreeMap::new();
    if let Some(common) = &mut saved.common {
        let name = usual(common, "common");
        place(common, name, is_home, target, &mut texts);
    }
    for pass in &mut saved.passes {
        let name = usual(&pass.source, &pass.id.key());
        place(&mut pass.source, name, is_home, target, &mut texts);
        for stage in pass.settings.geometry.iter_mut().flat_map(|g| &mut g.stages) {
            let name = stage.name.clone();
            place(stage, name, is_home, target, &mut texts);
        }
    }
    if !is_home {
        // Under their own names, which the lines that include them say.
        for included in project.includes.iter().filter(|i| i.trouble.is_none()) {
            texts.insert(included.source.name.clone(), included.source.text.as_bytes().to_vec());
        }
    }
    let mut writes: BTreeMap<PathBuf, Content> = BTreeMap::new();
    if !is_home {
        copy_media(&mut saved, target, &mut writes);
    }
    saved.origin = Origin::Folder { path: target.to_owned(), has_manifest: true };
    let name = folder_name(target);
    if is_home && !had_manifest && says_the_same(&saved, &name, &folder_after(target, &texts)) {
        saved.origin = Origin::Folder { path: target.to_owned(), has_manifest: false };
    } else {
        let old = if had_manifest { fs::read_to_string(target.join(MANIFEST)).ok() } else { None };
        let text = manifest_text(&saved, old.as_deref(), &name, target, &texts)?;
        texts.insert(MANIFEST.into(), text.into_bytes());
    }
    writes.extend(texts.into_iter().map(|(name, bytes)| (target.join(name), Content::Bytes(bytes))));
    let own: Vec<PathBuf> = own.into_iter().map(|name| target.join(name)).collect();
    write(writes, |path| own.iter().any(|o| o == path), overwrite)?;
    saved.read_includes();
    Ok(saved)
}

/// The file a text has in a new folder. One that includes others stays where it was among them.
fn usual(source: &Source, key: &str) -> String {
    let includes = source.path.is_some() && source.text.contains("#include");
    if includes { source.name.clone() } else { format!("{key}.glsl") }
}

/// Gives a text its file: the one it has in this folder, else the one of its name. Two passes may share a file as long as
/// they say the same.
fn place(source: &mut Source, usual: String, is_home: bool, target: &Path, texts: &mut BTreeMap<String, Vec<u8>>) {
    let bytes = source.text.as_bytes();
    let is_free = |name: &str| texts.get(name).is_none_or(|b| b == bytes);
    let old = (is_home && source.path.is_some() && is_free(&source.name)).then(|| source.name.clone());
    let mut name = old.unwrap_or_else(|| usual.clone());
    let mut number = 2;
    while !is_free(&name) {
        name = format!("{}_{number}.glsl", usual.trim_end_matches(".glsl"));
        number += 1;
    }
    texts.insert(name.clone(), bytes.to_vec());
    source.path = Some(target.join(&name));
    source.name = name;
}

/// Where a file of the old folder, named relative to it, goes in a new one.
enum Move {
    /// It is copied to the same place in the new folder.
    Along(PathBuf),
    /// It lies outside the old folder, and is named by its whole path from now on.
    Stays(PathBuf),
}

fn moved(base: &Path, path: &Path) -> Option<Move> {
    let from = base.join(path);
    if path.is_absolute() || !from.is_file() {
        None
    } else if path.components().all(|c| matches!(c, Component::Normal(_) | Component::CurDir)) {
        Some(Move::Along(from))
    } else {
        from.canonicalize().ok().map(Move::Stays)
    }
}

/// Models and what they name, as [`copy_media`] does with pictures.
fn copy_models(base: &Path, project: &mut Project, target: &Path, writes: &mut BTreeMap<PathBuf, Content>) {
    let geometries = project.passes.iter_mut().filter_map(|p| p.settings.geometry.as_mut());
    for draw in geometries.flat_map(|g| &mut g.draws) {
        let MeshSource::File(path) = &mut draw.mesh else { continue };
        match moved(base, path) {
            Some(Move::Along(from)) => {
                let folder = path.parent().unwrap_or(Path::new("")).to_owned();
                for beside in files_beside(&from) {
                    if let Some(Move::Along(from)) = moved(base, &folder.join(&beside)) {
                        writes.insert(target.join(&folder).join(beside), Content::CopyOf(from));
                    }
                }
                writes.insert(target.join(&*path), Content::CopyOf(from));
            }
            Some(Move::Stays(whole)) => *path = whole,
            None => {}
        }
    }
}

/// Pictures named relative to the old folder go along; those outside it are named by their whole path from now on.
fn copy_media(project: &mut Project, target: &Path, writes: &mut BTreeMap<PathBuf, Content>) {
    let Some(base) = project.origin.base_dir().map(Path::to_owned) else { return };
    copy_models(&base, project, target, writes);
    for channel in project.passes.iter_mut().flat_map(|p| p.channels.iter_mut().flatten()) {
        let (Input::Texture(media)
        | Input::Cubemap(media)
        | Input::Volume(media)
        | Input::Video(media)
        | Input::Music(media)) = &mut channel.input
        else {
            continue;
        };
        let Media::File(path) = media else { continue };
        move_file(&base, path, target, writes);
    }
    for pass in &mut project.passes {
        for kind in FillKind::ALL {
            if let Some(FillValue::File(path)) = pass.fill_mut(kind).map(|f| &mut f.value) {
                move_file(&base, path, target, writes);
            }
        }
    }
}

fn move_file(base: &Path, path: &mut PathBuf, target: &Path, writes: &mut BTreeMap<PathBuf, Content>) {
    match moved(base, path) {
        Some(Move::Along(from)) => drop(writes.insert(target.join(&*path), Content::CopyOf(from))),
        Some(Move::Stays(whole)) => *path = whole,
        None => {}
    }
}

/// The text files of the folder once `texts` are written.
fn folder_after(target: &Path, texts: &BTreeMap<String, Vec<u8>>) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for name in Files::Disk(target).names().unwrap_or_default() {
        if folder::role_of_file(&name).is_some() {
            files.insert(name.clone(), fs::read(target.join(&name)).unwrap_or_default());
        }
    }
    files.extend(texts.iter().map(|(name, bytes)| (name.clone(), bytes.clone())));
    files
}

/// Whether the GLSL files alone, without `eddy.toml`, give this project.
fn says_the_same(project: &Project, folder_name: &str, files: &BTreeMap<String, Vec<u8>>) -> bool {
    let texts = files
        .iter()
        .filter_map(|(name, bytes)| Some((name, String::from_utf8(bytes.clone()).ok()?)))
        .map(|(name, text)| Source { name: name.clone(), path: None, text: text.into() })
        .collect();
    let (read, diagnostics) = folder::project(folder_name.to_owned(), texts, Origin::Unsaved);
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

/// An `eddy.toml` that reads back as this project: the old one changed, or, where that cannot be, a new one.
fn manifest_text(
    project: &Project,
    old: Option<&str>,
    name: &str,
    target: &Path,
    texts: &BTreeMap<String, Vec<u8>>,
) -> Result<String, ProjectError> {
    let files = folder_after(target, texts);
    let has_common_file = files.keys().any(|name| folder::role_of_file(name) == Some(folder::Role::Common));
    for old in [old, None] {
        let text = manifest::write(project, old, name, has_common_file);
        let read = manifest::project("", name.to_owned(), &text, &Files::Memory(&files), Origin::Unsaved);
        if read.is_ok_and(|l| is_equal_but_for_places(&l.project, project)) {
            return Ok(text);
        }
    }
    // A path that is not UTF-8 is the one thing known that TOML has no form for.
    Err(ProjectError::CannotHold {
        path: target.join(MANIFEST),
        what: "a name in this project that is not plain text".into(),
    })
}

/// Checks that nothing foreign is in the way, then writes everything.
fn write(
    writes: BTreeMap<PathBuf, Content>,
    is_own: impl Fn(&Path) -> bool,
    overwrite: Overwrite,
) -> Result<(), ProjectError> {
    let mut changed = Vec::new();
    for (path, content) in writes {
        match atomic::compare(&path, &content)? {
            atomic::OnDisk::Same => continue,
            atomic::OnDisk::Different if overwrite == Overwrite::Refuse && !is_own(&path) => {
                return Err(ProjectError::WouldOverwrite { path });
            }
            atomic::OnDisk::Different | atomic::OnDisk::Absent => changed.push((path, content)),
        }
    }
    atomic::write_all(changed)
}

/// Whether two paths name one place, also where one is written in another way.
fn is_same(a: &Path, b: &Path) -> bool {
    a == b || matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

#[cfg(test)]
#[path = "save_tests.rs"]
mod tests;
