//! Operators, assignments, equality.

use super::{function::Builder, names::Precondition};
use crate::{
    hir::{BinaryOp, ExprId, ExprKind, IncDec, Scalar, Shape, Type, TypeId, UnaryOp},
    ir::{Binary, Op, Unary, Value},
};

/// A value and its type.
pub(super) type Typed = (TypeId, Value);

impl Builder<'_, '_> {
    pub(super) fn unary(&mut self, op: UnaryOp, ty: TypeId, expr: Value) -> Value {
        let types = &self.cx.hir.types;
        match op {
            UnaryOp::Not => self.not(expr),
            UnaryOp::BitNot => self.add(Op::Unary { op: Unary::BitwiseNot, operand: expr }),
            UnaryOp::Negate if matches!(types.get(ty), Type::Matrix { .. }) => {
                let minus = self.float(-1.0);
                self.op(Binary::Multiply, expr, minus)
            }
            UnaryOp::Negate if types.scalar(ty) == Some(Scalar::Uint) => {
                let zero = self.zero(ty);
                self.op(Binary::Subtract, zero, expr)
            }
            UnaryOp::Negate => self.negate(expr),
        }
    }

    fn negate(&mut self, expr: Value) -> Value {
        self.add(Op::Unary { op: Unary::Negate, operand: expr })
    }

    pub(super) fn binary(&mut self, source: BinaryOp, shape: Shape, left: Typed, right: Typed) -> Value {
        use BinaryOp as B;
        let op = source;
        let types = &self.cx.hir.types;
        match op {
            B::Equal => return self.equal(left.0, left.1, right.1),
            B::NotEqual => {
                // Not `!=`: naga's is false for NaN.
                let equal = self.equal(left.0, left.1, right.1);
                return self.not(equal);
            }
            B::LogicalXor => return self.op(Binary::NotEqual, left.1, right.1),
            B::Shl => return self.shift(Binary::ShiftLeft, left, right),
            B::Shr => return self.shift(Binary::ShiftRight, left, right),
            B::Div | B::Rem if types.scalar(left.0) != Some(Scalar::Float) => {
                return self.int_division(op, shape, left, right);
            }
            _ => {}
        }
        let op = match op {
            B::Add => Binary::Add,
            B::Sub => Binary::Subtract,
            B::Mul => Binary::Multiply,
            B::Div => Binary::Divide,
            B::Rem => Binary::Modulo,
            B::BitAnd => Binary::And,
            B::BitOr => Binary::InclusiveOr,
            B::BitXor => Binary::ExclusiveOr,
            B::Less => Binary::Less,
            B::Greater => Binary::Greater,
            B::LessEqual => Binary::LessEqual,
            B::GreaterEqual => Binary::GreaterEqual,
            B::Equal | B::NotEqual | B::LogicalXor | B::Shl | B::Shr => unreachable!("seen above"),
        };
        let matrix = match shape {
            Shape::ScalarLeft => types.get(right.0),
            _ => types.get(left.0),
        };
        match (shape, types.get(left.0), types.get(right.0)) {
            (Shape::MatVec, Type::Matrix { columns, rows }, _) => {
                return self.matrix_times_vector((columns, rows), left.1, right.1);
            }
            (Shape::VecMat, _, Type::Matrix { columns, rows }) => {
                return self.vector_times_matrix((columns, rows), left.1, right.1);
            }
            (Shape::MatMat, Type::Matrix { columns: inner, rows }, Type::Matrix { columns, .. }) => {
                return self.matrix_times_matrix((columns, rows), inner, left.1, right.1);
            }
            _ => {}
        }
        // naga supports products of matrices and scalars, and of float vectors and scalars.
        if op == Binary::Multiply {
            let scaled = if shape == Shape::ScalarLeft { right.0 } else { left.0 };
            if shape == Shape::Same || types.scalar(scaled) == Some(Scalar::Float) {
                return self.op(op, left.1, right.1);
            }
        }
        if let (Type::Matrix { columns, rows }, true) =
            (matrix, matches!(shape, Shape::Same | Shape::ScalarLeft | Shape::ScalarRight))
        {
            if shape == Shape::Same && op != Binary::Divide {
                return self.op(op, left.1, right.1);
            }
            return self.by_column(op, shape, (columns, rows), left.1, right.1);
        }
        let (l, r) = match shape {
            Shape::ScalarLeft => (self.splat(left.1, right.0), right.1),
            Shape::ScalarRight => (left.1, self.splat(right.1, left.0)),
            _ => (left.1, right.1),
        };
        self.op(op, l, r)
    }

    /// Applies an operator component by component on matrices, where naga lacks it.
    fn by_column(&mut self, op: Binary, shape: Shape, (columns, rows): (u8, u8), left: Value, right: Value) -> Value {
        let column_ty = TypeId::vector(Scalar::Float, rows);
        let scalar = match shape {
            Shape::ScalarLeft => Some(self.splat(left, column_ty)),
            Shape::ScalarRight => Some(self.splat(right, column_ty)),
            _ => None,
        };
        let mut out = Vec::with_capacity(columns.into());
        for index in 0..u32::from(columns) {
            let l = match (shape, scalar) {
                (Shape::ScalarLeft, Some(scalar)) => scalar,
                _ => self.add(Op::Part { base: left, index }),
            };
            let r = match (shape, scalar) {
                (Shape::ScalarRight, Some(scalar)) => scalar,
                _ => self.add(Op::Part { base: right, index }),
            };
            out.push(self.op(op, l, r));
        }
        self.compose(TypeId::matrix(columns, rows), out)
    }

    /// Lowers a shift. Distances of 32 and more are undefined in GLSL and rejected by naga: the low five bits are used,
    /// as on all hardware.
    fn shift(&mut self, op: Binary, left: Typed, right: Typed) -> Value {
        let hir = self.cx.hir;
        let small = self.integer(right.1).is_some_and(|by| by < 32);
        let mut by = right.1;
        if hir.types.scalar(right.0) == Some(Scalar::Int) {
            by = match self.integer(by) {
                Some(bits) => self.literal(Scalar::Uint, bits),
                None => self.bitcast(by, Scalar::Uint),
            };
        }
        if !small {
            let size = self.extent(right.0) as u8;
            let mask = self.int_of(TypeId::vector(Scalar::Uint, size), 31);
            let low = self.op(Binary::And, by, mask);
            self.record_precondition(low, || Precondition::Distance(by));
            by = low;
        }
        if self.extent(right.0) == 1 {
            by = self.splat(by, left.0);
        }
        self.op(op, left.1, by)
    }

    /// Lowers `==` of whole values of one type.
    pub(super) fn equal(&mut self, ty: TypeId, left: Value, right: Value) -> Value {
        let hir = self.cx.hir;
        let parts: Vec<TypeId> = match hir.types.get(ty) {
            Type::Vector { .. } => {
                let each = self.op(Binary::Equal, left, right);
                return self.add(Op::All(each));
            }
            Type::Matrix { columns, rows } => vec![TypeId::vector(Scalar::Float, rows); columns.into()],
            Type::Array { element, len } => vec![element; len as usize],
            Type::Struct(id) => hir[hir[id].members].iter().map(|member| member.ty).collect(),
            _ => return self.op(Binary::Equal, left, right),
        };
        let mut all = None;
        for (index, ty) in parts.into_iter().enumerate() {
            let index = index as u32;
            let l = self.add(Op::Part { base: left, index });
            let r = self.add(Op::Part { base: right, index });
            let equal = self.equal(ty, l, r);
            all = Some(match all {
                Some(all) => self.op(Binary::LogicalAnd, all, equal),
                None => equal,
            });
        }
        all.unwrap_or_else(|| self.literal(Scalar::Bool, 1))
    }

    pub(super) fn assign(&mut self, place: ExprId, value: ExprId) -> Value {
        let place = self.place(place);
        let value = self.value(value);
        self.store_place(place, value);
        value
    }

    pub(super) fn assign_op(&mut self, op: BinaryOp, shape: Shape, place: ExprId, value: ExprId) -> Value {
        let hir = self.cx.hir;
        let (place_ty, value_ty) = (hir[place].ty, hir[value].ty);
        let at = self.place(place);
        let right = self.value(value);
        let left = self.load_place(at);
        let result = self.binary(op, shape, (place_ty, left), (value_ty, right));
        self.store_place(at, result);
        result
    }

    pub(super) fn inc_dec(&mut self, op: IncDec, place: ExprId) -> Value {
        let hir = self.cx.hir;
        let ty = hir[place].ty;
        let scalar = hir.types.scalar(ty).unwrap_or(Scalar::Int);
        let one = match scalar {
            Scalar::Float => self.float(1.0),
            scalar => self.literal(scalar, 1),
        };
        let shape = match hir.types.get(ty) {
            Type::Scalar(_) => Shape::Same,
            _ => Shape::ScalarRight,
        };
        let place = self.place(place);
        let old = self.load_place(place);
        let direction = match op {
            IncDec::PreIncrement | IncDec::PostIncrement => BinaryOp::Add,
            IncDec::PreDecrement | IncDec::PostDecrement => BinaryOp::Sub,
        };
        let new = self.binary(direction, shape, (ty, old), (TypeId::vector(scalar, 1), one));
        self.store_place(place, new);
        match op {
            IncDec::PreIncrement | IncDec::PreDecrement => new,
            IncDec::PostIncrement | IncDec::PostDecrement => old,
        }
    }

    /// Returns the bits of a literal expression.
    pub(super) fn literal_bits(&self, expr: ExprId) -> Option<u32> {
        match self.cx.hir[expr].kind {
            ExprKind::Literal(bits) => Some(bits),
            _ => None,
        }
    }
}
