//! Adds a discard that is never executed to fragment stages.
//!
//! Mesa's llvmpipe returns early from its conversion of colours to 16-bit floats if a fragment fails the depth test
//! (`generate_unswizzled_blend` in `lp_state_fs.c`), and then no longer treats denormal numbers as zeros. Programs that
//! may discard test depth in a different way.

use crate::ir::{
    Module, Stmt,
    rewrite::{self, Rewriter, Rule},
};

pub(super) fn run(program: &mut Module) {
    let entry = program.functions.len() - 1;
    rewrite::function(program, entry, &mut MayDiscard);
}

struct MayDiscard;

impl Rule for MayDiscard {
    fn start(&mut self, r: &mut Rewriter<'_>) {
        r.push_untaken_jump(Stmt::Discard);
    }
}
