//! Loops that end because of a counter.

use rustc_hash::FxHashSet;

use super::{
    continues,
    counters::{holding, mirrored},
    leaves, stores,
};
use crate::{
    ir::{Binary, Block, Function, Global, Op, Stmt, Unary, Value, VarId},
    types::{Scalar, TypeId},
};

/// Returns whether a loop ends for all values: an int is compared with a loop-invariant limit, and each iteration adds
/// a constant to it, towards the limit. It may have as many iterations as there are ints.
pub fn ends(globals: &[Global], f: &Function, body: &Block, continuing: &Block, break_if: Option<Value>) -> bool {
    let mut tests = Vec::new();
    for stmt in body.iter().take_while(|stmt| !continues(stmt)) {
        match stmt {
            Stmt::If { condition, reject, .. } if leaves_loop(reject) => all_holding(f, *condition, true, &mut tests),
            Stmt::If { condition, accept, .. } if leaves_loop(accept) => all_holding(f, *condition, false, &mut tests),
            _ => {}
        }
    }
    if let Some(condition) = break_if {
        all_holding(f, condition, false, &mut tests);
    }
    if tests.is_empty() {
        return false;
    }
    let mut iterations = Iterations { globals, f, body, continuing, computed: FxHashSet::default(), calls: false };
    iterations.gather(body);
    iterations.gather(continuing);
    tests.iter().any(|&(op, left, right)| {
        iterations.approaches(left, op, right) || mirrored(op).is_some_and(|op| iterations.approaches(right, op, left))
    })
}

/// As [`holding`], of each side of an `&&` where both are true.
fn all_holding(f: &Function, condition: Value, truth: bool, out: &mut Vec<(Binary, Value, Value)>) {
    match f[condition] {
        Op::Unary { op: Unary::LogicalNot, operand } => all_holding(f, operand, !truth, out),
        Op::Binary { op: Binary::LogicalAnd, left, right } if truth => {
            all_holding(f, left, true, out);
            all_holding(f, right, true, out);
        }
        Op::Binary { op: Binary::Equal, left, right } if !truth => out.push((Binary::NotEqual, left, right)),
        _ => holding(f, condition, truth, out),
    }
}

/// Returns whether every path through a block leaves the enclosing loop.
fn leaves_loop(block: &Block) -> bool {
    leaves(block) && !matches!(block.last(), Some(Stmt::Continue))
}

/// The iterations of a loop.
struct Iterations<'a> {
    globals: &'a [Global],
    f: &'a Function,
    body: &'a Block,
    continuing: &'a Block,
    /// Values computed inside the loop.
    computed: FxHashSet<Value>,
    /// An iteration calls a function, which may write shared memory.
    calls: bool,
}

impl Iterations<'_> {
    fn gather(&mut self, block: &Block) {
        for stmt in block {
            if let Stmt::Let(value) = stmt {
                self.computed.insert(*value);
                self.calls |= matches!(self.f[*value], Op::Call { .. });
            }
            stmt.blocks(|inner| self.gather(inner));
        }
    }

    /// Returns whether `counter`, while this comparison with `limit` is true, comes nearer to it in each iteration.
    fn approaches(&self, counter: Value, op: Binary, limit: Value) -> bool {
        if !matches!(self.f.ty(counter), TypeId::INT | TypeId::UINT) {
            return false;
        }
        let Some(var) = self.loaded_from(counter).or_else(|| self.stored_to(counter)) else { return false };
        let Some(by) = self.step(var) else { return false };
        // Numbers wrap: if no number is beyond the limit, or the counter can step over it, the loop may never end.
        let (min, max) = match self.f.ty(counter) {
            TypeId::INT => (i64::from(i32::MIN), i64::from(i32::MAX)),
            _ => (0, i64::from(u32::MAX)),
        };
        let has_room = |beyond: i64| {
            let limit = match self.f[limit] {
                Op::Literal(Scalar::Int, bits) => i64::from(bits as i32),
                Op::Literal(Scalar::Uint, bits) => i64::from(bits),
                Op::Zero(_) => 0,
                _ => return false,
            };
            (min..=max).contains(&(limit + beyond))
        };
        let counts = match op {
            Binary::Less => by == 1 || (by > 0 && has_room(by - 1)),
            Binary::Greater => by == -1 || (by < 0 && has_room(by + 1)),
            Binary::LessEqual => by > 0 && has_room(by),
            Binary::GreaterEqual => by < 0 && has_room(by),
            // The counter takes every value.
            Binary::NotEqual => by.abs() == 1,
            _ => false,
        };
        counts && self.is_invariant(limit)
    }

    /// Returns the variable that a value of an iteration was loaded from.
    fn loaded_from(&self, value: Value) -> Option<VarId> {
        let Op::Load { place } = self.f[value] else { return None };
        match self.f[place] {
            Op::Var(var) if self.computed.contains(&value) => Some(var),
            _ => None,
        }
    }

    /// Returns the variable that a value is stored to, as in `++i`.
    fn stored_to(&self, value: Value) -> Option<VarId> {
        self.body.iter().find_map(|stmt| match *stmt {
            Stmt::Store { place, value: stored } if stored == value => match self.f[place] {
                Op::Var(var) => Some(var),
                _ => None,
            },
            _ => None,
        })
    }

    /// Returns the amount that each iteration adds to a variable, if it writes nothing else to it.
    fn step(&self, var: VarId) -> Option<i64> {
        if self.writes(Op::Var(var)) != 1 {
            return None;
        }
        let stored = |stmt: &Stmt| match *stmt {
            Stmt::Store { place, value } if self.f[place] == Op::Var(var) => Some(value),
            _ => None,
        };
        // No iteration skips it.
        let whole = self.body.iter().take_while(|stmt| !continues(stmt)).chain(self.continuing);
        let Op::Binary { op, left, right } = self.f[whole.into_iter().find_map(stored)?] else { return None };
        let number = |value: Value| match self.f[value] {
            Op::Literal(Scalar::Int, bits) => Some(i64::from(bits as i32)),
            Op::Literal(Scalar::Uint, bits) => Some(i64::from(bits as i32)),
            _ => None,
        };
        match op {
            Binary::Add if self.loaded_from(left) == Some(var) => number(right),
            Binary::Add if self.loaded_from(right) == Some(var) => number(left),
            Binary::Subtract if self.loaded_from(left) == Some(var) => Some(-number(right)?),
            _ => None,
        }
    }

    /// Counts the statements of an iteration that write to a variable, or to a part of it.
    fn writes(&self, root: Op) -> usize {
        let mut count = 0;
        let mut visit = |place| count += usize::from(self.f[self.f.root(place)] == root);
        stores(self.f, self.body, &mut visit);
        stores(self.f, self.continuing, &mut visit);
        count
    }

    /// Returns whether a value is loop-invariant.
    fn is_invariant(&self, value: Value) -> bool {
        if !self.computed.contains(&value) {
            return true;
        }
        let op = &self.f[value];
        match op {
            Op::Call { .. } => false,
            Op::Load { place } => {
                let root = self.f[self.f.root(*place)].clone();
                let is_shared = match root {
                    Op::Global(global) => !self.globals[global.index()].kind.is_read_only(),
                    Op::Param(_) => true,
                    _ => false,
                };
                self.writes(root) == 0 && !(is_shared && self.calls) && self.are_operands_invariant(&self.f[*place])
            }
            op => self.are_operands_invariant(op),
        }
    }

    fn are_operands_invariant(&self, op: &Op) -> bool {
        let mut all = true;
        op.operands(|operand| all &= self.is_invariant(operand));
        all
    }
}
