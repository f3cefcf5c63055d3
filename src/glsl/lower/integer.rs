//! Built-in functions on the bits of numbers (sections 8.3 and 8.8 of GLSL 4.60), as operations that every graphics API
//! has.

use super::function::Builder;
use crate::{
    hir::{ExprId, Scalar, TypeId},
    ir::{Binary, Value},
};

/// The bits of a float that are not its exponent, the exponent of 0.5 to 1, and the smallest float that is not
/// subnormal.
const NOT_EXPONENT: u32 = 0x807f_ffff;
const HALF: u32 = 0x3f00_0000;
const MIN_NORMAL: u32 = 0x0080_0000;
const MAGNITUDE: u32 = 0x7fff_ffff;

impl Builder<'_, '_> {
    /// Returns the type of as many components as `ty` has.
    fn same_size(&self, ty: TypeId, scalar: Scalar) -> TypeId {
        TypeId::vector(scalar, self.extent(ty).max(1) as u8)
    }

    fn shifted(&mut self, op: Binary, ty: TypeId, value: Value, by: u32) -> Value {
        let amount = self.int_of(self.same_size(ty, Scalar::Uint), by);
        self.op(op, value, amount)
    }

    /// Lowers `frexp(x, out exp)`. Subnormal numbers are made normal first; devices that take them for zeros return
    /// them and 0.
    pub(super) fn frexp(&mut self, ty: TypeId, args: &[ExprId]) -> Value {
        let x = self.value(args[0]);
        let place = self.place(args[1]);
        let (uints, ints) = (self.same_size(ty, Scalar::Uint), self.same_size(ty, Scalar::Int));
        let [mask, min, fraction, half] =
            [MAGNITUDE, MIN_NORMAL, NOT_EXPONENT, HALF].map(|bits| self.int_of(uints, bits));
        let bits = self.bitcast(x, Scalar::Uint);
        let magnitude = self.op(Binary::And, bits, mask);
        let is_subnormal = self.op(Binary::Less, magnitude, min);
        let scale = self.float_of(ty, 16_777_216.0);
        let larger = self.op(Binary::Multiply, x, scale);
        let normal = self.select(is_subnormal, larger, x);
        let bits = self.bitcast(normal, Scalar::Uint);
        let magnitude = self.op(Binary::And, bits, mask);
        let is_zero = self.op(Binary::Less, magnitude, min);
        let exponent = self.shifted(Binary::ShiftRight, ty, magnitude, 23);
        let exponent = self.bitcast(exponent, Scalar::Int);
        let [of_subnormal, of_normal, zero] = [-150i32, -126, 0].map(|number| self.int_of(ints, number as u32));
        let bias = self.select(is_subnormal, of_subnormal, of_normal);
        let exponent = self.op(Binary::Add, exponent, bias);
        let exponent = self.select(is_zero, zero, exponent);
        self.store_place(place, exponent);
        let significand = self.op(Binary::And, bits, fraction);
        let significand = self.op(Binary::InclusiveOr, significand, half);
        let significand = self.bitcast(significand, Scalar::Float);
        self.select(is_zero, x, significand)
    }

    /// Lowers `ldexp(x, exp)`: a product with two powers of two, because one of them may not be a float. Larger
    /// exponents than those of two floats have the same results.
    pub(super) fn ldexp(&mut self, x: Value, ty: TypeId, exponent: Value) -> Value {
        let [min, max, bias] = [-252i32, 254, 127].map(|number| self.int_of(ty, number as u32));
        let exponent = self.math3(crate::ir::Math::Clamp, exponent, min, max);
        let half = self.shifted(Binary::ShiftRight, ty, exponent, 1);
        let rest = self.op(Binary::Subtract, exponent, half);
        [half, rest].into_iter().fold(x, |product, exponent| {
            let biased = self.op(Binary::Add, exponent, bias);
            let bits = self.shifted(Binary::ShiftLeft, ty, biased, 23);
            let power = self.bitcast(bits, Scalar::Float);
            self.op(Binary::Multiply, product, power)
        })
    }

    /// Returns 1 where a condition holds, else 0.
    fn bit(&mut self, condition: Value, ty: TypeId) -> Value {
        let [one, zero] = [1, 0].map(|bits| self.int_of(ty, bits));
        self.select(condition, one, zero)
    }

    /// Lowers `uaddCarry(x, y, out carry)`.
    pub(super) fn add_carry(&mut self, ty: TypeId, args: &[ExprId]) -> Value {
        let (x, y) = (self.value(args[0]), self.value(args[1]));
        let place = self.place(args[2]);
        let sum = self.op(Binary::Add, x, y);
        let is_over = self.op(Binary::Less, sum, x);
        let carry = self.bit(is_over, ty);
        self.store_place(place, carry);
        sum
    }

    /// Lowers `usubBorrow(x, y, out borrow)`.
    pub(super) fn subtract_borrow(&mut self, ty: TypeId, args: &[ExprId]) -> Value {
        let (x, y) = (self.value(args[0]), self.value(args[1]));
        let place = self.place(args[2]);
        let is_under = self.op(Binary::Less, x, y);
        let borrow = self.bit(is_under, ty);
        self.store_place(place, borrow);
        self.op(Binary::Subtract, x, y)
    }

    /// Lowers `umulExtended(x, y, out msb, out lsb)` and `imulExtended`.
    pub(super) fn multiply_extended(&mut self, args: &[ExprId]) {
        let ty = self.cx.hir[args[0]].ty;
        let is_int = self.cx.hir.types.scalar(ty) == Some(Scalar::Int);
        let (x, y) = (self.value(args[0]), self.value(args[1]));
        let (upper_place, lower_place) = (self.place(args[2]), self.place(args[3]));
        let product = |b: &mut Self| match is_int {
            true => b.signed_upper_bits(ty, x, y),
            false => b.upper_bits(ty, x, y),
        };
        let upper = product(self);
        let lower = self.op(Binary::Multiply, x, y);
        self.store_place(upper_place, upper);
        self.store_place(lower_place, lower);
    }

    /// Returns the upper 32 bits of the product of two ints: that of the same bits as uints, without 2 to the power of
    /// 32 times the other factor for each negative one.
    fn signed_upper_bits(&mut self, ty: TypeId, x: Value, y: Value) -> Value {
        let [signs_x, signs_y] = [x, y].map(|value| {
            let signs = self.shifted(Binary::ShiftRight, ty, value, 31);
            self.bitcast(signs, Scalar::Uint)
        });
        let [x, y] = [x, y].map(|value| self.bitcast(value, Scalar::Uint));
        let mut upper = self.upper_bits(self.same_size(ty, Scalar::Uint), x, y);
        for (signs, other) in [(signs_x, y), (signs_y, x)] {
            let excess = self.op(Binary::And, signs, other);
            upper = self.op(Binary::Subtract, upper, excess);
        }
        self.bitcast(upper, Scalar::Int)
    }

    /// Returns the upper 32 bits of the product of two uints, from the products of their halves.
    fn upper_bits(&mut self, ty: TypeId, x: Value, y: Value) -> Value {
        let mask = self.int_of(ty, 0xffff);
        let mut halves = |value: Value| {
            let lower = self.op(Binary::And, value, mask);
            (lower, self.shifted(Binary::ShiftRight, ty, value, 16))
        };
        let ((x_low, x_high), (y_low, y_high)) = (halves(x), halves(y));
        let low = self.op(Binary::Multiply, x_low, y_low);
        let low = self.shifted(Binary::ShiftRight, ty, low, 16);
        let middle = self.op(Binary::Multiply, x_high, y_low);
        let middle = self.op(Binary::Add, middle, low);
        let (rest, carried) = (self.op(Binary::And, middle, mask), self.shifted(Binary::ShiftRight, ty, middle, 16));
        let other = self.op(Binary::Multiply, x_low, y_high);
        let other = self.op(Binary::Add, other, rest);
        let other = self.shifted(Binary::ShiftRight, ty, other, 16);
        let high = self.op(Binary::Multiply, x_high, y_high);
        let high = self.op(Binary::Add, high, carried);
        self.op(Binary::Add, high, other)
    }
}
