//! Expressions of `#if` and `#elif` (section 3.4): integers, `defined`, and the operators of C without assignment and
//! the conditional operator.

use super::state::Preprocessor;
use crate::{
    ast::Symbol,
    lex::{Kind, Token},
    stack::{STACK_LEFT, STACK_MORE},
};

/// The limit of nested parentheses and signs.
const MAX_DEPTH: u32 = 10_000;

impl Preprocessor<'_, '_> {
    /// Returns whether the condition is true. An invalid condition is reported and false.
    pub(super) fn condition(&mut self, directive: &Token, line: &[Token]) -> bool {
        let Some(tokens) = self.without_defined(line) else { return false };
        let mut expanded = Vec::new();
        self.expand_line(&tokens, &mut expanded);
        if self.stopped {
            return false;
        }
        let mut evaluation =
            Evaluation { all: self, tokens: &expanded, at: 0, unevaluated: 0, depth: 0, end: *directive };
        let Some(value) = evaluation.binary(0) else { return false };
        if let Some(extra) = evaluation.peek() {
            evaluation.unexpected(&extra);
            return false;
        }
        value != 0
    }

    /// Returns the one or two numbers of a `#line`; `None` if they are invalid, which was reported.
    pub(super) fn line_numbers(&mut self, directive: &Token, line: &[Token]) -> Option<(i64, Option<i64>)> {
        let mut expanded = Vec::new();
        self.expand_line(line, &mut expanded);
        let mut evaluation =
            Evaluation { all: self, tokens: &expanded, at: 0, unevaluated: 0, depth: 0, end: *directive };
        let number = evaluation.binary(0)?;
        let file = if evaluation.peek().is_some() { Some(evaluation.binary(0)?) } else { None };
        if let Some(extra) = evaluation.peek() {
            evaluation.unexpected(&extra);
            return None;
        }
        Some((number, file))
    }

    /// Returns the line with `defined X` and `defined(X)` replaced by 1 or 0, before macros are expanded.
    fn without_defined(&mut self, line: &[Token]) -> Option<Vec<Token>> {
        let mut tokens = Vec::with_capacity(line.len());
        let mut at = 0;
        while let Some(&token) = line.get(at) {
            at += 1;
            if token.kind != Kind::Ident || self.names.get(Symbol(token.value)) != "defined" {
                tokens.push(token);
                continue;
            }
            let open = line.get(at).is_some_and(|t| t.kind == Kind::LParen);
            let name = line.get(at + usize::from(open)).filter(|t| t.kind == Kind::Ident);
            let closed = !open || line.get(at + 2).is_some_and(|t| t.kind == Kind::RParen);
            let Some(name) = name.filter(|_| closed) else {
                self.error(&token, "`defined` takes the name of a macro", Some("write `defined(NAME)`".into()));
                return None;
            };
            let found = self.defined(name.value);
            self.origins.macro_uses.extend(found.map(|id| (name.span, id)));
            tokens.push(Token { kind: Kind::Int, value: u32::from(found.is_some()), ..token });
            at += if open { 3 } else { 1 };
        }
        Some(tokens)
    }
}

struct Evaluation<'e, 'p, 'a, 'r> {
    all: &'p mut Preprocessor<'a, 'r>,
    tokens: &'e [Token],
    at: usize,
    /// Inside the unevaluated right side of an `&&` or `||`: nothing there is an error.
    unevaluated: u32,
    depth: u32,
    /// The token at which an expression that ends too early is reported.
    end: Token,
}

/// Returns the precedence of an operator; a higher one binds tighter.
fn precedence(kind: Kind) -> u32 {
    match kind {
        Kind::OrOr => 1,
        Kind::AndAnd => 2,
        Kind::Or => 3,
        Kind::Caret => 4,
        Kind::And => 5,
        Kind::EqualEqual | Kind::BangEqual => 6,
        Kind::Less | Kind::Greater | Kind::LessEqual | Kind::GreaterEqual => 7,
        Kind::LessLess | Kind::GreaterGreater => 8,
        Kind::Plus | Kind::Minus => 9,
        Kind::Star | Kind::Slash | Kind::Percent => 10,
        _ => 0,
    }
}

impl Evaluation<'_, '_, '_, '_> {
    fn peek(&self) -> Option<Token> {
        self.tokens.get(self.at).copied()
    }

    fn unexpected(&mut self, token: &Token) {
        let text = self.all.text(token.span).to_owned();
        let hint = match token.kind {
            Kind::Equal => Some("to compare write `==`".into()),
            Kind::Question => Some("there is no `?:` in an `#if`".into()),
            Kind::LParen => Some("to call a macro that may not be defined, put an `#if` into an `#ifdef`".into()),
            _ => None,
        };
        if !matches!(token.kind, Kind::BadChar | Kind::BadName | Kind::Text | Kind::Hash | Kind::HashHash) {
            self.all.error(token, format!("`{text}` is not expected here"), hint);
        } else {
            self.all.report_invalid_token(token);
        }
    }

    fn binary(&mut self, above: u32) -> Option<i64> {
        let mut left = self.unary()?;
        while let Some(op) = self.peek() {
            let level = precedence(op.kind);
            if level <= above {
                break;
            }
            self.at += 1;
            let decided = op.kind == Kind::AndAnd && left == 0 || op.kind == Kind::OrOr && left != 0;
            self.unevaluated += u32::from(decided);
            let right = self.binary(level);
            self.unevaluated -= u32::from(decided);
            left = self.apply(&op, left, right?)?;
        }
        Some(left)
    }

    fn apply(&mut self, op: &Token, a: i64, b: i64) -> Option<i64> {
        Some(match op.kind {
            Kind::OrOr => i64::from(a != 0 || b != 0),
            Kind::AndAnd => i64::from(a != 0 && b != 0),
            Kind::Or => a | b,
            Kind::Caret => a ^ b,
            Kind::And => a & b,
            Kind::EqualEqual => i64::from(a == b),
            Kind::BangEqual => i64::from(a != b),
            Kind::Less => i64::from(a < b),
            Kind::Greater => i64::from(a > b),
            Kind::LessEqual => i64::from(a <= b),
            Kind::GreaterEqual => i64::from(a >= b),
            Kind::LessLess | Kind::GreaterGreater if !(0..32).contains(&b) => {
                if self.unevaluated == 0 {
                    self.all.error(op, format!("a shift by {b} has no meaning"), None);
                    return None;
                }
                0
            }
            Kind::LessLess => a << b,
            Kind::GreaterGreater => a >> b,
            Kind::Plus => a.wrapping_add(b),
            Kind::Minus => a.wrapping_sub(b),
            Kind::Star => a.wrapping_mul(b),
            _ if b == 0 => {
                if self.unevaluated == 0 {
                    self.all.error(op, "this divides by zero", None);
                    return None;
                }
                0
            }
            Kind::Slash => a.wrapping_div(b),
            _ => a.wrapping_rem(b),
        })
    }

    fn unary(&mut self) -> Option<i64> {
        stacker::maybe_grow(STACK_LEFT, STACK_MORE, || self.unary_here())
    }

    fn unary_here(&mut self) -> Option<i64> {
        let Some(token) = self.peek() else {
            let last = self.tokens.last().copied().unwrap_or(self.end);
            let message = if self.tokens.is_empty() { "a value is missing here" } else { "this is incomplete" };
            self.all.error(&last, message, None);
            return None;
        };
        self.at += 1;
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            self.all.error(&token, format!("this is nested more than {MAX_DEPTH} levels deep"), None);
            return None;
        }
        let value = match token.kind {
            Kind::Plus => self.unary()?,
            Kind::Minus => self.unary()?.wrapping_neg(),
            Kind::Bang => i64::from(self.unary()? == 0),
            Kind::Tilde => !self.unary()?,
            Kind::LParen => {
                let value = self.binary(0)?;
                match self.peek() {
                    Some(close) if close.kind == Kind::RParen => self.at += 1,
                    Some(other) => {
                        self.unexpected(&other);
                        return None;
                    }
                    None => {
                        self.all.error(&token, "this parenthesis is not closed", None);
                        return None;
                    }
                }
                value
            }
            Kind::Int | Kind::Uint => i64::from(token.value),
            Kind::Ident => {
                if self.unevaluated == 0 {
                    self.name(&token);
                    return None;
                }
                0
            }
            Kind::Float => {
                let text = self.all.text(token.span).to_owned();
                self.all.error(&token, format!("`{text}`: a directive accepts only integers"), None);
                return None;
            }
            Kind::Wrong => return None,
            Kind::BadNumber => {
                self.all.report_invalid_token(&token);
                return None;
            }
            _ => {
                self.unexpected(&token);
                return None;
            }
        };
        self.depth -= 1;
        Some(value)
    }

    /// Reports a name that is not a macro.
    fn name(&mut self, token: &Token) {
        let text = self.all.names.get(Symbol(token.value)).to_owned();
        if let Some(id) = self.all.defined(token.value) {
            let hint = if self.all.origins[id].function_like { "add its arguments" } else { "it refers to itself" };
            self.all.error(token, format!("the macro `{text}` has no value here"), Some(hint.into()));
            return;
        }
        let (message, hint) = match text.as_str() {
            "true" | "false" => {
                let value = u8::from(text == "true");
                (format!("`{text}` has no value in a directive"), format!("write `{value}`"))
            }
            "defined" => ("`defined` cannot come from a macro".into(), "write it directly in the condition".into()),
            _ => (
                format!("`{text}` is not defined, so it has no value here"),
                format!("write `defined({text})` to test whether it is defined"),
            ),
        };
        self.all.error(token, message, Some(hint));
    }
}
