//! Sums and products in the order in which OpenGL's compilers evaluate them.
//!
//! GLSL leaves the order open, and every driver regroups; which last bits come out depends on who does it first. Real shaders
//! blow up last bits (`fract(sin(x) * 43758.5453)`), so the constants of a chain are joined here, as the GLSL compilers people
//! write their shaders on join them, before a SPIR-V driver joins them in another order.

use super::{function::Builder, operators::Typed};
use crate::glsl::hir::{Scalar, Type, TypeId};
use crate::glsl::ir::{Binary, Math, Op, Value};

/// One component of a value, as far as it can be told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Part {
    Known(f32),
    /// Component `.1` of a vector, or a scalar.
    Of(Value, u32),
}

impl Builder<'_, '_> {
    /// `left op right`, a sum or product of type `ty`, where one side is constant and the other has a constant deeper in its
    /// own chain of `op`: `(a * 2.0) * 3.0` becomes `a * 6.0`. `None` where there is nothing to join.
    pub fn with_constants_joined(&mut self, op: Binary, ty: TypeId, left: Typed, right: Typed) -> Option<Value> {
        if self.cx.hir.types.scalar(ty) != Some(Scalar::Float) || !self.is_vector_or_scalar(ty) {
            return None;
        }
        let ((chain_ty, chain), constant) = match (self.floats(left.1), self.floats(right.1)) {
            (None, Some(constant)) => (left, constant),
            (Some(constant), None) => (right, constant),
            _ => return None,
        };
        // Unlike its products, naga's sums have sides of one type, and what is a scalar within a chain is not known there.
        if op == Binary::Add && chain_ty != ty {
            return None;
        }
        let (joined, freed) = self.join(op, ty, chain, &constant, 0)?;
        // What is freed comes where the constant was: it is the first operand that drivers move further constants to.
        let (left, right) = if chain == left.1 { (joined, freed) } else { (freed, joined) };
        Some(self.sum_or_product(op, ty, left, right))
    }

    /// Puts a constant beside the first one of a chain, in the place of that one's neighbour: the chain and the neighbour.
    fn join(&mut self, op: Binary, ty: TypeId, chain: Value, constant: &[f32], depth: u32) -> Option<(Value, Value)> {
        /// Chains are short; without a limit a long one would be searched for each of its links.
        const DEEP: u32 = 8;
        let Op::Binary { op: inner, left, right } = self.f[chain] else { return None };
        if inner != op || depth > DEEP || self.is_apart(chain) || (depth > 0 && self.is_named(chain)) {
            return None;
        }
        let (known, neighbour) = match (self.floats(left), self.floats(right)) {
            (Some(known), None) => (known, right),
            (None, Some(known)) => (known, left),
            (Some(_), Some(_)) => return None,
            // What is used elsewhere is not taken apart.
            (None, None) if self.shared.contains(&chain) => return None,
            (None, None) => {
                if let Some((part, freed)) = self.join(op, ty, left, constant, depth + 1) {
                    return Some((self.sum_or_product(op, ty, part, right), freed));
                }
                let (part, freed) = self.join(op, ty, right, constant, depth + 1)?;
                return Some((self.sum_or_product(op, ty, left, part), freed));
            }
        };
        let size = known.len().max(constant.len());
        let at = |side: &[f32], i: usize| side[i.min(side.len() - 1)];
        let joined: Vec<f32> = (0..size)
            .map(|i| match op {
                Binary::Multiply => at(&known, i) * at(constant, i),
                _ => at(&known, i) + at(constant, i),
            })
            .collect();
        // What overflows only in this order must not.
        if joined.iter().any(|number| !number.is_finite()) {
            return None;
        }
        let parts: Vec<Value> = joined.into_iter().map(|number| self.float(number)).collect();
        let joined = match parts[..] {
            [scalar] => scalar,
            _ => self.compose(TypeId::vector(Scalar::Float, size as u8), parts),
        };
        Some((joined, neighbour))
    }

    /// `k (b + c)` for `b k + c k` with one literal `k`. Mesa does that wherever a factor is the same, but finds two equal
    /// literals of SPIR-V to be so only after it has put them elsewhere.
    pub fn with_constant_factored(&mut self, left: Value, right: Value) -> Option<Value> {
        let (left, right) = (self.factors(left)?, self.factors(right)?);
        for (b, k) in [(left[0], left[1]), (left[1], left[0])] {
            if self.number(k).is_none() {
                continue;
            }
            let c = if right[1] == k {
                right[0]
            } else if right[0] == k {
                right[1]
            } else {
                continue;
            };
            let sum = self.op(Binary::Add, b, c);
            return Some(self.op(Binary::Multiply, sum, k));
        }
        None
    }

    fn factors(&self, value: Value) -> Option<[Value; 2]> {
        match self.f[value] {
            Op::Binary { op: Binary::Multiply, left, right } => Some([left, right]),
            _ => None,
        }
    }

    /// Of floats; a literal counts for every component of `ty`.
    fn sum_or_product(&mut self, op: Binary, ty: TypeId, left: Value, right: Value) -> Value {
        if op == Binary::Multiply || ty == TypeId::FLOAT {
            return self.op(op, left, right);
        }
        let [left, right] = [left, right].map(|side| match self.f[side] {
            Op::Literal(..) => self.splat(side, ty),
            _ => side,
        });
        self.op(op, left, right)
    }

    /// The components of a float constant; one for a scalar or a repeated one.
    pub fn floats(&self, value: Value) -> Option<Vec<f32>> {
        match &self.f[value] {
            Op::Literal(..) => Some(vec![self.number(value)?]),
            Op::Splat { value, .. } => self.floats(*value),
            Op::Compose { parts, .. } => parts.iter().map(|&part| self.number(part)).collect(),
            Op::Const(id) => {
                let constant = &self.cx.out[*id];
                let is_vector =
                    matches!(self.cx.out.types.get(constant.ty), Type::Vector { scalar: Scalar::Float, .. });
                let numbers = || constant.words.iter().map(|&bits| f32::from_bits(bits));
                (is_vector && numbers().all(f32::is_finite)).then(|| numbers().collect())
            }
            Op::Part { base, index } => match self.f[*base] {
                Op::Const(_) => Some(vec![*self.floats(*base)?.get(*index as usize)?]),
                _ => None,
            },
            _ => None,
        }
    }

    pub fn part(&self, value: Value, index: u32) -> Part {
        if let Some(floats) = self.floats(value) {
            return Part::Known(floats[(index as usize).min(floats.len() - 1)]);
        }
        match self.f[value] {
            Op::Splat { value, .. } => Part::Of(value, 0),
            _ => Part::Of(value, index),
        }
    }

    /// Section 8.3: `t = clamp((x - a) / (b - a), 0, 1)`, then `t t (3 - 2 t)`.
    ///
    /// Undefined for `a == b`, but shaders use it as a step: infinities clamp to 0 and 1. So no driver must see that the divisor
    /// is zero ([`super::zeros`]).
    pub fn smoothstep(&mut self, ty: TypeId, a: Value, b: Value, x: Value) -> Value {
        let differ = |index| match (self.part(a, index), self.part(b, index)) {
            (Part::Known(a), Part::Known(b)) => a != b,
            _ => false,
        };
        if (0..self.extent(ty)).all(differ) {
            return self.math3(Math::SmoothStep, a, b, x);
        }
        let width = self.op(Binary::Subtract, b, a);
        let width = self.hidden(ty, width);
        let distance = self.op(Binary::Subtract, x, a);
        let quotient = self.op(Binary::Divide, distance, width);
        let t = self.math(Math::Saturate, quotient);
        let (two, three) = (self.float_of(ty, 2.0), self.float_of(ty, 3.0));
        let twice = self.op(Binary::Multiply, two, t);
        let slope = self.op(Binary::Subtract, three, twice);
        let product = self.op(Binary::Multiply, t, slope);
        self.op(Binary::Multiply, t, product)
    }
}
