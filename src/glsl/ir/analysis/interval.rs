//! Intervals of numbers: what is known statically about values.

use crate::{
    ir::{Binary, Math, Unary},
    types::{Scalar, TypeId},
};

/// The interval that contains a value, or all its components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    pub min: f64,
    pub max: f64,
    /// The value may be zero. Never true if the interval excludes 0, but not always true if it includes 0.
    pub zero: bool,
}

impl Interval {
    /// Any number.
    pub const ANY: Interval = Interval { min: f64::NEG_INFINITY, max: f64::INFINITY, zero: true };
    pub const ZERO: Interval = Interval { min: 0.0, max: 0.0, zero: true };
    pub const BOOL: Interval = Interval { min: 0.0, max: 1.0, zero: true };

    fn exact(number: f64) -> Interval {
        Interval::between(number, number)
    }

    /// Returns all numbers of an interval; any number if a bound is NaN.
    pub fn between(min: f64, max: f64) -> Interval {
        if min.is_nan() || max.is_nan() {
            return Interval::ANY;
        }
        Interval { min, max, zero: min <= 0.0 && max >= 0.0 }
    }

    /// Returns the interval of a scalar, given its bits.
    pub fn literal(scalar: Scalar, bits: u32) -> Interval {
        Interval::exact(match scalar {
            Scalar::Float => f32::from_bits(bits).into(),
            Scalar::Int => (bits as i32).into(),
            Scalar::Uint | Scalar::Bool => bits.into(),
        })
    }

    /// Returns all numbers of an int or a uint; `None` for other types.
    pub fn of_type(ty: TypeId) -> Option<Interval> {
        match ty {
            TypeId::INT => Some(Interval::between(i32::MIN.into(), i32::MAX.into())),
            TypeId::UINT => Some(Interval::between(0.0, u32::MAX.into())),
            _ => None,
        }
    }

    /// Returns any number, which may be zero only if `zero` is true.
    pub fn any_but(zero: bool) -> Interval {
        Interval { zero, ..Interval::ANY }
    }

    pub fn or(self, other: Interval) -> Interval {
        Interval { min: self.min.min(other.min), max: self.max.max(other.max), zero: self.zero || other.zero }
    }

    /// Returns `self`, the successor of `before`, with the bounds that have grown widened to infinity.
    pub fn widened(self, before: Interval) -> Interval {
        let min = if self.min < before.min { f64::NEG_INFINITY } else { self.min };
        let max = if self.max > before.max { f64::INFINITY } else { self.max };
        Interval { min, max, zero: self.zero }
    }

    /// Returns the intersection with an overlapping interval.
    pub fn within(self, other: Interval) -> Interval {
        Interval { min: self.min.max(other.min), max: self.max.min(other.max), zero: self.zero && other.zero }
    }

    pub fn is_exact(self) -> bool {
        self.min == self.max
    }

    /// Returns the smallest interval around `f` of the bounds of both, for an `f` that is monotonic in each argument.
    fn corners(self, other: Interval, f: impl Fn(f64, f64) -> f64) -> Interval {
        let (l, r) = (self, other);
        let all = [f(l.min, r.min), f(l.min, r.max), f(l.max, r.min), f(l.max, r.max)];
        if all.iter().any(|number| number.is_nan()) {
            return Interval::ANY;
        }
        Interval::between(
            all.into_iter().fold(f64::INFINITY, f64::min),
            all.into_iter().fold(f64::NEG_INFINITY, f64::max),
        )
    }

    /// Returns what the device computes in this type: floats are rounded, and integers wrap.
    fn as_type(self, scalar: Scalar) -> Interval {
        let (min, max) = match scalar {
            // Equal to a single rounding: a double has more than twice the bits of a float.
            Scalar::Float => {
                let (min, max) = (f64::from(self.min as f32), f64::from(self.max as f32));
                return Interval { min, max, zero: self.zero || (self.is_exact() && min == 0.0) };
            }
            Scalar::Int => (i32::MIN.into(), i32::MAX.into()),
            Scalar::Uint => (0.0, u32::MAX.into()),
            Scalar::Bool => (0.0, 1.0),
        };
        // No loop is unrolled until its counter wraps: a bound that was widened to infinity stays there.
        let wraps = |bound: f64| bound.is_finite() && !(min..=max).contains(&bound);
        if wraps(self.min) || wraps(self.max) { Interval::between(min, max) } else { self }
    }

    pub fn unary(self, op: Unary, scalar: Scalar) -> Interval {
        match op {
            Unary::Negate => Interval { min: -self.max, max: -self.min, zero: self.zero }.as_type(scalar),
            Unary::LogicalNot => Interval::BOOL,
            Unary::BitwiseNot => Interval::ANY,
        }
    }

    /// An operation on numbers of the type `scalar`.
    pub fn binary(self, op: Binary, other: Interval, scalar: Scalar) -> Interval {
        let (l, r) = (self, other);
        // A product or a quotient of two intervals with 0 between their bounds need not be 0.
        let with_zero =
            |interval: Interval, zero| Interval { zero: zero || (interval.is_exact() && interval.zero), ..interval };
        let result = match op {
            Binary::Add => l.corners(r, |l, r| l + r),
            Binary::Subtract => l.corners(r, |l, r| l - r),
            Binary::Multiply => with_zero(l.corners(r, |l, r| l * r), l.zero || r.zero),
            Binary::Divide if r.min > 0.0 || r.max < 0.0 => match scalar {
                Scalar::Float => with_zero(l.corners(r, |l, r| l / r), l.zero),
                _ => l.corners(r, |l, r| (l / r).trunc()),
            },
            Binary::And if l.min >= 0.0 || r.min >= 0.0 => {
                // Any bit of a negative number may be set.
                let max = |side: Interval| if side.min >= 0.0 { side.max } else { f64::INFINITY };
                Interval::between(0.0, max(l).min(max(r)))
            }
            // The result has the divisor's sign.
            Binary::Modulo if r.min > 0.0 => Interval::between(0.0, r.max - 1.0),
            Binary::ShiftRight if r.is_exact() && (0.0..32.0).contains(&r.min) => {
                let shifted = |number: f64| (number / r.min.exp2()).floor();
                Interval::between(shifted(l.min), shifted(l.max))
            }
            _ if op.is_comparison() => return Interval::BOOL,
            _ => return Interval::ANY,
        };
        result.as_type(scalar)
    }

    /// Returns the result of a comparison, if it is the same for all numbers of both.
    pub fn compare(self, op: Binary, other: Interval) -> Option<bool> {
        let (l, r) = (self, other);
        let (is_below, is_above) = (l.max < r.min, l.min > r.max);
        let is_same = l.is_exact() && l.min == r.min && l.max == r.max;
        let (all, none) = match op {
            Binary::Less => (is_below, l.min >= r.max),
            Binary::LessEqual => (l.max <= r.min, is_above),
            Binary::Greater => (is_above, l.max <= r.min),
            Binary::GreaterEqual => (l.min >= r.max, is_below),
            Binary::Equal => (is_same, is_below || is_above),
            Binary::NotEqual => (is_below || is_above, is_same),
            _ => return None,
        };
        (all || none).then_some(all)
    }

    /// A function of one number, or of two. Functions whose results are seldom divided by return any number for an
    /// interval.
    pub fn function(self, fun: Math, other: Option<Interval>, scalar: Scalar) -> Interval {
        let x = self;
        if let (true, Some(y)) = (x.is_exact(), other.map_or(Some(0.0), |y| y.is_exact().then_some(y.min)))
            && let Some(result) = std_function(fun, x.min, y)
        {
            return Interval::exact(result).as_type(scalar);
        }
        let both = |f: fn(f64, f64) -> f64, y: Interval| {
            let (min, max) = (f(x.min, y.min), f(x.max, y.max));
            Interval { min, max, zero: min <= 0.0 && max >= 0.0 && (x.zero || y.zero) }
        };
        let result = match (fun, other) {
            (Math::Abs, None) => {
                let (min, max) = (x.min.abs(), x.max.abs());
                let has_both_signs = x.min < 0.0 && x.max > 0.0;
                Interval { min: if has_both_signs { 0.0 } else { min.min(max) }, max: min.max(max), zero: x.zero }
            }
            (Math::Min, Some(y)) => both(f64::min, y),
            (Math::Max, Some(y)) => both(f64::max, y),
            (Math::Sqrt, None) if x.min >= 0.0 => Interval { min: x.min.sqrt(), max: x.max.sqrt(), zero: x.zero },
            // Smaller values would underflow.
            (Math::Exp | Math::Exp2, None) if x.min > -80.0 => Interval { min: 0.0, max: f64::INFINITY, zero: false },
            _ => return Interval::ANY,
        };
        result.as_type(scalar)
    }

    /// A conversion to another type.
    pub fn converted(self, to: Scalar) -> Interval {
        match to {
            Scalar::Float => self.as_type(to),
            Scalar::Int | Scalar::Uint => Interval::between(self.min.trunc(), self.max.trunc()).as_type(to),
            Scalar::Bool => Interval::BOOL,
        }
    }
}

/// A function of numbers, where the standard library's has the same zeros.
fn std_function(fun: Math, x: f64, y: f64) -> Option<f64> {
    Some(match fun {
        Math::Abs => x.abs(),
        Math::Floor => x.floor(),
        Math::Ceil => x.ceil(),
        Math::Trunc => x.trunc(),
        Math::Min => x.min(y),
        Math::Max => x.max(y),
        Math::Sqrt => x.sqrt(),
        Math::InverseSqrt => x.sqrt().recip(),
        Math::Pow => x.powf(y),
        Math::Exp => x.exp(),
        Math::Exp2 => x.exp2(),
        Math::Log => x.ln(),
        Math::Log2 => x.log2(),
        Math::Radians => x.to_radians(),
        Math::Degrees => x.to_degrees(),
        Math::Sin => x.sin(),
        Math::Cos => x.cos(),
        Math::Tan => x.tan(),
        Math::Asin => x.asin(),
        Math::Acos => x.acos(),
        Math::Atan => x.atan(),
        Math::Atan2 => x.atan2(y),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn float(number: f32) -> Interval {
        Interval::literal(Scalar::Float, number.to_bits())
    }

    fn binary(l: Interval, op: Binary, r: Interval) -> Interval {
        l.binary(op, r, Scalar::Float)
    }

    #[test]
    fn differences_of_equal_numbers_are_zeros() {
        assert!(binary(float(1.0), Binary::Subtract, float(1.0)).zero);
        assert!(!binary(float(1.0), Binary::Subtract, float(0.5)).zero);
        // In floats, this is 1 - 1.
        let nearly = binary(float(1.0), Binary::Add, float(1e-9));
        assert!(binary(float(1.0), Binary::Subtract, nearly).zero);
        assert!(binary(float(1e-30), Binary::Multiply, float(1e-30)).zero, "it underflows");
    }

    #[test]
    fn counters_that_grow_from_one_are_never_zero() {
        let grown = float(1.0).or(float(2.0)).widened(float(1.0));
        assert!(!grown.zero);
        assert!(!binary(grown, Binary::Add, float(1.0)).zero);
        assert!(!grown.converted(Scalar::Float).zero);
        let counter = |number: i32| Interval::literal(Scalar::Int, number as u32);
        let counted = counter(0).or(counter(1)).widened(counter(0));
        assert!(!counted.binary(Binary::Add, counter(1), Scalar::Int).zero);
        assert!(binary(grown, Binary::Subtract, float(3.0)).zero);
        let from_below = float(-2.0).or(float(-1.0)).widened(float(-2.0));
        assert!(binary(from_below, Binary::Add, float(1.0)).zero);
    }

    #[test]
    fn a_product_is_zero_where_a_factor_is() {
        let signs = float(-1.0).or(float(1.0));
        assert!(!signs.zero, "neither is 0");
        assert!(!binary(signs, Binary::Multiply, float(3.0)).zero);
        assert!(binary(signs, Binary::Multiply, float(0.0)).zero);
        assert!(binary(signs, Binary::Add, float(0.5)).zero, "which of them it is, is not known");
    }

    #[test]
    fn integers_wrap_and_are_cut_off() {
        let max = Interval::literal(Scalar::Int, i32::MAX as u32);
        assert!(max.binary(Binary::Add, Interval::literal(Scalar::Int, 1), Scalar::Int).zero);
        assert!(float(0.7).converted(Scalar::Int).zero);
        assert!(!float(-1.2).converted(Scalar::Int).zero);
    }

    #[test]
    fn bits_and_remainders_are_bounded() {
        let int = Interval::of_type(TypeId::INT).unwrap();
        let number = |number: i32| Interval::literal(Scalar::Int, number as u32);
        let bounds = |interval: Interval| (interval.min, interval.max);
        assert_eq!(bounds(int.binary(Binary::And, number(7), Scalar::Int)), (0.0, 7.0));
        assert_eq!(int.binary(Binary::And, number(-2), Scalar::Int), Interval::ANY);
        assert_eq!(bounds(int.binary(Binary::Modulo, number(5), Scalar::Int)), (0.0, 4.0));
        assert_eq!(bounds(number(-5).binary(Binary::ShiftRight, number(1), Scalar::Int)), (-3.0, -3.0));
        assert_eq!(bounds(int.binary(Binary::Add, number(1), Scalar::Int)), bounds(int), "it wraps");
        assert_eq!(number(3).compare(Binary::Less, number(4)), Some(true));
        assert_eq!(int.compare(Binary::Less, number(4)), None);
    }

    #[test]
    fn nan_bounds_allow_any_number() {
        assert_eq!(float(f32::NAN), Interval::ANY);
        let infinite = binary(float(f32::MAX), Binary::Multiply, float(f32::MAX));
        assert_eq!(binary(infinite, Binary::Subtract, infinite), Interval::ANY);
    }
}
