//! Pictures that the user picked from anywhere, and how they become files of the project.
//!
//! A picked picture is shown at once from its location. Saving copies it into the project's folder and names the copy,
//! so that the project never names a file outside its folder.

use super::{
    Fill, FillKind, FillValue, Input, Media, MeshSource, Project, ProjectError, atomic::Content, confine, files_beside,
    limits, writes::Writes,
};
use std::path::Path;

/// Returns an input with the absolute path of its picked picture, or with the picture's name if it is already in the
/// project's folder.
pub fn at_home(mut input: Input, folder: Option<&Path>) -> Input {
    if let Some(media) = input.media_mut()
        && let Media::Picked(path) = media
    {
        // If typed by hand, it may be relative to Eddy's working directory.
        *path = std::path::absolute(&*path).unwrap_or_else(|_| path.clone());
        if let Some(name) = folder.and_then(|folder| name_within(folder, path)) {
            *media = Media::File(name.into());
        }
    }
    input
}

/// Replaces the names of image files in a folder by their paths, for a project that leaves the folder.
pub fn leave_home(project: &mut Project, folder: &Path) {
    let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
    for channel in project.passes.iter_mut().flat_map(|pass| pass.bindings.channels_mut()) {
        if let Some(media) = channel.input.media_mut()
            && let Media::File(name) = media
        {
            *media = Media::Picked(folder.join(&*name));
        }
    }
}

/// Applies [`at_home`] to every picked file of a project.
pub fn bring_home(project: &mut Project, folder: Option<&Path>) {
    for pass in &mut project.passes {
        for channel in pass.bindings.channels_mut() {
            let input = std::mem::replace(&mut channel.input, Input::KEYBOARD);
            channel.input = at_home(input, folder);
        }
        for draw in pass.body.draws_mut() {
            let MeshSource::Picked(path) = &mut draw.mesh else { continue };
            *path = std::path::absolute(&*path).unwrap_or_else(|_| path.clone());
            if let Some(name) = folder.and_then(|folder| name_within(folder, path)) {
                draw.mesh = MeshSource::File(name.into());
            }
        }
    }
}

/// The name, relative to the folder, of a file in it.
fn name_within(folder: &Path, path: &Path) -> Option<String> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let (home, real) = (folder.canonicalize().ok()?, path.canonicalize().ok()?);
    let parts: Option<Vec<&str>> = real.strip_prefix(home).ok()?.iter().map(|part| part.to_str()).collect();
    let name = confine::relative("", &parts?.join("/")).ok()?;
    confine::resolve(folder, &name).is_ok().then_some(name)
}

/// Returns the paths of the picked pictures of a project.
pub(super) fn paths(project: &Project) -> impl Iterator<Item = &Path> {
    let channels = project.passes.iter().flat_map(|p| p.bindings.channels());
    channels.filter_map(|c| match c.input.media() {
        Some(Media::Picked(path)) => Some(path.as_path()),
        _ => None,
    })
}

/// Copies the picked pictures into `target` and names the copies. A file with different content is never replaced: the
/// copy then gets a number. For a picture that cannot be read only the name is set, so that the rest of the project is
/// saved.
pub(super) fn copy_in(project: &mut Project, target: &Path, writes: &mut Writes) -> Result<(), ProjectError> {
    for channel in project.passes.iter_mut().flat_map(|p| p.bindings.channels_mut()) {
        let Some(media @ Media::Picked(_)) = channel.input.media_mut() else { continue };
        let Media::Picked(path) = &*media else { continue };
        let name = match name_within(target, path) {
            Some(name) => name,
            None => copy(path, target, writes)?,
        };
        *media = Media::File(name.into());
    }
    Ok(())
}

/// Copies the picked models into `target` with the files that they name, and names the copies. The models contain these
/// names, so if one of them is taken, all files go into a new folder. For a model that cannot be read only the name is
/// set.
pub(super) fn copy_models_in(project: &mut Project, target: &Path, writes: &mut Writes) -> Result<(), ProjectError> {
    for pass in &mut project.passes {
        for draw in pass.body.draws_mut() {
            let MeshSource::Picked(path) = &draw.mesh else { continue };
            let name = match name_within(target, path) {
                Some(name) => name,
                None => copy_model(path, target, writes)?,
            };
            draw.mesh = MeshSource::File(name.into());
        }
    }
    Ok(())
}

fn copy_model(path: &Path, target: &Path, writes: &mut Writes) -> Result<String, ProjectError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let own = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut files: Vec<(String, Vec<u8>)> = Vec::new();
    for name in std::iter::once(own.clone()).chain(files_beside(folder, &own)) {
        // Missing files are omitted; drawing the model reports them.
        if let Ok(bytes) = confine::read(folder, &name, limits::MEDIA_FILE)
            && super::writes::is_media(&name)
        {
            files.push((name, bytes));
        }
    }
    let stem = parts(path).0;
    let numbered = (1..).map(|n| if n == 1 { format!("{stem}/") } else { format!("{stem}_{n}/") });
    for place in std::iter::once(String::new()).chain(numbered) {
        let is_free = |(name, bytes): &(String, Vec<u8>)| {
            let name = format!("{place}{name}");
            let is_free = target.join(&name).symlink_metadata().is_err()
                || confine::read(target, &name, limits::MEDIA_FILE).is_ok_and(|there| there == *bytes);
            is_free && writes.is_free(&name, bytes)
        };
        if files.iter().all(is_free) {
            for (name, bytes) in files {
                writes.add(&format!("{place}{name}"), Content::Bytes(bytes))?;
            }
            return Ok(format!("{place}{own}"));
        }
    }
    Ok(own)
}

/// Writes the in-memory files that fill the project's passes, and names these files, like [`copy_in`].
pub(super) fn write_held(project: &mut Project, target: &Path, writes: &mut Writes) -> Result<(), ProjectError> {
    for pass in &mut project.passes {
        for kind in FillKind::ALL {
            let Some(fill) = pass.fill_mut(kind) else { continue };
            let FillValue::InMemory { name, npy } = &fill.value else { continue };
            let name = add(parts(name), npy.to_vec(), target, writes)?;
            *fill = Fill::file(name);
        }
    }
    Ok(())
}

fn copy(path: &Path, target: &Path, writes: &mut Writes) -> Result<String, ProjectError> {
    let (stem, extension) = parts(path);
    match confine::read_own(path, limits::MEDIA_FILE) {
        Ok(bytes) => add((stem, extension), bytes, target, writes),
        Err(_) => Ok(format!("{stem}.{extension}")),
    }
}

/// Writes bytes under this name, or under a numbered one if it is taken.
fn add(
    (stem, extension): (String, String),
    bytes: Vec<u8>,
    target: &Path,
    writes: &mut Writes,
) -> Result<String, ProjectError> {
    let mut number = 1;
    loop {
        let name = if number == 1 { format!("{stem}.{extension}") } else { format!("{stem}_{number}.{extension}") };
        let on_disk = target.join(&name);
        let is_free = on_disk.symlink_metadata().is_err()
            || confine::read(target, &name, limits::MEDIA_FILE).is_ok_and(|there| there == bytes);
        if is_free && writes.is_free(&name, &bytes) {
            writes.add(&name, Content::Bytes(bytes))?;
            return Ok(name);
        }
        number += 1;
    }
}

/// The name and the extension of a picture's copy, which every system accepts.
fn parts(path: &Path) -> (String, String) {
    let fit = |text: Option<&std::ffi::OsStr>| -> String {
        let text = text.unwrap_or_default().to_string_lossy();
        let fit = |c: char| if c.is_alphanumeric() || matches!(c, '_' | '-' | ' ') { c } else { '_' };
        text.trim().chars().take(limits::NAME).map(fit).collect()
    };
    let (mut stem, mut extension) = (fit(path.file_stem()), fit(path.extension()).to_lowercase());
    if stem.is_empty() || confine::is_reserved(&stem) {
        stem = format!("picture_{stem}");
    }
    if !super::writes::is_media(&format!("x.{extension}")) {
        // The first bytes of a picture identify its format; its name need not.
        extension = "png".into();
    }
    (stem, extension)
}
