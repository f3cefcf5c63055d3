//! `mix` as OpenGL's compilers write it out.
//!
//! Mesa keeps it whole until what is around it is simplified, which a SPIR-V driver that meets its sums and products can no
//! longer do. See [`super::regroup`] for why the last bits matter.

use super::{function::Builder, regroup::Part};
use crate::glsl::hir::{Scalar, TypeId};
use crate::glsl::ir::{Binary, Math, Op, Unary, Value};

/// `mix` of scalars.
#[derive(Clone, Copy)]
struct Mix {
    x: Value,
    y: Value,
    a: Value,
}

impl Builder<'_, '_> {
    pub fn mix(&mut self, ty: TypeId, x: Value, y: Value, a: Value) -> Value {
        let mixes: Vec<Mix> = (0..self.extent(ty))
            .map(|index| {
                let [x, y, a] = [x, y, a].map(|value| match ty {
                    TypeId::FLOAT => value,
                    _ => self.add(Op::Part { base: value, index }),
                });
                Mix { x, y, a }
            })
            .collect();
        let parts: Vec<Value> = (0..mixes.len()).map(|index| self.mix_written_out(&mixes, index)).collect();
        match parts[..] {
            [scalar] => scalar,
            _ => self.compose(ty, parts),
        }
    }

    /// The sides of a sum or product that is used here alone.
    fn operands(&self, op: Binary, value: Value) -> Option<[Value; 2]> {
        match self.f[value] {
            Op::Binary { op: found, left, right } if found == op && !self.is_named(value) => Some([left, right]),
            _ => None,
        }
    }

    /// `x (1 - a) + y a` or `x + a (y - x)`: the first, of section 8.3, where that shares work between components or with
    /// constants, the second, which is shorter, elsewhere. A choice where `a` can only be 0 or 1, as with `step`: no sum keeps
    /// all of a small number beside a large one.
    fn mix_written_out(&mut self, mixes: &[Mix], index: usize) -> Value {
        let Mix { x, y, a } = mixes[index];
        if let Some(condition) = self.condition(a) {
            let condition = self.test(condition);
            return self.select(condition, y, x);
        }
        if let Some([left, right]) = self.operands(Binary::Multiply, y)
            && (left == x || right == x)
            && self.floats(x).is_none()
        {
            let factor = if left == x { right } else { left };
            let one = self.float(1.0);
            let inner = Mix { x: one, y: factor, a };
            let inner = self.mix_written_out(&[inner], 0);
            return self.op(Binary::Multiply, inner, x);
        }
        if self.mix_shares_work(mixes, index) {
            let one = self.float(1.0);
            let rest = self.op(Binary::Subtract, one, a);
            let (left, right) = (self.op(Binary::Multiply, x, rest), self.op(Binary::Multiply, y, a));
            return self.op(Binary::Add, left, right);
        }
        let difference = self.op(Binary::Subtract, y, x);
        let part = self.op(Binary::Multiply, a, difference);
        self.op(Binary::Add, x, part)
    }

    fn mix_shares_work(&self, mixes: &[Mix], index: usize) -> bool {
        let parts = |mix: Mix| (self.part(mix.x, 0), self.part(mix.y, 0), self.part(mix.a, 0));
        let (from, to, share) = parts(mixes[index]);
        match (from, to) {
            (Part::Known(from), Part::Known(to)) if similar(from, to) => return false,
            (Part::Known(from), _) if from.abs() == 1.0 || from == 0.0 => return false,
            (_, Part::Known(to)) if to.abs() == 1.0 || to == 0.0 => return true,
            _ => {}
        }
        let alike = |&mix: &Mix| {
            let (x, y, a) = parts(mix);
            a == share && (x == from || y == to)
        };
        let mut others = mixes.iter().enumerate().filter(|&(other, _)| other != index);
        matches!(share, Part::Known(_)) || others.any(|(_, mix)| alike(mix))
    }

    /// What a number that can only be 0 or 1 tells.
    fn condition(&self, number: Value) -> Option<Test> {
        self.condition_within(number, 8)
    }

    /// `depth`: how many operations deep to look. Each is looked through at every use.
    fn condition_within(&self, number: Value, depth: u32) -> Option<Test> {
        let depth = depth.checked_sub(1)?;
        let pair = |left, right| Some((self.condition_within(left, depth)?, self.condition_within(right, depth)?));
        match self.f[number] {
            Op::Convert { value: expr, to: Scalar::Float } if self.is_test(expr) => Some(Test::Of(expr, None)),
            Op::Part { base, index } => match self.f[base] {
                Op::Convert { value: expr, to: Scalar::Float } if self.is_test(expr) => {
                    Some(Test::Of(expr, Some(index)))
                }
                _ => None,
            },
            Op::Binary { op: Binary::Multiply, left, right } => pair(left, right).map(Test::both(Binary::LogicalAnd)),
            Op::Math { fun: Math::Min, arg, arg1: Some(other), .. } => {
                pair(arg, other).map(Test::both(Binary::LogicalAnd))
            }
            Op::Math { fun: Math::Max, arg, arg1: Some(other), .. } => {
                pair(arg, other).map(Test::both(Binary::LogicalOr))
            }
            _ => None,
        }
    }

    /// Whether a value is boolean, as far as can be told by the operation.
    fn is_test(&self, value: Value) -> bool {
        match self.f[value] {
            Op::Binary { op, .. } => op.is_comparison() || matches!(op, Binary::LogicalAnd | Binary::LogicalOr),
            Op::Unary { op, .. } => op == Unary::LogicalNot,
            Op::All(_) | Op::Any(_) | Op::Literal(Scalar::Bool, _) => true,
            _ => false,
        }
    }

    fn test(&mut self, test: Test) -> Value {
        match test {
            Test::Of(value, None) => value,
            Test::Of(base, Some(index)) => self.add(Op::Part { base, index }),
            Test::Both(op, tests) => {
                let (left, right) = *tests;
                let (left, right) = (self.test(left), self.test(right));
                self.op(op, left, right)
            }
        }
    }
}

/// A boolean, yet to be made.
enum Test {
    /// A value, or a component of it.
    Of(Value, Option<u32>),
    Both(Binary, Box<(Test, Test)>),
}

impl Test {
    fn both(op: Binary) -> impl Fn((Test, Test)) -> Test {
        move |pair| Test::Both(op, Box::new(pair))
    }
}

/// Whether the difference of two numbers keeps enough of the smaller one.
fn similar(a: f32, b: f32) -> bool {
    let exponent = |number: f32| if number == 0.0 { 0 } else { number.abs().log2().floor() as i32 + 1 };
    (exponent(a) - exponent(b)).abs() <= 11
}
