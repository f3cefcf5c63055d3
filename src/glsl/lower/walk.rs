//! Visits all operands and children of statements and expressions, reachable or not, without recursion; and the places
//! that they write.

use crate::hir::{ExprId, ExprKind, Module, StmtId, StmtKind};

#[derive(Clone, Copy)]
pub(super) enum Node {
    Stmt(StmtId),
    Expr(ExprId),
}

/// Calls `visit` for these and everything within them, in no particular order, with the nesting depth of each.
pub(super) fn walk(module: &Module, stmts: &[StmtId], exprs: &[ExprId], mut visit: impl FnMut(Node, usize)) {
    let mut pending: Vec<(Node, usize)> = Vec::new();
    let (mut stmts, mut exprs) = (stmts.to_vec(), exprs.to_vec());
    let mut depth = 0;
    loop {
        pending.extend(stmts.drain(..).map(|stmt| (Node::Stmt(stmt), depth)));
        pending.extend(exprs.drain(..).map(|expr| (Node::Expr(expr), depth)));
        let Some((node, at)) = pending.pop() else { return };
        depth = at + 1;
        visit(node, at);
        let stmt = match node {
            Node::Expr(expr) => {
                module.parts(expr, &mut exprs);
                continue;
            }
            Node::Stmt(stmt) => stmt,
        };
        match module[stmt].kind {
            StmtKind::Block(list) => stmts.extend(&module[list]),
            StmtKind::Expr(expr) => exprs.push(expr),
            StmtKind::Declare { init: value, .. } | StmtKind::Return(value) => exprs.extend(value),
            StmtKind::If { cond, then, otherwise } => {
                exprs.push(cond);
                stmts.extend(module[then].iter().chain(&module[otherwise]));
            }
            StmtKind::For { init, test, step, body } => {
                exprs.extend(test.into_iter().chain(step));
                stmts.extend(module[init].iter().chain(&module[body]));
            }
            StmtKind::DoWhile { body, test } => {
                exprs.push(test);
                stmts.extend(&module[body]);
            }
            StmtKind::Switch { value, cases } => {
                exprs.push(value);
                stmts.extend(module[cases].iter().flat_map(|case| &module[case.body]));
            }
            StmtKind::Break | StmtKind::Continue | StmtKind::Discard => {}
        }
    }
}

/// Calls `visit` for each place that an expression itself writes, not including its operands and callees.
pub(super) fn places(module: &Module, expr: ExprId, mut visit: impl FnMut(ExprId)) {
    match module[expr].kind {
        ExprKind::Assign { place, .. } | ExprKind::AssignOp { place, .. } | ExprKind::IncDec { place, .. } => {
            visit(place)
        }
        ExprKind::Builtin { builtin, args } => builtin.writes.iter().for_each(|&at| visit(module[args][at])),
        ExprKind::Call { func, args } => {
            for (param, &arg) in module.params(func).iter().zip(&module[args]) {
                if param.kind.copies_out() {
                    visit(arg);
                }
            }
        }
        _ => {}
    }
}
