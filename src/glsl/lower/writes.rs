//! Places that expressions write.

use crate::hir::{ExprId, ExprKind, Module};

/// Calls `visit` for each place that an expression writes by itself: what it consists of and what it calls left out.
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

/// Returns the variable that a place is or lies in.
pub(super) fn root(module: &Module, mut place: ExprId) -> ExprId {
    while let ExprKind::Member { base, .. } | ExprKind::Swizzle { base, .. } | ExprKind::Index { base, .. } =
        module[place].kind
    {
        place = base;
    }
    place
}
