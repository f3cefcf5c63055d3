//! What keys and the palette can ask of the code that is shown.

use super::motion::{Motion, Way};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EditorAction {
    Go(Motion),
    Select(Motion),
    Delete(Motion),
    NewLine,
    Indent,
    Unindent,
    ToggleComment,
    MoveLines(Way),
    CopyLines(Way),
    DeleteLines,
    SelectAll,
    SelectLine,
    AddNext,
    AddAll,
    AddCaret(Way),
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
}

impl EditorAction {
    /// Asks for help beside the text: what is open stays open.
    pub(super) fn is_help(self) -> bool {
        matches!(self, Self::Propose | Self::Signature | Self::Definition | Self::Uses)
    }
}
