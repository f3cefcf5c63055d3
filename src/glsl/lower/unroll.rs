//! Short loops whose rounds are known beforehand are written out, round after round.
//!
//! Drivers do so themselves, as long as all rounds together stay below some size, and it is worth much: what depends on the
//! counter alone is then computed once, by the compiler, and arrays that the counter indexes become registers. But they weigh
//! what they are handed, which is more than a GLSL compiler's own tree: Mesa (`nir_opt_loop_unroll`) allows 832 scalar
//! operations, and loops of five octaves of noise lie on either side of it by how a subtraction is written. So those up to
//! [`LARGEST`] are unrolled here. The counter stays a variable: what is known of its value the driver finds, and no constant
//! moves an operation to where the author did not write it.

use std::collections::HashMap;

use super::{
    function::{Builder, Loop, Slot},
    ranges::mirrored,
};
use crate::glsl::{
    ast::List,
    hir::{
        BinaryOp, Builtin, ExprId, ExprKind, FuncId, IncDec, LocalId, LogicalOp, Module, Scalar, Shape, StmtId,
        StmtKind,
    },
};

/// Scalar operations of all rounds together, those of called functions and of loops within included.
const LARGEST: u32 = 1100;

/// Mesa's `max_unroll_iterations` for its software drivers.
const MOST_ROUNDS: usize = 32;

/// The size of what holds a loop that stays one.
const ENDLESS: u32 = u32::MAX;

/// A loop to be written out.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Unrolled {
    counter: LocalId,
    /// The counter's value in each round.
    values: Vec<Number>,
}

/// A scalar that loops count in.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
enum Number {
    Int(i32),
    Uint(u32),
    Float(f32),
}

/// All loops to be written out, by [`StmtId::index`].
pub(super) fn unrolled(module: &Module) -> HashMap<usize, Unrolled> {
    let candidates: HashMap<usize, Unrolled> = (module.stmts.iter().enumerate())
        .filter_map(|(i, stmt)| match stmt.kind {
            StmtKind::For { init, test: Some(test), step: Some(step), .. } => {
                Some((i, counted(module, init, test, step)?))
            }
            _ => None,
        })
        .collect();
    if candidates.is_empty() {
        return candidates;
    }
    let mut sizes = Sizes {
        module,
        candidates,
        found: HashMap::new(),
        functions: vec![0; module.functions.len()],
        counters: Vec::new(),
    };
    for &func in &module.call_order {
        let size = sizes.statements(module[func].body.unwrap_or(List::EMPTY), &mut Jumps::default());
        sizes.functions[func.index()] = size;
    }
    sizes.found
}

// ------------------------------------------------------------------------------------------------------------- rounds

/// The rounds of `for (int i = 0; i < 5; i++)`: start, bound and step are literals.
fn counted(module: &Module, init: List<StmtId>, test: ExprId, step: ExprId) -> Option<Unrolled> {
    let ExprKind::Binary { op, shape: Shape::Same, lhs, rhs } = module[test].kind else { return None };
    let (counter, op, bound) = match (module[lhs].kind, module[rhs].kind) {
        (ExprKind::Local(local), _) => (local, op, number(module, rhs)?),
        (_, ExprKind::Local(local)) => (local, mirrored(op)?, number(module, lhs)?),
        _ => return None,
    };
    let mut value = start(module, init, counter)?;
    let mut values = Vec::new();
    while value.meets(op, bound)? {
        values.push(value);
        value = stepped(module, step, counter, value)?;
        if values.len() > MOST_ROUNDS {
            return None;
        }
    }
    (!values.is_empty()).then_some(Unrolled { counter, values })
}

fn number(module: &Module, expr: ExprId) -> Option<Number> {
    let ExprKind::Literal(bits) = module[expr].kind else { return None };
    Some(match module.types.scalar(module[expr].ty)? {
        Scalar::Int => Number::Int(bits as i32),
        Scalar::Uint => Number::Uint(bits),
        Scalar::Float => Number::Float(f32::from_bits(bits)),
        Scalar::Bool => return None,
    })
}

/// What the loop's first part gives its counter.
fn start(module: &Module, init: List<StmtId>, counter: LocalId) -> Option<Number> {
    module[init].iter().rev().find_map(|&stmt| match module[stmt].kind {
        StmtKind::Declare { local, init: Some(init) } if local == counter => number(module, init),
        StmtKind::Block(list) => start(module, list, counter),
        StmtKind::Expr(expr) => match module[expr].kind {
            ExprKind::Assign { place, value } if is_local(module, place, counter) => number(module, value),
            _ => None,
        },
        _ => None,
    })
}

/// The counter after one step, if that is the same on every device.
fn stepped(module: &Module, step: ExprId, counter: LocalId, value: Number) -> Option<Number> {
    let one = match value {
        Number::Int(_) => Number::Int(1),
        Number::Uint(_) => Number::Uint(1),
        Number::Float(_) => Number::Float(1.0),
    };
    match module[step].kind {
        ExprKind::IncDec { op, place } if is_local(module, place, counter) => match op {
            IncDec::PreIncrement | IncDec::PostIncrement => value.combined(BinaryOp::Add, one),
            IncDec::PreDecrement | IncDec::PostDecrement => value.combined(BinaryOp::Sub, one),
        },
        ExprKind::AssignOp { op, place, value: by, .. } if is_local(module, place, counter) => {
            value.combined(op, number(module, by)?)
        }
        ExprKind::Comma { lhs, rhs } => match module[rhs].kind {
            ExprKind::Comma { .. } => None,
            _ => stepped(module, rhs, counter, value).or_else(|| stepped(module, lhs, counter, value)),
        },
        _ => None,
    }
}

fn is_local(module: &Module, place: ExprId, local: LocalId) -> bool {
    matches!(module[place].kind, ExprKind::Local(found) if found == local)
}

impl Number {
    fn meets(self, op: BinaryOp, bound: Number) -> Option<bool> {
        Some(match op {
            BinaryOp::Less => self < bound,
            BinaryOp::LessEqual => self <= bound,
            BinaryOp::Greater => self > bound,
            BinaryOp::GreaterEqual => self >= bound,
            BinaryOp::NotEqual => self != bound,
            _ => return None,
        })
    }

    /// Integers wrap. Sums and products of floats that are not exact depend on how the device rounds: they are none.
    fn combined(self, op: BinaryOp, by: Number) -> Option<Number> {
        let int = |a: u32, b: u32| match op {
            BinaryOp::Add => Some(a.wrapping_add(b)),
            BinaryOp::Sub => Some(a.wrapping_sub(b)),
            BinaryOp::Mul => Some(a.wrapping_mul(b)),
            _ => None,
        };
        match (self, by) {
            (Number::Int(a), Number::Int(b)) => int(a as u32, b as u32).map(|bits| Number::Int(bits as i32)),
            (Number::Uint(a), Number::Uint(b)) => int(a, b).map(Number::Uint),
            (Number::Float(a), Number::Float(b)) => {
                let (a, b) = (f64::from(a), f64::from(b));
                let exact = match op {
                    BinaryOp::Add => a + b,
                    BinaryOp::Sub => a - b,
                    BinaryOp::Mul => a * b,
                    _ => return None,
                };
                (f64::from(exact as f32) == exact).then_some(Number::Float(exact as f32))
            }
            _ => None,
        }
    }
}

// -------------------------------------------------------------------------------------------------------------- sizes

/// Measures statements, and keeps of the candidates what is small enough.
struct Sizes<'a> {
    module: &'a Module,
    candidates: HashMap<usize, Unrolled>,
    found: HashMap<usize, Unrolled>,
    /// By [`FuncId::index`]; callees come first.
    functions: Vec<u32>,
    /// Counters of the candidates around the place at hand, and how many expressions there write them.
    counters: Vec<(LocalId, u32)>,
}

/// What leaves a loop's round before its end.
#[derive(Default)]
struct Jumps {
    from_loop: bool,
    in_switch: bool,
}

impl Sizes<'_> {
    fn statements(&mut self, list: List<StmtId>, jumps: &mut Jumps) -> u32 {
        let module = self.module;
        module[list].iter().fold(0, |size: u32, &stmt| size.saturating_add(self.statement(stmt, jumps)))
    }

    fn statement(&mut self, stmt: StmtId, jumps: &mut Jumps) -> u32 {
        let module = self.module;
        match module[stmt].kind {
            StmtKind::Block(list) => self.statements(list, jumps),
            StmtKind::Expr(expr) => self.expr(expr),
            StmtKind::Declare { init, .. } => init.map_or(0, |init| self.expr(init)),
            StmtKind::If { cond, then, otherwise } => {
                let size = self.expr(cond).saturating_add(1);
                let size = size.saturating_add(self.statements(then, jumps));
                size.saturating_add(self.statements(otherwise, jumps))
            }
            StmtKind::For { init, test, step, body } => {
                let size = self.statements(init, &mut Jumps::default());
                if let Some(test) = test {
                    self.expr(test);
                }
                size.saturating_add(self.for_loop(stmt, step, body))
            }
            StmtKind::DoWhile { body, test } => {
                self.statements(body, &mut Jumps::default());
                self.expr(test);
                ENDLESS
            }
            StmtKind::Switch { value, cases } => {
                let outer = std::mem::replace(&mut jumps.in_switch, true);
                let mut size = self.expr(value);
                for case in &module[cases] {
                    size = size.saturating_add(self.statements(case.body, jumps)).saturating_add(1);
                }
                jumps.in_switch = outer;
                size
            }
            StmtKind::Return(value) => value.map_or(0, |value| self.expr(value)),
            StmtKind::Break => {
                jumps.from_loop |= !jumps.in_switch;
                0
            }
            StmtKind::Continue => {
                jumps.from_loop = true;
                0
            }
            StmtKind::Discard => 1,
        }
    }

    fn for_loop(&mut self, stmt: StmtId, step: Option<ExprId>, body: List<StmtId>) -> u32 {
        let candidate = self.candidates.remove(&stmt.index());
        self.counters.extend(candidate.as_ref().map(|c| (c.counter, 0)));
        let mut jumps = Jumps::default();
        let round = self.statements(body, &mut jumps).saturating_add(step.map_or(0, |step| self.expr(step)));
        let Some(candidate) = candidate else { return ENDLESS };
        // The step alone writes the counter.
        let is_counted = self.counters.pop().is_some_and(|(_, writes)| writes == 1);
        let size = round.saturating_mul(candidate.values.len() as u32);
        if !is_counted || jumps.from_loop || size > LARGEST {
            return ENDLESS;
        }
        self.found.insert(stmt.index(), candidate);
        size
    }

    /// Operations of an expression and all within.
    fn expr(&mut self, expr: ExprId) -> u32 {
        let module = self.module;
        let mut size = 0u32;
        let mut pending = vec![expr];
        while let Some(expr) = pending.pop() {
            size = size.saturating_add(self.own_size(expr));
            match module[expr].kind {
                ExprKind::Member { base: of, .. }
                | ExprKind::Swizzle { base: of, .. }
                | ExprKind::Unary { operand: of, .. }
                | ExprKind::IncDec { place: of, .. }
                | ExprKind::Convert(of)
                | ExprKind::Splat(of)
                | ExprKind::MatrixDiagonal(of)
                | ExprKind::MatrixResize(of) => pending.push(of),
                ExprKind::Index { base: a, index: b }
                | ExprKind::Binary { lhs: a, rhs: b, .. }
                | ExprKind::Logical { lhs: a, rhs: b, .. }
                | ExprKind::Comma { lhs: a, rhs: b }
                | ExprKind::Assign { place: a, value: b }
                | ExprKind::AssignOp { place: a, value: b, .. } => pending.extend([a, b]),
                ExprKind::Ternary { cond, then, otherwise } => pending.extend([cond, then, otherwise]),
                ExprKind::Vector(args)
                | ExprKind::Matrix(args)
                | ExprKind::Struct(args)
                | ExprKind::Array(args)
                | ExprKind::Builtin { args, .. }
                | ExprKind::Call { args, .. } => pending.extend(&module[args]),
                _ => {}
            }
        }
        size
    }

    /// Scalar operations an expression itself is once drivers have taken vectors apart.
    fn own_size(&mut self, expr: ExprId) -> u32 {
        let module = self.module;
        let parts = |expr: ExprId| module.types.components(module[expr].ty).unwrap_or(1);
        match module[expr].kind {
            ExprKind::Index { index, .. } => u32::from(!matches!(module[index].kind, ExprKind::Literal(_))),
            ExprKind::Unary { .. } | ExprKind::Convert(_) | ExprKind::Ternary { .. } => parts(expr),
            ExprKind::Logical { op: LogicalOp::And | LogicalOp::Or, .. } => 1,
            ExprKind::Binary { op, shape, lhs, rhs } => of_operator(op, shape, parts(lhs), parts(rhs), parts(expr)),
            ExprKind::AssignOp { op, shape, place, value } => {
                self.wrote(place);
                of_operator(op, shape, parts(place), parts(value), parts(place))
            }
            ExprKind::IncDec { place, .. } => {
                self.wrote(place);
                parts(place)
            }
            ExprKind::Assign { place, .. } => {
                self.wrote(place);
                0
            }
            ExprKind::Call { func, args } => {
                self.wrote_arguments(func, args);
                self.functions[func.index()]
            }
            ExprKind::Builtin { builtin, args } => {
                let args = &module[args];
                if builtin == Builtin::Modf {
                    self.wrote(args[1]);
                }
                of_builtin(builtin, parts(expr), args.first().map_or(1, |&arg| parts(arg)), args.len())
            }
            _ => 0,
        }
    }

    fn wrote_arguments(&mut self, func: FuncId, args: List<ExprId>) {
        let module = self.module;
        for (param, &arg) in module.params(func).iter().zip(&module[args]) {
            if param.kind.copies_out() {
                self.wrote(arg);
            }
        }
    }

    /// Counters are scalars: they are written as a whole.
    fn wrote(&mut self, place: ExprId) {
        if let ExprKind::Local(local) = self.module[place].kind {
            for (_, writes) in self.counters.iter_mut().filter(|(counter, _)| *counter == local) {
                *writes += 1;
            }
        }
    }
}

fn of_operator(op: BinaryOp, shape: Shape, left: u32, right: u32, result: u32) -> u32 {
    match (op, shape) {
        // Each component is a sum of products over the side that is summed away: left * right = result * side².
        (_, Shape::MatVec | Shape::VecMat | Shape::MatMat) => {
            let side = (left * right / result.max(1)).isqrt().max(1);
            result * (2 * side - 1)
        }
        (BinaryOp::Sub, _) => 2 * result,
        (BinaryOp::Equal | BinaryOp::NotEqual, _) => 2 * left - 1,
        _ => result,
    }
}

/// `result` and `first` are the components of the result and of the first argument.
fn of_builtin(builtin: Builtin, result: u32, first: u32, args: usize) -> u32 {
    use Builtin as B;
    match builtin {
        B::Transpose | B::FloatBitsToInt | B::FloatBitsToUint | B::IntBitsToFloat | B::UintBitsToFloat => 0,
        B::Exp | B::Log | B::Clamp | B::Step | B::IsInf => 2 * result,
        B::Tan | B::Round | B::Modf => 3 * result,
        B::Mix => 4 * result,
        B::Mod => 5 * result,
        B::Sinh | B::Cosh | B::Tanh | B::Asinh | B::Acosh | B::Atanh => 7 * result,
        B::Smoothstep => 9 * result,
        B::Asin | B::Acos => 14 * result,
        B::Atan if args == 1 => 22 * result,
        B::Atan => 35 * result,
        B::Dot => 2 * first - 1,
        B::Any | B::All => first - 1,
        B::Length => 2 * first,
        B::Distance => 4 * first,
        B::Normalize => 3 * first + 1,
        B::Cross => 12,
        B::FaceForward | B::Reflect => 6 * first,
        B::Refract => 10 * first,
        B::Determinant => 5 * first,
        B::Inverse => 10 * first,
        B::PackSnorm2x16 | B::UnpackSnorm2x16 | B::PackUnorm2x16 | B::UnpackUnorm2x16 => 10,
        _ => result,
    }
}

// ------------------------------------------------------------------------------------------------------------ writing

impl Builder<'_, '_> {
    /// Writes the rounds of a loop out, behind its first part.
    pub fn rounds(&mut self, unrolled: &Unrolled, step: Option<ExprId>, body: List<StmtId>) {
        let counter = unrolled.counter.index() as u32;
        for value in &unrolled.values {
            self.undeclare(body);
            let exact = match *value {
                Number::Int(value) => Some(i64::from(value)),
                Number::Uint(value) => Some(i64::from(value)),
                Number::Float(_) => None,
            };
            let outer = exact.and_then(|value| self.known.insert(counter, (value, value)));
            // Declarations in it are met more than once.
            self.loops.push(Loop { step: None });
            self.statements(body);
            self.loops.pop();
            match outer {
                Some(range) => self.known.insert(counter, range),
                None => self.known.remove(&counter),
            };
            if self.ended {
                return;
            }
            if let Some(step) = step {
                self.effect(step);
            }
        }
    }

    /// Forgets what the last round's declarations gave their locals. Memory may be used again.
    fn undeclare(&mut self, list: List<StmtId>) {
        let hir = self.cx.hir;
        for &stmt in &hir[list] {
            match hir[stmt].kind {
                StmtKind::Declare { local, .. } => {
                    self.known.remove(&(local.index() as u32));
                    if let Slot::Value(_) | Slot::Table(_) = self.slot(local) {
                        self.set_slot(local, Slot::Unset);
                    }
                }
                StmtKind::Block(list) | StmtKind::DoWhile { body: list, .. } => self.undeclare(list),
                StmtKind::If { then, otherwise, .. } => {
                    self.undeclare(then);
                    self.undeclare(otherwise);
                }
                StmtKind::For { init, body, .. } => {
                    self.undeclare(init);
                    self.undeclare(body);
                }
                StmtKind::Switch { cases, .. } => hir[cases].iter().for_each(|case| self.undeclare(case.body)),
                _ => {}
            }
        }
    }
}
