//! Places: the memory that a program names, in the blocks and buffers that contain it.
//!
//! In a uniform buffer the elements of an array of scalars and vectors are in slots of 16 bytes: `iChannelTime` and
//! constant tables are read this way.

use naga::{Expression, GlobalVariable, Handle, SwizzleComponent};

use super::{
    context::TablePlace,
    function::Builder,
    resources::{self, CUBE_FACE, TILE_ORIGIN, ZERO},
};
use crate::{
    builtins::Uniform,
    ir::{GlobalId, GlobalKind, Op, Value},
    types::{Type, TypeId},
};

/// A pointer to the slot of an element of a padded array.
enum Slot {
    /// The element itself.
    Whole(Handle<Expression>),
    /// A four-component vector, of which the first two are the element.
    Two(Handle<Expression>),
}

impl Builder<'_, '_> {
    /// Returns the handle of a module-scope variable, or the pointer to it.
    pub(super) fn variable(&mut self, variable: Handle<GlobalVariable>) -> Handle<Expression> {
        // naga generates no instruction for it, so duplicates are harmless.
        self.add_preemitted(Expression::GlobalVariable(variable))
    }

    /// Returns the variable of a global of the program; `None` for a member of a block.
    pub(super) fn global(&mut self, id: GlobalId) -> Option<Handle<GlobalVariable>> {
        match self.cx.ir[id].kind {
            GlobalKind::Private { .. } => Some(self.cx.private_global(id)),
            GlobalKind::Table(table) => match self.cx.table_place(table) {
                TablePlace::Private(variable) => Some(variable),
                TablePlace::Uniform(_) | TablePlace::Storage(_) => None,
            },
            GlobalKind::Uniform(_)
            | GlobalKind::CustomUniform(_)
            | GlobalKind::CubeFace
            | GlobalKind::TileOrigin
            | GlobalKind::Member { .. } => None,
        }
    }

    /// Returns the pointer to a member of a block or buffer.
    pub(super) fn block_member_of(&mut self, id: GlobalId) -> Handle<Expression> {
        let (block, index) = match self.cx.ir[id].kind {
            GlobalKind::Uniform(uniform) => match uniform.geometry_member() {
                Some(index) => (self.cx.geometry_block(), index),
                None => {
                    let (member, name) = resources::uniform(uniform);
                    self.cx.reflection.uniforms.insert(name);
                    (self.cx.block(), member)
                }
            },
            GlobalKind::CustomUniform(slot) => {
                self.cx.reflection.custom_uniforms.insert(slot);
                (self.cx.custom_uniform_block(), slot.into())
            }
            GlobalKind::CubeFace => (self.cx.block(), CUBE_FACE),
            GlobalKind::TileOrigin => (self.cx.block(), TILE_ORIGIN),
            GlobalKind::Member { block, index } => self.cx.block_member(block, index),
            GlobalKind::Table(table) => match self.cx.table_place(table) {
                TablePlace::Uniform(index) => (self.cx.uniform_tables(), index),
                TablePlace::Storage(index) => (self.cx.storage_tables(), index),
                TablePlace::Private(_) => unreachable!("it is a variable of its own"),
            },
            GlobalKind::Private { .. } => unreachable!("it is a variable of its own"),
        };
        let is_face = self.cx.ir[id].kind == GlobalKind::CubeFace;
        let base = self.variable(block);
        let pointer = self.add(Expression::AccessIndex { base, index });
        if is_face { self.add(Expression::AccessIndex { base: pointer, index: 0 }) } else { pointer }
    }

    /// Returns whether the elements of this array are in slots.
    fn is_padded(&mut self, place: Value) -> bool {
        let Op::Global(id) = self.ir[place] else { return false };
        match self.cx.ir[id].kind {
            GlobalKind::Uniform(uniform) => uniform == Uniform::ChannelTime,
            GlobalKind::Table(table) => matches!(self.cx.table_place(table), TablePlace::Uniform(_)),
            _ => false,
        }
    }

    /// Returns the pointer to a part of a place; `None` for an element that is only a part of its slot.
    pub(super) fn part_of_place(&mut self, place: Value) -> Option<Handle<Expression>> {
        let ir = self.ir;
        let (Op::Part { base, .. } | Op::Element { base, .. }) = ir[place] else { unreachable!("it has a base") };
        if self.is_in_block(place) {
            return Some(self.part_in_block(place));
        }
        if self.is_padded(base) {
            return match self.slot(place) {
                Slot::Whole(pointer) => Some(pointer),
                Slot::Two(_) => None,
            };
        }
        let base = match ir[base] {
            // A component of a two-component vector in a slot of four.
            Op::Part { base: array, .. } | Op::Element { base: array, .. } if self.is_padded(array) => {
                match self.slot(base) {
                    Slot::Whole(pointer) | Slot::Two(pointer) => pointer,
                }
            }
            _ => self.value(base),
        };
        Some(match ir[place] {
            Op::Part { index, .. } => self.add(Expression::AccessIndex { base, index }),
            Op::Element { index, .. } => {
                let index = self.value(index);
                self.add(Expression::Access { base, index })
            }
            _ => unreachable!("seen above"),
        })
    }

    /// Returns the slot of an element of a padded array.
    fn slot(&mut self, element: Value) -> Slot {
        let ir = self.ir;
        let (base, pointer) = match ir[element] {
            Op::Part { base, index } => {
                let array = self.value(base);
                (base, self.add(Expression::AccessIndex { base: array, index }))
            }
            Op::Element { base, index } => {
                let (array, index) = (self.value(base), self.value(index));
                (base, self.add(Expression::Access { base: array, index }))
            }
            _ => unreachable!("an element has an index"),
        };
        debug_assert!(self.is_padded(base));
        self.within_slot(pointer, ir.ty(element))
    }

    fn within_slot(&mut self, pointer: Handle<Expression>, ty: TypeId) -> Slot {
        match self.cx.ir.types.get(ty) {
            Type::Scalar(_) => Slot::Whole(self.add(Expression::AccessIndex { base: pointer, index: 0 })),
            Type::Vector { size: 2, .. } => Slot::Two(pointer),
            _ => Slot::Whole(pointer),
        }
    }

    fn load_slot(&mut self, slot: Slot) -> Handle<Expression> {
        match slot {
            Slot::Whole(pointer) => self.add(Expression::Load { pointer }),
            Slot::Two(pointer) => {
                let vector = self.add(Expression::Load { pointer });
                let pattern = [SwizzleComponent::X, SwizzleComponent::Y, SwizzleComponent::X, SwizzleComponent::X];
                self.add(Expression::Swizzle { size: naga::VectorSize::Bi, vector, pattern })
            }
        }
    }

    /// Loads the contents of a place.
    pub(super) fn load(&mut self, place: Value) -> Handle<Expression> {
        let ir = self.ir;
        if self.is_in_block(place) {
            return self.load_in_block(place);
        }
        if self.is_padded(place) {
            let Type::Array { element, len } = self.cx.ir.types.get(ir.ty(place)) else {
                unreachable!("only arrays are padded")
            };
            let base = self.value(place);
            let parts = (0..len).map(|index| {
                let pointer = self.add(Expression::AccessIndex { base, index });
                let slot = self.within_slot(pointer, element);
                self.load_slot(slot)
            });
            let parts = parts.collect();
            return self.compose(ir.ty(place), parts);
        }
        if let Op::Part { base, .. } | Op::Element { base, .. } = ir[place]
            && self.is_padded(base)
        {
            let slot = self.slot(place);
            return self.load_slot(slot);
        }
        let pointer = self.value(place);
        self.add(Expression::Load { pointer })
    }

    /// Returns the int that is always zero, although the driver cannot know it: a uniform or, if the driver recompiles
    /// for each value of uniforms, the value computed by the entry point.
    pub(super) fn opaque_zero(&mut self) -> Handle<Expression> {
        let is_made = self.cx.source.driver.opaque_uniforms || self.cx.source.kind.is_plain();
        let pointer = if is_made {
            let variable = self.cx.opaque_zero();
            self.variable(variable)
        } else {
            let block = self.cx.block();
            let base = self.variable(block);
            let (member, component) = ZERO;
            let pad = self.add(Expression::AccessIndex { base, index: member });
            self.add(Expression::AccessIndex { base: pad, index: component })
        };
        self.add(Expression::Load { pointer })
    }
}
