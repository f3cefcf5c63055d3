//! Inlay hints.

use super::{positions::Lines, program::Program};
use eddy_diag::SourceId;
use eddy_project::limits;
use gen_lsp_types::{InlayHint, InlayHintKind, Label};
use std::ops::Range;

/// Returns the hints of a range of a text: those of the language, and after each `#iUniform` line the value that
/// `eddy.toml` sets.
pub(crate) fn hints(program: &Program, id: SourceId, lines: &Lines<'_>, range: Range<usize>) -> Vec<InlayHint> {
    let of_language = program.analysis(id).map(|analysis| analysis.hints(id, range.clone())).unwrap_or_default();
    let mut hints: Vec<InlayHint> = of_language
        .into_iter()
        .take(limits::LSP_ITEMS)
        .map(|hint| {
            let kind = match hint.is_parameter {
                true => Some(InlayHintKind::Parameter),
                // A value is neither a type nor a parameter.
                false => hint.label.starts_with(':').then_some(InlayHintKind::Type),
            };
            let is_value = kind.is_none();
            inlay_hint(lines, hint.at, hint.label, kind, is_value, hint.is_parameter)
        })
        .collect();
    let Some(project) = &program.project else { return hints };
    let declared = project.custom_uniforms();
    for (name, span) in program.uniforms.iter().filter(|(_, span)| span.source == id) {
        let Some(value) = project.custom_uniform_values.get(name) else { continue };
        let Some(uniform) = declared.get(name) else { continue };
        if range.start <= span.end as usize && (span.start as usize) <= range.end {
            let text = program.text(id);
            let at = text[span.end as usize..].find('\n').map_or(text.len(), |i| span.end as usize + i);
            let at = at - (text[..at].len() - text[..at].trim_end().len());
            let label = format!("now {} (eddy.toml)", value.glsl(uniform.ty));
            hints.push(inlay_hint(lines, at, label, None, true, false));
        }
    }
    hints
}

fn inlay_hint(
    lines: &Lines<'_>,
    at: usize,
    label: String,
    kind: Option<InlayHintKind>,
    left: bool,
    right: bool,
) -> InlayHint {
    InlayHint {
        position: lines.position(at),
        label: Label::String(label),
        kind,
        text_edits: None,
        tooltip: None,
        padding_left: left.then_some(true),
        padding_right: right.then_some(true),
        data: None,
    }
}
