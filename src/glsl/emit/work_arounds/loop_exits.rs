//! Loops that begin with an exit: Mesa's gallivm runs a loop until its last pixel leaves, and does not bring it into
//! loop-closed SSA form (`nir_to_lcssa.c`). A value that all exits agree on, and which needs no phi for that, is
//! computed anew for pixels that have left. With an exit before anything changes, each variable that the loop changes
//! has two values at its exits, the one with which a round began and a new one, and needs a phi after the loop.

use crate::ir::{
    Block, Function, Module, Op, Stmt,
    rewrite::{self, Rewriter, Rule},
};

pub(super) fn run(program: &mut Module) {
    rewrite::each_function(program, || LoopExits);
}

struct LoopExits;

impl Rule for LoopExits {
    fn begin_body(&mut self, r: &mut Rewriter<'_>, body: &Block) {
        if !begins_with_exit(&r.f, body) {
            r.seem_to(Stmt::Break);
        }
    }
}

/// Returns whether nothing is written before the first exit.
fn begins_with_exit(f: &Function, body: &Block) -> bool {
    let leaves = |block: &Block| matches!(block.first(), Some(Stmt::Break));
    let first = body.iter().find(|stmt| match stmt {
        Stmt::Let(value) => matches!(f[*value], Op::Call { .. }),
        _ => true,
    });
    matches!(first, Some(Stmt::If { accept, reject, .. }) if leaves(accept) || leaves(reject))
}
