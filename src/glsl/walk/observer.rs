//! Who watches a walk.

use super::{
    number::{Cell, Real},
    state::{Frame, State},
};
use crate::glsl::ir::{FuncId, Function, Module, Op, Value};

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

    /// The cells that a place holds.
    pub fn memory(&self, place: Value) -> &[Cell<R>] {
        self.state.memory(self.frame, place, self.lane)
    }
}

/// Sees each step of one pixel.
pub trait Observer<R> {
    /// A function begins.
    fn enter(&mut self, _: &View<'_, '_, R>) {}

    /// A function has ended.
    fn leave(&mut self, _: &View<'_, '_, R>) {}

    /// A loop begins another turn.
    fn turn(&mut self, _: &View<'_, '_, R>) {}

    /// A value has been computed.
    fn value(&mut self, _: &View<'_, '_, R>, _: Value) {}

    /// A value has been written to a place.
    fn store(&mut self, _: &View<'_, '_, R>, _place: Value, _value: Value) {}
}

/// Sees nothing.
pub struct Nobody;

impl<R> Observer<R> for Nobody {}
