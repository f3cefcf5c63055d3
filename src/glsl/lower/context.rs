//! Options and state of lowering one module.

use super::{
    arguments::{Arguments, Instance},
    names::{Marks, Names},
};
use crate::{
    PassSource, Reflection,
    hir::{self, BuiltinVar},
    ir::{self, GlobalKind, layout::Layouts},
    stages::Interface,
};
use rustc_hash::FxHashMap;

/// State of lowering one module. The state of one function is in [`super::function::Builder`].
pub(super) struct Lowering<'a> {
    pub hir: &'a hir::Module,
    pub source: &'a PassSource<'a>,
    pub options: Options,
    /// The locations of the inputs and outputs of a stage.
    pub interface: Interface,
    pub out: ir::Module,
    pub layouts: Layouts,
    pub resources: Variables,
    pub arguments: Arguments,
    pub functions: FxHashMap<Instance, ir::FuncId>,
    pub reflection: Reflection,
    pub names: Names,
    /// The probed value.
    pub probed: Option<Probed>,
    pub marks: Marks,
}

impl Lowering<'_> {
    /// Returns whether values of a type are passed by reference although a copy would be possible.
    pub(super) fn is_long(&mut self, ty: hir::TypeId) -> bool {
        let min_scalars = self.options.by_reference;
        min_scalars.is_some_and(|scalars| self.layouts.is_aggregate_of(&self.out, ty, scalars))
    }
}

/// The variables declared so far.
pub(super) struct Variables {
    pub read_only: FxHashMap<GlobalKind, ir::GlobalId>,
    /// By [`hir::GlobalId::index`].
    pub globals: Vec<Option<ir::GlobalId>>,
    /// `gl_FragCoord`, if something other than the entry point reads it.
    pub frag_coord: Option<ir::GlobalId>,
    pub frag_depth: Option<ir::GlobalId>,
    /// The built-in variables of stages, except those two.
    pub stage: FxHashMap<BuiltinVar, ir::GlobalId>,
    /// Bit i: an `st_assert(.., i)` failed.
    pub failed_asserts: Option<ir::GlobalId>,
}

impl Variables {
    pub(super) fn new(globals: usize) -> Self {
        Self {
            read_only: FxHashMap::default(),
            globals: vec![None; globals],
            frag_coord: None,
            frag_depth: None,
            stage: FxHashMap::default(),
            failed_asserts: None,
        }
    }
}

/// Returns the program's constant for a folded value.
pub(super) fn const_id(id: hir::ConstId) -> ir::ConstId {
    ir::ConstId::new(id.index())
}

/// The probed expression, and the variable that stores its value.
#[derive(Clone, Copy)]
pub(super) struct Probed {
    pub expr: hir::ExprId,
    pub visit: u32,
    /// The first components of the value, at most four, as floats; unknown until the probed visit. There are no more
    /// than the value has: a loop that carries more values may be compiled differently, which changes the last bits of
    /// its other values.
    pub value: ir::GlobalId,
    pub components: u8,
    /// The number of times that the expression has been evaluated: an `int`.
    pub visits: ir::GlobalId,
}

impl Probed {
    pub(super) fn new(out: &mut ir::Module, (expr, ty): (hir::ExprId, hir::TypeId), visit: u32) -> Self {
        let components = out.types.components(ty).map_or(4, |count| count.min(4) as u8);
        let kept = hir::TypeId::vector(hir::Scalar::Float, components);
        let value = out.add_global(kept, GlobalKind::Private(None));
        let visits = out.add_global(hir::TypeId::INT, GlobalKind::Private(None));
        Self { expr, visit, value, components, visits }
    }
}

/// The layout of a program, chosen for later stages. None of it changes what the program computes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Options {
    /// The number of scalars from which on an array or structure is passed by reference; `None` to pass by value
    /// wherever possible.
    pub by_reference: Option<u32>,
    /// The number of scalars from which on a constant replaces the parameter although only one call passes it.
    pub table: usize,
}
