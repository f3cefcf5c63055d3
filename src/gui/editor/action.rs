//! Owns what keys and the palette can ask of the code that is shown.

use super::motion::{Motion, Vertical};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum EditorAction {
    Go(Motion),
    Select(Motion),
    Delete(Motion),
    NewLine,
    /// A new line above or below that of the caret, wherever in it the caret is.
    OpenLine(Vertical),
    Indent,
    /// The whole lines, also of a caret that selects nothing.
    IndentLines,
    Unindent,
    ToggleComment,
    ToggleBlockComment,
    MoveLines(Vertical),
    CopyLines(Vertical),
    DeleteLines,
    SelectAll,
    SelectLine,
    AddNext,
    AddAll,
    AddCaret(Vertical),
    OneCaret,
    OtherBracket,
    Undo,
    Redo,
    Fold,
    Unfold,
    FoldAll,
    UnfoldAll,
    Propose,
    Signature,
    Definition,
    Uses,
    /// The mends for the problem at the caret.
    QuickFix,
    Rename,
    Cut,
    Copy,
    Paste,
}

impl EditorAction {
    /// Asks for help beside the text: what is open stays open.
    pub(super) fn is_help(self) -> bool {
        matches!(self, Self::Propose | Self::Signature | Self::Definition | Self::Uses | Self::QuickFix | Self::Rename)
    }
}
