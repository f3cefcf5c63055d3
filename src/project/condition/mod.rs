//! The condition of a pass (`when` in `eddy.toml`): an expression over the author's own uniforms and the size of the
//! picture that is evaluated each frame and decides whether the pass is drawn.
//!
//! Owns the names that it may use, its value, and the diagnostics about unknown names. The grammar is that of
//! [`Syntax::Condition`].

#[cfg(test)]
mod tests;

use super::{
    CustomUniform, CustomUniformType, CustomUniforms, Expression, ExpressionError, Project, Syntax, Term, Written,
    fill_texts::FillText, listed,
};
use eddy_diag::{Diagnostic, Span};
use std::{fmt, sync::Arc};

/// The names of the width and the height of the picture in pixels. A uniform of the author's with the same name takes
/// precedence.
const CANVAS: [&str; 2] = ["width", "height"];

/// An expression that decides whether a pass is drawn, and its place in `eddy.toml`.
#[derive(Clone, Debug)]
pub struct Condition {
    text: Arc<str>,
    expression: Expression,
    /// `None` if created in code.
    written: Option<Written>,
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
    pub fn parse(text: &str) -> Result<Condition, ExpressionError> {
        Ok(Condition { text: text.into(), expression: Expression::parse(text, Syntax::Condition)?, written: None })
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
        self.expression.root()
    }

    /// Evaluates the condition. `value` returns the value of a uniform, or `None` if no uniform has the name; unknown
    /// names are 0.
    pub fn holds(&self, value: &dyn Fn(&str) -> Option<f64>, canvas: (u32, u32)) -> bool {
        let of_canvas = |name: &str| match name {
            "width" => f64::from(canvas.0),
            "height" => f64::from(canvas.1),
            _ => 0.0,
        };
        self.expression.value(&|name| value(name).unwrap_or_else(|| of_canvas(name))) != 0.0
    }

    /// Returns whether it uses a uniform.
    pub fn names(&self, uniform: &str) -> bool {
        self.expression.has_name(uniform)
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
            for (name, range) in condition.expression.names() {
                let (message, hint) = match uniforms.get(name) {
                    Some(uniform) if uniform.ty.components() == 1 => continue,
                    Some(uniform) => several_numbers(uniform),
                    None if CANVAS.contains(&name.as_str()) => continue,
                    None => uniforms.unknown(name, &CANVAS, "a condition can name"),
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
