//! Symbols of a document and of all open projects.

use super::{
    documents::Documents,
    positions::{Encoding, Lines},
    program::Program,
    published::Places,
};
use eddy_diag::{SourceId, Span};
use eddy_glsl::services::{OutlineKind, Outlined};
use eddy_project::limits;
use gen_lsp_types::{BaseSymbolInformation, DocumentSymbol, SymbolKind, WorkspaceSymbol, WorkspaceSymbolLocation};

/// The limit of returned symbols of all projects, as an editor asks again with more letters; also of members of a
/// struct.
const MAX_SYMBOLS: usize = 500;

fn kind(kind: OutlineKind) -> SymbolKind {
    match kind {
        OutlineKind::Function => SymbolKind::Function,
        OutlineKind::Struct => SymbolKind::Struct,
        OutlineKind::Field => SymbolKind::Field,
        OutlineKind::Constant => SymbolKind::Constant,
        OutlineKind::Global | OutlineKind::Uniform => SymbolKind::Variable,
        // The protocol has no kind for macros; editors show this one for them.
        OutlineKind::Macro => SymbolKind::Constant,
    }
}

/// Returns the declarations of a text, the uniforms of its `#iUniform` lines first.
pub(crate) fn of_document(program: &Program, id: SourceId, lines: &Lines<'_>) -> Vec<DocumentSymbol> {
    let outline = program.analysis(id).map(|analysis| analysis.outline(id)).unwrap_or_default();
    let mut symbols: Vec<DocumentSymbol> = uniforms(program, id, lines);
    symbols.extend(outline.iter().take(limits::LSP_ITEMS).map(|one| symbol(one, lines)));
    symbols.truncate(limits::LSP_ITEMS);
    symbols.sort_by_key(|symbol| symbol.selection_range.start);
    symbols
}

fn uniforms(program: &Program, id: SourceId, lines: &Lines<'_>) -> Vec<DocumentSymbol> {
    let here = program.uniforms.iter().filter(|(_, span)| span.source == id);
    let here = here.take(limits::LSP_ITEMS);
    here.map(|(name, span)| document_symbol(name, "#iUniform", SymbolKind::Variable, lines, span.range(), span.range()))
        .collect()
}

#[expect(deprecated, reason = "the field has to be given a value")]
fn document_symbol(
    name: &str,
    detail: &str,
    kind: SymbolKind,
    lines: &Lines<'_>,
    whole: std::ops::Range<usize>,
    place: std::ops::Range<usize>,
) -> DocumentSymbol {
    DocumentSymbol {
        name: name.to_owned(),
        detail: (!detail.is_empty()).then(|| detail.to_owned()),
        kind,
        tags: None,
        deprecated: None,
        range: lines.range(whole),
        selection_range: lines.range(place),
        children: None,
    }
}

fn symbol(one: &Outlined, lines: &Lines<'_>) -> DocumentSymbol {
    let mut symbol =
        document_symbol(&one.name, &one.detail, kind(one.kind), lines, one.whole.clone(), one.place.clone());
    let children: Vec<DocumentSymbol> =
        one.members.iter().take(MAX_SYMBOLS).map(|member| symbol_of(member, lines)).collect();
    symbol.children = (!children.is_empty()).then_some(children);
    symbol
}

/// Members have no members.
fn symbol_of(member: &Outlined, lines: &Lines<'_>) -> DocumentSymbol {
    document_symbol(&member.name, &member.detail, kind(member.kind), lines, member.whole.clone(), member.place.clone())
}

/// Returns the declarations of a program whose names contain the letters of a query in order.
pub(crate) fn of_program(
    program: &Program,
    documents: &Documents,
    encoding: Encoding,
    query: &str,
    out: &mut Vec<WorkspaceSymbol>,
) {
    let mut places = Places::new(program, documents, encoding);
    let ids: Vec<SourceId> = (0..program.paths.len()).map(|i| SourceId(i as u16)).collect();
    for id in ids {
        let Some(analysis) = program.analysis(id) else { continue };
        let container = program.texts.get(id).map(|text| text.name.clone());
        for one in analysis.outline(id).into_iter().filter(|one| fits(query, &one.name)) {
            let Some(location) = places.location(Span::new(id, one.place)) else { continue };
            let found = WorkspaceSymbol {
                location: WorkspaceSymbolLocation::Location(location),
                data: None,
                base_symbol_information: BaseSymbolInformation {
                    name: one.name,
                    kind: kind(one.kind),
                    tags: None,
                    container_name: container.clone(),
                },
            };
            if out.len() < MAX_SYMBOLS && !out.contains(&found) {
                out.push(found);
            }
        }
    }
}

fn fits(query: &str, name: &str) -> bool {
    let mut letters = name.chars();
    query.chars().all(|wanted| letters.any(|letter| letter.eq_ignore_ascii_case(&wanted)))
}
