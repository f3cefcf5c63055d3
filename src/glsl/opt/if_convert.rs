//! If-conversion: `?:`, `&&` and `||` whose sides are cheap and have no effects become selects.
//!
//! A branch costs about as much as a few dozen operations on every device, drivers turn short branches into selects
//! anyway, and chains of `?:` must not become branches nested a dozen deep. Lowering writes each as
//!
//! ```text
//! $r <- %left          (only && and ||)
//! if %c { ..; $r <- %a } else { ..; $r <- %b }
//! %v = load $r
//! ```
//!
//! where nothing else names `$r`.

use crate::glsl::{
    ir::{Binary, Block, Function, Math, Module, Op, Stmt, Value},
    types::{Type, TypeId},
};

/// Up to this much work is done for nothing rather than branched around.
const CHEAP: u32 = 32;

/// Work of a texture read or call: never done for nothing.
const DEAR: u32 = 1000;

pub(super) fn run(module: &mut Module) {
    let mut functions = std::mem::take(&mut module.functions);
    for f in &mut functions {
        let mut body = std::mem::take(&mut f.body);
        let mut converted = Vec::new();
        block(module, f, &mut body, &mut converted);
        f.body = body;
        if !converted.is_empty() {
            f.drop_vars(&converted);
        }
    }
    module.functions = functions;
}

/// Converts the branches of a block, inner ones first. `converted` gets the places that are named no more.
fn block(module: &Module, f: &mut Function, stmts: &mut Block, converted: &mut Vec<Value>) {
    let mut is_there = false;
    for stmt in stmts.iter_mut() {
        is_there |= matches!(stmt, Stmt::If { .. });
        stmt.blocks_mut(|inner| block(module, f, inner, converted));
    }
    if !is_there {
        return;
    }
    let mut out: Block = Vec::with_capacity(stmts.len());
    let mut rest = std::mem::take(stmts).into_iter().peekable();
    while let Some(stmt) = rest.next() {
        let Stmt::If { condition, mut accept, mut reject } = stmt else {
            out.push(stmt);
            continue;
        };
        let sides = match rest.peek() {
            Some(Stmt::Let(load)) => sides(module, f, *load, &accept, &reject, out.last()),
            _ => None,
        };
        let Some(Sides { place, accepted, rejected, is_logical }) = sides else {
            out.push(Stmt::If { condition, accept, reject });
            continue;
        };
        for side in [&mut accept, &mut reject] {
            side.pop();
        }
        if is_logical {
            out.pop();
        }
        out.append(&mut accept);
        out.append(&mut reject);
        let Some(Stmt::Let(load)) = rest.next() else { unreachable!("it was peeked at") };
        let op = match (is_logical, accepted == condition) {
            (true, true) => Op::Binary { op: Binary::LogicalOr, left: condition, right: rejected },
            (true, false) => Op::Binary { op: Binary::LogicalAnd, left: condition, right: accepted },
            _ => Op::Select { condition, accept: accepted, reject: rejected },
        };
        f.replace(load, op);
        out.push(Stmt::Let(load));
        converted.push(place);
    }
    *stmts = out;
}

/// What a branch becomes.
struct Sides {
    place: Value,
    accepted: Value,
    rejected: Value,
    /// One side is the value stored before the branch, which is its condition.
    is_logical: bool,
}

/// `None` if the branch before a load stays one.
fn sides(
    module: &Module,
    f: &Function,
    load: Value,
    accept: &Block,
    reject: &Block,
    before: Option<&Stmt>,
) -> Option<Sides> {
    let Op::Load { place } = f[load] else { return None };
    let Op::Var(var) = f[place] else { return None };
    let is_small = matches!(module.types.get(f.ty(place)), Type::Scalar(_) | Type::Vector { .. });
    if !f.vars[var.index()].is_temporary || !is_small {
        return None;
    }
    let side = |block: &Block| match block.split_last() {
        Some((Stmt::Store { place: to, value }, lets)) if *to == place && is_cheap(module, f, lets) => Some(*value),
        _ => None,
    };
    let stored = match before {
        Some(Stmt::Store { place: to, value }) if *to == place => Some(*value),
        _ => None,
    };
    match (accept.is_empty(), reject.is_empty()) {
        (false, false) => Some(Sides { place, accepted: side(accept)?, rejected: side(reject)?, is_logical: false }),
        (false, true) => Some(Sides { place, accepted: side(accept)?, rejected: stored?, is_logical: true }),
        (true, false) => Some(Sides { place, accepted: stored?, rejected: side(reject)?, is_logical: true }),
        (true, true) => None,
    }
}

fn is_cheap(module: &Module, f: &Function, lets: &[Stmt]) -> bool {
    let mut work = 0;
    lets.iter().all(|stmt| {
        let Stmt::Let(value) = stmt else { return false };
        work += cost(module, f, *value);
        work <= CHEAP
    })
}

/// How much work an operation is, roughly.
fn cost(module: &Module, f: &Function, value: Value) -> u32 {
    let components = |ty: TypeId| module.types.components(ty).unwrap_or(4);
    match f[value] {
        Op::Call { .. } | Op::Sample { .. } | Op::Fetch { .. } | Op::TextureSize { .. } | Op::TextureLevels { .. } => {
            DEAR
        }
        Op::Element { .. } => 2,
        Op::Unary { .. } | Op::Convert { .. } | Op::Select { .. } | Op::All(_) | Op::Any(_) | Op::Derivative { .. } => {
            1
        }
        Op::Binary { left, right, .. } => {
            components(f.ty(value)).max(components(f.ty(left))).max(components(f.ty(right)))
        }
        Op::Math { fun, arg, .. } => of_function(fun) * components(f.ty(arg)),
        _ => 0,
    }
}

/// For each component.
fn of_function(fun: Math) -> u32 {
    use Math::*;
    match fun {
        Sin | Cos | Exp | Log | Exp2 | Log2 | Pow => 8,
        Tan | Asin | Acos | Atan | Atan2 | Sinh | Cosh | Tanh | Asinh | Acosh | Atanh | Determinant => 16,
        Sqrt | InverseSqrt | Normalize | Length | SmoothStep | FaceForward | Cross => 4,
        _ => 1,
    }
}
