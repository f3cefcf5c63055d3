//! Holds what comes of a pass that compiles.

use super::reflection::Reflection;
use eddy_diag::Diagnostic;

/// A pass that compiled.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// Valid ([`Compiled::validate`]); one entry point named [`super::interface::ENTRY_POINT`], of a fragment shader
    /// but for [`super::PassKind::Vertex`].
    pub module: naga::Module,
    pub reflection: Reflection,
    /// Says what the storage buffer at [`super::interface::TABLE_BINDING`] holds; empty: the module declares none.
    pub tables: Vec<u8>,
    /// Says what the uniform buffer at [`super::interface::UNIFORM_TABLE_BINDING`] holds; empty: the module declares
    /// none.
    pub uniform_tables: Vec<u8>,
    /// Bytes that the module reads at [`super::interface::CUSTOM_UNIFORM_BINDING`]; 0: it declares nothing there.
    pub custom_uniform_bytes: u64,
    /// An array of at least so many scalars that has no initialiser is written before anything reads it, so that it
    /// need not begin with zeros. `None`: that was not asked for ([`super::Driver::array_loops`]), or no array is that
    /// long.
    pub initialized_arrays: Option<u32>,
    /// Statements of the program with all calls written out, as drivers compile it.
    pub inlined_size: u64,
    /// Warnings and notes; never an error.
    pub diagnostics: Vec<Diagnostic>,
}
