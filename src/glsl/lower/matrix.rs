//! Matrix functions (section 8.6). `inverse` is expanded because naga's Metal and HLSL writers lack it, and like
//! `determinant` in the order of OpenGL's compilers (see [`super::geometry`]).

use super::function::Builder;
use crate::{
    hir::{Scalar, Type, TypeId},
    ir::{Binary, Math, Op, Value},
};

impl Builder<'_, '_> {
    /// Returns the inverse of a square matrix: transposed cofactors over the determinant.
    pub(super) fn inverse(&mut self, ty: TypeId, matrix: Value) -> Value {
        let m = self.elements(ty, matrix);
        let n = m.len();
        // Column j, row i of the inverse is the cofactor of m's row j, column i.
        let mut cofactors = vec![Vec::with_capacity(n); n];
        for (j, column) in cofactors.iter_mut().enumerate() {
            for i in 0..n {
                column.push(self.cofactor(&m, i, j));
            }
        }
        let first: Vec<Value> = cofactors.iter().map(|column| column[0]).collect();
        let determinant = self.expand(&m[0], &first);
        let column_ty = TypeId::vector(Scalar::Float, n as u8);
        let divisor = self.splat(determinant, column_ty);
        let columns: Vec<_> = cofactors
            .into_iter()
            .map(|column| {
                let column = self.compose(column_ty, column);
                self.op(Binary::Divide, column, divisor)
            })
            .collect();
        self.compose(ty, columns)
    }

    pub(super) fn determinant(&mut self, ty: TypeId, matrix: Value) -> Value {
        if self.extent(ty) < 4 {
            return self.math(Math::Determinant, matrix);
        }
        let m = self.elements(ty, matrix);
        let cofactors: Vec<_> = (0..m.len()).map(|row| self.cofactor(&m, 0, row)).collect();
        self.expand(&m[0], &cofactors)
    }

    /// Returns the elements of a matrix as `m[c][r]`: column c, row r.
    fn elements(&mut self, ty: TypeId, matrix: Value) -> Vec<Vec<Value>> {
        let n = self.extent(ty);
        let part = |this: &mut Self, base, index| this.add(Op::Part { base, index });
        (0..n)
            .map(|c| {
                let column = part(self, matrix, c);
                (0..n).map(|r| part(self, column, r)).collect()
            })
            .collect()
    }

    /// Returns a determinant from its first column and that column's cofactors.
    fn expand(&mut self, column: &[Value], cofactors: &[Value]) -> Value {
        let terms: Vec<_> = column.iter().zip(cofactors).map(|(&e, &c)| self.op(Binary::Multiply, e, c)).collect();
        match terms[..] {
            // Four terms are added from the end, fewer from the start.
            [a, b, c, d] => {
                let sum = self.op(Binary::Add, c, d);
                let sum = self.op(Binary::Add, b, sum);
                self.op(Binary::Add, a, sum)
            }
            _ => terms.into_iter().reduce(|sum, term| self.op(Binary::Add, sum, term)).expect("a matrix has columns"),
        }
    }

    /// Returns the cofactor of the element in column i, row j.
    fn cofactor(&mut self, m: &[Vec<Value>], i: usize, j: usize) -> Value {
        let without = |skip: usize| (0..m.len()).filter(|&k| k != skip).collect::<Vec<_>>();
        let minor = self.minor(m, &without(i), &without(j));
        if (i + j).is_multiple_of(2) {
            return minor;
        }
        let minus = self.float(-1.0);
        self.op(Binary::Multiply, minor, minus)
    }

    /// Returns the determinant of the named columns and rows, expanded along the first of the columns.
    fn minor(&mut self, m: &[Vec<Value>], columns: &[usize], rows: &[usize]) -> Value {
        let (&first, rest) = columns.split_first().expect("a minor has a column");
        if rest.is_empty() {
            return m[first][rows[0]];
        }
        let mut sum = None;
        for (i, &row) in rows.iter().enumerate() {
            let others: Vec<usize> = rows.iter().copied().filter(|&r| r != row).collect();
            let below = self.minor(m, rest, &others);
            let term = self.op(Binary::Multiply, m[first][row], below);
            sum = Some(match sum {
                None => term,
                Some(sum) => self.op(if i % 2 == 0 { Binary::Add } else { Binary::Subtract }, sum, term),
            });
        }
        sum.expect("a minor has a row")
    }

    pub(super) fn matrix_comp_mult(&mut self, ty: TypeId, a: Value, b: Value) -> Value {
        let Type::Matrix { columns, .. } = self.cx.hir.types.get(ty) else { unreachable!("a matrix type") };
        let columns = (0..u32::from(columns)).map(|index| {
            let left = self.add(Op::Part { base: a, index });
            let right = self.add(Op::Part { base: b, index });
            self.op(Binary::Multiply, left, right)
        });
        let columns = columns.collect();
        self.compose(ty, columns)
    }

    /// Returns a matrix whose columns are `a` times each component of `b`.
    pub(super) fn outer_product(&mut self, ty: TypeId, b_ty: TypeId, a: Value, b: Value) -> Value {
        let mut parts = Vec::new();
        self.components(b, b_ty, &mut parts);
        let columns = parts.into_iter().map(|part| self.op(Binary::Multiply, a, part)).collect();
        self.compose(ty, columns)
    }
}
