//! Renumbers values in the order of their statements and drops values that no statement uses.

use super::{Block, Function, Op, Stmt, Value};

impl Function {
    /// Renumbers all values: operands come before their users, and unused values are dropped.
    pub fn compact(&mut self) {
        let mut body = std::mem::take(&mut self.body);
        let mut old = std::mem::replace(self, Function::new(self.result));
        self.params = std::mem::take(&mut old.params);
        let mut vars = std::mem::take(&mut old.vars);
        self.reserve(old.nodes.len());
        let mut compact = Compact { map: vec![None; old.nodes.len()], old, new: self };
        for var in &mut vars {
            var.init = var.init.map(|init| compact.value(init));
        }
        compact.block(&mut body);
        self.vars = vars;
        self.body = body;
    }
}

struct Compact<'a> {
    old: Function,
    new: &'a mut Function,
    map: Vec<Option<Value>>,
}

impl Compact<'_> {
    /// Returns the new number of a value that is free or has been computed.
    fn value(&mut self, old: Value) -> Value {
        if let Some(new) = self.map[old.index()] {
            return new;
        }
        let op = self.take(old);
        debug_assert!(op.is_free(), "{op:?} is used before it is computed");
        self.append(old, op)
    }

    /// Moves an operation out; each is moved once.
    fn take(&mut self, old: Value) -> Op {
        std::mem::replace(&mut self.old.nodes[old.index()].op, Op::OpaqueZero)
    }

    fn append(&mut self, old: Value, op: Op) -> Value {
        let new = self.new.append(op, self.old.ty(old), self.old.origin(old));
        self.map[old.index()] = Some(new);
        new
    }

    fn block(&mut self, block: &mut Block) {
        for stmt in block {
            if let Stmt::Let(value) = stmt {
                let mut op = self.take(*value);
                op.operands_mut(|operand| *operand = self.value(*operand));
                *value = self.append(*value, op);
                continue;
            }
            // The test at the end of a loop is computed inside it.
            if matches!(stmt, Stmt::Loop { .. }) {
                stmt.blocks_mut(|block| self.block(block));
                stmt.operands_mut(|operand| *operand = self.value(*operand));
            } else {
                stmt.operands_mut(|operand| *operand = self.value(*operand));
                stmt.blocks_mut(|block| self.block(block));
            }
        }
    }
}
