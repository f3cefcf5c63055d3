//! Statements and blocks, and what of memory is known in them.

use naga::{Block, Range, Span, Statement};

use super::Builder;

impl Builder<'_, '_> {
    pub(super) fn emit(&mut self) {
        if let Some((first, last)) = self.unemitted.take() {
            self.block.push(Statement::Emit(Range::new_from_bounds(first, last)), Span::UNDEFINED);
        }
    }

    pub fn push(&mut self, statement: Statement) {
        self.emit();
        match &statement {
            Statement::Store { pointer, .. } => self.forget(*pointer),
            Statement::Call { arguments, .. } => {
                for &pointer in arguments {
                    self.forget(pointer);
                }
                self.forget_globals();
                self.run = self.f.expressions.len();
            }
            Statement::If { .. } | Statement::Loop { .. } | Statement::Switch { .. } => {
                self.run = self.f.expressions.len();
            }
            _ => {}
        }
        self.ended =
            matches!(statement, Statement::Break | Statement::Continue | Statement::Return { .. } | Statement::Kill);
        self.block.push(statement, Span::UNDEFINED);
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
        self.emit();
        let outer = std::mem::take(&mut self.block);
        let outer_ended = std::mem::take(&mut self.ended);
        let made = self.made_in_order.len();
        self.run = self.f.expressions.len();
        fill(self);
        self.emit();
        for key in self.made_in_order.drain(made..) {
            self.made.remove(&key);
        }
        let ended = std::mem::replace(&mut self.ended, outer_ended);
        (std::mem::replace(&mut self.block, outer), ended)
    }
}
