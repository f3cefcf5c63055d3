//! Probes: a value of the program is drawn instead of the picture of Image, or next to that of a buffer.

use super::{
    context::{Lowering, Probed},
    function::Builder,
};
use crate::{
    hir::{ExprId, Scalar, Type, TypeId},
    ir::{Binary, Block, Op, Stmt, Value},
};

impl Lowering<'_> {
    pub(super) fn is_probed(&self, expr: ExprId) -> bool {
        self.probed.as_ref().is_some_and(|probed| probed.expr == expr)
    }
}

impl Builder<'_, '_> {
    /// Stores the value of an expression if it is the probed one.
    pub(super) fn probe(&mut self, expr: ExprId, value: Value) {
        if !self.cx.is_probed(expr) {
            return;
        }
        let Some(Probed { visit, value: kept, components, visits, .. }) = self.cx.probed else { return };
        let ty = self.f.ty(value);
        let (kept, visits) = (self.global(kept), self.global(visits));
        let before = self.load(visits);
        let wanted = self.literal(Scalar::Int, visit);
        let is_it = self.op(Binary::Equal, before, wanted);
        let (accept, _) = self.nested(|b| {
            let mut scalars = Vec::new();
            b.scalars(value, ty, &mut scalars);
            // An array or a structure may have fewer scalars.
            while scalars.len() < usize::from(components) {
                scalars.push(b.float(if scalars.len() == 3 { 1.0 } else { 0.0 }));
            }
            scalars.truncate(components.into());
            let first = match scalars[..] {
                [single] => single,
                _ => b.compose(TypeId::vector(Scalar::Float, components), scalars),
            };
            b.store(kept, first);
        });
        self.push(Stmt::If { condition: is_it, accept, reject: Block::new() });
        let one = self.literal(Scalar::Int, 1);
        let after = self.op(Binary::Add, before, one);
        self.store(visits, after);
    }

    /// Adds every scalar of a value as a float.
    fn scalars(&mut self, value: Value, ty: TypeId, out: &mut Vec<Value>) {
        match self.cx.hir.types.get(ty) {
            Type::Scalar(Scalar::Float) => out.push(value),
            Type::Scalar(_) => out.push(self.add(Op::Convert { value, to: Scalar::Float })),
            _ => {
                for index in 0..self.cx.out.extent(ty) {
                    let part = self.add(Op::Part { base: value, index });
                    let ty = self.cx.out.part(ty, index);
                    self.scalars(part, ty, out);
                }
            }
        }
    }

    /// Loads the value that the pass draws: the probed one, with a scalar repeated three times; missing components are
    /// 0, and the last is 1. Four NaN if the probed visit did not happen.
    pub(super) fn probed_value(&mut self) -> Option<Value> {
        let Probed { visit, value, components, visits, .. } = self.cx.probed?;
        let (value, visits) = (self.global(value), self.global(visits));
        let (value, visits) = (self.load(value), self.load(visits));
        let wanted = self.literal(Scalar::Int, visit);
        let was_there = self.op(Binary::Greater, visits, wanted);
        let nan = self.literal(Scalar::Float, f32::NAN.to_bits());
        let parts = (0..4u32).map(|index| {
            let seen = match components {
                1 if index < 3 => value,
                count if index < u32::from(count) => self.add(Op::Part { base: value, index }),
                _ => self.float(if index == 3 { 1.0 } else { 0.0 }),
            };
            self.select(was_there, seen, nan)
        });
        let parts = parts.collect();
        Some(self.compose(TypeId::VEC4, parts))
    }
}
