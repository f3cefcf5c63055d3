//! Stepping through a history, forwards or backwards from a moment.

use super::history::{History, MomentKind};

/// A step of the debugger.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepKind {
    /// To the next line that runs, wherever it is.
    Into,
    /// To the next line of this call, or of one that it was made in.
    Over,
    /// To the place where this call was made.
    Out,
}

/// The direction of a step in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    Forward,
    Back,
}

/// Returns the moment that a step leads to; `None` if there is none in that direction.
pub fn step(history: &History, at: usize, stride: StepKind, direction: Direction) -> Option<usize> {
    let depth = history.depth(at);
    let fits = |other: &usize| {
        history.is_stop(*other)
            && match stride {
                StepKind::Into => true,
                StepKind::Over => history.depth(*other) <= depth,
                StepKind::Out => history.depth(*other) < depth,
            }
    };
    let found = ahead(history, at, direction).find(fits);
    // Stepping out of the outermost call leads to the start or end of the history.
    found.or_else(|| (stride == StepKind::Out && depth == 0).then(|| end(history, direction)).flatten())
}

/// Returns the moments in a direction, the nearest first.
fn ahead(history: &History, at: usize, direction: Direction) -> Box<dyn Iterator<Item = usize>> {
    match direction {
        Direction::Forward => Box::new(at + 1..history.moments.len()),
        Direction::Back => Box::new((0..at.min(history.moments.len())).rev()),
    }
}

/// Returns the first stop of the history, or the last.
pub fn end(history: &History, direction: Direction) -> Option<usize> {
    let mut all = 0..history.moments.len();
    match direction {
        Direction::Forward => all.rev().find(|at| history.is_stop(*at)),
        Direction::Back => all.find(|at| history.is_stop(*at)),
    }
}

/// Returns the nearest accepted moment in a direction at which a statement with `statement` true is about to run: each
/// start of it, and for a loop each iteration.
pub fn run(
    history: &History,
    at: usize,
    statement: impl Fn(u32) -> bool,
    mut accepts: impl FnMut(usize) -> bool,
    direction: Direction,
) -> Option<usize> {
    ahead(history, at, direction).find(|&other| {
        let moment = &history.moments[other];
        let is_started = !matches!(moment.kind, MomentKind::Return | MomentKind::Step);
        is_started && statement(moment.statement) && history.is_stop(other) && accepts(other)
    })
}
