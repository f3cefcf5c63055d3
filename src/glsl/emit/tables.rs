//! Constant tables that are indexed at run time, in read-only buffers.
//!
//! In memory of each invocation a table must be filled before the first read, element by element, and a driver's
//! compiler takes minutes for a table of some thousand entries. In a buffer it costs a load. GLSL drivers do the same:
//! Mesa's turn constant arrays into uniforms. Arrays of numbers and vectors are put in a uniform buffer until it is
//! full; large tables that a uniform buffer cannot store are put in a storage buffer. All others stay in memory: small
//! tables, which a driver turns into selects, and those that contain booleans, which are not allowed in buffers.

use std::num::NonZeroU32;

use naga::{AddressSpace, ArraySize, GlobalVariable, Handle, ResourceBinding, StorageAccess, StructMember, TypeInner};

use super::{
    context::{Buffer, Emitter, TablePlace},
    long_arrays::MIN_COPY,
};
use crate::{
    PassKind, interface,
    ir::{ConstId, layout::round_up},
    types::{Scalar, Type, TypeId},
};

/// The number of scalars from which on an indexed constant is put in a storage buffer. Its load is slow if neighbouring
/// invocations read different places (five times the frame time for a loop over 14 triangles on llvmpipe), and a driver
/// that unrolls such a loop constant-folds reads of memory.
pub(crate) const MIN_STORAGE_TABLE: usize = 256;

/// The number of elements from which on an indexed constant array is put in the uniform buffer. Filling memory takes
/// llvmpipe one store per pixel and component at every start of the program; but Mesa unrolls loops of up to 32
/// iterations (`max_unroll_iterations` in `lp_screen.c`), and then constant-folds their reads of memory.
pub(crate) const MIN_UNIFORM_TABLE: u32 = 33;

/// The size of a slot in bytes: the minimum stride of an array in a uniform buffer.
const SLOT: u32 = 16;

/// The contents of the buffers with constant tables; if empty, the module has no such buffer.
pub(crate) struct TableBytes {
    pub uniform: Vec<u8>,
    pub storage: Vec<u8>,
}

impl Emitter<'_> {
    /// Returns whether values of a type are copied by loops, because the driver needs it ([`super::long_arrays`]).
    pub(super) fn is_long(&mut self, ty: TypeId) -> bool {
        self.source.driver.array_loops && self.layouts.is_aggregate_of(self.ir, ty, MIN_COPY)
    }

    pub(super) fn table_place(&mut self, id: ConstId) -> TablePlace {
        let key = id.index() as u32;
        if let Some(&place) = self.tables.places.get(&key) {
            return place;
        }
        let constant = &self.ir[id];
        let scalars = constant.words.len();
        let place = if self.source.kind.is_plain() {
            TablePlace::Private(self.private_table(id))
        } else if let Some((ty, size)) = self.in_slots(constant.ty)
            && self.tables.uniform.bytes.len() + size as usize <= interface::UNIFORM_TABLE_BYTES
        {
            TablePlace::Uniform(self.append_to_uniform(id, ty, size))
        } else if scalars >= MIN_STORAGE_TABLE
            && !self.source.driver.tables_in_memory
            && !self.contains_booleans(constant.ty)
        {
            TablePlace::Storage(self.storage_index(id))
        } else {
            TablePlace::Private(self.private_table(id))
        };
        self.tables.places.insert(key, place);
        place
    }

    /// Returns the type of an array in a uniform buffer, and its number of bytes: its scalars and vectors are in slots
    /// of 16 bytes, in the first components of vectors of three or four. `None` if it is not an array of these, or too
    /// short to be worth it.
    fn in_slots(&mut self, ty: TypeId) -> Option<(Handle<naga::Type>, u32)> {
        let Type::Array { element, len: len @ MIN_UNIFORM_TABLE.. } = self.ir.types.get(ty) else { return None };
        let base = match self.ir.types.get(element) {
            Type::Scalar(Scalar::Bool) | Type::Vector { scalar: Scalar::Bool, .. } => return None,
            Type::Vector { size: 3.., .. } => self.ty(element),
            Type::Scalar(scalar) | Type::Vector { scalar, .. } => self.ty(TypeId::vector(scalar, 4)),
            _ => return None,
        };
        let size = ArraySize::Constant(NonZeroU32::new(len)?);
        Some((self.insert_type(TypeInner::Array { base, size, stride: SLOT }), SLOT.checked_mul(len)?))
    }

    fn append_to_uniform(&mut self, id: ConstId, ty: Handle<naga::Type>, size: u32) -> u32 {
        let words = &self.ir[id].words;
        let slots = size / SLOT;
        let buffer = &mut self.tables.uniform;
        let offset = buffer.bytes.len() as u32;
        buffer.members.push(StructMember { name: None, ty, binding: None, offset });
        for slot in words.chunks(words.len() / slots as usize) {
            let end = buffer.bytes.len() + SLOT as usize;
            slot.iter().for_each(|word| buffer.bytes.extend(word.to_ne_bytes()));
            buffer.bytes.resize(end, 0);
        }
        buffer.members.len() as u32 - 1
    }

    /// Returns the member of the storage buffer that contains a constant.
    pub(super) fn storage_index(&mut self, id: ConstId) -> u32 {
        let key = id.index() as u32;
        if let Some(&index) = self.tables.stored.get(&key) {
            return index;
        }
        let index = self.append_to_storage(id);
        self.tables.stored.insert(key, index);
        index
    }

    fn append_to_storage(&mut self, id: ConstId) -> u32 {
        let constant = &self.ir[id];
        let (ty, layout) = (self.ty(constant.ty), self.layout(constant.ty));
        let buffer = &mut self.tables.storage;
        let offset = round_up(layout.align, buffer.bytes.len() as u32);
        buffer.members.push(StructMember { name: None, ty, binding: None, offset });
        buffer.align = buffer.align.max(layout.align);
        let mut bytes = std::mem::take(&mut buffer.bytes);
        bytes.resize((offset + layout.size) as usize, 0);
        let mut words = constant.words.iter().copied();
        self.write(constant.ty, offset as usize, &mut words, &mut bytes);
        self.tables.storage.bytes = bytes;
        self.tables.storage.members.len() as u32 - 1
    }

    /// Writes a value's words at the offsets of its layout.
    fn write(&mut self, ty: TypeId, at: usize, words: &mut dyn Iterator<Item = u32>, bytes: &mut [u8]) {
        let ir = self.ir;
        let mut put = |at: usize| {
            let word = words.next().expect("as many words as scalars");
            bytes[at..at + 4].copy_from_slice(&word.to_ne_bytes());
        };
        match ir.types.get(ty) {
            Type::Scalar(_) => put(at),
            Type::Vector { size, .. } => (0..usize::from(size)).for_each(|i| put(at + 4 * i)),
            Type::Matrix { columns, rows } => {
                let stride = self.layout(TypeId::vector(Scalar::Float, rows)).align as usize;
                for column in 0..usize::from(columns) {
                    (0..usize::from(rows)).for_each(|row| put(at + column * stride + 4 * row));
                }
            }
            Type::Array { element, len } => {
                let stride = self.layout(element).stride() as usize;
                (0..len as usize).for_each(|i| self.write(element, at + i * stride, words, bytes));
            }
            Type::Struct(id) => {
                let mut offset = 0;
                for &member in &ir.structs[id.index()] {
                    let layout = self.layout(member);
                    offset = round_up(layout.align, offset);
                    self.write(member, at + offset as usize, words, bytes);
                    offset += layout.size;
                }
            }
            other => unreachable!("{other:?} is no type of a value"),
        }
    }

    pub(super) fn contains_booleans(&self, ty: TypeId) -> bool {
        match self.ir.types.get(ty) {
            Type::Scalar(scalar) | Type::Vector { scalar, .. } => scalar == Scalar::Bool,
            Type::Array { element, .. } => self.contains_booleans(element),
            Type::Struct(id) => self.ir.structs[id.index()].iter().any(|&member| self.contains_booleans(member)),
            _ => false,
        }
    }

    pub(super) fn uniform_tables(&mut self) -> Handle<GlobalVariable> {
        if let Some(made) = self.tables.uniform.variable {
            return made;
        }
        let binding = match self.source.kind {
            PassKind::Vertex => interface::VERTEX_TABLE_BINDING,
            _ => interface::UNIFORM_TABLE_BINDING,
        };
        let made = self.table_buffer(AddressSpace::Uniform, binding);
        *self.tables.uniform.variable.insert(made)
    }

    pub(super) fn storage_tables(&mut self) -> Handle<GlobalVariable> {
        if let Some(made) = self.tables.storage.variable {
            return made;
        }
        let made = self.table_buffer(AddressSpace::Storage { access: StorageAccess::LOAD }, interface::TABLE_BINDING);
        *self.tables.storage.variable.insert(made)
    }

    /// Returns a buffer; its type is not known until the last table has been added.
    fn table_buffer(&mut self, space: AddressSpace, binding: u32) -> Handle<GlobalVariable> {
        let ty = self.ty(TypeId::UINT);
        self.variable(space, ty, Some(ResourceBinding { group: interface::UNIFORM_GROUP, binding }), None)
    }

    /// Sets the types of the buffers, and returns their contents.
    pub(super) fn finish_tables(&mut self) -> TableBytes {
        let (uniform, storage) = (std::mem::take(&mut self.tables.uniform), std::mem::take(&mut self.tables.storage));
        let align = storage.align.max(4);
        TableBytes { uniform: self.finish_buffer(uniform, SLOT), storage: self.finish_buffer(storage, align) }
    }

    fn finish_buffer(&mut self, buffer: Buffer, align: u32) -> Vec<u8> {
        let Buffer { variable: Some(variable), members, mut bytes, .. } = buffer else { return Vec::new() };
        let span = round_up(align, bytes.len() as u32);
        bytes.resize(span as usize, 0);
        let ty = self.insert_type(TypeInner::Struct { members, span });
        self.out.global_variables[variable].ty = ty;
        bytes
    }
}
