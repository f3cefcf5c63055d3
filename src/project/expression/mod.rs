//! Expressions over named numbers: conditions of passes (`when` in `eddy.toml`), sizes of passes in ISF files, and the
//! numbers of assertions.
//!
//! Owns the grammar, the parser and the evaluation. The operators and their precedence are GLSL's:
//!
//! ```text
//! expression = or ["?" expression ":" expression]
//! or         = and {"||" and}
//! and        = equality {"&&" equality}
//! equality   = comparison [("==" | "!=") comparison]
//! comparison = sum [("<" | "<=" | ">" | ">=") sum]
//! sum        = product {("+" | "-") product}
//! product    = signed {("*" | "/" | "%") signed}
//! signed     = ("!" | "-" | "+") signed | "(" expression ")" | call | name | number | "true" | "false"
//! call       = function "(" expression {"," expression} ")"
//! ```
//!
//! Names are letters, digits and `_`. A comparison is 1 or 0, and every number other than 0 is true. [`Syntax`] says
//! which parts a text may use.

mod parse;
#[cfg(test)]
mod tests;

use std::ops::{Range, RangeInclusive};

/// The part of the grammar that a text may use, and the precision of its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Syntax {
    /// A condition of a pass compares values and does not compute any: no `?`, sums, products, `+` signs and calls.
    /// Fractions are rounded to single precision, as in a shader.
    Condition,
    /// Everything except `%`, in double precision.
    Assertion,
    /// Everything, in double precision.
    Size,
}

/// An operator between two numbers.
#[derive(Debug)]
pub struct Operator {
    /// Its GLSL spelling.
    pub symbol: &'static str,
    value: fn(f64, f64) -> f64,
}

const fn operator(symbol: &'static str, value: fn(f64, f64) -> f64) -> Operator {
    Operator { symbol, value }
}

/// The operators by precedence, lowest first, and of one precedence those that start with another one before it.
static OPERATORS: [&[Operator]; 6] = [
    &[operator("||", |a, b| f64::from(a != 0.0 || b != 0.0))],
    &[operator("&&", |a, b| f64::from(a != 0.0 && b != 0.0))],
    &[operator("==", |a, b| f64::from(a == b)), operator("!=", |a, b| f64::from(a != b))],
    &[
        operator("<=", |a, b| f64::from(a <= b)),
        operator(">=", |a, b| f64::from(a >= b)),
        operator("<", |a, b| f64::from(a < b)),
        operator(">", |a, b| f64::from(a > b)),
    ],
    &[operator("+", |a, b| a + b), operator("-", |a, b| a - b)],
    &[operator("*", |a, b| a * b), operator("/", |a, b| a / b), operator("%", |a, b| a % b)],
];

/// A function of numbers.
#[derive(Debug)]
pub struct Function {
    pub name: &'static str,
    /// The numbers of arguments that it takes.
    arguments: RangeInclusive<usize>,
    value: fn(&[f64]) -> f64,
}

const fn function(name: &'static str, arguments: RangeInclusive<usize>, value: fn(&[f64]) -> f64) -> Function {
    Function { name, arguments, value }
}

/// Names and meanings are GLSL's, except that `mod` is never below 0. `min` and `max` take several numbers, and ignore NaN
/// as Rust's do.
static FUNCTIONS: [Function; 13] = [
    function("abs", 1..=1, |x| x[0].abs()),
    function("floor", 1..=1, |x| x[0].floor()),
    function("ceil", 1..=1, |x| x[0].ceil()),
    function("round", 1..=1, |x| x[0].round()),
    function("sqrt", 1..=1, |x| x[0].sqrt()),
    function("exp2", 1..=1, |x| x[0].exp2()),
    function("log", 1..=1, |x| x[0].ln()),
    function("log2", 1..=1, |x| x[0].log2()),
    function("pow", 2..=2, |x| x[0].powf(x[1])),
    function("mod", 2..=2, |x| x[0].rem_euclid(x[1])),
    function("min", 2..=usize::MAX, |x| x.iter().copied().fold(f64::NAN, f64::min)),
    function("max", 2..=usize::MAX, |x| x.iter().copied().fold(f64::NAN, f64::max)),
    // `f64::clamp` panics where the ends are exchanged or NaN.
    function("clamp", 3..=3, |x| {
        if x[0] < x[1] {
            x[1]
        } else if x[0] > x[2] {
            x[2]
        } else {
            x[0]
        }
    }),
];

/// A part of an expression.
#[derive(Clone, Debug)]
pub enum Term {
    Number(f64),
    Name(String),
    Not(Box<Term>),
    Negative(Box<Term>),
    Pair(&'static Operator, Box<Term>, Box<Term>),
    /// The second if the first is not 0, else the third.
    Choice(Box<[Term; 3]>),
    /// With as many arguments as the function takes.
    Call(&'static Function, Vec<Term>),
}

impl Term {
    fn value(&self, of: &dyn Fn(&str) -> f64) -> f64 {
        match self {
            Term::Number(number) => *number,
            Term::Name(name) => of(name),
            Term::Not(term) => f64::from(term.value(of) == 0.0),
            Term::Negative(term) => -term.value(of),
            Term::Pair(operator, left, right) => (operator.value)(left.value(of), right.value(of)),
            Term::Choice(parts) if parts[0].value(of) != 0.0 => parts[1].value(of),
            Term::Choice(parts) => parts[2].value(of),
            Term::Call(function, arguments) => {
                let values: Vec<f64> = arguments.iter().map(|term| term.value(of)).collect();
                (function.value)(&values)
            }
        }
    }
}

/// An error in the text of an expression.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}: {hint}")]
pub struct ExpressionError {
    /// A byte range of the text.
    pub range: Range<usize>,
    pub message: String,
    pub hint: String,
}

/// A parsed expression.
#[derive(Clone, Debug)]
pub struct Expression {
    root: Term,
    /// Every name with its byte range in the text.
    names: Vec<(String, Range<usize>)>,
}

impl Expression {
    /// Evaluates the expression. `of` returns the value of a name.
    pub fn value(&self, of: &dyn Fn(&str) -> f64) -> f64 {
        self.root.value(of)
    }

    /// Returns its value if it names nothing.
    pub fn constant(&self) -> Option<f64> {
        self.names.is_empty().then(|| self.value(&|_| f64::NAN))
    }

    pub fn root(&self) -> &Term {
        &self.root
    }

    /// Returns every name, in the order of the text, with its byte range.
    pub fn names(&self) -> &[(String, Range<usize>)] {
        &self.names
    }

    /// Returns whether it uses a name.
    pub fn has_name(&self, name: &str) -> bool {
        self.names.iter().any(|(own, _)| own == name)
    }
}

impl From<f64> for Expression {
    fn from(number: f64) -> Expression {
        Expression { root: Term::Number(number), names: Vec::new() }
    }
}
