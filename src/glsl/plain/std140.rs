//! The layout std140 (section 2.12.6.4 of the OpenGL ES 3.0 specification).

use crate::{
    ir::{
        Module,
        layout::{Layout, round_up},
    },
    types::{Scalar, Type, TypeId},
};

/// The alignment of arrays, structures and the columns of matrices.
pub(crate) const SLOT: u32 = 16;

/// Returns the layout of a type in bytes. Saturating, because the author chooses the sizes of arrays.
pub(crate) fn layout(module: &Module, ty: TypeId) -> Layout {
    match module.types.get(ty) {
        Type::Scalar(_) => Layout { size: 4, align: 4 },
        Type::Vector { size: 2, .. } => Layout { size: 8, align: 8 },
        Type::Vector { size, .. } => Layout { size: 4 * u32::from(size), align: SLOT },
        Type::Matrix { columns, .. } => Layout { size: SLOT * u32::from(columns), align: SLOT },
        Type::Array { element, len } => Layout { size: array_stride(module, element).saturating_mul(len), align: SLOT },
        Type::Struct(id) => {
            let size = offsets(module, &module.structs[id.index()]).1;
            Layout { size, align: SLOT }
        }
        other => unreachable!("{other:?} is no type of a value"),
    }
}

/// Returns the bytes from one element of an array to the next.
pub(crate) fn array_stride(module: &Module, element: TypeId) -> u32 {
    round_up(SLOT, layout(module, element).size)
}

/// Returns the offset of each member of a structure, and its size, a multiple of 16.
pub(crate) fn offsets(module: &Module, members: &[TypeId]) -> (Vec<u32>, u32) {
    let mut end = 0u32;
    let offsets = members.iter().map(|&member| {
        let layout = layout(module, member);
        let offset = round_up(layout.align, end);
        end = offset.saturating_add(layout.size);
        offset
    });
    let offsets = offsets.collect();
    (offsets, round_up(SLOT, end))
}

/// Returns whether a value has the same layout in a buffer as in memory, so that it can be loaded as a whole; for an
/// element of an array or a column of a matrix, whether it has in its slot.
pub(crate) fn is_plain(module: &Module, ty: TypeId) -> bool {
    match module.types.get(ty) {
        Type::Scalar(scalar) | Type::Vector { scalar, .. } => scalar != Scalar::Bool,
        Type::Matrix { rows, .. } => rows > 2,
        Type::Array { element, .. } => {
            let fills_slots = match module.types.get(element) {
                Type::Scalar(_) => false,
                Type::Vector { size, .. } => size > 2,
                _ => true,
            };
            fills_slots && is_plain(module, element)
        }
        _ => false,
    }
}
