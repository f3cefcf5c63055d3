//! The state of a running program: values, variables and access to them.

use super::{
    layout::{self, Layout, SlotKind},
    number::{Cell, Float},
    world::World,
};
use crate::ir::{FuncId, GlobalId, Module, Value};

/// Pixels that run together: at (0, 0), (1, 0), (0, 1) and (1, 1) of a block of two by two.
pub const LANES: usize = 4;

/// A set of lanes.
pub(super) type Lanes = u8;
pub(super) const ALL: Lanes = 0b1111;

pub(super) fn of(lanes: Lanes) -> impl Iterator<Item = usize> {
    (0..LANES).filter(move |lane| lanes & (1 << lane) != 0)
}

/// One activation of a function.
pub(super) struct Frame<R> {
    pub function: FuncId,
    /// The function's constants, followed by its computed values, lane by lane: everything that can be an operand.
    pub cells: Vec<Cell<R>>,
    /// The cell of each place in the memory of each lane.
    pub places: Vec<[u32; LANES]>,
    /// Lane by lane.
    pub result: Vec<Cell<R>>,
}

impl<R: Float> Frame<R> {
    pub(super) fn new(function: FuncId, layout: &Layout<R>) -> Self {
        let mut cells = layout.constants.clone();
        cells.resize(layout.constants.len() + layout.registers * LANES, Cell::Bits(0));
        let (places, result) = (vec![[0; LANES]; layout.places], vec![Cell::Bits(0); layout.result * LANES]);
        Self { function, cells, places, result }
    }

    /// Resets the frame to its initial state.
    pub(super) fn clear(&mut self, layout: &Layout<R>) {
        self.cells[layout.constants.len()..].fill(Cell::Bits(0));
        self.places.fill([0; LANES]);
        self.result.fill(Cell::Bits(0));
    }
}

/// The program and its memory.
pub(super) struct State<'a, R> {
    pub module: &'a Module,
    pub world: &'a dyn World,
    pub layouts: Vec<Layout<R>>,
    /// The memory of each lane: the variables of the module, then those of each activation.
    pub memory: [Vec<Cell<R>>; LANES],
    /// First cell of each variable of the module.
    pub globals: Vec<usize>,
}

impl<'a, R: Float> State<'a, R> {
    pub(super) fn new(module: &'a Module, world: &'a dyn World) -> Self {
        let layouts = module.functions.iter().map(|function| Layout::new(module, function)).collect();
        Self { module, world, layouts, memory: Default::default(), globals: Vec::new() }
    }

    pub(super) fn layout(&self, frame: &Frame<R>) -> &Layout<R> {
        &self.layouts[frame.function.index()]
    }

    /// Returns the cells of a computed value in a lane.
    pub(super) fn register_mut<'f>(&self, frame: &'f mut Frame<R>, value: Value, lane: usize) -> &'f mut [Cell<R>] {
        let slot = self.layout(frame).slots[value.index()];
        debug_assert!(slot.kind == SlotKind::Register, "{value:?} is computed");
        &mut frame.cells[slot.cells(lane)]
    }

    /// Returns the cells of a value in a lane.
    pub(super) fn value<'f>(&'f self, frame: &'f Frame<R>, value: Value, lane: usize) -> &'f [Cell<R>] {
        let slot = self.layout(frame).slots[value.index()];
        debug_assert!(slot.kind != SlotKind::Place, "{value:?} is an address");
        &frame.cells[slot.cells(lane)]
    }

    /// Returns the cells of a place's contents in a lane.
    pub(super) fn memory(&self, frame: &Frame<R>, place: Value, lane: usize) -> &[Cell<R>] {
        let slot = self.layout(frame).slots[place.index()];
        let start = frame.places[slot.start as usize][lane] as usize;
        &self.memory[lane][start..start + slot.size as usize]
    }

    /// Returns the cells of a variable of the module in a lane.
    pub(super) fn global(&self, global: GlobalId, lane: usize) -> &[Cell<R>] {
        let start = self.globals[global.index()];
        &self.memory[lane][start..start + layout::cells(self.module, self.module[global].ty)]
    }

    pub(super) fn place(&self, frame: &Frame<R>, place: Value) -> [u32; LANES] {
        let slot = self.layout(frame).slots[place.index()];
        debug_assert!(slot.kind == SlotKind::Place, "{place:?} is a value");
        frame.places[slot.start as usize]
    }
}
