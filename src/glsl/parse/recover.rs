//! Reporting each syntax error once, and finding the place from which to continue.

use super::parser::{Failed, Parser};
use crate::lex::Kind;
use eddy_diag::{Diagnostic, Span};

impl Parser<'_> {
    /// Returns the token as the author wrote it, truncated if it is long.
    pub(super) fn quoted(&self, i: usize) -> String {
        const MAX_QUOTED: usize = 60;
        let text = self.text(i);
        match text.char_indices().nth(MAX_QUOTED) {
            Some((end, _)) => format!("`{}...`", &text[..end]),
            None => format!("`{text}`"),
        }
    }

    /// Returns the token as the author wrote it.
    pub(super) fn text(&self, i: usize) -> &str {
        let span = self.origins.tokens[i].spelled;
        self.pieces.iter().find(|p| p.text.id == span.source).and_then(|p| p.text.text.get(span.range())).unwrap_or("")
    }

    /// Returns the token for a message.
    pub(super) fn shown(&self, i: usize) -> String {
        if self.kind_at(i) == Kind::Eof { "the end of the text".into() } else { self.quoted(i) }
    }

    /// Returns whether a token and the previous one are on different lines (or one of them comes from a macro with a
    /// line of its own).
    pub(super) fn starts_line(&self, i: usize) -> bool {
        if i == 0 || self.kind_at(i) == Kind::Eof {
            return true;
        }
        let (before, here) = (self.origins.token_span(Self::token(i - 1)), self.origins.token_span(Self::token(i)));
        if before.source != here.source {
            return true;
        }
        let text = self.pieces.iter().find(|p| p.text.id == here.source).map_or("", |p| p.text.text);
        text.get(before.end as usize..here.start as usize).is_some_and(|between| between.contains(['\n', '\r']))
    }

    /// Returns whether two tokens touch each other.
    pub(super) fn adjacent(&self, i: usize) -> bool {
        let (first, second) = (self.origins.tokens[i].spelled, self.origins.tokens[i + 1].spelled);
        first.source == second.source && first.end == second.start
    }

    /// Returns whether a token needs no further message: it was reported, or the previous message was about it.
    pub(super) fn is_reported(&self, i: usize) -> bool {
        self.last_error == Some(i) || self.kind_at(i) == Kind::Wrong || (i > 0 && self.kind_at(i - 1) == Kind::Wrong)
    }

    pub(super) fn error(&mut self, i: usize, message: impl Into<String>, hint: Option<String>) {
        let mut diagnostic = self.origins.error(self.names, Self::token(i), message);
        diagnostic.hints.extend(hint);
        self.report_at(i, diagnostic);
    }

    pub(super) fn report_at(&mut self, i: usize, diagnostic: Diagnostic) {
        if self.is_reported(i) {
            return;
        }
        self.last_error = Some(i);
        let definition = self.origins.definition_span(Self::token(i).into()).map(|d| d.0);
        self.report.add_in_macro(definition, diagnostic);
    }

    /// Reports an error at a token that ends the group being parsed.
    #[cold]
    pub(super) fn fail(&mut self, i: usize, message: impl Into<String>, hint: Option<String>) -> Failed {
        self.error(i, message, hint);
        Failed
    }

    /// Returns the place directly after a token, where something is missing.
    pub(super) fn span_after(&self, i: usize) -> Span {
        let span = self.origins.token_span(Self::token(i));
        Span { start: span.end, ..span }
    }

    /// Reports that something is missing after the last token.
    pub(super) fn missing(&mut self, what: &str, hint: Option<String>, label: Option<(usize, &str)>) {
        let here = self.at;
        let before = here.saturating_sub(1);
        let mut diagnostic =
            Diagnostic::error(self.span_after(before), format!("missing {what} after {}", self.shown(before)));
        if let Some((token, text)) = label {
            diagnostic = diagnostic.label(self.origins.token_span(Self::token(token)), text);
        }
        diagnostic.hints.extend(hint);
        self.report_at(here, diagnostic);
    }

    /// Skips the rest of a declaration or statement that could not be parsed: up to and including its `;` or block, or
    /// up to the clear start of the next one.
    pub(super) fn recover(&mut self) {
        let start = self.at;
        loop {
            match self.kind() {
                Kind::Eof | Kind::RBrace => return,
                Kind::Semicolon => {
                    self.bump();
                    return;
                }
                Kind::LBrace => {
                    if let Some(end) = self.partner(self.at) {
                        self.at = end;
                        self.bump();
                        self.eat(Kind::Semicolon);
                        return;
                    }
                    self.bump();
                }
                Kind::LParen | Kind::LBracket => {
                    self.at = self.partner(self.at).unwrap_or(self.at);
                    self.bump();
                }
                _ if self.at > start && self.is_certain_start() && self.starts_line(self.at) => return,
                _ => self.bump(),
            }
        }
    }

    /// Returns whether the next tokens can only be the start of a statement or declaration.
    pub(super) fn is_certain_start(&self) -> bool {
        match self.kind() {
            Kind::Type | Kind::Ident => self.second() == Kind::Ident,
            Kind::Const
            | Kind::Uniform
            | Kind::Struct
            | Kind::Precision
            | Kind::Layout
            | Kind::If
            | Kind::For
            | Kind::While
            | Kind::Do
            | Kind::Switch
            | Kind::Case
            | Kind::Default
            | Kind::Return
            | Kind::Break
            | Kind::Continue
            | Kind::Discard => true,
            _ => false,
        }
    }
}
