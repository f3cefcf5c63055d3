//! Folds blocks of the text, and unfolds them where the caret goes.

use super::{action::EditorAction, brackets, motion::Motion, selection::Selection, view::CodeEditor};

impl CodeEditor {
    /// Applies an action that concerns rows. Returns false for any other action.
    pub(super) fn act_on_rows(&mut self, action: EditorAction) -> bool {
        let line = self.buffer.line_of(self.buffer.selection().head);
        match action {
            EditorAction::Fold => {
                let block = match self.rows.fold(&self.buffer, &self.highlight, line) {
                    true => Some(line),
                    false => brackets::block_around(&self.highlight, line),
                };
                if let Some(line) = block {
                    self.rows.fold(&self.buffer, &self.highlight, line);
                }
            }
            EditorAction::Unfold => self.rows.unfold(&self.buffer, &self.highlight, line),
            EditorAction::FoldAll => self.rows.fold_all(&self.buffer, &self.highlight),
            EditorAction::UnfoldAll => self.rows.unfold_all(&self.buffer, &self.highlight),
            EditorAction::Go(Motion::Lines(by)) if !self.rows.is_plain() => self.go_rows(by, false),
            EditorAction::Select(Motion::Lines(by)) if !self.rows.is_plain() => self.go_rows(by, true),
            EditorAction::Go(Motion::Pages(by)) => self.go_rows(by * self.page as isize, false),
            EditorAction::Select(Motion::Pages(by)) => self.go_rows(by * self.page as isize, true),
            _ => return false,
        }
        if matches!(action, EditorAction::Fold | EditorAction::FoldAll) {
            self.leave_folds();
        }
        true
    }

    fn go_rows(&mut self, by: isize, selecting: bool) {
        let Self { buffer, highlight, rows, .. } = self;
        buffer.go_to(selecting, |buffer, s| rows.moved_by_rows(buffer, highlight, s, by));
    }

    /// Folds or unfolds the block that a line opens.
    pub(super) fn toggle_fold(&mut self, line: usize) {
        if self.rows.is_folded(line) {
            self.rows.unfold(&self.buffer, &self.highlight, line);
        } else {
            self.rows.fold(&self.buffer, &self.highlight, line);
            self.leave_folds();
        }
    }

    /// Moves carets inside a fold to the end of the line that opens the block.
    fn leave_folds(&mut self) {
        let hides = |at: usize| self.rows.is_hidden(self.buffer.line_of(at));
        if !self.buffer.carets().list().iter().any(|s| hides(s.head)) {
            return;
        }
        let carets = self.buffer.carets().map(|s| {
            let mut line = self.buffer.line_of(s.head);
            if !self.rows.is_hidden(line) {
                return s;
            }
            while line > 0 && self.rows.is_hidden(line) {
                line -= 1;
            }
            Selection::caret(self.buffer.line_range(line).end)
        });
        self.buffer.set_carets(carets);
    }

    /// Unfolds the blocks that hide a caret.
    pub(super) fn reveal_carets(&mut self) {
        if self.rows.is_plain() {
            return;
        }
        for s in self.buffer.carets().list().to_vec() {
            let line = self.buffer.line_of(s.head);
            self.rows.reveal(&self.buffer, &self.highlight, line);
        }
    }
}
