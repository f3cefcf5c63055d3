//! Help while writing: completion at the caret, the signature of the enclosing call, what the name under the pointer
//! is, and where it is declared and used.
//!
//! Owns the open popups and decides which keys go to them. Their contents come from an [`Analysis`], which lags the
//! text for a moment after each change: until it catches up, open popups stay and no new ones open.

mod completion;
mod draw;
mod tips;

use super::{buffer::Buffer, history, lines::Lines, look::Help};
use crate::{
    diag::Span,
    glsl::services::{CompletionKind, SignatureHelp},
};
use completion::Popup;
use egui::{Event, Key, Rect, Ui};
use std::ops::Range;

/// A request of the editor that concerns other tabs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum EditorRequest {
    /// Go to a place in any text of the analysis.
    GoTo(Span),
    /// Open the file that the `#include` line at this byte names.
    OpenIncluded(usize),
    /// List all uses of the name at this byte.
    ListUses(usize),
    /// Show the fixes for the problem at this byte.
    Fix(usize),
    /// Rename what is named at this byte.
    Rename(usize),
    /// Replace the selection with the clipboard's text.
    Paste,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Question {
    Definition,
    Uses,
}

#[derive(Debug, Default)]
pub(super) struct Assist {
    popup: Option<Popup>,
    /// Completions are requested as soon as the analysis matches the text; `true`: by Ctrl+Space.
    wanted: Option<bool>,
    /// The start of the word for which Escape closed the popup.
    dismissed: Option<usize>,
    signature: Option<SignatureHelp>,
    signature_is_on: bool,
    hover: tips::Pointer,
    /// Uses of the name at the caret, with the revision and the caret for which they were found.
    uses: Vec<Range<usize>>,
    uses_of: Option<(u64, usize)>,
    /// A completion was clicked.
    is_chosen: bool,
    /// The request about the name at the caret that waits for the analysis.
    question: Option<Question>,
    pub requests: Vec<EditorRequest>,
    /// The names and areas of open popups.
    pub placed: Vec<(String, Rect)>,
}

impl Assist {
    /// Handles an event if it is for an open popup; otherwise the editor gets it.
    pub(super) fn take(&mut self, event: &Event, buffer: &mut Buffer) -> bool {
        let Event::Key { key, pressed: true, modifiers: m, .. } = *event else { return false };
        self.hover.close();
        self.question = None;
        let plain = m.is_none();
        if let Some(popup) = &mut self.popup {
            let step = match key {
                Key::ArrowDown if plain => Some(1),
                Key::ArrowUp if plain => Some(-1),
                Key::PageDown if plain => Some(completion::ROWS as isize),
                Key::PageUp if plain => Some(-(completion::ROWS as isize)),
                _ => None,
            };
            if let Some(step) = step {
                popup.step(step);
                return true;
            }
            let accepts = key == Key::Tab || (key == Key::Enter && popup.enter_accepts(buffer));
            if plain && accepts {
                self.accept(buffer);
                return true;
            }
            if key == Key::Escape {
                self.dismissed = Some(popup.start());
                self.close();
                return true;
            }
        }
        let closes = key == Key::Escape && self.signature.is_some();
        if closes {
            self.close_signature();
        }
        closes
    }

    /// Opens the completion list, even if nothing is typed yet.
    pub(super) fn propose(&mut self) {
        self.wanted = Some(true);
        self.dismissed = None;
    }

    /// Shows the signature of the call around the caret.
    pub(super) fn show_signature(&mut self) {
        self.signature_is_on = true;
    }

    /// Lists the uses of the name at the caret as soon as they are known.
    pub(super) fn list_uses(&mut self) {
        self.question = Some(Question::Uses);
    }

    /// Opens, updates or closes popups after the editor has handled an event.
    pub(super) fn after(&mut self, event: &Event, buffer: &Buffer) {
        match event {
            Event::Text(text) => self.typed(text, buffer),
            Event::Key { key: Key::Backspace | Key::Delete, pressed: true, .. } => {
                self.wanted = None;
                self.dismissed = None;
                self.go_on(buffer);
            }
            Event::Key { key: Key::Enter, pressed: true, .. } => {
                self.close();
                self.close_signature();
            }
            // A letter's key comes with its text; any other key moves the caret or changes the text elsewhere.
            Event::Key { key, pressed: true, modifiers, .. } => {
                let is_typing = !modifiers.command && !modifiers.alt && key.name().chars().count() == 1;
                if !is_typing {
                    self.close();
                }
            }
            Event::Paste(_) | Event::Cut => self.close(),
            _ => {}
        }
    }

    fn typed(&mut self, text: &str, buffer: &Buffer) {
        self.hover.close();
        let word = buffer.word_before_caret();
        if self.dismissed.is_some_and(|start| start != word.start) {
            self.dismissed = None;
        }
        let continues = text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if continues {
            self.go_on(buffer);
            let starts_word = buffer.text()[word.clone()].starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
            if self.popup.is_none() && word.len() >= 2 && starts_word && self.dismissed.is_none() {
                self.wanted = Some(false);
            }
            return;
        }
        self.close();
        match text {
            "." => self.wanted = Some(false),
            "(" | "," => self.signature_is_on = true,
            _ => {}
        }
    }

    /// Updates an open popup after the word before the caret has changed.
    fn go_on(&mut self, buffer: &Buffer) {
        if self.popup.as_mut().is_some_and(|popup| !popup.filter(buffer)) {
            self.popup = None;
        }
    }

    pub(super) fn close(&mut self) {
        self.popup = None;
        self.wanted = None;
    }

    fn close_signature(&mut self) {
        self.signature = None;
        self.signature_is_on = false;
    }

    /// Closes everything: the keyboard focus or the text has moved elsewhere.
    pub(super) fn close_all(&mut self) {
        self.close();
        self.close_signature();
        self.hover.close();
        self.question = None;
    }

    /// Inserts the selected item. A function gets its parentheses, and the caret between them if it has parameters.
    fn accept(&mut self, buffer: &mut Buffer) {
        let Some((range, item)) = self.popup.as_ref().and_then(|popup| popup.choice(buffer)) else { return };
        let is_function = matches!(item.kind, CompletionKind::Function | CompletionKind::Builtin);
        if is_function && !buffer.text()[range.end..].starts_with('(') {
            let has_parameters = !item.detail.contains("()");
            buffer.replace_by_call(range, &item.label, has_parameters);
            self.signature_is_on |= has_parameters;
        } else {
            buffer.replace(range, &item.label, history::Kind::Other);
        }
        self.close();
    }

    /// Goes to the definition of the name at the caret as soon as it is known.
    pub(super) fn go_to_definition(&mut self) {
        self.question = Some(Question::Definition);
    }

    /// Opens what was requested if `help` matches the text. Called once a frame.
    pub(super) fn update(&mut self, buffer: &Buffer, help: Option<Help<'_>>) {
        let Some(help) = help else {
            self.uses_of = None;
            self.uses.clear();
            return;
        };
        let caret = buffer.selection().head;
        match self.question.take() {
            Some(Question::Definition) => {
                let declared = help.analysis.definition(help.source, caret).map(EditorRequest::GoTo);
                let included = buffer.names_file(caret).then_some(EditorRequest::OpenIncluded(caret));
                self.requests.extend(declared.or(included));
            }
            Some(Question::Uses) => self.requests.push(EditorRequest::ListUses(caret)),
            None => {}
        }
        if let Some(asked_for) = self.wanted.take() {
            self.popup = Popup::open(help.analysis.completions(help.source, caret), buffer, asked_for);
        }
        if self.signature_is_on {
            self.signature = help.analysis.signature_help(help.source, caret);
            self.signature_is_on = self.signature.is_some();
        }
        let now = (buffer.revision(), caret);
        if self.uses_of != Some(now) {
            self.uses_of = Some(now);
            let same = buffer.selection().is_empty();
            let found = if same { help.analysis.uses(help.source, caret) } else { Vec::new() };
            self.uses = found.iter().filter(|s| s.source == help.source).map(|s| s.range()).collect();
            self.uses.sort_by_key(|r| r.start);
        }
    }

    /// Returns whether the completion list is open.
    pub(super) fn is_open(&self) -> bool {
        self.popup.is_some()
    }

    /// Returns the uses of the name at the caret in this text.
    pub(super) fn uses(&self) -> &[Range<usize>] {
        &self.uses
    }

    /// Inserts the completion that was clicked in the previous frame: the text must not change while lines are shown.
    pub(super) fn take_chosen(&mut self, buffer: &mut Buffer) {
        if std::mem::take(&mut self.is_chosen) {
            self.accept(buffer);
        }
    }

    /// Shows the open popups.
    pub(super) fn show(&mut self, ui: &Ui, lines: &Lines<'_>, buffer: &Buffer, shown: Rect) {
        let caret = lines.caret_rect(buffer);
        let is_in_sight = shown.intersects(caret);
        if let Some(popup) = self.popup.as_mut().filter(|_| is_in_sight) {
            let at = lines.rect_of(buffer, popup.start());
            if popup.show(ui, at, &lines.font, &mut self.placed) {
                self.is_chosen = true;
                ui.ctx().request_repaint();
            }
        }
        if let Some(signature) = self.signature.as_ref().filter(|_| is_in_sight) {
            let start = buffer.snap(signature.name_start);
            let same_line = buffer.line_of(start) == buffer.line_of(buffer.selection().head);
            let at = if same_line { lines.rect_of(buffer, start) } else { caret };
            tips::signature(ui, signature, at, &lines.font, &mut self.placed);
        }
    }

    /// Shows what the name under the pointer is, once the pointer rests. Returns true if the tooltip is below its
    /// line.
    pub(super) fn show_hover(
        &mut self,
        ui: &Ui,
        lines: &Lines<'_>,
        buffer: &Buffer,
        help: Option<Help<'_>>,
        shown: Rect,
    ) -> bool {
        if self.popup.is_some() {
            self.hover.close();
            return false;
        }
        self.hover.show(ui, lines, buffer, help, shown, &mut self.placed)
    }
}

#[cfg(test)]
mod tests;
