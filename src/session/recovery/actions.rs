//! Passes unsaved work to the recovery file, and restores that of an earlier session.

use super::{Left, News, Recovery};
use crate::{
    Session,
    command::{Answer, PendingAction, Question, Recovered},
    documents::Documents,
    open_project::OpenProject,
    view::{About, Level},
};
use eddy_background::Wake;
use eddy_project::Origin;
use std::{
    io,
    path::{Path, PathBuf},
};

/// Unsaved work and its recovery file.
#[derive(Default)]
pub(crate) struct UnsavedWork {
    /// `None`: this session stores no unsaved work.
    pub recovery: Option<Recovery>,
    /// The revision of the documents that was stored last.
    pub kept: Option<u64>,
    /// Unsaved work that was found, about which a question is open.
    pub found: Vec<Left>,
}

impl UnsavedWork {
    /// Starts looking for unsaved work at once.
    pub(crate) fn new(folder: Option<PathBuf>, wake: &Wake) -> io::Result<UnsavedWork> {
        let recovery = folder.map(|folder| Recovery::new(folder, wake.clone())).transpose()?;
        recovery.iter().for_each(Recovery::scan);
        Ok(UnsavedWork { recovery, ..UnsavedWork::default() })
    }
}

impl Session {
    /// Applies the answer about unsaved work; returns false for an answer that does not fit.
    pub(crate) fn answer_recover(&mut self, recovered: &Recovered, answer: &Answer) -> bool {
        match answer {
            Answer::Recover if self.is_dirty() => {
                let (then, tabs) = (PendingAction::Recover(recovered.file.clone()), self.open.documents.dirty_tabs());
                self.open.host.dialog.questions.push_front(Question::Unsaved { then, tabs });
            }
            Answer::Recover => self.recover(&recovered.file),
            Answer::Discard => {
                self.services.recovery.found.retain(|left| left.shown.file != recovered.file);
                if let Some(recovery) = &self.services.recovery.recovery {
                    recovery.discard(recovered.file.clone());
                }
            }
            Answer::Cancel => self.services.recovery.put_off(&recovered.file),
            _ => return false,
        }
        true
    }

    /// Replaces the open project by the work in a recovery file.
    pub(crate) fn recover(&mut self, file: &Path) {
        let Some(at) = self.services.recovery.found.iter().position(|left| left.shown.file == *file) else { return };
        let Left { shown, project, saved, .. } = self.services.recovery.found.remove(at);
        self.replace(Documents::restored(project, saved));
        // The project may have ended the last process and may do it again, so start paused.
        self.open.playback.clock.pause();
        if let Some(recovery) = &self.services.recovery.recovery {
            recovery.adopt(shown.file);
        }
        self.open.compile.include_edits += 1;
        let placeless = shown.trouble.map(|why| format!(" Its original location is gone: {why}")).unwrap_or_default();
        self.open.notice(Level::Info, format!("recovered {}: paused and not saved yet.{placeless}", shown.name));
        self.services.recovery.put_off_all(&mut self.open);
    }
}

impl UnsavedWork {
    /// Passes unsaved work to the thread that writes it, if it has changed. Never blocks.
    pub(crate) fn keep_unsaved(&mut self, open: &mut OpenProject) {
        let Some(recovery) = &self.recovery else { return };
        let revision = Some(open.documents.revision());
        if self.kept == revision {
            return;
        }
        self.kept = revision;
        if open.documents.is_dirty() {
            recovery.keep(open.documents.current());
        } else {
            recovery.forget();
        }
    }

    /// Removes the recovery file: the unsaved work is discarded on purpose, or stored elsewhere.
    pub(crate) fn forget_unsaved(&self) {
        self.recovery.iter().for_each(Recovery::forget);
    }

    /// Asks about unsaved work that was found.
    pub(crate) fn take_found_work(&mut self, open: &mut OpenProject) {
        while let Some(news) = self.recovery.as_ref().and_then(Recovery::take_news) {
            match news {
                News::Trouble(text) => open.notice_about(About::Window, Level::Warning, text),
                News::Found(found) => {
                    let here = place(&open.project().origin);
                    let is_here = |left: &Left| here.is_some() && place(&left.shown.origin) == here;
                    let (first, rest): (Vec<Left>, Vec<Left>) = found.into_iter().partition(is_here);
                    for left in first.into_iter().chain(rest) {
                        open.ask(Question::Recover(Box::new(left.shown.clone())));
                        self.found.push(left);
                    }
                }
            }
        }
    }

    /// Postpones all other unsaved work, which would replace what was just recovered.
    fn put_off_all(&mut self, open: &mut OpenProject) {
        let others: Vec<PathBuf> = self.found.iter().map(|left| left.shown.file.clone()).collect();
        let some = match others.len() {
            0 => return,
            1 => "there is unsaved work of another project too".to_owned(),
            n => format!("there is unsaved work of {n} other projects too"),
        };
        open.notice(Level::Info, format!("{some}; Eddy asks about it at the next start"));
        others.iter().for_each(|file| self.put_off(file));
        open.host.dialog.questions.retain(|q| !matches!(q, Question::Recover(_)));
    }

    fn put_off(&mut self, file: &Path) {
        self.found.retain(|left| left.shown.file != *file);
        if let Some(recovery) = &self.recovery {
            recovery.put_off(file.to_owned());
        }
    }
}

/// Returns the normalised path of a project; `None` for one that is not stored in files.
fn place(origin: &Origin) -> Option<PathBuf> {
    match origin {
        Origin::Unsaved => None,
        Origin::Preset(name) => Some(PathBuf::from(name)),
        Origin::Folder { path, .. } | Origin::File(path) | Origin::Json(path) => {
            Some(path.canonicalize().unwrap_or_else(|_| path.clone()))
        }
    }
}
