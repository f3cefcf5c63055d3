//! Observers of a walk.

use super::{
    layout,
    number::{Cell, Float},
    state::{Frame, LANES, State},
};
use crate::ir::{FuncId, Function, GlobalId, Module, Op, Output, Stmt, Value};
use std::ops::Range;

/// One activation of a function, as seen by the observed pixel.
pub struct View<'v, 'a, R> {
    state: &'v State<'a, R>,
    frame: &'v Frame<R>,
    lane: usize,
}

impl<'v, 'a, R: Float> View<'v, 'a, R> {
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

    /// Returns the cells of a value that is not an address.
    pub fn value(&self, value: Value) -> &[Cell<R>] {
        self.state.value(self.frame, value, self.lane)
    }

    /// Returns the number of cells that a frame of the function has for its values, in one lane.
    pub fn frame_cells(&self) -> usize {
        let layout = self.state.layout(self.frame);
        layout.constants.len() + layout.registers
    }

    /// Returns the cells among [`Self::frame_cells`] that belong to a value other than an address.
    pub fn cells_of(&self, value: Value) -> Range<usize> {
        self.state.layout(self.frame).slots[value.index()].cells(0)
    }

    /// Returns the number of cells before a part of a value or place ([`Op::Part`]); for an element the number of its
    /// own.
    pub fn offset(&self, part: Value) -> usize {
        self.state.layout(self.frame).offsets[part.index()] as usize
    }

    /// Returns the memory cells of the variables of this activation.
    pub fn own_memory(&self) -> Range<usize> {
        let end = self.state.memory[self.lane].len();
        end - self.state.layout(self.frame).memory..end
    }

    /// Returns the memory cells of a variable of the module.
    pub fn global_memory(&self, global: GlobalId) -> Range<usize> {
        let start = self.state.globals[global.index()];
        start..start + layout::cells(self.module(), self.module()[global].ty)
    }

    /// Returns the first cell of a place, by which overlapping places are found.
    pub fn address(&self, place: Value) -> usize {
        self.state.place(self.frame, place)[self.lane] as usize
    }

    /// Returns whether a value is an address.
    pub fn is_place(&self, value: Value) -> bool {
        self.function().is_place(value)
    }

    /// Returns the variable, parameter or global that contains a place, and the number of its cells before the place.
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

    /// Returns the cells of a variable of the module.
    pub fn global(&self, global: GlobalId) -> &[Cell<R>] {
        self.state.global(global, self.lane)
    }

    /// Returns the result of the function, empty if it has none.
    pub fn result(&self) -> &[Cell<R>] {
        let size = self.frame.result.len() / LANES;
        &self.frame.result[self.lane * size..][..size]
    }

    /// Returns the cells of a place's contents.
    pub fn memory(&self, place: Value) -> &[Cell<R>] {
        self.state.memory(self.frame, place, self.lane)
    }
}

/// Receives each step of one pixel.
pub trait Observer<R> {
    /// Called before a function is called with these arguments.
    fn calling(&mut self, _: &View<'_, '_, R>, _arguments: &[Value]) {}

    /// Called at the start of a function.
    fn enter(&mut self, _: &View<'_, '_, R>) {}

    /// Called when a function returns this value, or nothing.
    fn returned(&mut self, _: &View<'_, '_, R>, _: Option<Value>) {}

    /// Called after a function has ended.
    fn leave(&mut self, _: &View<'_, '_, R>) {}

    /// Called at a statement that branches, an `If` or a `Switch`, before [`Self::decide`].
    fn branch(&mut self, _: &View<'_, '_, R>, _: &Stmt) {}

    /// Called when the statement of the innermost open [`Self::branch`] has ended, in any way.
    fn branch_end(&mut self, _: &View<'_, '_, R>) {}

    /// Called at the start of a loop.
    fn loop_start(&mut self, _: &View<'_, '_, R>, _: &Stmt) {}

    /// Called at the start of an iteration.
    fn iteration(&mut self, _: &View<'_, '_, R>) {}

    /// Called when an iteration reaches its `continuing` part.
    fn continuing(&mut self, _: &View<'_, '_, R>) {}

    /// Called when the innermost open loop has ended, in any way.
    fn loop_end(&mut self, _: &View<'_, '_, R>) {}

    /// Called with the cells of a computed value, in one of the lanes, before they are used: they may be changed.
    fn correct(&mut self, _: FuncId, _: Value, _: &mut [Cell<R>]) {}

    /// Called after a value has been computed.
    fn value(&mut self, _: &View<'_, '_, R>, _: Value) {}

    /// Called after a value has been computed from all four pixels although not all of them reached it.
    fn diverged(&mut self, _: &View<'_, '_, R>, _: Value) {}

    /// Called for a value that decides control flow: the condition of a branch, or of the test after an iteration.
    fn decide(&mut self, _: &View<'_, '_, R>, _: Value) {}

    /// Called for a value that the shader outputs.
    fn output(&mut self, _: &View<'_, '_, R>, _: Output, _: Value) {}

    /// Called after a value has been written to a place.
    fn store(&mut self, _: &View<'_, '_, R>, _place: Value, _value: Value) {}
}

/// An observer that does nothing.
pub struct NoObserver;

impl<R> Observer<R> for NoObserver {}
