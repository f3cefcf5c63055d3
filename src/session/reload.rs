//! What happens when the project's files change under it.

use super::{
    Session, capture,
    command::Question,
    documents::{self, Merge},
    view::Level,
    watch::Watch,
};
use crate::project::{self, FillValue, Input, Media, MeshSource, Origin, Project, Tab};
use std::{
    collections::BTreeSet,
    fs,
    hash::{DefaultHasher, Hash, Hasher},
    path::{Path, PathBuf},
};

/// What the pictures a project names and the files its texts include held on disk, as a hash of the whole content: enough to see that one has changed. A time
/// of change is not, as it stands still for milliseconds and the new picture can be as long as the old.
pub(super) type MediaStamps = Vec<(PathBuf, Option<u64>)>;

/// What is on disk, if it can be used.
enum OnDisk {
    Project(Box<Project>),
    /// It makes no whole project, perhaps because somebody is writing it just now.
    Unusable(String),
}

impl Session {
    /// Looks at the disk where the watch says so and the quiet has lasted.
    pub(super) fn check_disk(&mut self) {
        if self.disk.watch.as_ref().is_some_and(Watch::take_changed) {
            self.disk.changes.touch(self.now);
        }
        let is_due = self.disk.changes.take_due(self.now);
        if !(std::mem::take(&mut self.disk.is_check_wanted) || is_due) {
            return;
        }
        let since = *self.disk.unsettled_since.get_or_insert(self.now);
        let is_last_try = self.now.saturating_duration_since(since) >= self.options.retry_for;
        match self.read_disk(is_last_try) {
            None => self.disk.unsettled_since = None,
            Some(OnDisk::Project(project)) => {
                self.disk.unsettled_since = None;
                self.disk.told = None;
                self.merge(*project);
            }
            Some(OnDisk::Unusable(_)) if !is_last_try => self.disk.changes.touch(self.now),
            Some(OnDisk::Unusable(why)) => {
                self.disk.unsettled_since = None;
                self.tell_gone();
                if self.disk.told.as_ref() != Some(&why) {
                    self.notice(Level::Warning, format!("{why}\nThe texts and the picture here stay as they are"));
                    self.disk.told = Some(why);
                }
            }
        }
    }

    /// `None` for a project that lies in no file. On the last try files that are gone or empty are taken as meant.
    fn read_disk(&self, is_last_try: bool) -> Option<OnDisk> {
        let path = match &self.documents.saved().origin {
            Origin::Folder { path, .. } | Origin::File(path) | Origin::Json(path) => path,
            Origin::Unsaved | Origin::Preset(_) => return None,
        };
        let mut loaded = match project::load(&path.to_string_lossy()) {
            Ok(loaded) => loaded.project,
            Err(e) => return Some(OnDisk::Unusable(e.to_string())),
        };
        for tab in self.documents.saved().tabs() {
            let Some(known) = self.documents.saved().source(&tab) else { continue };
            match loaded.source_mut(&tab) {
                // Editors truncate a file before they write it.
                Some(source) if source.text.is_empty() && !known.text.is_empty() => {
                    if !is_last_try && !self.documents.is_missing(&tab) {
                        return Some(OnDisk::Unusable(format!("{} is empty", source.name)));
                    }
                    source.text = known.text.clone();
                }
                Some(_) => {}
                // ... or move it away.
                None if !is_last_try
                    && !self.documents.is_missing(&tab)
                    && known.path.as_ref().is_some_and(|p| !p.exists()) =>
                {
                    return Some(OnDisk::Unusable(format!("{} is gone", known.name)));
                }
                None => {}
            }
        }
        Some(OnDisk::Project(Box::new(loaded)))
    }

    fn merge(&mut self, disk: Project) {
        let merge = self.documents.merge(disk);
        merge.gone.iter().for_each(|tab| self.tell_one_gone(tab));
        self.tell_gone();
        self.ask_conflicts(&merge);
        if merge.changes_project() {
            let names: Vec<String> = merge.taken.iter().map(Tab::title).collect();
            let what = if names.is_empty() { "passes and channels".to_owned() } else { project::listed(&names) };
            self.notice(Level::Info, format!("reloaded {what}"));
            self.compile.reset_when_built |= self.disk.reset_on_reload;
            self.after_reload();
        }
        self.documents.current_mut().read_includes();
        let before = std::mem::take(&mut self.disk.media.stamps);
        self.disk_is_known();
        if self.disk.media.stamps != before {
            self.compile_soon();
        }
    }

    /// The project here was changed from outside the editor.
    pub(super) fn after_reload(&mut self) {
        self.text_generation += 1;
        self.show_image_if_gone();
        self.compile_soon();
    }

    fn ask_conflicts(&mut self, merge: &Merge) {
        let base = capture::base_folder(self.project()).unwrap_or_default();
        let texts =
            merge.conflicts.iter().map(|c| (Some(c.tab.clone()), base.join(&c.file), c.mine.clone(), c.disk.clone()));
        let mut all: Vec<_> = texts.collect();
        if merge.structure_conflict {
            let file = manifest_path(self.documents.saved()).unwrap_or_else(|| base.join("eddy.toml"));
            let (mine, disk) = (manifest_text(self.documents.current()), manifest_text(self.documents.saved()));
            all.push((None, file, mine.into(), disk.into()));
        }
        for (tab, file, mine, disk) in all {
            // A newer text on disk takes the place of the one a question shows.
            self.dialog.questions.retain(|q| !matches!(q, Question::Conflict { tab: t, .. } if *t == tab));
            let diff = documents::diff(&disk, &mine);
            self.ask(Question::Conflict { tab, file, mine, disk, diff });
        }
    }

    /// Tells of files that are gone or empty, once each.
    fn tell_gone(&mut self) {
        let saved = self.documents.saved();
        let is_gone = |tab: &Tab| {
            let path = saved.source(tab).and_then(|s| s.path.as_ref());
            path.is_some_and(|p| fs::metadata(p).map_or(true, |m| m.len() == 0))
                && saved.source(tab).is_some_and(|s| !s.text.is_empty())
        };
        let gone: Vec<Tab> = saved.tabs().into_iter().filter(is_gone).collect();
        let new = self.documents.set_missing(gone.into_iter().collect());
        new.iter().for_each(|tab| self.tell_one_gone(tab));
    }

    fn tell_one_gone(&mut self, tab: &Tab) {
        let name = self.project().source(tab).map_or_else(|| tab.title(), |s| s.name.clone());
        self.notice(
            Level::Warning,
            format!("{name} was deleted or emptied outside Eddy; its tab keeps the text, and saving writes it again"),
        );
    }

    /// Whether every file is still as it was read, so that saving overwrites nothing of somebody else's. What has changed is
    /// merged first, and conflicts are asked.
    pub(super) fn disk_is_as_read(&mut self) -> bool {
        let (saved, current) = (self.documents.saved(), self.documents.current());
        let is_text_known = saved.tabs().iter().all(|tab| {
            let Some(source) = saved.source(tab) else { return true };
            let mine = current.source(tab).map(|s| s.text.as_bytes());
            source.path.as_ref().is_none_or(|path| match fs::read(path) {
                Ok(bytes) => {
                    bytes == source.text.as_bytes()
                        || Some(&*bytes) == mine
                        || bytes.is_empty() && self.documents.is_missing(tab)
                }
                // Gone: there is nothing to overwrite.
                Err(_) => true,
            })
        });
        if is_text_known && read_manifest(saved).is_none_or(|now| Some(now) == self.disk.manifest) {
            return true;
        }
        match self.read_disk(true) {
            Some(OnDisk::Project(project)) => {
                let questions = self.dialog.questions.len();
                self.merge(*project);
                self.dialog.questions.len() == questions
            }
            Some(OnDisk::Unusable(why)) => {
                self.notice(
                    Level::Error,
                    format!("not saved: the files have changed on disk and cannot be read whole. {why}\nMend them, or save to another folder"),
                );
                false
            }
            None => true,
        }
    }

    /// What lies on disk is what `documents` says: remember how it looks, and watch it.
    pub(super) fn disk_is_known(&mut self) {
        self.look_at_media();
        self.disk.manifest = read_manifest(self.documents.saved());
    }

    /// Reads what the texts include now; the compile to come takes it.
    pub(super) fn refresh_includes(&mut self) {
        let project = self.documents.current();
        let includes = |s: &project::Source| s.text.contains("#include");
        if !project.includes.is_empty() || project.tab_sources().any(includes) {
            self.documents.current_mut().read_includes();
            self.look_at_media();
        }
    }

    /// Watches what the project reads now, and remembers how its pictures look.
    pub(super) fn look_at_media(&mut self) {
        let folders = folders(self.project());
        if folders.is_empty() {
            self.disk.watch = None;
        } else if self.disk.watch.as_ref().is_none_or(|w| *w.folders() != folders) {
            self.watch(folders);
            // What changed after it was read and before the watch began: nobody tells of it.
            self.disk.is_check_wanted = true;
        }
        self.disk.media.stamps = media_stamps(self.project());
    }

    fn watch(&mut self, folders: BTreeSet<PathBuf>) {
        match Watch::new(folders, self.wake.clone()) {
            Ok((watch, failed)) => {
                self.disk.watch = Some(watch);
                for (folder, error) in failed {
                    self.notice(Level::Warning, format!("changes in {} will go unseen: {error}", folder.display()));
                }
            }
            Err(e) => self.notice(Level::Warning, format!("changes on disk will go unseen: {e}")),
        }
    }
}

fn manifest_path(project: &Project) -> Option<PathBuf> {
    match &project.origin {
        Origin::Folder { path, has_manifest: true } => Some(path.join("eddy.toml")),
        _ => None,
    }
}

fn read_manifest(project: &Project) -> Option<Vec<u8>> {
    fs::read(manifest_path(project)?).ok()
}

/// Passes and channels as `eddy.toml` would say them.
fn manifest_text(project: &Project) -> String {
    let mut named = project.clone();
    for pass in named.passes.iter_mut().filter(|p| p.source.path.is_none()) {
        pass.source.name = format!("{}.glsl", pass.id.key());
    }
    let old = manifest_path(project).and_then(|p| fs::read_to_string(p).ok());
    let has_common_file = capture::base_folder(project).is_some_and(|p| p.join("common.glsl").is_file());
    project::write_manifest(&named, old.as_deref(), &project.name, has_common_file)
}

fn media_files(project: &Project) -> impl Iterator<Item = PathBuf> {
    let base = capture::base_folder(project);
    let channels = project.passes.iter().flat_map(|p| p.channels.iter().flatten());
    channels.filter_map(move |c| match &c.input {
        Input::Texture(m) | Input::Cubemap(m) | Input::Volume(m) | Input::Video(m) | Input::Music(m) => match m {
            Media::File(path) => Some(base.as_deref().unwrap_or(Path::new("")).join(path)),
            Media::Builtin(_) | Media::Site { .. } => None,
        },
        Input::Buffer(_)
        | Input::Target { .. }
        | Input::CubemapPass
        | Input::Keyboard
        | Input::Microphone
        | Input::Webcam => None,
    })
}

/// Files that fill texels of passes.
fn fill_files(project: &Project) -> impl Iterator<Item = PathBuf> {
    let base = capture::base_folder(project).unwrap_or_default();
    project.fills().filter_map(move |(.., fill)| match &fill.value {
        FillValue::File(path) => Some(base.join(path)),
        FillValue::Expression(_) => None,
    })
}

/// Files that texts include, those that are not there among them.
fn included_files(project: &Project) -> impl Iterator<Item = PathBuf> {
    project.includes.iter().filter_map(|i| i.source.path.clone())
}

/// Models that are drawn, and the files these name.
fn model_files(project: &Project) -> Vec<PathBuf> {
    let base = capture::base_folder(project).unwrap_or_default();
    let mut files = Vec::new();
    for draw in project.passes.iter().filter_map(|p| p.settings.geometry.as_ref()).flat_map(|g| &g.draws) {
        let MeshSource::File(path) = &draw.mesh else { continue };
        let model = base.join(path);
        let folder = model.parent().map(Path::to_owned).unwrap_or_default();
        files.extend(project::files_beside(&model).into_iter().map(|f| folder.join(f)));
        files.push(model);
    }
    files.sort();
    files.dedup();
    files
}

/// Everything that is read besides the texts of tabs.
fn read_files(project: &Project) -> impl Iterator<Item = PathBuf> {
    media_files(project).chain(fill_files(project)).chain(included_files(project)).chain(model_files(project))
}

fn media_stamps(project: &Project) -> MediaStamps {
    let stamp = |path: &Path| {
        let mut hasher = DefaultHasher::new();
        fs::read(path).ok()?.hash(&mut hasher);
        Some(hasher.finish())
    };
    read_files(project).map(|p| (p.clone(), stamp(&p))).collect()
}

/// Every folder a file of the project lies in; none for a project that lies nowhere.
fn folders(project: &Project) -> BTreeSet<PathBuf> {
    let Some(base) = capture::base_folder(project) else { return BTreeSet::new() };
    let sources = project.tab_sources();
    let files = sources.filter_map(|s| s.path.clone()).chain(read_files(project));
    let parents = files.filter_map(|f| f.parent().map(Path::to_owned)).filter(|p| p.is_dir());
    parents.chain([base]).collect()
}
