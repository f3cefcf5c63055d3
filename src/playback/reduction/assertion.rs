//! Assertions about a quantity.

use super::{quantity::Quantity, reader::Reader};
use std::fmt;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Relation {
    Within(Tolerance),
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Tolerance {
    Absolute(f64),
    /// Relative to the expected value.
    Percent(f64),
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Expected {
    Value(f64),
    /// The quantity's value in the first frame that was measured.
    First,
}

/// An assertion: `sum(buffer_a.x) within 1e-4 of 1`, `mean(buffer_a.x) within 1% of first`, `max(image) <= 1`,
/// `nonfinite(buffer_b) == 0`.
#[derive(Clone, Debug, PartialEq)]
pub struct Assertion {
    pub quantity: Quantity,
    relation: Relation,
    expected: Expected,
    /// The source text of the assertion.
    text: String,
}

/// An assertion that failed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "frame {frame}: {assertion} does not hold: it is {value}{}",
    first.map_or(String::new(), |x| format!(", and was {x} in the first frame"))
)]
pub struct Failure {
    pub assertion: String,
    pub frame: u32,
    pub value: f64,
    /// The first value, if that is the expected one.
    pub first: Option<f64>,
}

impl Assertion {
    /// Parses an assertion. Returns an error message if it is malformed.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut reader = Reader::new(text);
        let quantity = Quantity::read(&mut reader)?;
        let (relation, expected) = claim(&mut reader)?;
        reader.end()?;
        Ok(Self { quantity, relation, expected, text: text.trim().to_owned() })
    }

    /// Checks the assertion against the value of a frame and that of the first one. NaN fails every assertion.
    pub fn check(&self, frame: u32, value: f64, first: f64) -> Result<(), Failure> {
        let (expected, first) = match self.expected {
            Expected::Value(expected) => (expected, None),
            Expected::First => (first, Some(first)),
        };
        let within = |tolerance: f64| (value - expected).abs() <= tolerance || value == expected;
        let holds = match self.relation {
            Relation::Within(Tolerance::Absolute(tolerance)) => within(tolerance),
            Relation::Within(Tolerance::Percent(percent)) => within(percent / 100.0 * expected.abs()),
            Relation::Less => value < expected,
            Relation::LessEqual => value <= expected,
            Relation::Greater => value > expected,
            Relation::GreaterEqual => value >= expected,
            Relation::Equal => value == expected,
        };
        if holds { Ok(()) } else { Err(Failure { assertion: self.text.clone(), frame, value, first }) }
    }
}

fn claim(reader: &mut Reader<'_>) -> Result<(Relation, Expected), String> {
    // Longer operators first.
    const SIGNS: [(&str, Relation); 6] = [
        ("<=", Relation::LessEqual),
        (">=", Relation::GreaterEqual),
        ("==", Relation::Equal),
        ("=", Relation::Equal),
        ("<", Relation::Less),
        (">", Relation::Greater),
    ];
    if reader.has("within") {
        let number = reader.number("a tolerance")?;
        if number < 0.0 {
            return Err(format!("a tolerance must be at least 0, not {number}"));
        }
        let tolerance = if reader.has("%") { Tolerance::Percent(number) } else { Tolerance::Absolute(number) };
        reader.want("of", "after the tolerance")?;
        return Ok((Relation::Within(tolerance), expected(reader)?));
    }
    match SIGNS.into_iter().find(|(sign, _)| reader.has(sign)) {
        Some((_, relation)) => Ok((relation, expected(reader)?)),
        None => {
            Err(format!("expected `within TOLERANCE of VALUE`, or <, <=, >, >= or == and a value, {}", reader.found()))
        }
    }
}

fn expected(reader: &mut Reader<'_>) -> Result<Expected, String> {
    if reader.has("first") { Ok(Expected::First) } else { reader.number("a value").map(Expected::Value) }
}

impl fmt::Display for Assertion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}
