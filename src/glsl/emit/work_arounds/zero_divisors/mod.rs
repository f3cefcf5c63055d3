//! Hides divisors that may be a zero that is known at compile time.
//!
//! `x / 0.0` is infinite or NaN on every device, and shaders rely on it: `clamp(0.5 + (b - a) / k, 0.0, 1.0)` with `k =
//! 0.0` selects a side. Mesa's llvmpipe treats a quotient as undefined once it knows that the divisor is zero
//! (`lp_build_div` in `gallivm/lp_bld_arit.c`), after inlining functions, unrolling loops, and folding and propagating
//! constants. Therefore divisors that may be such a zero are hidden from it: literal zeros, and those computed from
//! other constants ([`constants`]), as `1.0 - k` with `k = 1.0`, or `float(i)` in a loop that counts through zero. A
//! hidden divisor is no longer folded into its quotient, which may change a last bit: so only those that may be a zero
//! are hidden.
//!
//! Shaders also use `smoothstep` as a step, with equal edges: the quotient is then infinite, and is clamped to 0 or 1.
//! Mesa's `nir_opt_algebraic.py` replaces `b - a` with zero once it knows that the two are one value. Which edges
//! become equal is not known here, so the width of each `smoothstep` that lowering expanded is hidden; where edges are
//! constants that differ, lowering leaves `smoothstep` to the driver.

mod constants;
mod same;
mod state;

use self::constants::Constants;
use crate::{
    builtins::Operation,
    ir::{
        Binary, Function, Module, Op, Value,
        rewrite::{self, Rewriter, Rule},
    },
    types::Scalar,
};

pub(super) fn run(program: &mut Module) {
    let divides = |f: &Function| f.values().any(|division| divisor(program, f, division).is_some());
    if !program.functions.iter().any(divides) {
        return;
    }
    let mut constants = Constants::of(program);
    for index in 0..program.functions.len() {
        let f = &program.functions[index];
        let hides =
            |division| divisor(program, f, division).is_some_and(|it| constants.may_be_zero(program, index, it));
        let mut divisions: Vec<bool> = f.values().map(hides).collect();
        if divisions.contains(&true) {
            constants.analyse_call_sites(program, index, &mut divisions);
        }
        let is_width = |division| divisor(program, f, division).is_some() && is_of_smoothstep(f, division.0);
        divisions.iter_mut().zip(f.values()).for_each(|(hides, division)| *hides |= is_width(division));
        if divisions.contains(&true) {
            rewrite::function(program, index, &mut HiddenDivisors(divisions));
        }
    }
}

/// Returns the divisor of a float division, unless it is a nonzero literal.
fn divisor(program: &Module, f: &Function, (value, op): (Value, &Op)) -> Option<Value> {
    let Op::Binary { op: Binary::Divide, right, .. } = *op else { return None };
    let is_of_floats = program.types.scalar(f.ty(value)) == Some(Scalar::Float);
    let is_number = matches!(f[right], Op::Literal(_, bits) if bits << 1 != 0);
    (is_of_floats && !is_number).then_some(right)
}

fn is_of_smoothstep(f: &Function, value: Value) -> bool {
    f.origin(value).builtin.is_some_and(|builtin| builtin.operation == Operation::Smoothstep)
}

/// Divisions whose divisor is hidden, by [`Value::index`].
struct HiddenDivisors(Vec<bool>);

impl Rule for HiddenDivisors {
    fn operation(&mut self, r: &mut Rewriter<'_>, value: Value, op: &Op) -> Option<Value> {
        let Op::Binary { op, left, right } = *op else { return None };
        if !self.0[value.index()] {
            return None;
        }
        let right = r.opaque(right);
        Some(r.add(Op::Binary { op, left, right }))
    }
}
