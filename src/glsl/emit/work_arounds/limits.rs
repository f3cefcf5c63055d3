//! Hides the limits that loops count down to from drivers that mistake their largest value for their smallest.
//!
//! Mesa's `nir_loop_analyze.c` bounds the iterations of a loop whose counter is compared with `min(c, x)` as if the
//! limit were `c`. This is right for `i < min(c, x)`, but `for (int i = 4; i > min(6, x); i--)` then has no iterations
//! at all. The comparison may be in any exit of the loop, and the `min` in a variable, so each non-constant limit is
//! hidden. A variable that the loop does not change is not a counter: in `i < n` nothing counts down to `i`, and hiding
//! `i` would keep drivers from knowing the number of iterations.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::ir::{
    Binary, Block, Function, GlobalId, Module, Op, Stmt, Unary, Value, VarId,
    analysis::stores,
    rewrite::{self, Rewriter, Rule},
};

pub(super) fn run(program: &mut Module) {
    for index in 0..program.functions.len() {
        let f = &program.functions[index];
        let mut limits = Limits::default();
        limits.note_stores(f, &f.body);
        limits.block(f, &f.body, &[]);
        if !limits.found.is_empty() {
            rewrite::function(program, index, &mut limits);
        }
    }
}

#[derive(Default)]
struct Limits {
    /// Comparisons, and whether their left and right sides are limits: values for which a loop continues while the
    /// other side is greater.
    found: FxHashMap<Value, [bool; 2]>,
    /// The values that variables may have.
    stores: FxHashMap<VarId, Vec<Value>>,
    /// Variables whose tests have been visited, and whether a loop continues if they hold.
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

    /// Visits a block; `loops` are the variables that each enclosing loop changes, the outermost first.
    fn block(&mut self, f: &Function, block: &Block, loops: &[&Written]) {
        for stmt in block {
            if let (Some(innermost), Stmt::If { condition, accept, reject }) = (loops.last(), stmt) {
                for (jump, continues) in [(accept.last(), false), (reject.last(), true)] {
                    let left = match jump {
                        Some(Stmt::Break) => innermost,
                        // It leaves all of them.
                        Some(Stmt::Return(_)) => loops[0],
                        _ => continue,
                    };
                    self.followed.clear();
                    self.compared(f, *condition, continues, left);
                }
            }
            if let Stmt::Loop { body, continuing, break_if } = stmt {
                let written = Written::of(f, [body, continuing]);
                if let Some(condition) = break_if {
                    self.followed.clear();
                    self.compared(f, *condition, false, &written);
                }
                let mut loops = loops.to_vec();
                loops.push(&written);
                self.block(f, body, &loops);
                self.block(f, continuing, &loops);
            } else {
                stmt.blocks(|block| self.block(f, block, loops));
            }
        }
    }

    /// Records the limits in a condition of a loop; `continues` is whether the loop continues if it holds.
    fn compared(&mut self, f: &Function, condition: Value, continues: bool, written: &Written) {
        match f[condition] {
            Op::Unary { op: Unary::LogicalNot, operand } => self.compared(f, operand, !continues, written),
            // For `&&` and `||`, whose sides are stored one after the other, or a test in a variable of the author.
            Op::Load { place } => {
                let Op::Var(var) = f[place] else { return };
                // A variable may be computed from itself.
                if self.followed.insert((var, continues)) {
                    for value in self.stores.get(&var).cloned().unwrap_or_default() {
                        self.compared(f, value, continues, written);
                    }
                }
            }
            Op::Binary { op, left, right } if op.is_comparison() => {
                let is_greater = match op {
                    Binary::Greater | Binary::GreaterEqual => continues,
                    Binary::Less | Binary::LessEqual => !continues,
                    _ => return,
                };
                let (counter, limit) = if is_greater { (left, right) } else { (right, left) };
                if !matches!(f[limit], Op::Literal(..) | Op::Zero(_)) && is_counted(f, counter, written) {
                    self.found.entry(condition).or_default()[usize::from(is_greater)] = true;
                }
            }
            _ => {}
        }
    }
}

/// The variables that a loop writes.
#[derive(Default)]
struct Written {
    /// Those that are stored to or passed to calls.
    roots: FxHashSet<Root>,
    /// Functions may write global variables.
    has_call: bool,
}

/// The variable named by a store or a load.
#[derive(PartialEq, Eq, Hash)]
enum Root {
    Var(VarId),
    Global(GlobalId),
    Param(u32),
}

impl Root {
    fn of(f: &Function, place: Value) -> Option<Root> {
        match f[f.root(place)] {
            Op::Var(var) => Some(Root::Var(var)),
            Op::Global(global) => Some(Root::Global(global)),
            Op::Param(index) => Some(Root::Param(index)),
            _ => None,
        }
    }
}

impl Written {
    fn of(f: &Function, blocks: [&Block; 2]) -> Self {
        let mut written = Self::default();
        for block in blocks {
            stores(f, block, &mut |place| written.roots.extend(Root::of(f, place)));
            written.has_call |= has_call(f, block);
        }
        written
    }

    fn contains(&self, f: &Function, place: Value) -> bool {
        Root::of(f, place)
            .is_some_and(|root| self.has_call && matches!(root, Root::Global(_)) || self.roots.contains(&root))
    }
}

fn has_call(f: &Function, block: &Block) -> bool {
    block.iter().any(|stmt| match stmt {
        Stmt::Let(value) => matches!(f[*value], Op::Call { .. }),
        other => other.any_block(|block| has_call(f, block)),
    })
}

/// Returns whether a value is read from a variable that the loop writes, or has just been stepped.
fn is_counted(f: &Function, value: Value, written: &Written) -> bool {
    let is_counter = |value: Value| matches!(f[value], Op::Load { place } if written.contains(f, place));
    match f[value] {
        Op::Binary { op: Binary::Add | Binary::Subtract, left, right } => is_counter(left) || is_counter(right),
        _ => is_counter(value),
    }
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
