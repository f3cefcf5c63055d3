//! A place of a project's texts, and what the author wrote there.

use super::terminal::one_line;
use crate::{diag::Span, project::Project};
use serde::Serialize;

#[derive(Debug, Serialize)]
pub(super) struct SourceExcerpt {
    pub source: Option<String>,
    /// Counted from 1, in characters.
    pub line: Option<usize>,
    pub column: Option<usize>,
    /// Its first line.
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

    /// `image.glsl:12:9`; `None` for what Eddy adds to the author's code.
    pub(super) fn place(&self) -> Option<String> {
        Some(format!("{}:{}:{}", one_line(self.source.as_ref()?), self.line?, self.column?))
    }
}
