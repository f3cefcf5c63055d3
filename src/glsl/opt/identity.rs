//! The product of a number and one, which is that number: the example of `docs/compiler.md`, which shows this file.

use crate::{
    ir::{
        Binary, Module, Op, Value,
        rewrite::{self, Rewriter, Rule},
    },
    types::Scalar,
};

pub(super) fn run(module: &mut Module) {
    rewrite::each_function(module, || Identity);
}

struct Identity;

impl Rule for Identity {
    fn operation(&mut self, r: &mut Rewriter<'_>, _: Value, op: &Op) -> Option<Value> {
        let Op::Binary { op: Binary::Multiply, left, right } = *op else { return None };
        let is_one = |value: Value| r.f[value] == Op::Literal(Scalar::Float, f32::to_bits(1.0));
        match (is_one(left), is_one(right)) {
            (true, _) => Some(right),
            (_, true) => Some(left),
            _ => None,
        }
    }
}
