//! Lowering: the checked program of [`super::hir`] to a validated-by-construction [`naga::Module`], and the [`Reflection`] of
//! what it reaches.
//!
//! Owns the meaning of running code: evaluation order, copies of `out` and `inout` arguments, the zero that WebGL gives to
//! everything undefined, clamped indices. Judges nothing: it runs only on programs without errors, and reports none.
//!
//! What the generated code looks like, and why:
//! - Only what the entry point reaches is lowered ([`reach`]). A branch whose condition is a literal is not reached.
//! - A variable nobody writes is a value, not memory. All others are `LocalVariable`s or private globals; what they hold is known
//!   until they are written, into branches, and into loops that do not write them ([`memory`]). At last what is no array becomes scalars
//!   ([`split`]), and arrays that each call fills become global ([`filled`]).
//! - Small functions, and those called at one place, become part of their callers ([`inline`]). Others have one copy for each
//!   combination of channels, globals and tables that stand for parameters they only read ([`calls`]).
//! - A constant table that is indexed at run time lives in a buffer ([`tables`]); a small one once in a private global
//!   with an initialiser: naga's SPIR-V writer would otherwise copy the whole table to the stack at each access.
//! - So does a large global array that the program fills with constants before all else ([`settled`]).
//! - Where the driver needs it, long arrays are filled and copied by loops ([`long_arrays`]).
//! - Every index that is not provably in range is clamped here ([`ranges`] tells what is known), as WebGL does; the modules
//!   need no bounds checks from naga. Divisors of integers that may be zero are guarded ([`divide`]), as no driver's compiler
//!   may meet one. Fetches outside a texture are left to the driver's image robustness, which gives the zeros WebGL promises.
//! - `&&`, `||` and `?:` become selects where both sides are cheap and have no effects, branches elsewhere.

mod access;
mod balance;
mod bilinear;
mod builtin;
mod calls;
mod consts;
mod convert;
mod cost;
mod divide;
mod entry;
mod expr;
mod filled;
mod flow;
mod function;
mod geometry;
mod inline;
mod limits;
mod long_arrays;
mod matrix;
mod memory;
mod mix;
mod opaque;
mod operators;
mod ranges;
mod reach;
mod regroup;
mod resources;
mod scalars;
mod settled;
mod split;
mod stage;
mod steps;
mod tables;
mod texture;
mod types;
mod walk;
mod writes;
mod zeros;

use std::collections::{HashMap, HashSet};

use naga::{FastHashMap, Handle};

pub(crate) use self::tables::TableBytes;
use self::{
    calls::{Arguments, Given},
    consts::Constants,
    reach::Reach,
    resources::Resources,
    tables::Tables,
    types::Types,
    zeros::Zeros,
};
pub(in crate::glsl) use self::{reach::reached, settled::settle};
use super::{PassSource, Reflection, hir, interface::KNOB_BYTES, stages::Interface};

/// What lowering makes.
pub(crate) struct Lowered {
    pub module: naga::Module,
    pub reflection: Reflection,
    pub tables: TableBytes,
    /// Size of the array of the author's own uniforms; 0 if the module has none.
    pub knob_bytes: u64,
    /// See [`super::Compiled::filled_arrays`].
    pub filled_arrays: Option<u32>,
}

/// Lowers a program without errors. The result validates; a validation error is a bug of this module.
///
/// # Panics
/// If `module` breaks the promises of [`hir`], such as having no entry point.
pub(in crate::glsl) fn lower(module: &hir::Module, source: &PassSource<'_>, interface: Interface) -> Lowered {
    let (reach, arguments) = Reach::new(module);
    let writes = ranges::write_counts(module);
    let mut cx = Lowering {
        hir: module,
        source,
        interface,
        out: naga::Module::default(),
        types: Types::new(module.types.len()),
        consts: Constants::new(module.consts.len()),
        tables: Tables::default(),
        resources: Resources::new(module.globals.len()),
        costs: cost::costs(module),
        counted: steps::counted(module, &writes),
        limits: if source.driver.hidden_limits { limits::limits(module) } else { HashSet::new() },
        writes,
        arguments,
        inlined: inline::inlined(module, &reach),
        uses: ranges::use_counts(module),
        zeros: Zeros::new(module),
        functions: HashMap::with_capacity(reach.instances.len()),
        filled: HashSet::new(),
        reflection: Reflection::default(),
    };
    let apart: Vec<_> = reach.instances.iter().filter(|i| !cx.inlined[i.func.index()]).collect();
    for instance in apart {
        let function = function::lower(&mut cx, instance);
        let handle = cx.out.functions.append(function, naga::Span::UNDEFINED);
        cx.functions.insert(instance.clone(), handle);
    }
    if source.kind.is_stage() {
        stage::lower(&mut cx, &reach);
    } else {
        entry::lower(&mut cx, &reach);
    }
    let tables = cx.finish_tables();
    let knob_bytes = if cx.reflection.knobs.is_empty() { 0 } else { u64::from(cx.knob_slots()) * KNOB_BYTES };
    let filled_arrays = if source.driver.array_loops { long_arrays::write(&mut cx.out, &cx.filled) } else { None };
    Lowered { module: cx.out, filled_arrays, reflection: cx.reflection, tables, knob_bytes }
}

/// Checks a lowered module. An error is a bug of this module, never the author's.
pub(crate) fn validate(module: &naga::Module) -> Result<naga::valid::ModuleInfo, String> {
    use naga::valid::{Capabilities, ValidationFlags, Validator};
    // `packHalf2x16` needs the second; every desktop device has it.
    let capabilities = Capabilities::default() | Capabilities::SHADER_FLOAT16_IN_FLOAT32;
    Validator::new(ValidationFlags::all(), capabilities).validate(module).map_err(|error| {
        let error = error.into_inner();
        let mut text = error.to_string();
        let mut source = std::error::Error::source(&error);
        while let Some(cause) = source {
            text.push_str(": ");
            text.push_str(&cause.to_string());
            source = cause.source();
        }
        text
    })
}

/// A user function with what it has in place of samplers and of arrays that it only reads, in order.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Instance {
    func: hir::FuncId,
    given: Box<[Given]>,
}

/// State of lowering one module. What belongs to one function is in [`function::Builder`].
struct Lowering<'a> {
    hir: &'a hir::Module,
    source: &'a PassSource<'a>,
    /// Of a stage: where its inputs and outputs lie.
    interface: Interface,
    out: naga::Module,
    types: Types,
    consts: Constants,
    tables: Tables,
    resources: Resources,
    /// Cost of each expression, by [`hir::ExprId::index`].
    costs: Vec<u16>,
    /// How many expressions write each local, by [`hir::LocalId::index`].
    writes: Vec<u32>,
    /// Locals that one loop counts.
    counted: HashMap<usize, steps::Counted>,
    /// Operands that the driver shall not see through.
    limits: HashSet<hir::ExprId>,
    arguments: Arguments,
    /// Functions that become part of their callers, by [`hir::FuncId::index`].
    inlined: Vec<bool>,
    /// How many expressions name each local, by [`hir::LocalId::index`].
    uses: Vec<u32>,
    zeros: Zeros,
    functions: HashMap<Instance, Handle<naga::Function>>,
    /// Private globals that are stored as a whole before all else: by each call of the one function that knows them, or where the
    /// program starts.
    filled: HashSet<Handle<naga::GlobalVariable>>,
    reflection: Reflection,
}

/// Handles by 32-bit keys, with naga's quick hash.
type Map<K, V> = FastHashMap<K, V>;
