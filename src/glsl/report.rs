//! Collects the diagnostics of one compile: a limit to how many, and one message a place.

use eddy_diag::{Diagnostic, Span};

/// Errors shown for one text; the rest is most likely a consequence.
pub(super) const MAX_ERRORS: usize = 100;

#[derive(Clone, Default)]
pub(super) struct Report {
    pub diagnostics: Vec<Diagnostic>,
    errors: usize,
    /// Places in macro definitions that were reported: a mistake there shows once, not at every use.
    in_macros: Vec<Span>,
}

impl Report {
    /// Takes a diagnostic, unless there are too many already.
    pub fn add(&mut self, diagnostic: Diagnostic) {
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

    /// As [`Report::add`]; where the mistake stands in a macro's definition, only its first use counts.
    pub fn add_in_macro(&mut self, definition: Option<Span>, diagnostic: Diagnostic) {
        // What is left out need not be told apart, which takes a look at each place so far.
        if let Some(span) = definition.filter(|_| !self.is_full()) {
            if self.in_macros.contains(&span) {
                return;
            }
            self.in_macros.push(span);
        }
        self.add(diagnostic);
    }

    pub fn has_errors(&self) -> bool {
        self.errors > 0
    }

    /// More errors than are kept: nobody need look for further ones.
    pub fn is_full(&self) -> bool {
        self.errors > MAX_ERRORS
    }
}
