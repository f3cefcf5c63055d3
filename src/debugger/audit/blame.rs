//! Finds the operation that causes most of a pixel's error.

use super::{
    distance::error_of,
    watch::{Blame, Watch},
};
use crate::trace::TraceError;
use eddy_glsl::{
    ir::{FuncId, Value},
    walk::{Cell, Observer, Shadowed},
};

/// Errors of a pixel's value that are ignored, relative to a value of 1: a few roundings.
const MIN_ERROR: f64 = 1e-5;
/// The number of operations that are tried.
const MAX_SUSPECTS: usize = 8;
/// The largest part of an error that may remain when the operation that causes it is exact.
const MAX_REMAINING_SHARE: f64 = 0.5;

/// Makes an operation exact: its single-precision result is the rounded double-precision one.
struct ExactOperation {
    function: FuncId,
    value: Value,
}

impl Observer<Shadowed> for ExactOperation {
    fn correct(&mut self, function: FuncId, value: Value, cells: &mut [Cell<Shadowed>]) {
        if (function, value) != (self.function, self.value) {
            return;
        }
        for cell in cells {
            if let Cell::Float(x) = cell {
                x.single = x.double as f32;
            }
        }
    }
}

/// Repeats the walk with each suspect exact; `drawn` is the pixel's value, and `walk` runs it.
pub(super) fn find(
    drawn: &[Shadowed; 4],
    watch: &Watch<'_>,
    walk: impl Fn(&mut dyn Observer<Shadowed>) -> Result<[Shadowed; 4], TraceError>,
) -> Result<Option<Blame>, TraceError> {
    let error = error_of(drawn);
    let size = drawn.iter().map(|x| x.double.abs()).filter(|x| x.is_finite()).fold(1.0, f64::max);
    if error < MIN_ERROR * size {
        return Ok(None);
    }
    let mut best: Option<Blame> = None;
    for cause in watch.root_causes().into_iter().take(MAX_SUSPECTS) {
        let drawn = walk(&mut ExactOperation { function: cause.function, value: cause.value })?;
        let left = error_of(&drawn);
        if left <= MAX_REMAINING_SHARE * error && best.as_ref().is_none_or(|best| left < best.left) {
            best = Some(Blame { cause: cause.clone(), error, left });
        }
    }
    Ok(best)
}
