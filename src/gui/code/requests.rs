//! Handles the editor's requests that concern other texts, and owns the quick fixes at its caret.

use super::{
    CodePanel,
    fixes::{Fixes, FixesAction},
    rename_bar::RenameBar,
};
use crate::{
    gui::{
        editor::EditorRequest,
        ui_output::{ShellCommand, UiOutput},
        uses::Uses,
    },
    project::Tab,
    session::{Level, Session},
};
use egui::Ui;

impl CodePanel {
    /// Handles a request of the editor that concerns other texts.
    pub(super) fn answer(&mut self, session: &Session, request: EditorRequest, out: &mut UiOutput) {
        let tab = self.current.clone();
        let of_tab = session.analysis().filter(|a| a.front == tab).and_then(|a| Some((a, a.source_of(&tab)?)));
        match (request, of_tab) {
            (EditorRequest::OpenIncluded(at), _) => {
                if let Some(tab) = session.project().included_at(&tab, at) {
                    self.bring(tab);
                    self.focus();
                }
            }
            (EditorRequest::GoTo(span), Some((analysis, _))) => {
                if let Some(tab) = analysis.tab_of(span.source) {
                    self.show_range(tab, span.range());
                }
            }
            (EditorRequest::ListUses(at), Some((analysis, source))) => {
                self.uses = Uses::new(|tab| Some(session.text(tab)), session.uses(analysis, source, at));
            }
            (EditorRequest::Fix(at), _) => {
                let line = self.buffer().map_or(0, |buffer| buffer.line_of(at));
                self.fixes = self.fixed_at().map(|now| Fixes::new(session, now, line));
            }
            (EditorRequest::Rename(at), _) => match RenameBar::new(session, tab, at) {
                Ok(bar) => {
                    self.rename = Some(bar);
                    self.go_to_line = None;
                    self.find.close();
                }
                Err(text) => out.notify(Level::Info, text),
            },
            (EditorRequest::Paste, _) => out.shell_commands.push(ShellCommand::PasteCode),
            (EditorRequest::GoTo(_) | EditorRequest::ListUses(_), None) => {}
        }
    }

    /// Returns the caret for a list of fixes.
    pub(super) fn fixed_at(&self) -> Option<(Tab, usize, u64)> {
        let buffer = self.buffer()?;
        Some((self.current.clone(), buffer.selection().head, buffer.revision()))
    }

    pub(super) fn choose_fix(&mut self, chosen: FixesAction, out: &mut UiOutput) {
        match chosen {
            FixesAction::Nothing => return,
            FixesAction::Closed => {}
            FixesAction::Fix(fix) => out.shell_commands.push(ShellCommand::Fix(fix)),
        }
        self.fixes = None;
    }

    pub(super) fn has_focus(ui: &Ui, tab: &Tab) -> bool {
        ui.memory(|m| m.has_focus(Self::id(tab)))
    }
}
