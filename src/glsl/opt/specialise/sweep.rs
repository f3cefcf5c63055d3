//! Removes what folding has left without a use: stores to variables that nothing loads, calls without an effect whose
//! results nothing uses, and arguments that the called function does not read.

use crate::ir::{Block, Function, GlobalKind, Module, Op, Stmt, Value};

pub(super) fn run(module: &mut Module) {
    remove_dead_calls(module);
    super::super::dce::run(module);
    module.drop_uncalled();
    remove_unread_arguments(module);
    remove_dead_stores(module);
    super::super::dce::run(module);
}

/// Visits all statements of a block, outer ones before inner ones.
fn each_stmt<'a>(block: &'a Block, visit: &mut impl FnMut(&'a Stmt)) {
    for stmt in block {
        visit(stmt);
        stmt.blocks(|block| each_stmt(block, visit));
    }
}

/// Keeps the statements, at any depth, for which a condition is true.
fn retain(block: &mut Block, keep: &impl Fn(&Stmt) -> bool) {
    block.retain(keep);
    for stmt in block {
        stmt.blocks_mut(|block| retain(block, keep));
    }
}

/// Returns for each function whether a call of it can have an effect besides its result.
fn effects(module: &Module) -> Vec<bool> {
    let mut all: Vec<bool> = Vec::with_capacity(module.functions.len());
    for f in &module.functions {
        let mut has_effect = f.params.iter().any(|param| param.by_reference);
        each_stmt(&f.body, &mut |stmt| {
            has_effect |= match stmt {
                Stmt::Store { place, .. } => !matches!(f[f.root(*place)], Op::Var(_)),
                Stmt::Discard | Stmt::Output(_) => true,
                Stmt::Let(value) => match f[*value] {
                    Op::Call { function, .. } => all[function.index()],
                    _ => false,
                },
                _ => false,
            };
        });
        all.push(has_effect);
    }
    all
}

fn remove_dead_calls(module: &mut Module) {
    let effects = effects(module);
    for f in &mut module.functions {
        let mut body = std::mem::take(&mut f.body);
        let mut is_used = vec![false; f.len()];
        each_stmt(&body, &mut |stmt| {
            if let Stmt::Let(value) = stmt {
                f[*value].operands(|operand| is_used[operand.index()] = true);
            }
            stmt.operands(|operand| is_used[operand.index()] = true);
        });
        retain(&mut body, &|stmt| match stmt {
            Stmt::Let(value) => match f[*value] {
                Op::Call { function, .. } => is_used[value.index()] || effects[function.index()],
                _ => true,
            },
            _ => true,
        });
        f.body = body;
    }
}

fn remove_unread_arguments(module: &mut Module) {
    let is_read: Vec<Vec<bool>> = module
        .functions
        .iter()
        .map(|f| {
            let mut is_read = vec![false; f.params.len()];
            for (_, op) in f.values() {
                if let Op::Param(index) = op {
                    is_read[*index as usize] = true;
                }
            }
            is_read
        })
        .collect();
    let params: Vec<Vec<_>> = module.functions.iter().map(|f| f.params.clone()).collect();
    for f in &mut module.functions {
        for index in 0..f.len() {
            let value = Value::new(index);
            let Op::Call { function, ref args } = f[value] else { continue };
            let callee = function.index();
            let mut args = args.clone();
            for (n, arg) in args.iter_mut().enumerate() {
                let param = params[callee][n];
                if !is_read[callee][n] && !param.by_reference && !matches!(f[*arg], Op::Zero(_)) {
                    *arg = f.append(Op::Zero(param.ty), param.ty, crate::ir::Origin::default());
                }
            }
            f.replace(value, Op::Call { function, args });
        }
    }
}

fn remove_dead_stores(module: &mut Module) {
    let mut loaded_globals = vec![false; module.globals.len()];
    let mut loaded_vars: Vec<Vec<bool>> = Vec::new();
    for f in &module.functions {
        let mut vars = vec![false; f.vars.len()];
        let mut load = |f: &Function, place: Value| match f[f.root(place)] {
            Op::Var(id) => vars[id.index()] = true,
            Op::Global(id) => loaded_globals[id.index()] = true,
            _ => {}
        };
        for (_, op) in f.values() {
            match op {
                Op::Load { place } => load(f, *place),
                Op::Call { args, .. } => args.iter().filter(|&&arg| f.is_place(arg)).for_each(|&arg| load(f, arg)),
                _ => {}
            }
        }
        loaded_vars.push(vars);
    }
    let globals = module.globals.clone();
    for (f, vars) in module.functions.iter_mut().zip(&loaded_vars) {
        let mut body = std::mem::take(&mut f.body);
        retain(&mut body, &|stmt| match stmt {
            Stmt::Store { place, .. } => match f[f.root(*place)] {
                Op::Var(id) => vars[id.index()],
                Op::Global(id) => {
                    loaded_globals[id.index()] || !matches!(globals[id.index()].kind, GlobalKind::Private(_))
                }
                _ => true,
            },
            _ => true,
        });
        f.body = body;
    }
}
