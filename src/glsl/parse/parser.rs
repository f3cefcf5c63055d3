//! The parser's state, and what every rule of the grammar needs: tokens, positions, depth, names.

use super::{brackets, hint};
use crate::{
    ast::{Ast, Declarator, ExprId, ExprKind, Ident, Interner, Loc, MAX_NESTING, Origins, StmtId, Symbol, TokenId},
    cancel::Cancel,
    lex::Kind,
    pieces::Piece,
    preprocess::{Tok, Unit},
    report::Report,
    source::Dialect,
};

/// A part could not be parsed, and the error was reported.
pub(super) struct Failed;

pub(super) type Parse<T> = Result<T, Failed>;

pub(super) struct Parser<'p> {
    pub tokens: Vec<Tok>,
    /// The next token.
    pub at: usize,
    pub ast: Ast,
    pub origins: Origins,
    pub names: &'p Interner,
    pub report: &'p mut Report,
    pub pieces: &'p [Piece<'p>],
    pub unit: Unit,
    pub dialect: Dialect,
    pub cancel: Cancel<'p>,
    /// The number of statements around the next token.
    pub depth: u32,
    /// The number of parentheses, operators and calls around it in its expression.
    pub levels: u32,
    /// Children of all lists that are being parsed.
    pub expr_stack: Vec<ExprId>,
    pub stmt_stack: Vec<StmtId>,
    /// Kept to reuse its allocation.
    pub declarators: Vec<Declarator>,
    /// Token of the last error.
    pub last_error: Option<usize>,
    /// Reserved words that were reported.
    pub reported_reserved: Vec<u32>,
    /// True if a struct has the name, by symbol.
    pub structs: Vec<bool>,
    /// The opening brace and the name of the function that is being parsed.
    pub body: Option<(usize, Ident)>,
    /// A surplus closing brace left the parser outside of functions; reported once.
    pub is_outside_functions: bool,
    pub reported_too_deep: bool,
}

/// Section 3.9 does not define the limit; this is WebGL 2's.
const MAX_NAME: usize = 1024;

/// Variables of the language that a text of later versions may declare again, with other qualifiers (GLSL 4.60, section
/// 7.1.5).
const REDECLARED: [&str; 2] = ["gl_FragCoord", "gl_FragDepth"];

/// The depth to which an expression may nest as written, including parentheses. ANGLE's parser keeps at most 10,000
/// symbols, of which each level takes one or more. The checker limits the depth of its tree.
pub(super) const MAX_LEVELS: u32 = 10_000;

impl Parser<'_> {
    #[inline]
    pub(super) fn kind(&self) -> Kind {
        self.tokens[self.at].kind
    }

    #[inline]
    pub(super) fn kind_at(&self, i: usize) -> Kind {
        self.tokens.get(i).map_or(Kind::Eof, |t| t.kind)
    }

    /// Returns the kind of the token after the next one.
    #[inline]
    pub(super) fn second(&self) -> Kind {
        self.kind_at(self.at + 1)
    }

    #[inline]
    pub(super) fn value(&self) -> u32 {
        self.tokens[self.at].value
    }

    #[inline]
    pub(super) fn bump(&mut self) {
        // The parser never moves past the end token.
        if self.at + 1 < self.tokens.len() {
            self.at += 1;
        }
    }

    #[inline]
    pub(super) fn eat(&mut self, kind: Kind) -> bool {
        let found = self.kind() == kind;
        if found {
            self.bump();
        }
        found
    }

    /// Returns the partner of a bracket.
    #[inline]
    pub(super) fn partner(&self, i: usize) -> Option<usize> {
        let value = self.tokens[i].value;
        (value != brackets::ALONE).then_some(value as usize)
    }

    #[inline]
    pub(super) fn token(i: usize) -> TokenId {
        TokenId(i as u32)
    }

    /// Returns the range from a token to the last consumed one.
    #[inline]
    pub(super) fn loc(&self, first: usize) -> Loc {
        Loc::new(Self::token(first), Self::token(self.at.saturating_sub(1).max(first)))
    }

    #[inline]
    pub(super) fn enter(&mut self) -> Parse<()> {
        self.depth += 1;
        if self.depth > MAX_NESTING { Err(self.too_deep(self.at, MAX_NESTING)) } else { Ok(()) }
    }

    #[inline]
    pub(super) fn leave(&mut self) {
        self.depth -= 1;
    }

    #[cold]
    pub(super) fn too_deep(&mut self, i: usize, limit: u32) -> Failed {
        if !std::mem::replace(&mut self.reported_too_deep, true) {
            let message = format!("this is nested more than {limit} levels deep");
            self.error(i, message, Some("move a part of it to a variable or a function".into()));
        }
        self.last_error = Some(i);
        Failed
    }

    /// Runs a part that may fail. If it does, its expressions are discarded, so that no incomplete tree is left.
    pub(super) fn with_rollback<T>(&mut self, part: impl FnOnce(&mut Self) -> Parse<T>) -> Parse<T> {
        let (depth, levels, exprs) = (self.depth, self.levels, self.ast.exprs.len());
        let (expr_stack, stmt_stack) = (self.expr_stack.len(), self.stmt_stack.len());
        let result = part(self);
        if result.is_err() {
            (self.depth, self.levels) = (depth, levels);
            self.ast.exprs.truncate(exprs);
            self.expr_stack.truncate(expr_stack);
            self.stmt_stack.truncate(stmt_stack);
        }
        result
    }

    /// Parses the closing bracket for the opening one at `open`.
    pub(super) fn close(&mut self, open: usize, wanted: Kind) -> Parse<()> {
        if self.eat(wanted) {
            return Ok(());
        }
        let closer = match wanted {
            Kind::RParen => "`)`",
            Kind::RBracket => "`]`",
            _ => "`}`",
        };
        if self.partner(open).is_none() {
            // The rest may be correct: continue as if it were here if something else clearly starts.
            self.missing(closer, None, Some((open, "opened here")));
            if matches!(self.kind(), Kind::Semicolon | Kind::LBrace) {
                return Ok(());
            }
            return Err(Failed);
        }
        Err(self.unexpected(&format!("an operator or {closer}")))
    }

    /// Parses the `;` after a statement or declaration. Before a new line it is only missing, and parsing continues.
    pub(super) fn semicolon(&mut self) -> Parse<()> {
        if self.eat(Kind::Semicolon) {
            return Ok(());
        }
        let here = self.at;
        if here > 0 && self.kind_at(here - 1) == Kind::Wrong {
            return Ok(());
        }
        if self.starts_line(here) && self.starts_statement(here) || matches!(self.kind(), Kind::RBrace | Kind::Eof) {
            self.missing("`;`", None, None);
            return Ok(());
        }
        Err(self.unexpected("`;`"))
    }

    /// Returns whether a token can start a statement or declaration.
    pub(super) fn starts_statement(&self, i: usize) -> bool {
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

    /// Parses a name that is being declared.
    pub(super) fn declared(&mut self, what: &str) -> Parse<Ident> {
        let i = self.at;
        let ident = self.ident(what)?;
        let name = self.names.get(ident.symbol);
        let kept = if self.dialect.is_any() && REDECLARED.contains(&name) {
            None
        } else if name.starts_with("gl_") {
            Some("names that start with `gl_` are reserved")
        } else if name.starts_with("webgl_") || name.starts_with("_webgl_") {
            Some("names that start with `webgl_` or `_webgl_` are reserved for WebGL")
        } else if name.as_bytes().windows(2).any(|two| two == b"__") {
            Some("names with two underscores in a row are reserved")
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

    /// Parses a name. A reserved word is reported once and accepted as a name.
    pub(super) fn ident(&mut self, what: &str) -> Parse<Ident> {
        let i = self.at;
        match self.kind() {
            Kind::Ident => {}
            Kind::Reserved => self.reserved(i),
            Kind::Wrong => {
                self.bump();
                return Err(Failed);
            }
            kind if kind.is_keyword() => {
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
    pub(super) fn reserved(&mut self, i: usize) {
        let symbol = self.tokens[i].value;
        if self.reported_reserved.contains(&symbol) {
            return;
        }
        self.reported_reserved.push(symbol);
        let word = self.text(i).to_owned();
        if self.dialect.is_any()
            && let Some(message) = hint::double_precision(&word)
        {
            let meant = hint::foreign_type(&word).map(|ty| format!("write `{}`", ty.name()));
            self.error(i, message, meant);
            return;
        }
        let hint = hint::reserved(&word, self.unit).map_or_else(|| "choose another name".to_owned(), str::to_owned);
        self.error(i, format!("`{word}` is a reserved word of GLSL ES"), Some(hint));
    }

    pub(super) fn error_expr(&mut self, first: usize) -> ExprId {
        let loc = self.loc(first);
        self.ast.expr(ExprKind::Error, loc)
    }
}
