//! The condition of a pass (`when` in `eddy.toml`): an expression over the author's own uniforms and the size of the
//! picture that is evaluated each frame and decides whether the pass is drawn.
//!
//! Owns its form, its evaluation, and the diagnostics about unknown names. The grammar is GLSL's: `||`, `&&`, `==`
//! `!=`, `<` `<=` `>` `>=`, `!` `-`, parentheses, numbers, `true`, `false` and names, in this order of precedence.
//! Numbers are compared in single precision, as in a shader.

mod parse;
#[cfg(test)]
mod tests;

use super::{
    CustomUniform, CustomUniformType, CustomUniforms, Project, Written, fill_texts::FillText, listed, nearest,
};
use eddy_diag::{Diagnostic, Span};
use std::{fmt, ops::Range, sync::Arc};

/// The names of the width and the height of the picture in pixels. A uniform of the author's with the same name takes
/// precedence.
const CANVAS: [&str; 2] = ["width", "height"];

/// An expression that decides whether a pass is drawn, and its place in `eddy.toml`.
#[derive(Clone, Debug)]
pub struct Condition {
    text: Arc<str>,
    root: Term,
    /// Every name with its byte range in the text.
    names: Vec<(String, Range<usize>)>,
    /// `None` if created in code.
    written: Option<Written>,
}

/// A part of a condition.
#[derive(Clone, Debug, PartialEq)]
pub enum Term {
    Number(f64),
    /// A uniform, or `width` or `height`.
    Name(String),
    Not(Box<Term>),
    Negative(Box<Term>),
    Pair(Operator, Box<Term>, Box<Term>),
}

/// An operator between two terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    Or,
    And,
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
}

impl Operator {
    /// Returns its GLSL spelling.
    pub fn symbol(self) -> &'static str {
        match self {
            Operator::Or => "||",
            Operator::And => "&&",
            Operator::Equal => "==",
            Operator::NotEqual => "!=",
            Operator::Less => "<",
            Operator::LessEqual => "<=",
            Operator::Greater => ">",
            Operator::GreaterEqual => ">=",
        }
    }

    fn holds(self, left: f64, right: f64) -> bool {
        match self {
            Operator::Or => left != 0.0 || right != 0.0,
            Operator::And => left != 0.0 && right != 0.0,
            Operator::Equal => left == right,
            Operator::NotEqual => left != right,
            Operator::Less => left < right,
            Operator::LessEqual => left <= right,
            Operator::Greater => left > right,
            Operator::GreaterEqual => left >= right,
        }
    }
}

impl Term {
    /// Evaluates the term; a comparison is 1 or 0.
    fn value(&self, of: &dyn Fn(&str) -> f64) -> f64 {
        match self {
            Term::Number(number) => *number,
            Term::Name(name) => of(name),
            Term::Not(term) => f64::from(term.value(of) == 0.0),
            Term::Negative(term) => -term.value(of),
            Term::Pair(operator, left, right) => f64::from(operator.holds(left.value(of), right.value(of))),
        }
    }
}

/// An error in the text of a condition.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}: {hint}")]
pub struct ConditionError {
    /// A byte range of the text.
    pub range: Range<usize>,
    pub message: String,
    pub hint: String,
}

/// Conditions are equal if their expressions are, wherever they are written.
impl PartialEq for Condition {
    fn eq(&self, other: &Condition) -> bool {
        self.text == other.text
    }
}

impl Eq for Condition {}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl Condition {
    /// Parses an expression.
    pub fn parse(text: &str) -> Result<Condition, ConditionError> {
        let (root, names) = parse::parse(text)?;
        Ok(Condition { text: text.into(), root, names, written: None })
    }

    /// Returns the same condition with its place in a manifest.
    #[must_use]
    pub(super) fn at(self, written: Option<Written>) -> Condition {
        Condition { written, ..self }
    }

    /// Returns the expression's source text.
    pub fn text(&self) -> &str {
        &self.text
    }

    pub fn root(&self) -> &Term {
        &self.root
    }

    /// Evaluates the condition. `value` returns the value of a uniform, or `None` if no uniform has the name; unknown
    /// names are 0.
    pub fn holds(&self, value: &dyn Fn(&str) -> Option<f64>, canvas: (u32, u32)) -> bool {
        let of_canvas = |name: &str| match name {
            "width" => f64::from(canvas.0),
            "height" => f64::from(canvas.1),
            _ => 0.0,
        };
        self.root.value(&|name| value(name).unwrap_or_else(|| of_canvas(name))) != 0.0
    }

    /// Returns whether it uses a uniform.
    pub fn names(&self, uniform: &str) -> bool {
        self.names.iter().any(|(name, _)| name == uniform)
    }
}

impl Project {
    /// Every condition with the index of its pass, in the order of [`Project::sources`].
    pub fn conditions(&self) -> impl Iterator<Item = (usize, &Condition)> {
        self.passes.iter().enumerate().filter_map(|(index, pass)| Some((index, pass.settings.when.as_ref()?)))
    }

    /// Returns the texts that contain conditions, by their ids in [`Project::sources`].
    pub(super) fn condition_texts(&self) -> impl Iterator<Item = FillText> {
        self.conditions().enumerate().map(|(n, (_, condition))| {
            let (text, range) = Written::located(&condition.text, condition.written.as_ref());
            FillText { id: self.condition_id(n), text, range }
        })
    }

    /// Returns errors for names that are not uniforms, and for uniforms with several components. Spans point into
    /// [`Project::sources`].
    pub fn check_conditions(&self, uniforms: &CustomUniforms) -> Vec<Diagnostic> {
        let mut found = Vec::new();
        for ((_, condition), text) in self.conditions().zip(self.condition_texts()) {
            for (name, range) in &condition.names {
                let (message, hint) = match uniforms.get(name) {
                    Some(uniform) if uniform.ty.components() == 1 => continue,
                    Some(uniform) => several_numbers(uniform),
                    None if CANVAS.contains(&name.as_str()) => continue,
                    None => unknown(name, uniforms),
                };
                let place = text.range.start + range.start..text.range.start + range.end;
                found.push(Diagnostic::error(Span::new(text.id, place), message).hint(hint));
            }
        }
        found
    }
}

fn several_numbers(uniform: &CustomUniform) -> (String, String) {
    let message = format!("`{}` is a {}; a condition compares single numbers", uniform.name, uniform.ty.name());
    let of_one = CustomUniformType::ALL.into_iter().filter(|ty| ty.components() == 1).map(CustomUniformType::name);
    (message, format!("use a uniform of one of the types {}", listed(&of_one.collect::<Vec<_>>())))
}

fn unknown(name: &str, uniforms: &CustomUniforms) -> (String, String) {
    let message = format!("no #iUniform line declares `{name}`");
    let known: Vec<&str> = uniforms.list.iter().map(|uniform| uniform.name.as_str()).chain(CANVAS).collect();
    let hint = match nearest(name, known.iter().copied()) {
        Some(near) => format!("did you mean {near}?"),
        None => format!("a condition can name {}", listed(&known)),
    };
    (message, hint)
}
