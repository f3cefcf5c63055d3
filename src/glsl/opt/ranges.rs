//! Value ranges: known bounds of ints make clamps of indices, guards of divisors, and tests of either redundant.
//!
//! Nothing else keeps a generated program from accessing memory out of bounds, or from a trapping division: so a bound
//! must hold wherever it is used. A value's range follows from its op and the ranges of its operands. The value of a
//! variable follows from the only stores to it ([`Counters`]): what holds for all of them is known from then on, and
//! the bounds that a loop's test implies for its counter hold in the loop's body, after the test and before the step.
//!
//! `tests/it/glsl_bounds.rs` covers each way in which a bound could be used where it does not hold.

use crate::{
    builtins::Uniform,
    ir::{
        Binary, Block, GlobalKind, Math, Module, Op, Value,
        analysis::{Counters, Definition, Interval, Step},
        rewrite::{self, Rewriter, Rule},
    },
    types::{Scalar, TypeId},
};

/// An upper bound for the number of pixels on a side of any target (`maxImageDimension2D` is 32,768 at most today). No
/// target is empty.
const MAX_TARGET_SIZE: u32 = 1 << 20;

pub(super) fn run(module: &mut Module) {
    for index in 0..module.functions.len() {
        let f = &module.functions[index];
        let is_concerned = |(value, op): (Value, &Op)| match op {
            Op::Math { fun: Math::Min | Math::Max, .. } | Op::Binary { op: Binary::Divide | Binary::Modulo, .. } => {
                Interval::of_type(f.ty(value)).is_some()
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
                entered_loops: 0,
                tested: None,
            };
            rewrite::function(module, index, &mut ranges);
        }
    }
}

struct Ranges {
    counters: Counters,
    /// The bounds of ints and uints, by [`Value::index`].
    values: Vec<Option<Interval>>,
    /// The bounds of the first value stored to a variable, by [`VarId::index`](crate::ir::VarId::index).
    first_stored: Vec<Option<Interval>>,
    /// The bounds of variables at the current code; for a float counter, those of `int(x)`.
    current: Vec<Option<Interval>>,
    /// The bounds of counters from the test of their loop on.
    from_test: Vec<Option<Interval>>,
    /// The loops around the current code, by their numbers.
    loops: Vec<usize>,
    /// The number of loops entered so far.
    entered_loops: usize,
    /// A loop whose test comes next.
    tested: Option<usize>,
}

impl Ranges {
    /// Returns the range of an int or a uint.
    fn of(&self, r: &Rewriter<'_>, value: Value) -> Option<Interval> {
        match r.f[value] {
            Op::Literal(scalar @ (Scalar::Int | Scalar::Uint), bits) => Some(Interval::literal(scalar, bits)),
            Op::Zero(TypeId::INT | TypeId::UINT) => Some(Interval::ZERO),
            _ => self.values.get(value.index()).copied().flatten().or_else(|| Interval::of_type(r.f.ty(value))),
        }
    }

    /// Returns the range of an op of an int or uint type.
    fn compute(&self, r: &Rewriter<'_>, op: &Op, ty: TypeId) -> Option<Interval> {
        let limits = Interval::of_type(ty)?;
        let scalar = r.module.scalar(ty);
        let of = |value: Value| self.of(r, value);
        let range = match *op {
            Op::Load { place } => match r.f[place] {
                Op::Var(var) => self.current[var.index()]?,
                _ => return None,
            },
            Op::Convert { value, to } => match r.module.types.scalar(r.f.ty(value))? {
                Scalar::Bool => Interval::BOOL,
                Scalar::Int | Scalar::Uint => of(value)?.converted(to),
                Scalar::Float => self.truncated(r, value)?.converted(to),
            },
            Op::Unary { op, operand } => of(operand)?.unary(op, scalar),
            Op::Binary { op, left, right } => of(left)?.binary(op, of(right)?, scalar),
            Op::Math { fun: Math::Clamp, arg, arg1: Some(low), arg2: Some(high), .. } => {
                let above = of(arg)?.function(Math::Max, Some(of(low)?), scalar);
                above.function(Math::Min, Some(of(high)?), scalar)
            }
            Op::Math { fun, arg, arg1, arg2: None, .. } => {
                let other = match arg1 {
                    Some(other) => Some(of(other)?),
                    None => None,
                };
                of(arg)?.function(fun, other, scalar)
            }
            Op::Select { accept, reject, .. } => of(accept)?.or(of(reject)?),
            _ => return None,
        };
        Some(range.within(limits))
    }

    /// Returns the bounds of `int(x)` for a float.
    fn truncated(&self, r: &Rewriter<'_>, value: Value) -> Option<Interval> {
        let is_resolution = |place: Value| match r.f[place] {
            Op::Global(id) => r.module[id].kind == GlobalKind::Uniform(Uniform::Resolution),
            _ => false,
        };
        let size = Some(Interval::between(1.0, MAX_TARGET_SIZE.into()));
        match r.f[value] {
            Op::Load { place } => match r.f[place] {
                Op::Var(var) => self.current[var.index()],
                Op::Part { base, index: 0 | 1 } if is_resolution(base) => size,
                _ => None,
            },
            Op::Part { base, index: 0 | 1 } => match r.f[base] {
                Op::Load { place } if is_resolution(place) => size,
                _ => None,
            },
            _ => None,
        }
    }
}

impl Rule for Ranges {
    fn operation(&mut self, r: &mut Rewriter<'_>, value: Value, op: &Op) -> Option<Value> {
        match *op {
            Op::Math { fun: fun @ (Math::Min | Math::Max), arg: a, arg1: Some(b), .. } => {
                if let (Some(left), Some(right)) = (self.of(r, a), self.of(r, b)) {
                    let (is_below, is_above) = (left.max <= right.min, left.min >= right.max);
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
                let known = self.of(r, left)?.compare(op, self.of(r, right)?)?;
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
            Definition::Once => self.of(r, value),
            Definition::Counted { number, .. } if self.loops.contains(&number) => self.from_test[var],
            Definition::Counted { .. } => {
                self.first_stored[var] = self.of(r, value);
                self.first_stored[var]
            }
            Definition::Unknown => None,
        };
    }

    fn start_body(&mut self, _: &mut Rewriter<'_>, _: &Block) {
        self.loops.push(self.entered_loops);
        self.tested = Some(self.entered_loops);
        // Nothing is known about it in later iterations before their test.
        for (var, written) in self.current.iter_mut().zip(&self.counters.vars) {
            if matches!(written, Definition::Counted { number, .. } if *number == self.entered_loops) {
                *var = None;
            }
        }
        self.entered_loops += 1;
    }

    fn after_if(&mut self, r: &Rewriter<'_>) {
        let Some(tested) = self.tested.take() else { return };
        for var in 0..self.current.len() {
            if let Definition::Counted { number, ty, by } = self.counters.vars[var]
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
            if matches!(self.counters.vars[var], Definition::Counted { number, .. } if number == ended) {
                self.current[var] = self.from_test[var];
            }
        }
    }
}

impl Ranges {
    /// Returns the bounds of a counter after its loop's test and before its step, and those from the test on, in the
    /// loop and after it.
    fn counted(&self, r: &Rewriter<'_>, var: usize, ty: TypeId, by: Step) -> Option<(Interval, Interval)> {
        let (test, bound) = self.counters.test(var)?;
        let (min, max, all) = match by {
            Step::Int(by) => {
                let (limits, start) = (Interval::of_type(ty)?, self.first_stored[var]?);
                let by = by as f64;
                // `i < n` implies that i is not the largest int, whatever n is: `i + 1` does not wrap.
                let bound = self.of(r, r.value(bound)).unwrap_or(limits);
                match test {
                    Binary::Less | Binary::LessEqual if by >= 0.0 => {
                        let last = bound.max - f64::from(u8::from(test == Binary::Less));
                        let end = (last + by <= limits.max).then_some(last + by)?;
                        (start.min, last, Interval::between(start.min, start.max.max(end)))
                    }
                    Binary::Greater | Binary::GreaterEqual if by <= 0.0 => {
                        let min = bound.min + f64::from(u8::from(test == Binary::Greater));
                        let end = (min + by >= limits.min).then_some(min + by)?;
                        (min, start.max, Interval::between(start.min.min(end), start.max))
                    }
                    _ => return None,
                }
            }
            Step::Float { start, by } => {
                let Op::Literal(Scalar::Float, bits) = r.f[bound] else { return None };
                let (min, max) = counted_in_floats(test, start, by, f32::from_bits(bits))?;
                // They are not used after the loop.
                (min, max, Interval::ANY)
            }
        };
        // A loop without iterations has a counter without values: nothing follows for the code in its body.
        (min <= max).then(|| (Interval::between(min, max), all))
    }
}

/// Returns the bounds of `int(x)` in the iterations of a loop with a float counter. `int` truncates towards zero. Sums
/// are rounded, but never past their starting value.
fn counted_in_floats(test: Binary, start: f32, by: f32, bound: f32) -> Option<(f64, f64)> {
    let (first, last) = (f64::from(start.trunc()), f64::from(bound.trunc()));
    let before = f64::from(u8::from(bound.fract() == 0.0));
    Some(match test {
        Binary::LessEqual if by >= 0.0 => (first, last),
        Binary::Less if by >= 0.0 && bound > 0.0 => (first, last - before),
        Binary::GreaterEqual if by <= 0.0 => (last, first),
        Binary::Greater if by <= 0.0 && bound < 0.0 => (last + before, first),
        Binary::Greater if by <= 0.0 => (last, first),
        _ => return None,
    })
}
