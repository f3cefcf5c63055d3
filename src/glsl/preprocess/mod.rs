//! The preprocessor (section 3.4): directives and macros, from the texts of a pass to the tokens the parser reads.
//!
//! Owns [`preprocess`], [`Origins`] as it fills them, and every message about directives, macros and characters. It sees the
//! texts one after another as the site does (Common, then the pass's code, and in them what they include): macros and open conditionals carry over.
//!
//! Follows ANGLE, which compiles for every browser, in what the specification leaves open: an unknown name in an `#if` is an
//! error unless `&&` or `||` passes it by; there is no pasting with `##`; a macro's name met while the macro is being expanded
//! is left alone for good.

mod characters;
mod condition;
mod define;
mod directive;
mod entry;
mod expand;
mod lines;
mod tests;

use super::{
    PassKind,
    ast::{Expansion, ExpansionId, Interner, MacroDef, MacroId, Origin, Origins, Symbol},
    lex::{Kind, LINE_START, Lexer, Token, bad_number, words},
    pieces::Piece,
    report::Report,
};
use crate::diag::{Diagnostic, Severity, Span};
#[cfg(test)]
pub(super) use directive::DIRECTIVES;
use lines::LineCount;
pub(super) use lines::Unit;

/// A token as the parser reads it. Its place is `Origins::tokens` of the same index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tok {
    pub kind: Kind,
    /// What [`Kind`] says; for brackets the parser's index of the partner.
    pub value: u32,
}

/// Tokens that macros may produce, those that are read again and again counted each time. Ten times what the largest known
/// shader needs; a bomb reaches it in a fraction of a second.
pub(super) const MAX_MACRO_TOKENS: u32 = 2_000_000;
/// How deep macro calls may stand in each other's arguments.
pub(super) const MAX_CALL_DEPTH: u32 = 200;

/// What the parser goes on with.
pub(super) struct Preprocessed {
    /// As many as `origins.tokens`; the last is `Eof`.
    pub tokens: Vec<Tok>,
    pub origins: Origins,
    /// The text ends before its end, which was reported: an open comment or conditional hides what may be missing.
    pub is_cut: bool,
}

/// Runs the texts through.
pub(super) fn preprocess(pieces: &[Piece<'_>], unit: Unit, names: &mut Interner, report: &mut Report) -> Preprocessed {
    let mut all = Preprocessor::new(pieces, unit, names, report);
    all.run(unit);
    Preprocessed { tokens: all.tokens, origins: all.origins, is_cut: all.is_cut }
}

struct Macro {
    /// Range of [`Preprocessor::bodies`].
    body: (u32, u32),
    /// Symbols of the parameters, a range of [`Preprocessor::params`].
    params: (u32, u32),
    /// Its text is being read; the name is not to be expanded now.
    busy: bool,
    /// Calls whose arguments are being read.
    calls: u32,
    given: Given,
    /// Its first use, through which uses inside its body are recorded once.
    first_use: Option<ExpansionId>,
}

/// Where a macro's value comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Given {
    ByAuthor,
    /// `HW_PERFORMANCE`, defined by the site's header like any macro.
    BySite(u32),
    /// Part of the language: nobody may define or undefine it.
    ByLanguage(u32),
    LineNumber,
    FileNumber,
}

/// An `#if` that is open.
struct Conditional {
    at: Token,
    /// One of its groups was compiled.
    taken: bool,
    seen_else: Option<Token>,
}

/// Tokens to be read before the running text goes on.
struct Context {
    start: u32,
    next: u32,
    end: u32,
    /// The macro they come from; `None` for an argument or a directive's line, where reading ends.
    source: Option<MacroId>,
}

struct Preprocessor<'a, 'r> {
    pieces: &'r [Piece<'a>],
    lexers: Vec<Lexer<'a>>,
    current: usize,
    names: &'r mut Interner,
    report: &'r mut Report,
    origins: Origins,
    tokens: Vec<Tok>,
    /// By symbol: the number of its macro plus one.
    defined: Vec<u32>,
    macros: Vec<Macro>,
    bodies: Vec<Token>,
    params: Vec<u32>,
    contexts: Vec<Context>,
    /// Tokens of the contexts, in the same order.
    pool: Vec<Token>,
    peeked: Option<Token>,
    conditionals: Vec<Conditional>,
    /// Macros that wait until a call's arguments are complete before their names are free again.
    waiting: Vec<MacroId>,
    collecting: u32,
    call_depth: u32,
    /// Tokens that macros have produced.
    work: u32,
    /// A limit was passed: nothing more is read.
    stopped: bool,
    is_cut: bool,
    spare: Vec<Vec<Token>>,
    /// Names with foreign letters that were reported.
    foreign: Vec<u32>,
    line: LineCount,
}

impl<'a, 'r> Preprocessor<'a, 'r> {
    fn new(pieces: &'r [Piece<'a>], unit: Unit, names: &'r mut Interner, report: &'r mut Report) -> Self {
        let bytes: usize = pieces.iter().map(|p| p.range.len()).sum();
        let mut new = Self {
            pieces,
            lexers: pieces.iter().map(|p| Lexer::part(p.text.id, p.text.text, p.range.clone())).collect(),
            current: 0,
            names,
            report,
            origins: Origins::default(),
            // A token for four bytes is what shaders have, comments included.
            tokens: Vec::with_capacity(bytes / 4 + 16),
            defined: Vec::new(),
            macros: Vec::new(),
            bodies: Vec::new(),
            params: Vec::new(),
            contexts: Vec::new(),
            pool: Vec::new(),
            peeked: None,
            conditionals: Vec::new(),
            waiting: Vec::new(),
            collecting: 0,
            call_depth: 0,
            work: 0,
            stopped: false,
            is_cut: false,
            spare: Vec::new(),
            foreign: Vec::new(),
            line: LineCount::new(unit),
        };
        new.origins.tokens.reserve(bytes / 4 + 16);
        for (name, given) in [
            ("__LINE__", Given::LineNumber),
            ("__FILE__", Given::FileNumber),
            ("__VERSION__", Given::ByLanguage(300)),
            ("GL_ES", Given::ByLanguage(1)),
            ("GL_FRAGMENT_PRECISION_HIGH", Given::ByLanguage(1)),
            ("HW_PERFORMANCE", Given::BySite(1)),
        ] {
            let name = new.names.intern(name);
            let def = MacroDef { name, name_at: None, defined_at: None, function_like: false };
            new.add_macro(def, (0, 0), (0, 0), given);
        }
        new
    }

    fn run(&mut self, unit: Unit) {
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
            // Half a text would only give messages about its other half.
            self.tokens.clear();
            self.origins.tokens.clear();
        }
        let last = self
            .pieces
            .last()
            .map_or(Span::at(crate::diag::SourceId(0), 0), |p| Span::at(p.text.id, p.text.text.len()));
        self.tokens.push(Tok { kind: Kind::Eof, value: 0 });
        self.origins.tokens.push(Origin { spelled: last, expansion: None });
    }

    /// Hands a token to the parser.
    #[inline]
    fn emit(&mut self, token: Token) {
        let (kind, value) = match token.kind {
            Kind::Ident => (words::kind(token.value), token.value),
            Kind::BadNumber
            | Kind::BadChar
            | Kind::BadName
            | Kind::Text
            | Kind::Hash
            | Kind::HashHash
            | Kind::Newline
            | Kind::OpenComment
            | Kind::Param => match self.mend(&token) {
                Some(mended) => mended,
                None => return,
            },
            kind => (kind, token.value),
        };
        self.tokens.push(Tok { kind, value });
        self.origins.tokens.push(Origin { spelled: token.span, expansion: token.expansion });
    }

    /// The next token of the current text, with nothing done to it.
    #[inline]
    fn raw(&mut self) -> Token {
        self.lexers[self.current].next(self.names)
    }

    /// The next token of the running text, directives carried out on the way.
    #[inline]
    fn running(&mut self) -> Token {
        if let Some(token) = self.peeked.take() {
            return token;
        }
        loop {
            let token = self.raw();
            match token.kind {
                Kind::Hash if token.has(LINE_START) => self.directive(token),
                Kind::Eof if self.current + 1 < self.lexers.len() => self.current += 1,
                Kind::OpenComment => self.open_comment(&token),
                _ => return token,
            }
            if self.stopped {
                return end_token(token);
            }
        }
    }

    fn open_comment(&mut self, token: &Token) {
        self.is_cut = true;
        self.error(
            token,
            "this comment is not closed: it hides the rest of the text",
            Some("close it with `*/`".into()),
        );
    }

    #[inline]
    fn defined(&self, symbol: u32) -> Option<MacroId> {
        match self.defined.get(symbol as usize) {
            Some(&id) if id > 0 => Some(MacroId::new(id as usize - 1)),
            _ => None,
        }
    }

    fn text(&self, span: Span) -> &'a str {
        self.pieces.iter().find(|p| p.text.id == span.source).and_then(|p| p.text.text.get(span.range())).unwrap_or("")
    }

    /// Where the author wrote what became this token.
    fn place(&self, token: &Token) -> Span {
        token.expansion.map_or(token.span, |id| self.origins[id].used_at)
    }

    fn diagnose(&mut self, severity: Severity, token: &Token, message: String, hint: Option<String>) {
        let mut diagnostic = Diagnostic::new(severity, self.place(token), message);
        if let Some(id) = token.expansion {
            let name = self.names.get(self.origins[self.origins[id].macro_id].name);
            diagnostic = diagnostic.label(token.span, format!("in the definition of the macro `{name}`"));
        }
        diagnostic.hints.extend(hint);
        self.report.add_in_macro(token.expansion.map(|_| token.span), diagnostic);
    }

    fn error(&mut self, token: &Token, message: impl Into<String>, hint: Option<String>) {
        self.diagnose(Severity::Error, token, message.into(), hint);
    }

    fn warning(&mut self, token: &Token, message: impl Into<String>, hint: Option<String>) {
        self.diagnose(Severity::Warning, token, message.into(), hint);
    }

    /// An error that ends the reading: what follows would make no sense.
    fn stop(&mut self, token: &Token, message: String, hint: Option<String>) {
        if !self.stopped {
            self.error(token, message, hint);
        }
        self.stopped = true;
    }
}

fn end_token(like: Token) -> Token {
    Token { kind: Kind::Eof, ..like }
}
