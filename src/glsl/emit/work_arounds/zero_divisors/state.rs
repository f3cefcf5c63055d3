//! The known state of a value, and of memory that is written in several places.

use State::{Unknown, Unseen};

use crate::ir::analysis::Interval;

/// The known state of a value.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum State {
    /// No statement that computes it has been analysed yet.
    #[default]
    Unseen,
    /// The value is one number of an interval: a driver may know which.
    Range(Interval),
    Unknown,
}

impl State {
    pub(super) const ZERO: State = State::Range(Interval::ZERO);

    /// Returns the union of both, where a driver knows which of the two it is.
    pub(super) fn or(self, other: State) -> State {
        match (self, other) {
            (Unseen, state) | (state, Unseen) => state,
            (State::Range(a), State::Range(b)) => State::Range(a.or(b)),
            _ => Unknown,
        }
    }

    /// Returns the known state where an unknown condition has selected one of both.
    pub(super) fn met(self, other: State) -> State {
        match (self, other) {
            (Unseen, state) | (state, Unseen) => state,
            (State::Range(a), State::Range(b)) if a == b && a.is_exact() => self,
            _ => Unknown,
        }
    }

    /// Returns the known state where two paths meet; a driver knows which one was taken if `is_known`.
    pub(super) fn join(self, other: State, is_known: bool) -> State {
        if is_known { self.or(other) } else { self.met(other) }
    }

    pub(super) fn map(self, f: impl FnOnce(Interval) -> Interval) -> State {
        match self {
            State::Range(range) => State::Range(f(range)),
            state => state,
        }
    }

    pub(super) fn zip(self, other: State, f: impl FnOnce(Interval, Interval) -> Interval) -> State {
        match (self, other) {
            (State::Range(a), State::Range(b)) => State::Range(f(a, b)),
            (Unknown, _) | (_, Unknown) => Unknown,
            _ => Unseen,
        }
    }
}

/// The known state of memory that is written in several places.
#[derive(Clone, Copy, Default)]
pub(super) struct Merged {
    pub state: State,
    /// The number of times that its interval has grown.
    pub grown: u8,
}

impl Merged {
    /// The number of times that an interval grows by no more than necessary. Values that calls count up would grow
    /// forever.
    const MAX_GROWN: u8 = 3;

    /// Returns the known state where it is read.
    pub(super) fn state(&self) -> State {
        match self.state {
            Unseen => Unknown,
            state => state,
        }
    }

    /// Adds a stored value; returns whether that changes the state.
    pub(super) fn add(&mut self, state: State) -> bool {
        self.add_growing(state, Self::MAX_GROWN)
    }

    /// Adds a value that an iteration of a loop stores. A value that grows in one most likely grows in each, so it is
    /// assumed to be unbounded.
    pub(super) fn add_in_loop(&mut self, state: State) -> bool {
        self.add_growing(state, 0)
    }

    fn add_growing(&mut self, state: State, most_grown: u8) -> bool {
        let before = self.state;
        let mut after = before.or(state);
        if after == before {
            return false;
        }
        if let (State::Range(old), State::Range(new)) = (before, after) {
            self.grown = self.grown.saturating_add(1);
            if self.grown > most_grown {
                after = State::Range(new.widened(old));
            }
        }
        self.state = after;
        true
    }
}
