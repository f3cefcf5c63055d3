//! Code folding: the parts of a text that an editor can fold.

use super::{
    analysis::Analysis,
    text::{Directive, Source},
};
use crate::lex::Kind;
use eddy_diag::SourceId;
use std::ops::Range;

/// A foldable part of a text: bytes from the end of its first line to the end of its last.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fold {
    pub range: Range<usize>,
    pub kind: FoldKind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FoldKind {
    /// Between two braces.
    Block,
    /// A comment of several lines, or consecutive line comments.
    Comment,
    /// From an `#if` to the line before its `#else` or `#endif`.
    Conditional,
}

impl Analysis {
    /// Returns every part that spans several lines, by its start.
    pub fn folds(&self, source: SourceId) -> Vec<Fold> {
        let Some(index) = self.source_index(source) else { return Vec::new() };
        let text = &self.sources[index];
        let mut folds = blocks(text);
        folds.extend(comments(text));
        folds.extend(conditionals(text));
        folds.retain(|fold| text.text[fold.range.clone()].contains('\n'));
        folds.sort_by_key(|fold| (fold.range.start, fold.range.end));
        folds
    }
}

fn blocks(text: &Source) -> Vec<Fold> {
    let open = (0..text.tokens.len()).filter(|&i| text.kind(i) == Kind::LBrace);
    let block = |i: usize| {
        let close = text.partner(i)?;
        let range = text.tokens[i].end as usize..text.tokens[close].start as usize;
        (range.start < range.end).then_some(Fold { range, kind: FoldKind::Block })
    };
    open.filter_map(block).collect()
}

/// Consecutive comments on lines of their own are merged.
fn comments(text: &Source) -> Vec<Fold> {
    let mut folds: Vec<Fold> = Vec::new();
    for comment in &text.comments {
        let range = comment.start as usize..comment.end as usize;
        let line = text.text[..range.start].rfind('\n').map_or(0, |i| i + 1);
        let begins_line = text.text[line..range.start].trim().is_empty();
        if let Some(last) = folds.last_mut()
            && begins_line
            && text.text[range.clone()].starts_with("//")
            && text.text[last.range.clone()].starts_with("//")
            && text.text[last.range.end..range.start].trim().is_empty()
            && text.text[last.range.end..range.start].matches('\n').count() <= 1
        {
            last.range.end = range.end;
        } else if begins_line {
            folds.push(Fold { range, kind: FoldKind::Comment });
        }
    }
    folds
}

fn conditionals(text: &Source) -> Vec<Fold> {
    let mut folds = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    for (i, token) in text.tokens.iter().enumerate() {
        if token.kind != Kind::Hash || token.directive != Directive::Head {
            continue;
        }
        let word = text.tokens.get(i + 1).filter(|t| t.directive == Directive::Head);
        let word = word.and_then(|t| text.text.get(t.range())).unwrap_or_default();
        let opens = matches!(word, "if" | "ifdef" | "ifndef");
        let goes_on = matches!(word, "else" | "elif");
        if (goes_on || word == "endif")
            && let Some(start) = open.pop()
        {
            let end = text.text[..token.start as usize].rfind('\n').unwrap_or(start).max(start);
            folds.push(Fold { range: start..end, kind: FoldKind::Conditional });
        }
        if opens || goes_on {
            let line = token.start as usize;
            open.push(text.text[line..].find('\n').map_or(text.text.len(), |at| line + at));
        }
    }
    folds
}
