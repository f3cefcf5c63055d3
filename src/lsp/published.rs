//! Diagnostics in the protocol's form, by file, including files that the editor does not have open.

use super::{
    documents::Documents,
    positions::{Encoding, Lines},
    program::Program,
};
use eddy_diag::{Diagnostic, Severity, SourceId, Span};
use gen_lsp_types::{
    self as lsp, DiagnosticRelatedInformation, DiagnosticSeverity, Location, PublishDiagnosticsParams, Range, Uri,
};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// The line indices of texts, computed on demand.
pub(crate) struct Places<'p> {
    program: &'p Program,
    documents: &'p Documents,
    encoding: Encoding,
    lines: HashMap<SourceId, Lines<'p>>,
}

impl<'p> Places<'p> {
    pub(crate) fn new(program: &'p Program, documents: &'p Documents, encoding: Encoding) -> Self {
        Self { program, documents, encoding, lines: HashMap::new() }
    }

    pub(crate) fn lines(&mut self, id: SourceId) -> &Lines<'p> {
        let (program, encoding) = (self.program, self.encoding);
        self.lines.entry(id).or_insert_with(|| Lines::new(program.text(id), encoding))
    }

    pub(crate) fn range(&mut self, span: Span) -> Range {
        self.lines(span.source).range(span.range())
    }

    /// Returns `None` for a text that is not in a file.
    pub(crate) fn uri(&self, id: SourceId) -> Option<Uri> {
        Some(Uri(self.documents.uri(self.program.path_of(id)?)))
    }

    pub(crate) fn location(&mut self, span: Span) -> Option<Location> {
        Some(Location { uri: self.uri(span.source)?, range: self.range(span) })
    }

    pub(crate) fn diagnostic(&mut self, said: &Diagnostic) -> lsp::Diagnostic {
        let mut message = said.message.clone();
        for hint in &said.hints {
            message.push_str("\nhelp: ");
            message.push_str(hint);
        }
        let related: Vec<DiagnosticRelatedInformation> = said
            .labels
            .iter()
            .filter_map(|label| {
                let location = self.location(label.span)?;
                Some(DiagnosticRelatedInformation { location, message: label.message.clone() })
            })
            .collect();
        lsp::Diagnostic {
            range: said.span.map_or_else(Range::default, |span| self.range(span)),
            severity: Some(match said.severity {
                Severity::Error => DiagnosticSeverity::Error,
                Severity::Warning => DiagnosticSeverity::Warning,
                Severity::Note => DiagnosticSeverity::Information,
            }),
            source: Some("eddy".into()),
            message: message.into(),
            related_information: (!related.is_empty()).then_some(related),
            ..lsp::Diagnostic::default()
        }
    }
}

/// Returns the diagnostics of every file of a program that has some, or that had some when they were last published,
/// and records the files. Files that are documents of other programs are left to those.
pub(crate) fn publish(
    program: &mut Program,
    documents: &Documents,
    encoding: Encoding,
    is_others: impl Fn(&std::path::Path) -> bool,
) -> Vec<PublishDiagnosticsParams> {
    program.is_unpublished = false;
    let said = program.diagnostics();
    let mut places = Places::new(program, documents, encoding);
    let mut lists: BTreeMap<String, Vec<lsp::Diagnostic>> = BTreeMap::new();
    for document in documents.iter().filter(|document| program.contains(&document.path)) {
        lists.insert(document.uri.clone(), Vec::new());
    }
    for diagnostic in &said {
        let placed = diagnostic.span.and_then(|span| program.path_of(span.source));
        // A diagnostic in a text without a file is reported at the start of the main file.
        let unplaced = Diagnostic { span: None, ..diagnostic.clone() };
        let diagnostic = if placed.is_some() { diagnostic } else { &unplaced };
        let path = placed.or_else(|| program.main_path());
        let Some(path) = path else { continue };
        let list = lists.entry(documents.uri(path)).or_default();
        let one = places.diagnostic(diagnostic);
        // Two passes may use the same file.
        if !list.contains(&one) {
            list.push(one);
        }
    }
    lists.retain(|uri, _| !is_others(&super::documents::path_of(uri)));
    let with_some: BTreeSet<String> = lists.keys().cloned().collect();
    for uri in &program.published {
        lists.entry(uri.clone()).or_default();
    }
    program.published = with_some;
    let version = |uri: &str| documents.iter().find(|document| document.uri == uri).map(|document| document.version);
    lists
        .into_iter()
        .map(|(uri, diagnostics)| PublishDiagnosticsParams { version: version(&uri), uri: Uri(uri), diagnostics })
        .collect()
}
