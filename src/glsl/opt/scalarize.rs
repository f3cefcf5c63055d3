//! Expands vector arithmetic to components.
//!
//! A driver that fuses operations before it splits vectors combines different terms of sums and products than one that
//! fuses afterwards. OpenGL drivers split first, Vulkan ones later, so last bits differ; here vectors are split in
//! advance. Devices that compute by component have the same amount of work either way.

use crate::ir::rewrite::{self, Rewriter, Rule};
use crate::{
    ir::{Binary, Math, Module, Op, Unary, Value},
    types::{Scalar, Type, TypeId},
};

pub(super) fn run(module: &mut Module) {
    rewrite::each_function(module, || Scalarize);
}

struct Scalarize;

impl Rule for Scalarize {
    fn operation(&mut self, r: &mut Rewriter<'_>, value: Value, op: &Op) -> Option<Value> {
        if let Op::Part { base, index } = *op {
            return known_part(r, base, index);
        }
        let ty = r.f.ty(value);
        let Type::Vector { scalar: Scalar::Float, size } = r.module.types.get(ty) else { return None };
        let by_component = match *op {
            Op::Unary { op, .. } => op == Unary::Negate,
            Op::Binary { op, .. } => {
                matches!(op, Binary::Add | Binary::Subtract | Binary::Multiply | Binary::Divide)
            }
            Op::Math { fun, .. } => fun.is_componentwise() && !is_hyperbolic(fun),
            _ => false,
        };
        if !by_component {
            return None;
        }
        let parts = (0..u32::from(size)).map(|index| {
            let mut part = op.clone();
            part.operands_mut(|operand| *operand = component(r, *operand, index));
            r.add_typed(part, TypeId::FLOAT)
        });
        let parts = parts.collect();
        Some(r.add_typed(Op::Compose { ty, parts }, ty))
    }
}

/// Returns a component of an operand; a scalar is used for each.
fn component(r: &mut Rewriter<'_>, operand: Value, index: u32) -> Value {
    match r.module.types.get(r.f.ty(operand)) {
        Type::Vector { .. } => match known_part(r, operand, index) {
            Some(part) => part,
            None => r.add_typed(Op::Part { base: operand, index }, TypeId::FLOAT),
        },
        _ => operand,
    }
}

/// Returns a part of a value that was composed of that many parts.
fn known_part(r: &Rewriter<'_>, value: Value, index: u32) -> Option<Value> {
    match r.f[value] {
        Op::Compose { ty, ref parts } if parts.len() == r.module.extent(ty) as usize => Some(parts[index as usize]),
        Op::Splat { value, .. } => Some(value),
        _ => None,
    }
}

/// Returns whether drivers expand a function themselves (`spirv_to_nir` in Mesa), so that it is not split.
fn is_hyperbolic(fun: Math) -> bool {
    use Math::*;
    matches!(fun, Sinh | Cosh | Tanh | Asinh | Acosh | Atanh)
}
