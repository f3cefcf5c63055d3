//! Steps of undo and redo. Knows what was put where, not why.

use super::selection::Carets;
use std::ops::Range;

/// A replacement in a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Change {
    /// In the text before any of the changes that were made with it.
    pub at: usize,
    pub removed: String,
    pub inserted: String,
}

impl Change {
    pub fn range(&self) -> Range<usize> {
        self.at..self.at + self.removed.len()
    }
}

/// Replacements made at once, in the order of the text, with the carets on both sides of them.
#[derive(Clone, Debug)]
pub(super) struct Edit {
    pub changes: Vec<Change>,
    pub before: Carets,
    pub after: Carets,
}

impl Edit {
    /// Returns the changes that lead back.
    pub fn inverse(&self) -> Vec<Change> {
        let mut shift = 0isize;
        let back = |c: &Change| {
            let at = c.at.saturating_add_signed(shift);
            shift += c.inserted.len() as isize - c.removed.len() as isize;
            Change { at, removed: c.inserted.clone(), inserted: c.removed.clone() }
        };
        self.changes.iter().map(back).collect()
    }
}

/// The kind of an edit, which decides whether it joins the one before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A character typed: joins a word being typed.
    Typing,
    /// A character deleted: joins a run of deletions.
    Deleting,
    /// Anything else: a step of its own.
    Other,
}

#[derive(Clone, Debug, Default)]
pub(super) struct History {
    done: Vec<Vec<Edit>>,
    undone: Vec<Vec<Edit>>,
    /// Kind of the newest step while more may join it.
    open: Option<Kind>,
}

impl History {
    pub fn push(&mut self, edit: Edit, kind: Kind) {
        self.undone.clear();
        match self.done.last_mut() {
            Some(step) if self.open == Some(kind) && joins(step.last(), &edit, kind) => step.push(edit),
            _ => self.done.push(vec![edit]),
        }
        self.open = (kind != Kind::Other).then_some(kind);
    }

    /// The caret went elsewhere: what follows is a new step.
    pub fn seal(&mut self) {
        self.open = None;
    }

    /// Carets went on by what was typed, though the text was there already.
    pub fn go_on(&mut self, carets: &Carets) {
        if let Some(edit) = self.done.last_mut().and_then(|step| step.last_mut())
            && self.open == Some(Kind::Typing)
        {
            edit.after.clone_from(carets);
        }
    }

    pub fn undo(&mut self) -> Option<Vec<Edit>> {
        self.open = None;
        let step = self.done.pop()?;
        self.undone.push(step.clone());
        Some(step)
    }

    pub fn redo(&mut self) -> Option<Vec<Edit>> {
        self.open = None;
        let step = self.undone.pop()?;
        self.done.push(step.clone());
        Some(step)
    }
}

/// A word typed or a run deleted is one step; the first letter after a space begins the next.
fn joins(previous: Option<&Edit>, edit: &Edit, kind: Kind) -> bool {
    let Some(previous) = previous else { return false };
    match kind {
        Kind::Other => false,
        Kind::Deleting => edit.changes.iter().all(|c| !c.removed.contains('\n') && c.inserted.is_empty()),
        Kind::Typing => {
            let left = previous.after.list();
            let follows = |(c, before): (&Change, &Change)| {
                let begins_word =
                    before.inserted.ends_with(char::is_whitespace) && !c.inserted.starts_with(char::is_whitespace);
                c.removed.is_empty() && !c.inserted.contains('\n') && !begins_word
            };
            edit.changes.len() == left.len()
                && edit.changes.len() == previous.changes.len()
                && edit.changes.iter().zip(left).all(|(c, left)| c.at == left.head)
                && edit.changes.iter().zip(&previous.changes).all(follows)
        }
    }
}
