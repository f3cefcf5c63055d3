//! How much work an expression is, roughly: decides between a select, which computes both sides, and a branch.

use crate::glsl::hir::{Builtin, ExprId, ExprKind, Module};

/// Up to this much work is done for nothing rather than branched around. A branch costs about as much on every device, drivers
/// turn short branches into selects anyway, and chains of `?:` must not become branches nested a dozen deep.
pub(super) const CHEAP: u16 = 32;

/// Work of a texture read or call: never done for nothing.
const DEAR: u16 = 1000;

/// The cost of every expression. One pass: children come before their parents.
pub(super) fn costs(module: &Module) -> Vec<u16> {
    let mut costs = Vec::with_capacity(module.exprs.len());
    for expr in &module.exprs {
        let at = |id: ExprId| -> u16 { costs[id.index()] };
        let sum = |ids: &[ExprId]| ids.iter().fold(0u16, |sum, &id| sum.saturating_add(costs[id.index()]));
        let cost = match expr.kind {
            ExprKind::Error
            | ExprKind::Literal(_)
            | ExprKind::Const(_)
            | ExprKind::Local(_)
            | ExprKind::Global(_)
            | ExprKind::Uniform(_)
            | ExprKind::Knob(_)
            | ExprKind::Channel(_)
            | ExprKind::BuiltinVar(_) => 0,
            ExprKind::Member { base, .. } | ExprKind::Swizzle { base, .. } => at(base),
            ExprKind::Index { base, index } => match module[index].kind {
                ExprKind::Literal(_) => at(base),
                _ => at(base).saturating_add(at(index)).saturating_add(2),
            },
            ExprKind::Unary { operand, .. } | ExprKind::Convert(operand) => at(operand).saturating_add(1),
            ExprKind::Splat(of) | ExprKind::MatrixDiagonal(of) | ExprKind::MatrixResize(of) => at(of),
            ExprKind::Binary { lhs, rhs, .. } => {
                let parts = module.types.components(expr.ty).unwrap_or(4) as u16;
                at(lhs).saturating_add(at(rhs)).saturating_add(parts)
            }
            ExprKind::Logical { lhs, rhs, .. } => at(lhs).saturating_add(at(rhs)).saturating_add(1),
            ExprKind::Ternary { cond, then, otherwise } => sum(&[cond, then, otherwise]).saturating_add(1),
            ExprKind::Comma { lhs, rhs } => at(lhs).saturating_add(at(rhs)),
            ExprKind::Assign { place, value } | ExprKind::AssignOp { place, value, .. } => {
                at(place).saturating_add(at(value)).saturating_add(2)
            }
            ExprKind::IncDec { place, .. } => at(place).saturating_add(2),
            ExprKind::Vector(args) | ExprKind::Matrix(args) | ExprKind::Struct(args) | ExprKind::Array(args) => {
                sum(&module[args])
            }
            ExprKind::Call { args, .. } => sum(&module[args]).saturating_add(DEAR),
            ExprKind::Builtin { builtin, args } => {
                let parts = module.types.components(expr.ty).unwrap_or(4) as u16;
                sum(&module[args]).saturating_add(of_builtin(builtin).saturating_mul(parts))
            }
        };
        costs.push(cost);
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
