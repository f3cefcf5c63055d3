//! The angle of (0, 0), which is undefined on the device.
//!
//! GLSL leaves `atan(0, 0)` undefined (section 8.1), and constants fold to 0. Direct3D's `atan2` is defined "for every
//! point other than the origin" (HLSL reference), and naga translates `atan` to that (`back/hlsl/writer.rs`); drivers
//! return NaN. Therefore the angle of (0, 1) is used instead, unless an argument is known to be nonzero.

use crate::{
    ir::{
        Binary, Math, Module, Op, Value,
        rewrite::{self, Rewriter, Rule},
    },
    types::{Scalar, Type},
};

pub(super) fn run(program: &mut Module) {
    rewrite::each_function(program, || Angles);
}

struct Angles;

impl Rule for Angles {
    fn operation(&mut self, r: &mut Rewriter<'_>, _: Value, op: &Op) -> Option<Value> {
        let Op::Math { fun: Math::Atan2, arg: y, arg1: Some(x), .. } = *op else { return None };
        if is_nonzero(r, y) || is_nonzero(r, x) {
            return None;
        }
        let mut constant = |number: f32| {
            let value = r.literal(Scalar::Float, number.to_bits());
            match r.module.types.get(r.f.ty(y)) {
                Type::Vector { size, .. } => r.add(Op::Splat { size, value }),
                _ => value,
            }
        };
        let (zero, one) = (constant(0.0), constant(1.0));
        let [no_x, no_y] = [x, y].map(|side| r.add(Op::Binary { op: Binary::Equal, left: side, right: zero }));
        let condition = r.add(Op::Binary { op: Binary::And, left: no_x, right: no_y });
        let x = r.add(Op::Select { condition, accept: one, reject: x });
        Some(r.add(Op::Math { fun: Math::Atan2, arg: y, arg1: Some(x), arg2: None, arg3: None }))
    }
}

/// Returns whether no component of a value is zero, as far as literals show.
fn is_nonzero(r: &Rewriter<'_>, value: Value) -> bool {
    match &r.f[value] {
        Op::Literal(_, bits) => bits << 1 != 0,
        Op::Splat { value, .. } => is_nonzero(r, *value),
        Op::Compose { parts, .. } => parts.iter().all(|&part| is_nonzero(r, part)),
        Op::Const(id) => r.module[*id].words.iter().all(|word| word << 1 != 0),
        _ => false,
    }
}
