//! Local variables: their forms in the generated code, and the known origins of values.

use super::{Builder, Slot};
use crate::{
    hir::{FuncId, LocalId, Type, TypeId, VarFlags},
    ir::{Op, Value},
    lower::names::{FunctionNames, Unset, UnsetKind},
};

impl Builder<'_, '_> {
    pub(crate) fn slot(&self, local: LocalId) -> Slot {
        self.slots[local.index() - self.first_local]
    }

    pub(crate) fn set_slot(&mut self, local: LocalId, slot: Slot) {
        self.slots[local.index() - self.first_local] = slot;
    }

    /// Makes a local memory, whether or not it is written.
    pub(crate) fn force_memory(&mut self, local: LocalId) {
        self.forced[local.index() - self.first_local] = true;
    }

    /// Returns whether a local is memory, whether or not it is written.
    pub(crate) fn is_forced(&self, local: LocalId) -> bool {
        self.forced[local.index() - self.first_local]
    }

    /// Initialises a local.
    pub(crate) fn declare(&mut self, local: LocalId, value: Value) {
        if self.needs_memory(local) {
            let pointer = self.address_of(local);
            self.store(pointer, value);
        } else {
            self.set_slot(local, Slot::Value(value));
        }
    }

    /// Returns whether a local is written, or indexed in a way that values cannot be.
    pub(crate) fn needs_memory(&self, local: LocalId) -> bool {
        let declared = self.cx.hir[local];
        declared.flags.contains(VarFlags::WRITTEN)
            || self.is_forced(local)
            || (self.cx.arguments.is_indexed(self.cx.hir, local) && !self.is_vector_or_scalar(declared.ty))
    }

    /// Returns the pointer to a local that is memory.
    pub(crate) fn address_of(&mut self, local: LocalId) -> Value {
        if let Slot::Memory(pointer) = self.slot(local) {
            return pointer;
        }
        let ty = self.cx.hir[local].ty;
        let pointer = self.temporary(ty);
        if self.is_forced(local) {
            let zero = self.zero(ty);
            self.set_initializer(pointer, zero);
            if let (true, Some(name)) = (self.cx.marks.undefined, self.cx.hir[local].name) {
                let unset = Unset { value: pointer, kind: UnsetKind::Variable, name: name.symbol, loc: name.loc() };
                self.undefined.push(unset);
            }
        }
        self.set_slot(local, Slot::Memory(pointer));
        pointer
    }

    /// Initialises a variable of the function with a constant.
    pub(crate) fn set_initializer(&mut self, variable: Value, value: Value) {
        if let Op::Var(id) = self.f[variable] {
            self.f.vars[id.index()].init = Some(value);
        }
    }

    /// Adds a variable to this function.
    pub(crate) fn temporary(&mut self, ty: TypeId) -> Value {
        let variable = self.f.add_var(ty);
        self.add_before(Op::Var(variable))
    }

    pub(crate) fn is_vector_or_scalar(&self, ty: TypeId) -> bool {
        matches!(self.cx.hir.types.get(ty), Type::Scalar(_) | Type::Vector { .. })
    }

    /// Returns the author's names in a completed function, each with its value or place.
    pub(in crate::lower) fn names(&self, func: FuncId) -> FunctionNames {
        let function = &self.cx.hir[func];
        let local = |index: u32| {
            let id = LocalId::new(index as usize);
            let name = self.cx.hir[id].name?;
            match self.slot(id) {
                Slot::Value(value) | Slot::Memory(value) => Some(((name.symbol, value), id)),
                Slot::Unset | Slot::Table(_) | Slot::Channel(_) => None,
            }
        };
        let (locals, ids) = function.locals.clone().filter_map(local).unzip();
        let (marks, undefined) = (self.marks.clone(), self.undefined.clone());
        FunctionNames { name: Some(function.name.symbol), locals, ids, marks, undefined }
    }
}
