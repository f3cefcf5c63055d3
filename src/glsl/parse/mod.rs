//! The parser (chapter 9): tokens to [`Ast`], with recovery.
//!
//! Owns [`parse`], every message about form, and reserved words. Whether names exist, types fit or a statement is at its place
//! is the checker's. No symbol table is needed: two names in a row are a declaration, a name before `[..](` a constructor, and
//! everything else is decided by the first tokens.
//!
//! Recovery: a mistake gives up the smallest group around it that can be told apart (an initialiser, a parameter, a condition,
//! a statement, a declaration), leaves an `Error` node there and goes on. A message is not repeated for the same token, and
//! nothing is said about operands that the preprocessor has reported.

pub(super) mod brackets;
mod decl;
mod expr;
mod function;
mod hint;
mod recover;
mod stmt;
mod tests;
mod types;

pub(super) use hint::foreign_type;

use super::{
    PassSource,
    ast::{Ast, Declarator, ExprId, ExprKind, Ident, Interner, Loc, MAX_NESTING, Origins, StmtId, Symbol, TokenId},
    lex::{Kind, words},
    pieces::{self, Piece},
    preprocess::{Tok, Unit, preprocess},
    report::Report,
};
use crate::diag::{Diagnostic, Span};

/// A pass as the checker takes it.
#[derive(Clone)]
pub(crate) struct Parsed {
    pub ast: Ast,
    pub origins: Origins,
    pub names: Interner,
    /// Errors and warnings of preprocessor and parser, in the order they were found.
    pub diagnostics: Vec<Diagnostic>,
}

/// Preprocesses and parses a pass behind its Common. Any text gives a tree.
pub(crate) fn parse(source: &PassSource<'_>) -> Parsed {
    let texts: Vec<_> = source.common.into_iter().chain([source.code]).collect();
    parse_texts(&pieces::of(&texts, source.includes), Unit::Pass(source.kind))
}

/// Preprocesses and parses texts that follow each other.
pub(super) fn parse_texts(pieces: &[Piece<'_>], unit: Unit) -> Parsed {
    let mut names = words::interner();
    let mut report = Report::default();
    let pre = preprocess(pieces, unit, &mut names, &mut report);
    let mut tokens = pre.tokens;
    brackets::pair(&mut tokens);
    let count = tokens.len();
    let mut parser = Parser {
        tokens,
        at: 0,
        ast: Ast::default(),
        origins: pre.origins,
        names: &names,
        report: &mut report,
        pieces,
        depth: 0,
        deepest: 0,
        expr_stack: Vec::new(),
        stmt_stack: Vec::new(),
        declarators: Vec::new(),
        last_error: pre.is_cut.then_some(count - 1),
        reserved_told: Vec::new(),
        structs: vec![false; names.len()],
        body: None,
        adrift: false,
        too_deep_told: false,
    };
    parser.ast.exprs.reserve(count / 2);
    parser.file();
    let Parser { ast, origins, .. } = parser;
    Parsed { ast, origins, names, diagnostics: report.diagnostics }
}

/// Something was not understood, and it was reported.
pub(super) struct Failed;

pub(super) type Parse<T> = Result<T, Failed>;

struct Parser<'p> {
    tokens: Vec<Tok>,
    /// The next token.
    at: usize,
    ast: Ast,
    origins: Origins,
    names: &'p Interner,
    report: &'p mut Report,
    pieces: &'p [Piece<'p>],
    /// Statements and expressions around the next token.
    depth: u32,
    /// The greatest `depth` since it was last looked at.
    deepest: u32,
    /// Children of lists that are being read, of all that are open.
    expr_stack: Vec<ExprId>,
    stmt_stack: Vec<StmtId>,
    /// Kept for its memory.
    declarators: Vec<Declarator>,
    /// Token of the last error.
    last_error: Option<usize>,
    /// Reserved words that were reported.
    reserved_told: Vec<u32>,
    /// Whether a struct has the name, by symbol.
    structs: Vec<bool>,
    /// The opening brace of the function that is being read, and its name.
    body: Option<(usize, Ident)>,
    /// A brace too many left the parser outside of functions; said once.
    adrift: bool,
    too_deep_told: bool,
}

/// Section 3.9 leaves the limit open; WebGL 2 has this one.
const MAX_NAME: usize = 1024;

/// How deep calls may nest before exact heights of trees are looked at: each call adds at most two levels.
const SAFE_DEPTH: u32 = 100;

impl Parser<'_> {
    #[inline]
    fn kind(&self) -> Kind {
        self.tokens[self.at].kind
    }

    #[inline]
    fn kind_at(&self, i: usize) -> Kind {
        self.tokens.get(i).map_or(Kind::Eof, |t| t.kind)
    }

    /// Kind of the token behind the next one.
    #[inline]
    fn second(&self) -> Kind {
        self.kind_at(self.at + 1)
    }

    #[inline]
    fn value(&self) -> u32 {
        self.tokens[self.at].value
    }

    #[inline]
    fn bump(&mut self) {
        // The end stays the next token for good.
        if self.at + 1 < self.tokens.len() {
            self.at += 1;
        }
    }

    #[inline]
    fn eat(&mut self, kind: Kind) -> bool {
        let found = self.kind() == kind;
        if found {
            self.bump();
        }
        found
    }

    /// The partner of a bracket.
    #[inline]
    fn partner(&self, i: usize) -> Option<usize> {
        let value = self.tokens[i].value;
        (value != brackets::ALONE).then_some(value as usize)
    }

    #[inline]
    fn token(i: usize) -> TokenId {
        TokenId(i as u32)
    }

    /// From a token to the last one read.
    #[inline]
    fn loc(&self, first: usize) -> Loc {
        Loc::new(Self::token(first), Self::token(self.at.saturating_sub(1).max(first)))
    }

    #[inline]
    fn enter(&mut self) -> Parse<()> {
        self.depth += 1;
        self.deepest = self.deepest.max(self.depth);
        if self.depth > MAX_NESTING { Err(self.too_deep(self.at)) } else { Ok(()) }
    }

    #[inline]
    fn leave(&mut self) {
        self.depth -= 1;
    }

    #[cold]
    fn too_deep(&mut self, i: usize) -> Failed {
        if !std::mem::replace(&mut self.too_deep_told, true) {
            let message = format!("this nests more than {MAX_NESTING} deep");
            self.error(i, message, Some("give a part of it a name or a function of its own".into()));
        }
        self.last_error = Some(i);
        Failed
    }

    /// Runs a part that may fail. Where it does, what it began is taken back, so that no half tree is left.
    fn attempt<T>(&mut self, part: impl FnOnce(&mut Self) -> Parse<T>) -> Parse<T> {
        let (depth, exprs) = (self.depth, self.ast.exprs.len());
        let (expr_stack, stmt_stack) = (self.expr_stack.len(), self.stmt_stack.len());
        let result = part(self);
        if result.is_err() {
            self.depth = depth;
            self.ast.exprs.truncate(exprs);
            self.expr_stack.truncate(expr_stack);
            self.stmt_stack.truncate(stmt_stack);
        }
        result
    }

    /// A closing bracket for the opening one at `open`.
    fn close(&mut self, open: usize, wanted: Kind) -> Parse<()> {
        if self.eat(wanted) {
            return Ok(());
        }
        let closer = match wanted {
            Kind::RParen => "`)`",
            Kind::RBracket => "`]`",
            _ => "`}`",
        };
        if self.partner(open).is_none() {
            // The rest may be in order: go on as if it stood here where something else plainly begins.
            self.missing(closer, None, Some((open, "opened here")));
            if matches!(self.kind(), Kind::Semicolon | Kind::LBrace) {
                return Ok(());
            }
            return Err(Failed);
        }
        Err(self.unexpected(&format!("an operator or {closer}")))
    }

    /// `;` behind a statement or declaration. Where a new line follows it is only missing, and all goes on.
    fn semicolon(&mut self) -> Parse<()> {
        if self.eat(Kind::Semicolon) {
            return Ok(());
        }
        let here = self.at;
        if here > 0 && self.kind_at(here - 1) == Kind::Wrong {
            return Ok(());
        }
        if self.starts_line(here) && self.begins_anew(here) || matches!(self.kind(), Kind::RBrace | Kind::Eof) {
            self.missing("`;`", None, None);
            return Ok(());
        }
        Err(self.unexpected("`;`"))
    }

    /// A token that can begin a statement or declaration.
    fn begins_anew(&self, i: usize) -> bool {
        !matches!(
            self.kind_at(i),
            Kind::RParen
                | Kind::RBracket
                | Kind::Dot
                | Kind::Comma
                | Kind::Colon
                | Kind::Question
                | Kind::Equal
                | Kind::PlusEqual
                | Kind::MinusEqual
                | Kind::StarEqual
                | Kind::SlashEqual
                | Kind::PercentEqual
                | Kind::LessLessEqual
                | Kind::GreaterGreaterEqual
                | Kind::AndEqual
                | Kind::OrEqual
                | Kind::CaretEqual
        )
    }

    /// A name that is being declared.
    fn declared(&mut self, what: &str) -> Parse<Ident> {
        let i = self.at;
        let ident = self.ident(what)?;
        let name = self.names.get(ident.symbol);
        let kept = if name.starts_with("gl_") {
            Some("names that begin with `gl_` are kept for the language")
        } else if name.starts_with("webgl_") || name.starts_with("_webgl_") {
            Some("names that begin with `webgl_` or `_webgl_` are kept for WebGL")
        } else if name.contains("__") {
            Some("names with two underscores in a row are kept for the language")
        } else if name.len() > MAX_NAME {
            self.error(i, format!("this name has more than {MAX_NAME} characters"), None);
            None
        } else {
            None
        };
        if let Some(rule) = kept {
            self.error(i, format!("`{name}`: {rule}"), Some("choose another name".into()));
        }
        Ok(ident)
    }

    /// A name. A reserved word is reported once and taken for one.
    fn ident(&mut self, what: &str) -> Parse<Ident> {
        let i = self.at;
        match self.kind() {
            Kind::Ident => {}
            Kind::Reserved => self.reserved(i),
            Kind::Wrong => {
                self.bump();
                return Err(Failed);
            }
            kind if hint::is_keyword(kind) => {
                let message = format!("expected {what}, found {}, which is a keyword", self.quoted(i));
                return Err(self.fail(i, message, Some("choose another name".into())));
            }
            _ => {
                let message = format!("expected {what}, found {}", self.shown(i));
                return Err(self.fail(i, message, None));
            }
        }
        let symbol = Symbol(self.value());
        self.bump();
        Ok(Ident { symbol, token: Self::token(i) })
    }

    /// Reports a reserved word, once.
    fn reserved(&mut self, i: usize) {
        let symbol = self.tokens[i].value;
        if self.reserved_told.contains(&symbol) {
            return;
        }
        self.reserved_told.push(symbol);
        let word = self.text(i).to_owned();
        let hint = hint::reserved(&word).map_or_else(|| "choose another name".to_owned(), str::to_owned);
        self.error(i, format!("`{word}` is a reserved word of GLSL ES"), Some(hint));
    }

    fn error_expr(&mut self, first: usize) -> ExprId {
        let loc = self.loc(first);
        self.ast.expr(ExprKind::Error, loc)
    }
}
