//! Translates events and actions into changes of a [`Buffer`].

use super::{action::EditorAction as Action, buffer::Buffer};
use egui::{Event, ImeEvent};

/// The effects of an event in addition to changes of the buffer.
#[derive(Debug, Default)]
pub(super) struct Handled {
    /// The caret moved or the text changed: scroll the caret into view.
    pub follow_caret: bool,
    /// The text for the clipboard.
    pub copied: Option<String>,
}

/// Feeds an event that is not a key to the buffer. `preedit` is the text that an input method is composing;
/// `is_comment` returns whether a byte is in a comment.
pub(super) fn handle(
    buffer: &mut Buffer,
    preedit: &mut String,
    event: &Event,
    is_comment: &dyn Fn(&Buffer, usize) -> bool,
) -> Handled {
    let mut handled = Handled::default();
    handled.follow_caret = match event {
        Event::Text(text) | Event::Ime(ImeEvent::Commit(text)) => {
            preedit.clear();
            let typed = !text.is_empty() && text != "\n" && text != "\r";
            if typed {
                buffer.type_closing(text, is_comment);
            }
            typed
        }
        Event::Ime(ImeEvent::Preedit { text, .. }) => {
            let used = *text != *preedit;
            preedit.clone_from(text);
            used
        }
        Event::Ime(ImeEvent::DeleteSurrounding { before_chars, after_chars }) => {
            let at = buffer.selection().head;
            let text = buffer.text();
            let start = text[..at].char_indices().rev().take(*before_chars).last().map_or(at, |(i, _)| i);
            let end = text[at..].char_indices().nth(*after_chars).map_or(text.len(), |(i, _)| at + i);
            buffer.replace(start..end, "", super::history::Kind::Other);
            true
        }
        Event::Paste(text) => {
            buffer.paste(text);
            true
        }
        Event::Copy => {
            handled.copied = Some(buffer.copied_text());
            false
        }
        Event::Cut => {
            handled.copied = Some(buffer.copied_text());
            buffer.cut();
            true
        }
        _ => false,
    };
    handled
}

/// Applies an action that only concerns a text. Returns false for an action of the window, and if there was nothing to
/// do.
pub(super) fn act(buffer: &mut Buffer, action: Action) -> bool {
    match action {
        Action::Go(motion) => buffer.go(motion, false),
        Action::Select(motion) => buffer.go(motion, true),
        Action::Delete(motion) => buffer.delete(motion),
        Action::NewLine => buffer.new_line(),
        Action::OpenLine(way) => buffer.open_line(way),
        Action::Indent => buffer.indent(),
        Action::IndentLines => buffer.indent_lines(),
        Action::Unindent => buffer.unindent(),
        Action::ToggleComment => buffer.toggle_comment(),
        Action::ToggleBlockComment => buffer.toggle_block_comment(),
        Action::MoveLines(way) => buffer.move_lines(way),
        Action::CopyLines(way) => buffer.copy_lines(way),
        Action::DeleteLines => buffer.delete_lines(),
        Action::SelectAll => buffer.select(0, buffer.text().len()),
        Action::SelectLine => {
            let line = buffer.whole_line(buffer.selection().range().start);
            buffer.select(line.start, line.end);
        }
        Action::AddNext => buffer.add_next(),
        Action::AddAll => buffer.add_all(),
        Action::AddCaret(way) => buffer.add_caret(way),
        Action::OneCaret => buffer.one_caret(),
        Action::Format => return buffer.format(),
        Action::Undo => return buffer.undo(),
        Action::Redo => return buffer.redo(),
        Action::OtherBracket
        | Action::Fold
        | Action::Unfold
        | Action::FoldAll
        | Action::UnfoldAll
        | Action::Propose
        | Action::Signature
        | Action::Definition
        | Action::Uses
        | Action::QuickFix
        | Action::Rename
        | Action::Cut
        | Action::Copy
        | Action::Paste => return false,
    }
    true
}
