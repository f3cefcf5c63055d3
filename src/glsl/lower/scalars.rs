//! Vector arithmetic, written out by component, each operation once.
//!
//! Which terms of sums and products a driver joins depends on whether it looks before or after it splits vectors and finds what
//! is computed twice. OpenGL drivers do both first, Vulkan ones later, so last bits differ (see [`super::regroup`]); here both is
//! done beforehand. Devices that compute by component have as much to do either way.

use naga::{BinaryOperator, Expression, Literal, MathFunction as Math, TypeInner, UnaryOperator};

use super::{
    function::{Builder, Value},
    operators::Typed,
};
use crate::glsl::hir::{Builtin, Scalar, Type, TypeId};

/// What tells pure operations apart: kind, operator, operands.
pub(super) type Key = (u8, u32, [Option<Value>; 4]);

/// `None` for what may be another value each time.
pub(super) fn key(expression: &Expression) -> Option<Key> {
    use Expression as E;
    Some(match *expression {
        E::Binary { op, left, right } => (0, op as u32, [Some(left), Some(right), None, None]),
        E::AccessIndex { base, index } => (1, index, [Some(base), None, None, None]),
        E::Unary { op, expr } => (2, op as u32, [Some(expr), None, None, None]),
        E::Math { fun, arg, arg1, arg2, arg3 } => (3, fun as u32, [Some(arg), arg1, arg2, arg3]),
        E::Splat { size, value } => (4, size as u32, [Some(value), None, None, None]),
        E::As { expr, kind, convert: Some(_) } => (5, kind as u32, [Some(expr), None, None, None]),
        E::Select { condition, accept, reject } => (6, 0, [Some(condition), Some(accept), Some(reject), None]),
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
                _ => self.add(Expression::AccessIndex { base: value, index }),
            });
            parts.push(f(self, values));
        }
        let vector = self.compose(ty, parts);
        self.by_component.insert(vector);
        vector
    }

    /// The result of an operation on literals, as they meet where a small function is inlined. None that is not finite: it is
    /// left to the device. In single precision, as OpenGL's compilers do it.
    pub fn folded_number(&self, expression: &Expression) -> Option<f32> {
        use BinaryOperator as Op;
        let number = |value| match self.f.expressions[value] {
            Expression::Literal(Literal::F32(number)) => Some(number),
            Expression::AccessIndex { .. } => self.floats(value).map(|all| all[0]),
            _ => None,
        };
        let folded = match *expression {
            Expression::Unary { op: UnaryOperator::Negate, expr } => -number(expr)?,
            Expression::Binary { op, left, right } => {
                let (left, right) = (number(left)?, number(right)?);
                match op {
                    Op::Add => left + right,
                    Op::Subtract => left - right,
                    Op::Multiply => left * right,
                    Op::Divide => left / right,
                    _ => return None,
                }
            }
            Expression::Math { fun: Math::Pow, arg, arg1: Some(power), .. } => {
                let (x, power) = (number(arg)?, number(power)?);
                x.powf(power)
            }
            Expression::Math { fun: Math::Atan2, arg, arg1: Some(x), .. } => {
                let (y, x) = (number(arg)?, number(x)?);
                y.atan2(x)
            }
            Expression::Math { fun, arg, arg1: None, .. } => {
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
    pub fn unchanged(&self, expression: &Expression) -> Option<Value> {
        use BinaryOperator as Op;
        let Expression::Binary { op, left, right } = *expression else { return None };
        let is = |value, number| match self.f.expressions[value] {
            Expression::Literal(Literal::F32(found)) => found == number,
            _ => false,
        };
        match op {
            Op::Add if is(left, 0.0) => Some(right),
            Op::Add | Op::Subtract if is(right, 0.0) => Some(left),
            Op::Multiply if is(left, 1.0) => Some(right),
            Op::Multiply | Op::Divide if is(right, 1.0) => Some(left),
            _ => None,
        }
    }

    /// A column of a matrix. Where it is constant and has one number twice, its components are those of a constant instead of
    /// literals: of a sum of products Mesa takes out what is one literal, but not what is two components of one vector.
    pub fn column(&mut self, ty: TypeId, matrix: Value, index: u32) -> Value {
        let column = self.add(Expression::AccessIndex { base: matrix, index });
        match self.floats(column) {
            Some(numbers) if (1..numbers.len()).any(|i| numbers[..i].contains(&numbers[i])) => {
                let parts = (0..numbers.len() as u32).map(|index| self.constant_component(&numbers, index)).collect();
                self.compose(ty, parts)
            }
            _ => column,
        }
    }

    fn constant_component(&mut self, numbers: &[f32], index: u32) -> Value {
        let number = numbers[index as usize];
        if matches!(number.abs(), 0.0 | 1.0) {
            return self.float(number);
        }
        let constant = self.cx.vector_constant(numbers);
        let base = match self.vectors.get(&constant) {
            Some(&base) => base,
            None => {
                let base = self.given(Expression::Constant(constant));
                self.vectors.insert(constant, base);
                base
            }
        };
        self.add_as_is(Expression::AccessIndex { base, index })
    }

    /// What a component of a value is, if no instruction is needed to take it out.
    pub fn known_component(&mut self, base: Value, index: u32) -> Option<Value> {
        match self.f.expressions[base] {
            Expression::Splat { value, .. } => Some(value),
            Expression::Swizzle { vector: mut base, pattern, .. } => {
                let mut index = pattern[index as usize] as u32;
                // Thousands may stand one behind the other.
                while let Expression::Swizzle { vector, pattern, .. } = self.f.expressions[base] {
                    index = pattern[index as usize] as u32;
                    base = vector;
                }
                Some(self.add(Expression::AccessIndex { base, index }))
            }
            Expression::Compose { ty, ref components } => {
                let whole = match self.cx.out.types[ty].inner {
                    TypeInner::Vector { size, .. } => components.len() == size as usize,
                    _ => true,
                };
                whole.then(|| components[index as usize])
            }
            Expression::Constant(_) => match self.floats(base)?[..] {
                [] | [_] => None,
                ref all => {
                    let number = all[index as usize];
                    Some(self.float(number))
                }
            },
            Expression::ZeroValue(ty) => match self.cx.out.types[ty].inner {
                TypeInner::Vector { scalar: naga::Scalar { kind: naga::ScalarKind::Float, .. }, .. } => {
                    Some(self.float(0.0))
                }
                _ => None,
            },
            Expression::Load { .. } => self.members.get(&(base, index)).copied(),
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
