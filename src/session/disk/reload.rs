//! Reloading of the project's files when they change on disk.

use super::{Check, DiskProject, DiskSync, manifest_path, manifest_text};
use crate::{
    command::Question,
    documents::{self, Merge},
    open_project::OpenProject,
    view::{About, Level},
};
use eddy_playback::capture;
use eddy_project::{self as project, Included, Loaded, Project, Tab};
use std::{fs, path::Path};

impl OpenProject {
    /// Checks the disk if the watcher has reported a change and the debounce time has passed.
    pub(crate) fn check_disk(&mut self) {
        match self.disk.check(self.host.now, &self.documents) {
            Check::Nothing => {}
            Check::Project(project) => {
                self.dismiss_notices(About::Files);
                self.dismiss_notices(About::Gone);
                self.merge(*project);
            }
            Check::Gone => drop(self.find_home()),
            Check::Unusable { why } => {
                self.report_missing_files();
                if let Some(why) = why {
                    self.dismiss_notices(About::Files);
                    let text = format!("{why}\nThe texts and the picture here are unchanged");
                    self.notice_about(About::Files, Level::Warning, text);
                }
            }
        }
    }

    /// Returns whether the project can be saved where it is. Follows a file or folder that was renamed; says so if it was
    /// moved or deleted. A single deleted file is written again by saving.
    pub(crate) fn find_home(&mut self) -> bool {
        if self.disk.is_home_there(&self.documents) {
            self.dismiss_notices(About::Gone);
            return true;
        }
        let Some(home) = self.disk.home.clone() else { return true };
        self.dismiss_notices(About::Files);
        let what = if home.is_folder() { "folder" } else { "file" };
        let Some(path) = home.renamed() else {
            if !home.is_folder() && home.path().parent().is_some_and(Path::is_dir) {
                self.report_missing_files();
                return true;
            }
            if self.documents.restore_includes() {
                self.compile_soon();
            }
            let is_told = self.host.notices.list().iter().any(|notice| notice.about == About::Gone);
            if !is_told {
                let place = home.path().display();
                let text = format!(
                    "The project's {what} {place} was moved or deleted. Your work is still open here: save it elsewhere"
                );
                self.notice_about(About::Gone, Level::Warning, text);
            }
            return false;
        };
        self.dismiss_notices(About::Gone);
        self.documents.follow_move(&path);
        self.disk.has_moved();
        self.remember_disk();
        self.disk.want_check();
        self.compile_soon();
        self.notice_with_path(
            About::Project,
            Level::Info,
            format!("The {what} was renamed to {}", path.display()),
            path,
        );
        true
    }

    /// Reads the project from disk after only the texts were written.
    pub(crate) fn read_disk(&mut self) {
        if let Some(DiskProject::Project(project)) = DiskSync::read(&self.documents, true) {
            self.merge(*project);
        }
    }

    fn merge(&mut self, disk: Loaded) {
        let merge = self.documents.merge(disk.project);
        self.note_reading(&disk.warnings, &disk.sources);
        merge.gone.iter().for_each(|tab| self.report_missing_file(tab));
        self.report_missing_files();
        self.ask_conflicts(&merge);
        if merge.changes_project() {
            let names: Vec<String> = merge.taken.iter().map(Tab::title).collect();
            let what = if names.is_empty() { "passes and channels".to_owned() } else { project::listed(&names) };
            self.notice(Level::Info, format!("reloaded {what}"));
            self.compile.resets |= self.disk.reset_on_reload;
            if merge.took_structure {
                self.pass_history.clear();
            }
            self.after_reload();
        }
        let before = self.project().includes.clone();
        self.read_includes();
        if self.project().includes != before {
            self.compile_soon();
        }
        self.remember_disk();
        self.compile.is_file_check_due = true;
    }

    /// Updates the session after the project was changed outside the editor.
    pub(crate) fn after_reload(&mut self) {
        self.host.text_generation += 1;
        self.compile.include_edits += 1;
        self.show_image_if_gone();
        self.compile_soon();
    }

    /// Reads the included files if no compile has done it yet: they are saved with the project.
    pub(crate) fn settle_includes(&mut self) {
        if self.compile.unread_includes().is_some() {
            self.read_includes();
        }
        if let Some(now) = project::regenerated(self.project()) {
            self.follow_generated(now);
        }
    }

    /// Takes the passes that were generated from the texts.
    pub(crate) fn follow_generated(&mut self, now: Project) {
        if self.documents.follow_generated(now) {
            self.host.text_generation += 1;
            self.host.changed = true;
            self.show_image_if_gone();
        }
    }

    fn read_includes(&mut self) {
        let mut project = self.project().clone();
        project.read_includes();
        self.take_includes(project.includes, self.compile.include_edits);
    }

    /// Takes the included files as they were read for an edit of the texts.
    pub(crate) fn take_includes(&mut self, includes: Vec<Included>, edit: u64) {
        self.compile.includes_read = edit;
        // Those of a project that was deleted stay as they were read: they are saved with it.
        if !self.disk.is_home_there(&self.documents) {
            return;
        }
        // An editor that shows one must reload it.
        self.host.text_generation += u64::from(self.documents.take_includes(includes));
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
            // A newer text on disk replaces the one that a question shows.
            self.host.dialog.questions.retain(|q| !matches!(q, Question::Conflict { tab: t, .. } if *t == tab));
            let diff = documents::diff(&disk, &mine);
            self.ask(Question::Conflict { tab, file, mine, disk, diff });
        }
    }

    /// Reports missing or empty files, once each.
    fn report_missing_files(&mut self) {
        let saved = self.documents.saved();
        // A missing included file is an error at the line that includes it.
        let is_own = |tab: &Tab| !matches!(tab, Tab::Included(_)) || self.documents.is_tab_dirty(tab);
        let is_gone = |tab: &Tab| {
            let path = saved.source(tab).and_then(|s| s.path.as_ref());
            path.is_some_and(|p| fs::metadata(p).map_or(true, |m| m.len() == 0))
                && saved.source(tab).is_some_and(|s| !s.text.is_empty())
        };
        let gone: Vec<Tab> = saved.tabs().into_iter().filter(is_own).filter(is_gone).collect();
        if gone.is_empty() {
            self.dismiss_notices(About::MissingFile);
        }
        let new = self.documents.set_missing(gone.into_iter().collect());
        new.iter().for_each(|tab| self.report_missing_file(tab));
    }

    fn report_missing_file(&mut self, tab: &Tab) {
        let source = self.project().source(tab);
        let name = source.map_or_else(|| tab.title(), |s| s.name.clone());
        let is_there = source.and_then(|s| s.path.as_ref()).is_some_and(|path| path.exists());
        let what = if is_there { "was emptied" } else { "was deleted" };
        self.notice_about(About::MissingFile, Level::Warning, format!("{name} {what} on disk. Save to write it again"));
    }

    /// Returns whether every file is unchanged since it was read, so that saving overwrites no other program's changes.
    /// Changes are merged first, and conflicts become questions.
    pub(crate) fn disk_is_as_read(&mut self) -> bool {
        if self.disk.is_as_read(&self.documents) {
            return true;
        }
        match DiskSync::read(&self.documents, true) {
            Some(DiskProject::Project(project)) => {
                let questions = self.host.dialog.questions.len();
                self.merge(*project);
                self.host.dialog.questions.len() == questions
            }
            Some(DiskProject::Unusable(why)) => {
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

    /// Records that the disk matches `documents`, and watches it.
    pub(crate) fn remember_disk(&mut self) {
        self.watch_folders();
        self.disk.remember(&self.documents);
    }

    /// Watches the folders of all files that the project reads, as far as the last compile has found them.
    pub(crate) fn watch_folders(&mut self) {
        let Some(failed) = self.disk.watch(self.documents.current(), &self.host.wake) else { return };
        self.dismiss_notices(About::Watching);
        for text in failed {
            self.notice_about(About::Watching, Level::Warning, text);
        }
    }
}
