//! Semantic colours, from an analysis that may be of a slightly older text.

use super::look::Help;
use crate::glsl::services::{Class, ClassSpan, lines::Token};
use std::ops::Range;

/// The classes of a text, valid before the first and after the last byte that has changed since the analysis.
pub(super) struct Semantic<'a> {
    classes: &'a [ClassSpan],
    /// The length of the equal prefix.
    head: usize,
    /// The start of the equal suffix in the current text, and the offset of its positions from those in the older
    /// text.
    tail: usize,
    shift: isize,
}

impl<'a> Semantic<'a> {
    pub(super) fn new(help: Help<'a>, text: &str) -> Self {
        let (old, new) = (help.text.as_bytes(), text.as_bytes());
        if old == new {
            return Self { classes: help.classes, head: new.len(), tail: 0, shift: 0 };
        }
        let head = equal_at_start(old, new);
        let limit = (old.len() - head).min(new.len() - head);
        let same = equal_at_end(&old[old.len() - limit..], &new[new.len() - limit..]);
        let shift = new.len() as isize - old.len() as isize;
        Self { classes: help.classes, head, tail: new.len() - same, shift }
    }

    /// Returns tokens that cover a line, or a piece of one, with the bytes `range`; `None` for a changed line.
    pub(super) fn tokens(&self, range: Range<usize>, line: &str) -> Option<Vec<Token>> {
        let shift = match () {
            // The line end is part of the line: if it is new, so is the line.
            () if range.end < self.head || (self.shift == 0 && self.tail == 0) => 0,
            () if range.start >= self.tail => self.shift,
            () => return None,
        };
        let old = range.start.checked_add_signed(-shift)?..range.end.checked_add_signed(-shift)?;
        let first = self.classes.partition_point(|c| c.range.end <= old.start);
        // The analysis blanks Eddy's own lines (`#iUniform`, `#include`): a `#` without classes.
        if line.trim_start().starts_with('#') && self.classes.get(first).is_none_or(|c| c.range.start >= old.end) {
            return None;
        }
        let mut tokens = Vec::new();
        let mut at = old.start;
        for span in self.classes[first..].iter().take_while(|c| c.range.start < old.end) {
            let (start, end) = (span.range.start.max(old.start), span.range.end.min(old.end));
            push(&mut tokens, start - at, Class::Operator);
            push(&mut tokens, end - start, span.class);
            at = end;
        }
        push(&mut tokens, old.end - at, Class::Operator);
        // Stale classes must not cut a character.
        let mut at = 0;
        let fits = tokens.iter().all(|token| {
            at += token.len;
            line.is_char_boundary(at)
        });
        (fits && at == line.len()).then_some(tokens)
    }
}

/// The number of bytes compared at once: comparing ten million one by one takes longer than a frame.
const BLOCK: usize = 4096;

/// Returns the length of the common prefix of two texts, in bytes.
fn equal_at_start(a: &[u8], b: &[u8]) -> usize {
    let blocks = a.chunks_exact(BLOCK).zip(b.chunks_exact(BLOCK)).take_while(|(a, b)| a == b).count() * BLOCK;
    blocks + a[blocks..].iter().zip(&b[blocks..]).take_while(|(a, b)| a == b).count()
}

/// Returns the length of the common suffix of two texts, in bytes.
fn equal_at_end(a: &[u8], b: &[u8]) -> usize {
    let blocks = a.rchunks_exact(BLOCK).zip(b.rchunks_exact(BLOCK)).take_while(|(a, b)| a == b).count() * BLOCK;
    let (a, b) = (&a[..a.len() - blocks], &b[..b.len() - blocks]);
    blocks + a.iter().rev().zip(b.iter().rev()).take_while(|(a, b)| a == b).count()
}

fn push(tokens: &mut Vec<Token>, len: usize, class: Class) {
    if len > 0 {
        tokens.push(Token { len, class });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        diag::SourceId,
        glsl::{PassKind, PassSource, Text, services::Analysis},
    };

    const TEXT: &str = "float g;\n/* é */ void f(float par) {\n    par = g;\n}\n#if 0\nout\n#endif";

    fn kinds(now: &str, line: usize) -> Option<Vec<Class>> {
        let id = SourceId(0);
        let analysis = Analysis::new(&PassSource::new(PassKind::Buffer, Text { id, text: TEXT }));
        let classes = analysis.classes(id);
        let help = Help { analysis: &analysis, source: id, classes: &classes, text: TEXT };
        let start = now.split_inclusive('\n').take(line).map(str::len).sum::<usize>();
        let text = now[start..].lines().next().unwrap_or("");
        let tokens = Semantic::new(help, now).tokens(start..start + text.len(), text)?;
        assert_eq!(tokens.iter().map(|t| t.len).sum::<usize>(), text.len(), "tokens cover {text:?}");
        Some(tokens.into_iter().map(|t| t.class).filter(|k| *k != Class::Operator).collect())
    }

    #[test]
    fn lines_that_did_not_change_keep_their_colours() {
        let body = Some(vec![Class::Parameter, Class::Global]);
        assert_eq!(kinds(TEXT, 2), body);
        assert_eq!(kinds(TEXT, 5), Some(vec![Class::Inactive]));
        // The changed line is left to the line lexer, the lines around it are not.
        let changed = TEXT.replace("float g;", "float g; float hé;");
        assert_eq!((kinds(&changed, 0), kinds(&changed, 2)), (None, body.clone()));
        let changed = TEXT.replace("par = g;", "par = gg;");
        assert_eq!(kinds(&changed, 2), None);
        assert_eq!(kinds(&changed, 0), Some(vec![Class::Type, Class::Global]));
        assert_eq!(kinds(&changed, 5), Some(vec![Class::Inactive]));
        let inserted = TEXT.replace("    par", "\n\n    par");
        assert_eq!(kinds(&inserted, 4), body);
        assert_eq!(kinds(&format!("{TEXT}\nx"), 7), None);
    }

    #[test]
    fn lines_blanked_by_the_analysis_use_the_line_lexer() {
        let now = TEXT.replace("float g;", "#iUnif g");
        let classes = [ClassSpan { range: 9..17, class: Class::Comment }];
        let semantic = Semantic { classes: &classes, head: now.len(), tail: 0, shift: 0 };
        assert_eq!(semantic.tokens(0..8, &now[..8]), None);
        let inactive = Semantic { classes: &[ClassSpan { range: 0..30, class: Class::Inactive }], ..semantic };
        assert!(inactive.tokens(0..8, &now[..8]).is_some());
    }
}
