//! Edits of passes and channels, and their undo.
//!
//! Undo restores the passes, channels and groups; text typed since then stays, also in a pass that has been renamed
//! since. The history is cleared when another project is opened or the disk's passes are taken.

use super::{
    documents::Documents,
    open_project::OpenProject,
    pass_history::{PassStep, Step, UndoState},
    template,
    view::{About, Level},
};
use eddy_project::{PassEdit, PassName, Project, Tab};
use std::time::Instant;

impl OpenProject {
    /// The edit that [`EditCommand::RedoPassEdit`](super::EditCommand::RedoPassEdit) redoes.
    pub(crate) fn pass_redo(&self) -> Option<PassStep<'_>> {
        self.pass_history.redo.last().map(Step::shown)
    }

    pub(crate) fn pass_undo(&self) -> Option<PassStep<'_>> {
        self.pass_history.undo.last().map(Step::shown)
    }

    pub(super) fn edit_passes(&mut self, edit: PassEdit) {
        self.dismiss_notices(About::PassEdit);
        let before = self.project().clone();
        let is_untouched = match &edit {
            PassEdit::Remove(tab) => before.source(tab).is_none_or(|s| is_untouched(&s.text, tab)),
            _ => true,
        };
        let done = match self.documents.current_mut().edit_passes(&edit) {
            Ok(done) => done,
            Err(e) => return self.notice_about(About::PassEdit, Level::Warning, e.to_string()),
        };
        if !done.is_changed {
            return;
        }
        if let Some((from, to)) = &done.renamed {
            self.follow_rename(from, to);
        }
        let said = match &edit {
            PassEdit::Remove(tab) if !is_untouched => Some(format!("{} was removed", tab.title())),
            _ => None,
        };
        self.pass_history.push(edit.title(), before, done.renamed, Some(edit), Instant::now());
        if let Some(said) = said {
            self.notice_with_undo(said);
        }
        self.passes_changed();
    }

    /// Adds Common or a pass with a starting text, if it does not exist.
    pub(super) fn add_tab(&mut self, tab: &Tab) {
        let before = self.project().clone();
        if template::add(self.documents.current_mut(), tab) {
            self.pass_history.push(format!("add {}", tab.title()), before, None, None, Instant::now());
            self.passes_changed();
        }
    }

    /// Records an edit whose undo restores `before`.
    pub(super) fn note_pass_edit(&mut self, title: String, before: Project) {
        self.pass_history.push(title, before, None, None, Instant::now());
    }

    /// Shows a notice about a change that the newest undo step reverts.
    pub(super) fn notice_with_undo(&mut self, text: String) {
        let serial = self.pass_undo().map(|step| step.serial);
        self.notice(Level::Info, text);
        if let Some(notice) = self.host.notices.last_mut() {
            notice.undoes = serial;
        }
    }

    pub(super) fn undo_pass_edit(&mut self) {
        if let Some(step) = self.pass_history.undo.pop() {
            let back = self.take_step(step);
            self.pass_history.redo.push(back);
        }
    }

    pub(super) fn redo_pass_edit(&mut self) {
        if let Some(step) = self.pass_history.redo.pop() {
            let back = self.take_step(step);
            self.pass_history.undo.push(back);
        }
    }

    /// Restores the other side of a step. Returns the step back.
    fn take_step(&mut self, step: Step) -> Step {
        let project = match step.side {
            UndoState::Passes(project) => *project,
            UndoState::Uniforms(values, name) => {
                let here = std::mem::replace(&mut self.documents.current_mut().custom_uniform_values, values);
                self.custom_uniforms_changed();
                self.host.changed = true;
                let (serial, title, renamed) = (step.serial, step.title, None);
                return Step { serial, title, side: UndoState::Uniforms(here, name), renamed, edit: None, at: None };
            }
        };
        let here = self.project().clone();
        let there = step.renamed.as_ref().map(|(there, here)| (there.clone(), here.clone()));
        let next = returned(&self.documents, project, there.as_ref());
        *self.documents.current_mut() = next;
        if let Some((there, here)) = &there {
            self.follow_rename(here, there);
        }
        self.passes_changed();
        let renamed = there.map(|(there, here)| (here, there));
        let (serial, title) = (step.serial, step.title);
        Step { serial, title, side: UndoState::Passes(Box::new(here)), renamed, edit: None, at: None }
    }

    /// Updates everything that refers to a pass by its name.
    fn follow_rename(&mut self, from: &PassName, to: &PassName) {
        self.host.renamed_passes.push((from.clone(), to.clone()));
        if self.picture.shown == *from {
            self.picture.shown = to.clone();
        }
    }

    pub(super) fn passes_changed(&mut self) {
        self.compile.include_edits += 1;
        self.host.text_generation += 1;
        self.show_image_if_gone();
        self.compile_soon();
        self.host.changed = true;
    }

    /// Shows Image if the shown pass no longer exists.
    pub(super) fn show_image_if_gone(&mut self) {
        if self.project().pass(&self.picture.shown).is_none() {
            self.picture.shown = PassName::image();
        }
    }
}

/// Returns whether a text was not written by the user.
fn is_untouched(text: &str, tab: &Tab) -> bool {
    text.trim().is_empty() || text == template::text(tab)
}

/// Returns the passes of `there` with the text typed since. `renamed`: a pass's name there, and here.
fn returned(documents: &Documents, mut there: Project, renamed: Option<&(PassName, PassName)>) -> Project {
    let (here, saved) = (documents.current(), documents.saved());
    for tab in there.tabs() {
        let tab_here = match renamed {
            Some((there, here)) if tab.pass() == Some(there) => tab.of_pass(here.clone()),
            _ => tab.clone(),
        };
        let Some(source) = there.source_mut(&tab) else { continue };
        if let Some(now) = here.source(&tab_here) {
            // Its place is known here: it may have been saved since.
            source.clone_from(now);
            if let (Some(there), Some(here)) = (tab.pass(), tab_here.pass())
                && there != here
            {
                source.follow_rename(here, there);
            }
        } else if let Some(on_disk) = saved.source(&tab) {
            (source.name, source.path) = (on_disk.name.clone(), on_disk.path.clone());
        } else {
            source.path = None;
        }
    }
    Project {
        name: here.name.clone(),
        info: here.info.clone(),
        custom_uniform_values: here.custom_uniform_values.clone(),
        controls: here.controls.clone(),
        includes: here.includes.clone(),
        origin: here.origin.clone(),
        ..there
    }
}
