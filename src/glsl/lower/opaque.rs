//! Values that the driver shall not see through: a zero that it cannot know, and what is joined with it.

use super::function::Builder;
use crate::glsl::{
    ast::List,
    hir::{ExprFlags, ExprId, Scalar, StmtId, StmtKind, Type, TypeId},
    ir::{Binary, Block, Op, Stmt, Value},
};

impl Builder<'_, '_> {
    /// The same bits, of a scalar or vector type `ty` of numbers, but joined with a zero that the driver cannot know.
    pub fn opaque(&mut self, ty: TypeId, value: Value) -> Value {
        let zero = self.opaque_zero();
        let ints = TypeId::vector(Scalar::Int, self.extent(ty) as u8);
        let zero = self.splat(zero, ints);
        let bits = self.bitcast(value, Scalar::Int);
        let bits = self.op(Binary::InclusiveOr, bits, zero);
        self.bitcast(bits, self.cx.hir.types.scalar(ty).unwrap_or(Scalar::Float))
    }

    fn opaque_zero(&mut self) -> Value {
        self.add(Op::OpaqueZero)
    }

    /// The value of an operand, hidden if it is one of [`limits`](super::limits).
    pub fn limit(&mut self, expr: ExprId, value: Value) -> Value {
        if self.cx.limits.contains(&expr) { self.opaque(self.cx.hir[expr].ty, value) } else { value }
    }

    /// Discards what never is, for a driver that asks for it.
    pub fn seem_to_discard(&mut self) {
        self.seem_to(Stmt::Discard);
    }

    /// Begins the body of a loop with an exit that is never taken, where the driver asks for it and the loop has no exit there
    /// that changes nothing before it: in `test` or as the first statement of `body`. With it each variable that the loop changes
    /// has two values at its exits, the one with which a round began and a new one, and needs a phi after the loop.
    pub fn close_loop(&mut self, test: Option<ExprId>, body: List<StmtId>) {
        let hir = self.cx.hir;
        let is_calm = |expr: ExprId| !hir[expr].flags.contains(ExprFlags::EFFECTS);
        let leaves = |list: List<StmtId>| match hir[list].first() {
            Some(&stmt) => matches!(hir[stmt].kind, StmtKind::Break),
            None => false,
        };
        let begins_with_exit = match (test, hir[body].first()) {
            (Some(test), _) => is_calm(test),
            (None, Some(&stmt)) => {
                matches!(hir[stmt].kind, StmtKind::If { cond, then, .. } if is_calm(cond) && leaves(then))
            }
            (None, None) => false,
        };
        if self.cx.source.driver.loop_closing_exits && !begins_with_exit {
            self.seem_to(Stmt::Break);
        }
    }

    /// A jump that never happens, though the driver cannot know it.
    fn seem_to(&mut self, jump: Stmt) {
        let number = self.opaque_zero();
        let zero = self.literal(Scalar::Int, 0);
        let condition = self.op(Binary::NotEqual, number, zero);
        let (accept, _) = self.nested(|b| b.push(jump));
        self.push(Stmt::If { condition, accept, reject: Block::new() });
    }

    /// Reads a value of type `ty` from a uniform block: so that the driver takes it for a value of the pixel, where
    /// [`opaque_uniforms`](crate::glsl::Driver::opaque_uniforms) asks for that. Then it is read once, before all else: an
    /// operation more in a loop or branch can be what keeps the driver from writing it out, or from making it a select.
    pub fn load_uniform(&mut self, pointer: Value, ty: TypeId) -> Value {
        if !self.cx.source.driver.opaque_uniforms {
            return self.load(pointer);
        }
        let Some(path) = self.constant_path(pointer) else { return self.load_opaque(pointer, ty) };
        if let Some(&value) = self.uniforms.get(&path) {
            return value;
        }
        let at_start = self.at_start(|b| {
            let pointer = path.1.iter().fold(path.0, |base, &index| b.add(Op::Part { base, index }));
            b.load_opaque(pointer, ty)
        });
        let Some(value) = at_start else { return self.load_opaque(pointer, ty) };
        self.uniforms.insert(path, value);
        value
    }

    /// The module-scope variable that constant members and indices lead from to what a pointer points to, and these.
    fn constant_path(&self, mut pointer: Value) -> Option<(Value, Vec<u32>)> {
        let mut path = Vec::new();
        while let Op::Part { base, index } = self.f[pointer] {
            path.push(index);
            pointer = base;
        }
        path.reverse();
        matches!(self.f[pointer], Op::Global(_)).then_some((pointer, path))
    }

    fn load_opaque(&mut self, pointer: Value, ty: TypeId) -> Value {
        let part = match self.cx.hir.types.get(ty) {
            Type::Array { element, .. } => element,
            Type::Matrix { rows, .. } => TypeId::vector(Scalar::Float, rows),
            _ => {
                let value = self.load(pointer);
                return self.opaque(ty, value);
            }
        };
        let parts = (0..self.extent(ty)).map(|index| {
            let pointer = self.add(Op::Part { base: pointer, index });
            self.load_opaque(pointer, part)
        });
        let parts = parts.collect();
        self.compose(ty, parts)
    }
}
