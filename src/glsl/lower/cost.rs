//! How much work an expression is, roughly: decides between a select, which computes both sides, and a branch.

use super::walk::parts;
use crate::glsl::hir::{Builtin, ExprId, ExprKind, Module};

/// Up to this much work is done for nothing rather than branched around. A branch costs about as much on every device, drivers
/// turn short branches into selects anyway, and chains of `?:` must not become branches nested a dozen deep.
pub(super) const CHEAP: u16 = 32;

/// Work of a texture read or call: never done for nothing.
const DEAR: u16 = 1000;

/// The cost of every expression. One pass: children come before their parents.
pub(super) fn costs(module: &Module) -> Vec<u16> {
    let mut costs: Vec<u16> = Vec::with_capacity(module.exprs.len());
    let mut within = Vec::new();
    for (i, expr) in module.exprs.iter().enumerate() {
        parts(module, ExprId::new(i), &mut within);
        let of_parts = within.drain(..).fold(0u16, |sum, id| sum.saturating_add(costs[id.index()]));
        let components = || module.types.components(expr.ty).unwrap_or(4) as u16;
        let own = match expr.kind {
            ExprKind::Index { index, .. } => match module[index].kind {
                ExprKind::Literal(_) => 0,
                _ => 2,
            },
            ExprKind::Unary { .. } | ExprKind::Convert(_) | ExprKind::Logical { .. } | ExprKind::Ternary { .. } => 1,
            ExprKind::Assign { .. } | ExprKind::AssignOp { .. } | ExprKind::IncDec { .. } => 2,
            ExprKind::Binary { .. } => components(),
            ExprKind::Builtin { builtin, .. } => of_builtin(builtin).saturating_mul(components()),
            ExprKind::Call { .. } => DEAR,
            _ => 0,
        };
        costs.push(of_parts.saturating_add(own));
    }
    costs
}

/// For each component of the result.
fn of_builtin(builtin: Builtin) -> u16 {
    use Builtin as B;
    match builtin {
        _ if builtin >= B::TextureSize => DEAR,
        B::Sin | B::Cos | B::Exp | B::Log | B::Exp2 | B::Log2 | B::Pow => 8,
        B::Tan | B::Asin | B::Acos | B::Atan | B::Sinh | B::Cosh | B::Tanh | B::Asinh | B::Acosh | B::Atanh => 16,
        B::Inverse | B::Determinant => 16,
        B::Sqrt | B::InverseSqrt | B::Normalize | B::Length | B::Distance | B::Mod | B::Smoothstep => 4,
        B::Reflect | B::Refract | B::FaceForward | B::Cross | B::Dot => 4,
        _ => 1,
    }
}
