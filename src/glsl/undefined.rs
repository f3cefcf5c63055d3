//! Operators whose result is undefined in GLSL ES 3.00, described for users. Sections are those of its specification.
//! For built-in functions see [`crate::builtins::Row::gaps`].

use super::types::Scalar;

pub const DIVISION: &str = "an integer divided by zero is undefined (5.9)";
pub const SHIFT: &str = "a shift by 32 or more bits, or by a negative number, is undefined (5.9)";

const TO_INT: &str = "converting a number out of range to int is undefined (5.4.1)";
const TO_UINT: &str = "converting a number out of range to uint is undefined (5.4.1)";

/// Returns why the conversion of a float to an int or a uint is undefined, if the float is out of range.
pub fn conversion(float: f32, to: Scalar) -> Option<&'static str> {
    match to {
        Scalar::Int => (!(-2_147_483_648.0..2_147_483_648.0).contains(&float)).then_some(TO_INT),
        Scalar::Uint => (!(float > -1.0 && float < 4_294_967_296.0)).then_some(TO_UINT),
        Scalar::Float | Scalar::Bool => None,
    }
}
