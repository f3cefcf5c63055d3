//! The assignments of a trace that a probe can draw.

use crate::trace::{Event, Number, Trace};
use eddy_diag::Span;
use eddy_engine::Sources;
use eddy_glsl::Probe;
use std::collections::HashMap;

/// A value that is assigned to a variable, or to a part of one.
#[derive(Clone, Debug, PartialEq)]
pub struct Assignment {
    /// The GLSL spelling.
    pub name: String,
    /// The assigned expression.
    pub span: Span,
    /// The probe that draws the value.
    pub probe: Probe,
    /// The walker's value, one to four numbers.
    pub walker: Vec<Number>,
}

/// Returns the assignments in the order of the trace, except literals, and those whose expression a probe cannot
/// distinguish from another, as two in one macro.
pub fn assignments(sources: &Sources<'_>, index: usize, trace: &Trace) -> Vec<Assignment> {
    let steps = || {
        trace.steps.iter().filter_map(|step| match &step.event {
            Event::Set { name, value } if value.len() <= 4 => Some((step.span?, name, value)),
            _ => None,
        })
    };
    let mut spans: Vec<Span> = steps().map(|(span, ..)| span).collect();
    spans.sort_by_key(|span| (span.source.0, span.start, span.end));
    spans.dedup();
    let places = sources.probe_places(index, &spans);
    let places: HashMap<Span, (u32, usize)> =
        spans.into_iter().zip(places).filter_map(|(span, place)| Some((span, place?))).collect();
    let mut visits: HashMap<(Span, &str), u32> = HashMap::new();
    let mut found = Vec::new();
    for (span, name, value) in steps() {
        let Some(&(at, components)) = places.get(&span) else { continue };
        let visit = visits.entry((span, name)).or_default();
        if components == value.len() {
            let probe = Probe { source: span.source, at, visit: *visit };
            found.push(Assignment { name: name.clone(), span, probe, walker: value.clone() });
        }
        *visit += 1;
    }
    found
}
