//! Navigation: the places where a name is declared and used.

use super::{program::Program, published::Places};
use eddy_diag::{SourceId, Span};
use eddy_project::limits;
use gen_lsp_types::{DocumentHighlight, DocumentHighlightKind, Location};
use std::collections::HashSet;

/// Returns the declaration of the item at a byte: in GLSL, by an `#iUniform` line, or the file that an `#include` line
/// names.
pub(crate) fn definition(program: &Program, places: &mut Places<'_>, id: SourceId, at: usize) -> Vec<Location> {
    let declared = program.analysis(id).and_then(|analysis| analysis.definition(id, at));
    let mut spans: Vec<Span> = declared.into_iter().collect();
    if spans.is_empty() {
        spans = program.programs(|programs| programs.uniform_lines(id, at));
    }
    if spans.is_empty() {
        let included = program.project.as_ref().and_then(|project| {
            let tab = project.included_at(&project.tab_of(id)?, at)?;
            project.id_of(&tab)
        });
        spans.extend(included.map(|id| Span::at(id, 0)));
    }
    spans.into_iter().filter_map(|span| places.location(span)).collect()
}

/// Returns every place of the project that refers to the item at a byte.
pub(crate) fn references(
    program: &Program,
    places: &mut Places<'_>,
    id: SourceId,
    at: usize,
    with_declaration: bool,
) -> Vec<Location> {
    let found = spans(program, id, at);
    let declared = program.analysis(id).and_then(|analysis| analysis.definition(id, at));
    let lines = program.programs(|programs| programs.uniform_lines(id, at));
    // From a declaration, the declaration is returned itself.
    let is_declaration = |span: &Span| Some(*span) == declared || lines.contains(span);
    let wanted = found.into_iter().filter(|span| with_declaration || !is_declaration(span));
    // Two texts may belong to the same file.
    let mut seen = HashSet::new();
    let locations = wanted.filter_map(|span| {
        let location = places.location(span)?;
        let (start, end) = (location.range.start, location.range.end);
        let key = (location.uri.0.clone(), (start.line, start.character), (end.line, end.character));
        seen.insert(key).then_some(location)
    });
    locations.take(limits::LSP_ITEMS).collect()
}

/// Returns the places in one text.
pub(crate) fn highlights(
    program: &Program,
    places: &mut Places<'_>,
    id: SourceId,
    at: usize,
) -> Vec<DocumentHighlight> {
    let here = spans(program, id, at).into_iter().filter(|span| span.source == id);
    let here = here.take(limits::LSP_ITEMS);
    here.map(|span| DocumentHighlight { range: places.range(span), kind: Some(DocumentHighlightKind::Text) }).collect()
}

/// Returns every place of a name; for a predefined one, those in the text of the request.
fn spans(program: &Program, id: SourceId, at: usize) -> Vec<Span> {
    let found = program.programs(|programs| programs.places(id, at));
    if !found.is_empty() {
        return found.into_iter().map(|(source, start, end)| Span { source, start, end }).collect();
    }
    program.analysis(id).map(|analysis| analysis.uses(id, at)).unwrap_or_default()
}
