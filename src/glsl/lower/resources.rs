//! Module-scope variables: uniforms, the author's globals, tables, and values that the entry point passes to functions.
//!
//! Each is declared when it is first reached.

use super::context::{Lowering, const_id};
use crate::{
    ast::{Loc, Symbol},
    hir::{self, BuiltinVar, GlobalId, Scalar, TypeId, Uniform},
    ir::{self, GlobalKind},
};

impl Lowering<'_> {
    /// Returns memory of one invocation, zero at its start.
    fn private(&mut self, ty: TypeId) -> ir::GlobalId {
        self.out.add_global(ty, GlobalKind::Private(None))
    }

    fn read_only(&mut self, ty: TypeId, kind: GlobalKind) -> ir::GlobalId {
        if let Some(&made) = self.resources.read_only.get(&kind) {
            return made;
        }
        let made = self.out.add_global(ty, kind);
        self.resources.read_only.insert(kind, made);
        made
    }

    pub(super) fn uniform(&mut self, uniform: Uniform) -> ir::GlobalId {
        // The checker has interned its array types.
        let ty = uniform.ty(&mut self.out.types);
        self.read_only(ty, GlobalKind::Uniform(uniform))
    }

    /// Returns the words of a custom uniform.
    pub(super) fn custom_uniform(&mut self, slot: u16) -> ir::GlobalId {
        self.read_only(TypeId::vector(Scalar::Uint, 4), GlobalKind::CustomUniform(slot))
    }

    /// Returns a uniform that a plain shader declares.
    pub(super) fn plain_uniform(&mut self, id: GlobalId) -> ir::GlobalId {
        let (block, index) = self.interface.resources.members[&id];
        self.read_only(self.hir[id].ty, GlobalKind::Member { block, index })
    }

    pub(super) fn cube_face(&mut self) -> ir::GlobalId {
        self.read_only(TypeId::INT, GlobalKind::CubeFace)
    }

    pub(super) fn tile_origin(&mut self) -> ir::GlobalId {
        self.read_only(TypeId::vector(Scalar::Int, 2), GlobalKind::TileOrigin)
    }

    /// Returns a constant that is indexed.
    pub(super) fn table(&mut self, id: ir::ConstId) -> ir::GlobalId {
        let ty = self.out[id].ty;
        self.read_only(ty, GlobalKind::Table(id))
    }

    /// Returns the memory of a built-in variable of a stage.
    pub(super) fn stage_variable(&mut self, variable: BuiltinVar) -> ir::GlobalId {
        if let Some(&made) = self.resources.stage.get(&variable) {
            return made;
        }
        let made = self.private(variable.ty());
        self.resources.stage.insert(variable, made);
        made
    }

    /// Returns the memory of one of the author's globals (storage `Private` or `Out`, in a stage also `In`), set to its
    /// constant value if it has one. The entry point computes non-constant values.
    pub(super) fn global(&mut self, id: GlobalId) -> ir::GlobalId {
        if let Some(made) = self.resources.globals[id.index()] {
            return made;
        }
        let global = self.hir[id];
        let init = global.value.map(const_id);
        let made = self.out.add_global(global.ty, GlobalKind::Private(init));
        self.resources.globals[id.index()] = Some(made);
        made
    }

    pub(super) fn frag_coord(&mut self) -> ir::GlobalId {
        if self.resources.frag_coord.is_none() {
            self.resources.frag_coord = Some(self.private(TypeId::VEC4));
        }
        self.resources.frag_coord.expect("just set")
    }

    pub(super) fn frag_depth(&mut self) -> ir::GlobalId {
        if self.resources.frag_depth.is_none() {
            self.resources.frag_depth = Some(self.private(TypeId::FLOAT));
        }
        self.resources.frag_depth.expect("just set")
    }

    pub(super) fn failed_asserts(&mut self) -> ir::GlobalId {
        if self.resources.failed_asserts.is_none() {
            self.resources.failed_asserts = Some(self.private(TypeId::UINT));
        }
        self.resources.failed_asserts.expect("just set")
    }

    /// Returns the names of the members of each structure.
    pub(super) fn member_names(&self) -> Vec<Vec<Symbol>> {
        let names = |structure: &hir::Struct| self.hir[structure.members].iter().map(|m| m.name.symbol).collect();
        self.hir.structs.iter().map(names).collect()
    }

    /// Returns the author's globals that are reachable.
    pub(super) fn named_globals(&self) -> Vec<(Symbol, ir::GlobalId, Loc)> {
        let made = self.hir.globals.iter().zip(&self.resources.globals);
        made.filter_map(|(global, made)| Some((global.name.symbol, (*made)?, global.name.loc()))).collect()
    }
}
