//! Lowering: translates the checked program of [`super::hir`] to the intermediate representation ([`super::ir`]), with
//! the [`Reflection`] of what is reachable.
//!
//! Implements the semantics of running code: evaluation order, copies of `out` and `inout` arguments, the zero that
//! WebGL uses for everything undefined, clamped indices. It runs only on error-free programs, and reports no errors.
//!
//! The generated code, and the reasons for its form:
//! - Only code reachable from the entry point is lowered ([`reachable`]). A branch that a literal condition excludes is
//!   unreachable.
//! - A variable that is never written is a value, not memory. All others are variables of the function or of the
//!   module.
//! - A function has one copy for each combination of channels, globals and tables that replace parameters it only reads
//!   ([`arguments`]).
//! - A large global array that the program fills with constants before anything else is a constant
//!   ([`constant_arrays`]).
//! - Every non-literal index is clamped, as in WebGL; the modules need no bounds checks from naga. Non-literal integer
//!   divisors are guarded ([`divide`]), as no driver's compiler may encounter a zero. The optimiser removes redundant
//!   clamps and guards. Fetches outside a texture are left to the driver's image robustness, which returns the zeros
//!   that WebGL guarantees.
//! - `&&`, `||` and `?:` are branches.

mod access;
mod arguments;
mod builtin;
mod calls;
mod constant_arrays;
mod context;
mod convert;
mod divide;
mod entry;
mod expr;
mod flow;
mod function;
mod geometry;
mod integer;
mod matrix;
mod names;
mod operators;
mod probe;
mod reachable;
mod resources;
mod stage;
mod texture;
mod walk;

use rustc_hash::FxHashMap;

pub use self::names::{Precondition, StatementEvent, UnsetKind};
pub(crate) use self::{
    constant_arrays::arrays_to_constants,
    names::{FunctionNames, Marks, Names, Unset},
    reachable::reached,
};
use self::{
    context::{Lowering, Probed, Variables},
    reachable::Reachable,
};
use super::{
    PassSource, Reflection, hir,
    ir::{self, layout::Layouts},
    plain::{self, Resources},
    stages::Interface,
};
pub(crate) use crate::lower::context::Options;

/// The result of lowering.
pub(crate) struct Lowered {
    pub program: ir::Module,
    pub reflection: Reflection,
    pub(crate) names: Names,
}

/// Lowers an error-free program. The result satisfies the rules of [`ir::verify`]; a violation is a bug of this module.
/// With a probe the pass also draws the value of an expression at the requested visit. `marks` are for programs that
/// the CPU interpreter runs.
///
/// # Panics
/// If `module` violates the guarantees of [`hir`], for example if it has no entry point.
pub(crate) fn lower(
    module: &hir::Module,
    source: &PassSource<'_>,
    options: Options,
    interface: Interface,
    probe: Option<(hir::ExprId, u32)>,
    marks: Marks,
) -> Lowered {
    let (reachable, arguments) = Reachable::new(module, options.table);
    let mut out = module_without_functions(module);
    let Resources { textures, blocks, struct_names, .. } = &interface.resources;
    (out.textures, out.blocks, out.struct_names) = (textures.clone(), blocks.clone(), struct_names.clone());
    let probed = probe.map(|(expr, visit)| Probed::new(&mut out, (expr, module[expr].ty), visit));
    let mut cx = Lowering {
        hir: module,
        source,
        options,
        interface,
        out,
        layouts: Layouts::default(),
        resources: Variables::new(module.globals.len()),
        arguments,
        functions: FxHashMap::with_capacity_and_hasher(reachable.instances.len(), Default::default()),
        reflection: Reflection::default(),
        names: Names::default(),
        marks,
        probed,
    };
    if source.kind.is_plain() {
        cx.reflection.shader.textures = cx.out.textures.iter().map(plain::texture).collect();
    }
    for instance in &reachable.instances {
        let (function, names) = function::lower(&mut cx, instance);
        cx.names.functions.push(names);
        cx.out.functions.push(function);
        let id = ir::FuncId::new(cx.out.functions.len() - 1);
        cx.functions.insert(instance.clone(), id);
    }
    let entry =
        if source.kind.is_stage() { stage::lower(&mut cx, &reachable) } else { entry::lower(&mut cx, &reachable) };
    cx.out.functions.push(entry);
    cx.names.functions.push(FunctionNames::default());
    (cx.names.globals, cx.names.members) = (cx.named_globals(), cx.member_names());
    Lowered { program: cx.out, reflection: cx.reflection, names: cx.names }
}

/// Returns a program without functions: types and constants.
fn module_without_functions(module: &hir::Module) -> ir::Module {
    let members = |structure: &hir::Struct| module[structure.members].iter().map(|member| member.ty).collect();
    let constant = |constant: &hir::Const| ir::Const { ty: constant.ty, words: module[constant.words].to_vec() };
    ir::Module {
        types: module.types.clone(),
        structs: module.structs.iter().map(members).collect(),
        consts: module.consts.iter().map(constant).collect(),
        ..ir::Module::default()
    }
}
