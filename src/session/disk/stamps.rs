//! The files that a project reads besides its texts, and how they look on disk: enough to see that one has changed.
//!
//! Used on the compile worker alone, as models and pictures are large and what a name leads to may be slow.

use eddy_playback::capture;
use eddy_project::{self as project, FillValue, Media, MeshSource, Project, confine, limits};
use std::{
    collections::{BTreeMap, HashMap},
    fs,
    hash::{DefaultHasher, Hash, Hasher},
    path::{Path, PathBuf},
    time::{Duration, SystemTime},
};

/// A file's content as a number; `None` for one that cannot be read.
pub(crate) type Stamp = (PathBuf, Option<u64>);

/// A file that was written so recently may be written again without another time of change.
const RECENT: Duration = Duration::from_secs(2);

/// Stamps as they were last taken, so that a file that has not changed is not read again.
#[derive(Default)]
pub(crate) struct Stamps {
    taken: HashMap<PathBuf, StampedFile>,
}

/// A stamp, and the attributes that the file had then.
struct StampedFile {
    attributes: Attributes,
    hash: u64,
}

/// The properties that tell cheaply that a file is the same.
#[derive(PartialEq)]
struct Attributes {
    bytes: u64,
    modified: SystemTime,
}

impl Stamps {
    /// Returns the stamps of every picture and model that the project names, and of the files that its models name.
    pub(crate) fn take(&mut self, project: &Project) -> Vec<Stamp> {
        let base = capture::base_folder(project);
        let files = files(project, base.as_deref());
        self.taken.retain(|path, _| files.contains_key(path));
        let stamp = |(path, name): (PathBuf, Option<String>)| {
            let hash = self.stamp(&path, base.as_deref().zip(name.as_deref()));
            (path, hash)
        };
        files.into_iter().map(stamp).collect()
    }

    /// `own`: the project's folder and the file's name in it, for a file that the person did not pick.
    fn stamp(&mut self, path: &Path, own: Option<(&Path, &str)>) -> Option<u64> {
        let attributes = attributes(path);
        if let (Some(attributes), Some(taken)) = (&attributes, self.taken.get(path))
            && *attributes == taken.attributes
        {
            return Some(taken.hash);
        }
        let bytes = match own {
            Some((base, name)) => confine::read(base, name, limits::MEDIA_FILE),
            None => confine::read_own(path, limits::MEDIA_FILE),
        };
        let mut hasher = DefaultHasher::new();
        let hash = bytes.ok().map(|bytes| {
            bytes.hash(&mut hasher);
            hasher.finish()
        });
        self.taken.remove(path);
        if let (Some(attributes), Some(hash)) = (attributes, hash) {
            self.taken.insert(path.to_owned(), StampedFile { attributes, hash });
        }
        hash
    }
}

/// Returns a file's attributes; `None` where they tell nothing.
fn attributes(path: &Path) -> Option<Attributes> {
    let metadata = fs::metadata(path).ok()?;
    let modified = metadata.modified().ok()?;
    let is_old = SystemTime::now().duration_since(modified).is_ok_and(|age| age > RECENT);
    is_old.then_some(Attributes { bytes: metadata.len(), modified })
}

/// Returns where they lie, each once, with the names from the folder of those that are the project's own.
fn files(project: &Project, base: Option<&Path>) -> BTreeMap<PathBuf, Option<String>> {
    let mut own: Vec<String> = Vec::new();
    let mut files = BTreeMap::new();
    let relative = |path: &Path| path.to_str().and_then(|name| confine::relative("", name).ok());
    for channel in project.passes.iter().flat_map(|p| p.bindings.channels()) {
        match channel.input.media() {
            Some(Media::File(path)) => own.extend(relative(path)),
            Some(Media::Picked(path)) => drop(files.insert(path.clone(), None)),
            Some(Media::Builtin(_) | Media::Site { .. }) | None => {}
        }
    }
    for (.., fill) in project.fills() {
        if let FillValue::File(path) = &fill.value {
            own.extend(relative(path));
        }
    }
    for draw in project.passes.iter().flat_map(|p| p.body.draws()) {
        let MeshSource::Picked(path) = &draw.mesh else { continue };
        let (Some(folder), Some(model)) = (path.parent(), path.file_name().and_then(|n| n.to_str())) else { continue };
        let beside = project::files_beside(folder, model);
        files.extend(beside.into_iter().map(|name| (folder.join(name), None)));
        files.insert(path.clone(), None);
    }
    let Some(base) = base else { return files };
    for draw in project.passes.iter().flat_map(|p| p.body.draws()) {
        let MeshSource::File(path) = &draw.mesh else { continue };
        let Some(model) = relative(path) else { continue };
        own.extend(project::files_beside(base, &model));
        own.push(model);
    }
    files.extend(own.into_iter().map(|name| (base.join(&name), Some(name))));
    files
}
