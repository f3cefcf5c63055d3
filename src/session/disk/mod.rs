//! The project's files: when they are read again, and what is known of them.
//!
//! Owns the watch on the project's folders ([`watcher`]), the wait until another program has finished writing, and the
//! stamps of pictures and models ([`stamps`]). The texts belong to the documents; `reload` applies changes to them.

mod home;
mod reload;
pub(crate) mod stamps;
mod watcher;

use super::{debounce::Debounce, documents::Documents, options::SessionOptions};
use eddy_background::Wake;
use eddy_playback::capture;
use eddy_project::{self as project, Loaded, Origin, Project, confine, limits};
use home::Home;
use std::{
    collections::BTreeSet,
    mem::take,
    path::PathBuf,
    time::{Duration, Instant},
};
use watcher::FolderWatcher;

/// The synchronisation state of the open project's files.
#[derive(Default)]
pub(super) struct DiskSync {
    watcher: Option<FolderWatcher>,
    /// Incomplete projects are read again for this long.
    retry_for: Duration,
    changes: Debounce,
    /// Check in the next tick, whatever the watcher says.
    is_check_wanted: bool,
    /// Since when the files on disk do not form a complete project.
    unsettled_since: Option<Instant>,
    /// The last message about such files, so that it is reported once.
    reported: Option<String>,
    /// The place at which the project was last read or written.
    home: Option<Home>,
    /// `eddy.toml` as it was last read or written.
    manifest: Option<Vec<u8>>,
    /// Counts the times that a project was opened or moved.
    opened: u64,
    /// Pictures, models and the files that these name, as the last compile found them.
    media_files: Vec<PathBuf>,
    pub reset_on_reload: bool,
}

/// The project on disk, if it can be loaded.
enum DiskProject {
    Project(Box<Loaded>),
    /// The files do not form a complete project, perhaps because another program is still writing them.
    Unusable(String),
}

/// The result of checking the disk.
enum Check {
    /// No check was due, or the files are being written.
    Nothing,
    /// The files form a different project.
    Project(Box<Loaded>),
    /// The files do not form a complete project. `why` is set if it has not been reported before.
    Unusable { why: Option<String> },
    /// The project's file or folder is no longer there.
    Gone,
}

impl DiskSync {
    pub(crate) fn new(options: &SessionOptions) -> Self {
        let (watch_debounce, retry_for) = (options.watch_debounce, options.retry_for);
        Self { retry_for, changes: Debounce::with_limit(watch_debounce, 8 * watch_debounce), ..Self::default() }
    }

    /// The state of another project's files, of which nothing is known yet.
    pub(crate) fn successor(&self, options: &SessionOptions) -> Self {
        Self { opened: self.opened + 1, reset_on_reload: self.reset_on_reload, ..Self::new(options) }
    }

    /// The project was moved to another place.
    pub(crate) fn has_moved(&mut self) {
        self.opened += 1;
    }

    /// Counts the times that a project was opened or moved.
    pub(crate) fn opened(&self) -> u64 {
        self.opened
    }

    /// Schedules a check of the files for the next tick.
    pub(crate) fn want_check(&mut self) {
        self.is_check_wanted = true;
    }

    /// Returns the path of the project's file or folder; `None` if it is not stored in files.
    pub(crate) fn home_path(&self) -> Option<PathBuf> {
        self.home.as_ref().map(|home| home.path().to_owned())
    }

    /// Returns when the debounce time after the last file change ends.
    pub(crate) fn deadline(&self) -> Option<Instant> {
        self.changes.deadline()
    }

    /// Takes the pictures, models and other files that a compile has read. Returns whether they have changed.
    pub(crate) fn set_media_files(&mut self, files: Vec<PathBuf>) -> bool {
        let is_new = self.media_files != files;
        self.media_files = files;
        is_new
    }

    /// Reads the files if the watcher has reported a change and the debounce time has passed.
    fn check(&mut self, now: Instant, documents: &Documents) -> Check {
        if self.watcher.as_ref().is_some_and(FolderWatcher::take_changed) {
            self.changes.touch(now);
        }
        let is_due = self.changes.take_due(now);
        if !(take(&mut self.is_check_wanted) || is_due) {
            return Check::Nothing;
        }
        let since = *self.unsettled_since.get_or_insert(now);
        let is_last_try = now.saturating_duration_since(since) >= self.retry_for;
        if !self.is_home_there(documents) {
            // Editors move a file away before they write it.
            if !is_last_try && !self.home.as_ref().is_some_and(Home::is_folder) {
                self.changes.touch(now);
                return Check::Nothing;
            }
            self.unsettled_since = None;
            return Check::Gone;
        }
        let found = Self::read(documents, is_last_try);
        if matches!(found, Some(DiskProject::Unusable(_))) && !is_last_try {
            self.changes.touch(now);
            return Check::Nothing;
        }
        self.unsettled_since = None;
        match found {
            None => Check::Nothing,
            Some(DiskProject::Project(project)) => {
                self.reported = None;
                Check::Project(project)
            }
            Some(DiskProject::Unusable(why)) => {
                let is_new = self.reported.as_ref() != Some(&why);
                self.reported = Some(why.clone());
                Check::Unusable { why: Some(why).filter(|_| is_new) }
            }
        }
    }

    /// `None` for a project that is not stored in files. On the last try, missing or empty files are accepted as they
    /// are.
    fn read(documents: &Documents, is_last_try: bool) -> Option<DiskProject> {
        let mut read = match project::load(&documents.saved().spec()?) {
            Ok(read) => read,
            Err(e) => return Some(DiskProject::Unusable(e.to_string())),
        };
        let loaded = &mut read.project;
        for tab in documents.saved().tabs() {
            let Some(known) = documents.saved().source(&tab) else { continue };
            match loaded.source_mut(&tab) {
                // Editors truncate a file before they write it.
                Some(source) if source.text.is_empty() && !known.text.is_empty() => {
                    if !is_last_try && !documents.is_missing(&tab) {
                        return Some(DiskProject::Unusable(format!("{} is empty", source.name)));
                    }
                    source.text = known.text.clone();
                }
                Some(_) => {}
                // ... or move it away.
                None if !is_last_try
                    && !documents.is_missing(&tab)
                    && known.path.as_ref().is_some_and(|p| !p.exists()) =>
                {
                    return Some(DiskProject::Unusable(format!("{} was removed", known.name)));
                }
                None => {}
            }
        }
        Some(DiskProject::Project(Box::new(read)))
    }

    /// Returns whether the project's file or folder is still where it was read; true if it is not stored in files.
    pub(crate) fn is_home_there(&self, documents: &Documents) -> bool {
        let saved = documents.saved();
        let files = || saved.tab_sources().filter_map(|source| source.path.as_deref());
        self.home.as_ref().is_none_or(|home| home.is_there(files()))
    }

    /// Returns whether every file is unchanged since it was read, or already has the content to be written.
    fn is_as_read(&self, documents: &Documents) -> bool {
        let (saved, current) = (documents.saved(), documents.current());
        let is_text_known = saved.tabs().iter().all(|tab| {
            let Some(source) = saved.source(tab) else { return true };
            let mine = current.source(tab).map(|s| s.text.as_bytes());
            source.path.as_ref().is_none_or(|path| match confine::read_own(path, limits::GLSL_TEXT) {
                Ok(bytes) => {
                    bytes == source.text.as_bytes()
                        || Some(&*bytes) == mine
                        || bytes.is_empty() && documents.is_missing(tab)
                }
                // A missing file cannot be overwritten. Any other error means that it is not what was read.
                Err(e) => e.is_missing(),
            })
        });
        is_text_known && read_manifest(saved).is_none_or(|now| Some(now) == self.manifest)
    }

    /// Records that the files on disk match the documents.
    fn remember(&mut self, documents: &Documents) {
        self.manifest = read_manifest(documents.saved());
        self.home = Home::of(&documents.saved().origin);
    }

    /// Watches the folders of all files that the project reads, as far as the last compile has found them. Returns
    /// messages about folders that cannot be watched; `None` if the folders are unchanged.
    fn watch(&mut self, project: &Project, wake: &Wake) -> Option<Vec<String>> {
        let folders = folders(project, &self.media_files);
        if folders.is_empty() {
            self.watcher = None;
            return None;
        }
        if self.watcher.as_ref().is_some_and(|w| *w.folders() == folders) {
            return None;
        }
        // Changes between reading and the start of the watch are not reported, so check again.
        self.is_check_wanted = true;
        Some(match FolderWatcher::new(folders, wake.clone()) {
            Ok((watcher, failed)) => {
                self.watcher = Some(watcher);
                let text =
                    |(folder, error): (PathBuf, _)| format!("cannot watch {} for changes: {error}", folder.display());
                failed.into_iter().map(text).collect()
            }
            Err(e) => vec![format!("cannot watch files for changes: {e}")],
        })
    }
}

fn manifest_path(project: &Project) -> Option<PathBuf> {
    match &project.origin {
        Origin::Folder { path, has_manifest: true } => Some(path.join("eddy.toml")),
        _ => None,
    }
}

fn read_manifest(project: &Project) -> Option<Vec<u8>> {
    manifest_path(project)?;
    confine::read(&capture::base_folder(project)?, "eddy.toml", limits::MANIFEST).ok()
}

/// Passes and channels in the form of `eddy.toml`.
fn manifest_text(project: &Project) -> String {
    let mut named = project.clone();
    for pass in named.passes.iter_mut().filter(|p| p.source.path.is_none()) {
        pass.source.name = format!("{}.glsl", pass.id.key());
    }
    let old = read_manifest(project).and_then(|bytes| String::from_utf8(bytes).ok());
    let has_common_file = capture::base_folder(project).is_some_and(|p| p.join("common.glsl").is_file());
    project::write_manifest(&named, old.as_deref(), &project.name, has_common_file)
}

/// Every folder that contains a file of the project; none for a project that is not stored in files.
fn folders(project: &Project, media: &[PathBuf]) -> BTreeSet<PathBuf> {
    let Some(base) = capture::base_folder(project) else { return BTreeSet::new() };
    let texts = project.tab_sources().chain(project.includes.iter().map(|i| &i.source));
    let files = texts.filter_map(|s| s.path.as_ref()).chain(media);
    let parents = files.filter_map(|f| Some(f.parent()?.to_owned())).filter(|p| p.is_dir());
    parents.chain([base]).collect()
}
