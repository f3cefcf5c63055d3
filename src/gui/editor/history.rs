//! Steps of undo and redo. Knows what was put where, not why.

use super::selection::Selection;

/// One replacement, with the selection on both sides of it.
#[derive(Clone, Debug)]
pub(super) struct Change {
    pub at: usize,
    pub removed: String,
    pub inserted: String,
    pub before: Selection,
    pub after: Selection,
}

/// The kind of a change, which decides whether it joins the one before.
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
    done: Vec<Vec<Change>>,
    undone: Vec<Vec<Change>>,
    /// Kind of the newest step while more may join it.
    open: Option<Kind>,
    /// Changes of a group being made.
    group: Option<Vec<Change>>,
}

impl History {
    pub fn push(&mut self, change: Change, kind: Kind) {
        self.undone.clear();
        if let Some(group) = &mut self.group {
            group.push(change);
            return;
        }
        match self.done.last_mut() {
            Some(step) if self.open == Some(kind) && joins(step.last(), &change, kind) => step.push(change),
            _ => self.done.push(vec![change]),
        }
        self.open = (kind != Kind::Other).then_some(kind);
    }

    /// The caret went elsewhere: what follows is a new step.
    pub fn seal(&mut self) {
        self.open = None;
    }

    pub fn begin_group(&mut self) {
        self.group.get_or_insert_default();
    }

    pub fn end_group(&mut self) {
        if let Some(step) = self.group.take().filter(|s| !s.is_empty()) {
            self.done.push(step);
        }
        self.open = None;
    }

    pub fn undo(&mut self) -> Option<Vec<Change>> {
        self.open = None;
        let step = self.done.pop()?;
        self.undone.push(step.clone());
        Some(step)
    }

    pub fn redo(&mut self) -> Option<Vec<Change>> {
        self.open = None;
        let step = self.undone.pop()?;
        self.done.push(step.clone());
        Some(step)
    }
}

/// A word typed or a run deleted is one step; the first letter after a space begins the next.
fn joins(previous: Option<&Change>, change: &Change, kind: Kind) -> bool {
    let Some(previous) = previous else { return false };
    match kind {
        Kind::Other => false,
        Kind::Deleting => !change.removed.contains('\n') && change.inserted.is_empty(),
        Kind::Typing => {
            let begins_word =
                previous.inserted.ends_with(char::is_whitespace) && !change.inserted.starts_with(char::is_whitespace);
            change.removed.is_empty()
                && change.at == previous.at + previous.inserted.len()
                && !change.inserted.contains('\n')
                && !begins_word
        }
    }
}
