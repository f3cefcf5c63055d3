//! Emission: translates the intermediate representation to a [`naga::Module`].
//!
//! Contains types, constants, tables, resources and entry points of the module, the order of its expressions, and
//! work-arounds for drivers on the emitted module ([`long_arrays`]; each names the driver and the fault). Adds the
//! declarations of the module to the reflection.
//!
//! naga does not know the bounds of indices, and guards divisions with its own functions: both are handled earlier
//! ([`super::ir`]), so that modules need neither.

mod blocks;
mod consts;
mod context;
mod entry;
mod expression;
mod function;
mod long_arrays;
mod memory;
mod operators;
mod remainder;
mod resources;
mod tables;
mod types;
pub(crate) mod work_arounds;

use rustc_hash::FxHashSet;

use self::context::{Constants, Emitter, Resources, Tables};
pub(crate) use self::tables::TableBytes;
pub(crate) use self::{
    long_arrays::MIN_COPY,
    tables::{MIN_STORAGE_TABLE, MIN_UNIFORM_TABLE},
};
use super::{
    PassSource, Reflection,
    interface::CUSTOM_UNIFORM_BYTES,
    ir::{self, layout::Layouts},
};

/// The result of emission.
pub(crate) struct Emitted {
    pub module: naga::Module,
    pub tables: TableBytes,
    /// The size of the array of custom uniforms; 0 if the module has none.
    pub custom_uniform_bytes: u64,
    /// See [`super::Compiled::initialized_arrays`].
    pub initialized_arrays: Option<u32>,
}

/// Emits a program that satisfies the rules of [`ir::verify`]; adds the declarations of the module to `reflection`. The
/// result validates; a validation error is a bug of this compiler.
pub(crate) fn emit(program: &ir::Module, source: &PassSource<'_>, reflection: &mut Reflection) -> Emitted {
    let mut emitter = Emitter {
        ir: program,
        source,
        reflection,
        out: naga::Module::default(),
        types: vec![None; program.types.len()],
        layouts: Layouts::default(),
        consts: Constants::new(program.consts.len()),
        tables: Tables::default(),
        resources: Resources::default(),
        functions: Vec::with_capacity(program.functions.len()),
        overwritten: FxHashSet::default(),
        written_first: Vec::new(),
    };
    let (entry, functions) = program.functions.split_last().expect("a program has an entry point");
    for function in functions {
        let function = function::emit(&mut emitter, function);
        let handle = emitter.out.functions.append(function, naga::Span::UNDEFINED);
        emitter.functions.push(handle);
    }
    entry::emit(&mut emitter, entry);
    let tables = emitter.finish_tables();
    emitter.finish_blocks();
    let slots = u64::from(emitter.custom_uniform_slots());
    let custom_uniform_bytes =
        if emitter.reflection.custom_uniforms.is_empty() { 0 } else { slots * CUSTOM_UNIFORM_BYTES };
    let Emitter { mut out, overwritten, written_first, .. } = emitter;
    let initialized_arrays =
        if source.driver.array_loops { long_arrays::write(&mut out, &overwritten, &written_first) } else { None };
    Emitted { module: out, tables, custom_uniform_bytes, initialized_arrays }
}

/// Validates an emitted module. An error is a bug of this compiler, never the author's.
pub(crate) fn validate(module: &naga::Module) -> Result<naga::valid::ModuleInfo, String> {
    use naga::valid::{Capabilities, ValidationFlags, Validator};
    // `packHalf2x16` needs the second capability; every desktop device has it.
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
