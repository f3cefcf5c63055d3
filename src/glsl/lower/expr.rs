//! Expressions: their values, their order of evaluation, and the conditions under which they are evaluated.

use super::{function::Builder, reachable::known_bool};
use crate::{
    hir::{ConstId, ExprFlags, ExprId, ExprKind, LogicalOp, Scalar, Type, TypeId},
    ir::{Binary, Block, Op, Stmt, Unary, Value},
};

impl Builder<'_, '_> {
    /// Returns the value of an expression that is not void.
    pub(super) fn value(&mut self, expr: ExprId) -> Value {
        // Operations on several values have the location of the whole, not of the last operand.
        let outer = self.loc;
        // Left spines may be thousands of links long, so they are descended by a loop instead of recursion.
        let hir = self.cx.hir;
        let mut spine = Vec::new();
        let mut at = expr;
        let mut value = loop {
            self.loc = hir[at].loc;
            match hir[at].kind {
                ExprKind::Member { .. } | ExprKind::Swizzle { .. } | ExprKind::Index { .. } => match self.read(at) {
                    Ok(value) => {
                        self.probe(at, value);
                        break value;
                    }
                    Err(links) => {
                        let innermost = *links.last().expect("a part has a link");
                        spine.extend(links);
                        at = match hir[innermost].kind {
                            ExprKind::Member { base, .. }
                            | ExprKind::Swizzle { base, .. }
                            | ExprKind::Index { base, .. } => base,
                            other => unreachable!("{other:?} is no part"),
                        };
                    }
                },
                ExprKind::Binary { op, shape, lhs, rhs } => {
                    let has_effects = hir[rhs].flags.contains(ExprFlags::EFFECTS);
                    if let Some(place) = self.read_late(lhs, has_effects) {
                        let right = self.value(rhs);
                        let left = self.load_place(place);
                        self.probe(lhs, left);
                        self.loc = hir[at].loc;
                        let value = self.binary(op, shape, (hir[lhs].ty, left), (hir[rhs].ty, right));
                        self.probe(at, value);
                        break value;
                    }
                    spine.push(at);
                    at = lhs;
                }
                ExprKind::Logical { lhs: inner, .. } | ExprKind::Convert(inner) => {
                    spine.push(at);
                    at = inner;
                }
                _ => {
                    let value = self.leaf(at);
                    self.probe(at, value);
                    break value;
                }
            }
        };
        while let Some(link) = spine.pop() {
            value = self.link(link, value);
            self.probe(link, value);
        }
        self.loc = outer;
        value
    }

    /// Evaluates one step up a left spine, from the value of the inner expression.
    fn link(&mut self, link: ExprId, value: Value) -> Value {
        let hir = self.cx.hir;
        self.loc = hir[link].loc;
        match hir[link].kind {
            ExprKind::Binary { op, shape, lhs, rhs } => {
                let (left, right) = (value, self.value(rhs));
                self.binary(op, shape, (hir[lhs].ty, left), (hir[rhs].ty, right))
            }
            ExprKind::Logical { op, lhs, rhs } => self.logical(op, lhs, value, rhs),
            ExprKind::Convert(_) => self.convert(value, hir[link].ty),
            _ => self.part_of_value(value, link),
        }
    }

    fn leaf(&mut self, expr: ExprId) -> Value {
        let hir = self.cx.hir;
        self.loc = hir[expr].loc;
        let ty = hir[expr].ty;
        match hir[expr].kind {
            ExprKind::Literal(bits) => self.scalar_literal(ty, bits),
            ExprKind::Const(id) => self.folded(id),
            ExprKind::Local(_)
            | ExprKind::Global(_)
            | ExprKind::Uniform(_)
            | ExprKind::CustomUniform(_)
            | ExprKind::BuiltinVar(_) => self.read(expr).unwrap_or_else(|_| self.root_value(expr)),
            ExprKind::Unary { op, operand } => {
                let value = self.value(operand);
                self.unary(op, ty, value)
            }
            ExprKind::Ternary { cond, then, otherwise } => self.ternary(ty, cond, then, otherwise),
            ExprKind::Comma { lhs, rhs } => {
                self.effect(lhs);
                self.value(rhs)
            }
            ExprKind::Assign { place, value } => self.assign(place, value),
            ExprKind::AssignOp { op, shape, place, value } => self.assign_op(op, shape, place, value),
            ExprKind::IncDec { op, place } => self.inc_dec(op, place),
            ExprKind::Splat(of) => {
                let value = self.value(of);
                self.splat(value, ty)
            }
            ExprKind::Vector(args) => self.vector(ty, &hir[args]),
            ExprKind::MatrixDiagonal(of) => self.matrix_diagonal(ty, of),
            ExprKind::MatrixResize(of) => self.matrix_resize(ty, of),
            ExprKind::Matrix(args) => self.matrix(ty, &hir[args]),
            ExprKind::Struct(args) | ExprKind::Array(args) => {
                let parts = self.values(&hir[args]);
                self.compose(ty, parts)
            }
            ExprKind::Call { func, args } => self.call(func, &hir[args]).expect("a call with a value"),
            ExprKind::Builtin { builtin, args } => {
                self.builtin(builtin, ty, &hir[args]).expect("a built-in with a value")
            }
            other => unreachable!("{other:?} has no value"),
        }
    }

    pub(super) fn scalar_literal(&mut self, ty: TypeId, bits: u32) -> Value {
        let scalar = self.cx.hir.types.scalar(ty).expect("a literal is a scalar");
        self.literal(scalar, bits)
    }

    /// Returns a folded value of any type.
    pub(super) fn folded(&mut self, id: ConstId) -> Value {
        let hir = self.cx.hir;
        match hir.types.get(hir[id].ty) {
            Type::Scalar(scalar) => self.literal(scalar, hir[hir[id].words][0]),
            _ => self.constant(id),
        }
    }

    /// Evaluates an expression only for its effects; void expressions must be evaluated this way.
    pub(super) fn effect(&mut self, expr: ExprId) {
        let hir = self.cx.hir;
        // A comma chain is a left spine.
        let mut rest = Vec::new();
        let mut at = expr;
        while let ExprKind::Comma { lhs, rhs } = hir[at].kind {
            rest.push(rhs);
            at = lhs;
        }
        self.effect_of_one(at);
        while let Some(next) = rest.pop() {
            self.effect(next);
        }
    }

    fn effect_of_one(&mut self, expr: ExprId) {
        let hir = self.cx.hir;
        if !hir[expr].flags.contains(ExprFlags::EFFECTS) {
            return;
        }
        self.loc = hir[expr].loc;
        match hir[expr].kind {
            ExprKind::Call { func, args } => {
                self.call(func, &hir[args]);
            }
            ExprKind::Builtin { builtin, args } => {
                self.builtin(builtin, hir[expr].ty, &hir[args]);
            }
            ExprKind::Ternary { cond, then, otherwise } => match known_bool(hir, cond) {
                Some(known) => self.effect(if known { then } else { otherwise }),
                None => {
                    let condition = self.value(cond);
                    let (accept, _) = self.nested(|b| b.effect(then));
                    let (reject, _) = self.nested(|b| b.effect(otherwise));
                    self.push(Stmt::If { condition, accept, reject });
                }
            },
            _ => {
                self.value(expr);
            }
        }
    }

    fn logical(&mut self, op: LogicalOp, lhs: ExprId, left: Value, rhs: ExprId) -> Value {
        match (op, known_bool(self.cx.hir, lhs)) {
            (LogicalOp::And, Some(false)) | (LogicalOp::Or, Some(true)) => return left,
            (_, Some(_)) => return self.value(rhs),
            (_, None) => {}
        }
        let result = self.temporary(TypeId::BOOL);
        self.store(result, left);
        let (needed, _) = self.nested(|b| {
            let right = b.value(rhs);
            b.store(result, right);
        });
        let (accept, reject) = match op {
            LogicalOp::And => (needed, Block::new()),
            LogicalOp::Or => (Block::new(), needed),
        };
        self.push(Stmt::If { condition: left, accept, reject });
        self.load(result)
    }

    fn ternary(&mut self, ty: TypeId, cond: ExprId, then: ExprId, otherwise: ExprId) -> Value {
        if let Some(known) = known_bool(self.cx.hir, cond) {
            return self.value(if known { then } else { otherwise });
        }
        let condition = self.value(cond);
        let result = self.temporary(ty);
        let (accept, _) = self.nested(|b| {
            let value = b.value(then);
            b.store(result, value);
        });
        let (reject, _) = self.nested(|b| {
            let value = b.value(otherwise);
            b.store(result, value);
        });
        self.push(Stmt::If { condition, accept, reject });
        self.load(result)
    }

    pub(super) fn select(&mut self, condition: Value, accept: Value, reject: Value) -> Value {
        self.add(Op::Select { condition, accept, reject })
    }

    pub(super) fn not(&mut self, expr: Value) -> Value {
        self.add(Op::Unary { op: Unary::LogicalNot, operand: expr })
    }

    pub(super) fn op(&mut self, op: Binary, left: Value, right: Value) -> Value {
        self.add(Op::Binary { op, left, right })
    }

    /// Returns a scalar repeated to a vector of type `ty`, or the scalar itself if `ty` is a scalar.
    pub(super) fn splat(&mut self, value: Value, ty: TypeId) -> Value {
        match self.cx.hir.types.get(ty) {
            Type::Vector { size, .. } => self.add(Op::Splat { size, value }),
            _ => value,
        }
    }

    /// Returns a literal number repeated to the float type `ty`.
    pub(super) fn float_of(&mut self, ty: TypeId, number: f32) -> Value {
        let value = self.float(number);
        self.splat(value, ty)
    }

    /// Returns a literal repeated to the int or uint type `ty`.
    pub(super) fn int_of(&mut self, ty: TypeId, bits: u32) -> Value {
        let scalar = self.cx.hir.types.scalar(ty).unwrap_or(Scalar::Int);
        let value = self.literal(scalar, bits);
        self.splat(value, ty)
    }
}
