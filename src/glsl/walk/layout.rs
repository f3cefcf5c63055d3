//! The layout of a function's values while it runs: cells, one per scalar, without gaps.

use super::number::{Cell, Float};
use crate::{
    ir::{Function, GlobalId, Module, Op, Value},
    types::{Scalar, Type, TypeId},
};

/// Returns the number of scalars in a value of a type.
pub fn cells(module: &Module, ty: TypeId) -> usize {
    match module.types.get(ty) {
        Type::Void => 0,
        Type::Scalar(_) => 1,
        Type::Struct(_) => (0..module.extent(ty)).map(|i| cells(module, module.part(ty, i))).sum(),
        _ => module.extent(ty) as usize * cells(module, module.part(ty, 0)),
    }
}

/// Returns the number of scalars before a part.
pub(super) fn offset(module: &Module, ty: TypeId, index: u32) -> usize {
    match module.types.get(ty) {
        Type::Struct(_) => (0..index).map(|i| cells(module, module.part(ty, i))).sum(),
        _ => index as usize * cells(module, module.part(ty, 0)),
    }
}

/// Appends a constant, whose words are in memory order.
pub(super) fn constant<R: Float>(
    module: &Module,
    ty: TypeId,
    words: &mut impl Iterator<Item = u32>,
    out: &mut Vec<Cell<R>>,
) {
    match module.types.get(ty) {
        Type::Scalar(scalar) => {
            let word = words.next().expect("as many words as scalars");
            out.push(if scalar == Scalar::Float { Cell::Float(R::from_bits(word)) } else { Cell::Bits(word) });
        }
        _ => (0..module.extent(ty)).for_each(|i| constant(module, module.part(ty, i), words, out)),
    }
}

/// The location of a value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slot {
    pub kind: SlotKind,
    /// The first cell in the frame, of the first lane; for an address the index among the frame's places.
    pub start: u32,
    /// The cells between two lanes: 0 for a constant, which is the same in all.
    pub stride: u32,
    /// The cells of the value; for an address of its target.
    pub size: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SlotKind {
    /// Known statically.
    Constant,
    Register,
    /// An address.
    Place,
}

impl Slot {
    /// Returns the first cell of a value in a lane.
    pub(super) fn first(self, lane: usize) -> usize {
        self.start as usize + lane * self.stride as usize
    }

    pub(super) fn cells(self, lane: usize) -> std::ops::Range<usize> {
        let first = self.first(lane);
        first..first + self.size as usize
    }
}

/// The variable that a place refers to.
#[derive(Clone, Copy, Debug)]
pub(super) enum Root {
    /// A variable of the function: the first cell relative to the base of its memory.
    Var(usize),
    Global(GlobalId),
}

/// The layout of one function, computed once instead of at each step.
pub(super) struct Layout<R> {
    /// By [`Value::index`].
    pub slots: Vec<Slot>,
    /// By [`Value::index`]: the cells before a part, and the cells of one element.
    pub offsets: Vec<u32>,
    /// By [`Value::index`]: the type of the components of a scalar, vector or matrix; floats for anything else.
    pub scalars: Vec<Scalar>,
    /// The constants, at the start of each frame.
    pub constants: Vec<Cell<R>>,
    /// Cells of a frame, for one lane, without constants.
    pub registers: usize,
    pub places: usize,
    /// The parameters.
    pub params: Vec<(u32, Slot)>,
    /// Places that are variables.
    pub roots: Vec<(u32, Root)>,
    /// Variables with an initial constant: the first cell relative to the base of the memory, and the constant.
    pub inits: Vec<(usize, Slot)>,
    /// Cells of all variables together, for one lane.
    pub memory: usize,
    /// Cells of the result.
    pub result: usize,
}

impl<R: Float> Layout<R> {
    pub(super) fn new(module: &Module, function: &Function) -> Self {
        let mut layout = Self {
            slots: Vec::with_capacity(function.len()),
            offsets: Vec::with_capacity(function.len()),
            scalars: Vec::with_capacity(function.len()),
            constants: Vec::new(),
            registers: 0,
            places: 0,
            params: Vec::new(),
            roots: Vec::new(),
            inits: Vec::new(),
            memory: 0,
            result: cells(module, function.result),
        };
        let mut vars = Vec::new();
        for var in &function.vars {
            vars.push(layout.memory);
            layout.memory += cells(module, var.ty);
        }
        for (value, op) in function.values() {
            let slot = layout.slot(module, function, value, op);
            layout.slots.push(slot);
            layout.scalars.push(module.types.scalar(function.ty(value)).unwrap_or(Scalar::Float));
            layout.offsets.push(match *op {
                Op::Part { base, index } => offset(module, function.ty(base), index) as u32,
                Op::Element { base, .. } => cells(module, module.part(function.ty(base), 0)) as u32,
                _ => 0,
            });
            match *op {
                Op::Param(index) => layout.params.push((index, slot)),
                Op::Var(var) => layout.roots.push((slot.start, Root::Var(vars[var.index()]))),
                Op::Global(global) => layout.roots.push((slot.start, Root::Global(global))),
                _ => {}
            }
        }
        for (var, start) in function.vars.iter().zip(vars) {
            let init = var.init.map(|init| layout.slots[init.index()]);
            layout.inits.extend(init.filter(|slot| slot.kind == SlotKind::Constant).map(|slot| (start, slot)));
        }
        // Constants come first, followed by the registers of all lanes.
        let (count, stride) = (layout.constants.len() as u32, layout.registers as u32);
        let params = layout.params.iter_mut().map(|(_, slot)| slot);
        for slot in layout.slots.iter_mut().chain(params).filter(|slot| slot.kind == SlotKind::Register) {
            (slot.start, slot.stride) = (slot.start + count, stride);
        }
        layout
    }

    /// Returns the slot of a value; of a register, relative to the registers.
    fn slot(&mut self, module: &Module, function: &Function, value: Value, op: &Op) -> Slot {
        let ty = function.ty(value);
        if function.is_place(value) {
            self.places += 1;
            let size = cells(module, ty) as u32;
            return Slot { kind: SlotKind::Place, start: self.places as u32 - 1, stride: 0, size };
        }
        let start = self.constants.len();
        match *op {
            Op::Literal(_, bits) => constant(module, ty, &mut [bits].into_iter(), &mut self.constants),
            Op::Zero(_) => constant(module, ty, &mut std::iter::repeat(0), &mut self.constants),
            Op::Const(id) => constant(module, ty, &mut module[id].words.iter().copied(), &mut self.constants),
            _ => {
                let (start, size) = (self.registers as u32, cells(module, ty) as u32);
                self.registers += size as usize;
                return Slot { kind: SlotKind::Register, start, stride: 0, size };
            }
        }
        let size = (self.constants.len() - start) as u32;
        Slot { kind: SlotKind::Constant, start: start as u32, stride: 0, size }
    }
}
