//! Constant tables that are indexed at run time, in one read-only storage buffer.
//!
//! As memory of each invocation a table must be filled before the first read, texel by texel, and a driver's compiler takes
//! minutes over a table of some thousand entries. In a buffer it costs a load. GLSL drivers do the same: Mesa's turns constant
//! arrays into uniforms. Small tables stay in memory, where a driver can turn them into selects; so do those that hold
//! booleans, which no buffer may.

use naga::{AddressSpace, Expression, GlobalVariable, Handle, ResourceBinding, StorageAccess, StructMember, TypeInner};

use super::{
    Lowering, Map,
    function::{Builder, Value},
    types::round_up,
};
use crate::glsl::{
    hir::{ConstId, Scalar, Type, TypeId},
    interface,
};

/// Scalars from which on a table goes into the buffer. A buffer's load is slow where neighbours read different places (five times
/// the frame of a loop over 14 triangles on llvmpipe), and a driver that unrolls such a loop folds reads of memory away.
const LARGE: usize = 256;

/// Tables found so far.
#[derive(Default)]
pub(super) struct Tables {
    places: Map<u32, TablePlace>,
    buffer: Option<Handle<GlobalVariable>>,
    members: Vec<StructMember>,
    bytes: Vec<u8>,
}

#[derive(Clone, Copy)]
enum TablePlace {
    Private(Handle<GlobalVariable>),
    /// A member of the buffer.
    Member(u32),
}

impl Builder<'_, '_> {
    /// A pointer to memory that holds a folded value, for indexing.
    pub fn table(&mut self, id: ConstId) -> Value {
        match self.cx.table_place(id) {
            TablePlace::Private(global) => self.global(global),
            TablePlace::Member(index) => {
                let buffer = self.cx.table_buffer();
                let base = self.global(buffer);
                self.add(Expression::AccessIndex { base, index })
            }
        }
    }
}

impl Lowering<'_> {
    fn table_place(&mut self, id: ConstId) -> TablePlace {
        let key = id.index() as u32;
        if let Some(&place) = self.tables.places.get(&key) {
            return place;
        }
        let constant = self.hir[id];
        let is_large = self.hir[constant.words].len() >= LARGE;
        let place = if is_large && !self.source.tables_in_memory && !self.holds_booleans(constant.ty) {
            TablePlace::Member(self.append_table(id))
        } else {
            TablePlace::Private(self.private_table(id))
        };
        self.tables.places.insert(key, place);
        place
    }

    fn append_table(&mut self, id: ConstId) -> u32 {
        let constant = self.hir[id];
        let (ty, layout) = self.laid_out(constant.ty);
        let offset = round_up(layout.align, self.tables.bytes.len() as u32);
        self.tables.members.push(StructMember { name: None, ty, binding: None, offset });
        let mut bytes = std::mem::take(&mut self.tables.bytes);
        bytes.resize((offset + layout.size) as usize, 0);
        let mut words = self.hir[constant.words].iter().copied();
        self.write(constant.ty, offset as usize, &mut words, &mut bytes);
        self.tables.bytes = bytes;
        self.tables.members.len() as u32 - 1
    }

    /// Puts a value's words where its layout has them.
    fn write(&mut self, ty: TypeId, at: usize, words: &mut dyn Iterator<Item = u32>, bytes: &mut [u8]) {
        let hir = self.hir;
        let mut put = |at: usize| {
            let word = words.next().expect("as many words as scalars");
            bytes[at..at + 4].copy_from_slice(&word.to_ne_bytes());
        };
        match hir.types.get(ty) {
            Type::Scalar(_) => put(at),
            Type::Vector { size, .. } => (0..usize::from(size)).for_each(|i| put(at + 4 * i)),
            Type::Matrix { columns, rows } => {
                let stride = self.laid_out(TypeId::vector(Scalar::Float, rows)).1.align as usize;
                for column in 0..usize::from(columns) {
                    (0..usize::from(rows)).for_each(|row| put(at + column * stride + 4 * row));
                }
            }
            Type::Array { element, len } => {
                let layout = self.laid_out(element).1;
                let stride = round_up(layout.align, layout.size) as usize;
                (0..len as usize).for_each(|i| self.write(element, at + i * stride, words, bytes));
            }
            Type::Struct(id) => {
                let mut offset = 0;
                for member in &hir[hir[id].members] {
                    let layout = self.laid_out(member.ty).1;
                    offset = round_up(layout.align, offset);
                    self.write(member.ty, at + offset as usize, words, bytes);
                    offset += layout.size;
                }
            }
            other => unreachable!("{other:?} is no type of a value"),
        }
    }

    fn holds_booleans(&self, ty: TypeId) -> bool {
        match self.hir.types.get(ty) {
            Type::Scalar(scalar) | Type::Vector { scalar, .. } => scalar == Scalar::Bool,
            Type::Array { element, .. } => self.holds_booleans(element),
            Type::Struct(id) => self.hir[self.hir[id].members].iter().any(|m| self.holds_booleans(m.ty)),
            _ => false,
        }
    }

    /// The buffer; its type is not known before the last table is.
    fn table_buffer(&mut self) -> Handle<GlobalVariable> {
        if let Some(buffer) = self.tables.buffer {
            return buffer;
        }
        let binding = ResourceBinding { group: interface::UNIFORM_GROUP, binding: interface::TABLE_BINDING };
        let ty = self.ty(TypeId::UINT);
        let buffer = self.variable(AddressSpace::Storage { access: StorageAccess::LOAD }, ty, Some(binding), None);
        self.tables.buffer = Some(buffer);
        buffer
    }

    /// Gives the buffer its type; its bytes.
    pub fn finish_tables(&mut self) -> Vec<u8> {
        let Some(buffer) = self.tables.buffer else { return Vec::new() };
        let members = std::mem::take(&mut self.tables.members);
        let align = members.iter().map(|m| self.alignment(m.ty)).max().unwrap_or(4);
        let mut bytes = std::mem::take(&mut self.tables.bytes);
        let span = round_up(align, bytes.len() as u32);
        bytes.resize(span as usize, 0);
        let ty = self.insert_type(TypeInner::Struct { members, span });
        self.out.global_variables[buffer].ty = ty;
        bytes
    }

    /// Alignment of a type made by [`Lowering::laid_out`].
    fn alignment(&self, ty: Handle<naga::Type>) -> u32 {
        self.types.layout_of(ty).map_or(16, |layout| layout.align)
    }
}
