//! Handles input from outside the window: dropped and pasted files, pasted text and the clipboard.

use super::{Shell, pasted_files};
use crate::{
    gui::ui_output::UiOutput,
    session::{FileCommand, Session},
};
use egui::Ui;
use std::path::PathBuf;

/// Requests for the clipboard's contents, which arrive as a paste event.
#[derive(Default)]
pub(super) struct ClipboardRequests {
    /// They were requested and are handled as if they had been pasted into the window.
    pub is_wanted: bool,
    takes_paste: bool,
    /// The code editor requested them.
    pub is_wanted_by_code: bool,
    pastes_into_code: bool,
}

/// The contents of the clipboard that are requested.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wanted {
    Text,
    /// Files that were copied in a file manager, as [`addresses`](super::addresses), or else text.
    FilesOrText,
}

impl Shell {
    /// Returns a request for the clipboard's contents once. They then arrive as a paste event.
    pub(crate) fn take_clipboard_request(&mut self) -> Option<Wanted> {
        let wants = std::mem::take(&mut self.clipboard.is_wanted);
        self.clipboard.takes_paste |= wants;
        let pastes = std::mem::take(&mut self.clipboard.is_wanted_by_code);
        self.clipboard.pastes_into_code |= pastes;
        match (wants, pastes) {
            (true, _) => Some(Wanted::FilesOrText),
            (false, true) => Some(Wanted::Text),
            (false, false) => None,
        }
    }

    /// Returns whether a text field or the code has the keyboard: pasted text goes there.
    pub(crate) fn is_typing(&self, ctx: &egui::Context) -> bool {
        ctx.text_edit_focused() || self.code.has_keys(ctx) || self.overlays.palette.is_open()
    }

    /// Takes dropped files, and text that is pasted while no text field has the focus.
    pub(super) fn take_imports(&mut self, ui: &Ui, session: &Session, out: &mut UiOutput) {
        if std::mem::replace(&mut self.opened, session.opened()) != session.opened() && self.modes.gallery {
            self.close_gallery(out);
        }
        let (files, at) = ui.input(|i| (i.raw.dropped_files.clone(), i.pointer.latest_pos()));
        if !files.is_empty() {
            let channel = at.and_then(|at| self.channel_at(at));
            self.open_files(files.iter().map(|file| file.path().to_owned()).collect(), channel, out);
        }
        if self.is_typing(ui.ctx()) && !self.clipboard.takes_paste && !self.clipboard.pastes_into_code {
            return;
        }
        let mut pasted = None;
        ui.input_mut(|i| {
            i.events.retain(|event| match event {
                egui::Event::Paste(text) => {
                    pasted = Some(text.clone());
                    false
                }
                _ => true,
            });
        });
        if let Some(text) = pasted {
            if std::mem::take(&mut self.clipboard.pastes_into_code) && !self.clipboard.takes_paste {
                return self.code.paste(text);
            }
            self.clipboard.takes_paste = false;
            match pasted_files::files_of(&text) {
                Some(files) => self.open_files(files, None, out),
                None => out.ask(FileCommand::Paste(text)),
            }
        }
    }

    /// Opens files: projects are opened, pictures and models go to the selected pass.
    pub(super) fn open_files(&self, paths: Vec<PathBuf>, channel: Option<usize>, out: &mut UiOutput) {
        let pass = self.code.current().pass().cloned().unwrap_or_default();
        // No pass is selected while the gallery covers it.
        let to = (!self.modes.gallery).then_some((pass, channel));
        out.ask(FileCommand::Bring { paths, to });
    }

    /// Returns the channel whose card is at a point.
    fn channel_at(&self, at: egui::Pos2) -> Option<usize> {
        (0..4).find(|i| self.places.places.get(&format!("channel:{i}")).is_some_and(|r| r.contains(at)))
    }
}
