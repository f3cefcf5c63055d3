//! Code actions: the fixes of diagnostics, and edits of several files in the protocol's form.

use super::{program::Program, published::Places};
use eddy_diag::{Fix, SourceId};
use gen_lsp_types::{CodeAction, CodeActionKind, TextEdit, Uri, WorkspaceEdit};
use std::{collections::HashMap, ops::Range};

/// Returns the fixes of the diagnostics in a range of a text, the likeliest first.
pub(crate) fn actions(
    program: &Program,
    places: &mut Places<'_>,
    id: SourceId,
    range: Range<usize>,
) -> Vec<CodeAction> {
    let mut actions = Vec::new();
    let path = program.path_of(id);
    for said in program.diagnostics() {
        let Some(span) = said.span.filter(|span| program.path_of(span.source) == path) else { continue };
        if (span.start as usize) > range.end || range.start > span.end as usize {
            continue;
        }
        for (n, fix) in said.fixes.iter().enumerate() {
            let Some(edit) = edit(program, places, fix) else { continue };
            actions.push(CodeAction {
                title: fix.title.clone(),
                kind: Some(CodeActionKind::QuickFix),
                diagnostics: Some(vec![places.diagnostic(&said)]),
                is_preferred: (n == 0).then_some(true),
                edit: Some(edit),
                ..CodeAction::default()
            });
        }
    }
    actions
}

/// Returns the edits of a fix by file; `None` if one is not in a file.
pub(crate) fn edit(program: &Program, places: &mut Places<'_>, fix: &Fix) -> Option<WorkspaceEdit> {
    let mut changes: HashMap<Uri, Vec<TextEdit>> = HashMap::new();
    for edit in &fix.edits {
        program.path_of(edit.span.source)?;
        let uri = places.uri(edit.span.source)?;
        let edit = TextEdit { range: places.range(edit.span), new_text: edit.text.clone() };
        let list = changes.entry(uri).or_default();
        // Two passes may use the same file.
        if !list.contains(&edit) {
            list.push(edit);
        }
    }
    Some(WorkspaceEdit { changes: Some(changes), ..WorkspaceEdit::default() })
}
