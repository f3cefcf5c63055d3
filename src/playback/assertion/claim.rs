//! The part of an assertion that says which values a quantity may have.

use super::reader::Reader;
use eddy_project::Expression;

/// The largest absolute value where a claim may fail, unless its own range is wider.
pub const EXCUSED_LIMIT: f64 = 1e4;

/// A comparison with a number.
type Comparison = fn(&f64, &f64) -> bool;

/// The signs of comparisons, longer ones first.
static SIGNS: [(&str, Comparison); 6] =
    [("<=", f64::le), (">=", f64::ge), ("==", f64::eq), ("=", f64::eq), ("<", f64::lt), (">", f64::gt)];

/// A claim, whose numbers are expressions (`N` is [`Expression`]) or known (`f64`).
#[derive(Clone, Copy, Debug)]
pub(super) enum Claim<N> {
    /// Both ends are included.
    In(N, N),
    /// A tolerance, in percent of the expected value if the flag is set, and the expected value.
    Within(N, bool, N),
    /// A sign, its comparison, and the expected value.
    Is(&'static str, Comparison, N),
}

impl Claim<Expression> {
    pub(super) fn read(reader: &mut Reader<'_>) -> Result<Self, String> {
        if reader.has("within") {
            let tolerance = reader.expression("a tolerance")?;
            if let Some(number) = tolerance.constant().filter(|number| *number < 0.0) {
                return Err(format!("a tolerance must be at least 0, not {number}"));
            }
            let is_percent = reader.has("%");
            reader.want("of", "after the tolerance")?;
            return Ok(Claim::Within(tolerance, is_percent, reader.expression("a value")?));
        }
        if reader.has("in") {
            let low = reader.expression("the low end of a range, as in 0..1")?;
            reader.want("..", "between the ends of the range")?;
            let high = reader.expression("the high end of a range, as in 0..1")?;
            return match (low.constant(), high.constant()) {
                (Some(low), Some(high)) if low > high => {
                    Err(format!("the low end {low} of the range is above the high end {high}: exchange them"))
                }
                _ => Ok(Claim::In(low, high)),
            };
        }
        match SIGNS.iter().find(|(sign, _)| reader.has(sign)) {
            Some((sign, compare)) => Ok(Claim::Is(sign, *compare, reader.expression("a value")?)),
            None => {
                Err(reader.expected("`within TOLERANCE of VALUE`, `in LOW..HIGH`, or <, <=, >, >= or == and a value"))
            }
        }
    }

    /// Returns its expressions.
    pub(super) fn expressions(&self) -> impl Iterator<Item = &Expression> {
        let (one, other) = match self {
            Claim::In(one, other) | Claim::Within(one, _, other) => (one, Some(other)),
            Claim::Is(_, _, one) => (one, None),
        };
        [one].into_iter().chain(other)
    }

    /// Evaluates its expressions.
    pub(super) fn evaluate(&self, value: impl Fn(&Expression) -> f64) -> Claim<f64> {
        match self {
            Claim::In(low, high) => Claim::In(value(low), value(high)),
            Claim::Within(tolerance, is_percent, expected) => {
                let (part, expected) = (value(tolerance), value(expected));
                Claim::Within(if *is_percent { part / 100.0 * expected.abs() } else { part }, false, expected)
            }
            Claim::Is(sign, compare, expected) => Claim::Is(sign, *compare, value(expected)),
        }
    }
}

/// The tolerance of an evaluated claim is in the unit of the expected value.
impl Claim<f64> {
    /// Returns the range of values, including both ends, in which it may hold.
    pub(super) fn ends(self) -> (f64, f64) {
        match self {
            Claim::In(low, high) => (low, high),
            Claim::Within(tolerance, _, expected) => (expected - tolerance, expected + tolerance),
            Claim::Is("<" | "<=", _, expected) => (f64::NEG_INFINITY, expected),
            Claim::Is(">" | ">=", _, expected) => (expected, f64::INFINITY),
            Claim::Is(_, _, expected) => (expected, expected),
        }
    }

    fn holds(self, value: f64) -> bool {
        match self {
            Claim::In(low, high) => value.is_finite() && (low..=high).contains(&value),
            Claim::Within(tolerance, _, expected) => (value - expected).abs() <= tolerance || value == expected,
            Claim::Is(_, compare, expected) => compare(&value, &expected),
        }
    }

    /// Returns the distance by which a value violates it, infinite if the value is not finite; 0 if it holds.
    pub(super) fn excess(self, value: f64) -> f64 {
        let (low, high) = self.ends();
        match (self.holds(value), value.is_finite()) {
            (true, _) => 0.0,
            (false, true) => (low - value).max(value - high).max(f64::MIN_POSITIVE),
            (false, false) => f64::INFINITY,
        }
    }
}
