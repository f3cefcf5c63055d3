//! Uniform buffers that a plain shader declares, laid out by std140.
//!
//! Their types differ from those of values where std140 pads: an element of an array of scalars or of two-component
//! vectors is the first components of a four-component vector, and so is a column of two rows; a bool is a uint.
//! Structures have members that fill the gaps, so that all of naga's writers, including one that writes no offsets,
//! produce the same layout.

use std::num::NonZeroU32;

use naga::{
    AddressSpace, ArraySize, BinaryOperator, Expression, GlobalVariable, Handle, ResourceBinding, StructMember,
    SwizzleComponent, TypeInner,
};

use super::{context::Emitter, function::Builder};
use crate::{
    UniformBuffer,
    ir::{GlobalKind, Op, Value},
    plain::{self, std140},
    types::{Scalar, Type, TypeId},
};

/// A declared block.
pub(super) struct Block {
    pub variable: Handle<GlobalVariable>,
    /// The index in the type of each member of the block.
    places: Vec<u32>,
    /// The members of the block that are read.
    read: Vec<bool>,
}

impl Emitter<'_> {
    /// Returns the variable of a block, and the index in its type of a member of the block.
    pub(super) fn block_member(&mut self, block: u16, index: u16) -> (Handle<GlobalVariable>, u32) {
        let made = match self.resources.blocks.remove(&block) {
            Some(made) => made,
            None => self.make_block(block),
        };
        let result = (made.variable, made.places[usize::from(index)]);
        self.resources.blocks.entry(block).or_insert(made).read[usize::from(index)] = true;
        result
    }

    fn make_block(&mut self, block: u16) -> Block {
        let block = &self.ir.blocks[usize::from(block)];
        let types: Vec<TypeId> = block.members.iter().map(|member| member.ty).collect();
        let names: Vec<&str> = block.members.iter().map(|member| member.name.as_str()).collect();
        let name = if block.name.is_empty() { "Uniforms" } else { &block.name };
        let (ty, places) = self.padded_struct(name, &types, &names);
        let binding = ResourceBinding { group: block.group, binding: block.binding };
        let variable = self.variable(AddressSpace::Uniform, ty, Some(binding), None);
        self.out.global_variables[variable].name = Some(name.to_lowercase());
        Block { variable, places, read: vec![false; types.len()] }
    }

    /// Returns a structure with its gaps filled, and the index of each member in it.
    fn padded_struct(&mut self, name: &str, types: &[TypeId], names: &[&str]) -> (Handle<naga::Type>, Vec<u32>) {
        let (offsets, span) = std140::offsets(self.ir, types);
        let (mut members, mut places) = (Vec::new(), Vec::new());
        let uint = self.ty(TypeId::UINT);
        let mut end = 0;
        let fill = |members: &mut Vec<StructMember>, end: u32, to: u32| {
            for offset in (end..to).step_by(4) {
                let name = Some(format!("pad_{offset}"));
                members.push(StructMember { name, ty: uint, binding: None, offset });
            }
        };
        for ((&ty, &name), offset) in types.iter().zip(names).zip(offsets) {
            fill(&mut members, end, offset);
            places.push(members.len() as u32);
            end = offset + std140::layout(self.ir, ty).size;
            let ty = self.buffer_ty(ty);
            members.push(StructMember { name: Some(name.to_owned()), ty, binding: None, offset });
        }
        fill(&mut members, end, span);
        let inner = TypeInner::Struct { members, span };
        let ty = naga::Type { name: Some(name.to_owned()), inner };
        (self.out.types.insert(ty, naga::Span::UNDEFINED), places)
    }

    /// Returns the type of a value in a buffer.
    fn buffer_ty(&mut self, ty: TypeId) -> Handle<naga::Type> {
        match self.ir.types.get(ty) {
            Type::Scalar(Scalar::Bool) => self.ty(TypeId::UINT),
            Type::Vector { scalar: Scalar::Bool, size } => self.ty(TypeId::vector(Scalar::Uint, size)),
            Type::Matrix { columns, rows: 2 } => self.slots(Scalar::Float, columns.into()),
            Type::Array { element, len } => match self.ir.types.get(element) {
                Type::Scalar(scalar) | Type::Vector { scalar, size: 2 } => self.slots(in_buffer(scalar), len),
                _ => {
                    let base = self.buffer_ty(element);
                    self.array(base, len, std140::array_stride(self.ir, element))
                }
            },
            Type::Struct(id) => {
                let (ir, index) = (self.ir, id.index());
                let names: Vec<&str> = ir.struct_names[index].members.iter().map(String::as_str).collect();
                let name = &ir.struct_names[index].name;
                self.padded_struct(if name.is_empty() { "Struct" } else { name }, &ir.structs[index], &names).0
            }
            _ => self.ty(ty),
        }
    }

    fn slots(&mut self, scalar: Scalar, len: u32) -> Handle<naga::Type> {
        let base = self.ty(TypeId::vector(scalar, 4));
        self.array(base, len, std140::SLOT)
    }

    fn array(&mut self, base: Handle<naga::Type>, len: u32, stride: u32) -> Handle<naga::Type> {
        let size = ArraySize::Constant(NonZeroU32::new(len).unwrap_or(NonZeroU32::MIN));
        self.insert_type(TypeInner::Array { base, size, stride })
    }

    /// Returns the index of a member in its structure's type in a buffer.
    fn place_in_struct(&self, ty: TypeId, index: u32) -> u32 {
        let Type::Struct(id) = self.ir.types.get(ty) else { return index };
        let types = &self.ir.structs[id.index()];
        let (offsets, _) = std140::offsets(self.ir, types);
        let (mut place, mut end) = (0, 0);
        for (n, (&ty, offset)) in types.iter().zip(offsets).enumerate() {
            place += (offset - end) / 4;
            if n as u32 == index {
                break;
            }
            place += 1;
            end = offset + std140::layout(self.ir, ty).size;
        }
        place
    }

    /// Adds the declared blocks to the reflection, and removes undeclared samplers from it.
    pub(super) fn finish_blocks(&mut self) {
        let mut blocks: Vec<_> = std::mem::take(&mut self.resources.blocks).into_iter().collect();
        blocks.sort_by_key(|(index, _)| *index);
        for (index, made) in blocks {
            let block = &self.ir.blocks[usize::from(index)];
            let types: Vec<TypeId> = block.members.iter().map(|member| member.ty).collect();
            let (offsets, size) = std140::offsets(self.ir, &types);
            let mut members = Vec::new();
            for ((member, offset), _) in block.members.iter().zip(offsets).zip(made.read).filter(|(_, read)| *read) {
                plain::members(self.ir, member, offset, &mut members);
            }
            let (name, group, binding) = (block.name.clone(), block.group, block.binding);
            self.reflection.shader.buffers.push(UniformBuffer { name, group, binding, size, members });
        }
        self.reflection.shader.textures.retain(|texture| texture.used.is_read());
    }
}

/// Returns the component type that represents another one in a buffer.
fn in_buffer(scalar: Scalar) -> Scalar {
    if scalar == Scalar::Bool { Scalar::Uint } else { scalar }
}

impl Builder<'_, '_> {
    /// Returns whether a place is in a uniform block that the author declared.
    pub(super) fn is_in_block(&self, place: Value) -> bool {
        match self.ir[self.ir.root(place)] {
            Op::Global(id) => matches!(self.cx.ir[id].kind, GlobalKind::Member { .. }),
            _ => false,
        }
    }

    /// Returns whether the parts of a type are the first components of larger slots.
    fn has_slots(&self, ty: TypeId) -> bool {
        match self.cx.ir.types.get(ty) {
            Type::Matrix { rows, .. } => rows == 2,
            Type::Array { element, .. } => {
                matches!(self.cx.ir.types.get(element), Type::Scalar(_) | Type::Vector { size: 2, .. })
            }
            _ => false,
        }
    }

    /// Returns the pointer to a part of a place in a block, or to the slot of a two-component vector, if it is in one.
    pub(super) fn part_in_block(&mut self, place: Value) -> Handle<Expression> {
        let ir = self.ir;
        let (Op::Part { base: of, .. } | Op::Element { base: of, .. }) = ir[place] else {
            unreachable!("it has a base")
        };
        let (base, ty) = (self.value(of), ir.ty(of));
        let pointer = match ir[place] {
            Op::Element { index, .. } => {
                let index = self.value(index);
                self.add(Expression::Access { base, index })
            }
            Op::Part { index, .. } => {
                let index = self.cx.place_in_struct(ty, index);
                self.add(Expression::AccessIndex { base, index })
            }
            _ => unreachable!("seen above"),
        };
        self.first_of_slot(pointer, ty, ir.ty(place))
    }

    /// Returns the pointer to a scalar in its slot; other parts start at the start of the slot.
    fn first_of_slot(&mut self, pointer: Handle<Expression>, whole: TypeId, part: TypeId) -> Handle<Expression> {
        match self.cx.ir.types.get(part) {
            Type::Scalar(_) if self.has_slots(whole) => self.add(Expression::AccessIndex { base: pointer, index: 0 }),
            _ => pointer,
        }
    }

    /// Loads a place in a block.
    pub(super) fn load_in_block(&mut self, place: Value) -> Handle<Expression> {
        let ir = self.ir;
        let in_slot = match ir[place] {
            Op::Part { base, .. } | Op::Element { base, .. } => self.has_slots(ir.ty(base)),
            _ => false,
        };
        let pointer = self.value(place);
        self.load_parts(pointer, ir.ty(place), in_slot)
    }

    fn load_parts(&mut self, pointer: Handle<Expression>, ty: TypeId, in_slot: bool) -> Handle<Expression> {
        let program = self.cx.ir;
        match program.types.get(ty) {
            Type::Scalar(scalar) | Type::Vector { scalar, .. } => {
                let mut value = self.add(Expression::Load { pointer });
                if in_slot && matches!(program.types.get(ty), Type::Vector { .. }) {
                    let pattern = [SwizzleComponent::X, SwizzleComponent::Y, SwizzleComponent::X, SwizzleComponent::X];
                    value = self.add(Expression::Swizzle { size: naga::VectorSize::Bi, vector: value, pattern });
                }
                if scalar != Scalar::Bool {
                    return value;
                }
                let size = program.types.components(ty).unwrap_or(1) as u8;
                let ty = self.cx.ty(TypeId::vector(Scalar::Uint, size));
                let zero = self.add_preemitted(Expression::ZeroValue(ty));
                self.add(Expression::Binary { op: BinaryOperator::NotEqual, left: value, right: zero })
            }
            _ if std140::is_plain(program, ty) => self.add(Expression::Load { pointer }),
            _ => {
                let in_slot = self.has_slots(ty);
                let parts = (0..program.extent(ty)).map(|index| {
                    let part = program.part(ty, index);
                    let index = self.cx.place_in_struct(ty, index);
                    let pointer = self.add(Expression::AccessIndex { base: pointer, index });
                    let pointer = self.first_of_slot(pointer, ty, part);
                    self.load_parts(pointer, part, in_slot)
                });
                let parts = parts.collect();
                self.compose(ty, parts)
            }
        }
    }
}
