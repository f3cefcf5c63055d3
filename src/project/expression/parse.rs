//! The parser of expressions.

use super::{Expression, ExpressionError, FUNCTIONS, OPERATORS, Operator, Syntax, Term};
use crate::{limits, listed};
use std::ops::Range;

/// The levels of [`OPERATORS`] that do not chain: `1 < a < 3` is not a comparison in GLSL either. Conditions have none
/// after these.
const COMPARISONS: Range<usize> = 2..4;

impl Syntax {
    fn computes(self) -> bool {
        self != Syntax::Condition
    }

    /// Returns the word for such a text in messages.
    fn noun(self) -> &'static str {
        if self.computes() { "expression" } else { "condition" }
    }

    /// Returns the limit of nesting.
    fn depth(self) -> usize {
        if self == Syntax::Size { limits::ISF_DEPTH } else { limits::CONDITION_DEPTH }
    }
}

impl Expression {
    /// Parses a whole text, of at most [`limits::CONDITION`] letters.
    pub fn parse(text: &str, syntax: Syntax) -> Result<Expression, ExpressionError> {
        let noun = syntax.noun();
        if text.len() > limits::CONDITION {
            let message = format!("the {noun} is longer than {} letters, the limit", limits::CONDITION);
            return Err(error(0..text.len(), message, "compute the choice in a shader instead"));
        }
        if text.trim().is_empty() {
            return Err(error(0..text.len(), format!("the {noun} is empty"), "write for example \"quality > 1\""));
        }
        let mut parser = Parser { text, syntax, at: 0, depth: 0, names: Vec::new() };
        let root = parser.choice()?;
        parser.skip_blanks();
        match parser.rest().chars().next() {
            None => Ok(Expression { root, names: parser.names }),
            Some(c) => Err(parser.unexpected(c)),
        }
    }

    /// Parses the longest expression that a text starts with. Returns it with its length in bytes.
    pub fn parse_start(text: &str, syntax: Syntax) -> Result<(Expression, usize), ExpressionError> {
        let mut parser = Parser { text, syntax, at: 0, depth: 0, names: Vec::new() };
        let root = parser.choice()?;
        Ok((Expression { root, names: parser.names }, parser.at))
    }
}

fn error(range: Range<usize>, message: impl Into<String>, hint: impl Into<String>) -> ExpressionError {
    ExpressionError { range, message: message.into(), hint: hint.into() }
}

struct Parser<'t> {
    text: &'t str,
    syntax: Syntax,
    at: usize,
    depth: usize,
    names: Vec<(String, Range<usize>)>,
}

impl<'t> Parser<'t> {
    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    fn skip_blanks(&mut self) {
        self.at = self.text.len() - self.rest().trim_start().len();
    }

    /// Consumes a symbol if it comes next. Blanks before another one are not consumed.
    fn takes(&mut self, symbol: &str) -> bool {
        let rest = self.rest().trim_start().strip_prefix(symbol);
        self.at = rest.map_or(self.at, |rest| self.text.len() - rest.len());
        rest.is_some()
    }

    /// Consumes an operator of a level if it comes next.
    fn operator(&mut self, level: &'static [Operator]) -> Option<&'static Operator> {
        let has_remainder = self.syntax == Syntax::Size;
        let is_used = |operator: &&Operator| operator.symbol != "%" || has_remainder;
        level.iter().filter(is_used).find(|operator| self.takes(operator.symbol))
    }

    /// Parses something that is nested.
    fn nested(
        &mut self,
        parse: impl FnOnce(&mut Self) -> Result<Term, ExpressionError>,
    ) -> Result<Term, ExpressionError> {
        self.depth += 1;
        let most = self.syntax.depth();
        if self.depth > most {
            let what = if self.syntax.computes() { "parentheses, signs and choices" } else { "parentheses and signs" };
            return Err(error(self.at..self.at, format!("more than {most} {what} in one another"), "write it simpler"));
        }
        let term = parse(self)?;
        self.depth -= 1;
        Ok(term)
    }

    /// Parses an expression.
    fn choice(&mut self) -> Result<Term, ExpressionError> {
        let condition = self.level(0)?;
        if !(self.syntax.computes() && self.takes("?")) {
            return Ok(condition);
        }
        let mark = self.at - 1..self.at;
        self.nested(|parser| {
            let yes = parser.choice()?;
            if !parser.takes(":") {
                return Err(error(mark, "this ? has no :", "write CONDITION ? A : B"));
            }
            Ok(Term::Choice(Box::new([condition, yes, parser.choice()?])))
        })
    }

    /// Parses operators of a level and of all levels that bind more tightly.
    fn level(&mut self, level: usize) -> Result<Term, ExpressionError> {
        let levels = if self.syntax.computes() { &OPERATORS[..] } else { &OPERATORS[..COMPARISONS.end] };
        let Some(operators) = levels.get(level) else { return self.nested(Self::signed) };
        let mut left = self.level(level + 1)?;
        let mut has_one = false;
        while let Some(operator) = self.operator(operators) {
            let symbol = operator.symbol;
            if has_one && COMPARISONS.contains(&level) {
                let message = format!("a comparison has two sides, and this is a second {symbol}");
                let hint = "write two comparisons with && between them";
                return Err(error(self.at - symbol.len()..self.at, message, hint));
            }
            has_one = true;
            let right = self.level(level + 1)?;
            left = Term::Pair(operator, Box::new(left), Box::new(right));
        }
        Ok(left)
    }

    /// Parses signs and parenthesised expressions.
    fn signed(&mut self) -> Result<Term, ExpressionError> {
        self.skip_blanks();
        let from = self.at;
        if self.takes("!") {
            Ok(Term::Not(Box::new(self.nested(Self::signed)?)))
        } else if self.takes("-") {
            Ok(Term::Negative(Box::new(self.nested(Self::signed)?)))
        } else if self.syntax.computes() && self.takes("+") {
            self.nested(Self::signed)
        } else if self.takes("(") {
            let inner = self.choice()?;
            self.close(from)?;
            Ok(inner)
        } else {
            self.value()
        }
    }

    /// Consumes the parenthesis that closes the one at `open`.
    fn close(&mut self, open: usize) -> Result<(), ExpressionError> {
        if self.takes(")") {
            return Ok(());
        }
        Err(error(open..open + 1, "this parenthesis is not closed", "write ) where it ends"))
    }

    fn value(&mut self) -> Result<Term, ExpressionError> {
        let (from, rest) = (self.at, self.rest());
        let Some(first) = rest.chars().next() else {
            let message = format!("the {} ends where a value must follow", self.syntax.noun());
            return Err(error(from..from, message, "write a number or the name of a uniform after it"));
        };
        if first.is_ascii_digit() || first == '.' {
            return self.number();
        }
        if !(first.is_ascii_alphabetic() || first == '_') {
            return Err(self.unexpected(first));
        }
        let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
        self.at += end;
        match &rest[..end] {
            "true" => Ok(Term::Number(1.0)),
            "false" => Ok(Term::Number(0.0)),
            name if self.syntax.computes() && self.takes("(") => self.call(name, from..from + end),
            name => {
                self.names.push((name.to_owned(), from..self.at));
                Ok(Term::Name(name.to_owned()))
            }
        }
    }

    /// Parses the arguments of a function after its parenthesis.
    fn call(&mut self, name: &str, place: Range<usize>) -> Result<Term, ExpressionError> {
        let open = self.at - 1;
        let Some(function) = FUNCTIONS.iter().find(|function| function.name == name) else {
            let known = FUNCTIONS.each_ref().map(|function| function.name);
            return Err(error(place, format!("there is no function {name}"), format!("there are {}", listed(&known))));
        };
        let mut arguments = vec![self.choice()?];
        while self.takes(",") {
            arguments.push(self.choice()?);
        }
        self.close(open)?;
        if !function.arguments.contains(&arguments.len()) {
            let (least, most) = (function.arguments.start(), function.arguments.end());
            let hint = format!("it takes {least}{}", if most > least { " or more" } else { "" });
            return Err(error(place, format!("{name} does not take {} arguments", arguments.len()), hint));
        }
        Ok(Term::Call(function, arguments))
    }

    fn number(&mut self) -> Result<Term, ExpressionError> {
        let (from, rest) = (self.at, self.rest());
        let mut end = 0;
        for (at, c) in rest.char_indices() {
            let is_sign_of_exponent = matches!(c, '+' | '-') && rest[..at].ends_with(['e', 'E']);
            // Two dots are between the ends of a range.
            if !(c.is_ascii_alphanumeric() || c == '.' || is_sign_of_exponent) || rest[at..].starts_with("..") {
                break;
            }
            end = at + c.len_utf8();
        }
        self.at += end;
        let written = &rest[..end];
        let digits = written.strip_suffix(['f', 'F']).unwrap_or(written);
        let number = digits.parse::<f64>().ok().filter(|number| number.is_finite() || self.syntax.computes());
        let Some(number) = number.filter(|_| !digits.contains(|c: char| c.is_ascii_alphabetic() && !"eE".contains(c)))
        else {
            let message = format!("{written} is not a number");
            return Err(error(from..self.at, message, "write for example 3, 0.5 or 1e-4"));
        };
        // An integer may be compared with an int, which single precision cannot represent exactly.
        let is_exact = self.syntax.computes() || number.fract() == 0.0;
        Ok(Term::Number(if is_exact { number } else { f64::from(number as f32) }))
    }

    fn unexpected(&self, c: char) -> ExpressionError {
        let (from, rest) = (self.at, self.rest());
        let word = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
        let range = from..from + word.max(c.len_utf8());
        let hint = match &rest[..word.max(c.len_utf8())] {
            "=" => "write == to compare",
            "&" | "and" => "write && for and",
            "|" | "or" => "write || for or",
            "not" => "write ! for not",
            ")" => "remove it, or write ( where it begins",
            _ if self.syntax.computes() => {
                "an expression has numbers, names, functions, parentheses and operators as in GLSL"
            }
            "+" | "*" | "/" | "%" => "a condition compares values and does not compute any",
            _ => "a condition has ||, &&, ==, !=, <, <=, >, >=, !, parentheses, numbers and names of uniforms",
        };
        let message = format!("{} is not expected here", &rest[..word.max(c.len_utf8())].escape_debug());
        error(range, message, hint)
    }
}
