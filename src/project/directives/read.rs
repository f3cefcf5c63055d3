//! The directives of one pass, combined.

use super::{
    around::{DirectiveScope, is_channel},
    line,
};
use crate::{Bindings, lines::hash_lines};
use eddy_diag::{Diagnostic, SourceId, Span};
use std::collections::BTreeMap;

/// The directives of one pass.
#[derive(Debug, Default)]
pub(crate) struct Declared {
    /// `None` if no directive declares a channel's input.
    pub channels: Option<Bindings>,
    /// The line that declares each channel's input.
    pub places: BTreeMap<usize, Span>,
    pub diagnostics: Vec<Diagnostic>,
}

/// Reads the directives of a pass. `default`: the inputs of its channels if no directive declares one.
pub(crate) fn read(text: &str, source: SourceId, around: DirectiveScope<'_>, default: &Bindings) -> Declared {
    let mut found = Declared::default();
    // Inputs first, then settings: a setting may come before the line that names the input.
    let mut settings: Vec<(usize, &str, &str, Span)> = Vec::new();
    let mut channels = Bindings::default();
    let mut is_any = false;
    for line in hash_lines(text).into_iter().filter(is_channel) {
        let span = Span::new(source, line.range.clone());
        match line::parse(&line) {
            Ok((n, None, value)) => {
                is_any = true;
                let read = line::input(value, around, span, &mut found.diagnostics);
                if let Some(&earlier) = found.places.get(&n)
                    && channels.get(n) != read.as_ref()
                {
                    let message = format!("another line already sets iChannel{n}: only this one is used");
                    let twice = Diagnostic::warning(span, message).label(earlier, "this line is ignored");
                    found.diagnostics.push(twice.hint("remove one of them"));
                }
                channels.set(n, read);
                found.places.insert(n, span);
            }
            Ok((n, Some(setting), value)) => settings.push((n, setting, value, span)),
            Err(diagnostic) => found.diagnostics.push(diagnostic(span)),
        }
    }
    if !is_any {
        channels = default.clone();
    }
    for (n, setting, value, span) in settings {
        match channels.get_mut(n) {
            Some(channel) => {
                line::set(channel, setting, value, span, &mut found.diagnostics);
                is_any = true;
            }
            // The input is invalid, which was reported.
            None if found.places.contains_key(&n) => {}
            None => found.diagnostics.push(
                Diagnostic::warning(span, format!("iChannel{n} has no input, so this line is ignored"))
                    .hint(format!("add its input: #iChannel{n} \"buffer_a\"")),
            ),
        }
    }
    found.channels = is_any.then_some(channels);
    found
}
