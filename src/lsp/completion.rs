//! Completion: everything that is valid at the caret.

use super::{hover::markdown, positions::Lines, program::Program};
use eddy_diag::SourceId;
use eddy_glsl::services::CompletionKind;
use gen_lsp_types::{
    CompletionItem, CompletionItemKind, CompletionItemTextEdit, CompletionList, Documentation, TextEdit,
};

fn kind(kind: CompletionKind) -> CompletionItemKind {
    match kind {
        CompletionKind::Local | CompletionKind::Parameter | CompletionKind::Global | CompletionKind::Uniform => {
            CompletionItemKind::Variable
        }
        CompletionKind::Constant | CompletionKind::Macro => CompletionItemKind::Constant,
        CompletionKind::Function | CompletionKind::Builtin => CompletionItemKind::Function,
        CompletionKind::Struct => CompletionItemKind::Struct,
        CompletionKind::Field => CompletionItemKind::Field,
        CompletionKind::Type => CompletionItemKind::Class,
        CompletionKind::Keyword => CompletionItemKind::Keyword,
    }
}

/// Returns all completions at a byte, best first; the editor filters by the typed text.
pub(crate) fn completions(program: &Program, id: SourceId, at: usize, lines: &Lines<'_>) -> CompletionList {
    let Some(analysis) = program.analysis(id) else { return CompletionList::default() };
    let found = analysis.completions(id, at);
    let range = lines.range(found.replace.clone());
    let ranked = found.matching("").into_iter().enumerate();
    let items = ranked.map(|(rank, index)| {
        let item = &found.items[index];
        CompletionItem {
            label: item.label.clone(),
            kind: Some(kind(item.kind)),
            detail: (!item.detail.is_empty()).then(|| item.detail.clone()),
            documentation: (!item.doc.is_empty())
                .then(|| Documentation::MarkupContent(markdown(item.doc.replace('\n', "  \n")))),
            sort_text: Some(format!("{rank:04}")),
            text_edit: Some(CompletionItemTextEdit::TextEdit(TextEdit { range, new_text: item.label.clone() })),
            ..CompletionItem::default()
        }
    });
    CompletionList { is_incomplete: false, items: items.collect(), ..CompletionList::default() }
}
