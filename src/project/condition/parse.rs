//! The parser of conditions.

use super::{ConditionError, Operator, Term};
use crate::limits;
use std::ops::Range;

/// The binary operators by precedence, lowest first. Comparisons do not chain: `1 < a < 3` is not a comparison in GLSL
/// either.
const LEVELS: [&[Operator]; 4] = [
    &[Operator::Or],
    &[Operator::And],
    &[Operator::Equal, Operator::NotEqual],
    &[Operator::LessEqual, Operator::GreaterEqual, Operator::Less, Operator::Greater],
];

type Names = Vec<(String, Range<usize>)>;

/// Parses a whole text. Returns its terms, and every name with its range.
pub(super) fn parse(text: &str) -> Result<(Term, Names), ConditionError> {
    let mut parser = Parser { text, at: 0, depth: 0, names: Vec::new() };
    if text.len() > limits::CONDITION {
        let message = format!("the condition is longer than {} letters, the limit", limits::CONDITION);
        return Err(parser.error(0..text.len(), message, "compute the choice in a shader instead"));
    }
    if text.trim().is_empty() {
        return Err(parser.error(0..text.len(), "the condition is empty", "write for example \"quality > 1\""));
    }
    let root = parser.level(0)?;
    parser.skip_blanks();
    match parser.rest().chars().next() {
        None => Ok((root, parser.names)),
        Some(c) => Err(parser.unexpected(c)),
    }
}

struct Parser<'t> {
    text: &'t str,
    at: usize,
    depth: usize,
    names: Names,
}

impl<'t> Parser<'t> {
    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    fn skip_blanks(&mut self) {
        self.at = self.text.len() - self.rest().trim_start().len();
    }

    fn error(&self, range: Range<usize>, message: impl Into<String>, hint: impl Into<String>) -> ConditionError {
        ConditionError { range, message: message.into(), hint: hint.into() }
    }

    /// Consumes a symbol if it comes next.
    fn takes(&mut self, symbol: &str) -> bool {
        self.skip_blanks();
        let is_next = self.rest().starts_with(symbol);
        if is_next {
            self.at += symbol.len();
        }
        is_next
    }

    /// Consumes an operator of a level if it comes next.
    fn operator(&mut self, level: &[Operator]) -> Option<Operator> {
        level.iter().copied().find(|operator| self.takes(operator.symbol()))
    }

    /// Parses operators of a level and of all levels that bind more tightly.
    fn level(&mut self, level: usize) -> Result<Term, ConditionError> {
        let Some(operators) = LEVELS.get(level) else { return self.sign() };
        let mut left = self.level(level + 1)?;
        let is_comparison = level >= 2;
        let mut has_one = false;
        while let Some(operator) = self.operator(operators) {
            let symbol = operator.symbol();
            if has_one && is_comparison {
                let message = format!("a comparison has two sides, and this is a second {symbol}");
                let hint = "write two comparisons with && between them";
                return Err(self.error(self.at - symbol.len()..self.at, message, hint));
            }
            has_one = true;
            let right = self.level(level + 1)?;
            left = Term::Pair(operator, Box::new(left), Box::new(right));
        }
        Ok(left)
    }

    /// Parses `!`, `-` and parenthesised expressions.
    fn sign(&mut self) -> Result<Term, ConditionError> {
        self.depth += 1;
        if self.depth > limits::CONDITION_DEPTH {
            let message = format!("more than {} parentheses and signs in one another", limits::CONDITION_DEPTH);
            return Err(self.error(self.at..self.at, message, "write it simpler"));
        }
        self.skip_blanks();
        let start = self.at;
        let term = if self.takes("!") {
            Term::Not(Box::new(self.sign()?))
        } else if self.takes("-") {
            Term::Negative(Box::new(self.sign()?))
        } else if self.takes("(") {
            let inner = self.level(0)?;
            if !self.takes(")") {
                let open = start..start + 1;
                return Err(self.error(open, "this parenthesis is not closed", "write ) where it ends"));
            }
            inner
        } else {
            self.value()?
        };
        self.depth -= 1;
        Ok(term)
    }

    fn value(&mut self) -> Result<Term, ConditionError> {
        self.skip_blanks();
        let (start, rest) = (self.at, self.rest());
        let Some(first) = rest.chars().next() else {
            let hint = "write a number or the name of a uniform after it";
            return Err(self.error(start..start, "the condition ends where a value must follow", hint));
        };
        if first.is_ascii_digit() || first == '.' {
            return self.number();
        }
        if !(first.is_ascii_alphabetic() || first == '_') {
            return Err(self.unexpected(first));
        }
        let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
        self.at += end;
        Ok(match &rest[..end] {
            "true" => Term::Number(1.0),
            "false" => Term::Number(0.0),
            name => {
                self.names.push((name.to_owned(), start..self.at));
                Term::Name(name.to_owned())
            }
        })
    }

    fn number(&mut self) -> Result<Term, ConditionError> {
        let (start, rest) = (self.at, self.rest());
        let mut end = 0;
        for (at, c) in rest.char_indices() {
            let is_sign_of_exponent = matches!(c, '+' | '-') && rest[..at].ends_with(['e', 'E']);
            if !(c.is_ascii_alphanumeric() || c == '.' || is_sign_of_exponent) {
                break;
            }
            end = at + c.len_utf8();
        }
        self.at += end;
        let written = &rest[..end];
        let digits = written.strip_suffix(['f', 'F']).unwrap_or(written);
        let number = digits.parse::<f64>().ok().filter(|number| number.is_finite());
        let Some(number) = number.filter(|_| !digits.contains(|c: char| c.is_ascii_alphabetic() && !"eE".contains(c)))
        else {
            let message = format!("{written} is not a number");
            return Err(self.error(start..self.at, message, "write for example 3, 0.5 or 1e-4"));
        };
        // An integer may be compared with an int, which single precision cannot represent exactly.
        Ok(Term::Number(if number.fract() == 0.0 { number } else { f64::from(number as f32) }))
    }

    fn unexpected(&self, c: char) -> ConditionError {
        let (start, rest) = (self.at, self.rest());
        let word = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
        let range = start..start + word.max(c.len_utf8());
        let hint = match &rest[..word.max(c.len_utf8())] {
            "=" => "write == to compare",
            "&" | "and" => "write && for and",
            "|" | "or" => "write || for or",
            "not" => "write ! for not",
            ")" => "remove it, or write ( where it begins",
            "+" | "*" | "/" | "%" => "a condition compares values and does not compute any",
            _ => "a condition has ||, &&, ==, !=, <, <=, >, >=, !, parentheses, numbers and names of uniforms",
        };
        let message = format!("{} is not expected here", &rest[..word.max(c.len_utf8())].escape_debug());
        self.error(range, message, hint)
    }
}
