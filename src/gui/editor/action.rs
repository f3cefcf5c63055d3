//! The actions of keys and the palette that apply to the code shown.

use super::motion::{Motion, Vertical};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum EditorAction {
    Go(Motion),
    Select(Motion),
    Delete(Motion),
    NewLine,
    /// Inserts a line above or below that of the caret, wherever in its line the caret is.
    OpenLine(Vertical),
    Indent,
    /// Indents whole lines, even for a caret that selects nothing.
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
    /// Indents all lines, and sets the blanks between tokens.
    Format,
    Fold,
    Unfold,
    FoldAll,
    UnfoldAll,
    Propose,
    Signature,
    Definition,
    Uses,
    /// Shows the fixes for the problem at the caret.
    QuickFix,
    Rename,
    Cut,
    Copy,
    Paste,
}

impl EditorAction {
    /// Returns whether the action requests help with the text, which keeps open popups open.
    pub(super) fn is_help(self) -> bool {
        matches!(self, Self::Propose | Self::Signature | Self::Definition | Self::Uses | Self::QuickFix | Self::Rename)
    }
}
