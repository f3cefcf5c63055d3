//! The state of a program while it runs: values, variables and the way to them.

use super::{
    layout::{self, Layout, Slot},
    number::{Cell, Real},
    world::World,
};
use crate::glsl::ir::{FuncId, GlobalId, Module, Value};

/// Pixels that run together: at (0, 0), (1, 0), (0, 1) and (1, 1) of a block of two by two.
pub const LANES: usize = 4;

/// One activation of a function.
pub struct Frame<R> {
    pub function: FuncId,
    /// Lane by lane.
    pub registers: Vec<Cell<R>>,
    /// The cell of each place in the memory of each lane.
    pub places: Vec<[u32; LANES]>,
    /// Lane by lane.
    pub result: Vec<Cell<R>>,
}

/// The program, and its memory.
pub struct State<'a, R> {
    pub module: &'a Module,
    pub world: &'a dyn World,
    pub layouts: Vec<Layout<R>>,
    /// The memory of each lane: the variables of the module, then those of each activation.
    pub memory: [Vec<Cell<R>>; LANES],
    /// First cell of each variable of the module.
    pub globals: Vec<usize>,
}

impl<'a, R: Real> State<'a, R> {
    pub fn new(module: &'a Module, world: &'a dyn World) -> Self {
        let layouts = module.functions.iter().map(|function| Layout::new(module, function)).collect();
        Self { module, world, layouts, memory: Default::default(), globals: Vec::new() }
    }

    /// Returns the cells of a computed value in a lane.
    pub fn register_mut<'f>(&self, frame: &'f mut Frame<R>, value: Value, lane: usize) -> &'f mut [Cell<R>] {
        let layout = &self.layouts[frame.function.index()];
        let Slot::Register { start, size } = layout.slots[value.index()] else { unreachable!("{value:?} is computed") };
        let start = lane * layout.registers + start as usize;
        &mut frame.registers[start..start + size as usize]
    }

    /// The cells of a value in a lane.
    pub fn value<'f>(&'f self, frame: &'f Frame<R>, value: Value, lane: usize) -> &'f [Cell<R>] {
        let layout = &self.layouts[frame.function.index()];
        match layout.slots[value.index()] {
            Slot::Constant { start, size } => &layout.constants[start as usize..(start + size) as usize],
            Slot::Register { start, size } => {
                let start = lane * layout.registers + start as usize;
                &frame.registers[start..start + size as usize]
            }
            Slot::Place(_) => unreachable!("{value:?} is an address"),
        }
    }

    /// A value is known before the program runs.
    pub fn is_constant(&self, frame: &Frame<R>, value: Value) -> bool {
        matches!(self.layouts[frame.function.index()].slots[value.index()], Slot::Constant { .. })
    }

    /// The cells of what a place holds in a lane.
    pub fn memory(&self, frame: &Frame<R>, place: Value, lane: usize) -> &[Cell<R>] {
        let start = self.place(frame, place)[lane] as usize;
        let size = layout::cells(self.module, self.module[frame.function].ty(place));
        &self.memory[lane][start..start + size]
    }

    /// The cells of a variable of the module in a lane.
    pub fn global(&self, global: GlobalId, lane: usize) -> &[Cell<R>] {
        let start = self.globals[global.index()];
        &self.memory[lane][start..start + layout::cells(self.module, self.module[global].ty)]
    }

    pub fn place(&self, frame: &Frame<R>, place: Value) -> [u32; LANES] {
        match self.layouts[frame.function.index()].slots[place.index()] {
            Slot::Place(index) => frame.places[index as usize],
            _ => unreachable!("{place:?} is a value"),
        }
    }
}
