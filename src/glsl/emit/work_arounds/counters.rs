//! Hides counters of nested loops where they index an array.
//!
//! Mesa unrolls a loop that indexes a variable by its counter and has as many iterations as the variable has elements,
//! whatever the cost (`force_unroll_array_access` in `nir_loop_analyze.c`). For a nested loop, as in sorting, that is
//! the square of the number of elements: LLVM takes 15 s for twelve structures of four numbers, and minutes for twenty.

use crate::{
    ir::{
        Block, Module, Op, Value,
        rewrite::{self, Rewriter, Rule},
    },
    types::Type,
};

/// The number of loop bodies that may be unrolled: more than for a matrix, or for an eight by eight kernel.
const MAX_BODIES: u32 = 64;

pub(super) fn run(program: &mut Module) {
    rewrite::each_function(program, Counters::default);
}

#[derive(Default)]
struct Counters {
    /// The number of enclosing loops.
    depth: u32,
}

impl Rule for Counters {
    fn operation(&mut self, r: &mut Rewriter<'_>, value: Value, op: &Op) -> Option<Value> {
        let Op::Element { base, index } = *op else { return None };
        let Type::Array { len, .. } = r.module.types.get(r.f.ty(base)) else { return None };
        let mesa_unrolls = self.depth > 1 && len.saturating_pow(self.depth) > MAX_BODIES;
        if !mesa_unrolls || !r.f.is_place(base) || !matches!(r.f[index], Op::Load { .. }) {
            return None;
        }
        let index = r.opaque(index);
        Some(r.add_typed(Op::Element { base, index }, r.f.ty(value)))
    }

    fn start_body(&mut self, _: &mut Rewriter<'_>, _: &Block) {
        self.depth += 1;
    }

    fn end_body(&mut self) {
        self.depth -= 1;
    }
}
