//! Opening, saving, closing, and the questions that protect unsaved work, with their answers.

use super::{
    Session,
    command::{Answer, FileCommand, PendingAction, Question, Request},
    documents::Documents,
    export_page::is_page,
    open_project::OpenProject,
    recovery::{KEPT_DAYS, place_for_replaced},
    scene, template,
    view::{About, Level, TabDiagnostic},
};
use eddy_diag::{Diagnostic, SourceMap};
use eddy_playback::capture;
use eddy_project::{self as project, Origin, Overwrite, Project, ProjectError, Tab};
use std::{
    fs,
    io::Write,
    path::{Path, PathBuf},
};

impl Session {
    pub(super) fn apply_to_files(&mut self, command: FileCommand) {
        match command {
            FileCommand::Answer(answer) => self.answer(answer),
            FileCommand::Terminate => self.terminate(),
            // A front end shows nothing else while a question is open; a script may still send commands.
            _ if self.question().is_some() => {
                self.open.notice_about(About::Question, Level::Warning, "answer the open question first");
            }
            FileCommand::Open(spec) if scene::holds_project(Path::new(&spec)) => self.open_picture(Path::new(&spec)),
            FileCommand::Open(spec) => self.ask_to_save_then(PendingAction::Open(spec)),
            FileCommand::OpenProject { project, size } => {
                self.ask_to_save_then(PendingAction::OpenProject { project, size })
            }
            FileCommand::Paste(text) => self.paste(&text),
            FileCommand::Bring { paths, to } => self.bring(paths, to),
            FileCommand::New => self.ask_to_save_then(PendingAction::New),
            FileCommand::Close => self.ask_to_save_then(PendingAction::Close),
            FileCommand::Save => {
                self.save();
            }
            FileCommand::SaveAs(folder) => self.save_as(&folder, &[]),
            FileCommand::ExportJson(file) => self.open.export_json(&file),
            FileCommand::Convert => self.convert(),
            FileCommand::ExportPage(file) => self.open.export_page(&file),
            FileCommand::SaveAsCancelled => self.open.host.dialog.after_save = None,
        }
    }

    pub(super) fn ask_to_save_then(&mut self, then: PendingAction) {
        if self.is_dirty() {
            let tabs = self.open.documents.dirty_tabs();
            self.open.ask(Question::Unsaved { then, tabs });
        } else {
            self.perform(then);
        }
    }

    fn perform(&mut self, then: PendingAction) {
        match then {
            PendingAction::Open(spec) => self.open(&spec),
            PendingAction::OpenProject { project, size } => {
                self.replace(Documents::new(*project));
                if size.is_some() {
                    self.open.canvas.requested.fixed = size;
                }
            }
            PendingAction::OpenPicture(scene) => self.show_scene(&scene),
            PendingAction::New => {
                self.replace(Documents::new(template::project()));
                self.open.host.new_shader_count += 1;
            }
            PendingAction::Keep(project) => self.replace(Documents::restored(*project, template::project())),
            PendingAction::Recover(file) => self.recover(&file),
            PendingAction::Close if self.asks_about_film() => {}
            PendingAction::Close => {
                self.open.end_recording();
                self.keep_time();
                self.services.recovery.forget_unsaved();
                self.open.host.dialog.requests.push_back(Request::Exit);
            }
        }
    }

    /// Quits without a question, which might never be answered.
    fn terminate(&mut self) {
        self.open.end_recording();
        self.cancel_film();
        self.keep_time();
        self.services.recovery.keep_unsaved(&mut self.open);
        self.open.host.dialog.requests.push_back(Request::Exit);
    }

    fn open(&mut self, spec: &str) {
        self.open.dismiss_notices(About::Opening);
        match project::load(spec) {
            Ok(loaded) => {
                self.replace(Documents::new(loaded.project));
                self.open.note_reading(&loaded.warnings, &loaded.sources);
            }
            Err(e) => self.open.notice_about(About::Opening, Level::Error, format!("cannot open {spec}: {e}")),
        }
    }

    /// Writes the project to where it came from. Returns whether nothing unsaved is left.
    fn save(&mut self) -> bool {
        self.open.dismiss_notices(About::Saving);
        let home = match &self.project().origin {
            Origin::Folder { path, .. } | Origin::File(path) => path.clone(),
            Origin::Unsaved | Origin::Preset(_) | Origin::Json(_) => {
                self.open.request_save_as();
                return false;
            }
        };
        if !self.open.find_home() {
            self.open.request_save_as();
            return false;
        }
        let home = self.open.disk.home_path().unwrap_or(home);
        if !self.open.may_overwrite() {
            return false;
        }
        self.open.settle_includes();
        if !self.is_dirty() {
            self.open.compile.saved();
            self.open.notice(Level::Info, "nothing to save: the files are up to date");
            return true;
        }
        match project::save(self.project(), &home, Overwrite::Refuse) {
            Ok(saved) => {
                self.saved(saved);
                true
            }
            // The name of a pass that was added here is that of a file outside this project.
            Err(ProjectError::WouldOverwrite { paths }) => {
                self.open.ask(Question::Overwrite { folder: home, files: paths });
                false
            }
            // Texts are written if they can be, even if the rest cannot.
            Err(ProjectError::CannotHold { what, .. })
                if self.open.host.dialog.after_save.is_none() && self.open.save_texts(&home) =>
            {
                let place = home.display();
                let text = format!(
                    "saved the code of {place}; it cannot store {what}. Save again to put the project into a folder"
                );
                self.open.notice_about(About::Saving, Level::Warning, text);
                false
            }
            Err(e @ ProjectError::CannotHold { .. }) => {
                self.open.notice_about(About::Saving, Level::Warning, e.to_string());
                self.open.request_save_as();
                false
            }
            Err(e) => {
                self.open.save_failed(&e);
                false
            }
        }
    }

    /// `replaced`: the foreign files that the user allows replacing.
    fn save_as(&mut self, folder: &Path, replaced: &[PathBuf]) {
        self.open.dismiss_notices(About::Saving);
        // A typed path may be relative to where Eddy was started.
        let folder = &std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
        let home = capture::base_folder(self.project()).and_then(|home| home.canonicalize().ok());
        let is_home = home.is_some_and(|home| folder.canonicalize().is_ok_and(|folder| folder == home));
        if is_home && !self.open.may_overwrite() {
            return;
        }
        self.open.settle_includes();
        let mut project = self.project().clone();
        if !self.open.disk.is_home_there(&self.open.documents) {
            self.open.documents.restore_includes();
            project = self.project().clone();
            // A folder of that name has none of its files.
            project.origin = Origin::Unsaved;
        }
        if !is_same_place(&project.origin, folder) {
            project.name = project::name_at(folder);
        }
        match save_over(&project, folder, replaced, self.open.host.options.recovery.as_deref()) {
            Ok((saved, kept)) => {
                self.saved(saved);
                if let Some(kept) = kept {
                    self.open.report_kept_files(replaced.len(), kept);
                }
                // Pictures are read from the new place, and the texts have new names in diagnostics.
                self.open.disk.has_moved();
                self.open.compile_soon();
                self.finish_save();
            }
            Err(ProjectError::WouldOverwrite { paths }) => {
                self.open.ask(Question::Overwrite { folder: folder.to_owned(), files: paths });
            }
            Err(e) => self.open.save_failed(&e),
        }
    }

    fn saved(&mut self, project: Project) {
        project::remove_renamed(self.open.documents.saved(), self.open.documents.current(), &project);
        let place = match &project.origin {
            Origin::Folder { path, .. } | Origin::File(path) | Origin::Json(path) => path.display().to_string(),
            Origin::Unsaved | Origin::Preset(_) => project.name.clone(),
        };
        if self.open.documents.set_saved(project) {
            // The last compile was of the edited version, which differs.
            self.open.pass_history.clear();
            self.open.after_reload();
        }
        self.record_recent();
        self.open.remember_disk();
        self.open.compile.saved();
        self.open.notice(Level::Info, format!("saved {place}"));
    }

    fn finish_save(&mut self) {
        if let Some(then) = self.open.host.dialog.after_save.take() {
            self.perform(then);
        }
    }

    fn answer(&mut self, answer: Answer) {
        self.open.dismiss_notices(About::Question);
        let Some(question) = self.open.host.dialog.questions.pop_front() else { return };
        match (question, answer) {
            (Question::Unsaved { then, .. }, Answer::Save) => {
                self.open.host.dialog.after_save = Some(then);
                if self.save() {
                    self.finish_save();
                }
            }
            (Question::Unsaved { then, .. }, Answer::Discard) => self.perform(then),
            (Question::Overwrite { folder, files }, Answer::Overwrite) => self.save_as(&folder, &files),
            (Question::Export { file, exists, .. }, Answer::Export) if is_page(&file) => {
                self.open.write_page(&file, exists)
            }
            (Question::Export { file, exists, .. }, Answer::Export) => self.open.write_json(&file, exists),
            (Question::Export { .. } | Question::Film { .. }, Answer::Cancel) => {}
            (Question::Film { .. }, Answer::Finish) => self.close_after_film(),
            (Question::Film { .. }, Answer::Discard) => {
                self.cancel_film();
                self.ask_to_save_then(PendingAction::Close);
            }
            (Question::Unsaved { .. } | Question::Overwrite { .. }, Answer::Cancel) => {
                self.open.host.dialog.after_save = None
            }
            (Question::Conflict { tab, file, mine, disk, diff }, answer) => {
                // The text may have been edited since the question was asked.
                let mine_now = tab.as_ref().map_or_else(|| mine.to_string(), |t| self.text(t).to_owned());
                if let Err(why) = self.open.settle(tab.as_ref(), &file, &mine_now, &disk, answer) {
                    if let Some(why) = why {
                        self.open.notice(Level::Error, why);
                    }
                    self.open.host.dialog.questions.push_front(Question::Conflict { tab, file, mine, disk, diff });
                }
            }
            (Question::Recover(recovered), answer) => {
                if !self.answer_recover(&recovered, &answer) {
                    self.open.host.dialog.questions.push_front(Question::Recover(recovered));
                }
            }
            (question, _) => self.open.host.dialog.questions.push_front(question),
        }
    }
}

impl OpenProject {
    pub(super) fn ask(&mut self, question: Question) {
        self.host.dialog.questions.push_back(question);
        self.host.changed = true;
    }

    /// Returns whether the project's own files contain nothing that the user has not seen.
    fn may_overwrite(&mut self) -> bool {
        let is_asked = self.host.dialog.questions.iter().any(|q| matches!(q, Question::Conflict { .. }));
        let may = !is_asked && self.disk_is_as_read();
        if !may {
            self.host.dialog.after_save = None;
        }
        may
    }

    /// Reports where the files that a save has replaced are kept.
    pub(super) fn report_kept_files(&mut self, count: usize, kept: PathBuf) {
        let files =
            if count == 1 { "the file that was replaced is".into() } else { format!("the {count} replaced files are") };
        let time = self.host.options.recovery.as_ref().map(|_| format!(" for {KEPT_DAYS} days")).unwrap_or_default();
        let text = format!("{files} kept in {}{time}", kept.display());
        self.notice_with_path(About::Saving, Level::Info, text, kept);
    }

    /// Writes the edited texts alone. Returns false if there are none, or they cannot be written there.
    fn save_texts(&mut self, home: &Path) -> bool {
        let Some(project) = self.documents.edited_texts() else { return false };
        if project::save(&project, home, Overwrite::Refuse).is_err() {
            return false;
        }
        self.read_disk();
        self.compile.saved();
        true
    }

    fn request_save_as(&mut self) {
        let suggested_name = capture::file_stem(&self.project().name);
        self.host.dialog.requests.push_back(Request::SaveAs { suggested_name });
    }

    fn save_failed(&mut self, error: &ProjectError) {
        self.host.dialog.after_save = None;
        self.notice_about(About::Saving, Level::Error, format!("not saved: {error}; your changes are still open here"));
    }

    /// Resolves a conflict after writing the other text to a file of its own. Fails with a message, or silently for an
    /// answer that does not fit; then the question stays open.
    fn settle(
        &mut self,
        tab: Option<&Tab>,
        file: &Path,
        mine: &str,
        disk: &str,
        answer: Answer,
    ) -> Result<(), Option<String>> {
        let kept = match &answer {
            Answer::KeepMine => keep_beside(file, "disk", disk)?,
            Answer::TakeDisk => keep_beside(file, "mine", mine)?,
            Answer::SaveMineAs(path) => {
                let written = fs::File::create_new(path).and_then(|mut f| f.write_all(mine.as_bytes()));
                written.map_err(|e| format!("cannot write {}: {e}", path.display()))?;
                path.clone()
            }
            _ => return Err(None),
        };
        if answer != Answer::KeepMine {
            match tab {
                Some(tab) => self.documents.take_text_of_saved(tab),
                None => {
                    self.documents.take_structure_of_saved();
                    self.pass_history.clear();
                }
            }
            self.after_reload();
        }
        self.notice(Level::Info, format!("the other version is kept in {}", kept.display()));
        Ok(())
    }

    /// Keeps the warnings from loading the open project for the list of problems, without those that each compile
    /// repeats.
    pub(super) fn note_reading(&mut self, warnings: &[Diagnostic], sources: &SourceMap) {
        let mut project = self.documents.saved().clone();
        let mut again = project::advice(&project);
        again.extend(project::declare_channels(&mut project));
        let is_new = |d: &&Diagnostic| !again.iter().any(|other| other.repeats(d));
        let kept = warnings.iter().filter(is_new).map(|d| TabDiagnostic::new(d, sources, &project)).collect();
        self.compile.read = kept;
    }

    pub(super) fn report_diagnostics(&mut self, diagnostics: &[Diagnostic], sources: &SourceMap) {
        for d in diagnostics {
            self.notice(Level::Warning, eddy_diag::render(d, sources).trim_end());
        }
    }
}

/// Saves a project over the files that the user was shown, and over no other files that are not its own. Replaced files
/// are kept in the folder that is returned.
pub(super) fn save_over(
    project: &Project,
    target: &Path,
    shown: &[PathBuf],
    recovery: Option<&Path>,
) -> Result<(Project, Option<PathBuf>), ProjectError> {
    match project::save(project, target, Overwrite::Refuse) {
        Err(ProjectError::WouldOverwrite { paths }) if paths.iter().all(|path| shown.contains(path)) => {
            let kept = place_for_replaced(recovery, target);
            let saved = project::save(project, target, Overwrite::KeepIn(&kept))?;
            Ok((saved, Some(kept)))
        }
        other => other.map(|saved| (saved, None)),
    }
}

/// Returns whether a project saved to `target` keeps its origin.
fn is_same_place(origin: &Origin, target: &Path) -> bool {
    let (Origin::Folder { path, .. } | Origin::File(path) | Origin::Json(path)) = origin else { return false };
    let target = if target.ends_with("eddy.toml") { target.parent().unwrap_or(target) } else { target };
    matches!((path.canonicalize(), target.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// Writes a text to a new numbered file next to `file`; its extension keeps it from being loaded as a pass.
fn keep_beside(file: &Path, whose: &str, text: &str) -> Result<PathBuf, String> {
    let folder = file.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let numbered = |n: u32| format!("{name}.{whose}-{n:04}");
    capture::write_new(folder, numbered, &name, |out| out.write_all(text.as_bytes())).map_err(|e| e.to_string())
}
