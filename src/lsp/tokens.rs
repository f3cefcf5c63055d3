//! Semantic tokens and folding ranges.

use super::{positions::Lines, program::Program};
use eddy_diag::SourceId;
use eddy_glsl::services::{Class, FoldKind};
use eddy_project::limits;
use gen_lsp_types::{FoldingRange, FoldingRangeKind, Position, SemanticToken, SemanticTokens, SemanticTokensLegend};

/// The types of tokens, by the protocol's names where it has one.
const TYPES: &[&str] =
    &["keyword", "type", "function", "variable", "macro", "parameter", "property", "number", "comment", "operator"];

/// The modifiers, one bit each.
const MODIFIERS: &[&str] = &["readonly", "defaultLibrary", "static"];
const READONLY: u32 = 1;
const DEFAULT_LIBRARY: u32 = 2;
/// Declared outside of functions.
const STATIC: u32 = 4;

pub(crate) fn legend() -> SemanticTokensLegend {
    let owned = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    SemanticTokensLegend { token_types: owned(TYPES), token_modifiers: owned(MODIFIERS) }
}

/// Returns the type of a token, and its modifiers.
fn kind(class: Class) -> Option<(&'static str, u32)> {
    Some(match class {
        Class::Keyword => ("keyword", 0),
        Class::Type => ("type", 0),
        Class::Builtin => ("function", DEFAULT_LIBRARY),
        Class::Function => ("function", 0),
        Class::Uniform => ("variable", READONLY | DEFAULT_LIBRARY),
        Class::Macro => ("macro", 0),
        Class::Parameter => ("parameter", 0),
        Class::Local => ("variable", 0),
        Class::Global => ("variable", STATIC),
        Class::Field => ("property", 0),
        Class::Number => ("number", 0),
        Class::Comment | Class::Inactive => ("comment", 0),
        Class::Preprocessor => ("keyword", 0),
        Class::Operator => ("operator", 0),
        Class::Unknown => return None,
    })
}

/// Returns the tokens of some lines of a text, from `first` up to `end`, exclusive.
pub(crate) fn tokens(program: &Program, id: SourceId, lines: &Lines<'_>, rows: std::ops::Range<u32>) -> SemanticTokens {
    let mut data = Vec::new();
    let mut last = Position::default();
    let classes = program.analysis(id).map(|analysis| analysis.classes(id)).unwrap_or_default();
    let text = program.text(id);
    for span in classes {
        let Some((name, modifiers)) = kind(span.class) else { continue };
        let token_type = TYPES.iter().position(|known| *known == name).unwrap_or(0) as u32;
        // A token is within a single line.
        let mut start = span.range.start;
        for part in text.get(span.range).unwrap_or_default().split_inclusive('\n') {
            let shown = part.trim_end_matches(['\n', '\r']);
            let from = lines.position(start);
            let to = lines.position(start + shown.len());
            start += part.len();
            if from.line != to.line || from == to || !rows.contains(&from.line) {
                continue;
            }
            let is_same_line = from.line == last.line;
            data.push(SemanticToken {
                delta_line: from.line - last.line,
                delta_start: if is_same_line { from.character - last.character } else { from.character },
                length: to.character - from.character,
                token_type,
                token_modifiers_bitset: modifiers,
            });
            last = from;
        }
    }
    SemanticTokens { result_id: None, data }
}

pub(crate) fn folds(program: &Program, id: SourceId, lines: &Lines<'_>) -> Vec<FoldingRange> {
    let folds = program.analysis(id).map(|analysis| analysis.folds(id)).unwrap_or_default();
    let fold = |fold: eddy_glsl::services::Fold| {
        let (start, end) = (lines.position(fold.range.start), lines.position(fold.range.end));
        // The line of a closing brace stays visible.
        let end_line = if fold.kind == FoldKind::Block { end.line.saturating_sub(1) } else { end.line };
        let kind = match fold.kind {
            FoldKind::Block => None,
            FoldKind::Comment => Some(FoldingRangeKind::Comment),
            FoldKind::Conditional => Some(FoldingRangeKind::Region),
        };
        (end_line > start.line).then(|| FoldingRange { start_line: start.line, end_line, kind, ..Default::default() })
    };
    folds.into_iter().filter_map(fold).take(limits::LSP_ITEMS).collect()
}
