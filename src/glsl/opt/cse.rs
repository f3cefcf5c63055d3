//! Common subexpressions: what was computed before, with the same operands, is not computed again.

use rustc_hash::FxHashMap;

use crate::glsl::ir::rewrite::{self, Rewriter, Rule};
use crate::glsl::ir::{Module, Op, Value};

pub(super) fn run(module: &mut Module) {
    rewrite::each_function(module, |_, _| Cse::default());
}

/// What tells pure operations apart: kind, operator, operands.
type Key = (u8, u32, [Option<Value>; 4]);

/// `None` for what may be another value each time, and for what costs no instruction.
fn key(op: &Op) -> Option<Key> {
    Some(match *op {
        Op::Binary { op, left, right } => (0, op as u32, [Some(left), Some(right), None, None]),
        Op::Part { base, index } => (1, index, [Some(base), None, None, None]),
        Op::Unary { op, operand } => (2, op as u32, [Some(operand), None, None, None]),
        Op::Math { fun, arg, arg1, arg2, arg3 } => (3, fun as u32, [Some(arg), arg1, arg2, arg3]),
        Op::Splat { size, value } => (4, size.into(), [Some(value), None, None, None]),
        Op::Convert { value, to } => (5, to as u32, [Some(value), None, None, None]),
        Op::Select { condition, accept, reject } => (6, 0, [Some(condition), Some(accept), Some(reject), None]),
        Op::OpaqueZero => (7, 0, [None; 4]),
        _ => return None,
    })
}

/// Operations of the block at hand and of those around it.
#[derive(Default)]
struct Cse {
    made: FxHashMap<Key, Value>,
    in_order: Vec<Key>,
    /// How many there were as each block began.
    outer: Vec<usize>,
}

impl Rule for Cse {
    fn operation(&mut self, _: &mut Rewriter<'_>, value: Value, op: &Op) -> Option<Value> {
        let key = key(op)?;
        if let Some(&made) = self.made.get(&key) {
            return Some(made);
        }
        self.made.insert(key, value);
        self.in_order.push(key);
        None
    }

    fn enter(&mut self) {
        self.outer.push(self.in_order.len());
    }

    fn leave(&mut self, _: &Rewriter<'_>) {
        let first = self.outer.pop().expect("a block was entered");
        for key in self.in_order.drain(first..) {
            self.made.remove(&key);
        }
    }
}
