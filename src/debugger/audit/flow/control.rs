//! Control flow that depends on undefined values: for each open branch, the undefined values that decided it.

use super::sets::{Set, Sets};
use eddy_glsl::ir::{Stmt, Value};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Function,
    If,
    Switch,
    Loop { stmt: *const Stmt, break_if: Option<Value> },
}

#[derive(Clone, Copy, Debug)]
struct Open {
    kind: Kind,
    /// The values that decided it, or decided a jump out of it.
    own: Set,
    /// For a loop: the values that decided a `continue` of the current iteration.
    iteration: Set,
    /// The union with those of all enclosing ones.
    total: Set,
}

/// The open functions, branches and loops.
#[derive(Default)]
pub(super) struct Control {
    open: Vec<Open>,
    /// The values that decided whether the pixel is discarded.
    discard: Set,
}

impl Control {
    pub(super) fn total(&self) -> Set {
        self.open.last().map_or(self.discard, |open| open.total)
    }

    pub(super) fn push(&mut self, kind: Kind) {
        let total = self.total();
        self.open.push(Open { kind, own: Set::EMPTY, iteration: Set::EMPTY, total });
    }

    pub(super) fn pop(&mut self) {
        self.open.pop();
    }

    /// Ends a function with everything that is open in it.
    pub(super) fn pop_function(&mut self) {
        while self.open.pop().is_some_and(|open| open.kind != Kind::Function) {}
    }

    pub(super) fn top(&self) -> Option<Kind> {
        self.open.last().map(|open| open.kind)
    }

    /// Adds a set to the innermost open item of a kind, for the rest of its duration.
    pub(super) fn add(&mut self, set: Set, is_kind: impl Fn(Kind) -> bool, sets: &mut Sets) {
        if let Some(at) = self.open.iter().rposition(|open| is_kind(open.kind)) {
            self.open[at].own = sets.union(self.open[at].own, set);
            self.refresh(at, sets);
        }
    }

    pub(super) fn add_to_iteration(&mut self, set: Set, sets: &mut Sets) {
        if let Some(at) = self.open.iter().rposition(|open| matches!(open.kind, Kind::Loop { .. })) {
            self.open[at].iteration = sets.union(self.open[at].iteration, set);
            self.refresh(at, sets);
        }
    }

    pub(super) fn add_discard(&mut self, set: Set, sets: &mut Sets) {
        self.discard = sets.union(self.discard, set);
        self.refresh(0, sets);
    }

    /// Called when the iteration of the innermost loop reaches its `continuing` part, or the next iteration.
    pub(super) fn end_iteration(&mut self, sets: &mut Sets) {
        if let Some(at) = self.open.len().checked_sub(1)
            && !self.open[at].iteration.is_empty()
        {
            self.open[at].iteration = Set::EMPTY;
            self.refresh(at, sets);
        }
    }

    fn refresh(&mut self, from: usize, sets: &mut Sets) {
        let mut before = match from.checked_sub(1) {
            Some(outer) => self.open[outer].total,
            None => self.discard,
        };
        for open in &mut self.open[from..] {
            let own = sets.union(open.own, open.iteration);
            before = sets.union(before, own);
            open.total = before;
        }
    }
}
