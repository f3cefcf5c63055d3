//! Collects the diagnostics of one compile: limits their number, and keeps one message per place.

use eddy_diag::{Diagnostic, Span};

/// The maximum number of errors per text; further ones are most likely consequences.
pub(super) const MAX_ERRORS: usize = 100;

#[derive(Clone, Default)]
pub(super) struct Report {
    pub diagnostics: Vec<Diagnostic>,
    errors: usize,
    /// Reported places in macro definitions: a mistake there is shown once, not at every use.
    in_macros: Vec<Span>,
}

impl Report {
    /// Adds a diagnostic, unless there are already too many.
    pub(crate) fn add(&mut self, diagnostic: Diagnostic) {
        if diagnostic.is_error() {
            self.errors += 1;
            if self.errors > MAX_ERRORS {
                return;
            }
        } else if self.diagnostics.len() - self.errors.min(MAX_ERRORS) > MAX_ERRORS {
            return;
        }
        self.diagnostics.push(diagnostic);
    }

    /// As [`Report::add`]; if the mistake is in a macro's definition, only its first use is reported.
    pub(crate) fn add_in_macro(&mut self, definition: Option<Span>, diagnostic: Diagnostic) {
        // Once the report is full, duplicates need not be detected, which would search all earlier places.
        if let Some(span) = definition.filter(|_| !self.is_full()) {
            if self.in_macros.contains(&span) {
                return;
            }
            self.in_macros.push(span);
        }
        self.add(diagnostic);
    }

    pub(crate) fn has_errors(&self) -> bool {
        self.errors > 0
    }

    /// Returns whether there are more errors than are kept, so that no further ones need be searched for.
    pub(crate) fn is_full(&self) -> bool {
        self.errors > MAX_ERRORS
    }
}
