//! Dispatch of directives, and the implementation of all but `#define`: conditionals, `#error`, `#line`, `#version`,
//! `#extension`, `#pragma`.

use super::state::{Conditional, Preprocessor};
use crate::{
    ast::Symbol,
    lex::{Kind, Token},
};
use eddy_diag::{Diagnostic, Span};

pub(crate) const DIRECTIVES: [&str; 13] = [
    "define",
    "undef",
    "if",
    "ifdef",
    "ifndef",
    "elif",
    "else",
    "endif",
    "error",
    "line",
    "version",
    "extension",
    "pragma",
];

impl Preprocessor<'_, '_> {
    /// Processes the directive that starts with `hash`, to the end of its line.
    pub(super) fn directive(&mut self, hash: Token) {
        self.cancel.check();
        self.lexer.start_directive();
        let name = self.next_raw();
        match name.kind {
            // `#` by itself does nothing.
            Kind::Newline | Kind::Eof => return,
            Kind::Ident => {}
            _ => {
                let text = self.text(name.span).to_owned();
                self.error(&hash, format!("expected the name of a directive after `#`, found `{text}`"), None);
                self.lexer.rest_of_line();
                self.line_tokens();
                return;
            }
        }
        if self.names.get(Symbol(name.value)) == "error" {
            let (text, span) = self.lexer.rest_of_line();
            self.line_tokens();
            self.report.add(Diagnostic::error(name.span.to(span), format!("#error: {text}")));
            return;
        }
        let line = self.line_tokens();
        self.named_directive(&name, &line);
        self.recycle(line);
    }

    fn named_directive(&mut self, name: &Token, line: &[Token]) {
        match self.names.get(Symbol(name.value)) {
            "define" => self.define(name, line),
            "undef" => self.undef(name, line),
            "if" => {
                let on = self.condition(name, line);
                self.open_conditional(name, on);
            }
            "ifdef" | "ifndef" => {
                let wanted = self.names.get(Symbol(name.value)) == "ifdef";
                let on = self.is_defined(name, line).map(|defined| defined == wanted);
                self.open_conditional(name, on.unwrap_or(false));
            }
            "elif" | "else" | "endif" => {
                if !self.next_group(name, line) {
                    self.skip();
                }
            }
            "line" => self.line_directive(name, line),
            "version" if self.is_plain => self.version(name, line),
            "extension" if self.is_plain => self.extension(name, line),
            // Hosts set a version of their own: the text's is the one it was written in, and the rules here accept all
            // of these.
            "version" | "extension" if self.dialect.ignores_late_directives() => {}
            "extension" if self.dialect.has_late_extensions() => self.extension(name, line),
            "version" => self.error(
                name,
                format!("`#version` must come first, and {} already has it", self.dialect.header()),
                Some(format!("delete the line: the language is always {}", self.dialect.language())),
            ),
            "extension" => self.error(
                name,
                format!("`#extension` must come before all declarations, but {} comes first", self.dialect.header()),
                Some(format!("delete the line: the feature is part of {} or not available", self.dialect.language())),
            ),
            "pragma" => self.pragma(line),
            "include" => self.include(name, line),
            other => {
                let other = other.to_owned();
                self.unknown_directive(name, &other, line);
            }
        }
    }

    /// Processes the version of a standalone text (section 3.3).
    fn version(&mut self, name: &Token, line: &[Token]) {
        let words: Vec<&str> = line.iter().map(|token| self.text(token.span)).collect();
        let message = match words[..] {
            ["300", "es"] if self.tokens.len() == self.earlier => return,
            ["300", "es"] => "`#version` must come before everything but comments".to_owned(),
            ["100"] | [] => "this is GLSL ES 1.00; only GLSL ES 3.00 is supported".to_owned(),
            _ => format!("`#version {}` is not supported", words.join(" ")),
        };
        let fix = match words[..] {
            ["300", "es"] => "move it to the first line",
            ["100"] | [] => {
                "write `#version 300 es`, `in` for attribute, `in` or `out` for varying, `texture` for texture2D, and \
                 `out vec4 color;` at file scope for gl_FragColor"
            }
            _ => "write `#version 300 es`, or delete the line: the language is always GLSL ES 3.00",
        };
        self.error(name, message, Some(fix.into()));
    }

    /// Processes an extension. None is supported; a text that only enables one is compiled without it (section 3.4).
    fn extension(&mut self, name: &Token, line: &[Token]) {
        let words: Vec<&str> = line.iter().map(|token| self.text(token.span)).collect();
        let (extension, behaviour) = match words[..] {
            [extension, ":", behaviour] => (extension.to_owned(), behaviour),
            _ => return self.error(name, "write `#extension NAME : enable`", None),
        };
        let message = format!("there is no extension `{extension}`");
        let hint = format!("delete the line: the feature is part of {} or not available", self.dialect.language());
        if behaviour == "require" {
            self.error(name, message, Some(hint));
        } else {
            self.report.add(Diagnostic::warning(name.span, message).hint(hint));
        }
    }

    /// Reads the remaining tokens of the directive's line.
    pub(super) fn line_tokens(&mut self) -> Vec<Token> {
        let mut line = self.spare.pop().unwrap_or_default();
        loop {
            let token = self.next_raw();
            match token.kind {
                Kind::Newline | Kind::Eof => return line,
                Kind::OpenComment => {
                    self.open_comment(&token);
                    return line;
                }
                _ => line.push(token),
            }
        }
    }

    fn recycle(&mut self, mut tokens: Vec<Token>) {
        tokens.clear();
        self.spare.push(tokens);
    }

    /// Ends a directive: further tokens on its line are an error, as in ANGLE.
    pub(super) fn nothing_more(&mut self, rest: &[Token], directive: &str) {
        if let Some(extra) = rest.first() {
            let text = self.text(extra.span).to_owned();
            self.error(extra, format!("unexpected `{text}` after `#{directive}`"), None);
        }
    }

    /// Evaluates `#ifdef` and `#ifndef`; `None` if no name follows.
    fn is_defined(&mut self, directive: &Token, line: &[Token]) -> Option<bool> {
        let text = self.text(directive.span).to_owned();
        let Some(name) = line.first().filter(|t| t.kind == Kind::Ident) else {
            let hint = format!("write `#{text} NAME`; for an expression use `#if`");
            self.error(line.first().unwrap_or(directive), format!("`#{text}` needs the name of a macro"), Some(hint));
            return None;
        };
        self.nothing_more(&line[1..], &text);
        let found = self.defined(name.value);
        self.origins.macro_uses.extend(found.map(|id| (name.span, id)));
        Some(found.is_some())
    }

    fn open_conditional(&mut self, name: &Token, on: bool) {
        self.conditionals.push(Conditional { at: *name, taken: on, seen_else: None });
        if !on {
            self.skip();
        }
    }

    /// Skips lines up to the group of the innermost conditional that is to be compiled, or its end.
    fn skip(&mut self) {
        let mut depth = 0;
        let mut from = self.lexer.here();
        loop {
            let found = self.lexer.skip_to_directive();
            let here = self.lexer.here();
            if !found {
                self.record_skipped(from.to(here));
                if self.next_piece() {
                    from = self.lexer.here();
                    continue;
                }
                return;
            }
            self.lexer.start_directive();
            let name = self.next_raw();
            let word = if name.kind == Kind::Ident { self.names.get(Symbol(name.value)) } else { "" };
            match word {
                "if" | "ifdef" | "ifndef" => depth += 1,
                "endif" if depth > 0 => depth -= 1,
                "elif" | "else" | "endif" if depth == 0 => {
                    // The `#` has been consumed.
                    self.record_skipped(Span { end: here.end.saturating_sub(1).max(from.start), ..from });
                    let line = self.line_tokens();
                    let compiled = self.next_group(&name, &line);
                    self.recycle(line);
                    if compiled {
                        return;
                    }
                    from = self.lexer.here();
                }
                _ => {}
            }
            self.lexer.end_directive();
        }
    }

    /// Records text that is not compiled.
    fn record_skipped(&mut self, span: Span) {
        if span.start < span.end {
            self.origins.inactive.push(span);
        }
    }

    /// Processes `#elif`, `#else` and `#endif` of the innermost conditional. Returns whether the following lines are
    /// compiled.
    fn next_group(&mut self, name: &Token, line: &[Token]) -> bool {
        let text = self.text(name.span).to_owned();
        if self.conditionals.is_empty() {
            self.error(name, format!("`#{text}` without an `#if` before it"), None);
            return true;
        }
        let last = self.conditionals.len() - 1;
        if text == "endif" {
            self.conditionals.pop();
            self.nothing_more(line, "endif");
            return true;
        }
        if let Some(earlier) = self.conditionals[last].seen_else {
            let message = format!("`#{text}` after the `#else` of the same `#if`");
            let diagnostic = Diagnostic::error(name.span, message)
                .label(earlier.span, "the `#else`")
                .label(self.conditionals[last].at.span, "the `#if`");
            self.report.add(diagnostic);
            return false;
        }
        let taken = self.conditionals[last].taken;
        let on = if text == "else" {
            self.nothing_more(line, "else");
            self.conditionals[last].seen_else = Some(*name);
            !taken
        } else {
            // After a compiled group, further conditions are not evaluated.
            !taken && self.condition(name, line)
        };
        self.conditionals[last].taken |= on;
        on
    }

    /// Checks a pragma: only one has a meaning, and not in a fragment shader.
    fn pragma(&mut self, line: &[Token]) {
        if let [stdgl, word, ..] = line
            && self.text(stdgl.span) == "STDGL"
            && self.text(word.span) == "invariant"
        {
            self.error(word, "`invariant(all)` is not allowed in a fragment shader", Some("delete the line".into()));
        }
        self.foreign_pragma(line);
    }
}
