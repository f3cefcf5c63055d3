//! Divisors that may be a zero which is known before a program runs.
//!
//! `x / 0.0` is infinite or NaN on every device, and shaders rely on it: `clamp(0.5 + (b - a) / k, 0.0, 1.0)` with `k =
//! 0.0` chooses a side. Mesa's llvmpipe takes a quotient for undefined once it sees that the divisor is zero
//! (`lp_build_div` in `gallivm/lp_bld_arit.c`), after it has inlined functions, unrolled loops, and folded and spread
//! constants. So what may be such a zero is kept out of its sight: one that is written, or that comes of other constants
//! ([`constants`]), as `1.0 - k` with `k = 1.0`, or `float(i)` in a loop that counts through zero. What is hidden is not
//! folded into its quotient any more, which may change a last bit: so no more is hidden than may be a zero.
//!
//! Shaders also use `smoothstep` as a step, with edges that are equal: the quotient is then infinite, and is clamped to 0
//! or 1. Mesa's `nir_opt_algebraic.py` makes a zero of `b - a` once it sees that the two are one value. Which edges become
//! equal is not known here, so the width of each `smoothstep` that lowering wrote out is hidden; where edges are constants
//! that differ, lowering leaves `smoothstep` to the driver.

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
            constants.look_at_each_call(program, index, &mut divisions);
        }
        let is_width = |division| divisor(program, f, division).is_some() && is_of_smoothstep(f, division.0);
        divisions.iter_mut().zip(f.values()).for_each(|(hides, division)| *hides |= is_width(division));
        if divisions.contains(&true) {
            rewrite::function(program, index, &mut HiddenDivisors(divisions));
        }
    }
}

/// Returns what a division of floats divides by, unless it is a number that is no zero.
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
