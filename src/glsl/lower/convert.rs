//! Constructors and conversions (section 5.4).

use super::function::Builder;
use crate::{
    hir::{ExprId, Scalar, Type, TypeId},
    ir::{Op, Value},
};

impl Builder<'_, '_> {
    /// Converts a scalar or vector to the same size of another component type.
    pub(super) fn convert(&mut self, value: Value, to: TypeId) -> Value {
        let to = self.cx.hir.types.scalar(to).expect("a scalar or vector");
        // From float to uint, negative numbers become zero: GLSL leaves it undefined, Direct3D requires it, and devices
        // do it.
        self.add(Op::Convert { value, to })
    }

    /// Lowers `vecN(..)` of scalars, vectors and matrices.
    pub(super) fn vector(&mut self, ty: TypeId, args: &[ExprId]) -> Value {
        let hir = self.cx.hir;
        let size = self.extent(ty) as usize;
        let values: Vec<_> = self.values(args).into_iter().zip(args.iter().map(|&arg| hir[arg].ty)).collect();
        let mut parts = Vec::with_capacity(size);
        let mut filled = 0;
        for (value, ty) in values {
            if filled >= size {
                break;
            }
            let components = hir.types.components(ty).unwrap_or(1) as usize;
            match hir.types.get(ty) {
                Type::Scalar(_) => parts.push(value),
                // Vectors that fit are used whole.
                Type::Vector { .. } if filled + components <= size => parts.push(value),
                _ => {
                    let mut all = Vec::new();
                    self.components(value, ty, &mut all);
                    parts.extend(all.into_iter().take(size - filled));
                }
            }
            filled += components;
        }
        match parts[..] {
            [whole] => whole,
            _ => self.compose(ty, parts),
        }
    }

    /// Lowers `matCxR(..)` of scalars and vectors, column by column.
    pub(super) fn matrix(&mut self, ty: TypeId, args: &[ExprId]) -> Value {
        let hir = self.cx.hir;
        let Type::Matrix { columns, rows } = hir.types.get(ty) else { unreachable!("a matrix type") };
        let column_ty = TypeId::vector(Scalar::Float, rows);
        let values: Vec<_> = self.values(args).into_iter().zip(args.iter().map(|&arg| hir[arg].ty)).collect();
        if values.len() == usize::from(columns) && values.iter().all(|(_, ty)| *ty == column_ty) {
            return self.compose(ty, values.into_iter().map(|(value, _)| value).collect());
        }
        let mut scalars = Vec::with_capacity(16);
        for (value, ty) in values {
            self.components(value, ty, &mut scalars);
        }
        let columns = scalars.chunks_exact(rows.into()).take(columns.into());
        let columns: Vec<_> = columns.map(|column| self.compose(column_ty, column.to_vec())).collect();
        self.compose(ty, columns)
    }

    pub(super) fn matrix_diagonal(&mut self, ty: TypeId, of: ExprId) -> Value {
        let Type::Matrix { columns, rows } = self.cx.hir.types.get(ty) else { unreachable!("a matrix type") };
        let value = self.value(of);
        let zero = self.float(0.0);
        let columns: Vec<_> = (0..columns)
            .map(|c| {
                let column = (0..rows).map(|r| if r == c { value } else { zero }).collect();
                self.compose(TypeId::vector(Scalar::Float, rows), column)
            })
            .collect();
        self.compose(ty, columns)
    }

    pub(super) fn matrix_resize(&mut self, ty: TypeId, of: ExprId) -> Value {
        let hir = self.cx.hir;
        let Type::Matrix { columns, rows } = hir.types.get(ty) else { unreachable!("a matrix type") };
        let Type::Matrix { columns: from_columns, rows: from_rows } = hir.types.get(hir[of].ty) else {
            unreachable!("a matrix type")
        };
        let value = self.value(of);
        let mut out = Vec::with_capacity(columns.into());
        for c in 0..columns {
            let mut column = Vec::with_capacity(rows.into());
            let source = (c < from_columns).then(|| self.add(Op::Part { base: value, index: u32::from(c) }));
            for r in 0..rows {
                column.push(match source {
                    Some(source) if r < from_rows => self.add(Op::Part { base: source, index: u32::from(r) }),
                    _ => self.float(if r == c { 1.0 } else { 0.0 }),
                });
            }
            out.push(self.compose(TypeId::vector(Scalar::Float, rows), column));
        }
        self.compose(ty, out)
    }
}
