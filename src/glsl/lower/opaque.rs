//! Values that no compiler behind this one sees through.

use super::function::Builder;
use crate::glsl::{
    hir::{Scalar, TypeId},
    ir::{Binary, Op, Value},
};

impl Builder<'_, '_> {
    /// The same bits, of a scalar or vector type `ty` of numbers, but joined with a zero that the driver cannot know.
    pub fn opaque(&mut self, ty: TypeId, value: Value) -> Value {
        let zero = self.add(Op::OpaqueZero);
        let ints = TypeId::vector(Scalar::Int, self.extent(ty) as u8);
        let zero = self.splat(zero, ints);
        let bits = self.bitcast(value, Scalar::Int);
        let bits = self.op(Binary::InclusiveOr, bits, zero);
        self.bitcast(bits, self.cx.hir.types.scalar(ty).unwrap_or(Scalar::Float))
    }
}
