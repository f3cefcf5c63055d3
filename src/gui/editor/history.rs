//! The undo history. Stores which text was replaced where, not why.

use super::selection::{Carets, Selection};
use std::{collections::VecDeque, ops::Range};

/// The limit on stored bytes; the oldest steps are dropped first. Hours of typing use a thousandth of it.
const MAX_BYTES: usize = 64 << 20;

/// A replacement in a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Change {
    /// A position in the text before any of the changes of its edit.
    pub at: usize,
    pub removed: String,
    pub inserted: String,
}

impl Change {
    pub(super) fn range(&self) -> Range<usize> {
        self.at..self.at + self.removed.len()
    }
}

/// Replacements made at once, in the order of the text, with the carets before and after.
#[derive(Clone, Debug)]
pub(super) struct Edit {
    pub changes: Vec<Change>,
    pub before: Carets,
    pub after: Carets,
}

impl Edit {
    /// Returns the number of bytes that it stores.
    fn size(&self) -> usize {
        let text = |c: &Change| c.removed.len() + c.inserted.len() + size_of::<Change>();
        let carets = self.before.list().len() + self.after.list().len();
        self.changes.iter().map(text).sum::<usize>() + carets * size_of::<Selection>() + size_of::<Edit>()
    }

    /// Returns the changes that undo it.
    pub(super) fn inverse(&self) -> Vec<Change> {
        let mut shift = 0isize;
        let back = |c: &Change| {
            let at = c.at.saturating_add_signed(shift);
            shift += c.inserted.len() as isize - c.removed.len() as isize;
            Change { at, removed: c.inserted.clone(), inserted: c.removed.clone() }
        };
        self.changes.iter().map(back).collect()
    }
}

/// The kind of an edit, which decides whether it joins the previous one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A character typed: joins a word being typed.
    Typing,
    /// A character deleted: joins a run of deletions.
    Deleting,
    /// Anything else: a step of its own.
    Other,
}

/// The edits that are undone together.
#[derive(Clone, Debug)]
pub(super) struct Step {
    /// Different for each step of a text.
    pub id: u64,
    pub edits: Vec<Edit>,
}

#[derive(Clone, Debug, Default)]
pub(super) struct History {
    done: VecDeque<Step>,
    /// The bytes of done steps; undone steps were counted when they were done.
    size: usize,
    undone: Vec<Step>,
    /// The number of steps so far.
    steps: u64,
    /// The kind of the newest step while more edits may join it.
    open: Option<Kind>,
}

impl History {
    pub(super) fn push(&mut self, edit: Edit, kind: Kind) {
        self.undone.clear();
        self.size += edit.size();
        match self.done.back_mut() {
            Some(step) if self.open == Some(kind) && can_merge(step.edits.last(), &edit, kind) => {
                step.edits.push(edit);
            }
            _ => {
                self.steps += 1;
                self.done.push_back(Step { id: self.steps, edits: vec![edit] });
            }
        }
        while self.size > MAX_BYTES && self.done.len() > 1 {
            self.size -= self.done.pop_front().map_or(0, |step| size(&step.edits));
        }
        self.open = (kind != Kind::Other).then_some(kind);
    }

    /// Closes the newest step because the caret moved: the next edit starts a new one.
    pub(super) fn end_step(&mut self) {
        self.open = None;
    }

    /// Records that the carets passed over typed text that was already there.
    pub(super) fn go_on(&mut self, carets: &Carets) {
        if let Some(edit) = self.done.back_mut().and_then(|step| step.edits.last_mut())
            && self.open == Some(Kind::Typing)
        {
            edit.after.clone_from(carets);
        }
    }

    /// Returns the step that undo reverts next.
    pub(super) fn done(&self) -> Option<u64> {
        self.done.back().map(|step| step.id)
    }

    /// Returns the step that redo makes next.
    pub(super) fn undone(&self) -> Option<u64> {
        self.undone.last().map(|step| step.id)
    }

    pub(super) fn undo(&mut self) -> Option<Step> {
        self.open = None;
        let step = self.done.pop_back()?;
        self.size -= size(&step.edits);
        self.undone.push(step.clone());
        Some(step)
    }

    pub(super) fn redo(&mut self) -> Option<Step> {
        self.open = None;
        let step = self.undone.pop()?;
        self.size += size(&step.edits);
        self.done.push_back(step.clone());
        Some(step)
    }
}

fn size(step: &[Edit]) -> usize {
    step.iter().map(Edit::size).sum()
}

/// Returns whether an edit joins the previous one. A typed word or a run of deletions is one step; the first letter
/// after a space starts the next.
fn can_merge(previous: Option<&Edit>, edit: &Edit, kind: Kind) -> bool {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn pasted(text: &str) -> Edit {
        let changes = vec![Change { at: 0, removed: String::new(), inserted: text.to_owned() }];
        Edit { changes, before: Carets::default(), after: Carets::default() }
    }

    #[test]
    fn history_is_bounded_and_the_newest_step_can_be_undone() {
        let mut history = History::default();
        let large = "x".repeat(MAX_BYTES / 8);
        for _ in 0..40 {
            history.push(pasted(&large), Kind::Other);
        }
        assert!(history.size <= MAX_BYTES && history.done.len() == 7, "{} in {}", history.size, history.done.len());
        history.push(pasted("y"), Kind::Other);
        assert_eq!(history.undo().unwrap().edits[0].changes[0].inserted, "y");
        let steps = std::iter::from_fn(|| history.undo()).count();
        assert_eq!((steps, history.size), (7, 0));
        assert_eq!(std::iter::from_fn(|| history.redo()).count(), 8);
        // A step of any size can be undone.
        history.push(pasted(&"z".repeat(2 * MAX_BYTES)), Kind::Other);
        assert!(history.undo().is_some() && history.undo().is_none());
    }
}
