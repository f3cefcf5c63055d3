//! Watches a walk in both precisions.

use super::{
    distance::apart,
    finding::{Finding, Kind},
    undefined,
};
use eddy_diag::Span;
use eddy_engine::DrawInputs;
use eddy_glsl::{
    ast::Loc,
    ir::{Binary, FuncId, GlobalKind, Math, Op, Output, Value},
    walk::{Cell, Observer, Shadowed, View, World},
    walkable::Walkable,
};
use std::collections::{HashMap, HashSet};

/// Half the distance of single precision's numbers, relative to them.
const ROUNDING: f64 = 1.0 / (1 << 24) as f64;
/// By how much an operation makes relative errors larger for its error to be its own and not its operands'.
const GROWTH: f64 = 16.0;
/// A sum is a cancellation where it is smaller than its operands by this.
const CANCELLED: f64 = 1.0 / 16.0;
/// The angle where the distance of single precision's numbers is a thousandth of a turn.
const LARGE_ANGLE: f32 = 1e4;

/// An operation whose result is much less exact than its operands.
#[derive(Clone, Debug)]
pub struct RootCause {
    pub function: FuncId,
    pub value: Value,
    /// Relative error of the result.
    pub error: f64,
    pub what: &'static str,
    pub numbers: String,
    span: Option<Span>,
}

/// An operation, a pixel's error, and what is left of it where the operation is exact.
pub struct Blame {
    pub cause: RootCause,
    pub error: f64,
    pub left: f64,
}

pub struct Watch<'w> {
    walkable: &'w Walkable,
    inputs: &'w DrawInputs<'w>,
    root_causes: HashMap<(FuncId, Value), RootCause>,
    found: Vec<(Kind, Option<Span>, String)>,
    /// Cells of memory that nothing was written to, and those that an undefined value was written to: with the place of
    /// the expression that it is the value of.
    unset: HashMap<usize, Option<Span>>,
    /// Cells of variables of the module that something was written to.
    written: HashSet<usize>,
    /// The undefined components of values, for each call under way.
    calls: Vec<HashMap<Value, Vec<bool>>>,
    variables: HashMap<FuncId, Vec<Value>>,
    parameters: HashMap<FuncId, Vec<(Value, u32)>>,
    /// The undefined components of the arguments of the call that is about to begin.
    arguments: Vec<Option<Vec<bool>>>,
    /// The undefined components of what the last function returned.
    returned: Option<Vec<bool>>,
}

impl<'w> Watch<'w> {
    pub fn new(walkable: &'w Walkable, inputs: &'w DrawInputs<'w>) -> Self {
        Self {
            walkable,
            inputs,
            root_causes: HashMap::new(),
            found: Vec::new(),
            unset: HashMap::new(),
            written: HashSet::new(),
            calls: Vec::new(),
            variables: HashMap::new(),
            parameters: HashMap::new(),
            arguments: Vec::new(),
            returned: None,
        }
    }

    /// The operations in which errors are born, the largest first.
    pub fn root_causes(&self) -> Vec<&RootCause> {
        let mut root_causes: Vec<&RootCause> = self.root_causes.values().collect();
        root_causes.sort_by(|a, b| b.error.total_cmp(&a.error).then(a.span.cmp_place(&b.span)));
        root_causes
    }

    pub fn end(self, pixel: (u32, u32), born: Option<Blame>) -> Vec<Finding> {
        let finding = |(kind, span, numbers)| Finding { kind, span, pixels: 1, pixel, numbers, error: None };
        let mut all: Vec<Finding> = self.found.into_iter().map(finding).collect();
        if let Some(Blame { cause, error, left }) = born {
            let (kind, span, numbers) = (Kind::Rounding(cause.what), cause.span, cause.numbers);
            all.push(Finding { kind, span, pixels: 1, pixel, numbers, error: Some((error, left)) });
        }
        all
    }

    fn span(&self, loc: Loc) -> Option<Span> {
        (loc != Loc::default()).then(|| self.walkable.span(loc))
    }

    fn find(&mut self, kind: Kind, span: Option<Span>, numbers: String) {
        if !self.found.iter().any(|(k, s, _)| *k == kind && *s == span) {
            self.found.push((kind, span, numbers));
        }
    }

    fn undefined_components(&self, view: &View<'_, '_, Shadowed>, value: Value) -> Option<Vec<bool>> {
        if self.walkable.undefined(view.function_id()).contains(&value) {
            return Some(vec![true; view.value(value).len()]);
        }
        self.calls.last()?.get(&value).cloned()
    }

    /// The variable of the module that a place lies in, if nothing is written there before the program writes.
    fn is_unset_global(&self, view: &View<'_, '_, Shadowed>, place: Value) -> bool {
        match *view.op(place) {
            Op::Part { base, .. } | Op::Element { base, .. } => self.is_unset_global(view, base),
            Op::Global(global) => {
                let is_empty = matches!(view.module()[global].kind, GlobalKind::Private(None));
                is_empty && self.walkable.global_name(global).is_some()
            }
            _ => false,
        }
    }

    /// A value is used where something undefined decides.
    fn used(&mut self, view: &View<'_, '_, Shadowed>, value: Value) {
        let span = self.span(view.function().loc(value));
        let what = "this uses a variable that was never written (undefined, 4.3.1)";
        self.find(Kind::Undefined(what), span, String::new());
    }

    /// The place of the expression that an undefined value comes from, as far as it was only carried along since.
    fn origin(&self, view: &View<'_, '_, Shadowed>, value: Value) -> Option<Span> {
        match view.op(value) {
            Op::Load { place } => {
                let (start, count) = (view.address(*place), view.memory(*place).len());
                (start..start + count).find_map(|cell| self.unset.get(&cell).copied().flatten())
            }
            Op::Part { base, .. } => self.origin(view, *base),
            Op::Swizzle { vector, .. } => self.origin(view, *vector),
            Op::Splat { value, .. } => self.origin(view, *value),
            Op::Compose { parts, .. } => parts.iter().find_map(|&part| self.origin(view, part)),
            _ => None,
        }
    }

    /// Notes which components of a value nothing was written to, and whether that counts as a use of them.
    fn follow(&mut self, view: &View<'_, '_, Shadowed>, value: Value, op: &Op) {
        let mut is_used = false;
        let undefined: Option<Vec<bool>> = match op {
            Op::Load { place } => {
                let (start, count) = (view.address(*place), view.memory(*place).len());
                let is_global = self.is_unset_global(view, *place);
                let is_unset =
                    |cell: usize| self.unset.contains_key(&cell) || (is_global && !self.written.contains(&cell));
                let components: Vec<bool> = (start..start + count).map(is_unset).collect();
                components.contains(&true).then_some(components)
            }
            Op::Part { base, index } => {
                let size = view.value(value).len();
                let parts = self.undefined_components(view, *base);
                parts.map(|parts| parts[*index as usize * size..][..size].to_vec())
            }
            Op::Swizzle { vector, swizzle } => {
                let parts = self.undefined_components(view, *vector);
                parts.map(|parts| swizzle.iter().map(|i| parts[i]).collect())
            }
            Op::Splat { size, value } => {
                let part = self.undefined_components(view, *value);
                part.map(|part| vec![part[0]; usize::from(*size)])
            }
            Op::Compose { parts, .. } => {
                let mut all = Vec::new();
                for &part in &**parts {
                    let size = view.value(part).len();
                    all.extend(self.undefined_components(view, part).unwrap_or_else(|| vec![false; size]));
                }
                Some(all)
            }
            Op::Call { args, .. } => {
                // Components of an argument that are undefined are followed into the function; a whole argument is used.
                is_used = args.iter().filter(|&&arg| !view.is_place(arg)).any(|&arg| {
                    self.undefined_components(view, arg).is_some_and(|parts| parts.iter().all(|&part| part))
                });
                let returned = self.returned.take();
                returned.filter(|components| components.len() == view.value(value).len())
            }
            _ => {
                let size = view.value(value).len();
                let mut components = vec![false; size];
                for operand in operands(op) {
                    if view.is_place(operand) {
                        continue;
                    }
                    let Some(parts) = self.undefined_components(view, operand) else { continue };
                    // A component that is nothing may be carried along and thrown away.
                    is_used |= parts.iter().all(|&part| part) || parts.len() != size;
                    let each = |i: usize| parts[if parts.len() == 1 { 0 } else { i.min(parts.len() - 1) }];
                    components.iter_mut().enumerate().for_each(|(i, c)| *c |= each(i));
                }
                (!is_used).then_some(components)
            }
        };
        if is_used {
            self.used(view, value);
        }
        if let Some(call) = self.calls.last_mut() {
            match undefined.filter(|components| components.contains(&true)) {
                Some(components) => call.insert(value, components),
                None => call.remove(&value),
            };
        }
    }
}

impl Observer<Shadowed> for Watch<'_> {
    fn calling(&mut self, view: &View<'_, '_, Shadowed>, arguments: &[Value]) {
        let components = |&argument: &Value| match view.is_place(argument) {
            true => None,
            false => {
                let components = self.undefined_components(view, argument)?;
                components.contains(&false).then_some(components)
            }
        };
        self.arguments = arguments.iter().map(components).collect();
    }

    fn enter(&mut self, view: &View<'_, '_, Shadowed>) {
        let arguments = std::mem::take(&mut self.arguments);
        let parameters = self.parameters.entry(view.function_id()).or_insert_with(|| {
            let parameter = |(value, op): (Value, &Op)| match *op {
                Op::Param(index) => Some((value, index)),
                _ => None,
            };
            view.function().values().filter_map(parameter).collect()
        });
        let undefined = |&(value, index): &(Value, u32)| {
            arguments.get(index as usize).cloned().flatten().map(|components| (value, components))
        };
        self.calls.push(parameters.iter().filter_map(undefined).collect());
        self.returned = None;
        let variables = self.variables.entry(view.function_id()).or_insert_with(|| {
            let is_variable = |(value, op): (Value, &Op)| matches!(op, Op::Var(_)).then_some(value);
            view.function().values().filter_map(is_variable).collect()
        });
        // The cells were another call's.
        for &variable in &*variables {
            let start = view.address(variable);
            for cell in start..start + view.memory(variable).len() {
                self.unset.remove(&cell);
            }
        }
    }

    fn returned(&mut self, view: &View<'_, '_, Shadowed>, value: Option<Value>) {
        let components = value.and_then(|value| self.undefined_components(view, value));
        self.returned = components.filter(|components| components.contains(&true));
    }

    fn leave(&mut self, _: &View<'_, '_, Shadowed>) {
        self.calls.pop();
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
        if self.undefined_components(view, value).is_some() {
            self.used(view, value);
        }
    }

    fn output(&mut self, view: &View<'_, '_, Shadowed>, _: Output, value: Value) {
        // What is shown of a colour has no alpha, and buffers that need few components write few.
        let parts = self.undefined_components(view, value).unwrap_or_default();
        if !parts.is_empty() && parts.iter().take(3).all(|&part| part) {
            let span = self.origin(view, value);
            let what = match span {
                Some(_) => "the colour of the pixel is of a variable that was never written (undefined, 4.3.1)",
                None => "the colour of the pixel was never written (undefined, 4.3.1)",
            };
            self.find(Kind::Undefined(what), span, String::new());
        }
    }

    fn store(&mut self, view: &View<'_, '_, Shadowed>, place: Value, value: Value) {
        let (start, count) = (view.address(place), view.memory(place).len());
        let undefined = self.undefined_components(view, value);
        let is_declared = self.walkable.undefined(view.function_id()).contains(&value);
        let is_authors = self.walkable.function_name(view.function_id()).is_some();
        let carried = self.origin(view, value);
        let own = (is_authors && !is_declared).then(|| self.span(view.function().loc(value))).flatten();
        for i in 0..count {
            match undefined.as_ref().is_some_and(|parts| parts[i.min(parts.len() - 1)]) {
                true => self.unset.insert(start + i, own.or(carried)),
                false => self.unset.remove(&(start + i)),
            };
        }
        if self.is_unset_global(view, place) {
            self.written.extend(start..start + count);
        }
    }

    fn value(&mut self, view: &View<'_, '_, Shadowed>, value: Value) {
        let op = view.op(value);
        let loc = view.function().loc(value);
        if view.is_place(value) {
            return;
        }
        self.follow(view, value, op);
        if let Some(what) = self.walkable.unsequenced(loc) {
            let span = self.span(loc);
            self.find(Kind::Undefined(what), span, String::new());
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
                if decides_otherwise(view, *op, *left, *right) {
                    let span = self.span(loc);
                    self.find(Kind::Decided, span, shown(view, &[*left, *right]));
                }
                return;
            }
            Op::Binary { op, left, right } => birth_of_binary(view, *op, *left, *right, value),
            Op::Math { fun, arg, .. } => birth_of_math(view, *fun, *arg),
            _ => return,
        };
        let operands: Vec<Value> = operands(op).into_iter().filter(|&operand| !view.is_place(operand)).collect();
        let error = relative(view.value(value));
        let before = operands.iter().map(|&operand| relative(view.value(operand))).fold(0.0, f64::max);
        let is_finite =
            |value: Value| view.value(value).iter().all(|c| !matches!(c, Cell::Float(x) if !x.single.is_finite()));
        if !is_finite(value) && operands.iter().all(|&operand| is_finite(operand)) {
            let span = self.span(loc);
            let is_nan = view.value(value).iter().any(|c| matches!(c, Cell::Float(x) if x.single.is_nan()));
            let what = if is_nan { "first NaN here" } else { "first infinity here" };
            self.find(Kind::Nonfinite(what), span, shown(view, &operands));
        }
        if error < GROWTH * ROUNDING || error < GROWTH * before.max(ROUNDING) {
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

fn birth_of_binary(view: &View<'_, '_, Shadowed>, op: Binary, left: Value, right: Value, value: Value) -> &'static str {
    let size = |value: Value| view.value(value).iter().map(|c| c.float().single.abs()).fold(0.0, f32::max);
    match op {
        Binary::Add | Binary::Subtract
            if f64::from(size(value)) < CANCELLED * f64::from(size(left).max(size(right))) =>
        {
            "cancellation: subtracting nearly equal numbers leaves mostly rounding error"
        }
        Binary::Divide => "a small divisor magnifies rounding errors",
        _ => "rounding errors grow here",
    }
}

fn birth_of_math(view: &View<'_, '_, Shadowed>, fun: Math, arg: Value) -> &'static str {
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

/// The largest error of a component, relative to it.
fn relative(cells: &[Cell<Shadowed>]) -> f64 {
    let one = |cell: &Cell<Shadowed>| match *cell {
        Cell::Float(x) => {
            let size = x.double.abs().max(f64::from(x.single).abs());
            match apart(x) {
                0.0 => 0.0,
                error if size.is_finite() => error / size.max(f64::from(f32::MIN_POSITIVE)),
                _ => f64::INFINITY,
            }
        }
        Cell::Bits(_) => 0.0,
    };
    cells.iter().map(one).fold(0.0, f64::max)
}

fn decides_otherwise(view: &View<'_, '_, Shadowed>, op: Binary, left: Value, right: Value) -> bool {
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

/// Places in the order of the text, so that equal errors are told in one order on every run.
trait ComparePlace {
    fn cmp_place(&self, other: &Self) -> std::cmp::Ordering;
}

impl ComparePlace for Option<Span> {
    fn cmp_place(&self, other: &Self) -> std::cmp::Ordering {
        let key = |span: &Option<Span>| span.map(|s| (s.source.0, s.start));
        key(self).cmp(&key(other))
    }
}
