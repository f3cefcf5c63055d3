//! Operations that leave an operand as it is: `x * 1.0` is `x`.
//!
//! The example of `docs/compiler.md`: a pass is a rule and an entry in the list.

use crate::glsl::ir::rewrite::{self, Rewriter, Rule};
use crate::glsl::{
    ir::{Binary, Module, Op, Value},
    types::Scalar,
};

pub(super) fn run(module: &mut Module) {
    rewrite::each_function(module, || Identity);
}

struct Identity;

impl Rule for Identity {
    fn operation(&mut self, r: &mut Rewriter<'_>, _: Value, op: &Op) -> Option<Value> {
        let Op::Binary { op, left, right } = *op else { return None };
        // A literal is a scalar, so that `x` is no vector: those are written out by component before.
        let is = |value, number| {
            r.f[value] == Op::Literal(Scalar::Float, f32::to_bits(number)) && r.f.ty(left) == r.f.ty(right)
        };
        match op {
            Binary::Multiply if is(left, 1.0) => Some(right),
            Binary::Multiply | Binary::Divide if is(right, 1.0) => Some(left),
            Binary::Add if is(left, 0.0) => Some(right),
            Binary::Add | Binary::Subtract if is(right, 0.0) => Some(left),
            _ => None,
        }
    }
}
