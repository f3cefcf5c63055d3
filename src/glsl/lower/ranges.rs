//! What is known of integers: so that an index provably in range needs no clamp, and a divisor that is never zero no
//! guard.
//!
//! Nothing else keeps a generated program from memory that is not its own, nor from a trapping division: so what is
//! known of a local must hold at the very place where it is asked for. There are two kinds:
//! - What [`Builder::note_range`] finds holds for each value that the local has from its declaration until it is
//!   declared again, wherever the code between is written out: it follows from the declaration and from the only
//!   expression that writes the local. A function that becomes part of its caller again begins anew
//!   ([`Builder::enter`]), with what is known there of arguments whose parameters nothing writes.
//! - The bounds of a counter in the rounds of its loop hold in the loop's body alone. They are part of the entry in
//!   [`Builder::loops`], which says in which part of the loop the code at hand lies ([`Builder::within`]).
//!
//! `tests/it/glsl_bounds.rs` has each way in which code is written out twice or elsewhere.

use super::{
    function::{Builder, Part},
    writes,
};
use crate::glsl::{
    ast::List,
    hir::{
        BinaryOp, Builtin, ExprId, ExprKind, FuncId, IncDec, LocalId, Module, Scalar, Shape, StmtId, StmtKind, TypeId,
        Uniform,
    },
};

/// Least and greatest value.
pub(super) type Bounds = (i64, i64);

/// How deep an index expression is looked into.
const DEPTH: u32 = 8;

/// More pixels than a side of any target has (`maxImageDimension2D` is 32,768 at most today). None is empty.
const LARGEST_CANVAS: i64 = 1 << 20;

/// How many expressions write each local, anywhere; declarations are not counted.
pub(super) fn write_counts(module: &Module) -> Vec<u32> {
    let mut counts = vec![0; module.locals.len()];
    for expr in (0..module.exprs.len()).map(ExprId::new) {
        writes::places(module, expr, |place| {
            if let ExprKind::Local(local) = module[writes::root(module, place)].kind {
                counts[local.index()] += 1;
            }
        });
    }
    counts
}

pub(super) fn limits(ty: TypeId) -> Option<Bounds> {
    match ty {
        TypeId::INT => Some((i32::MIN.into(), i32::MAX.into())),
        TypeId::UINT => Some((0, u32::MAX.into())),
        _ => None,
    }
}

impl Builder<'_, '_> {
    /// Bounds of an int or uint scalar at this place, as far as known.
    pub fn range(&self, expr: ExprId) -> Option<Bounds> {
        self.range_within(expr, DEPTH)
    }

    /// Bounds of what a local holds at this place; of a float, those of `int(x)`. The loops at hand say what holds in
    /// their bodies alone: code that leaves a body, as a step does that is written out at a `continue`, asks in vain.
    fn bounds_here(&self, local: LocalId) -> Option<Bounds> {
        let counters = self.loops.iter().rev().filter(|at| at.part == Part::Body).filter_map(|at| at.counter);
        let of_round = counters.into_iter().find_map(|(counter, bounds)| (counter == local).then_some(bounds));
        let bounds = of_round.or_else(|| self.declared.get(&(local.index() as u32)).copied());
        // A loop without a round has a counter without a value: nothing follows from what its body does with it.
        bounds.filter(|(least, greatest)| least <= greatest)
    }

    fn range_within(&self, expr: ExprId, depth: u32) -> Option<Bounds> {
        let hir = self.cx.hir;
        let ty = hir[expr].ty;
        let limits = limits(ty)?;
        let depth = depth.checked_sub(1)?;
        // What would overflow wraps: then nothing is known.
        let fits = |bounds: Bounds| (bounds.0 >= limits.0 && bounds.1 <= limits.1).then_some(bounds);
        match hir[expr].kind {
            ExprKind::Literal(bits) => {
                let value = if ty == TypeId::UINT { i64::from(bits) } else { i64::from(bits as i32) };
                Some((value, value))
            }
            ExprKind::Local(local) => self.bounds_here(local),
            ExprKind::Convert(of) => match hir.types.scalar(hir[of].ty) {
                Some(Scalar::Bool) => Some((0, 1)),
                Some(Scalar::Int | Scalar::Uint) => fits(self.range_within(of, depth)?),
                Some(Scalar::Float) => match hir[of].kind {
                    ExprKind::Local(local) => fits(self.bounds_here(local)?),
                    ExprKind::Swizzle { base, swizzle }
                        if matches!(hir[base].kind, ExprKind::Uniform(Uniform::Resolution)) && swizzle.get(0) < 2 =>
                    {
                        Some((1, LARGEST_CANVAS))
                    }
                    _ => None,
                },
                _ => None,
            },
            ExprKind::Binary { op, shape: Shape::Same, lhs, rhs } => {
                let left = self.range_within(lhs, depth);
                let right = self.range_within(rhs, depth);
                match (op, left, right) {
                    (BinaryOp::Add, Some(l), Some(r)) => fits((l.0 + r.0, l.1 + r.1)),
                    (BinaryOp::Sub, Some(l), Some(r)) => fits((l.0 - r.1, l.1 - r.0)),
                    (BinaryOp::Mul, Some(l), Some(r)) => {
                        // Two uints may go beyond an i64, and then beyond the limits as well.
                        let all = [(l.0, r.0), (l.0, r.1), (l.1, r.0), (l.1, r.1)].map(|(l, r)| l.saturating_mul(r));
                        fits((*all.iter().min()?, *all.iter().max()?))
                    }
                    (BinaryOp::Div, Some(l), Some(r)) if l.0 >= 0 && r.0 > 0 => Some((l.0 / r.1, l.1 / r.0)),
                    (BinaryOp::BitAnd, _, Some((0.., mask))) | (BinaryOp::BitAnd, Some((0.., mask)), _) => {
                        Some((0, mask))
                    }
                    // With the divisor's sign: see `Builder::int_division`.
                    (BinaryOp::Rem, _, Some(r)) if r.0 > 0 => Some((0, r.1 - 1)),
                    (BinaryOp::Shr, left, Some(r)) if r.0 == r.1 && (0..32).contains(&r.0) => {
                        let left = left.unwrap_or(limits);
                        Some((left.0 >> r.0, left.1 >> r.0))
                    }
                    _ => None,
                }
            }
            ExprKind::Builtin { builtin, args } => {
                let args: Vec<_> =
                    hir[args].iter().map(|&arg| self.range_within(arg, depth).unwrap_or(limits)).collect();
                match (builtin, &args[..]) {
                    (Builtin::Min, [a, b]) => Some((a.0.min(b.0), a.1.min(b.1))),
                    (Builtin::Max, [a, b]) => Some((a.0.max(b.0), a.1.max(b.1))),
                    (Builtin::Clamp, [x, low, high]) => {
                        let max = (x.0.max(low.0), x.1.max(low.1));
                        Some((max.0.min(high.0), max.1.min(high.1)))
                    }
                    _ => None,
                }
            }
            ExprKind::Ternary { then, otherwise, .. } => {
                let (a, b) = (self.range_within(then, depth)?, self.range_within(otherwise, depth)?);
                Some((a.0.min(b.0), a.1.max(b.1)))
            }
            _ => None,
        }
    }

    /// Bounds of the parameters that a function does not write, where it is called here with `args`.
    pub fn bounds_of_arguments(&self, func: FuncId, args: &[ExprId]) -> Vec<(LocalId, Bounds)> {
        let hir = self.cx.hir;
        let first = hir[func].locals.start as usize;
        let params = (first..).map(LocalId::new).zip(args);
        let unwritten = params.filter(|(param, _)| self.cx.writes[param.index()] == 0);
        unwritten.filter_map(|(param, &arg)| Some((param, self.range(arg)?))).collect()
    }

    /// For `for (int i = a; i < b; i++)` whose `i` is written by the step alone: `i` and its bounds in the body. Any
    /// order of comparison and any known step will do.
    pub fn counter(&self, init: List<StmtId>, test: ExprId, step: Option<ExprId>) -> Option<(LocalId, Bounds)> {
        let hir = self.cx.hir;
        let ExprKind::Binary { op, shape: Shape::Same, lhs, rhs } = hir[test].kind else { return None };
        let (local, op, bound) = match (hir[lhs].kind, hir[rhs].kind) {
            (ExprKind::Local(local), _) => (local, op, rhs),
            (_, ExprKind::Local(local)) => (local, mirrored(op)?, lhs),
            _ => return None,
        };
        let limits = limits(hir[local].ty)?;
        if self.cx.writes[local.index()] != 1 {
            return None;
        }
        let start = self.start(init, local)?;
        let by = self.step(step?, local)?;
        let bound = self.range(bound)?;
        let bounds = match op {
            BinaryOp::Less | BinaryOp::LessEqual if by.0 >= 0 => {
                let last = bound.1 - i64::from(op == BinaryOp::Less);
                (last + by.1 <= limits.1).then_some((start.0, last))
            }
            BinaryOp::Greater | BinaryOp::GreaterEqual if by.1 <= 0 => {
                let least = bound.0 + i64::from(op == BinaryOp::Greater);
                (least + by.0 >= limits.0).then_some((least, start.1))
            }
            _ => None,
        }?;
        Some((local, bounds))
    }

    /// For `for (float x = 0.0; x < 9.0; x += 1.0)` whose `x` is written by the step alone, all of it literals: `x` and
    /// the bounds of `int(x)` in the body.
    pub fn float_counter(&self, init: List<StmtId>, test: ExprId, step: Option<ExprId>) -> Option<(LocalId, Bounds)> {
        let hir = self.cx.hir;
        let ExprKind::Binary { op, shape: Shape::Same, lhs, rhs } = hir[test].kind else { return None };
        let ExprKind::Local(local) = hir[lhs].kind else { return None };
        let float = |expr: ExprId| match hir[expr].kind {
            ExprKind::Literal(bits) if hir[expr].ty == TypeId::FLOAT => Some(f32::from_bits(bits)),
            _ => None,
        };
        if hir[local].ty != TypeId::FLOAT || self.cx.writes[local.index()] != 1 {
            return None;
        }
        let start = hir[init].iter().find_map(|&stmt| match hir[stmt].kind {
            StmtKind::Declare { local: declared, init: Some(init) } if declared == local => float(init),
            _ => None,
        })?;
        let is_local = |place: ExprId| matches!(hir[place].kind, ExprKind::Local(found) if found == local);
        let by = match hir[step?].kind {
            ExprKind::IncDec { op: IncDec::PreIncrement | IncDec::PostIncrement, place } if is_local(place) => 1.0,
            ExprKind::IncDec { op: IncDec::PreDecrement | IncDec::PostDecrement, place } if is_local(place) => -1.0,
            ExprKind::AssignOp { op: BinaryOp::Add, place, value, .. } if is_local(place) => float(value)?,
            ExprKind::AssignOp { op: BinaryOp::Sub, place, value, .. } if is_local(place) => -float(value)?,
            _ => return None,
        };
        let bound = float(rhs)?;
        // `int` cuts off towards zero. Sums are rounded, but never to the other side of where they began.
        let (first, last) = (start as i64, bound as i64);
        let before = i64::from(bound.fract() == 0.0);
        let bounds = match op {
            BinaryOp::LessEqual if by >= 0.0 => (first, last),
            BinaryOp::Less if by >= 0.0 && bound > 0.0 => (first, last - before),
            BinaryOp::GreaterEqual if by <= 0.0 => (last, first),
            BinaryOp::Greater if by <= 0.0 && bound < 0.0 => (last + before, first),
            BinaryOp::Greater if by <= 0.0 => (last, first),
            _ => return None,
        };
        Some((local, bounds))
    }

    /// What the loop's own declarations give `local`.
    fn start(&self, init: List<StmtId>, local: LocalId) -> Option<Bounds> {
        let hir = self.cx.hir;
        hir[init].iter().find_map(|&stmt| match hir[stmt].kind {
            StmtKind::Declare { local: declared, init } if declared == local => match init {
                Some(init) => self.range(init),
                None => Some((0, 0)),
            },
            StmtKind::Block(list) => self.start(list, local),
            _ => None,
        })
    }

    /// What the step adds to `local`.
    pub fn step(&self, step: ExprId, local: LocalId) -> Option<Bounds> {
        let hir = self.cx.hir;
        let is_local = |place: ExprId| matches!(hir[place].kind, ExprKind::Local(found) if found == local);
        match hir[step].kind {
            ExprKind::IncDec { op, place } if is_local(place) => Some(match op {
                IncDec::PreIncrement | IncDec::PostIncrement => (1, 1),
                IncDec::PreDecrement | IncDec::PostDecrement => (-1, -1),
            }),
            ExprKind::AssignOp { op, place, value, .. } if is_local(place) => match op {
                BinaryOp::Add => self.range(value),
                BinaryOp::Sub => self.range(value).map(|(least, greatest)| (-greatest, -least)),
                _ => None,
            },
            ExprKind::Comma { lhs, rhs } => self.step(rhs, local).or_else(|| match hir[lhs].kind {
                // One level: counters are rarely hidden deeper.
                ExprKind::Comma { .. } => None,
                _ => self.step(lhs, local),
            }),
            _ => None,
        }
    }
}

/// The comparison with its sides exchanged.
pub(super) fn mirrored(op: BinaryOp) -> Option<BinaryOp> {
    Some(match op {
        BinaryOp::Less => BinaryOp::Greater,
        BinaryOp::Greater => BinaryOp::Less,
        BinaryOp::LessEqual => BinaryOp::GreaterEqual,
        BinaryOp::GreaterEqual => BinaryOp::LessEqual,
        _ => return None,
    })
}
