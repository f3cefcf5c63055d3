//! A selection being drawn.

use super::selection::Selection;
use std::ops::Range;

/// A selection being drawn with the pointer.
#[derive(Clone, Debug)]
pub(super) struct Drag {
    /// The place where it began, whole words or lines at a time.
    pub from: Range<usize>,
    pub granularity: Granularity,
    /// Selections that stay beside it.
    pub others: Vec<Selection>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Granularity {
    Letter,
    Word,
    Line,
}
