//! Loops whose number of iterations is a small constant, which compilers of drivers write out.

use crate::{
    ir::{Binary, Block, Function, Op, Stmt, Value, VarId, analysis::stores},
    types::Scalar,
};

/// The most iterations that are written out (`max_unroll_iterations` in Mesa's drivers).
const MOST: u32 = 32;

/// Returns the number of iterations of a loop after these statements of its block: it starts with a test of a variable
/// against a constant, the variable is a constant before it, and `continuing` adds a constant.
pub(super) fn of(f: &Function, before: &[Stmt], body: &Block, continuing: &Block) -> Option<u32> {
    let test = body.iter().find(|stmt| !matches!(stmt, Stmt::Let(_)))?;
    let Stmt::If { condition, accept, reject } = test else { return None };
    let stays = match (&accept[..], &reject[..]) {
        ([], [Stmt::Break]) => true,
        ([Stmt::Break], []) => false,
        _ => return None,
    };
    let Op::Binary { op, left, right } = f[*condition] else { return None };
    let var = loaded(f, left)?;
    let limit = number(f, right)?;
    let first = before.iter().rev().find_map(|stmt| match stmt {
        Stmt::Store { place, value } if f[*place] == Op::Var(var) => Some(number(f, *value)),
        other => writes(f, std::slice::from_ref(other), var).then_some(None),
    })??;
    if writes(f, body, var) {
        return None;
    }
    let mut steps = continuing.iter().filter_map(|stmt| match stmt {
        Stmt::Store { place, value } if f[*place] == Op::Var(var) => Some(step(f, *value, var)),
        other => writes(f, std::slice::from_ref(other), var).then_some(None),
    });
    let (Some(Some(step)), None) = (steps.next(), steps.next()) else { return None };
    let mut at = first;
    for iteration in 0..=MOST {
        let holds = match op {
            Binary::Less => at < limit,
            Binary::LessEqual => at <= limit,
            Binary::Greater => at > limit,
            Binary::GreaterEqual => at >= limit,
            Binary::NotEqual => at != limit,
            _ => return None,
        };
        if holds != stays {
            return Some(iteration);
        }
        at += step;
    }
    None
}

fn writes(f: &Function, stmts: &[Stmt], var: VarId) -> bool {
    let mut found = false;
    stores(f, stmts, &mut |place| found |= f[f.root(place)] == Op::Var(var));
    found
}

/// Returns the variable whose whole value this is.
fn loaded(f: &Function, value: Value) -> Option<VarId> {
    let Op::Load { place } = f[value] else { return None };
    if let Op::Var(var) = f[place] { Some(var) } else { None }
}

fn number(f: &Function, value: Value) -> Option<f64> {
    match f[value] {
        Op::Literal(Scalar::Float, bits) => Some(f32::from_bits(bits).into()),
        Op::Literal(Scalar::Int, bits) => Some(f64::from(bits as i32)),
        Op::Literal(Scalar::Uint, bits) => Some(f64::from(bits)),
        Op::Zero(_) => Some(0.0),
        _ => None,
    }
}

/// Returns what a value adds to a variable.
fn step(f: &Function, value: Value, var: VarId) -> Option<f64> {
    let Op::Binary { op, left, right } = f[value] else { return None };
    match op {
        Binary::Add if loaded(f, left) == Some(var) => number(f, right),
        Binary::Add if loaded(f, right) == Some(var) => number(f, left),
        Binary::Subtract if loaded(f, left) == Some(var) => Some(-number(f, right)?),
        _ => None,
    }
}
