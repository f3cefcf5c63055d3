//! Operators (sections 5.7 to 5.9): the types they take and return, and their values on constants.

use super::{
    checker::Checker,
    fault,
    fold::{self, FoldWarning, Grid},
    words::ScalarWords,
};
use crate::{
    ast::{self, BinaryOp as Op, Loc},
    hir::{BinaryOp, ExprFlags, ExprId, ExprKind, IncDec, LogicalOp, Scalar, Shape, Type, TypeId, UnaryOp},
    undefined,
};

impl Checker<'_> {
    pub(super) fn unary(&mut self, op: ast::UnaryOp, operand: ast::ExprId, loc: Loc) -> ExprId {
        let value = self.lowered_expr(operand);
        let ty = self.ty(value);
        if ty == TypeId::ERROR {
            return self.error_expr(loc);
        }
        let scalar = self.module.types.scalar(ty);
        let (node, legal) = match op {
            ast::UnaryOp::Increment => return self.inc_dec(IncDec::PreIncrement, value, loc),
            ast::UnaryOp::Decrement => return self.inc_dec(IncDec::PreDecrement, value, loc),
            ast::UnaryOp::Plus => (None, scalar.is_some_and(|s| s != Scalar::Bool)),
            ast::UnaryOp::Minus => (Some(UnaryOp::Negate), scalar.is_some_and(|s| s != Scalar::Bool)),
            ast::UnaryOp::Not => (Some(UnaryOp::Not), ty == TypeId::BOOL),
            ast::UnaryOp::BitNot => (Some(UnaryOp::BitNot), matches!(scalar, Some(Scalar::Int | Scalar::Uint))),
        };
        if !legal {
            self.bad_unary(op, ty, scalar, loc);
            return self.error_expr(loc);
        }
        let Some(node) = node else {
            let value = self.as_value(value);
            self.module[value].loc = loc;
            return value;
        };
        if let Some(words) = self.words(value) {
            let scalar = scalar.expect("legal operands have components");
            let folded: ScalarWords = words.iter().map(|&bits| fold::unary(node, scalar, bits)).collect();
            return self.constant(ty, folded.as_slice(), loc);
        }
        let flags = self.inherited(&[value]);
        self.push(ExprKind::Unary { op: node, operand: value }, ty, flags, loc)
    }

    #[cold]
    fn bad_unary(&mut self, op: ast::UnaryOp, ty: TypeId, scalar: Option<Scalar>, loc: Loc) {
        let name = self.type_name(ty);
        let text = match op {
            ast::UnaryOp::Plus | ast::UnaryOp::Increment => "+",
            ast::UnaryOp::Minus | ast::UnaryOp::Decrement => "-",
            ast::UnaryOp::Not => "!",
            ast::UnaryOp::BitNot => "~",
        };
        self.error(loc, format!("`{text}` cannot be applied to a `{name}`"));
        match (op, scalar) {
            (ast::UnaryOp::Not, Some(Scalar::Bool)) => self.hint("for vectors write `not(..)`"),
            (ast::UnaryOp::Not, Some(Scalar::Float)) => self.hint("compare it: `.. == 0.0`"),
            (ast::UnaryOp::Not, Some(_)) => self.hint("compare it: `.. == 0`"),
            (ast::UnaryOp::BitNot, Some(Scalar::Bool)) => self.hint("to negate a bool write `!`"),
            _ => {}
        }
    }

    pub(super) fn inc_dec(&mut self, op: IncDec, place: ExprId, loc: Loc) -> ExprId {
        let ty = self.ty(place);
        if ty == TypeId::ERROR {
            return self.error_expr(loc);
        }
        let text = match op {
            IncDec::PreIncrement | IncDec::PostIncrement => "++",
            IncDec::PreDecrement | IncDec::PostDecrement => "--",
        };
        if !self.module.types.scalar(ty).is_some_and(|s| s != Scalar::Bool) {
            let name = self.type_name(ty);
            self.error(loc, format!("`{text}` cannot be applied to a `{name}`"));
            return self.error_expr(loc);
        }
        if !self.place(place, "changed") {
            return self.error_expr_of(ty, loc);
        }
        let flags = self.inherited(&[place]) | ExprFlags::EFFECTS;
        self.push(ExprKind::IncDec { op, place }, ty, flags, loc)
    }

    /// Returns an error expression of a known type, so that its uses can be checked.
    pub(super) fn error_expr_of(&mut self, ty: TypeId, loc: Loc) -> ExprId {
        let id = self.error_expr(loc);
        self.module[id].ty = ty;
        id
    }

    pub(super) fn binary(&mut self, op: Op, lhs: ast::ExprId, rhs: ast::ExprId, loc: Loc) -> ExprId {
        if !matches!(op, Op::Shl | Op::Shr) {
            self.promote(lhs, rhs, false);
        }
        let (l, r) = (self.lowered_expr(lhs), self.lowered_expr(rhs));
        let (lt, rt) = (self.ty(l), self.ty(r));
        if lt == TypeId::ERROR || rt == TypeId::ERROR {
            // Comparisons return a bool whatever is wrong with their sides.
            let ty = if yields_bool(op) { TypeId::BOOL } else { TypeId::ERROR };
            return self.error_expr_of(ty, loc);
        }
        let Some((ty, shape)) = self.operator_type(op, lt, rt) else {
            self.bad_binary(op, (l, lhs), (r, rhs), loc);
            return self.error_expr_of(if yields_bool(op) { TypeId::BOOL } else { TypeId::ERROR }, loc);
        };
        let constant = self.is_constant(l) && self.is_constant(r);
        let logical = match op {
            Op::LogicalAnd => Some(LogicalOp::And),
            Op::LogicalOr => Some(LogicalOp::Or),
            _ => None,
        };
        if let Some(logical) = logical {
            if constant {
                let on = |id| self.words(id) == Some(&[1]);
                let value = if logical == LogicalOp::And { on(l) && on(r) } else { on(l) || on(r) };
                return self.literal(value.into(), TypeId::BOOL, loc);
            }
            let flags = self.inherited(&[l, r]);
            return self.push(ExprKind::Logical { op: logical, lhs: l, rhs: r }, TypeId::BOOL, flags, loc);
        }
        let op = eager(op);
        if constant && let Some(folded) = self.fold_binary(op, shape, ty, l, r, loc) {
            return folded;
        }
        let flags = self.inherited(&[l, r]);
        self.push(ExprKind::Binary { op, shape, lhs: l, rhs: r }, ty, flags, loc)
    }

    /// Returns the type and shape of `left op right`; `None` if the operator does not take these types.
    pub(super) fn operator_type(&self, op: Op, left: TypeId, right: TypeId) -> Option<(TypeId, Shape)> {
        let types = &self.module.types;
        match op {
            Op::Equal | Op::NotEqual => {
                let legal = left == right && left != TypeId::VOID && !self.facts(left).opaque;
                legal.then_some((TypeId::BOOL, Shape::Same))
            }
            Op::LogicalAnd | Op::LogicalOr | Op::LogicalXor => {
                (left == TypeId::BOOL && right == TypeId::BOOL).then_some((TypeId::BOOL, Shape::Same))
            }
            Op::Less | Op::Greater | Op::LessEqual | Op::GreaterEqual => {
                let legal = left == right && matches!(left, TypeId::INT | TypeId::UINT | TypeId::FLOAT);
                legal.then_some((TypeId::BOOL, Shape::Same))
            }
            Op::Shl | Op::Shr => {
                let ((a, m), (b, n)) = (self.vector_shape(left)?, self.vector_shape(right)?);
                let ints = |s| matches!(s, Scalar::Int | Scalar::Uint);
                if !ints(a) || !ints(b) {
                    return None;
                }
                match (m, n) {
                    _ if m == n => Some((left, Shape::Same)),
                    (_, 1) => Some((left, Shape::ScalarRight)),
                    _ => None,
                }
            }
            Op::Mul | Op::Div | Op::Add | Op::Sub | Op::Rem | Op::BitAnd | Op::BitXor | Op::BitOr => {
                let (a, b) = (types.scalar(left)?, types.scalar(right)?);
                let ints_only = matches!(op, Op::Rem | Op::BitAnd | Op::BitXor | Op::BitOr);
                if a != b || a == Scalar::Bool || (ints_only && a == Scalar::Float) {
                    return None;
                }
                if op == Op::Mul
                    && let Some(product) = self.product_type(left, right)
                {
                    return product;
                }
                let is_scalar = |ty| matches!(types.get(ty), Type::Scalar(_));
                match (is_scalar(left), is_scalar(right)) {
                    _ if left == right => Some((left, Shape::Same)),
                    (true, _) => Some((right, Shape::ScalarLeft)),
                    (_, true) => Some((left, Shape::ScalarRight)),
                    _ => None,
                }
            }
        }
    }

    /// Returns the type and shape of `*` on a matrix and a matrix or vector (section 5.9); the outer `None` means that
    /// it is not such a product.
    #[expect(clippy::option_option, reason = "no product, and a product without a type, differ")]
    fn product_type(&self, left: TypeId, right: TypeId) -> Option<Option<(TypeId, Shape)>> {
        let types = &self.module.types;
        Some(match (types.get(left), types.get(right)) {
            (Type::Matrix { columns, rows }, Type::Vector { size, .. }) => {
                (columns == size).then_some((TypeId::vector(Scalar::Float, rows), Shape::MatVec))
            }
            (Type::Vector { size, .. }, Type::Matrix { columns, rows }) => {
                (rows == size).then_some((TypeId::vector(Scalar::Float, columns), Shape::VecMat))
            }
            (Type::Matrix { columns: inner, rows }, Type::Matrix { columns, rows: other }) => {
                (inner == other).then_some((TypeId::matrix(columns, rows), Shape::MatMat))
            }
            _ => return None,
        })
    }

    fn fold_binary(
        &mut self,
        op: BinaryOp,
        shape: Shape,
        ty: TypeId,
        l: ExprId,
        r: ExprId,
        loc: Loc,
    ) -> Option<ExprId> {
        let (lt, rt) = (self.ty(l), self.ty(r));
        if matches!(op, BinaryOp::Equal | BinaryOp::NotEqual) {
            if !self.has_room(self.words(l)?.len(), loc) {
                return Some(self.error_expr_of(TypeId::BOOL, loc));
            }
            let equal = self.equal_constants(lt, l, r)?;
            return Some(self.literal(u32::from(equal == (op == BinaryOp::Equal)), TypeId::BOOL, loc));
        }
        let (a, b) = (self.words(l)?, self.words(r)?);
        let mut trouble = None;
        let folded = match shape {
            Shape::MatVec | Shape::VecMat | Shape::MatMat => fold::product(shape, self.grid(lt), self.grid(rt), a, b),
            Shape::Same | Shape::ScalarLeft | Shape::ScalarRight => {
                let scalar = self.module.types.scalar(lt)?;
                let signed = self.module.types.scalar(rt)? == Scalar::Int;
                let of = |words: &[u32], i: usize| words[if words.len() == 1 { 0 } else { i }];
                let count = a.len().max(b.len());
                (0..count).map(|i| fold::binary(op, scalar, of(a, i), of(b, i), signed, &mut trouble)).collect()
            }
        };
        let is_float = self.module.types.scalar(ty) == Some(Scalar::Float);
        let (is_nan, is_infinite) = if is_float {
            fault::introduces_nan_or_infinity([a, b].into_iter(), folded.as_slice())
        } else {
            (false, false)
        };
        let id = self.constant(ty, folded.as_slice(), loc);
        match trouble {
            Some(FoldWarning::DivisionByZero) => {
                self.undefined(loc, undefined::DIVISION);
                self.warning(loc, "division by zero: the result is undefined");
            }
            Some(FoldWarning::ShiftRange) => {
                self.undefined(loc, undefined::SHIFT);
                self.warning(loc, "a shift by less than 0 or more than 31 bits: the result is undefined");
            }
            None => self.note_floats(loc, is_nan, is_infinite),
        }
        Some(id)
    }

    fn grid(&self, ty: TypeId) -> Grid {
        match self.module.types.get(ty) {
            Type::Matrix { columns, rows } => Grid { columns: columns.into(), rows: rows.into() },
            Type::Vector { size, .. } => Grid { columns: 1, rows: size.into() },
            _ => Grid { columns: 1, rows: 1 },
        }
    }

    /// Returns whether two folded values of one type are equal: floats as numbers, so -0 equals 0 and NaN equals
    /// nothing.
    fn equal_constants(&self, ty: TypeId, l: ExprId, r: ExprId) -> Option<bool> {
        let (a, b) = (self.words(l)?, self.words(r)?);
        let mut at = 0;
        Some(self.equal_words(ty, a, b, &mut at))
    }

    /// Compares words up to the first difference. Recursion is bounded by the nesting of structs, which is limited.
    fn equal_words(&self, ty: TypeId, a: &[u32], b: &[u32], at: &mut usize) -> bool {
        match self.module.types.get(ty) {
            Type::Array { element, len } => (0..len).all(|_| self.equal_words(element, a, b, at)),
            Type::Struct(id) => self.module[self.module[id].members].iter().all(|m| self.equal_words(m.ty, a, b, at)),
            _ => {
                let count = self.module.types.components(ty).unwrap_or(0) as usize;
                let float = self.module.types.scalar(ty) == Some(Scalar::Float);
                let range = *at..*at + count;
                *at += count;
                let mut pairs = a[range.clone()].iter().zip(&b[range]);
                pairs.all(|(&x, &y)| if float { f32::from_bits(x) == f32::from_bits(y) } else { x == y })
            }
        }
    }

    pub(super) fn assign(&mut self, op: Option<Op>, place: ast::ExprId, value: ast::ExprId, loc: Loc) -> ExprId {
        match op {
            None => {
                let want = self.ty(self.lowered_expr(place));
                self.implicit(value, want);
            }
            Some(Op::Shl | Op::Shr) => {}
            Some(_) => self.promote(place, value, true),
        }
        let (p, v) = (self.lowered_expr(place), self.lowered_expr(value));
        let (pt, vt) = (self.ty(p), self.ty(v));
        if pt == TypeId::ERROR {
            return self.error_expr(loc);
        }
        if !self.place(p, "assigned to") || vt == TypeId::ERROR {
            return self.error_expr_of(pt, loc);
        }
        let flags = self.inherited(&[p, v]) | ExprFlags::EFFECTS;
        let Some(op) = op else {
            if self.is_void(v) {
                return self.error_expr_of(pt, loc);
            }
            let message = |checker: &Self| format!("cannot assign {{}} to a `{}`", checker.type_name(pt));
            if !self.expect_type(v, value, pt, message) {
                return self.error_expr_of(pt, loc);
            }
            if self.facts(pt).opaque {
                self.error(loc, "samplers and structs with samplers cannot be assigned");
                return self.error_expr_of(pt, loc);
            }
            return self.push(ExprKind::Assign { place: p, value: v }, pt, flags, loc);
        };
        match self.operator_type(op, pt, vt) {
            Some((ty, shape)) if ty == pt => {
                self.push(ExprKind::AssignOp { op: eager(op), shape, place: p, value: v }, pt, flags, loc)
            }
            Some((ty, _)) => {
                let (gives, has, text) = (self.type_name(ty), self.type_name(pt), op.text());
                self.error(loc, format!("`{text}=` would give a `{gives}`, which cannot be stored in a `{has}`"));
                self.conversion_hint((p, place), (v, value));
                self.error_expr_of(pt, loc)
            }
            None => {
                self.bad_binary(op, (p, place), (v, value), loc);
                self.error_expr_of(pt, loc)
            }
        }
    }

    #[cold]
    fn bad_binary(&mut self, op: Op, left: (ExprId, ast::ExprId), right: (ExprId, ast::ExprId), loc: Loc) {
        let (lt, rt) = (self.ty(left.0), self.ty(right.0));
        if self.is_void(left.0) || self.is_void(right.0) {
            return;
        }
        let (a, b, text) = (self.type_name(lt), self.type_name(rt), op.text());
        if self.facts(lt).opaque || self.facts(rt).opaque {
            self.error(loc, format!("`{text}` takes no samplers"));
            return;
        }
        let scalars = (self.module.types.scalar(lt), self.module.types.scalar(rt));
        match op {
            Op::LogicalAnd | Op::LogicalOr | Op::LogicalXor => {
                let (side, written) = if lt == TypeId::BOOL { right } else { left };
                self.expect_bool(side, written, &format!("each side of `{text}`"));
                return;
            }
            Op::Less | Op::Greater | Op::LessEqual | Op::GreaterEqual
                if lt == rt && self.vector_shape(lt).is_some_and(|(s, n)| n > 1 && s != Scalar::Bool) =>
            {
                self.error(loc, format!("`{text}` compares scalars, not `{a}`"));
                let function = match op {
                    Op::Less => "lessThan",
                    Op::Greater => "greaterThan",
                    Op::LessEqual => "lessThanEqual",
                    _ => "greaterThanEqual",
                };
                self.hint(format!(
                    "`{function}(a, b)` compares component by component; `all(..)` or `any(..)` reduces that to a \
                     bool"
                ));
                return;
            }
            _ => {}
        }
        self.error(loc, format!("`{text}` cannot combine `{a}` and `{b}`"));
        match (op, scalars) {
            (Op::Rem, (Some(Scalar::Float), _) | (_, Some(Scalar::Float))) => {
                self.hint("`%` is for ints; for floats write `mod(a, b)`");
            }
            (Op::BitXor, (Some(Scalar::Float), _) | (_, Some(Scalar::Float))) => {
                self.hint("`^` is bitwise exclusive or; for a power write `pow(a, b)`");
            }
            (Op::BitAnd | Op::BitOr | Op::BitXor, (Some(Scalar::Bool), Some(Scalar::Bool))) => {
                self.hint(format!("for bools write `{text}{text}`"));
            }
            (Op::BitAnd | Op::BitOr | Op::Shl | Op::Shr, (Some(Scalar::Float), _) | (_, Some(Scalar::Float))) => {
                self.hint("bits are for ints: convert with `int(..)`, or see them with `floatBitsToInt(..)`");
            }
            (Op::Mul, (Some(Scalar::Float), Some(Scalar::Float))) if self.product_type(lt, rt).is_some() => {
                self.product_hint(lt, rt);
            }
            _ => self.conversion_hint(left, right),
        }
    }

    fn product_hint(&mut self, lt: TypeId, rt: TypeId) {
        let types = &self.module.types;
        let hint = match (types.get(lt), types.get(rt)) {
            (Type::Matrix { columns, .. }, Type::Vector { .. }) => {
                format!("`{}` times a vector needs one of {columns} components", self.type_name(lt))
            }
            (Type::Vector { .. }, Type::Matrix { rows, .. }) => {
                format!("a vector times `{}` needs {rows} components", self.type_name(rt))
            }
            (Type::Matrix { columns, .. }, Type::Matrix { .. }) => {
                format!("the right matrix needs as many rows as the left has columns, {columns}")
            }
            _ => return,
        };
        self.hint(hint);
    }
}

fn yields_bool(op: Op) -> bool {
    matches!(
        op,
        Op::Less
            | Op::Greater
            | Op::LessEqual
            | Op::GreaterEqual
            | Op::Equal
            | Op::NotEqual
            | Op::LogicalAnd
            | Op::LogicalOr
            | Op::LogicalXor
    )
}

fn eager(op: Op) -> BinaryOp {
    match op {
        Op::Mul => BinaryOp::Mul,
        Op::Div => BinaryOp::Div,
        Op::Rem => BinaryOp::Rem,
        Op::Add => BinaryOp::Add,
        Op::Sub => BinaryOp::Sub,
        Op::Shl => BinaryOp::Shl,
        Op::Shr => BinaryOp::Shr,
        Op::Less => BinaryOp::Less,
        Op::Greater => BinaryOp::Greater,
        Op::LessEqual => BinaryOp::LessEqual,
        Op::GreaterEqual => BinaryOp::GreaterEqual,
        Op::Equal => BinaryOp::Equal,
        Op::NotEqual => BinaryOp::NotEqual,
        Op::BitAnd => BinaryOp::BitAnd,
        Op::BitXor => BinaryOp::BitXor,
        Op::BitOr => BinaryOp::BitOr,
        Op::LogicalXor => BinaryOp::LogicalXor,
        Op::LogicalAnd | Op::LogicalOr => unreachable!("handled as ExprKind::Logical"),
    }
}
