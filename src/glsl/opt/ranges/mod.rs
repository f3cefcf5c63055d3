//! Value ranges: what is known of ints makes clamps of indices, guards of divisors, and tests of either superfluous.
//!
//! Nothing else keeps a generated program from memory that is not its own, nor from a trapping division: so a bound
//! must hold wherever it is used. A value's range follows from its op and the ranges of its operands. What a variable
//! holds follows from the only stores to it ([`counters`]): what holds of all of them is known from then on, and what a
//! loop's test says of its counter is known in the loop's body, behind the test and before the step.
//!
//! `tests/it/glsl_bounds.rs` has each way in which a bound could be used where it does not hold.

mod counters;

use self::counters::{Counters, Step, Written};
use crate::{
    builtins::Uniform,
    ir::{
        Binary, Block, GlobalKind, Math, Module, Op, Value,
        rewrite::{self, Rewriter, Rule},
    },
    types::{Scalar, TypeId},
};

/// Least and greatest value.
type Bounds = (i64, i64);

/// More pixels than a side of any target has (`maxImageDimension2D` is 32,768 at most today). None is empty.
const LARGEST_CANVAS: i64 = 1 << 20;

pub(super) fn run(module: &mut Module) {
    for index in 0..module.functions.len() {
        let f = &module.functions[index];
        let is_concerned = |(value, op): (Value, &Op)| match op {
            Op::Math { fun: Math::Min | Math::Max, .. } | Op::Binary { op: Binary::Divide | Binary::Modulo, .. } => {
                limits(f.ty(value)).is_some()
            }
            _ => false,
        };
        if f.values().any(is_concerned) {
            let counters = Counters::of(f);
            let vars = f.vars.len();
            let mut ranges = Ranges {
                counters,
                values: vec![None; f.len()],
                first_stored: vec![None; vars],
                current: vec![None; vars],
                from_test: vec![None; vars],
                loops: Vec::new(),
                begun_loops: 0,
                tested: None,
            };
            rewrite::function(module, index, &mut ranges);
        }
    }
}

fn limits(ty: TypeId) -> Option<Bounds> {
    match ty {
        TypeId::INT => Some((i32::MIN.into(), i32::MAX.into())),
        TypeId::UINT => Some((0, u32::MAX.into())),
        _ => None,
    }
}

struct Ranges {
    counters: Counters,
    /// The bounds of ints and uints, by [`Value::index`].
    values: Vec<Option<Bounds>>,
    /// The bounds of what was first stored to a variable, by [`VarId::index`](crate::ir::VarId::index).
    first_stored: Vec<Option<Bounds>>,
    /// The bounds of variables at the code at hand; for a counted float, those of `int(x)`.
    current: Vec<Option<Bounds>>,
    /// The bounds of counters from the test of their loop on.
    from_test: Vec<Option<Bounds>>,
    /// Loops around the code at hand, by their numbers.
    loops: Vec<usize>,
    /// The number of loops that have begun.
    begun_loops: usize,
    /// A loop whose test comes next.
    tested: Option<usize>,
}

impl Ranges {
    fn of(&self, r: &Rewriter<'_>, value: Value) -> Option<Bounds> {
        let exact = |bits: u32, ty| {
            let number = if ty == TypeId::UINT { i64::from(bits) } else { i64::from(bits as i32) };
            Some((number, number))
        };
        match r.f[value] {
            Op::Literal(Scalar::Int | Scalar::Uint, bits) => exact(bits, r.f.ty(value)),
            Op::Zero(ty) if limits(ty).is_some() => Some((0, 0)),
            _ => self.values.get(value.index()).copied().flatten(),
        }
    }

    /// Returns the range of an op of an int or uint type.
    fn compute(&self, r: &Rewriter<'_>, op: &Op, ty: TypeId) -> Option<Bounds> {
        let limits = limits(ty)?;
        let of = |value: Value| self.of(r, value);
        let any = |value: Value| of(value).unwrap_or(limits);
        // What would overflow wraps: then nothing is known.
        let fits = |bounds: Bounds| (bounds.0 >= limits.0 && bounds.1 <= limits.1).then_some(bounds);
        match *op {
            Op::Load { place } => match r.f[place] {
                Op::Var(var) => self.current[var.index()],
                _ => None,
            },
            Op::Convert { value, .. } => match r.module.types.scalar(r.f.ty(value))? {
                Scalar::Bool => Some((0, 1)),
                Scalar::Int | Scalar::Uint => fits(of(value)?),
                Scalar::Float => fits(self.truncated(r, value)?),
            },
            Op::Binary { op, left, right } => binary(op, (of(left), of(right)), limits).and_then(fits),
            Op::Math { fun: Math::Min, arg: a, arg1: Some(b), .. } => {
                let (a, b) = (any(a), any(b));
                Some((a.0.min(b.0), a.1.min(b.1)))
            }
            Op::Math { fun: Math::Max, arg: a, arg1: Some(b), .. } => {
                let (a, b) = (any(a), any(b));
                Some((a.0.max(b.0), a.1.max(b.1)))
            }
            Op::Math { fun: Math::Clamp, arg, arg1: Some(low), arg2: Some(high), .. } => {
                let (x, low, high) = (any(arg), any(low), any(high));
                let max = (x.0.max(low.0), x.1.max(low.1));
                Some((max.0.min(high.0), max.1.min(high.1)))
            }
            Op::Select { accept, reject, .. } => {
                let (a, b) = (of(accept)?, of(reject)?);
                Some((a.0.min(b.0), a.1.max(b.1)))
            }
            _ => None,
        }
    }

    /// Returns the bounds of `int(x)` for a float.
    fn truncated(&self, r: &Rewriter<'_>, value: Value) -> Option<Bounds> {
        let is_resolution = |place: Value| match r.f[place] {
            Op::Global(id) => r.module[id].kind == GlobalKind::Uniform(Uniform::Resolution),
            _ => false,
        };
        let canvas = Some((1, LARGEST_CANVAS));
        match r.f[value] {
            Op::Load { place } => match r.f[place] {
                Op::Var(var) => self.current[var.index()],
                Op::Part { base, index: 0 | 1 } if is_resolution(base) => canvas,
                _ => None,
            },
            Op::Part { base, index: 0 | 1 } => match r.f[base] {
                Op::Load { place } if is_resolution(place) => canvas,
                _ => None,
            },
            _ => None,
        }
    }
}

fn binary(op: Binary, sides: (Option<Bounds>, Option<Bounds>), limits: Bounds) -> Option<Bounds> {
    match (op, sides.0, sides.1) {
        (Binary::Add, Some(l), Some(r)) => Some((l.0 + r.0, l.1 + r.1)),
        (Binary::Subtract, Some(l), Some(r)) => Some((l.0 - r.1, l.1 - r.0)),
        (Binary::Multiply, Some(l), Some(r)) => {
            // Two uints may go beyond an i64, and then beyond the limits as well.
            let all = [(l.0, r.0), (l.0, r.1), (l.1, r.0), (l.1, r.1)].map(|(l, r)| l.saturating_mul(r));
            Some((*all.iter().min()?, *all.iter().max()?))
        }
        (Binary::Divide, Some(l), Some(r)) if l.0 >= 0 && r.0 > 0 => Some((l.0 / r.1, l.1 / r.0)),
        (Binary::And, _, Some((0.., mask))) | (Binary::And, Some((0.., mask)), _) => Some((0, mask)),
        // It has the divisor's sign.
        (Binary::Modulo, _, Some(r)) if r.0 > 0 => Some((0, r.1 - 1)),
        (Binary::ShiftRight, left, Some(r)) if r.0 == r.1 && (0..32).contains(&r.0) => {
            let left = left.unwrap_or(limits);
            Some((left.0 >> r.0, left.1 >> r.0))
        }
        _ => None,
    }
}

/// Returns the result of a comparison, if it is the same for all numbers of two ranges.
fn compared(op: Binary, left: Bounds, right: Bounds) -> Option<bool> {
    let (all, none) = match op {
        Binary::Less => (left.1 < right.0, left.0 >= right.1),
        Binary::LessEqual => (left.1 <= right.0, left.0 > right.1),
        Binary::Greater => (left.0 > right.1, left.1 <= right.0),
        Binary::GreaterEqual => (left.0 >= right.1, left.1 < right.0),
        Binary::Equal => (left.0 == left.1 && left == right, left.1 < right.0 || right.1 < left.0),
        Binary::NotEqual => (left.1 < right.0 || right.1 < left.0, left.0 == left.1 && left == right),
        _ => return None,
    };
    (all || none).then_some(all)
}

impl Rule for Ranges {
    fn operation(&mut self, r: &mut Rewriter<'_>, value: Value, op: &Op) -> Option<Value> {
        match *op {
            Op::Math { fun: fun @ (Math::Min | Math::Max), arg: a, arg1: Some(b), .. } => {
                if let (Some(left), Some(right)) = (self.of(r, a), self.of(r, b)) {
                    let (is_below, is_above) = (left.1 <= right.0, left.0 >= right.1);
                    match fun {
                        Math::Min if is_below => return Some(a),
                        Math::Min if is_above => return Some(b),
                        Math::Max if is_above => return Some(a),
                        Math::Max if is_below => return Some(b),
                        _ => {}
                    }
                }
            }
            Op::Binary { op, left, right } if op.is_comparison() => {
                let known = compared(op, self.of(r, left)?, self.of(r, right)?)?;
                return Some(r.literal(Scalar::Bool, known.into()));
            }
            Op::Select { condition, accept, reject } => {
                if let Op::Literal(Scalar::Bool, bits) = r.f[condition] {
                    return Some(if bits != 0 { accept } else { reject });
                }
            }
            _ => {}
        }
        self.values[value.index()] = self.compute(r, op, r.f.ty(value));
        None
    }

    fn store(&mut self, r: &Rewriter<'_>, place: Value, value: Value) {
        let Op::Var(var) = r.f[place] else { return };
        let var = var.index();
        self.current[var] = match self.counters.vars[var] {
            Written::Once => self.of(r, value),
            Written::Counted { number, .. } if self.loops.contains(&number) => self.from_test[var],
            Written::Counted { .. } => {
                self.first_stored[var] = self.of(r, value);
                self.first_stored[var]
            }
            Written::Unknown => None,
        };
    }

    fn begin_body(&mut self, _: &mut Rewriter<'_>, _: &Block) {
        self.loops.push(self.begun_loops);
        self.tested = Some(self.begun_loops);
        // Nothing is known of it in later rounds before their test.
        for (var, written) in self.current.iter_mut().zip(&self.counters.vars) {
            if matches!(written, Written::Counted { number, .. } if *number == self.begun_loops) {
                *var = None;
            }
        }
        self.begun_loops += 1;
    }

    fn after_if(&mut self, r: &Rewriter<'_>) {
        let Some(tested) = self.tested.take() else { return };
        for var in 0..self.current.len() {
            if let Written::Counted { number, ty, by } = self.counters.vars[var]
                && number == tested
            {
                (self.current[var], self.from_test[var]) = self.counted(r, var, ty, by).unzip();
            }
        }
    }

    fn end_body(&mut self) {
        let Some(ended) = self.loops.pop() else { return };
        self.tested = None;
        for var in 0..self.current.len() {
            if matches!(self.counters.vars[var], Written::Counted { number, .. } if number == ended) {
                self.current[var] = self.from_test[var];
            }
        }
    }
}

impl Ranges {
    /// Returns the bounds of a counter behind its loop's test and before its step, and those from the test on, in the
    /// loop and behind it.
    fn counted(&self, r: &Rewriter<'_>, var: usize, ty: TypeId, by: Step) -> Option<(Bounds, Bounds)> {
        let (test, bound) = self.counters.test(var)?;
        let (body, all) = match by {
            Step::Int(by) => {
                let (limits, start) = (limits(ty)?, self.first_stored[var]?);
                // `i < n` implies that i is not the largest int, whatever n is: `i + 1` does not wrap.
                let bound = self.of(r, r.value(bound)).unwrap_or(limits);
                match test {
                    Binary::Less | Binary::LessEqual if by >= 0 => {
                        let last = bound.1 - i64::from(test == Binary::Less);
                        let end = (last + by <= limits.1).then_some(last + by)?;
                        ((start.0, last), (start.0, start.1.max(end)))
                    }
                    Binary::Greater | Binary::GreaterEqual if by <= 0 => {
                        let least = bound.0 + i64::from(test == Binary::Greater);
                        let end = (least + by >= limits.0).then_some(least + by)?;
                        ((least, start.1), (start.0.min(end), start.1))
                    }
                    _ => return None,
                }
            }
            Step::Float { start, by } => {
                let Op::Literal(Scalar::Float, bits) = r.f[bound] else { return None };
                let bounds = counted_in_floats(test, start, by, f32::from_bits(bits))?;
                // Behind the loop nobody asks.
                (bounds, (i64::MIN, i64::MAX))
            }
        };
        // A loop without a round has a counter without a value: nothing follows from what its body does with it.
        (body.0 <= body.1).then_some((body, all))
    }
}

/// Returns the bounds of `int(x)` in the rounds of a loop that counts a float. `int` cuts off towards zero. Sums are
/// rounded, but never to the other side of where they began.
fn counted_in_floats(test: Binary, start: f32, by: f32, bound: f32) -> Option<Bounds> {
    let (first, last) = (start as i64, bound as i64);
    let before = i64::from(bound.fract() == 0.0);
    Some(match test {
        Binary::LessEqual if by >= 0.0 => (first, last),
        Binary::Less if by >= 0.0 && bound > 0.0 => (first, last - before),
        Binary::GreaterEqual if by <= 0.0 => (last, first),
        Binary::Greater if by <= 0.0 && bound < 0.0 => (last + before, first),
        Binary::Greater if by <= 0.0 => (last, first),
        _ => return None,
    })
}
