//! Expands remainders of ints: naga's `%` has the dividend's sign, and its SPIR-V form adds another guard against
//! divisors that cannot occur.
//!
//! GLSL leaves `%` undefined if an operand is negative (section 5.9), but shaders rely on the result of OpenGL drivers
//! and Shadertoy: a remainder with the divisor's sign.

use naga::{BinaryOperator, Expression, Handle};

use super::{function::Builder, types};
use crate::{
    ir::{Op, Value},
    types::{Scalar, Type},
};

impl Builder<'_, '_> {
    /// Returns the remainder that has the divisor's sign.
    pub(super) fn modulo(&mut self, value: Value, left: Value, right: Value) -> Handle<Expression> {
        use BinaryOperator as B;
        let ty = self.ir.ty(value);
        let scalar = self.cx.ir.scalar(ty);
        let size = match self.cx.ir.types.get(ty) {
            Type::Vector { size, .. } => Some(types::vector_size(size.into())),
            _ => None,
        };
        let known = self.known_divisor(right);
        let (left, right) = (self.value(left), self.value(right));
        let op = |b: &mut Self, op, left, right| b.add(Expression::Binary { op, left, right });
        if scalar == Scalar::Uint {
            return op(self, B::Modulo, left, right);
        }
        let repeated = |b: &mut Self, bits| {
            let value = b.literal(scalar, bits);
            size.map_or(value, |size| b.add(Expression::Splat { size, value }))
        };
        if let Some(divisor) = known.filter(|divisor| divisor.is_power_of_two()) {
            let mask = repeated(self, divisor - 1);
            return op(self, B::And, left, mask);
        }
        let quotient = op(self, B::Divide, left, right);
        let multiple = op(self, B::Multiply, quotient, right);
        let rest = op(self, B::Subtract, left, multiple);
        let zero = repeated(self, 0);
        // A remainder of 0 has no sign: for a positive divisor it is not below zero, and for a negative one the test is
        // on the product of signs, which must exclude 0.
        let condition = if known.is_some() {
            op(self, B::Less, rest, zero)
        } else {
            let signs = op(self, B::ExclusiveOr, rest, right);
            let differ = op(self, B::Less, signs, zero);
            let some = op(self, B::NotEqual, rest, zero);
            op(self, B::And, differ, some)
        };
        let moved = op(self, B::Add, rest, right);
        self.add(Expression::Select { condition, accept: moved, reject: rest })
    }

    /// Returns the divisor if it is a positive literal.
    fn known_divisor(&self, value: Value) -> Option<u32> {
        match self.ir[value] {
            Op::Literal(Scalar::Int, bits) => (bits as i32 > 0).then_some(bits),
            Op::Splat { value, .. } => self.known_divisor(value),
            _ => None,
        }
    }
}
