//! A discard that never is, in fragment stages.
//!
//! Mesa's llvmpipe leaves its conversion of colours to 16-bit floats early where a fragment fails the depth test
//! (`generate_unswizzled_blend` in `lp_state_fs.c`), and no longer takes denormal numbers for zeros then. Programs that
//! may discard test depth on another way.

use crate::ir::{
    Module, Stmt,
    rewrite::{self, Rewriter, Rule},
};

pub(super) fn run(program: &mut Module) {
    let entry = program.functions.len() - 1;
    rewrite::function(program, entry, &mut SeemToDiscard);
}

struct SeemToDiscard;

impl Rule for SeemToDiscard {
    fn begin(&mut self, r: &mut Rewriter<'_>) {
        r.seem_to(Stmt::Discard);
    }
}
