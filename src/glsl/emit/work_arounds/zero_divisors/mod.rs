//! Divisors that may be a zero which is known before a program runs.
//!
//! `x / 0.0` is infinite or NaN on every device, and shaders rely on it: `clamp(0.5 + (b - a) / k, 0.0, 1.0)` with `k =
//! 0.0` chooses a side. Mesa's llvmpipe takes a quotient for undefined once it sees that the divisor is zero
//! (`lp_build_div` in `gallivm/lp_bld_arit.c`), after it has inlined functions, unrolled loops, and folded and spread
//! constants. So what may be such a zero is kept out of its sight: zeros that are written somewhere ([`zeros`]), and
//! those that come of other constants ([`constants`]), as `1.0 - k` with `k = 1.0`, or `float(i)` in a loop that counts
//! through zero. What is hidden is not folded into its quotient any more, which may change a last bit: so no more is
//! hidden than may be a zero.

mod constants;
mod known;
mod zeros;

use self::{
    constants::Constants,
    zeros::{Zeros, is_of_floats},
};
use crate::glsl::ir::{
    Binary, Module, Op, Value,
    rewrite::{self, Rewriter, Rule},
};

pub(super) fn run(program: &mut Module) {
    let Some(zeros) = Zeros::of(program) else { return };
    let constants = Constants::of(program);
    for index in 0..program.functions.len() {
        let f = &program.functions[index];
        let may_be_zero =
            |value: Value| zeros.values[index][value.index()] || constants.may_be_zero(program, index, value);
        let hides = |(value, op): (Value, &Op)| match *op {
            Op::Binary { op: Binary::Divide, right, .. } => is_of_floats(program, f, value) && may_be_zero(right),
            _ => false,
        };
        let divisions: Vec<bool> = f.values().map(hides).collect();
        if divisions.contains(&true) {
            rewrite::function(program, index, &mut HiddenDivisors(divisions));
        }
    }
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
