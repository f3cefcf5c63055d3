//! Locations in the texts of a project, as people are told them.

use crate::{Project, Tab};
use eddy_diag::{SourceMap, Span};
use std::ops::Range;

/// A location in a text of the project.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextLocation {
    /// `None`: the text is no tab, as an included file is not.
    pub tab: Option<Tab>,
    /// The text's name.
    pub text: String,
    /// Line and column of the start, counted from 1; columns count characters.
    pub line: usize,
    pub column: usize,
    /// Bytes of the text as it was compiled.
    pub range: Range<usize>,
}

impl TextLocation {
    /// Returns `None` for a span of a text that `sources` does not have.
    pub fn new(span: Span, sources: &SourceMap, project: &Project) -> Option<Self> {
        let at = sources.line_column(span)?;
        let text = sources.get(span.source)?.name.clone();
        let tab = project.tab_of(span.source);
        Some(Self { tab, text, line: at.line, column: at.column, range: span.range() })
    }

    /// The tab's title, or the text's own name where it is no tab.
    pub fn title(&self) -> String {
        self.tab.as_ref().map_or_else(|| self.text.clone(), Tab::title)
    }
}
