//! Translates types of the intermediate representation to naga's.

use std::num::NonZeroU32;

use naga::{AddressSpace, ArraySize, Handle, StructMember, TypeInner, VectorSize};

use super::context::Emitter;
use crate::{
    ir::layout::{Layout, round_up},
    types::{Scalar, Type, TypeId},
};

pub(super) fn naga_scalar(scalar: Scalar) -> naga::Scalar {
    match scalar {
        Scalar::Bool => naga::Scalar::BOOL,
        Scalar::Int => naga::Scalar::I32,
        Scalar::Uint => naga::Scalar::U32,
        Scalar::Float => naga::Scalar::F32,
    }
}

/// Converts a size of 2 to 4.
pub(super) fn vector_size(size: usize) -> VectorSize {
    match size {
        2 => VectorSize::Bi,
        3 => VectorSize::Tri,
        _ => VectorSize::Quad,
    }
}

impl Emitter<'_> {
    /// Returns the type with this `inner`, created at most once.
    pub(super) fn insert_type(&mut self, inner: TypeInner) -> Handle<naga::Type> {
        self.out.types.insert(naga::Type { name: None, inner }, naga::Span::UNDEFINED)
    }

    /// Returns a pointer to a variable of a function.
    pub(super) fn pointer_ty(&mut self, id: TypeId) -> Handle<naga::Type> {
        let base = self.ty(id);
        self.insert_type(TypeInner::Pointer { base, space: AddressSpace::Function })
    }

    pub(super) fn layout(&mut self, id: TypeId) -> Layout {
        self.layouts.of(self.ir, id)
    }

    /// Returns naga's type of a value, which is not void, sampler or error.
    pub(super) fn ty(&mut self, id: TypeId) -> Handle<naga::Type> {
        if let Some(made) = self.types[id.0 as usize] {
            return made;
        }
        let inner = match self.ir.types.get(id) {
            Type::Scalar(scalar) => TypeInner::Scalar(naga_scalar(scalar)),
            Type::Vector { scalar, size } => {
                TypeInner::Vector { size: vector_size(size.into()), scalar: naga_scalar(scalar) }
            }
            Type::Matrix { columns, rows } => TypeInner::Matrix {
                columns: vector_size(columns.into()),
                rows: vector_size(rows.into()),
                scalar: naga::Scalar::F32,
            },
            Type::Array { element, len } => {
                let base = self.ty(element);
                let size = ArraySize::Constant(NonZeroU32::new(len).unwrap_or(NonZeroU32::MIN));
                TypeInner::Array { base, size, stride: self.layout(element).stride() }
            }
            Type::Struct(structure) => {
                let ir = self.ir;
                let mut members = Vec::new();
                let mut end = 0u32;
                for &member in &ir.structs[structure.index()] {
                    let ty = self.ty(member);
                    let layout = self.layout(member);
                    let offset = round_up(layout.align, end);
                    members.push(StructMember { name: None, ty, binding: None, offset });
                    end = offset.saturating_add(layout.size);
                }
                TypeInner::Struct { members, span: self.layout(id).size }
            }
            other => unreachable!("{other:?} is no type of a value"),
        };
        let made = self.insert_type(inner);
        self.types[id.0 as usize] = Some(made);
        made
    }
}
