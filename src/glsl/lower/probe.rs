//! A probe: a value of the program is drawn instead of the picture.

use super::{
    context::{Lowering, Probed},
    function::Builder,
};
use crate::glsl::{
    hir::{ExprId, Scalar, Type, TypeId},
    ir::{Binary, Block, Op, Stmt, Value},
};

impl Lowering<'_> {
    pub fn is_probed(&self, expr: ExprId) -> bool {
        self.probed.as_ref().is_some_and(|probed| probed.expr == expr)
    }
}

impl Builder<'_, '_> {
    /// Keeps the value of an expression if it is the one that is probed.
    pub fn probe(&mut self, expr: ExprId, value: Value) {
        if !self.cx.is_probed(expr) {
            return;
        }
        let Some(Probed { visit, value: kept, visits, .. }) = self.cx.probed else { return };
        let ty = self.f.ty(value);
        let (kept, visits) = (self.global(kept), self.global(visits));
        let before = self.load(visits);
        let wanted = self.literal(Scalar::Int, visit);
        let is_it = self.op(Binary::Equal, before, wanted);
        let (accept, _) = self.nested(|b| {
            let shown = b.as_vec4(value, ty);
            b.store(kept, shown);
        });
        self.push(Stmt::If { condition: is_it, accept, reject: Block::new() });
        let one = self.literal(Scalar::Int, 1);
        let after = self.op(Binary::Add, before, one);
        self.store(visits, after);
    }

    /// Returns the first four components of a value: a scalar three times, and what is missing 0, the last 1.
    fn as_vec4(&mut self, value: Value, ty: TypeId) -> Value {
        let mut scalars = Vec::new();
        self.scalars(value, ty, &mut scalars);
        let mut parts: Vec<Value> = scalars.into_iter().take(4).collect();
        if let [single] = parts[..] {
            parts.extend([single; 2]);
        }
        for index in parts.len()..4 {
            parts.push(self.float(if index == 3 { 1.0 } else { 0.0 }));
        }
        self.compose(TypeId::VEC4, parts)
    }

    /// Every scalar of a value as a float.
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

    /// Loads the value that the pass draws instead of its picture: the probed one, or four NaN where the probe never
    /// was.
    pub fn probed_value(&mut self) -> Option<Value> {
        let Probed { visit, value, visits, .. } = self.cx.probed?;
        let (value, visits) = (self.global(value), self.global(visits));
        let (value, visits) = (self.load(value), self.load(visits));
        let wanted = self.literal(Scalar::Int, visit);
        let was_there = self.op(Binary::Greater, visits, wanted);
        let nan = self.literal(Scalar::Float, f32::NAN.to_bits());
        let parts = (0..4).map(|index| {
            let seen = self.add(Op::Part { base: value, index });
            self.select(was_there, seen, nan)
        });
        let parts = parts.collect();
        Some(self.compose(TypeId::VEC4, parts))
    }
}
