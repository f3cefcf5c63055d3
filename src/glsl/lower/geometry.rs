//! Geometric functions, expanded in the order in which OpenGL's compilers evaluate them.
//!
//! SPIR-V leaves the order of additions within a dot product or matrix product to the driver, which uses a different
//! order than its OpenGL counterpart. Real shaders amplify last bits (`fract(sin(dot(p, k)) * 43758.5453)`), so the
//! pictures differ. The number of instructions is the same either way, and drivers may still fuse them.

use super::function::{Builder, PartOf};
use crate::{
    hir::{Scalar, TypeId},
    ir::{Binary, Math, Op, Value},
};

impl Builder<'_, '_> {
    /// Adds `((w w' + z z') + y y') + x x'`: the side of each sum matters for the terms that drivers fuse. Terms
    /// multiplied by a literal zero are left out.
    pub(super) fn dot(&mut self, ty: TypeId, a: Value, b: Value) -> Value {
        let size = self.extent(ty);
        if size == 1 {
            return self.op(Binary::Multiply, a, b);
        }
        let product = |this: &mut Self, index| {
            let is_zero = |this: &Self, side| this.part(side, index) == PartOf::Known(0.0);
            if is_zero(this, a) || is_zero(this, b) {
                let zero = this.float(0.0);
                if !this.cx.marks.undefined {
                    return zero;
                }
                // The value is zero anyway, but undefined values must still be detected in a product with zero.
                let other = if is_zero(this, a) { b } else { a };
                let other = this.add(Op::Part { base: other, index });
                return this.op(Binary::Multiply, zero, other);
            }
            let a = this.add(Op::Part { base: a, index });
            let b = this.add(Op::Part { base: b, index });
            this.op(Binary::Multiply, a, b)
        };
        let mut sum = product(self, size - 1);
        for index in (0..size - 1).rev() {
            let term = product(self, index);
            sum = self.op(Binary::Add, sum, term);
        }
        sum
    }

    pub(super) fn length(&mut self, ty: TypeId, vector: Value) -> Value {
        if ty == TypeId::FLOAT {
            return self.math(Math::Abs, vector);
        }
        let square = self.dot(ty, vector, vector);
        self.math(Math::Sqrt, square)
    }

    pub(super) fn normalize(&mut self, ty: TypeId, vector: Value) -> Value {
        let square = self.dot(ty, vector, vector);
        let scale = self.math(Math::InverseSqrt, square);
        self.op(Binary::Multiply, vector, scale)
    }

    /// Returns `i - 2 dot(n, i) n`.
    pub(super) fn reflect(&mut self, ty: TypeId, i: Value, n: Value) -> Value {
        let dot = self.dot(ty, n, i);
        let two = self.float(2.0);
        let twice = self.op(Binary::Multiply, two, dot);
        let along = self.op(Binary::Multiply, n, twice);
        self.op(Binary::Subtract, i, along)
    }

    /// Lowers `refract` (section 8.5): zero if all light is reflected.
    pub(super) fn refract(&mut self, ty: TypeId, i: Value, n: Value, eta: Value) -> Value {
        let one = self.float(1.0);
        let dot = self.dot(ty, n, i);
        let dot_squared = self.op(Binary::Multiply, dot, dot);
        let sine = self.op(Binary::Subtract, one, dot_squared);
        let bent = self.op(Binary::Multiply, eta, sine);
        let bent = self.op(Binary::Multiply, eta, bent);
        let k = self.op(Binary::Subtract, one, bent);
        let root = self.math(Math::Sqrt, k);
        let along = self.op(Binary::Multiply, eta, dot);
        let sum = self.op(Binary::Add, along, root);
        let normal = self.op(Binary::Multiply, n, sum);
        let scaled = self.op(Binary::Multiply, i, eta);
        let refracted = self.op(Binary::Subtract, scaled, normal);
        let zero_k = self.float(0.0);
        let total = self.op(Binary::Less, k, zero_k);
        let zero = self.zero(ty);
        self.select(total, zero, refracted)
    }

    /// Returns `matCxR * vecC`: columns times components, added from the first on.
    pub(super) fn matrix_times_vector(&mut self, (columns, _): (u8, u8), matrix: Value, vector: Value) -> Value {
        let mut sum = None;
        for index in 0..u32::from(columns) {
            let column = self.add(Op::Part { base: matrix, index });
            let factor = self.add(Op::Part { base: vector, index });
            let term = self.op(Binary::Multiply, column, factor);
            sum = Some(match sum {
                Some(sum) => self.op(Binary::Add, sum, term),
                None => term,
            });
        }
        sum.expect("a matrix has columns")
    }

    /// Returns `vecR * matCxR`: the dot product with each column.
    pub(super) fn vector_times_matrix(&mut self, (columns, rows): (u8, u8), vector: Value, matrix: Value) -> Value {
        let column_ty = TypeId::vector(Scalar::Float, rows);
        let parts = (0..u32::from(columns)).map(|index| {
            let column = self.add(Op::Part { base: matrix, index });
            self.dot(column_ty, vector, column)
        });
        let parts = parts.collect();
        self.compose(TypeId::vector(Scalar::Float, columns), parts)
    }

    /// Returns `matKxR * matCxK`: the left one times each column of the right one.
    pub(super) fn matrix_times_matrix(
        &mut self,
        (columns, rows): (u8, u8),
        inner: u8,
        left: Value,
        right: Value,
    ) -> Value {
        let columns_of_right = (0..u32::from(columns)).map(|index| {
            let column = self.add(Op::Part { base: right, index });
            self.matrix_times_vector((inner, rows), left, column)
        });
        let parts = columns_of_right.collect();
        self.compose(TypeId::matrix(columns, rows), parts)
    }
}
