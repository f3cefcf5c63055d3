//! Adds an exit at the start of loops: Mesa's gallivm runs a loop until its last pixel leaves, and does not convert it
//! to loop-closed SSA form (`nir_to_lcssa.c`). A value that is the same at all exits, and therefore needs no phi, is
//! recomputed for pixels that have already left. With an exit before anything changes, each variable that the loop
//! changes has two values at its exits, that at the start of an iteration and a new one, and needs a phi after the
//! loop.

use crate::ir::{
    Block, Function, Module, Op, Stmt,
    rewrite::{self, Rewriter, Rule},
};

pub(super) fn run(program: &mut Module) {
    rewrite::each_function(program, || LoopExits);
}

struct LoopExits;

impl Rule for LoopExits {
    fn start_body(&mut self, r: &mut Rewriter<'_>, body: &Block) {
        if !starts_with_exit(&r.f, body) {
            r.push_untaken_jump(Stmt::Break);
        }
    }
}

/// Returns whether nothing is written before the first exit.
fn starts_with_exit(f: &Function, body: &Block) -> bool {
    let leaves = |block: &Block| matches!(block.first(), Some(Stmt::Break));
    let first = body.iter().find(|stmt| match stmt {
        Stmt::Let(value) => matches!(f[*value], Op::Call { .. }),
        _ => true,
    });
    matches!(first, Some(Stmt::If { accept, reject, .. }) if leaves(accept) || leaves(reject))
}
