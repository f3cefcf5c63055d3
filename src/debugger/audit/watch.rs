//! Observes a walk in both precisions.

use super::{
    distance::difference,
    finding::{Finding, Kind},
    flow::{Flow, Shown},
    undefined,
};
use eddy_diag::Span;
use eddy_engine::DrawInputs;
use eddy_glsl::{
    ast::Loc,
    ir::{Binary, FuncId, Math, Op, Output, Stmt, Value},
    walk::{Cell, Observer, Shadowed, View, World},
    walkable::Walkable,
};
use std::collections::HashMap;

/// Half the spacing of single-precision numbers, relative to them.
const ROUNDING: f64 = 1.0 / (1 << 24) as f64;
/// The factor by which an operation must increase the relative error of its operands to be the cause.
const MIN_GROWTH: f64 = 16.0;
/// A sum is a cancellation if it is smaller than its operands by this factor.
const CANCELLATION: f64 = 1.0 / 16.0;
/// The angle at which the spacing of single-precision numbers is a thousandth of a turn.
const LARGE_ANGLE: f32 = 1e4;

/// An operation whose result is much less exact than its operands.
#[derive(Clone, Debug)]
pub(super) struct RootCause {
    pub function: FuncId,
    pub value: Value,
    /// Relative error of the result.
    pub error: f64,
    pub what: &'static str,
    pub numbers: String,
    span: Option<Span>,
}

/// An operation, a pixel's error, and the error that remains if the operation is exact.
pub(super) struct Blame {
    pub cause: RootCause,
    pub error: f64,
    pub left: f64,
}

pub(super) struct Watch<'w> {
    walkable: &'w Walkable,
    inputs: &'w DrawInputs<'w>,
    root_causes: HashMap<(FuncId, Value), RootCause>,
    found: Vec<(Kind, Option<Span>, String)>,
    flow: Flow<'w>,
}

impl<'w> Watch<'w> {
    /// `stored` is the number of components that each target stores.
    pub(super) fn new(walkable: &'w Walkable, inputs: &'w DrawInputs<'w>, stored: &'w [usize]) -> Self {
        Self { walkable, inputs, root_causes: HashMap::new(), found: Vec::new(), flow: Flow::new(walkable, stored) }
    }

    /// Returns the operations that cause errors, the largest first.
    pub(super) fn root_causes(&self) -> Vec<&RootCause> {
        let mut root_causes: Vec<&RootCause> = self.root_causes.values().collect();
        root_causes.sort_by(|a, b| b.error.total_cmp(&a.error).then(a.span.cmp_place(&b.span)));
        root_causes
    }

    /// Returns the findings, and the unwritten values that the output depends on.
    pub(super) fn end(self, pixel: (u32, u32), blame: Option<Blame>) -> (Vec<Finding>, Vec<Shown>) {
        let finding = |(kind, span, numbers)| Finding { kind, span, pixels: 1, pixel, numbers, error: None };
        let mut all: Vec<Finding> = self.found.into_iter().map(finding).collect();
        if let Some(Blame { cause, error, left }) = blame {
            let (kind, span, numbers) = (Kind::Rounding(cause.what), cause.span, cause.numbers);
            all.push(Finding { kind, span, pixels: 1, pixel, numbers, error: Some((error, left)) });
        }
        (all, self.flow.shown())
    }

    fn span(&self, loc: Loc) -> Option<Span> {
        (loc != Loc::default()).then(|| self.walkable.span(loc))
    }

    fn find(&mut self, kind: Kind, span: Option<Span>, numbers: String) {
        if !self.found.iter().any(|(k, s, _)| *k == kind && *s == span) {
            self.found.push((kind, span, numbers));
        }
    }
}

impl Observer<Shadowed> for Watch<'_> {
    fn calling(&mut self, view: &View<'_, '_, Shadowed>, arguments: &[Value]) {
        self.flow.calling(view, arguments);
    }

    fn enter(&mut self, view: &View<'_, '_, Shadowed>) {
        self.flow.enter(view);
    }

    fn returned(&mut self, view: &View<'_, '_, Shadowed>, value: Option<Value>) {
        self.flow.returned(view, value);
    }

    fn leave(&mut self, _: &View<'_, '_, Shadowed>) {
        self.flow.leave();
    }

    fn branch(&mut self, view: &View<'_, '_, Shadowed>, stmt: &Stmt) {
        self.flow.branch(view, stmt);
    }

    fn branch_end(&mut self, _: &View<'_, '_, Shadowed>) {
        self.flow.branch_end();
    }

    fn loop_start(&mut self, _: &View<'_, '_, Shadowed>, stmt: &Stmt) {
        self.flow.loop_start(stmt);
    }

    fn iteration(&mut self, _: &View<'_, '_, Shadowed>) {
        self.flow.turn();
    }

    fn continuing(&mut self, _: &View<'_, '_, Shadowed>) {
        self.flow.turn();
    }

    fn loop_end(&mut self, _: &View<'_, '_, Shadowed>) {
        self.flow.branch_end();
    }

    fn diverged(&mut self, view: &View<'_, '_, Shadowed>, value: Value) {
        let what = match *view.op(value) {
            Op::Sample { channel, .. } if !self.inputs.is_of_levels(channel) => return,
            Op::Sample { .. } => {
                "the mip level comes from derivatives in a branch that neighbouring pixels do not share (undefined, \
                 8.8)"
            }
            _ => "a derivative is undefined in a branch that neighbouring pixels do not share (8.9)",
        };
        let span = self.span(view.function().loc(value));
        self.find(Kind::Undefined(what), span, String::new());
    }

    fn decide(&mut self, view: &View<'_, '_, Shadowed>, value: Value) {
        self.flow.decide(view, value);
    }

    fn output(&mut self, view: &View<'_, '_, Shadowed>, output: Output, value: Value) {
        self.flow.output(view, output, value);
    }

    fn store(&mut self, view: &View<'_, '_, Shadowed>, place: Value, value: Value) {
        self.flow.store(view, place, value);
    }

    fn value(&mut self, view: &View<'_, '_, Shadowed>, value: Value) {
        let op = view.op(value);
        let loc = view.function().loc(value);
        if view.is_place(value) {
            self.flow.place(view, value);
            return;
        }
        self.flow.value(view, value);
        if let Some(what) = self.walkable.unsequenced(loc) {
            let span = self.span(loc);
            self.find(Kind::Undefined(what), span, String::new());
        }
        // Consequences of an undefined value are reported at its source.
        if self.flow.is_undefined(view, op) || self.flow.is_undefined_value(view, value) {
            return;
        }
        let size = |channel, level| World::size(self.inputs, channel, level);
        let precondition = self.walkable.precondition(view.function_id(), value);
        let broken = precondition.and_then(|precondition| undefined::of_precondition(view, precondition));
        for (what, numbers) in [undefined::of_operation(view, value, &size), broken].into_iter().flatten() {
            let span = self.span(loc);
            self.find(Kind::Undefined(what), span, numbers);
        }
        let own = match op {
            Op::Binary { op, left, right } if op.is_comparison() => {
                if comparison_differs(view, *op, *left, *right) {
                    let span = self.span(loc);
                    self.find(Kind::Decided, span, shown(view, &[*left, *right]));
                }
                return;
            }
            Op::Binary { op, left, right } => cause_of_binary(view, *op, *left, *right, value),
            Op::Math { fun, arg, .. } => cause_of_math(view, *fun, *arg),
            _ => return,
        };
        let operands: Vec<Value> = operands(op).into_iter().filter(|&operand| !view.is_place(operand)).collect();
        let error = relative_error(view.value(value));
        let before = operands.iter().map(|&operand| relative_error(view.value(operand))).fold(0.0, f64::max);
        let is_finite =
            |value: Value| view.value(value).iter().all(|c| !matches!(c, Cell::Float(x) if !x.single.is_finite()));
        if !is_finite(value) && operands.iter().all(|&operand| is_finite(operand)) {
            let span = self.span(loc);
            let is_nan = view.value(value).iter().any(|c| matches!(c, Cell::Float(x) if x.single.is_nan()));
            let what = if is_nan { "first NaN here" } else { "first infinity here" };
            self.find(Kind::Nonfinite(what), span, shown(view, &operands));
        }
        if error < MIN_GROWTH * ROUNDING || error < MIN_GROWTH * before.max(ROUNDING) {
            return;
        }
        let key = (view.function_id(), value);
        if self.root_causes.get(&key).is_none_or(|known| known.error < error) {
            let (function, numbers) = (view.function_id(), shown(view, &operands));
            let span = self.span(loc);
            self.root_causes.insert(key, RootCause { function, value, error, what: own, numbers, span });
        }
    }
}

fn operands(op: &Op) -> Vec<Value> {
    let mut all = Vec::new();
    op.operands(|operand| all.push(operand));
    all
}

fn cause_of_binary(view: &View<'_, '_, Shadowed>, op: Binary, left: Value, right: Value, value: Value) -> &'static str {
    let size = |value: Value| view.value(value).iter().map(|c| c.float().single.abs()).fold(0.0, f32::max);
    match op {
        Binary::Add | Binary::Subtract
            if f64::from(size(value)) < CANCELLATION * f64::from(size(left).max(size(right))) =>
        {
            "cancellation: subtracting nearly equal numbers leaves mostly rounding error"
        }
        Binary::Divide => "a small divisor magnifies rounding errors",
        _ => "rounding errors grow here",
    }
}

fn cause_of_math(view: &View<'_, '_, Shadowed>, fun: Math, arg: Value) -> &'static str {
    let is_large = view.value(arg).iter().any(|c| matches!(c, Cell::Float(x) if x.single.abs() >= LARGE_ANGLE));
    match fun {
        Math::Sin | Math::Cos | Math::Tan if is_large => {
            "a trigonometric function of a large number: rounding has lost the phase"
        }
        Math::Fract | Math::Floor | Math::Ceil | Math::Round | Math::Trunc => {
            "rounding changes the result of a step, floor or fract here"
        }
        Math::Exp | Math::Exp2 | Math::Pow => "an exponential magnifies rounding errors of its exponent",
        _ => "rounding errors grow here",
    }
}

/// Returns the largest relative error of a component.
fn relative_error(cells: &[Cell<Shadowed>]) -> f64 {
    let one = |cell: &Cell<Shadowed>| match *cell {
        Cell::Float(x) => {
            let size = x.double.abs().max(f64::from(x.single).abs());
            match difference(x) {
                0.0 => 0.0,
                error if size.is_finite() => error / size.max(f64::from(f32::MIN_POSITIVE)),
                _ => f64::INFINITY,
            }
        }
        Cell::Bits(_) => 0.0,
    };
    cells.iter().map(one).fold(0.0, f64::max)
}

fn comparison_differs(view: &View<'_, '_, Shadowed>, op: Binary, left: Value, right: Value) -> bool {
    let (a, b) = (view.value(left), view.value(right));
    let outcome = |order: Option<std::cmp::Ordering>| match op {
        Binary::Equal => order.is_some_and(|o| o.is_eq()),
        Binary::NotEqual => order.is_none_or(|o| o.is_ne()),
        Binary::Less => order.is_some_and(|o| o.is_lt()),
        Binary::LessEqual => order.is_some_and(|o| o.is_le()),
        Binary::Greater => order.is_some_and(|o| o.is_gt()),
        _ => order.is_some_and(|o| o.is_ge()),
    };
    a.iter().zip(b).any(|(a, b)| match (a, b) {
        (Cell::Float(a), Cell::Float(b)) => {
            outcome(a.single.partial_cmp(&b.single)) != outcome(a.double.partial_cmp(&b.double))
        }
        _ => false,
    })
}

fn shown(view: &View<'_, '_, Shadowed>, values: &[Value]) -> String {
    let one = |cell: &Cell<Shadowed>| match cell {
        Cell::Float(x) => format!("{:?}", x.single),
        Cell::Bits(bits) => (*bits as i32).to_string(),
    };
    let each = values.iter().map(|&value| {
        let all: Vec<String> = view.value(value).iter().map(one).collect();
        if all.len() == 1 { all[0].clone() } else { format!("({})", all.join(", ")) }
    });
    each.collect::<Vec<_>>().join(" and ")
}

/// Compares places by text order, so that equal errors are reported in the same order on every run.
trait ComparePlace {
    fn cmp_place(&self, other: &Self) -> std::cmp::Ordering;
}

impl ComparePlace for Option<Span> {
    fn cmp_place(&self, other: &Self) -> std::cmp::Ordering {
        let key = |span: &Option<Span>| span.map(|s| (s.source.0, s.start));
        key(self).cmp(&key(other))
    }
}
