//! The preprocessor's state: texts, macros, tokens for the parser.

use super::{
    macros::{MacroOrigin, MacroTable},
    preprocessed::{Preprocessed, Tok},
    unit::{LineCount, Unit},
};
use crate::{
    ast::{Interner, MacroDef, MacroId, Origin, Origins},
    cancel::Cancel,
    lex::{Kind, LINE_START, Lexer, Token, words},
    pieces::Piece,
    report::Report,
    source::Dialect,
};
use eddy_diag::{Diagnostic, Edit, Fix, Severity, SourceId, Span};

/// The limit of tokens that macros may produce; tokens that are read repeatedly count each time. Ten times what the
/// largest known shader needs; an exponential expansion reaches it in a fraction of a second.
pub(super) const MAX_MACRO_TOKENS: u32 = 2_000_000;
/// The limit of macro calls nested in each other's arguments: somewhat more than ANGLE's 1,000.
pub(super) const MAX_CALL_DEPTH: u32 = 1024;

/// An open `#if`.
pub(super) struct Conditional {
    pub at: Token,
    /// One of its groups was compiled.
    pub taken: bool,
    pub seen_else: Option<Token>,
}

/// Tokens to be read before the running text continues.
pub(super) struct Context {
    pub start: u32,
    pub next: u32,
    pub end: u32,
    /// The macro they come from; `None` for an argument or a directive's line, where reading ends.
    pub source: Option<MacroId>,
}

pub(super) struct Preprocessor<'a, 'r> {
    pub pieces: &'r [Piece<'a>],
    /// Reads the current piece.
    pub lexer: Lexer<'a>,
    /// The piece that is being read.
    pub current: usize,
    pub names: &'r mut Interner,
    pub report: &'r mut Report,
    pub origins: Origins,
    pub tokens: Vec<Tok>,
    /// The number of tokens of texts that were read before.
    pub earlier: usize,
    pub table: MacroTable,
    pub contexts: Vec<Context>,
    /// Tokens of the contexts, in the same order.
    pub pool: Vec<Token>,
    pub peeked: Option<Token>,
    pub conditionals: Vec<Conditional>,
    /// Macros whose names stay busy until a call's arguments are complete.
    pub waiting: Vec<MacroId>,
    pub collecting: u32,
    pub call_depth: u32,
    /// A limit was exceeded: reading has ended.
    pub stopped: bool,
    pub is_cut: bool,
    pub spare: Vec<Vec<Token>>,
    /// Names with non-ASCII letters that were reported.
    pub foreign: Vec<u32>,
    /// The diagnostic that reports a Markdown fence.
    pub fence: Option<usize>,
    pub line: LineCount,
    /// No other text precedes it, so that it may start with its version and extensions.
    pub is_plain: bool,
    pub dialect: Dialect,
    pub cancel: Cancel<'r>,
}

impl<'a, 'r> Preprocessor<'a, 'r> {
    /// Starts before the first piece that is not done.
    ///
    /// # Panics
    /// If there is none.
    pub(super) fn new(
        pieces: &'r [Piece<'a>],
        (unit, dialect, cancel): (Unit, Dialect, Cancel<'r>),
        done: Preprocessed,
        names: &'r mut Interner,
        report: &'r mut Report,
    ) -> Self {
        let Preprocessed { pieces: current, tokens, origins, macros: table, .. } = done;
        let bytes: usize = pieces[current..].iter().map(|p| p.range.len()).sum();
        let is_new = table.macros.is_empty();
        let mut new = Self {
            pieces,
            lexer: lexer(&pieces[current]),
            current,
            names,
            report,
            origins,
            earlier: tokens.len(),
            tokens,
            table,
            contexts: Vec::new(),
            pool: Vec::new(),
            peeked: None,
            conditionals: Vec::new(),
            waiting: Vec::new(),
            collecting: 0,
            call_depth: 0,
            stopped: false,
            is_cut: false,
            spare: Vec::new(),
            foreign: Vec::new(),
            fence: None,
            line: LineCount::new(unit),
            is_plain: matches!(unit, Unit::Pass(kind) if kind.is_plain()),
            dialect,
            cancel,
        };
        // Shaders have about one token per four bytes, comments included.
        new.tokens.reserve(bytes / 4 + 16);
        new.origins.tokens.reserve(bytes / 4 + 16);
        if is_new {
            for (name, origin) in MacroOrigin::all(dialect) {
                let name = new.names.intern(name);
                let def = MacroDef { name, name_at: None, defined_at: None, function_like: false };
                new.add_macro(def, (0, 0), (0, 0), origin);
            }
        }
        new
    }

    pub(super) fn run(&mut self, unit: Unit) {
        loop {
            let token = self.next_expanded();
            if token.kind == Kind::Eof {
                break;
            }
            self.emit(token);
        }
        if let Unit::Pass(kind) = unit
            && !self.stopped
        {
            self.wrap_entry(kind);
        }
        for open in std::mem::take(&mut self.conditionals) {
            self.is_cut = true;
            if !self.stopped {
                let name = self.text(open.at.span).to_owned();
                self.error(&open.at, format!("`#{name}` has no `#endif`"), None);
            }
        }
        if self.stopped {
            // Half a text would only cause messages about the missing half.
            self.tokens.truncate(self.earlier);
            self.origins.tokens.truncate(self.earlier);
        }
        if self.dialect.is_any() {
            self.free_later_keywords();
        }
        let last = self.pieces.last().map_or(Span::at(SourceId(0), 0), |p| Span::at(p.text.id, p.text.text.len()));
        self.tokens.push(Tok { kind: Kind::Eof, value: 0 });
        self.origins.tokens.push(Origin { spelled: last, expansion: None });
    }

    /// Turns keywords that GLSL 1.30 and later versions add into names where they cannot be keywords: an interpolation
    /// qualifier comes before other qualifiers or a type.
    fn free_later_keywords(&mut self) {
        for i in self.earlier..self.tokens.len() {
            let next = self.tokens.get(i + 1).map_or(Kind::Eof, |token| token.kind);
            let is_keyword = match self.tokens[i].kind {
                Kind::Flat | Kind::Smooth | Kind::Centroid => next.is_qualifier() || next == Kind::Type,
                _ => true,
            };
            if !is_keyword {
                self.tokens[i].kind = Kind::Ident;
            }
        }
    }

    /// Passes a token to the parser.
    #[inline]
    pub(super) fn emit(&mut self, token: Token) {
        let (kind, value) = match token.kind {
            Kind::Ident if self.dialect.is_any() => (words::kind_in_any_version(token.value), token.value),
            Kind::Ident => (words::kind(token.value), token.value),
            Kind::BadNumber
            | Kind::BadChar
            | Kind::BadName
            | Kind::Text
            | Kind::Hash
            | Kind::HashHash
            | Kind::Newline
            | Kind::OpenComment
            | Kind::Param => match self.report_invalid_token(&token) {
                Some(mended) => mended,
                None => return,
            },
            kind => (kind, token.value),
        };
        self.tokens.push(Tok { kind, value });
        self.origins.tokens.push(Origin { spelled: token.span, expansion: token.expansion });
    }

    /// Returns the next token of the current text, unprocessed.
    #[inline]
    pub(super) fn next_raw(&mut self) -> Token {
        self.lexer.next(self.names)
    }

    /// Returns the next token of the running text; directives before it are processed.
    #[inline]
    pub(super) fn next_in_piece(&mut self) -> Token {
        if let Some(token) = self.peeked.take() {
            return token;
        }
        loop {
            let token = self.next_raw();
            match token.kind {
                Kind::Hash if token.has(LINE_START) => self.directive(token),
                Kind::Eof if self.next_piece() => {
                    if let Some(missing) = self.pieces[self.current].missing {
                        self.report.add(missing.clone());
                    }
                }
                Kind::OpenComment => self.open_comment(&token),
                Kind::BadChar | Kind::Hash if self.is_misplaced(&token) => {}
                _ if token.has(LINE_START) && self.hides_directive(&token) => {}
                _ => return token,
            }
            if self.stopped {
                return end_token(token);
            }
        }
    }

    /// Continues with the next piece, if there is one.
    pub(super) fn next_piece(&mut self) -> bool {
        let Some(next) = self.pieces.get(self.current + 1) else { return false };
        self.current += 1;
        self.lexer = lexer(next);
        true
    }

    pub(super) fn open_comment(&mut self, token: &Token) {
        self.is_cut = true;
        self.error(
            token,
            "this comment is not closed: it hides the rest of the file",
            Some("close it with `*/`".into()),
        );
    }

    #[inline]
    pub(super) fn defined(&self, symbol: u32) -> Option<MacroId> {
        match self.table.defined.get(symbol as usize) {
            Some(&id) if id > 0 => Some(MacroId::new(id as usize - 1)),
            _ => None,
        }
    }

    pub(super) fn text(&self, span: Span) -> &'a str {
        self.pieces.iter().find(|p| p.text.id == span.source).and_then(|p| p.text.text.get(span.range())).unwrap_or("")
    }

    /// Returns whether a span is at the end of its text.
    pub(super) fn ends_text(&self, span: Span) -> bool {
        self.pieces.iter().any(|p| p.text.id == span.source && p.text.text.len() == span.range().end)
    }

    /// Returns the place where the author wrote the text of this token.
    pub(super) fn place(&self, token: &Token) -> Span {
        token.expansion.map_or(token.span, |id| self.origins[id].used_at)
    }

    /// Reports an error with the replacement text of the fix.
    pub(super) fn error_with(&mut self, token: &Token, message: String, hint: Option<String>, text: Option<&str>) {
        let before = self.report.diagnostics.len();
        self.error(token, message, hint);
        if let (Some(text), None) = (text, token.expansion)
            && let Some(new) = self.report.diagnostics.get_mut(before)
        {
            new.fixes.push(match text {
                "" => Fix::new("Delete it", vec![Edit { span: token.span, text: String::new() }]),
                " " => Fix::new("Replace with a space", vec![Edit { span: token.span, text: text.to_owned() }]),
                text => Fix::replace(token.span, text),
            });
        }
    }

    pub(super) fn diagnose(&mut self, severity: Severity, token: &Token, message: String, hint: Option<String>) {
        let mut diagnostic = Diagnostic::new(severity, self.place(token), message);
        if let Some(id) = token.expansion {
            let name = self.names.get(self.origins[self.origins[id].macro_id].name);
            diagnostic = diagnostic.label(token.span, format!("in the definition of the macro `{name}`"));
        }
        diagnostic.hints.extend(hint);
        self.report.add_in_macro(token.expansion.map(|_| token.span), diagnostic);
    }

    pub(super) fn error(&mut self, token: &Token, message: impl Into<String>, hint: Option<String>) {
        self.diagnose(Severity::Error, token, message.into(), hint);
    }

    pub(super) fn warning(&mut self, token: &Token, message: impl Into<String>, hint: Option<String>) {
        self.diagnose(Severity::Warning, token, message.into(), hint);
    }

    /// Reports an error that ends reading: the rest would be meaningless.
    pub(super) fn stop(&mut self, token: &Token, message: String, hint: Option<String>) {
        if !self.stopped {
            self.error(token, message, hint);
        }
        self.stopped = true;
    }
}

fn lexer<'a>(piece: &Piece<'a>) -> Lexer<'a> {
    Lexer::part(piece.text.id, piece.text.text, piece.range.clone())
}

pub(super) fn end_token(like: Token) -> Token {
    Token { kind: Kind::Eof, ..like }
}
