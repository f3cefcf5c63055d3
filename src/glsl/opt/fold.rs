//! Constant folding, and parts of what is put together.

use crate::glsl::ir::rewrite::{self, Rewriter, Rule};
use crate::glsl::{
    ir::{Binary, Math, Module, Op, Unary, Value},
    types::{Scalar, Type},
};

pub(super) fn run(module: &mut Module) {
    rewrite::each_function(module, |_, _| Fold);
}

struct Fold;

impl Rule for Fold {
    fn operation(&mut self, r: &mut Rewriter<'_>, _: Value, op: &Op) -> Option<Value> {
        if let Op::Part { base, index } = *op {
            return part(r, base, index);
        }
        number(r, op).map(|number| r.float(number))
    }
}

/// A part of a value that is known, if no instruction is needed to take it out.
fn part(r: &mut Rewriter<'_>, mut base: Value, mut index: u32) -> Option<Value> {
    let is_direct = !matches!(r.f[base], Op::Swizzle { .. });
    // Thousands may stand one behind the other.
    while let Op::Swizzle { vector, swizzle } = r.f[base] {
        index = swizzle.get(index as usize) as u32;
        base = vector;
    }
    let known = match r.f[base] {
        Op::Splat { value, .. } => Some(value),
        Op::Compose { ty, ref parts } => (parts.len() == r.module.extent(ty) as usize).then(|| parts[index as usize]),
        Op::Const(id) => {
            let constant = &r.module[id];
            let bits = constant.words.get(index as usize).copied();
            match r.module.types.get(constant.ty) {
                Type::Vector { scalar: Scalar::Float, .. } => {
                    let bits = bits.filter(|&bits| f32::from_bits(bits).is_finite());
                    bits.map(|bits| r.literal(Scalar::Float, bits))
                }
                _ => None,
            }
        }
        Op::Zero(ty) => match r.module.types.get(ty) {
            Type::Vector { scalar: Scalar::Float, .. } => Some(r.float(0.0)),
            _ => None,
        },
        _ => None,
    };
    known.or_else(|| (!is_direct).then(|| r.add(Op::Part { base, index })))
}

/// The result of an operation on literals. None that is not finite: it is left to the device. In single precision, as OpenGL's
/// compilers do it.
fn number(r: &Rewriter<'_>, op: &Op) -> Option<f32> {
    let number = |value| r.number(value);
    let folded = match *op {
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
        Op::Math { fun: Math::Pow, arg, arg1: Some(power), .. } => number(arg)?.powf(number(power)?),
        Op::Math { fun: Math::Atan2, arg, arg1: Some(x), .. } => number(arg)?.atan2(number(x)?),
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
