//! Limits that loops count down to, hidden from drivers that take their largest value for their least.
//!
//! Mesa's `nir_loop_analyze.c` bounds the rounds of a loop whose counter is compared with `min(c, x)` as if that were
//! `c`. This is right for `i < min(c, x)`, but `for (int i = 4; i > min(6, x); i--)` then has no round at all. The
//! comparison may lie in any exit of the loop, and the `min` in a variable, so each limit that is no constant is
//! hidden.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::glsl::ir::{
    Binary, Block, Function, Module, Op, Stmt, Unary, Value, VarId,
    rewrite::{self, Rewriter, Rule},
};

pub(super) fn run(program: &mut Module) {
    for index in 0..program.functions.len() {
        let f = &program.functions[index];
        let mut limits = Limits::default();
        limits.note_stores(f, &f.body);
        limits.block(f, &f.body, false);
        if !limits.found.is_empty() {
            rewrite::function(program, index, &mut limits);
        }
    }
}

#[derive(Default)]
struct Limits {
    /// Comparisons, and whether their left and right sides are limits: what something is compared with where a loop goes
    /// on while that is greater.
    found: FxHashMap<Value, [bool; 2]>,
    /// The values that variables may hold.
    stores: FxHashMap<VarId, Vec<Value>>,
    /// Variables whose tests are noted, and whether a loop goes on where they hold.
    followed: FxHashSet<(VarId, bool)>,
}

impl Limits {
    fn note_stores(&mut self, f: &Function, block: &Block) {
        for stmt in block {
            if let Stmt::Store { place, value } = stmt
                && let Op::Var(var) = f[*place]
            {
                self.stores.entry(var).or_default().push(*value);
            }
            stmt.blocks(|block| self.note_stores(f, block));
        }
    }

    fn block(&mut self, f: &Function, block: &Block, in_loop: bool) {
        for stmt in block {
            if let (true, Stmt::If { condition, accept, reject }) = (in_loop, stmt) {
                if leaves(accept) {
                    self.compared(f, *condition, false);
                }
                if leaves(reject) {
                    self.compared(f, *condition, true);
                }
            }
            if let Stmt::Loop { break_if: Some(condition), .. } = stmt {
                self.compared(f, *condition, false);
            }
            let in_loop = in_loop || matches!(stmt, Stmt::Loop { .. });
            stmt.blocks(|block| self.block(f, block, in_loop));
        }
    }

    /// Notes the limits in a condition; `goes_on`: the loop goes on where it holds.
    fn compared(&mut self, f: &Function, condition: Value, goes_on: bool) {
        match f[condition] {
            Op::Unary { op: Unary::LogicalNot, operand } => self.compared(f, operand, !goes_on),
            // Of `&&` and `||`, whose sides are stored one after the other, or a test that the author keeps.
            Op::Load { place } => {
                let Op::Var(var) = f[place] else { return };
                // A variable may be computed from itself.
                if self.followed.insert((var, goes_on)) {
                    for value in self.stores.get(&var).cloned().unwrap_or_default() {
                        self.compared(f, value, goes_on);
                    }
                }
            }
            Op::Binary { op, left, right } if op.is_comparison() => {
                let is_greater = match op {
                    Binary::Greater | Binary::GreaterEqual => goes_on,
                    Binary::Less | Binary::LessEqual => !goes_on,
                    _ => return,
                };
                let (counter, limit) = if is_greater { (left, right) } else { (right, left) };
                if is_counted(f, counter) && !matches!(f[limit], Op::Literal(..) | Op::Zero(_)) {
                    self.found.entry(condition).or_default()[usize::from(is_greater)] = true;
                }
            }
            _ => {}
        }
    }
}

/// Returns whether a value is read from a variable, or has just been stepped.
fn is_counted(f: &Function, value: Value) -> bool {
    let is_load = |value: Value| matches!(f[value], Op::Load { .. });
    match f[value] {
        Op::Binary { op: Binary::Add | Binary::Subtract, left, right } => is_load(left) || is_load(right),
        _ => is_load(value),
    }
}

/// Returns whether a block ends with leaving the loop, or the function.
fn leaves(block: &Block) -> bool {
    matches!(block.last(), Some(Stmt::Break | Stmt::Return(_)))
}

impl Rule for Limits {
    fn operation(&mut self, r: &mut Rewriter<'_>, value: Value, op: &Op) -> Option<Value> {
        let &[hides_left, hides_right] = self.found.get(&value)?;
        let Op::Binary { op, left, right } = *op else { return None };
        let left = if hides_left { r.opaque(left) } else { left };
        let right = if hides_right { r.opaque(right) } else { right };
        Some(r.add(Op::Binary { op, left, right }))
    }
}
