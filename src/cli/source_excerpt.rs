//! A range of a project's text, with its location and content.

use super::terminal::one_line;
use crate::{diag::Span, project::Project};
use serde::Serialize;

#[derive(Debug, Serialize)]
pub(super) struct SourceExcerpt {
    pub source: Option<String>,
    /// Counted from 1, in characters.
    pub line: Option<usize>,
    pub column: Option<usize>,
    /// The first line of the range.
    pub text: String,
}

impl SourceExcerpt {
    pub(super) fn at(project: &Project, span: Option<Span>) -> Self {
        let sources = project.sources();
        let at = span.and_then(|span| sources.line_column(span));
        let source = span.and_then(|span| sources.get(span.source));
        let text = span.zip(source).and_then(|(span, source)| source.text.get(span.range()));
        Self {
            source: source.map(|source| source.name.clone()),
            line: at.map(|at| at.line),
            column: at.map(|at| at.column),
            text: text.and_then(|text| text.lines().next()).unwrap_or_default().to_owned(),
        }
    }

    /// Formats the location, as in `image.glsl:12:9`; `None` for code that Eddy adds to the author's.
    pub(super) fn place(&self) -> Option<String> {
        Some(format!("{}:{}:{}", one_line(self.source.as_ref()?), self.line?, self.column?))
    }
}
