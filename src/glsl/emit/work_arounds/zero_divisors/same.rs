//! Finds differences that are zero because both sides are the same.

use crate::ir::{Function, Op, Value};

/// The maximum depth to which two expressions are compared.
const MAX_DEPTH: u32 = 8;

/// Returns whether two values are the same expression of the same variables, so that a driver may fold their difference
/// to zero.
pub(super) fn is_same(f: &Function, left: Value, right: Value) -> bool {
    is_same_to(f, left, right, MAX_DEPTH)
}

fn is_same_to(f: &Function, left: Value, right: Value, levels: u32) -> bool {
    if left == right {
        return true;
    }
    let (l, r) = (&f[left], &f[right]);
    if levels == 0 || std::mem::discriminant(l) != std::mem::discriminant(r) || matches!(l, Op::Call { .. }) {
        return false;
    }
    // The operations are compared with their operands replaced.
    let (mut of_left, mut of_right) = (Vec::new(), Vec::new());
    let (mut shape_left, mut shape_right) = (l.clone(), r.clone());
    shape_left.operands_mut(|value| of_left.push(std::mem::replace(value, left)));
    shape_right.operands_mut(|value| of_right.push(std::mem::replace(value, left)));
    shape_left == shape_right && of_left.iter().zip(&of_right).all(|(&l, &r)| is_same_to(f, l, r, levels - 1))
}
