//! Geometry, written out in the order in which OpenGL's compilers evaluate it.
//!
//! SPIR-V leaves the order of additions within a dot product or matrix product to the driver, which takes another one than its
//! OpenGL sibling. Real shaders blow up last bits (`fract(sin(dot(p, k)) * 43758.5453)`), so the pictures differ. The
//! instructions are as many either way, and drivers may still fuse them.

use super::function::Builder;
use crate::glsl::hir::{Scalar, TypeId};
use crate::glsl::ir::{Binary, Math, Op, Value};

impl Builder<'_, '_> {
    /// `((w w' + z z') + y y') + x x'`: the side the sum is on matters to what drivers join it with. What is multiplied by a
    /// literal zero is left out.
    pub fn dot(&mut self, ty: TypeId, a: Value, b: Value) -> Value {
        let size = self.extent(ty);
        if size == 1 {
            return self.op(Binary::Multiply, a, b);
        }
        let product = |this: &mut Self, index| {
            let a = this.add(Op::Part { base: a, index });
            let b = this.add(Op::Part { base: b, index });
            let is_zero = |side| this.number(side) == Some(0.0);
            if is_zero(a) || is_zero(b) { this.float(0.0) } else { this.op(Binary::Multiply, a, b) }
        };
        let mut sum = product(self, size - 1);
        for index in (0..size - 1).rev() {
            let term = product(self, index);
            sum = self.op(Binary::Add, sum, term);
        }
        sum
    }

    pub fn length(&mut self, ty: TypeId, vector: Value) -> Value {
        if ty == TypeId::FLOAT {
            return self.math(Math::Abs, vector);
        }
        let square = self.dot(ty, vector, vector);
        self.math(Math::Sqrt, square)
    }

    pub fn normalize(&mut self, ty: TypeId, vector: Value) -> Value {
        let square = self.dot(ty, vector, vector);
        let scale = self.math(Math::InverseSqrt, square);
        self.each(ty, [(ty, vector), (TypeId::FLOAT, scale)], |b, [x, scale]| b.op(Binary::Multiply, x, scale))
    }

    /// `i - 2 dot(n, i) n`.
    pub fn reflect(&mut self, ty: TypeId, i: Value, n: Value) -> Value {
        let dot = self.dot(ty, n, i);
        let two = self.float(2.0);
        let twice = self.op(Binary::Multiply, two, dot);
        self.each(ty, [(ty, i), (ty, n), (TypeId::FLOAT, twice)], |b, [i, n, twice]| {
            let along = b.op(Binary::Multiply, n, twice);
            b.op(Binary::Subtract, i, along)
        })
    }

    /// Section 8.5: zero where all light is reflected.
    pub fn refract(&mut self, ty: TypeId, i: Value, n: Value, eta: Value) -> Value {
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
        let float = TypeId::FLOAT;
        let refracted = self.each(ty, [(ty, i), (float, eta), (ty, n), (float, sum)], |b, [i, eta, n, sum]| {
            let normal = b.op(Binary::Multiply, n, sum);
            let scaled = b.op(Binary::Multiply, i, eta);
            b.op(Binary::Subtract, scaled, normal)
        });
        let zero_k = self.float(0.0);
        let total = self.op(Binary::Less, k, zero_k);
        let zero = self.zero(ty);
        self.select(total, zero, refracted)
    }

    /// `matCxR * vecC`: columns times components, added from the first on.
    pub fn matrix_times_vector(&mut self, (columns, rows): (u8, u8), matrix: Value, vector: Value) -> Value {
        let ty = TypeId::vector(Scalar::Float, rows);
        let mut sum = None;
        for index in 0..u32::from(columns) {
            let column = self.add(Op::Part { base: matrix, index });
            let factor = self.add(Op::Part { base: vector, index });
            let term = self
                .each(ty, [(ty, column), (TypeId::FLOAT, factor)], |b, [x, factor]| b.op(Binary::Multiply, x, factor));
            sum = Some(match sum {
                Some(sum) => self.each(ty, [(ty, sum), (ty, term)], |b, [sum, term]| {
                    b.with_constant_factored(sum, term).unwrap_or_else(|| b.op(Binary::Add, sum, term))
                }),
                None => term,
            });
        }
        sum.expect("a matrix has columns")
    }

    /// `vecR * matCxR`: the dot product with each column.
    pub fn vector_times_matrix(&mut self, (columns, rows): (u8, u8), vector: Value, matrix: Value) -> Value {
        let column_ty = TypeId::vector(Scalar::Float, rows);
        let parts = (0..u32::from(columns)).map(|index| {
            let column = self.add(Op::Part { base: matrix, index });
            self.dot(column_ty, vector, column)
        });
        let parts = parts.collect();
        self.compose(TypeId::vector(Scalar::Float, columns), parts)
    }

    /// `matKxR * matCxK`: the left one times each column of the right one.
    pub fn matrix_times_matrix(&mut self, (columns, rows): (u8, u8), inner: u8, left: Value, right: Value) -> Value {
        let ty = TypeId::matrix(columns, rows);
        let columns = (0..u32::from(columns)).map(|index| {
            let column = self.add(Op::Part { base: right, index });
            self.matrix_times_vector((inner, rows), left, column)
        });
        let columns = columns.collect();
        self.compose(ty, columns)
    }
}
