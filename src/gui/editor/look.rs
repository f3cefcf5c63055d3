//! Says how a text is shown besides what it says: its size, marks, places found, and what is known of it.

use crate::{
    diag::{Severity, SourceId},
    glsl::services::{Analysis, ClassSpan},
};
use std::ops::Range;

/// A diagnostic at a line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Mark {
    /// From 0.
    pub line: usize,
    /// The underlined bytes of the text; may be empty.
    pub range: Range<usize>,
    pub severity: Severity,
    pub message: String,
    pub hints: Vec<String>,
    /// It can be mended at once.
    pub has_fix: bool,
}

/// Says how a text is shown; not a part of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look<'a> {
    /// Holds what it is called to those who do not see it.
    pub name: &'a str,
    pub font_size: f32,
    /// Lines go on in the next row where they are too long.
    pub wraps: bool,
    pub marks: &'a [Mark],
    /// Places found, tinted.
    pub matches: &'a [Range<usize>],
    /// A text whose macros count in this one.
    pub shared: &'a str,
    /// The analysis of the text, or of what it was a moment ago.
    pub help: Option<Help<'a>>,
    pub debug: &'a Debug,
}

/// Holds what a debugger has to show in a text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Debug {
    /// The line, from 0, that is about to run.
    pub line: Option<usize>,
    /// The bytes of it that are.
    pub range: Option<Range<usize>>,
    /// Lines, from 0, at which it stops: whether it does now, and whether only under a condition.
    pub breakpoints: Vec<(usize, bool, bool)>,
}

/// Nothing.
#[cfg(test)]
pub(super) const NO_DEBUG: Debug = Debug { line: None, range: None, breakpoints: Vec::new() };

/// An analysis of the text that an editor shows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Help<'a> {
    pub analysis: &'a Analysis,
    /// The editor's text in `analysis`.
    pub source: SourceId,
    pub classes: &'a [ClassSpan],
    /// The text it was made of; where it is not the editor's, it is older.
    pub text: &'a str,
}
