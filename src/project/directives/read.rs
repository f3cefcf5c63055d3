//! The directives of one pass, taken together.

use super::{
    around::{DirectiveScope, is_channel},
    line,
};
use crate::{Channel, lines::hash_lines};
use eddy_diag::{Diagnostic, SourceId, Span};

/// The directives of one pass.
#[derive(Debug, Default)]
pub(crate) struct Declared {
    /// `None` where no directive names what a channel reads.
    pub channels: Option<[Option<Channel>; 4]>,
    /// The line that says what each channel reads.
    pub places: [Option<Span>; 4],
    pub diagnostics: Vec<Diagnostic>,
}

/// Reads the directives of a pass. `default`: what its channels read where no directive says it.
pub(crate) fn read(
    text: &str,
    source: SourceId,
    around: DirectiveScope<'_>,
    default: &[Option<Channel>; 4],
) -> Declared {
    let mut found = Declared::default();
    // Inputs first, settings after: a setting may stand above the line that names the input.
    let mut settings: Vec<(usize, &str, &str, Span)> = Vec::new();
    let mut channels: [Option<Channel>; 4] = Default::default();
    let mut is_any = false;
    for line in hash_lines(text).into_iter().filter(is_channel) {
        let span = Span::new(source, line.range.clone());
        match line::parse(&line) {
            Ok((n, None, value)) => {
                is_any = true;
                let read = line::input(value, around, span, &mut found.diagnostics);
                if let Some(earlier) = found.places[n]
                    && channels[n] != read
                {
                    let message = format!("another line already sets iChannel{n}: only this one is used");
                    let twice = Diagnostic::warning(span, message).label(earlier, "this line is ignored");
                    found.diagnostics.push(twice.hint("remove one of them"));
                }
                (channels[n], found.places[n]) = (read, Some(span));
            }
            Ok((n, Some(setting), value)) => settings.push((n, setting, value, span)),
            Err(diagnostic) => found.diagnostics.push(diagnostic(span)),
        }
    }
    if !is_any {
        channels = default.clone();
    }
    for (n, setting, value, span) in settings {
        match &mut channels[n] {
            Some(channel) => {
                line::set(channel, setting, value, span, &mut found.diagnostics);
                is_any = true;
            }
            // What it reads cannot be had, which was said.
            None if found.places[n].is_some() => {}
            None => found.diagnostics.push(
                Diagnostic::warning(span, format!("iChannel{n} has no input, so this line is ignored"))
                    .hint(format!("add its input: #iChannel{n} \"buffer_a\"")),
            ),
        }
    }
    found.channels = is_any.then_some(channels);
    found
}
