//! What loops count down to, hidden from drivers that take its largest value for its least.
//!
//! Mesa's `nir_loop_analyze.c` bounds the rounds of a loop whose counter is compared with `min(c, x)` as if that were `c`. This
//! is right for `i < min(c, x)`, but `for (int i = 4; i > min(6, x); i--)` then has no round at all. The comparison may lie in any
//! exit of the loop, and the `min` in a variable, so each limit that is no constant is hidden.

use std::collections::HashSet;

use super::{ranges::mirrored, walk};
use crate::glsl::{
    ast::List,
    hir::{BinaryOp, ExprFlags, ExprId, ExprKind, LogicalOp, Module, Shape, StmtId, StmtKind, UnaryOp},
};

/// The operands that a place is compared with where a loop goes on while it is greater than these.
pub(super) fn limits(module: &Module) -> HashSet<ExprId> {
    let (mut found, mut seen) = (HashSet::new(), HashSet::new());
    // What consists of statements comes after these: an outer loop is met first, and its inner ones with it.
    for stmt in (0..module.stmts.len()).rev().map(StmtId::new) {
        let is_loop = matches!(module[stmt].kind, StmtKind::For { .. } | StmtKind::DoWhile { .. });
        if !is_loop || seen.contains(&stmt) {
            continue;
        }
        walk::walk(module, &[stmt], &[], |node, _| {
            let walk::Node::Stmt(stmt) = node else { return };
            match module[stmt].kind {
                StmtKind::For { test, .. } => {
                    seen.insert(stmt);
                    test.into_iter().for_each(|test| compared(module, test, true, &mut found));
                }
                StmtKind::DoWhile { test, .. } => {
                    seen.insert(stmt);
                    compared(module, test, true, &mut found);
                }
                StmtKind::If { cond, then, otherwise } => {
                    if leaves(module, then) {
                        compared(module, cond, false, &mut found);
                    }
                    if leaves(module, otherwise) {
                        compared(module, cond, true, &mut found);
                    }
                }
                _ => {}
            }
        });
    }
    found
}

/// Whether statements end with leaving the loop: a `return` becomes a `break` where the function becomes part of its caller.
fn leaves(module: &Module, list: List<StmtId>) -> bool {
    module[list].last().is_some_and(|&stmt| match module[stmt].kind {
        StmtKind::Break | StmtKind::Return(_) => true,
        StmtKind::Block(list) => leaves(module, list),
        _ => false,
    })
}

/// Adds the limits in a condition with which, if it is `goes_on`, the loop goes on.
fn compared(module: &Module, cond: ExprId, goes_on: bool, out: &mut HashSet<ExprId>) {
    match module[cond].kind {
        ExprKind::Logical { op: LogicalOp::And | LogicalOp::Or, lhs, rhs } => {
            compared(module, lhs, goes_on, out);
            compared(module, rhs, goes_on, out);
        }
        ExprKind::Unary { op: UnaryOp::Not, operand } => compared(module, operand, !goes_on, out),
        ExprKind::Binary { op, shape: Shape::Same, lhs, rhs } => {
            let Some(mirrored) = mirrored(op) else { return };
            for (place, op, limit) in [(lhs, op, rhs), (rhs, mirrored, lhs)] {
                let is_counter = matches!(module[place].kind, ExprKind::IncDec { .. })
                    || module[place].flags.contains(ExprFlags::PLACE);
                let is_greater = matches!(op, BinaryOp::Greater | BinaryOp::GreaterEqual) == goes_on;
                if is_counter && is_greater && !module[limit].flags.contains(ExprFlags::CONSTANT) {
                    out.insert(limit);
                }
            }
        }
        _ => {}
    }
}
