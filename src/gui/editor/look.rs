//! The display settings of a text in an editor: its size, marks, matches, and the analysis of it.

use super::line_cost::LineCost;
use crate::{
    diag::{Severity, SourceId},
    glsl::services::{Analysis, ClassSpan},
};
use std::ops::Range;

/// A diagnostic at a line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Mark {
    /// Counted from 0.
    pub line: usize,
    /// The underlined bytes of the text; may be empty.
    pub range: Range<usize>,
    pub severity: Severity,
    pub message: String,
    pub hints: Vec<String>,
    /// It has a quick fix.
    pub has_fix: bool,
}

/// The display settings of a text, which are not part of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look<'a> {
    /// The editor's name for assistive technology.
    pub name: &'a str,
    pub font_size: f32,
    /// Long lines wrap to the next row.
    pub wraps: bool,
    pub marks: &'a [Mark],
    /// Search matches, which are tinted.
    pub matches: &'a [Range<usize>],
    /// A text whose macros are also visible in this one.
    pub shared: &'a str,
    /// The analysis of the text, or of a slightly older version of it.
    pub help: Option<Help<'a>>,
    pub debug: &'a Debug,
    /// The costs of lines, in the order of the lines; empty if that is not shown.
    pub costs: &'a [LineCost],
}

/// The debugger's marks in a text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Debug {
    /// The line, from 0, that is about to run.
    pub line: Option<usize>,
    /// The bytes of the line that are about to run.
    pub range: Option<Range<usize>>,
    /// Lines, from 0, of breakpoints: whether each stops now, and whether it has a condition.
    pub breakpoints: Vec<(usize, bool, bool)>,
}

/// No debugger.
#[cfg(test)]
pub(super) const NO_DEBUG: Debug = Debug { line: None, range: None, breakpoints: Vec::new() };

/// An analysis of the text of an editor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Help<'a> {
    pub analysis: &'a Analysis,
    /// The editor's text in `analysis`.
    pub source: SourceId,
    pub classes: &'a [ClassSpan],
    /// The text that was analysed; it is older if it differs from the editor's.
    pub text: &'a str,
}
