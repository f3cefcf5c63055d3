//! Numbers of which bounds are known: the domain in which a program is specialised.
//!
//! Every bound holds for any arithmetic that a driver may choose: each operation rounded, flushed to zero, or contracted
//! with the next one (`a * b + c` with one rounding). So a result is a single number only where no rounding occurs, and
//! bounds are widened outward everywhere else.

use crate::{
    ir::{Binary, Math, Unary},
    types::Scalar,
};

/// A number that is neither infinite nor NaN, or a bool as 0 or 1, between two bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Number {
    pub min: f64,
    pub max: f64,
    /// It may be the float -0.
    pub minus_zero: bool,
}

/// Larger floats are treated as unknown: a few operations later they may be infinite.
const MAX_FLOAT: f64 = 1e30;

/// The relative error of an operation that is rounded, or that a driver computes in another order: four units in the last
/// place.
const ROUNDING: f64 = 4.0 / (1 << 23) as f64;

impl Number {
    pub(super) const BOOL: Number = Number { min: 0.0, max: 1.0, minus_zero: false };

    /// Returns a number within these bounds that is not -0.
    pub(super) fn between(min: f64, max: f64) -> Number {
        Number { min, max, minus_zero: false }
    }

    /// Returns a number within these bounds that may be -0.
    pub(super) fn signed(min: f64, max: f64) -> Number {
        Number { min, max, minus_zero: true }
    }

    /// Returns the number with these bits; `None` for infinities and NaN.
    pub(super) fn literal(scalar: Scalar, bits: u32) -> Option<Number> {
        let number = match scalar {
            Scalar::Float => return Self::float(f32::from_bits(bits)),
            Scalar::Int => f64::from(bits as i32),
            Scalar::Uint => f64::from(bits),
            Scalar::Bool => f64::from(bits.min(1)),
        };
        Some(Self::between(number, number))
    }

    fn float(number: f32) -> Option<Number> {
        if !number.is_finite() || f64::from(number.abs()) > MAX_FLOAT {
            return None;
        }
        let exact = f64::from(number);
        if number.is_subnormal() {
            // Devices may read it as zero.
            return Some(Self::signed(exact.min(0.0), exact.max(0.0)));
        }
        Some(Number { min: exact, max: exact, minus_zero: number == 0.0 && number.is_sign_negative() })
    }

    /// Returns all numbers of an int, a uint or a bool; nothing is known of a float.
    pub(super) fn of_type(scalar: Scalar) -> Option<Number> {
        match scalar {
            Scalar::Float => None,
            Scalar::Int => Some(Self::between(i32::MIN.into(), i32::MAX.into())),
            Scalar::Uint => Some(Self::between(0.0, u32::MAX.into())),
            Scalar::Bool => Some(Self::BOOL),
        }
    }

    /// Returns the bits, if only one number is possible and its sign is known.
    pub(super) fn bits(self, scalar: Scalar) -> Option<u32> {
        if self.min != self.max || self.minus_zero {
            return None;
        }
        Some(match scalar {
            Scalar::Float => (self.min as f32 + 0.0).to_bits(),
            Scalar::Int => self.min as i32 as u32,
            Scalar::Uint | Scalar::Bool => self.min as u32,
        })
    }

    /// Returns whether it is a zero, of any sign.
    pub(super) fn is_zero(self) -> bool {
        self.min == 0.0 && self.max == 0.0
    }

    /// Returns whether no digit but the sign can differ.
    fn is_exact(self) -> bool {
        self.min == self.max
    }

    /// Returns whether the sign bit is never set.
    fn is_positive(self) -> bool {
        self.min >= 0.0 && !self.minus_zero
    }

    pub(super) fn or(self, other: Number) -> Number {
        Number {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
            minus_zero: self.minus_zero || other.minus_zero,
        }
    }

    /// Returns the result of a float operation with these bounds before rounding.
    fn rounded(min: f64, max: f64, minus_zero: bool) -> Option<Number> {
        // Smaller numbers may be flushed to zero.
        let low = f64::from(f32::MIN_POSITIVE);
        let widen = |bound: f64, to: f64| {
            let is_small = bound != 0.0 && bound.abs() < 2.0 * low;
            if is_small && bound * to < 0.0 {
                return 0.0;
            }
            bound + to * (bound.abs() * ROUNDING + if is_small { low } else { 0.0 })
        };
        let (min, max) = (widen(min, -1.0), widen(max, 1.0));
        let is_known = min >= -MAX_FLOAT && max <= MAX_FLOAT;
        is_known.then_some(Number { min, max, minus_zero: minus_zero || min < 0.0 && max > -low })
    }

    /// Returns the result of a float operation whose exact result is `number`, which may need no rounding.
    fn of_exact(number: f64, is_unrounded: bool, minus_zero: bool) -> Option<Number> {
        let is_float = f64::from(number as f32) == number && (number == 0.0 || (number as f32).is_normal());
        if !is_unrounded || !is_float {
            return Self::rounded(number, number, minus_zero);
        }
        (number.abs() <= MAX_FLOAT).then_some(Number { min: number, max: number, minus_zero })
    }

    pub(super) fn unary(self, op: Unary, scalar: Scalar) -> Option<Number> {
        match (op, scalar) {
            (Unary::Negate, Scalar::Float) => {
                // The other zero is possible if this one is.
                let may_be_zero = self.min <= 0.0 && self.max >= 0.0;
                Some(Number { min: -self.max, max: -self.min, minus_zero: may_be_zero })
            }
            (Unary::Negate, Scalar::Int) => integer(-self.max, -self.min, scalar),
            (Unary::LogicalNot, _) => Some(Number::between(1.0 - self.max, 1.0 - self.min)),
            _ => Number::of_type(scalar),
        }
    }

    /// Returns the result of an operation on numbers of one type, `scalar`.
    pub(super) fn binary(self, op: Binary, other: Number, scalar: Scalar) -> Option<Number> {
        if let Some(result) = self.compare(op, other) {
            return Some(result.map_or(Number::BOOL, |result| {
                let bit = f64::from(u8::from(result));
                Number::between(bit, bit)
            }));
        }
        match scalar {
            Scalar::Float => self.float_binary(op, other),
            Scalar::Bool => self.bool_binary(op, other),
            Scalar::Int | Scalar::Uint => self.integer_binary(op, other, scalar),
        }
    }

    fn float_binary(self, op: Binary, other: Number) -> Option<Number> {
        let (l, r) = (self, other);
        match op {
            Binary::Add | Binary::Subtract => {
                let r = if op == Binary::Add { r } else { r.unary(Unary::Negate, Scalar::Float)? };
                let minus_zero = l.minus_zero && r.minus_zero;
                if l.is_exact() && r.is_exact() {
                    let sum = l.min + r.min;
                    // The error of the sum in doubles (D. Knuth, The Art of Computer Programming 2, 4.2.2, theorem B).
                    let right = sum - l.min;
                    let error = (l.min - (sum - right)) + (r.min - right);
                    return Self::of_exact(sum, error == 0.0, minus_zero);
                }
                Self::rounded(l.min + r.min, l.max + r.max, minus_zero)
            }
            Binary::Multiply => {
                let has_known_sign = l.is_positive() && r.is_positive() || l.max < 0.0 && r.max < 0.0;
                if l.is_zero() || r.is_zero() {
                    return Some(Number { min: 0.0, max: 0.0, minus_zero: !has_known_sign });
                }
                if l.is_exact() && r.is_exact() {
                    return Self::of_exact(l.min * r.min, true, !has_known_sign && l.min * r.min == 0.0);
                }
                let all = [l.min * r.min, l.min * r.max, l.max * r.min, l.max * r.max];
                let (min, max) = bounds(&all);
                Self::rounded(min, max, !has_known_sign)
            }
            Binary::Divide => {
                let size = |number: f64| (1e-20..=1e20).contains(&number.abs());
                if !(r.min > 0.0 || r.max < 0.0) || !size(r.min) || !size(r.max) {
                    return None;
                }
                let has_known_sign = l.is_positive() && r.min > 0.0;
                if l.is_zero() {
                    return Some(Number { min: 0.0, max: 0.0, minus_zero: !has_known_sign });
                }
                let (min, max) = bounds(&[l.min / r.min, l.min / r.max, l.max / r.min, l.max / r.max]);
                Self::rounded(min, max, !has_known_sign)
            }
            _ => None,
        }
    }

    fn bool_binary(self, op: Binary, other: Number) -> Option<Number> {
        let (l, r) = (self, other);
        Some(match op {
            Binary::And | Binary::LogicalAnd => Number::between(l.min.min(r.min), l.max.min(r.max)),
            Binary::InclusiveOr => Number::between(l.min.max(r.min), l.max.max(r.max)),
            _ => Number::BOOL,
        })
    }

    fn integer_binary(self, op: Binary, other: Number, scalar: Scalar) -> Option<Number> {
        let (l, r) = (self, other);
        match op {
            Binary::Add => integer(l.min + r.min, l.max + r.max, scalar),
            Binary::Subtract => integer(l.min - r.max, l.max - r.min, scalar),
            Binary::Multiply => {
                let (min, max) = bounds(&[l.min * r.min, l.min * r.max, l.max * r.min, l.max * r.max]);
                // Products of two 32-bit integers that do not fit wrap, and are known as doubles only up to 2^53.
                integer(min, max, scalar)
            }
            Binary::And if l.is_zero() || r.is_zero() => Some(Number::between(0.0, 0.0)),
            Binary::InclusiveOr if r.is_zero() => Some(l),
            Binary::InclusiveOr if l.is_zero() => Some(r),
            Binary::ShiftLeft | Binary::ShiftRight if r.is_zero() => Some(l),
            _ => Number::of_type(scalar),
        }
    }

    /// Returns the result of a comparison: `None` for another operation, `Some(None)` if it may be either.
    #[expect(clippy::option_option, reason = "two different questions")]
    fn compare(self, op: Binary, other: Number) -> Option<Option<bool>> {
        let (l, r) = (self, other);
        let (is_below, is_above) = (l.max < r.min, l.min > r.max);
        let is_same = l.is_exact() && r.is_exact() && l.min == r.min;
        let (is_true, is_false) = match op {
            Binary::Less => (is_below, l.min >= r.max),
            Binary::LessEqual => (l.max <= r.min, is_above),
            Binary::Greater => (is_above, l.max <= r.min),
            Binary::GreaterEqual => (l.min >= r.max, is_below),
            Binary::Equal => (is_same, is_below || is_above),
            Binary::NotEqual => (is_below || is_above, is_same),
            _ => return None,
        };
        Some((is_true || is_false).then_some(is_true))
    }

    /// Returns the result of a function of floats, or of integers.
    pub(super) fn function(fun: Math, args: &[Option<Number>], scalar: Scalar) -> Option<Number> {
        let is_float = scalar == Scalar::Float;
        let of_type = || Number::of_type(scalar);
        let [Some(x), rest @ ..] = args else { return of_type() };
        let x = *x;
        let result = match (fun, rest) {
            (Math::Abs, []) if is_float || x.min > i32::MIN.into() => {
                let least = if x.min <= 0.0 && x.max >= 0.0 { 0.0 } else { x.min.abs().min(x.max.abs()) };
                Some(Number::between(least, x.min.abs().max(x.max.abs())))
            }
            (Math::Min, [Some(y)]) => Some(Number { min: x.min.min(y.min), max: x.max.min(y.max), ..x.or(*y) }),
            (Math::Max, [Some(y)]) => Some(Number { min: x.min.max(y.min), max: x.max.max(y.max), ..x.or(*y) }),
            (Math::Clamp, [Some(low), Some(high)]) if low.max <= high.min => Some(Number {
                min: x.min.max(low.min).min(high.min),
                max: x.max.max(low.max).min(high.max),
                ..x.or(*low).or(*high)
            }),
            (Math::Saturate, []) => Some(Number { min: x.min.clamp(0.0, 1.0), max: x.max.clamp(0.0, 1.0), ..x }),
            _ if !is_float => None,
            (Math::Floor | Math::Ceil | Math::Trunc | Math::Round, []) => {
                let of = |x: f64| match fun {
                    Math::Floor => x.floor(),
                    Math::Ceil => x.ceil(),
                    Math::Trunc => x.trunc(),
                    _ => x.round_ties_even(),
                };
                let (min, max) = (of(x.min), of(x.max));
                Some(Number { min, max, minus_zero: x.minus_zero || min <= 0.0 && max >= 0.0 && x.min < 0.0 })
            }
            // It may be rounded to 1.
            (Math::Fract, []) if x.is_exact() && x.min == x.min.floor() => Some(Number::between(0.0, 0.0)),
            (Math::Fract, []) => Some(Number::signed(0.0, 1.0)),
            // Their errors are absolute ("Precision and Operation of SPIR-V Instructions" of Vulkan's specification).
            (Math::Sin | Math::Cos, []) if x.min.abs().max(x.max.abs()) <= 1e9 => Some(Number::signed(-1.01, 1.01)),
            (Math::Sqrt, []) if x.is_positive() => Self::rounded(x.min.sqrt() * 0.999, x.max.sqrt() * 1.001, false),
            (Math::Exp, []) if x.min > -60.0 && x.max < 60.0 => {
                Self::rounded(x.min.exp() * 0.99, x.max.exp() * 1.01, false)
            }
            (Math::Atan, []) => Some(Number::signed(-1.6, 1.6)),
            _ => None,
        };
        result.or_else(of_type)
    }

    /// Returns the conversion of a number of the type `from`.
    pub(super) fn converted(self, from: Scalar, to: Scalar) -> Option<Number> {
        match (from, to) {
            (_, Scalar::Bool) if self.is_zero() => Some(Number::between(0.0, 0.0)),
            (_, Scalar::Bool) if self.min > 0.0 || self.max < 0.0 => Some(Number::between(1.0, 1.0)),
            (_, Scalar::Bool) => Some(Number::BOOL),
            (Scalar::Float, _) => integer(self.min.trunc(), self.max.trunc(), to),
            (_, Scalar::Float) if self.min.abs().max(self.max.abs()) <= (1 << 24).into() => Some(self),
            (_, Scalar::Float) => Self::rounded(self.min, self.max, false),
            (Scalar::Bool, _) => Some(self),
            _ => integer(self.min, self.max, to),
        }
    }

    /// Returns the number with the same bits in another type.
    pub(super) fn bitcast(self, from: Scalar, to: Scalar) -> Option<Number> {
        self.bits(from).map_or_else(|| Number::of_type(to), |bits| Number::literal(to, bits))
    }
}

/// Returns the integers between two bounds, or any if one of them wraps.
fn integer(min: f64, max: f64, scalar: Scalar) -> Option<Number> {
    let all = Number::of_type(scalar)?;
    Some(if min >= all.min && max <= all.max { Number::between(min, max) } else { all })
}

fn bounds(all: &[f64]) -> (f64, f64) {
    (all.iter().copied().fold(f64::INFINITY, f64::min), all.iter().copied().fold(f64::NEG_INFINITY, f64::max))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn float(number: f32) -> Number {
        Number::literal(Scalar::Float, number.to_bits()).unwrap()
    }

    fn binary(l: Number, op: Binary, r: Number) -> Option<Number> {
        l.binary(op, r, Scalar::Float)
    }

    fn bits(number: Option<Number>) -> Option<f32> {
        number.and_then(|number| number.bits(Scalar::Float)).map(f32::from_bits)
    }

    #[test]
    fn a_product_with_zero_is_known_only_with_its_sign() {
        let time = Number::between(0.0, 1e9);
        assert_eq!(bits(binary(float(0.0), Binary::Multiply, time)), Some(0.0));
        let signed = Number::signed(-1.0, 1.0);
        let product = binary(float(0.0), Binary::Multiply, signed).unwrap();
        assert!(product.is_zero() && product.bits(Scalar::Float).is_none());
        // 0.0 + -0.0 is 0.0.
        assert_eq!(bits(binary(float(0.0), Binary::Add, product)), Some(0.0));
        assert_eq!(bits(binary(float(2.0), Binary::Add, product)), Some(2.0));
        assert_eq!(bits(binary(float(-0.0), Binary::Add, product)), None);
        assert_eq!(bits(binary(float(-0.0), Binary::Multiply, time)), None, "this sign is not tracked");
    }

    #[test]
    fn only_results_without_rounding_are_single_numbers() {
        assert_eq!(bits(binary(float(0.5), Binary::Multiply, float(3.0))), Some(1.5));
        assert_eq!(bits(binary(float(0.1), Binary::Multiply, float(0.1))), None);
        assert_eq!(bits(binary(float(1.0), Binary::Add, float(1e-9))), None);
        assert_eq!(bits(binary(float(1.0), Binary::Add, float(1e-20))), None, "inexact in doubles, too");
        assert_eq!(bits(binary(float(1e-30), Binary::Multiply, float(1e-30))), None, "flushed, or not");
        assert_eq!(bits(binary(float(1.0), Binary::Divide, float(3.0))), None);
        assert_eq!(bits(Some(float(f32::from_bits(1)))), None, "a device may read zero");
    }

    #[test]
    fn comparisons_are_known_only_beyond_the_rounding() {
        let tenth = binary(float(0.1), Binary::Multiply, float(3.0)).unwrap();
        assert_eq!(tenth.compare(Binary::Greater, float(0.3)), Some(None));
        assert_eq!(tenth.compare(Binary::Greater, float(0.2)), Some(Some(true)));
        assert_eq!(float(0.0).compare(Binary::Greater, float(0.0)), Some(Some(false)));
        assert_eq!(float(-0.0).compare(Binary::Equal, float(0.0)), Some(Some(true)));
    }

    #[test]
    fn infinities_nan_and_large_numbers_are_unknown() {
        assert!(Number::literal(Scalar::Float, f32::INFINITY.to_bits()).is_none());
        assert!(Number::literal(Scalar::Float, f32::NAN.to_bits()).is_none());
        assert!(binary(float(1e20), Binary::Multiply, float(1e20)).is_none());
        assert!(binary(float(0.0), Binary::Divide, float(0.0)).is_none());
        assert!(Number::function(Math::Sqrt, &[Some(float(-1.0))], Scalar::Float).is_none());
    }

    #[test]
    fn integers_wrap() {
        let int = |number: i32| Number::literal(Scalar::Int, number as u32).unwrap();
        let product = int(1 << 20).binary(Binary::Multiply, int(1 << 20), Scalar::Int).unwrap();
        assert_eq!(product, Number::of_type(Scalar::Int).unwrap());
        assert_eq!(int(3).binary(Binary::Add, int(4), Scalar::Int), Some(int(7)));
        assert_eq!(Number::of_type(Scalar::Int).unwrap().binary(Binary::Multiply, int(0), Scalar::Int), Some(int(0)));
    }
}
