//! Integers that one loop counts up or down, wherever it does that and wherever they are declared.
//!
//! In `int n = 4; while (n >= 1) { ..; n--; }` nothing but `n--` writes `n`, at most once for each time that the test held: so
//! `n` lies between 0 and 4 from its declaration on. [`ranges`](super::ranges) knows less, but more exactly, of `for (int i ..)`.

use std::collections::HashMap;

use super::{
    function::Builder,
    ranges::{Bounds, limits, mirrored},
};
use crate::glsl::{
    ast::List,
    hir::{BinaryOp, ExprId, ExprKind, LocalId, LogicalOp, Module, Shape, StmtId, StmtKind},
    ir::{Binary, Math, Value},
};

/// The loop's test, seen from the local at its left: `local op bound`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Counted {
    op: BinaryOp,
    bound: ExprId,
    /// The only expression that writes the local.
    step: ExprId,
}

/// By [`LocalId::index`]; `writes` counts the expressions that write each local.
pub(super) fn counted(module: &Module, writes: &[u32]) -> HashMap<usize, Counted> {
    let mut found = HashMap::new();
    for stmt in &module.stmts {
        let StmtKind::For { test: Some(test), step, body, .. } = stmt.kind else { continue };
        let mut tests = Vec::new();
        comparisons(module, test, &mut tests);
        tests.retain(|(local, ..)| writes[local.index()] == 1);
        if tests.is_empty() {
            continue;
        }
        let mut steps = Vec::new();
        step.into_iter().for_each(|step| effects(module, step, &mut steps));
        once_a_round(module, body, &mut steps);
        for (local, op, bound) in tests {
            if let Some(&(_, step)) = steps.iter().find(|(stepped, _)| *stepped == local) {
                found.insert(local.index(), Counted { op, bound, step });
            }
        }
    }
    found
}

/// What holds of locals where `test` does.
fn comparisons(module: &Module, test: ExprId, out: &mut Vec<(LocalId, BinaryOp, ExprId)>) {
    match module[test].kind {
        ExprKind::Logical { op: LogicalOp::And, lhs, rhs } => {
            comparisons(module, lhs, out);
            comparisons(module, rhs, out);
        }
        ExprKind::Binary { op, shape: Shape::Same, lhs, rhs } => {
            if let ExprKind::Local(local) = module[lhs].kind {
                out.push((local, op, rhs));
            }
            if let (ExprKind::Local(local), Some(op)) = (module[rhs].kind, mirrored(op)) {
                out.push((local, op, lhs));
            }
        }
        _ => {}
    }
}

/// Locals that are stepped by statements which a round runs at most once.
fn once_a_round(module: &Module, list: List<StmtId>, out: &mut Vec<(LocalId, ExprId)>) {
    for &stmt in &module[list] {
        match module[stmt].kind {
            StmtKind::Block(list) => once_a_round(module, list, out),
            StmtKind::If { then, otherwise, .. } => {
                once_a_round(module, then, out);
                once_a_round(module, otherwise, out);
            }
            StmtKind::Expr(expr) => effects(module, expr, out),
            _ => {}
        }
    }
}

fn effects(module: &Module, expr: ExprId, out: &mut Vec<(LocalId, ExprId)>) {
    match module[expr].kind {
        ExprKind::IncDec { place, .. } | ExprKind::AssignOp { place, .. } => {
            if let ExprKind::Local(local) = module[place].kind {
                out.push((local, expr));
            }
        }
        ExprKind::Comma { lhs, rhs } => {
            effects(module, lhs, out);
            effects(module, rhs, out);
        }
        _ => {}
    }
}

/// Loops of more rounds are not taken apart by Mesa's software drivers (`max_unroll_iterations`).
const UNROLLED: i64 = 32;

impl Builder<'_, '_> {
    /// The test of a loop whose counter, where it is known, changes by at most `rounds`. A bound that varies but is known to be
    /// small is said to be: Mesa unrolls `i < min(n, 3)`, but of `i < n` leaves a loop, and with it the arrays it indexes in
    /// memory.
    pub fn loop_test(&mut self, test: ExprId, rounds: Option<i64>) -> Value {
        let hir = self.cx.hir;
        if let ExprKind::Binary { op, shape: Shape::Same, lhs, rhs } = hir[test].kind
            && let (ExprKind::Local(_), Some(..UNROLLED)) = (hir[lhs].kind, rounds)
            && let (false, Some((_, most))) = (matches!(hir[rhs].kind, ExprKind::Literal(_)), self.range(rhs))
            && let (BinaryOp::Less | BinaryOp::LessEqual, Some(scalar)) = (op, hir.types.scalar(hir[rhs].ty))
        {
            let left = self.value(lhs);
            let right = self.value(rhs);
            let most = self.literal(scalar, most as u32);
            let right = self.math2(Math::Min, right, most);
            let op = if op == BinaryOp::Less { Binary::Less } else { Binary::LessEqual };
            return self.op(op, left, right);
        }
        self.value(test)
    }

    /// Notes what a declaration says of all values its local will have.
    pub fn note_range(&mut self, local: LocalId, init: Option<ExprId>) {
        let Some(limits) = limits(self.cx.hir[local].ty) else { return };
        // What a switch may jump over is left alone.
        if self.is_forced(local) {
            return;
        }
        let Some(start) = init.map_or(Some((0, 0)), |init| self.range(init)) else { return };
        let bounds = match self.cx.writes[local.index()] {
            0 => Some(start),
            _ => self.cx.counted.get(&local.index()).copied().and_then(|c| self.counted_range(local, start, limits, c)),
        };
        if let Some(bounds) = bounds {
            self.declared.insert(local.index() as u32, bounds);
        }
    }

    fn counted_range(&self, local: LocalId, start: Bounds, limits: Bounds, counted: Counted) -> Option<Bounds> {
        let by = self.step(counted.step, local)?;
        let bound = self.range(counted.bound)?;
        match counted.op {
            BinaryOp::Less | BinaryOp::LessEqual if by.0 >= 0 => {
                let last = bound.1 - i64::from(counted.op == BinaryOp::Less) + by.1;
                (last <= limits.1).then_some((start.0, start.1.max(last)))
            }
            BinaryOp::Greater | BinaryOp::GreaterEqual if by.1 <= 0 => {
                let least = bound.0 + i64::from(counted.op == BinaryOp::Greater) + by.0;
                (least >= limits.0).then_some((start.0.min(least), start.1))
            }
            _ => None,
        }
    }
}
