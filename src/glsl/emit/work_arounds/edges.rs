//! Widths between the edges of `smoothstep`, hidden: shaders use it as a step, with edges that are equal.
//!
//! The quotient is then infinite, and is clamped to 0 or 1. Mesa's `nir_opt_algebraic.py` makes a zero of `b - a` once
//! it sees that the two are one value, after it has inlined functions, and a quotient by a known zero is undefined on
//! llvmpipe (`lp_build_div` in `lp_bld_arit.c`). Which edges become equal is not known here, so each width is hidden.
//! Where edges are constants that differ, lowering leaves `smoothstep` to the driver.

use crate::ir::{
    Binary, Function, Math, Module, Op, Value,
    rewrite::{self, Rewriter, Rule},
};

pub(super) fn run(program: &mut Module) {
    for index in 0..program.functions.len() {
        let quotients = quotients(&program.functions[index]);
        if !quotients.is_empty() {
            rewrite::function(program, index, &mut HiddenWidths(quotients));
        }
    }
}

/// Returns the quotients that lowering writes `smoothstep` out with, in order: they are clamped to 0 and 1, which
/// nothing else does by `Saturate`, and their divisor is a difference.
fn quotients(f: &Function) -> Vec<Value> {
    let quotient = |(_, op): (Value, &Op)| {
        let Op::Math { fun: Math::Saturate, arg, .. } = *op else { return None };
        let Op::Binary { op: Binary::Divide, right, .. } = f[arg] else { return None };
        matches!(f[right], Op::Binary { op: Binary::Subtract, .. }).then_some(arg)
    };
    let mut found: Vec<Value> = f.values().filter_map(quotient).collect();
    found.sort_unstable();
    found
}

/// The quotients whose divisor is hidden.
struct HiddenWidths(Vec<Value>);

impl Rule for HiddenWidths {
    fn operation(&mut self, r: &mut Rewriter<'_>, value: Value, op: &Op) -> Option<Value> {
        let Op::Binary { op, left, right } = *op else { return None };
        self.0.binary_search(&value).ok()?;
        let right = r.opaque(right);
        Some(r.add(Op::Binary { op, left, right }))
    }
}
