//! The layout of a function's values while it runs: cells, one a scalar, without gaps.

use super::number::{Cell, Real};
use crate::glsl::{
    ir::{Function, Module, Op, Value},
    types::{Scalar, Type, TypeId},
};

/// The number of scalars in a value of a type.
pub fn cells(module: &Module, ty: TypeId) -> usize {
    match module.types.get(ty) {
        Type::Void => 0,
        Type::Scalar(_) => 1,
        Type::Struct(_) => (0..module.extent(ty)).map(|i| cells(module, module.part(ty, i))).sum(),
        _ => module.extent(ty) as usize * cells(module, module.part(ty, 0)),
    }
}

/// The number of scalars before a part.
pub fn offset(module: &Module, ty: TypeId, index: u32) -> usize {
    match module.types.get(ty) {
        Type::Struct(_) => (0..index).map(|i| cells(module, module.part(ty, i))).sum(),
        _ => index as usize * cells(module, module.part(ty, 0)),
    }
}

/// Appends a constant, whose words lie in memory order.
pub fn constant<R: Real>(module: &Module, ty: TypeId, words: &mut impl Iterator<Item = u32>, out: &mut Vec<Cell<R>>) {
    match module.types.get(ty) {
        Type::Scalar(scalar) => {
            let word = words.next().expect("as many words as scalars");
            out.push(if scalar == Scalar::Float { Cell::Float(R::from_bits(word)) } else { Cell::Bits(word) });
        }
        _ => (0..module.extent(ty)).for_each(|i| constant(module, module.part(ty, i), words, out)),
    }
}

/// The place of a value.
#[derive(Clone, Copy, Debug)]
pub enum Slot {
    /// Among the function's constants, from a cell on.
    Constant { start: u32, size: u32 },
    /// In the frame of each lane, from a cell on.
    Register { start: u32, size: u32 },
    /// Among the frame's places: a value that is an address.
    Place(u32),
}

/// The layout of one function.
pub struct Layout<R> {
    /// By [`Value::index`].
    pub slots: Vec<Slot>,
    pub constants: Vec<Cell<R>>,
    /// Cells of a frame, of one lane.
    pub registers: usize,
    pub places: usize,
    /// The first cell of each variable, behind the base of the frame's memory.
    pub vars: Vec<usize>,
    /// Cells of all variables together, of one lane.
    pub memory: usize,
}

impl<R: Real> Layout<R> {
    pub fn new(module: &Module, function: &Function) -> Self {
        let mut layout =
            Self { slots: Vec::new(), constants: Vec::new(), registers: 0, places: 0, vars: Vec::new(), memory: 0 };
        for var in &function.vars {
            layout.vars.push(layout.memory);
            layout.memory += cells(module, var.ty);
        }
        for (value, op) in function.values() {
            let slot = layout.slot(module, function, value, op);
            layout.slots.push(slot);
        }
        layout
    }

    fn slot(&mut self, module: &Module, function: &Function, value: Value, op: &Op) -> Slot {
        let ty = function.ty(value);
        if function.is_place(value) {
            self.places += 1;
            return Slot::Place(self.places as u32 - 1);
        }
        let start = self.constants.len();
        match *op {
            Op::Literal(_, bits) => constant(module, ty, &mut [bits].into_iter(), &mut self.constants),
            Op::Zero(_) => constant(module, ty, &mut std::iter::repeat(0), &mut self.constants),
            Op::Const(id) => constant(module, ty, &mut module[id].words.iter().copied(), &mut self.constants),
            _ => {
                let (start, size) = (self.registers as u32, cells(module, ty) as u32);
                self.registers += size as usize;
                return Slot::Register { start, size };
            }
        }
        Slot::Constant { start: start as u32, size: (self.constants.len() - start) as u32 }
    }
}
