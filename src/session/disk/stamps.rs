//! The files that a project reads in addition to its texts, with stamps that show whether one has changed.
//!
//! Used on the compile worker alone, as models and pictures are large and the place that a name leads to may be slow.

use eddy_playback::capture;
use eddy_project::{self as project, FillValue, Media, MeshSource, Project, confine, limits};
use std::{
    collections::{BTreeMap, HashMap},
    fs,
    hash::{DefaultHasher, Hash, Hasher},
    path::{Path, PathBuf},
    time::{Duration, SystemTime},
};

/// A file with a hash of its content; `None` if it cannot be read.
pub(crate) type Stamp = (PathBuf, Option<u64>);

/// A file that was written less than this ago may be written again without a change of its modification time.
const RECENT: Duration = Duration::from_secs(2);

/// The last stamps, so that an unchanged file is not read again.
#[derive(Default)]
pub(crate) struct Stamps {
    taken: HashMap<PathBuf, StampedFile>,
}

/// A stamp, and the file's attributes at that time.
struct StampedFile {
    attributes: Attributes,
    hash: u64,
}

/// The attributes that cheaply identify an unchanged file.
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

    /// `own`: the project's folder and the file's name in it, for a file that the user did not pick.
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

/// Returns a file's attributes; `None` if they are unavailable.
fn attributes(path: &Path) -> Option<Attributes> {
    let metadata = fs::metadata(path).ok()?;
    let modified = metadata.modified().ok()?;
    let is_old = SystemTime::now().duration_since(modified).is_ok_and(|age| age > RECENT);
    is_old.then_some(Attributes { bytes: metadata.len(), modified })
}

/// Returns each path once, with its name relative to the folder for the project's own files.
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
