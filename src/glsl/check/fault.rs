//! Operations on constants whose result GLSL ES 3.00 leaves open, or that is no finite number. They are folded, so that
//! no device and no walk comes to them.

use crate::{ast::Loc, hir::Builtin as X};

/// An operation on constants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Fault {
    pub loc: Loc,
    /// The result is undefined; else it is an infinity of finite numbers, which section 4.5.1 demands.
    pub is_undefined: bool,
    /// The fault in words for a person. Sections are those of the specification.
    pub what: &'static str,
}

/// A NaN came of numbers, or an infinity of finite ones.
pub(super) fn born<'w>(given: impl Iterator<Item = &'w [u32]> + Clone, result: &[u32]) -> (bool, bool) {
    let float = |bits: &u32| f32::from_bits(*bits);
    let has = |is: fn(f32) -> bool| given.clone().flatten().any(|bits| is(float(bits)));
    let is_nan = result.iter().any(|bits| float(bits).is_nan()) && !has(f32::is_nan);
    let is_infinite = result.iter().any(|bits| float(bits).is_infinite()) && !has(|x| !x.is_finite());
    (is_nan, is_infinite)
}

/// Returns why a function has no result for some arguments.
pub(super) fn domain(builtin: X) -> &'static str {
    match builtin {
        X::Asin => "asin is undefined outside -1 to 1 (8.1)",
        X::Acos => "acos is undefined outside -1 to 1 (8.1)",
        X::Acosh => "acosh is undefined below 1 (8.1)",
        X::Atanh => "atanh is undefined at and beyond -1 and 1 (8.1)",
        X::Atan => "the angle of (0, 0) is undefined (8.1)",
        X::Pow => "pow of a negative base, and of 0 unless the exponent is above 0, is undefined (8.2)",
        X::Log | X::Log2 => "the logarithm of 0 and below is undefined (8.2)",
        X::Sqrt => "the square root of a negative number is undefined (8.2)",
        X::InverseSqrt => "inversesqrt is undefined for 0 and below (8.2)",
        X::Clamp => "clamp is undefined where minVal is above maxVal (8.3)",
        X::Smoothstep => "smoothstep is undefined unless its first edge is below the second (8.3)",
        X::Normalize => "normalize of a zero vector is undefined (8.5)",
        X::Inverse => "the inverse of a singular matrix is undefined (8.6)",
        _ => "the result is undefined for this value",
    }
}

/// The function makes floats of other bits, which may stand for anything.
pub(super) fn reads_bits(builtin: X) -> bool {
    matches!(builtin, X::IntBitsToFloat | X::UintBitsToFloat | X::UnpackHalf2x16)
}
