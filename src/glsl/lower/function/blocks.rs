//! Statements and blocks.

use super::Builder;
use crate::ir::{Block, FuncId, Op, Stmt, Value};

impl Builder<'_, '_> {
    pub fn push(&mut self, statement: Stmt) {
        self.ended = matches!(statement, Stmt::Break | Stmt::Continue | Stmt::Return(_) | Stmt::Discard);
        self.block.push(statement);
    }

    /// Reads a place.
    pub fn load(&mut self, place: Value) -> Value {
        self.add(Op::Load { place })
    }

    /// Writes to a place.
    pub fn store(&mut self, place: Value, value: Value) {
        self.push(Stmt::Store { place, value });
    }

    /// Statements that were lowered before.
    pub fn splice(&mut self, mut block: Block) {
        self.block.append(&mut block);
    }

    /// Calls a function; the value of a void one is none.
    pub fn push_call(&mut self, function: FuncId, args: Vec<Value>) -> Value {
        let ty = self.cx.out[function].result;
        self.add_typed(Op::Call { function, args: args.into() }, ty)
    }

    /// Returns a nested block, filled by `fill`, and whether its end cannot be reached.
    pub fn nested(&mut self, fill: impl FnOnce(&mut Self)) -> (Block, bool) {
        let outer = std::mem::take(&mut self.block);
        let outer_ended = std::mem::take(&mut self.ended);
        fill(self);
        let ended = std::mem::replace(&mut self.ended, outer_ended);
        (std::mem::replace(&mut self.block, outer), ended)
    }
}
