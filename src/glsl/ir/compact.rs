//! Values in the order of their statements, and none that no statement names.

use super::{Block, Function, Op, Stmt, Value};

impl Function {
    /// Numbers all values anew: operands come before what uses them, and what is not used is gone.
    pub fn compact(&mut self) {
        let mut body = std::mem::take(&mut self.body);
        let old = std::mem::replace(self, Function { vars: Vec::new(), ..Function::new(self.result) });
        self.params = old.params.clone();
        self.ops.reserve(old.len());
        let mut compact = Compact { map: vec![None; old.len()], old: &old, new: self };
        let vars = old.vars.iter().map(|var| super::Var { init: var.init.map(|init| compact.value(init)), ..*var });
        let vars = vars.collect();
        compact.block(&mut body);
        self.vars = vars;
        self.body = body;
    }
}

struct Compact<'a> {
    old: &'a Function,
    new: &'a mut Function,
    map: Vec<Option<Value>>,
}

impl Compact<'_> {
    /// The new number of a value that is free, or was computed.
    fn value(&mut self, old: Value) -> Value {
        if let Some(new) = self.map[old.index()] {
            return new;
        }
        let op = self.old[old].clone();
        debug_assert!(op.is_free(), "{op:?} is used before it is computed");
        self.append(old, op)
    }

    fn append(&mut self, old: Value, op: Op) -> Value {
        let new = self.new.append(op, self.old.ty(old), self.old.loc(old));
        self.map[old.index()] = Some(new);
        new
    }

    fn block(&mut self, block: &mut Block) {
        for stmt in block {
            match stmt {
                Stmt::Let(value) => {
                    let mut op = self.old[*value].clone();
                    op.operands_mut(|operand| *operand = self.value(*operand));
                    *value = self.append(*value, op);
                }
                Stmt::Store { place, value } => {
                    *place = self.value(*place);
                    *value = self.value(*value);
                }
                Stmt::If { condition, accept, reject } => {
                    *condition = self.value(*condition);
                    self.block(accept);
                    self.block(reject);
                }
                Stmt::Loop { body, continuing, break_if } => {
                    self.block(body);
                    self.block(continuing);
                    *break_if = break_if.map(|value| self.value(value));
                }
                Stmt::Switch { selector, cases } => {
                    *selector = self.value(*selector);
                    cases.iter_mut().for_each(|case| self.block(&mut case.body));
                }
                Stmt::Return(value) => *value = value.map(|value| self.value(value)),
                Stmt::Output(parts) => parts.iter_mut().for_each(|(_, value)| *value = self.value(*value)),
                Stmt::Break | Stmt::Continue | Stmt::Discard => {}
            }
        }
    }
}
