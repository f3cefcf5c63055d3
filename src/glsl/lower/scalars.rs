//! Vector arithmetic, written out by component, each operation once.
//!
//! Which terms of sums and products a driver joins depends on whether it looks before or after it splits vectors and finds what
//! is computed twice. OpenGL drivers do both first, Vulkan ones later, so last bits differ (see [`super::regroup`]); here both is
//! done beforehand. Devices that compute by component have as much to do either way.

use super::{function::Builder, operators::Typed};
use crate::glsl::hir::{Builtin, Scalar, Type, TypeId};
use crate::glsl::ir::{Binary, Math, Op, Unary, Value};

/// What tells pure operations apart: kind, operator, operands.
pub(super) type Key = (u8, u32, [Option<Value>; 4]);

/// `None` for what may be another value each time.
pub(super) fn key(op: &Op) -> Option<Key> {
    Some(match *op {
        Op::Binary { op, left, right } => (0, op as u32, [Some(left), Some(right), None, None]),
        Op::Part { base, index } => (1, index, [Some(base), None, None, None]),
        Op::Unary { op, operand } => (2, op as u32, [Some(operand), None, None, None]),
        Op::Math { fun, arg, arg1, arg2, arg3 } => (3, fun as u32, [Some(arg), arg1, arg2, arg3]),
        Op::Splat { size, value } => (4, size.into(), [Some(value), None, None, None]),
        Op::Convert { value, to } => (5, to as u32, [Some(value), None, None, None]),
        Op::Select { condition, accept, reject } => (6, 0, [Some(condition), Some(accept), Some(reject), None]),
        Op::OpaqueZero => (7, 0, [None; 4]),
        _ => return None,
    })
}

impl Builder<'_, '_> {
    pub fn is_float_vector(&self, ty: TypeId) -> bool {
        matches!(self.cx.hir.types.get(ty), Type::Vector { scalar: Scalar::Float, .. })
    }

    /// Applies `f` to the components of vectors, and to scalars as they are; `ty` is the result's type.
    pub fn each<const N: usize>(
        &mut self,
        ty: TypeId,
        operands: [Typed; N],
        mut f: impl FnMut(&mut Self, [Value; N]) -> Value,
    ) -> Value {
        let size = self.extent(ty);
        if size == 1 {
            return f(self, operands.map(|(_, value)| value));
        }
        let mut parts = Vec::with_capacity(size as usize);
        for index in 0..size {
            let values = operands.map(|(ty, value)| match self.extent(ty) {
                1 => value,
                _ => self.add(Op::Part { base: value, index }),
            });
            parts.push(f(self, values));
        }
        self.compose(ty, parts)
    }

    /// The result of an operation on literals, as they meet where a small function is inlined. None that is not finite: it is
    /// left to the device. In single precision, as OpenGL's compilers do it.
    pub fn folded_number(&self, expression: &Op) -> Option<f32> {
        let number = |value| match self.f[value] {
            Op::Literal(..) => self.number(value),
            Op::Part { .. } => self.floats(value).map(|all| all[0]),
            _ => None,
        };
        let folded = match *expression {
            Op::Unary { op: Unary::Negate, operand } => -number(operand)?,
            Op::Binary { op, left, right } => {
                let (left, right) = (number(left)?, number(right)?);
                match op {
                    Binary::Add => left + right,
                    Binary::Subtract => left - right,
                    Binary::Multiply => left * right,
                    Binary::Divide => left / right,
                    _ => return None,
                }
            }
            Op::Math { fun: Math::Pow, arg, arg1: Some(power), .. } => {
                let (x, power) = (number(arg)?, number(power)?);
                x.powf(power)
            }
            Op::Math { fun: Math::Atan2, arg, arg1: Some(x), .. } => {
                let (y, x) = (number(arg)?, number(x)?);
                y.atan2(x)
            }
            Op::Math { fun, arg, arg1: None, .. } => {
                let x = number(arg)?;
                match fun {
                    Math::Sin => x.sin(),
                    Math::Cos => x.cos(),
                    Math::Atan => x.atan(),
                    Math::Exp => x.exp(),
                    Math::Exp2 => x.exp2(),
                    Math::Log => x.ln(),
                    Math::Log2 => x.log2(),
                    Math::Sqrt => x.sqrt(),
                    Math::InverseSqrt => 1.0 / x.sqrt(),
                    Math::Abs => x.abs(),
                    Math::Floor => x.floor(),
                    Math::Fract => x - x.floor(),
                    _ => return None,
                }
            }
            _ => return None,
        };
        folded.is_finite().then_some(folded)
    }

    /// The operand that an operation with a literal leaves as it is.
    pub fn unchanged(&self, expression: &Op) -> Option<Value> {
        let Op::Binary { op, left, right } = *expression else { return None };
        let is = |value, number| self.number(value) == Some(number);
        match op {
            Binary::Add if is(left, 0.0) => Some(right),
            Binary::Add | Binary::Subtract if is(right, 0.0) => Some(left),
            Binary::Multiply if is(left, 1.0) => Some(right),
            Binary::Multiply | Binary::Divide if is(right, 1.0) => Some(left),
            _ => None,
        }
    }

    /// What a component of a value is, if no instruction is needed to take it out.
    pub fn known_component(&mut self, base: Value, index: u32) -> Option<Value> {
        match self.f[base] {
            Op::Splat { value, .. } => Some(value),
            Op::Swizzle { vector: mut base, swizzle } => {
                let mut index = swizzle.get(index as usize) as u32;
                // Thousands may stand one behind the other.
                while let Op::Swizzle { vector, swizzle } = self.f[base] {
                    index = swizzle.get(index as usize) as u32;
                    base = vector;
                }
                Some(self.add(Op::Part { base, index }))
            }
            Op::Compose { ty, ref parts } => {
                let is_whole = parts.len() == self.cx.out.extent(ty) as usize;
                is_whole.then(|| parts[index as usize])
            }
            Op::Const(_) => match self.floats(base)?[..] {
                [] | [_] => None,
                ref all => {
                    let number = all[index as usize];
                    Some(self.float(number))
                }
            },
            Op::Zero(ty) if self.is_float_vector(ty) => Some(self.float(0.0)),
            Op::Load { .. } => self.members.get(&(base, index)).copied(),
            _ => None,
        }
    }
}

/// Whether a built-in works on each component alone, by the type of its result where that is of floats.
pub(super) fn is_by_component(builtin: Builtin) -> bool {
    use Builtin as B;
    matches!(
        builtin,
        B::Radians
            | B::Degrees
            | B::Sin
            | B::Cos
            | B::Tan
            | B::Asin
            | B::Acos
            | B::Atan
            | B::Exp
            | B::Log
            | B::Exp2
            | B::Log2
            | B::Sqrt
            | B::InverseSqrt
            | B::Abs
            | B::Sign
            | B::Floor
            | B::Trunc
            | B::Round
            | B::RoundEven
            | B::Ceil
            | B::Fract
            | B::Pow
            | B::Min
            | B::Max
            | B::Mod
            | B::Step
            | B::Clamp
            | B::Smoothstep
    )
}
