//! Quantities that `//@probe` comments of a project request.

use super::quantity::Quantity;
use eddy_diag::{Diagnostic, Span};
use eddy_project::{self as project, PassName, Project, inspect_comments};

/// The reason why a number cannot be measured, and its fix.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unmeasured {
    pub why: String,
    pub hint: String,
}

/// A measuring comment, such as `//@probe sum(buffer_a.x)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Declared {
    /// The span of the text after the keyword, in the project's texts.
    pub span: Span,
    pub text: String,
    pub quantity: Result<Quantity, Unmeasured>,
}

impl Unmeasured {
    pub fn diagnostic(&self, span: Span) -> Diagnostic {
        Diagnostic::warning(span, format!("not measured: {}", self.why)).hint(self.hint.as_str())
    }
}

/// Returns the measuring comments of a project, in the order of its texts.
pub fn declared(project: &Project) -> Vec<Declared> {
    let mut all = Vec::new();
    for (id, source) in project.texts().iter() {
        for comment in inspect_comments(&source.text).into_iter().filter(|comment| comment.kind == "probe") {
            let (span, text) = (Span::new(id, comment.range), comment.argument.to_owned());
            all.push(Declared { span, quantity: quantity(project, &text), text });
        }
    }
    all
}

/// Returns the quantity that a comment names, if the project has it.
fn quantity(project: &Project, text: &str) -> Result<Quantity, Unmeasured> {
    let quantity = Quantity::parse(text).map_err(|why| Unmeasured {
        why,
        hint: "the form is //@probe sum(buffer_a.x), with sum, min, max, mean, rms, nonfinite, energy or roughness"
            .into(),
    })?;
    let key = quantity.pass.key();
    let Some(pass) = project.pass(&quantity.pass) else {
        let keys: Vec<&str> = project.passes.iter().map(|pass| pass.id.key()).collect();
        let hint = format!("the project's passes are {}", project::listed(&keys));
        return Err(Unmeasured { why: format!("there is no pass {key}"), hint });
    };
    let formats = pass.formats();
    let Some(format) = formats.get(quantity.target) else {
        let why = format!("{key} has no target {}", quantity.target);
        let hint = match formats.len() {
            1 => format!("it has one target, written {key}"),
            count => format!("it has {count} targets, numbered from 0"),
        };
        return Err(Unmeasured { why, hint });
    };
    match quantity.components.iter().copied().find(|component| *component >= format.components()) {
        Some(component) => Err(Unmeasured {
            why: format!("{key} does not store {}", ["x", "y", "z", "w"][component]),
            hint: format!("its format {} has {} of the four components", format.name(), format.components()),
        }),
        None => Ok(quantity),
    }
}

/// Returns how many components a target of a pass stores.
pub fn stored(project: &Project, pass: &PassName, target: usize) -> usize {
    let formats = project.pass(pass).map(|pass| pass.formats()).unwrap_or_default();
    formats.get(target).copied().unwrap_or_default().components()
}
