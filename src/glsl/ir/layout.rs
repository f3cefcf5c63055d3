//! The layout of values in memory shared with the device: sizes and alignments of WGSL's storage address space (section
//! 14.4.1 of its specification).

use super::Module;
use crate::types::{Scalar, Type, TypeId};

/// Size and alignment in bytes. Saturating: the validator rejects types that are too large.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    pub size: u32,
    pub align: u32,
}

impl Layout {
    /// Returns the distance between the elements of an array of these.
    pub fn stride(self) -> u32 {
        round_up(self.align, self.size)
    }
}

/// Layouts found so far, by [`TypeId`].
#[derive(Clone, Debug, Default)]
pub struct Layouts(Vec<Option<Layout>>);

impl Layouts {
    /// Returns whether a type is an array or structure that takes the memory of at least this number of scalars.
    pub fn is_aggregate_of(&mut self, module: &Module, ty: TypeId, scalars: u32) -> bool {
        matches!(module.types.get(ty), Type::Array { .. } | Type::Struct(_)) && self.of(module, ty).size >= 4 * scalars
    }

    /// Returns the layout of a type.
    pub fn of(&mut self, module: &Module, ty: TypeId) -> Layout {
        let index = ty.0 as usize;
        if let Some(&Some(found)) = self.0.get(index) {
            return found;
        }
        let layout = match module.types.get(ty) {
            Type::Vector { scalar, size } => {
                Layout { size: width(scalar) * u32::from(size), align: width(scalar) * vector_align(size) }
            }
            Type::Matrix { columns, rows } => {
                let align = 4 * vector_align(rows);
                Layout { size: u32::from(columns) * align, align }
            }
            Type::Array { element, len } => {
                let element = self.of(module, element);
                Layout { size: element.stride().saturating_mul(len), align: element.align }
            }
            Type::Struct(id) => {
                let (mut end, mut align) = (0u32, 1);
                for &member in &module.structs[id.index()] {
                    let layout = self.of(module, member);
                    end = round_up(layout.align, end).saturating_add(layout.size);
                    align = align.max(layout.align);
                }
                Layout { size: round_up(align, end), align }
            }
            Type::Scalar(scalar) => Layout { size: width(scalar), align: width(scalar) },
            other => unreachable!("{other:?} is no type of a value"),
        };
        if self.0.len() <= index {
            self.0.resize(index + 1, None);
        }
        self.0[index] = Some(layout);
        layout
    }
}

pub fn round_up(align: u32, size: u32) -> u32 {
    size.div_ceil(align).saturating_mul(align)
}

/// Returns the size of a scalar in bytes. Buffers never contain bools, so naga's width is sufficient.
fn width(scalar: Scalar) -> u32 {
    if scalar == Scalar::Bool { 1 } else { 4 }
}

/// Returns the alignment of a vector of `size` components, in components.
fn vector_align(size: u8) -> u32 {
    if size == 2 { 2 } else { 4 }
}
