//! Moves the step of loops to the end of the body: Mesa's loop analysis (`nir_loop_analyze.c`) knows the number of
//! iterations of such a loop, and so unrolls it, but knows that of fewer loops whose `continuing` part is the target of
//! several jumps. Mesa's own GLSL compiler repeats the step of a `for` before each `continue`; here a short one is
//! repeated as well.

use rustc_hash::FxHashMap;

use crate::ir::{
    Block, Function, Module, Op, Stmt, Value,
    analysis::{continues, leaves},
};

/// The maximum number of statements of a step that is repeated.
const MAX_STATEMENTS: usize = 16;

pub(super) fn run(program: &mut Module) {
    for f in &mut program.functions {
        let mut body = std::mem::take(&mut f.body);
        block(f, &mut body);
        f.body = body;
    }
}

fn block(f: &mut Function, stmts: &mut Block) {
    for stmt in stmts {
        stmt.blocks_mut(|inner| block(f, inner));
        if let Stmt::Loop { body, continuing, break_if: None } = stmt
            && !continuing.is_empty()
            && (!body.iter().any(continues) || is_short(f, continuing))
        {
            let step = std::mem::take(continuing);
            before_continues(f, body, &step);
            if !leaves(body) {
                body.extend(step);
            }
        }
    }
}

fn is_short(f: &Function, step: &Block) -> bool {
    let is_simple = |stmt: &Stmt| match stmt {
        Stmt::Let(value) => !matches!(f[*value], Op::Call { .. }),
        Stmt::Store { .. } => true,
        _ => false,
    };
    step.len() <= MAX_STATEMENTS && step.iter().all(is_simple)
}

/// Repeats a step before each `Continue` of the enclosing loop.
fn before_continues(f: &mut Function, block: &mut Block, step: &Block) {
    for stmt in block.iter_mut() {
        if !matches!(stmt, Stmt::Loop { .. }) {
            stmt.blocks_mut(|inner| before_continues(f, inner, step));
        }
    }
    if let Some(Stmt::Continue) = block.last() {
        block.pop();
        copy(f, step, block);
        block.push(Stmt::Continue);
    }
}

/// Copies statements that contain no other statements.
fn copy(f: &mut Function, step: &Block, out: &mut Block) {
    let mut new: FxHashMap<Value, Value> = FxHashMap::default();
    for stmt in step {
        let mut stmt = stmt.clone();
        if let Stmt::Let(value) = &mut stmt {
            let mut op = f[*value].clone();
            op.operands_mut(|operand| *operand = new.get(operand).copied().unwrap_or(*operand));
            let made = f.append(op, f.ty(*value), f.origin(*value));
            new.insert(*value, made);
            *value = made;
        }
        stmt.operands_mut(|operand| *operand = new.get(operand).copied().unwrap_or(*operand));
        out.push(stmt);
    }
}
