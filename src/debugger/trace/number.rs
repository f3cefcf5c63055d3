//! A scalar of a trace.

use eddy_glsl::types::Scalar;
use serde::{Serialize, Serializer};
use std::fmt;

/// A scalar of the language, for display.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    Bool(bool),
    Int(i32),
    Uint(u32),
    Float(f32),
    /// A float in double precision.
    Double(f64),
}

impl Number {
    /// Returns the scalar with these bits.
    pub(super) fn of(scalar: Scalar, bits: u32) -> Self {
        match scalar {
            Scalar::Bool => Number::Bool(bits != 0),
            Scalar::Int => Number::Int(bits as i32),
            Scalar::Uint => Number::Uint(bits),
            Scalar::Float => Number::Float(f32::from_bits(bits)),
        }
    }

    /// Returns the number; 1 for true and 0 for false.
    pub fn as_f64(self) -> f64 {
        match self {
            Number::Bool(value) => u8::from(value).into(),
            Number::Int(value) => value.into(),
            Number::Uint(value) => value.into(),
            Number::Float(value) => value.into(),
            Number::Double(value) => value,
        }
    }
}

impl fmt::Display for Number {
    /// Writes a float with as many digits as distinguish it from its neighbours.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Number::Bool(value) => value.fmt(f),
            Number::Int(value) => value.fmt(f),
            Number::Uint(value) => write!(f, "{value}u"),
            Number::Float(value)
                if value.is_finite() && (value.abs() >= 1e7 || value.abs() < 1e-4) && *value != 0.0 =>
            {
                write!(f, "{value:e}")
            }
            Number::Float(value) if value.is_finite() => write!(f, "{value:?}"),
            Number::Float(value) => write!(f, "{value}"),
            Number::Double(value) => write!(f, "{value:?}"),
        }
    }
}

impl Serialize for Number {
    /// JSON has no NaN and no infinities: these become strings, `NaN`, `inf` and `-inf`.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match *self {
            Number::Bool(value) => serializer.serialize_bool(value),
            Number::Int(value) => serializer.serialize_i32(value),
            Number::Uint(value) => serializer.serialize_u32(value),
            Number::Float(value) if value.is_finite() => serializer.serialize_f32(value),
            Number::Float(value) => serializer.collect_str(&value),
            Number::Double(value) if value.is_finite() => serializer.serialize_f64(value),
            Number::Double(value) => serializer.collect_str(&value),
        }
    }
}
