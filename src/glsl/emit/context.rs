//! State of emitting one module.

use rustc_hash::FxHashSet;

use naga::{Expression, FastHashMap, GlobalVariable, Handle, StructMember};

use super::blocks::Block;
use crate::{
    PassSource, Reflection,
    ir::{self, ConstId, layout::Layouts},
};

/// State of emitting one module. The state of one function is in [`super::function::Builder`].
pub(super) struct Emitter<'a> {
    pub ir: &'a ir::Module,
    pub source: &'a PassSource<'a>,
    pub reflection: &'a mut Reflection,
    pub out: naga::Module,
    /// By [`TypeId`](crate::types::TypeId).
    pub types: Vec<Option<Handle<naga::Type>>>,
    pub layouts: Layouts,
    pub consts: Constants,
    pub tables: Tables,
    pub resources: Resources,
    /// By [`ir::FuncId`].
    pub functions: Vec<Handle<naga::Function>>,
    /// Private memory that is stored as a whole before it is read.
    pub overwritten: FxHashSet<Handle<GlobalVariable>>,
    /// Variables of each function that are written before they are read, in the order of emission: the entry point
    /// last.
    pub written_first: Vec<FxHashSet<Handle<naga::LocalVariable>>>,
}

/// The constants created so far.
pub(super) struct Constants {
    /// By [`ConstId::index`]; `Some(None)` if it contains a value that is not a literal.
    pub inits: Vec<Option<Option<Handle<Expression>>>>,
    pub constants: Vec<Option<Handle<naga::Constant>>>,
    pub literals: Map<(u8, u32), Handle<Expression>>,
    /// Globals whose constant value is not a constant expression in naga.
    pub set_at_start: Vec<(Handle<GlobalVariable>, ConstId)>,
}

impl Constants {
    pub(super) fn new(count: usize) -> Self {
        Self {
            inits: vec![None; count],
            constants: vec![None; count],
            literals: Map::default(),
            set_at_start: Vec::new(),
        }
    }
}

/// The tables found so far.
#[derive(Default)]
pub(super) struct Tables {
    pub places: Map<u32, TablePlace>,
    /// Members of the storage buffer, by [`ConstId::index`].
    pub stored: Map<u32, u32>,
    pub uniform: Buffer,
    pub storage: Buffer,
}

/// A buffer under construction: a structure with a member for each table.
#[derive(Default)]
pub(super) struct Buffer {
    pub variable: Option<Handle<GlobalVariable>>,
    pub members: Vec<StructMember>,
    pub bytes: Vec<u8>,
    /// The largest alignment of a member, in bytes.
    pub align: u32,
}

/// The place of a table.
#[derive(Clone, Copy)]
pub(super) enum TablePlace {
    Private(Handle<GlobalVariable>),
    /// A member of the uniform buffer.
    Uniform(u32),
    /// A member of the storage buffer.
    Storage(u32),
}

/// The variables declared so far.
#[derive(Default)]
pub(super) struct Resources {
    pub block: Option<Handle<GlobalVariable>>,
    pub custom_uniform_block: Option<Handle<GlobalVariable>>,
    /// By [`ir::Module::blocks`].
    pub blocks: Map<u16, Block>,
    /// Textures and samplers, by channel.
    pub textures: Map<u8, Handle<GlobalVariable>>,
    pub samplers: Map<u8, Handle<GlobalVariable>>,
    /// Private memory, by [`ir::GlobalId::index`].
    pub private: Vec<Option<Handle<GlobalVariable>>>,
    pub geometry: Option<Handle<GlobalVariable>>,
    /// The zero that is unknown to the driver.
    pub opaque_zero: Option<Handle<GlobalVariable>>,
}

/// Handles by 32-bit keys, with naga's quick hash.
pub(super) type Map<K, V> = FastHashMap<K, V>;
