//! GLSL types as naga types. Owns the layout rules naga's validator wants of structs and arrays, which are those of a storage
//! buffer ([`super::tables`]); the uniform block is built by hand in [`super::resources`].

use std::num::NonZeroU32;

use naga::{AddressSpace, ArraySize, Handle, StructMember, TypeInner, VectorSize};

use super::Lowering;
use crate::glsl::hir::{self, Scalar, TypeId};

/// Types made so far, by [`TypeId`].
pub(super) struct Types {
    made: Vec<Option<(Handle<naga::Type>, Layout)>>,
}

/// Bytes, as the storage address space and naga's `Layouter` counts them. Saturating: what is too large, the validator refuses.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    pub size: u32,
    pub align: u32,
}

impl Types {
    pub fn new(count: usize) -> Self {
        Self { made: vec![None; count] }
    }

    pub fn layout_of(&self, ty: Handle<naga::Type>) -> Option<Layout> {
        self.made.iter().flatten().find(|(made, _)| *made == ty).map(|(_, layout)| *layout)
    }
}

pub(super) fn naga_scalar(scalar: Scalar) -> naga::Scalar {
    match scalar {
        Scalar::Bool => naga::Scalar::BOOL,
        Scalar::Int => naga::Scalar::I32,
        Scalar::Uint => naga::Scalar::U32,
        Scalar::Float => naga::Scalar::F32,
    }
}

/// `size` 2 to 4.
pub(super) fn vector_size(size: usize) -> VectorSize {
    match size {
        2 => VectorSize::Bi,
        3 => VectorSize::Tri,
        _ => VectorSize::Quad,
    }
}

pub(super) fn round_up(align: u32, size: u32) -> u32 {
    size.div_ceil(align).saturating_mul(align)
}

/// Alignment of a vector of `size` components of `width` bytes.
fn vector_align(size: u8, width: u32) -> u32 {
    if size == 2 { 2 * width } else { 4 * width }
}

impl Lowering<'_> {
    /// A type of `inner`, made at most once.
    pub fn insert_type(&mut self, inner: TypeInner) -> Handle<naga::Type> {
        self.out.types.insert(naga::Type { name: None, inner }, naga::Span::UNDEFINED)
    }

    /// Of a value type: neither void, sampler nor error.
    pub fn ty(&mut self, id: TypeId) -> Handle<naga::Type> {
        self.laid_out(id).0
    }

    /// A pointer to a variable of a function.
    pub fn pointer_ty(&mut self, id: TypeId) -> Handle<naga::Type> {
        let base = self.ty(id);
        self.insert_type(TypeInner::Pointer { base, space: AddressSpace::Function })
    }

    pub fn laid_out(&mut self, id: TypeId) -> (Handle<naga::Type>, Layout) {
        if let Some(made) = self.types.made[id.0 as usize] {
            return made;
        }
        let (inner, layout) = match self.hir.types.get(id) {
            hir::Type::Scalar(scalar) => {
                let scalar = naga_scalar(scalar);
                let width = u32::from(scalar.width);
                (TypeInner::Scalar(scalar), Layout { size: width, align: width })
            }
            hir::Type::Vector { scalar, size } => {
                let scalar = naga_scalar(scalar);
                let width = u32::from(scalar.width);
                let layout = Layout { size: u32::from(size) * width, align: vector_align(size, width) };
                (TypeInner::Vector { size: vector_size(size.into()), scalar }, layout)
            }
            hir::Type::Matrix { columns, rows } => {
                let align = vector_align(rows, 4);
                let inner = TypeInner::Matrix {
                    columns: vector_size(columns.into()),
                    rows: vector_size(rows.into()),
                    scalar: naga::Scalar::F32,
                };
                (inner, Layout { size: u32::from(columns) * align, align })
            }
            hir::Type::Array { element, len } => {
                let (base, layout) = self.laid_out(element);
                let stride = round_up(layout.align, layout.size);
                let size = ArraySize::Constant(NonZeroU32::new(len).unwrap_or(NonZeroU32::MIN));
                let layout = Layout { size: stride.saturating_mul(len), align: layout.align };
                (TypeInner::Array { base, size, stride }, layout)
            }
            hir::Type::Struct(id) => self.structure(id),
            other => unreachable!("{other:?} is no type of a value"),
        };
        let made = (self.insert_type(inner), layout);
        self.types.made[id.0 as usize] = Some(made);
        made
    }

    fn structure(&mut self, id: hir::StructId) -> (TypeInner, Layout) {
        let hir = self.hir;
        let mut members = Vec::new();
        let (mut end, mut align) = (0, 1);
        for member in &hir[hir[id].members] {
            let (ty, layout) = self.laid_out(member.ty);
            let offset = round_up(layout.align, end);
            members.push(StructMember { name: None, ty, binding: None, offset });
            end = offset.saturating_add(layout.size);
            align = align.max(layout.align);
        }
        let size = round_up(align, end);
        (TypeInner::Struct { members, span: size }, Layout { size, align })
    }
}
