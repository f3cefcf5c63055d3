//! Statements and blocks, and what of memory is known in them.

use super::Builder;
use crate::glsl::ir::{Block, Op, Stmt};

impl Builder<'_, '_> {
    pub fn push(&mut self, statement: Stmt) {
        match &statement {
            Stmt::Store { place, .. } => self.forget(*place),
            Stmt::If { .. } | Stmt::Loop { .. } | Stmt::Switch { .. } => self.run = self.f.len(),
            _ => {}
        }
        self.ended = matches!(statement, Stmt::Break | Stmt::Continue | Stmt::Return(_) | Stmt::Discard);
        self.block.push(statement);
    }

    /// Statements that were lowered before.
    pub fn splice(&mut self, mut block: Block) {
        self.run = self.f.len();
        self.block.append(&mut block);
    }

    /// Calls a function; the value of a void one is none.
    pub fn push_call(&mut self, function: crate::glsl::ir::FuncId, args: Vec<super::Value>) -> super::Value {
        let ty = self.cx.out[function].result;
        let value = self.add_typed(Op::Call { function, args: args.clone().into() }, ty);
        for place in args {
            self.forget(place);
        }
        self.forget_globals();
        self.run = self.f.len();
        value
    }

    /// A nested block, filled by `fill`, before which nothing is known of memory. Tells also whether its end can not be reached.
    pub fn nested(&mut self, fill: impl FnOnce(&mut Self)) -> (Block, bool) {
        let loaded = std::mem::take(&mut self.loaded);
        let loaded_globals = std::mem::take(&mut self.loaded_globals);
        let before = self.loaded_in_order.len();
        let written = std::mem::take(&mut self.written);
        let globals_written = std::mem::take(&mut self.globals_written);
        let made = self.block_of(fill);
        self.loaded_in_order.truncate(before);
        self.loaded = loaded;
        self.loaded_globals = loaded_globals;
        let within = std::mem::replace(&mut self.written, written);
        for variable in &within {
            self.loaded.remove(variable);
            self.loaded_globals.remove(variable);
        }
        self.written.extend(within);
        if self.globals_written {
            self.forget_globals();
        }
        self.globals_written |= globals_written;
        made
    }

    /// A nested block where what was known before it still holds: a branch, or a loop's body after
    /// [`Builder::forget_written`].
    pub fn branch_block(&mut self, fill: impl FnOnce(&mut Self)) -> (Block, bool) {
        let before = self.loaded_in_order.len();
        let made = self.block_of(fill);
        // What was written in it is forgotten already.
        for (variable, pointer) in self.loaded_in_order.drain(before..) {
            if let Some(parts) = self.loaded.get_mut(&variable) {
                parts.remove(&pointer);
            }
        }
        made
    }

    fn block_of(&mut self, fill: impl FnOnce(&mut Self)) -> (Block, bool) {
        let outer = std::mem::take(&mut self.block);
        let outer_ended = std::mem::take(&mut self.ended);
        let made = self.made_in_order.len();
        self.run = self.f.len();
        fill(self);
        for key in self.made_in_order.drain(made..) {
            self.made.remove(&key);
        }
        let ended = std::mem::replace(&mut self.ended, outer_ended);
        (std::mem::replace(&mut self.block, outer), ended)
    }
}
