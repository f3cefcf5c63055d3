//! Expressions (section 5.1): precedence climbing with a loop for the left sides, so that chains of any length use no
//! stack.

use super::parser::{MAX_LEVELS, Parse, Parser};
use crate::{
    ast::{BinaryOp, ExprId, ExprKind, List, PostfixOp, Symbol, TypeSpec, TypeSpecKind, UnaryOp},
    lex::{Kind, words},
    preprocess::Tok,
    stack::{STACK_LEFT, STACK_MORE},
};

/// Returns an operator and its precedence; a higher one binds tighter.
#[inline]
fn binary_op(kind: Kind) -> Option<(BinaryOp, u8)> {
    Some(match kind {
        Kind::Star => (BinaryOp::Mul, 11),
        Kind::Slash => (BinaryOp::Div, 11),
        Kind::Percent => (BinaryOp::Rem, 11),
        Kind::Plus => (BinaryOp::Add, 10),
        Kind::Minus => (BinaryOp::Sub, 10),
        Kind::LessLess => (BinaryOp::Shl, 9),
        Kind::GreaterGreater => (BinaryOp::Shr, 9),
        Kind::Less => (BinaryOp::Less, 8),
        Kind::Greater => (BinaryOp::Greater, 8),
        Kind::LessEqual => (BinaryOp::LessEqual, 8),
        Kind::GreaterEqual => (BinaryOp::GreaterEqual, 8),
        Kind::EqualEqual => (BinaryOp::Equal, 7),
        Kind::BangEqual => (BinaryOp::NotEqual, 7),
        Kind::And => (BinaryOp::BitAnd, 6),
        Kind::Caret => (BinaryOp::BitXor, 5),
        Kind::Or => (BinaryOp::BitOr, 4),
        Kind::AndAnd => (BinaryOp::LogicalAnd, 3),
        Kind::CaretCaret => (BinaryOp::LogicalXor, 2),
        Kind::OrOr => (BinaryOp::LogicalOr, 1),
        _ => return None,
    })
}

/// Returns `Some(None)` for `=`, `Some(Some(op))` for `op=`.
#[inline]
fn assign_op(kind: Kind) -> Option<Option<BinaryOp>> {
    Some(match kind {
        Kind::Equal => None,
        Kind::PlusEqual => Some(BinaryOp::Add),
        Kind::MinusEqual => Some(BinaryOp::Sub),
        Kind::StarEqual => Some(BinaryOp::Mul),
        Kind::SlashEqual => Some(BinaryOp::Div),
        Kind::PercentEqual => Some(BinaryOp::Rem),
        Kind::LessLessEqual => Some(BinaryOp::Shl),
        Kind::GreaterGreaterEqual => Some(BinaryOp::Shr),
        Kind::AndEqual => Some(BinaryOp::BitAnd),
        Kind::OrEqual => Some(BinaryOp::BitOr),
        Kind::CaretEqual => Some(BinaryOp::BitXor),
        _ => return None,
    })
}

impl Parser<'_> {
    /// Parses a full expression: its nodes are contiguous, and none is left if it fails.
    pub(super) fn full_expression(&mut self) -> Parse<ExprId> {
        self.full(Self::expression)
    }

    /// Parses a full expression without the comma operator.
    pub(super) fn full_assignment(&mut self) -> Parse<ExprId> {
        self.full(Self::assignment)
    }

    /// Parses an expression within another. Parentheses and operators may nest deeper than a thread's stack allows.
    fn level(&mut self, part: fn(&mut Self) -> Parse<ExprId>) -> Parse<ExprId> {
        self.levels += 1;
        if self.levels > MAX_LEVELS {
            return Err(self.too_deep(self.at, MAX_LEVELS));
        }
        let read = stacker::maybe_grow(STACK_LEFT, STACK_MORE, || part(self))?;
        self.levels -= 1;
        Ok(read)
    }

    fn full(&mut self, part: fn(&mut Self) -> Parse<ExprId>) -> Parse<ExprId> {
        let within = std::mem::take(&mut self.levels);
        let read = self.with_rollback(part);
        self.levels = within;
        read
    }

    /// Parses `expression`, with commas.
    fn expression(&mut self) -> Parse<ExprId> {
        let first = self.at;
        let mut lhs = self.assignment()?;
        while self.eat(Kind::Comma) {
            let rhs = self.assignment()?;
            let loc = self.loc(first);
            lhs = self.ast.expr(ExprKind::Comma { lhs, rhs }, loc);
        }
        Ok(lhs)
    }

    fn assignment(&mut self) -> Parse<ExprId> {
        self.level(Self::assignment_here)
    }

    fn assignment_here(&mut self) -> Parse<ExprId> {
        let first = self.at;
        let mut lhs = self.binary(1)?;
        if self.eat(Kind::Question) {
            let then = self.expression()?;
            if !self.eat(Kind::Colon) {
                return Err(self.unexpected("`:` and the other value of `?`"));
            }
            let otherwise = self.assignment()?;
            let loc = self.loc(first);
            lhs = self.ast.expr(ExprKind::Ternary { cond: lhs, then, otherwise }, loc);
        } else if let Some(op) = assign_op(self.kind()) {
            self.bump();
            self.check_unary_slip();
            let value = self.assignment()?;
            let loc = self.loc(first);
            lhs = self.ast.expr(ExprKind::Assign { op, place: lhs, value }, loc);
        }
        Ok(lhs)
    }

    /// Reports `a =+ b`, which is `a = +b` and never intended.
    pub(super) fn check_unary_slip(&mut self) {
        let i = self.at;
        if self.kind() == Kind::Plus && self.kind_at(i - 1) == Kind::Equal && self.adjacent(i - 1) && !self.adjacent(i)
        {
            let warning = self.origins.warning(self.names, Self::token(i), "`=+` assigns the value on its right");
            self.report.add(warning.hint("to add write `+=`"));
        }
    }

    fn binary(&mut self, min_level: u8) -> Parse<ExprId> {
        let first = self.at;
        let mut lhs = self.unary()?;
        while let Some((op, level)) = binary_op(self.kind()) {
            if level < min_level {
                break;
            }
            self.bump();
            // At most one level of recursion for each precedence.
            let rhs = self.binary(level + 1)?;
            let loc = self.loc(first);
            lhs = self.ast.expr(ExprKind::Binary { op, lhs, rhs }, loc);
        }
        Ok(lhs)
    }

    fn unary(&mut self) -> Parse<ExprId> {
        let op = match self.kind() {
            Kind::Plus => UnaryOp::Plus,
            Kind::Minus => UnaryOp::Minus,
            Kind::Bang => UnaryOp::Not,
            Kind::Tilde => UnaryOp::BitNot,
            Kind::PlusPlus => UnaryOp::Increment,
            Kind::MinusMinus => UnaryOp::Decrement,
            _ => return self.postfix(),
        };
        let first = self.at;
        self.bump();
        let operand = self.level(Self::unary)?;
        let loc = self.loc(first);
        Ok(self.ast.expr(ExprKind::Unary { op, operand }, loc))
    }

    fn postfix(&mut self) -> Parse<ExprId> {
        let first = self.at;
        let mut base = self.primary()?;
        loop {
            let kind = match self.kind() {
                Kind::Dot => {
                    self.bump();
                    self.after_dot(base)?
                }
                Kind::LBracket => {
                    let open = self.at;
                    self.bump();
                    if self.kind() == Kind::RBracket {
                        return Err(self.fail(self.at, "these brackets need an index", None));
                    }
                    let index = self.expression()?;
                    self.close(open, Kind::RBracket)?;
                    ExprKind::Index { base, index }
                }
                Kind::PlusPlus => {
                    self.bump();
                    ExprKind::Postfix { op: PostfixOp::Increment, operand: base }
                }
                Kind::MinusMinus => {
                    self.bump();
                    ExprKind::Postfix { op: PostfixOp::Decrement, operand: base }
                }
                _ => return Ok(base),
            };
            let loc = self.loc(first);
            base = self.ast.expr(kind, loc);
        }
    }

    /// Parses a member, swizzle or `length()`; the point has been consumed.
    fn after_dot(&mut self, base: ExprId) -> Parse<ExprKind> {
        let name = self.ident("a member or components after `.`")?;
        if self.kind() != Kind::LParen {
            return Ok(ExprKind::Member { base, name: name.symbol });
        }
        let open = self.at;
        self.bump();
        if self.kind() != Kind::RParen {
            let method = self.names.get(name.symbol);
            let message = if method == "length" {
                "`length()` of an array takes no arguments".to_owned()
            } else {
                format!("GLSL has no methods: `.{method}(..)`")
            };
            let failed = self.fail(self.at, message, None);
            let Some(end) = self.partner(open) else { return Err(failed) };
            self.at = end;
        }
        self.close(open, Kind::RParen)?;
        Ok(ExprKind::Method { base, name })
    }

    fn primary(&mut self) -> Parse<ExprId> {
        let first = self.at;
        let Tok { kind, value } = self.tokens[first];
        let node = match kind {
            Kind::Ident => match self.second() {
                Kind::LParen => return self.call(),
                Kind::LBracket if self.is_array_constructor(first) => return self.constructor(),
                _ => ExprKind::Name(Symbol(value)),
            },
            Kind::Float => ExprKind::Float(f32::from_bits(value)),
            Kind::Int => ExprKind::Int(value as i32),
            Kind::Uint => ExprKind::Uint(value),
            Kind::True => ExprKind::Bool(true),
            Kind::False => ExprKind::Bool(false),
            Kind::Type => return self.constructor(),
            Kind::LParen => {
                self.bump();
                if self.kind() == Kind::RParen {
                    return Err(self.fail(first, "these parentheses are empty", None));
                }
                let inner = self.expression()?;
                self.close(first, Kind::RParen)?;
                return Ok(inner);
            }
            Kind::Wrong => {
                // What follows belonged to it: the `(..)` of an invalid macro call has been consumed with it.
                ExprKind::Error
            }
            Kind::Reserved => {
                self.reserved(first);
                if self.second() == Kind::LParen {
                    self.call()?;
                    let loc = self.loc(first);
                    return Ok(self.ast.expr(ExprKind::Error, loc));
                }
                ExprKind::Name(Symbol(value))
            }
            Kind::LBrace => {
                let hint = "write a constructor: `float[](1.0, 2.0)`, `vec3(..)`, `Name(..)`";
                let failed = self.fail(first, "GLSL ES has no lists in braces", Some(hint.into()));
                let Some(end) = self.partner(first) else { return Err(failed) };
                self.at = end;
                ExprKind::Error
            }
            _ => return Err(self.no_operand()),
        };
        self.bump();
        let loc = self.loc(first);
        Ok(self.ast.expr(node, loc))
    }

    /// Returns whether a name, brackets and then `(` follow: `S[2](..)`.
    fn is_array_constructor(&self, name: usize) -> bool {
        self.partner(name + 1).is_some_and(|end| self.kind_at(end + 1) == Kind::LParen)
    }

    fn call(&mut self) -> Parse<ExprId> {
        let first = self.at;
        let name = Symbol(self.value());
        self.bump();
        let args = self.arguments()?;
        let loc = self.loc(first);
        Ok(self.ast.expr(ExprKind::Call { name, args }, loc))
    }

    /// Parses `vec3(..)`, `float[2](..)`, `S[](..)`.
    fn constructor(&mut self) -> Parse<ExprId> {
        let first = self.at;
        let kind = match self.kind() {
            Kind::Type => TypeSpecKind::Basic(words::basic_type(self.value())),
            _ => TypeSpecKind::Named(Symbol(self.value())),
        };
        self.bump();
        let dims = self.dims(Self::expression)?;
        let loc = self.loc(first);
        let ty = self.ast.type_spec(TypeSpec { kind, dims, loc });
        if self.kind() != Kind::LParen {
            return Err(self.type_as_operand(first));
        }
        let args = self.arguments()?;
        let loc = self.loc(first);
        Ok(self.ast.expr(ExprKind::Construct { ty, args }, loc))
    }

    /// Parses `(a, b)`; `()` and `(void)` are empty.
    fn arguments(&mut self) -> Parse<List<ExprId>> {
        let open = self.at;
        self.bump();
        if self.eat(Kind::RParen) {
            return Ok(List::EMPTY);
        }
        if self.second() == Kind::RParen && self.kind() == Kind::Type && self.text(self.at) == "void" {
            self.at += 2;
            return Ok(List::EMPTY);
        }
        let mark = self.expr_stack.len();
        loop {
            let arg = self.assignment()?;
            self.expr_stack.push(arg);
            if !self.eat(Kind::Comma) {
                break;
            }
        }
        if self.kind() != Kind::RParen && self.partner(open).is_some() {
            return Err(self.unexpected("`,` or `)`"));
        }
        self.close(open, Kind::RParen)?;
        let list = self.ast.list(&self.expr_stack[mark..]);
        self.expr_stack.truncate(mark);
        Ok(list)
    }
}
