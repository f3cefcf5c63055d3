//! Operations on constants whose result is undefined in GLSL ES 3.00 or not a finite number. They are folded, so
//! neither devices nor the CPU interpreter (`walk`) execute them.

use super::checker::Checker;
use crate::ast::Loc;

const INFINITE: &str = "first infinity here";
const NAN: &str = "this is NaN, which a GPU need not support: the result is undefined (4.5.1)";

/// An operation on constants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Fault {
    pub loc: Loc,
    /// The result is undefined; otherwise it is an infinity computed from finite numbers, which section 4.5.1 requires.
    pub is_undefined: bool,
    /// The description for users. Sections are those of the specification.
    pub what: &'static str,
}

/// Returns whether a NaN was computed from numbers that are not NaN, and whether an infinity was computed from finite
/// ones.
pub(super) fn introduces_nan_or_infinity<'w>(
    given: impl Iterator<Item = &'w [u32]> + Clone,
    result: &[u32],
) -> (bool, bool) {
    let float = |bits: &u32| f32::from_bits(*bits);
    let has = |is: fn(f32) -> bool| given.clone().flatten().any(|bits| is(float(bits)));
    let is_nan = result.iter().any(|bits| float(bits).is_nan()) && !has(f32::is_nan);
    let is_infinite = result.iter().any(|bits| float(bits).is_infinite()) && !has(|x| !x.is_finite());
    (is_nan, is_infinite)
}

impl Checker<'_> {
    pub(super) fn undefined(&mut self, loc: Loc, what: &'static str) {
        self.faults.push(Fault { loc, is_undefined: true, what });
    }

    /// Records NaNs and infinities computed from constants. Infinities are often intended, so they are not reported.
    pub(super) fn note_floats(&mut self, loc: Loc, is_nan: bool, is_infinite: bool) {
        if is_nan {
            self.undefined(loc, NAN);
            self.warning(loc, NAN);
        } else if is_infinite {
            self.faults.push(Fault { loc, is_undefined: false, what: INFINITE });
        }
    }
}
