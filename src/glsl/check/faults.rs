//! The checker notes what is wrong with operations on constants.

use super::{checker::Checker, fault::Fault};
use crate::{ast::Loc, hir::Scalar};

const INFINITE: &str = "first infinity here";
const NAN: &str = "this is NaN, which a GPU need not support: the result is undefined (4.5.1)";

impl Checker<'_> {
    pub(super) fn undefined(&mut self, loc: Loc, what: &'static str) {
        self.faults.push(Fault { loc, is_undefined: true, what });
    }

    /// Notes what floats came of constants: `given` are those that went in. Infinities are often meant, and no warning.
    pub(super) fn note_floats(&mut self, loc: Loc, is_nan: bool, is_infinite: bool) {
        if is_nan {
            self.undefined(loc, NAN);
            self.warning(loc, NAN);
        } else if is_infinite {
            self.faults.push(Fault { loc, is_undefined: false, what: INFINITE });
        }
    }

    /// A constant of floats beyond the range of the scalar that they become.
    pub(super) fn out_of_range(&mut self, to: Scalar, loc: Loc) {
        let what = match to {
            Scalar::Uint => "converting a number out of range to uint is undefined (5.4.1)",
            _ => "converting a number out of range to int is undefined (5.4.1)",
        };
        self.undefined(loc, what);
        self.warning(loc, what);
    }
}
