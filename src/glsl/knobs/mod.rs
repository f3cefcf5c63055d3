//! Numbers of a program on which its amount of work depends: what bounds its loops, their steps, and what ends them.
//!
//! Owns the rules by which a number counts as one ([`Role`]) and the place of its text ([`Number::span`]). Works
//! on the syntax tree, where numbers and names are as the author wrote them: the checker folds constants. Values are
//! followed through macros, constants, variables and parameters of functions, without regard to the order of
//! assignments: what a number may reach counts.

mod find;
mod flow;
#[cfg(test)]
mod tests;

use crate::{
    parse,
    source::{PassSource, Text},
    stack::on_deep_stack,
};
use eddy_diag::{SourceId, Span};

/// The type in which a number is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NumberType {
    Int,
    Uint,
    Float,
}

impl NumberType {
    /// Returns a value as a literal of this type. Integers are rounded, and floats have a decimal point.
    pub fn literal(self, value: f64) -> String {
        match self {
            NumberType::Int => format!("{}", value.round() as i64),
            NumberType::Uint => format!("{}u", value.round().max(0.0) as u64),
            NumberType::Float => {
                let text = format!("{}", value as f32);
                if text.contains('.') { text } else { text + ".0" }
            }
        }
    }
}

/// The declaration of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Declared {
    /// `#define NAME 64`
    Macro,
    /// `const int NAME = 64;`
    Const,
    /// `int name = 64;`, a variable or a global.
    Variable,
    /// A number in place, as in `i < 64`.
    Literal,
    /// A custom uniform: the span is that of its use, and there is no value.
    Uniform,
}

/// The effect of a number on the amount of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RoleKind {
    /// It bounds the iterations of a loop.
    LoopBound,
    /// It is the step of a loop's counter, or of what a loop's end depends on.
    LoopStep,
    /// A loop ends when a quantity is below it: a tolerance.
    Tolerance,
    /// A loop ends when a quantity is above it: a distance.
    Distance,
    /// It sizes an array.
    ArraySize,
    /// An `#if` compares it.
    Condition,
    /// An `#ifdef`, or `defined`, asks whether it exists.
    Switch,
}

/// One place where a number has an effect on the amount of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Role {
    pub kind: RoleKind,
    /// A larger number means more work; otherwise a smaller one does.
    pub grows: bool,
    /// The expression, in the author's text.
    pub at: Span,
}

impl Role {
    /// Returns whether the number decides by this role how often code runs.
    pub fn is_work(&self) -> bool {
        !matches!(self.kind, RoleKind::ArraySize | RoleKind::Condition | RoleKind::Switch)
    }
}

/// A number of a program, or a custom uniform that acts as one.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// The macro, constant or variable; empty for a literal in place.
    pub name: String,
    pub declared: Declared,
    /// The characters of the number in its text.
    pub span: Span,
    pub value: f64,
    pub ty: NumberType,
    /// In the order of the text. Numbers with a name are listed even without any.
    pub roles: Vec<Role>,
}

/// Returns the numbers of a pass: each that a macro or a constant names, and each other that has a [`Role`], in the order
/// of their texts. Texts with errors give what can be read.
pub fn numbers(source: &PassSource<'_>) -> Vec<Number> {
    let mut found = on_deep_stack(|| numbers_here(source));
    // A loop that `#if AA > 1` leaves out appears with a larger number.
    for number in &mut found {
        let is_hidden = number.declared == Declared::Macro
            && number.ty == NumberType::Int
            && number.roles.iter().any(|role| role.kind == RoleKind::Condition)
            && !number.roles.iter().any(Role::is_work);
        if !is_hidden {
            continue;
        }
        let raised = [2.0, 4.0].map(|factor| (number.value * factor).max(factor));
        let (span, key) = (number.span, number.span.start);
        for value in raised {
            let with = on_deep_stack(|| with_number(source, span, &NumberType::Int.literal(value), numbers_here));
            let same = with.into_iter().find(|other| (other.span.source, other.span.start) == (span.source, key));
            let mut roles = same.map_or_else(Vec::new, |number| number.roles);
            roles.retain(Role::is_work);
            if !roles.is_empty() {
                let grown = NumberType::Int.literal(value).len() as i64 - i64::from(span.end - span.start);
                let back = |at: u32| if at > key { (i64::from(at) - grown).max(0) as u32 } else { at };
                for role in &mut roles {
                    if role.at.source == span.source {
                        role.at = Span { start: back(role.at.start), end: back(role.at.end), ..role.at };
                    }
                }
                number.roles.extend(roles);
                break;
            }
        }
    }
    found
}

fn numbers_here(source: &PassSource<'_>) -> Vec<Number> {
    let parsed = parse::parse(source, None);
    find::Finder::new(&parsed.ast, &parsed.origins, &parsed.names, source).numbers()
}

/// Calls `work` with the pass whose text has another number at a place.
fn with_number<T>(source: &PassSource<'_>, span: Span, number: &str, work: impl FnOnce(&PassSource<'_>) -> T) -> T {
    let replaced = |text: &str| {
        let mut text = text.to_owned();
        text.replace_range(span.range(), number);
        text
    };
    match source.common.filter(|common| common.id == span.source) {
        Some(common) => {
            let text = replaced(common.text);
            work(&PassSource { common: Some(Text { id: common.id, text: &text }), ..*source })
        }
        None if source.code.id == span.source => {
            let text = replaced(source.code.text);
            work(&PassSource { code: Text { id: source.code.id, text: &text }, ..*source })
        }
        None => work(source),
    }
}

/// Returns a text of a pass.
fn text_of<'a>(source: &PassSource<'a>, id: SourceId) -> Option<&'a str> {
    let own = source.common.into_iter().chain([source.code]).find(|text| text.id == id);
    let included = || source.includes.iter().filter_map(|include| include.text.ok()).find(|text| text.id == id);
    own.or_else(included).map(|text| text.text)
}
