//! A session follows the project's files when they change under it.

use super::{
    Session, capture,
    command::Question,
    documents::{self, Merge},
    view::{About, Level},
    watch::Watch,
};
use eddy_project::{self as project, Included, Loaded, Origin, Project, Tab, confine, limits};
use std::{collections::BTreeSet, fs, path::PathBuf};

/// The project on disk, if it can be used.
enum OnDisk {
    Project(Box<Loaded>),
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
                self.settled(About::Files);
                self.merge(*project);
            }
            Some(OnDisk::Unusable(_)) if !is_last_try => self.disk.changes.touch(self.now),
            Some(OnDisk::Unusable(why)) => {
                self.disk.unsettled_since = None;
                self.tell_gone();
                if self.disk.told.as_ref() != Some(&why) {
                    self.settled(About::Files);
                    let text = format!("{why}\nThe texts and the picture here are unchanged");
                    self.notice_about(About::Files, Level::Warning, text);
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
        let mut read = match project::load(&path.to_string_lossy()) {
            Ok(read) => read,
            Err(e) => return Some(OnDisk::Unusable(e.to_string())),
        };
        let loaded = &mut read.project;
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
                    return Some(OnDisk::Unusable(format!("{} was removed", known.name)));
                }
                None => {}
            }
        }
        Some(OnDisk::Project(Box::new(read)))
    }

    fn merge(&mut self, disk: Loaded) {
        let merge = self.documents.merge(disk.project);
        self.note_reading(&disk.warnings, &disk.sources);
        merge.gone.iter().for_each(|tab| self.tell_one_gone(tab));
        self.tell_gone();
        self.ask_conflicts(&merge);
        if merge.changes_project() {
            let names: Vec<String> = merge.taken.iter().map(Tab::title).collect();
            let what = if names.is_empty() { "passes and channels".to_owned() } else { project::listed(&names) };
            self.notice(Level::Info, format!("reloaded {what}"));
            self.compile.reset_when_built |= self.disk.reset_on_reload;
            if merge.took_structure {
                self.passes.clear();
            }
            self.after_reload();
        }
        let before = self.project().includes.clone();
        self.read_includes();
        if self.project().includes != before {
            self.compile_soon();
        }
        self.disk_is_known();
        self.compile.is_look_wanted = true;
    }

    /// The project here was changed from outside the editor.
    pub(super) fn after_reload(&mut self) {
        self.text_generation += 1;
        self.compile.include_edits += 1;
        self.show_image_if_gone();
        self.compile_soon();
    }

    /// Reads what the texts include where no compile has done it yet: included files are saved with the project.
    pub(super) fn settle_includes(&mut self) {
        if self.compile.includes_read != self.compile.include_edits {
            self.read_includes();
        }
    }

    fn read_includes(&mut self) {
        let mut project = self.project().clone();
        project.read_includes();
        self.take_includes(project.includes, self.compile.include_edits);
    }

    /// Takes what the texts include as it was read for an edit of them.
    pub(super) fn take_includes(&mut self, includes: Vec<Included>, edit: u64) {
        self.compile.includes_read = edit;
        // An editor that shows one takes it anew.
        self.text_generation += u64::from(self.documents.take_includes(includes));
    }

    fn ask_conflicts(&mut self, merge: &Merge) {
        let texts =
            merge.conflicts.iter().map(|c| (Some(c.tab.clone()), c.file.clone(), c.mine.clone(), c.disk.clone()));
        let mut all: Vec<_> = texts.collect();
        if merge.structure_conflict {
            let file = manifest_path(self.documents.saved()).unwrap_or_else(|| {
                let base = capture::base_folder(self.project()).unwrap_or_default();
                base.join("eddy.toml")
            });
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
        // A file that others include has an error at the line that does.
        let is_own = |tab: &Tab| !matches!(tab, Tab::Included(_)) || self.documents.is_tab_dirty(tab);
        let is_gone = |tab: &Tab| {
            let path = saved.source(tab).and_then(|s| s.path.as_ref());
            path.is_some_and(|p| fs::metadata(p).map_or(true, |m| m.len() == 0))
                && saved.source(tab).is_some_and(|s| !s.text.is_empty())
        };
        let gone: Vec<Tab> = saved.tabs().into_iter().filter(is_own).filter(is_gone).collect();
        if gone.is_empty() {
            self.settled(About::MissingFile);
        }
        let new = self.documents.set_missing(gone.into_iter().collect());
        new.iter().for_each(|tab| self.tell_one_gone(tab));
    }

    fn tell_one_gone(&mut self, tab: &Tab) {
        let name = self.project().source(tab).map_or_else(|| tab.title(), |s| s.name.clone());
        self.notice_about(
            About::MissingFile,
            Level::Warning,
            format!("{name} was deleted or emptied outside Eddy; its tab keeps the text, and saving writes it again"),
        );
    }

    /// Returns whether every file is still as it was read, so that saving overwrites nothing of somebody else's. What
    /// has changed is merged first, and conflicts are asked.
    pub(super) fn disk_is_as_read(&mut self) -> bool {
        let (saved, current) = (self.documents.saved(), self.documents.current());
        let is_text_known = saved.tabs().iter().all(|tab| {
            let Some(source) = saved.source(tab) else { return true };
            let mine = current.source(tab).map(|s| s.text.as_bytes());
            source.path.as_ref().is_none_or(|path| match confine::read_own(path, limits::GLSL_TEXT) {
                Ok(bytes) => {
                    bytes == source.text.as_bytes()
                        || Some(&*bytes) == mine
                        || bytes.is_empty() && self.documents.is_missing(tab)
                }
                // Gone: there is nothing to overwrite. Anything else is not what was read.
                Err(e) => e.is_missing(),
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
                self.notice_about(
                    About::Saving,
                    Level::Error,
                    format!(
                        "not saved: the files have changed on disk and cannot be read. {why}\nFix them, or save to \
                         another folder"
                    ),
                );
                false
            }
            None => true,
        }
    }

    /// Remembers that what lies on disk is what `documents` says, and watches it.
    pub(super) fn disk_is_known(&mut self) {
        self.watch_what_is_read();
        self.disk.manifest = read_manifest(self.documents.saved());
    }

    /// Watches the folders of all files that the project reads, as far as the last compile has found them.
    pub(super) fn watch_what_is_read(&mut self) {
        let folders = folders(self.project(), &self.disk.media_files);
        if folders.is_empty() {
            self.disk.watch = None;
        } else if self.disk.watch.as_ref().is_none_or(|w| *w.folders() != folders) {
            self.watch(folders);
            // What changed after it was read and before the watch began: nobody tells of it.
            self.disk.is_check_wanted = true;
        }
    }

    fn watch(&mut self, folders: BTreeSet<PathBuf>) {
        self.settled(About::Watching);
        match Watch::new(folders, self.wake.clone()) {
            Ok((watch, failed)) => {
                self.disk.watch = Some(watch);
                for (folder, error) in failed {
                    let text = format!("cannot watch {} for changes: {error}", folder.display());
                    self.notice_about(About::Watching, Level::Warning, text);
                }
            }
            Err(e) => {
                let text = format!("cannot watch files for changes: {e}");
                self.notice_about(About::Watching, Level::Warning, text);
            }
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
    manifest_path(project)?;
    confine::read(&capture::base_folder(project)?, "eddy.toml", limits::MANIFEST).ok()
}

/// Passes and channels as `eddy.toml` would say them.
fn manifest_text(project: &Project) -> String {
    let mut named = project.clone();
    for pass in named.passes.iter_mut().filter(|p| p.source.path.is_none()) {
        pass.source.name = format!("{}.glsl", pass.id.key());
    }
    let old = read_manifest(project).and_then(|bytes| String::from_utf8(bytes).ok());
    let has_common_file = capture::base_folder(project).is_some_and(|p| p.join("common.glsl").is_file());
    project::write_manifest(&named, old.as_deref(), &project.name, has_common_file)
}

/// Every folder a file of the project lies in; none for a project that lies nowhere.
fn folders(project: &Project, media: &[PathBuf]) -> BTreeSet<PathBuf> {
    let Some(base) = capture::base_folder(project) else { return BTreeSet::new() };
    let texts = project.tab_sources().chain(project.includes.iter().map(|i| &i.source));
    let files = texts.filter_map(|s| s.path.as_ref()).chain(media);
    let parents = files.filter_map(|f| Some(f.parent()?.to_owned())).filter(|p| p.is_dir());
    parents.chain([base]).collect()
}
