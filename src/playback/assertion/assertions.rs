//! Assertions about a quantity.

use super::{
    claim::{Claim, EXCUSED_LIMIT},
    conditions::{Conditions, check_name, constant},
    find::{Found, Worst},
    quantity::Quantity,
    reader::{Reader, check_length},
    statements::{Numbers, Statements},
};
use eddy_engine::Pixels;
use eddy_project::{CustomUniforms, Expression};
use std::{fmt, sync::Arc};

/// An assertion: `sum(buffer_a.x) within 1e-4 of 1`, `mean(buffer_a.x) within 1% of first`, `max(image) <= 1`,
/// `buffer_b.rgb in 0..brightness because "a lamp has no more" unless wild because "a wild lamp flickers"`.
#[derive(Clone, Debug)]
pub struct Assertion {
    pub quantity: Quantity,
    claim: Claim<Expression>,
    /// The justification of the claim.
    reason: Option<Arc<str>>,
    /// The conditions under which it may fail, each with the reason.
    excuses: Vec<(Expression, Arc<str>)>,
    /// The numbers that its expressions may name.
    numbers: Arc<Numbers>,
    /// The source text of the quantity and the claim.
    text: String,
}

/// An assertion that failed.
#[derive(Clone, Debug, thiserror::Error)]
pub struct Failure {
    pub assertion: Box<Assertion>,
    pub frame: u32,
    pub worst: Worst,
    /// The value in the first frame.
    pub first: f64,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Worst { texel, value, count } = self.worst;
        write!(f, "frame {}: {} does not hold: it is {value}", self.frame, self.assertion)?;
        if let Some((x, y)) = texel {
            write!(f, " at texel {x},{y}")?;
        }
        if count > 1 {
            write!(f, ", the worst of {count} values")?;
        }
        if self.assertion.is_about_first() {
            write!(f, ", and was {} in the first frame", self.first)?;
        }
        self.assertion.reason.iter().try_for_each(|reason| write!(f, " ({reason})"))
    }
}

/// The values that an assertion allows in a situation, including both ends.
#[derive(Clone, Debug)]
pub struct Range {
    pub low: f64,
    pub high: f64,
    /// The reason why the claim may fail.
    pub excuse: Option<Arc<str>>,
}

impl Range {
    /// Returns whether a value outside is excused: it is finite, and no larger than [`EXCUSED_LIMIT`] or the range's end.
    pub fn excuses(&self, value: f64) -> bool {
        self.excuse.is_some() && value.is_finite() && value.abs() <= EXCUSED_LIMIT.max(self.high)
    }
}

impl Assertion {
    /// Parses an assertion, with `let` statements before it. Returns an error message if it is malformed.
    pub fn parse(text: &str) -> Result<Self, String> {
        check_length(text)?;
        let mut statements = Statements::default();
        // The line is that of the command.
        statements.read(text, &mut |_, _| Ok(false)).map_err(|error| error.message)?;
        let mut assertions = statements.into_assertions();
        match (assertions.pop(), assertions.is_empty()) {
            (Some(assertion), true) => Ok(assertion),
            (Some(_), false) => Err("these are several assertions: give each its own --assert".to_owned()),
            // With the message for a missing quantity.
            (None, _) => Assertion::read(&mut Reader::new(""), &Statements::default()),
        }
    }

    /// An assertion that a quantity is in a range, including both ends.
    pub fn in_range(quantity: Quantity, low: f64, high: f64, reason: &str) -> Assertion {
        let (text, claim) = (format!("{quantity} in {low}..{high}"), Claim::In(low.into(), high.into()));
        let (reason, excuses) = (Some(reason.into()), Vec::new());
        Assertion { quantity, claim, reason, excuses, numbers: Arc::default(), text }
    }

    pub(super) fn read(reader: &mut Reader<'_>, statements: &Statements) -> Result<Self, String> {
        let start = reader.at();
        let quantity = Quantity::read(reader, &|name| statements.pass(name))?;
        let claim = Claim::read(reader)?;
        let text = reader.since(start).to_owned();
        let reason = reader.has("because").then(|| statements.text(reader)).transpose()?;
        let mut excuses = Vec::new();
        while reader.has("unless") {
            let condition = reader.expression("a condition")?;
            reader.want("because", "and the reason in quotes after `unless CONDITION`")?;
            excuses.push((condition, statements.text(reader)?));
        }
        let assertion = Self { quantity, claim, reason, excuses, numbers: Arc::default(), text };
        if assertion.is_about_first() && assertion.quantity.reduction.is_none() {
            let values = assertion.quantity.values();
            return Err(format!("`first` is one number, and {values} has numbers for each texel: write max({values})"));
        }
        Ok(assertion)
    }

    pub(super) fn with(self, numbers: &Arc<Numbers>) -> Assertion {
        Assertion { numbers: numbers.clone(), ..self }
    }

    /// Returns the justification of the claim; empty if none is written.
    pub fn reason(&self) -> &str {
        self.reason.as_deref().unwrap_or_default()
    }

    fn expressions(&self) -> impl Iterator<Item = &Expression> {
        self.claim.expressions().chain(self.excuses.iter().map(|(condition, _)| condition))
    }

    /// Returns whether its range or its excuses depend on the situation.
    pub fn varies(&self) -> bool {
        self.expressions().flat_map(Expression::names).any(|(name, _)| constant(name).is_none())
    }

    /// Returns whether it compares with the first frame that was measured.
    pub fn is_about_first(&self) -> bool {
        self.expressions().any(|expression| expression.has_name("first"))
    }

    /// Fails for names that a project with these uniforms does not have, and for definitions of names that it has.
    pub fn check_names(&self, uniforms: &CustomUniforms) -> Result<(), String> {
        let check = |expression: &Expression, before: &[(String, Expression)]| {
            expression.names().iter().try_for_each(|(name, _)| {
                let is_known = name == "first" || constant(name).is_some() || before.iter().any(|(own, _)| own == name);
                if is_known { Ok(()) } else { check_name(name, uniforms) }
            })
        };
        for (at, (name, expression)) in self.numbers.iter().enumerate() {
            if uniforms.get(name).is_some() {
                return Err(format!("`let {name}`: the project has a uniform of this name, choose another one"));
            }
            check(expression, &self.numbers[..at])?;
        }
        self.expressions().try_for_each(|expression| check(expression, &self.numbers))
    }

    /// Evaluates the claim and finds the first excuse that applies.
    fn evaluate(&self, conditions: &Conditions, first: f64) -> (Claim<f64>, Range) {
        let mut numbers: Vec<(&str, f64)> = Vec::new();
        let value = |numbers: &[(&str, f64)], expression: &Expression| {
            expression.value(&|name| match numbers.iter().find(|(own, _)| *own == name) {
                Some((_, value)) => *value,
                None if name == "first" => first,
                None => constant(name).unwrap_or_else(|| conditions.value(name)),
            })
        };
        for (name, expression) in self.numbers.iter() {
            let number = value(&numbers, expression);
            numbers.push((name, number));
        }
        let claim = self.claim.evaluate(|expression| value(&numbers, expression));
        let excuse = self.excuses.iter().find(|(condition, _)| value(&numbers, condition) != 0.0);
        let (low, high) = claim.ends();
        (claim, Range { low, high, excuse: excuse.map(|(_, reason)| reason.clone()) })
    }

    /// Returns the values that it allows. It must not be about the first frame.
    pub fn range(&self, conditions: &Conditions) -> Range {
        self.evaluate(conditions, f64::NAN).1
    }

    /// Computes the quantity, and finds the values for which the claim fails, excused or not. `stored` is the number of
    /// components that the pass stores, `first` the value of the quantity in the first frame.
    pub fn find(&self, pixels: &Pixels, stored: usize, conditions: &Conditions, first: f64) -> (Found, Range) {
        let (claim, range) = self.evaluate(conditions, first);
        (self.quantity.find(pixels, stored, |value| claim.excess(value), range.low), range)
    }

    /// Checks the texels of a frame.
    pub fn check(
        &self,
        frame: u32,
        (pixels, stored): (&Pixels, usize),
        first: f64,
        conditions: &Conditions,
    ) -> Result<(), Failure> {
        let (found, range) = self.find(pixels, stored, conditions, first);
        match found.worst.filter(|worst| !range.excuses(worst.value)) {
            Some(worst) => Err(Failure { assertion: Box::new(self.clone()), frame, worst, first }),
            None => Ok(()),
        }
    }
}

impl fmt::Display for Assertion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}
