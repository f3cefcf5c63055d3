//! Misplaced lines: a Markdown fence around the text, a directive that does not start its line.
//!
//! Each is one error, reported once. The parser's errors about the rest of such a line, and about the names that it
//! would have declared, would be consequences.

use super::{directive::DIRECTIVES, foreign::OWN, state::Preprocessor};
use crate::{
    ast::Symbol,
    lex::{Kind, LINE_START, Token},
};
use eddy_diag::{Diagnostic, Edit, Fix, Span};

/// Directives without which the rest of a text has another meaning.
const ESSENTIAL: [&str; 7] = ["include", "if", "ifdef", "ifndef", "elif", "else", "endif"];

impl Preprocessor<'_, '_> {
    /// Reports a fence, or a directive within its line. Returns false for anything else, of which nothing is consumed.
    #[cold]
    pub(super) fn is_misplaced(&mut self, token: &Token) -> bool {
        match token.kind {
            Kind::BadChar => token.value == u32::from('`') && token.has(LINE_START) && self.fence(token),
            _ => self.directive_within(token),
        }
    }

    /// Reports a directive that is preceded by a word, as `x#define N 3`. `first` is the first token of a line. Returns
    /// false if there is none, and consumes nothing then.
    #[inline]
    pub(super) fn hides_directive(&mut self, first: &Token) -> bool {
        let text = self.pieces[self.current].text.text.as_bytes();
        let mut at = first.span.end as usize;
        while matches!(text.get(at), Some(b' ' | b'\t')) {
            at += 1;
        }
        text.get(at) == Some(&b'#') && self.word_before(first, at)
    }

    #[cold]
    fn word_before(&mut self, first: &Token, hash: usize) -> bool {
        let is_word = matches!(first.kind, Kind::Ident | Kind::BadName | Kind::BadNumber | Kind::BadChar | Kind::Text)
            || self.text(first.span).starts_with(|c: char| c.is_ascii_digit());
        let Some(name) = self.directive_at(hash).filter(|_| is_word) else { return false };
        let word = self.text(first.span).to_owned();
        let edit = Edit { span: Span { end: hash as u32, ..first.span }, text: String::new() };
        self.report.add(
            Diagnostic::error(first.span, format!("`{word}` comes before `#{name}`, which must begin its line"))
                .hint(format!("delete `{word}`"))
                .fix(Fix::new(format!("Delete `{word}`"), vec![edit])),
        );
        self.skip_line(&name);
        true
    }

    fn directive_within(&mut self, hash: &Token) -> bool {
        let Some(name) = self.directive_at(hash.span.start as usize) else { return false };
        let edit = Edit { span: Span { end: hash.span.start, ..hash.span }, text: "\n".to_owned() };
        self.report.add(
            Diagnostic::error(hash.span, format!("`#{name}` must begin its line"))
                .hint("move it into a line of its own")
                .fix(Fix::new(format!("Move `#{name}` into its own line"), vec![edit])),
        );
        self.skip_line(&name);
        true
    }

    /// Returns the name of the directive whose `#` is at this byte of the current text.
    fn directive_at(&self, hash: usize) -> Option<String> {
        let rest = self.pieces[self.current].text.text.get(hash..)?.strip_prefix('#')?.trim_start_matches([' ', '\t']);
        let name = &rest[..rest.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(rest.len())];
        DIRECTIVES.into_iter().chain(OWN).any(|known| known == name).then(|| name.to_owned())
    }

    /// Consumes the rest of a line without processing it.
    fn skip_line(&mut self, name: &str) {
        self.lexer.start_directive();
        let line = self.line_tokens();
        let names = line.iter().filter(|t| t.kind == Kind::Ident).map(|t| Symbol(t.value));
        self.origins.unread.extend(names);
        self.stopped |= ESSENTIAL.contains(&name);
    }

    /// Reports the ``` that Markdown puts around a text: once, with a fix that removes all of them.
    fn fence(&mut self, token: &Token) -> bool {
        let text = self.pieces[self.current].text.text;
        let start = token.span.start as usize;
        let Some(rest) = text.get(start..) else { return false };
        let ticks = rest.len() - rest.trim_start_matches('`').len();
        if ticks < 3 {
            return false;
        }
        let line = rest.lines().next().unwrap_or_default();
        let after_ticks = line[ticks..].trim();
        let is_alone = !after_ticks.contains(|c: char| !(c.is_ascii_alphanumeric() || "+-_.#".contains(c)));
        let mut span = Span { end: token.span.start + ticks as u32, ..token.span };
        let marks = span;
        if is_alone {
            self.lexer.start_directive();
            self.lexer.rest_of_line();
            self.line_tokens();
            // Including its line end.
            let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
            let end = rest.find('\n').map_or(text.len(), |at| start + at + 1);
            span = Span::new(span.source, line_start..end);
        } else {
            for _ in 1..ticks {
                self.next_raw();
            }
        }
        let edit = Edit { span, text: String::new() };
        let first = self.fence.and_then(|at| self.report.diagnostics.get_mut(at)?.fixes.first_mut());
        match first {
            Some(fix) => fix.edits.push(edit),
            None => {
                self.fence = Some(self.report.diagnostics.len());
                self.report.add(
                    Diagnostic::error(marks, "Markdown fence: not GLSL")
                        .hint("delete the lines with ```")
                        .fix(Fix::new("Remove the Markdown fence", vec![edit])),
                );
            }
        }
        true
    }
}
