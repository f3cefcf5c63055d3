//! Walks a pixel of a pass and prints the values that its `//@print` comments request.

use super::terminal::one_line;
use crate::{
    debugger::trace::{Examiner, Number, TraceError, Traced},
    diag::escape_message,
    engine::{PassInputs, Pixels},
    project::{PassName, Project, Tab, inspect_comments},
};
use serde::Serialize;
use std::{fmt::Write, sync::Arc};

/// A comment, and its value at each evaluation.
#[derive(Debug, Serialize)]
pub(super) struct Printed {
    tab: String,
    line: usize,
    expression: String,
    /// The components of each value; null if it has no value.
    values: Vec<Option<Vec<Number>>>,
    /// The compiler's error if it has no value.
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
    /// True if there were more.
    cut: bool,
}

/// Walks again by statements if there are such comments.
pub(super) fn printed(
    project: &Project,
    pass: &PassName,
    frame: u32,
    (inputs, device): (&PassInputs, &Pixels),
    (x, y): (u32, u32),
) -> Result<Vec<Printed>, TraceError> {
    let asks = |tab: &Tab| {
        let text = project.source(tab).map_or("", |source| &source.text);
        inspect_comments(text).iter().any(|comment| comment.kind == "print")
    };
    let is_of_pass = |tab: &Tab| tab.pass().is_none_or(|of| of == pass);
    if !project.tabs().iter().filter(|tab| is_of_pass(tab)).any(asks) {
        return Ok(Vec::new());
    }
    let (width, height) = inputs.size;
    let place = [(x as f32 + 0.5) / width as f32, (y as f32 + 0.5) / height as f32];
    let traced = match Traced::new(project.clone(), pass, frame as i32, (inputs.clone(), device), place) {
        // No program of the pass runs for this pixel, so no comment is evaluated.
        Err(TraceError::Clear(_) | TraceError::Kept { .. } | TraceError::Boundary { .. }) => return Ok(Vec::new()),
        other => other?,
    };
    let all = Examiner::new(Arc::new(traced)).printed();
    Ok(all
        .into_iter()
        .map(|printed| Printed {
            tab: printed.tab.title(),
            line: printed.line + 1,
            expression: printed.expression,
            error: printed.values.iter().find_map(|(_, value)| value.as_ref().err().cloned()),
            values: printed.values.into_iter().map(|(_, value)| value.ok().map(|value| value.numbers)).collect(),
            cut: printed.is_cut,
        })
        .collect())
}

pub(super) fn words(all: &[Printed]) -> String {
    let mut out = String::new();
    for Printed { tab, line, expression, values, error, cut } in all {
        let _ = writeln!(out, "{}:{line}: {}", one_line(tab), one_line(expression));
        if let Some(error) = error {
            let _ = writeln!(out, "    {}", escape_message(error));
        }
        for (turn, value) in values.iter().enumerate() {
            let Some(numbers) = value else { continue };
            let list: Vec<String> = numbers.iter().map(Number::to_string).collect();
            let list = if list.len() == 1 { list[0].clone() } else { format!("({})", list.join(", ")) };
            let _ = writeln!(out, "    {:>5}  {list}", turn + 1);
        }
        if values.is_empty() {
            out.push_str("    never reached\n");
        }
        if *cut {
            out.push_str("    … and more\n");
        }
    }
    out
}
