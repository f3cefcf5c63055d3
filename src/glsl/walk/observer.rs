//! Observers of a walk.

use super::{
    layout,
    number::{Cell, Real},
    state::{Frame, LANES, State},
};
use crate::ir::{FuncId, Function, GlobalId, Module, Op, Output, Stmt, Value};
use std::ops::Range;

/// One activation of a function, as the pixel that is watched sees it.
pub struct View<'v, 'a, R> {
    state: &'v State<'a, R>,
    frame: &'v Frame<R>,
    lane: usize,
}

impl<'v, 'a, R: Real> View<'v, 'a, R> {
    pub(super) fn new(state: &'v State<'a, R>, frame: &'v Frame<R>, lane: usize) -> Self {
        Self { state, frame, lane }
    }

    pub fn module(&self) -> &'a Module {
        self.state.module
    }

    pub fn function_id(&self) -> FuncId {
        self.frame.function
    }

    pub fn function(&self) -> &'a Function {
        &self.module()[self.frame.function]
    }

    pub fn op(&self, value: Value) -> &'a Op {
        &self.function()[value]
    }

    /// The cells of a value that is no address.
    pub fn value(&self, value: Value) -> &[Cell<R>] {
        self.state.value(self.frame, value, self.lane)
    }

    /// The number of cells that a frame of the function has for its values, in one lane.
    pub fn frame_cells(&self) -> usize {
        let layout = self.state.layout(self.frame);
        layout.constants.len() + layout.registers
    }

    /// The cells among [`Self::frame_cells`] that a value other than an address has for itself.
    pub fn cells_of(&self, value: Value) -> Range<usize> {
        self.state.layout(self.frame).slots[value.index()].cells(0)
    }

    /// The number of cells before a part of a value or place ([`Op::Part`]); of an element the number of its own.
    pub fn offset(&self, part: Value) -> usize {
        self.state.layout(self.frame).offsets[part.index()] as usize
    }

    /// The cells of memory that the variables of this activation have.
    pub fn own_memory(&self) -> Range<usize> {
        let end = self.state.memory[self.lane].len();
        end - self.state.layout(self.frame).memory..end
    }

    /// The cells of memory of a variable of the module.
    pub fn global_memory(&self, global: GlobalId) -> Range<usize> {
        let start = self.state.globals[global.index()];
        start..start + layout::cells(self.module(), self.module()[global].ty)
    }

    /// The first cell of a place, by which places that overlap are told.
    pub fn address(&self, place: Value) -> usize {
        self.state.place(self.frame, place)[self.lane] as usize
    }

    /// A value is an address.
    pub fn is_place(&self, value: Value) -> bool {
        self.function().is_place(value)
    }

    /// The variable, parameter or global that a place lies in, and how many cells of it lie before the place.
    pub fn root(&self, place: Value) -> (Value, usize) {
        let (function, module) = (self.function(), self.module());
        let (mut root, mut before) = (place, 0);
        loop {
            match *self.op(root) {
                Op::Part { base, index } => {
                    before += layout::offset(module, function.ty(base), index);
                    root = base;
                }
                Op::Element { base, index } => {
                    let index = self.value(index)[0].bits().min(module.extent(function.ty(base)) - 1);
                    before += index as usize * layout::cells(module, module.part(function.ty(base), 0));
                    root = base;
                }
                _ => return (root, before),
            }
        }
    }

    /// The cells of a variable of the module.
    pub fn global(&self, global: GlobalId) -> &[Cell<R>] {
        self.state.global(global, self.lane)
    }

    /// Returns the result of the function, as far as it has one.
    pub fn result(&self) -> &[Cell<R>] {
        let size = self.frame.result.len() / LANES;
        &self.frame.result[self.lane * size..][..size]
    }

    /// The cells that a place holds.
    pub fn memory(&self, place: Value) -> &[Cell<R>] {
        self.state.memory(self.frame, place, self.lane)
    }
}

/// Sees each step of one pixel.
pub trait Observer<R> {
    /// A function is about to be called with these arguments.
    fn calling(&mut self, _: &View<'_, '_, R>, _arguments: &[Value]) {}

    /// A function begins.
    fn enter(&mut self, _: &View<'_, '_, R>) {}

    /// A function returns this value, or nothing.
    fn returned(&mut self, _: &View<'_, '_, R>, _: Option<Value>) {}

    /// A function has ended.
    fn leave(&mut self, _: &View<'_, '_, R>) {}

    /// A statement that branches has been reached, an `If` or a `Switch`: before [`Self::decide`].
    fn branch(&mut self, _: &View<'_, '_, R>, _: &Stmt) {}

    /// The statement of the last [`Self::branch`] that is open has ended, by whatever way.
    fn branch_end(&mut self, _: &View<'_, '_, R>) {}

    /// A loop has been reached.
    fn loop_start(&mut self, _: &View<'_, '_, R>, _: &Stmt) {}

    /// A loop begins another turn.
    fn turn(&mut self, _: &View<'_, '_, R>) {}

    /// A turn of a loop comes to the part that a `continue` leads to.
    fn continuing(&mut self, _: &View<'_, '_, R>) {}

    /// The last loop that is open has ended, by whatever way.
    fn loop_end(&mut self, _: &View<'_, '_, R>) {}

    /// The cells of a value that has been computed, in one of the lanes, before anything uses them: they may be made
    /// others.
    fn correct(&mut self, _: FuncId, _: Value, _: &mut [Cell<R>]) {}

    /// A value has been computed.
    fn value(&mut self, _: &View<'_, '_, R>, _: Value) {}

    /// A value has been computed of what all four pixels hold, while not all of them came there.
    fn diverged(&mut self, _: &View<'_, '_, R>, _: Value) {}

    /// A value decides which way is gone: the condition of a branch, or of the test after a turn.
    fn decide(&mut self, _: &View<'_, '_, R>, _: Value) {}

    /// A value is what the shader draws.
    fn output(&mut self, _: &View<'_, '_, R>, _: Output, _: Value) {}

    /// A value has been written to a place.
    fn store(&mut self, _: &View<'_, '_, R>, _place: Value, _value: Value) {}
}

/// Sees nothing.
pub struct NoObserver;

impl<R> Observer<R> for NoObserver {}
