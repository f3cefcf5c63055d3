//! Quotients and remainders of integers, which must never trap.
//!
//! GLSL leaves division by zero undefined (section 5.9), and so does SPIR-V, as well as the division of the smallest
//! int by -1. On x86 both end the process: Mesa's drivers trap even when folding constants (`idiv` in
//! `nir_constant_expressions.c` checks only for zero). Therefore a divisor that could be either is guarded: where it
//! is, it becomes 1, and no driver encounters it. The results are those of WGSL (section 8.7): `x / 0` is `x`, `x % 0`
//! is 0, and the smallest int divided by -1 is itself, with the remainder 0. A division by -1 becomes a division by 1
//! and a negation, which does not depend on the dividend: there is one guard per divisor, outside the loop if it is
//! invariant, and `/` and `%` share their quotient.
//!
//! naga has guards too, but as functions that are called, and without using known operands.

use super::{function::Builder, names::Precondition, operators::Typed};
use crate::{
    hir::{BinaryOp, Scalar, Shape, TypeId},
    ir::{Binary, Math, Op, Value},
};

const MINUS_ONE: u32 = -1i32 as u32;

impl Builder<'_, '_> {
    /// Lowers `/` and `%` of ints and uints.
    pub(super) fn int_division(&mut self, op: BinaryOp, shape: Shape, left: Typed, right: Typed) -> Value {
        let ty = if shape == Shape::ScalarLeft { right.0 } else { left.0 };
        let signed = self.cx.hir.types.scalar(ty) == Some(Scalar::Int);
        let dividend = if shape == Shape::ScalarLeft { self.splat(left.1, ty) } else { left.1 };
        let mut numbers = Vec::new();
        // Whether the divisor may be zero, and whether it may be -1, which overflows.
        let (divisor, zero, minus_one) = match self.int_components(right.0, right.1, &mut numbers) {
            // Division by -1 without a division.
            Some(()) if signed && numbers.iter().all(|&number| number == MINUS_ONE) => {
                let zero = self.zero(ty);
                return if op == BinaryOp::Rem { zero } else { self.op(Binary::Subtract, zero, dividend) };
            }
            Some(()) => {
                let minus_one = signed && numbers.contains(&MINUS_ONE);
                (self.without_zeros(right, numbers), false, minus_one)
            }
            None => (right.1, true, signed),
        };
        let divisor = self.splat_to(divisor, right.0, ty);
        let one = self.int_of(ty, 1);
        let safe = match (zero, minus_one) {
            (false, false) => divisor,
            (true, false) => self.math2(Math::Max, divisor, one),
            (false, true) => {
                let bad = self.is_minus_one(ty, divisor);
                self.select(bad, one, divisor)
            }
            // Checks both at once: the divisor plus one is 0 or 1.
            (true, true) => {
                let more = self.op(Binary::Add, divisor, one);
                let unsigned = TypeId::vector(Scalar::Uint, self.extent(ty) as u8);
                let more = self.convert(more, unsigned);
                let two = self.int_of(unsigned, 2);
                let bad = self.op(Binary::Less, more, two);
                self.select(bad, one, divisor)
            }
        };
        if zero {
            self.record_precondition(safe, || Precondition::Divisor(divisor));
        }
        match op {
            BinaryOp::Rem => self.op(Binary::Modulo, dividend, safe),
            _ => {
                let quotient = self.op(Binary::Divide, dividend, safe);
                if !minus_one {
                    return quotient;
                }
                let none = self.zero(ty);
                let negative = self.op(Binary::Subtract, none, quotient);
                let turned = self.is_minus_one(ty, divisor);
                self.select(turned, negative, quotient)
            }
        }
    }

    fn is_minus_one(&mut self, ty: TypeId, divisor: Value) -> Value {
        let minus_one = self.int_of(ty, MINUS_ONE);
        self.op(Binary::Equal, divisor, minus_one)
    }

    pub(super) fn splat_to(&mut self, value: Value, from: TypeId, ty: TypeId) -> Value {
        if from == ty { value } else { self.splat(value, ty) }
    }

    /// Returns a constant divisor with ones in place of zeros.
    fn without_zeros(&mut self, divisor: Typed, mut numbers: Vec<u32>) -> Value {
        if !numbers.contains(&0) {
            return divisor.1;
        }
        numbers.iter_mut().filter(|number| **number == 0).for_each(|number| *number = 1);
        let scalar = self.cx.hir.types.scalar(divisor.0).unwrap_or(Scalar::Int);
        let parts: Vec<Value> = numbers.into_iter().map(|number| self.literal(scalar, number)).collect();
        match parts[..] {
            [one] => one,
            _ => self.compose(divisor.0, parts),
        }
    }

    /// Adds the components of a constant; returns `None` if they are unknown or it is not a constant.
    fn int_components(&self, ty: TypeId, value: Value, out: &mut Vec<u32>) -> Option<()> {
        let count = self.extent(ty) as usize;
        match &self.f[value] {
            Op::Zero(_) => out.extend(std::iter::repeat_n(0, count)),
            Op::Splat { value, .. } => out.extend(std::iter::repeat_n(self.integer(*value)?, count)),
            Op::Compose { parts, .. } => {
                for &part in parts {
                    out.push(if let Op::Zero(_) = self.f[part] { 0 } else { self.integer(part)? });
                }
            }
            Op::Const(id) => out.extend(&self.cx.out[*id].words),
            _ => out.push(self.integer(value)?),
        }
        // A zero inside a composed vector may represent several components.
        (out.len() == count).then_some(())
    }
}
