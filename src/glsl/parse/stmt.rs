//! Statements (chapter 6).

use super::parser::{Failed, Parse, Parser};
use crate::{
    ast::{Condition, DeclKind, List, StmtId, StmtKind},
    lex::Kind,
    near::nearest_identifier,
};
use eddy_diag::Diagnostic;

impl Parser<'_> {
    /// Parses `{ .. }`: its statements, with each error confined to its statement.
    pub(super) fn statements(&mut self) -> Parse<List<StmtId>> {
        let open = self.at;
        self.bump();
        let mark = self.stmt_stack.len();
        loop {
            match self.kind() {
                Kind::RBrace => {
                    self.bump();
                    break;
                }
                Kind::Eof => {
                    self.report_unclosed(open);
                    break;
                }
                _ if self.starts_function() && self.body.is_some_and(|(brace, _)| self.partner(brace).is_none()) => {
                    // A brace is missing above: the function is parsed at file scope.
                    self.report_nested_function();
                    break;
                }
                _ => {}
            }
            let first = self.at;
            let stmt = match self.with_rollback(Self::statement) {
                Ok(stmt) => stmt,
                Err(Failed) => {
                    self.recover();
                    if self.at == first && self.kind() != Kind::RBrace {
                        self.bump();
                    }
                    let loc = self.loc(first);
                    self.ast.stmt(StmtKind::Error, loc)
                }
            };
            self.stmt_stack.push(stmt);
        }
        let list = self.ast.list(&self.stmt_stack[mark..]);
        self.stmt_stack.truncate(mark);
        Ok(list)
    }

    /// Reports that the text ends inside a block.
    fn report_unclosed(&mut self, open: usize) {
        // Of several open braces the outermost is the one without a partner; the innermost message is reported.
        let (brace, label) = match self.body {
            Some((brace, name)) if self.partner(brace).is_none() => {
                (brace, format!("`{}` starts here", self.names.get(name.symbol)))
            }
            _ => (open, "opened here".to_owned()),
        };
        let here = self.at;
        let diagnostic = Diagnostic::error(self.span_after(here - 1), "missing `}` at the end of the text")
            .label(self.origins.token_span(Self::token(brace)), label);
        self.report_at(here, diagnostic);
    }

    /// Returns whether `type name(..) {` follows, which is only allowed at file scope.
    fn starts_function(&self) -> bool {
        let name = self.at + 1;
        matches!(self.kind(), Kind::Type | Kind::Ident)
            && self.kind_at(name) == Kind::Ident
            && self.kind_at(name + 1) == Kind::LParen
            && self.partner(name + 1).is_some_and(|end| self.kind_at(end + 1) == Kind::LBrace)
    }

    fn report_nested_function(&mut self) {
        let Some((brace, name)) = self.body else { return };
        let here = self.at + 1;
        let outer = self.names.get(name.symbol);
        let message = format!("missing `}}`: {} starts inside `{outer}`", self.shown(here));
        let mut diagnostic = self.origins.error(self.names, Self::token(here), message);
        diagnostic = diagnostic.label(self.origins.token_span(Self::token(brace)), format!("`{outer}` starts here"));
        self.report_at(here, diagnostic);
    }

    pub(super) fn statement(&mut self) -> Parse<StmtId> {
        self.cancel.check();
        self.enter()?;
        let first = self.at;
        let kind = self.statement_kind()?;
        self.leave();
        let loc = self.loc(first);
        Ok(self.ast.stmt(kind, loc))
    }

    fn statement_kind(&mut self) -> Parse<StmtKind> {
        let first = self.at;
        Ok(match self.kind() {
            Kind::LBrace => StmtKind::Block(self.statements()?),
            Kind::Semicolon => {
                self.bump();
                StmtKind::Empty
            }
            Kind::If => self.if_statement()?,
            Kind::For => self.for_statement()?,
            Kind::While => {
                self.bump();
                let cond = self.in_parentheses(Self::condition)?;
                let body = self.statement()?;
                StmtKind::While { cond, body }
            }
            Kind::Do => {
                self.bump();
                let body = self.statement()?;
                if !self.eat(Kind::While) {
                    return Err(self.unexpected("`while` and the condition of `do`"));
                }
                let cond = self.in_parentheses(|p| p.full_expression().map(Condition::Expr))?;
                self.semicolon()?;
                let Condition::Expr(cond) = cond else { return Err(Failed) };
                StmtKind::DoWhile { body, cond }
            }
            Kind::Switch => {
                self.bump();
                let value = self.in_parentheses(|p| p.full_expression().map(Condition::Expr))?;
                let Condition::Expr(value) = value else { return Err(Failed) };
                if self.kind() != Kind::LBrace {
                    return Err(self.unexpected("`{`"));
                }
                StmtKind::Switch { value, body: self.statements()? }
            }
            Kind::Case => {
                self.bump();
                let value = self.full_expression()?;
                self.colon()?;
                StmtKind::Case(value)
            }
            Kind::Default => {
                self.bump();
                self.colon()?;
                StmtKind::Default
            }
            Kind::Return => {
                self.bump();
                let value = if self.returns_nothing() { None } else { Some(self.full_expression()?) };
                self.end_statement();
                StmtKind::Return(value)
            }
            Kind::Break => self.jump(StmtKind::Break),
            Kind::Continue => self.jump(StmtKind::Continue),
            Kind::Discard => self.jump(StmtKind::Discard),
            Kind::Else => {
                let semicolon = first > 0 && self.kind_at(first - 1) == Kind::Semicolon;
                let hint = semicolon
                    .then(|| "an `if` without braces has one statement, and `;` alone counts as one".to_owned());
                // Where nesting was too deep, an `else` may be left over.
                if !self.reported_too_deep {
                    self.error(first, "`else` without an `if` before it", hint);
                }
                self.bump();
                return self.statement_kind();
            }
            Kind::Wrong if self.second() != Kind::Semicolon && self.starts_line(first + 1) => {
                // An invalid macro call may replace any statement, including its semicolon.
                self.bump();
                StmtKind::Error
            }
            _ if self.starts_declaration() => {
                self.check_keyword_slip()?;
                if self.starts_function() {
                    let hint = "move it out of this function";
                    self.error(first + 1, "a function cannot be defined inside of another", Some(hint.into()));
                }
                StmtKind::Decl(self.declaration(false)?)
            }
            _ => {
                let value = self.full_expression()?;
                self.end_statement();
                StmtKind::Expr(value)
            }
        })
    }

    /// Parses the semicolon of a statement that is complete without it.
    fn end_statement(&mut self) {
        if self.semicolon().is_err() {
            self.recover();
        }
    }

    fn jump(&mut self, kind: StmtKind) -> StmtKind {
        self.bump();
        self.end_statement();
        kind
    }

    /// Returns whether a `;` follows `return`, or is missing there.
    fn returns_nothing(&self) -> bool {
        match self.kind() {
            Kind::Semicolon | Kind::RBrace => true,
            _ => self.starts_line(self.at) && self.is_certain_start(),
        }
    }

    fn colon(&mut self) -> Parse<()> {
        if self.eat(Kind::Colon) {
            return Ok(());
        }
        if self.kind() == Kind::Semicolon {
            self.error(self.at, "a label ends with `:`, not `;`", None);
            self.bump();
            return Ok(());
        }
        Err(self.unexpected("`:`"))
    }

    /// Reports `retrun x;`, which looks like a declaration.
    fn check_keyword_slip(&mut self) -> Parse<()> {
        if self.kind() != Kind::Ident || self.structs[self.value() as usize] {
            return Ok(());
        }
        let word = self.text(self.at).to_owned();
        let Some(meant) =
            nearest_identifier(&word, ["return", "const", "highp", "mediump", "lowp", "struct", "else", "case"])
        else {
            return Ok(());
        };
        Err(self.fail(
            self.at,
            format!("`{word}` is not a keyword or a type"),
            Some(format!("did you mean `{meant}`?")),
        ))
    }

    fn if_statement(&mut self) -> Parse<StmtKind> {
        self.bump();
        let cond = self.in_parentheses(|p| p.full_expression().map(Condition::Expr))?;
        let Condition::Expr(cond) = cond else { return Err(Failed) };
        if matches!(self.kind(), Kind::Ident) && self.text(self.at) == "then" {
            self.error(self.at, "GLSL has no `then`", Some("remove it".into()));
            self.bump();
        }
        let then = self.statement()?;
        if self.kind() == Kind::Ident && self.second() == Kind::LParen {
            let word = self.text(self.at);
            if matches!(word, "elseif" | "elif" | "elsif") {
                let message = format!("GLSL has no `{word}`");
                self.error(self.at, message, Some("write `else if`".into()));
                let otherwise = Some(self.else_if()?);
                return Ok(StmtKind::If { cond, then, otherwise });
            }
        }
        let otherwise = if self.eat(Kind::Else) { Some(self.statement()?) } else { None };
        Ok(StmtKind::If { cond, then, otherwise })
    }

    /// Parses the statement that `elseif (..)` was meant to be.
    fn else_if(&mut self) -> Parse<StmtId> {
        self.enter()?;
        let first = self.at;
        let kind = self.if_statement()?;
        self.leave();
        let loc = self.loc(first);
        Ok(self.ast.stmt(kind, loc))
    }

    /// Parses `( .. )` of a statement. Errors inside are confined to the parentheses.
    fn in_parentheses(&mut self, part: fn(&mut Self) -> Parse<Condition>) -> Parse<Condition> {
        let open = self.at;
        let keyword = open - 1;
        if self.kind() != Kind::LParen {
            let hint = format!("write `{} (..)`", self.text(keyword));
            let message = format!("the condition of `{}` must be in parentheses", self.text(keyword));
            self.error(open, message, Some(hint));
            let read = self.with_rollback(part);
            return match (read, self.kind()) {
                (Ok(condition), _) => Ok(condition),
                (Err(Failed), Kind::LBrace) => Ok(Condition::Expr(self.error_expr(open))),
                (Err(failed), _) => Err(failed),
            };
        }
        self.bump();
        let read = self.with_rollback(|p| {
            if p.kind() == Kind::RParen {
                return Err(p.fail(p.at, "a condition is missing between `(` and `)`", None));
            }
            let condition = part(p)?;
            p.close(open, Kind::RParen)?;
            Ok(condition)
        });
        if let Ok(condition) = read {
            return Ok(condition);
        }
        let Some(end) = self.partner(open) else {
            // Skip to the block, if there is one in this statement.
            while !matches!(self.kind(), Kind::LBrace | Kind::Semicolon | Kind::RBrace | Kind::Eof) {
                self.bump();
            }
            if self.kind() != Kind::LBrace {
                return Err(Failed);
            }
            return Ok(Condition::Expr(self.error_expr(open)));
        };
        self.at = end;
        self.bump();
        Ok(Condition::Expr(self.error_expr(open)))
    }

    /// Parses an expression, or a declaration with a value: `bool b = f()`.
    fn condition(&mut self) -> Parse<Condition> {
        if !self.starts_declaration() {
            return self.full_expression().map(Condition::Expr);
        }
        let first = self.at;
        let decl = self.declaration_without_end()?;
        let DeclKind::Vars { declarators, .. } = self.ast[decl].kind else { return Err(Failed) };
        if self.ast[declarators].len() != 1 || self.ast[declarators][0].init.is_none() {
            return Err(self.fail(first, "a condition that declares a variable needs one variable with a value", None));
        }
        Ok(Condition::Decl(decl))
    }

    /// Parses a declaration of variables without its `;` or `)`.
    fn declaration_without_end(&mut self) -> Parse<crate::ast::DeclId> {
        let first = self.at;
        let mut qualifiers = self.qualifiers()?;
        let ty = self.qualified_type(&mut qualifiers)?;
        self.eat(Kind::Comma);
        let declarators = self.declarators(ty)?;
        let loc = self.loc(first);
        Ok(self.ast.decl(DeclKind::Vars { qualifiers, ty, declarators }, loc))
    }

    fn for_statement(&mut self) -> Parse<StmtKind> {
        self.bump();
        let open = self.at;
        if !self.eat(Kind::LParen) {
            return Err(self.unexpected("`(`"));
        }
        let start = self.at;
        let init = self.with_rollback(Self::for_init);
        let mut whole = init.is_ok();
        let init = init.unwrap_or_else(|Failed| {
            let loc = self.loc(start);
            self.ast.stmt(StmtKind::Error, loc)
        });
        let (mut cond, mut step) = (None, None);
        whole = whole && self.for_separator();
        if whole && self.kind() != Kind::Semicolon {
            match self.with_rollback(Self::condition) {
                Ok(read) => cond = Some(read),
                Err(Failed) => {
                    self.skip_in_for(open);
                    cond = Some(Condition::Expr(self.error_expr(start)));
                }
            }
        }
        whole = whole && self.for_separator();
        if whole && self.kind() != Kind::RParen {
            match self.with_rollback(Self::full_expression) {
                Ok(read) => step = Some(read),
                Err(Failed) => whole = false,
            }
        }
        if !whole || self.close(open, Kind::RParen).is_err() {
            let Some(end) = self.partner(open) else { return Err(Failed) };
            self.at = end;
            self.bump();
        }
        let body = self.statement()?;
        Ok(StmtKind::For { init, cond, step, body })
    }

    /// Parses the first part of a `for`, without its `;`.
    fn for_init(&mut self) -> Parse<StmtId> {
        let first = self.at;
        let kind = if self.kind() == Kind::Semicolon {
            StmtKind::Empty
        } else if self.starts_declaration() {
            StmtKind::Decl(self.declaration_without_end()?)
        } else {
            StmtKind::Expr(self.full_expression()?)
        };
        let loc = self.loc(first);
        Ok(self.ast.stmt(kind, loc))
    }

    /// Parses the `;` between the parts of a `for`; false if it is missing, which was reported.
    fn for_separator(&mut self) -> bool {
        if self.eat(Kind::Semicolon) {
            return true;
        }
        let message = format!("expected `;`, found {}", self.shown(self.at));
        let hint = "the parts of a `for` are start, condition and step: `for (int i = 0; i < 8; i++)`";
        self.error(self.at, message, Some(hint.into()));
        false
    }

    /// Skips the rest of a part of a `for`.
    fn skip_in_for(&mut self, open: usize) {
        let end = self.partner(open).unwrap_or(0);
        while self.at < end && self.kind() != Kind::Semicolon {
            match self.partner_of_opener() {
                Some(close) => self.at = close + 1,
                None => self.bump(),
            }
        }
    }

    fn partner_of_opener(&self) -> Option<usize> {
        matches!(self.kind(), Kind::LParen | Kind::LBracket | Kind::LBrace).then(|| self.partner(self.at))?
    }
}
