//! Variables that a branch may write, and jumps that it may take, determined statically: an undefined condition decides
//! them.

use eddy_glsl::{
    ir::{Block, Function, Module, Op, Stmt, Value},
    types::TypeId,
    walk,
};
use std::collections::HashSet;

/// Cells of a variable, a parameter by reference or a global that may be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Written {
    /// The variable, as the value that is its address.
    pub root: Value,
    pub start: usize,
    pub count: usize,
}

/// The possible effects of a part of a program.
#[derive(Clone, Debug, Default)]
pub(super) struct Effects {
    pub writes: HashSet<Written>,
    pub breaks: bool,
    pub continues: bool,
    pub returns: bool,
    pub discards: bool,
}

/// The memory outside of a function that it may write.
#[derive(Clone, Debug, Default)]
pub(super) struct Summary {
    /// By parameter, or by global: the first cell, and the number of cells.
    params: HashSet<(u32, usize, usize)>,
    pub globals: HashSet<(eddy_glsl::ir::GlobalId, usize, usize)>,
    discards: bool,
}

/// Returns the summaries of all functions; callees come first.
pub(super) fn summaries(module: &Module) -> Vec<Summary> {
    let mut all: Vec<Summary> = Vec::with_capacity(module.functions.len());
    for function in &module.functions {
        let mut effects = Effects::default();
        let mut own = Summary::default();
        let mut globals = HashSet::new();
        add_block(module, function, &all, &function.body, &mut effects, &mut globals);
        own.discards = effects.discards;
        for written in effects.writes {
            match function[written.root] {
                Op::Param(index) => _ = own.params.insert((index, written.start, written.count)),
                Op::Global(global) => _ = globals.insert((global, written.start, written.count)),
                _ => {}
            }
        }
        own.globals = globals;
        all.push(own);
    }
    all
}

/// Globals that callees write.
pub(super) type Globals = HashSet<(eddy_glsl::ir::GlobalId, usize, usize)>;

/// Adds the effects of the statements of a block. Jumps that stay inside of it are left out.
pub(super) fn add_block(
    module: &Module,
    function: &Function,
    summaries: &[Summary],
    block: &[Stmt],
    effects: &mut Effects,
    globals: &mut Globals,
) {
    for stmt in block {
        add_stmt(module, function, summaries, stmt, effects, globals);
    }
}

pub(super) fn add_stmt(
    module: &Module,
    function: &Function,
    summaries: &[Summary],
    stmt: &Stmt,
    effects: &mut Effects,
    globals: &mut Globals,
) {
    let (breaks, continues) = (effects.breaks, effects.continues);
    match stmt {
        Stmt::Store { place, .. } => _ = effects.writes.insert(written(module, function, *place)),
        Stmt::Let(value) => {
            if let Op::Call { function: callee, args } = &function[*value]
                && let Some(summary) = summaries.get(callee.index())
            {
                for &(param, start, count) in &summary.params {
                    let whole = written(module, function, args[param as usize]);
                    let inside = whole.count == walk::cells(module, function.ty(args[param as usize]));
                    effects.writes.insert(match inside {
                        true => Written { start: whole.start + start, count, ..whole },
                        false => whole,
                    });
                }
                globals.extend(&summary.globals);
                effects.discards |= summary.discards;
            }
        }
        Stmt::Break => effects.breaks = true,
        Stmt::Continue => effects.continues = true,
        Stmt::Return(_) => effects.returns = true,
        Stmt::Discard => effects.discards = true,
        Stmt::Output(_) => {}
        Stmt::If { .. } | Stmt::Loop { .. } | Stmt::Switch { .. } => {
            stmt.blocks(|block| add_block(module, function, summaries, block, effects, globals));
            match stmt {
                Stmt::Loop { .. } => (effects.breaks, effects.continues) = (breaks, continues),
                Stmt::Switch { .. } => effects.breaks = breaks,
                _ => {}
            }
        }
    }
}

/// Returns the cells that a store to a place may write; all cells for an index that is not statically known.
fn written(module: &Module, function: &Function, place: Value) -> Written {
    let mut links = Vec::new();
    let mut root = place;
    while let Op::Part { base, .. } | Op::Element { base, .. } = function[root] {
        links.push(root);
        root = base;
    }
    let mut ty: TypeId = function.ty(root);
    let (mut start, mut count) = (0, walk::cells(module, ty));
    for link in links.into_iter().rev() {
        let Op::Part { index, .. } = function[link] else { break };
        start += (0..index).map(|i| walk::cells(module, module.part(ty, i))).sum::<usize>();
        ty = module.part(ty, index);
        count = walk::cells(module, ty);
    }
    Written { root, start, count }
}

/// Adds the effects that are skipped if a jump out of `stmt` is taken: the statements after it up to the jump's target,
/// and the loops that it leaves. Returns whether the block contains `stmt`.
pub(super) fn add_rest(
    (module, function, summaries): (&Module, &Function, &[Summary]),
    block: &Block,
    stmt: *const Stmt,
    jumps: &mut Effects,
    effects: &mut Effects,
    globals: &mut Globals,
) -> bool {
    for (at, outer) in block.iter().enumerate() {
        let mut is_inside = std::ptr::eq(outer, stmt);
        if !is_inside {
            outer.blocks(|inner| {
                is_inside = is_inside || add_rest((module, function, summaries), inner, stmt, jumps, effects, globals);
            });
            if is_inside {
                match outer {
                    Stmt::Loop { .. } => {
                        if jumps.breaks || jumps.returns {
                            let mut scratch = Effects::default();
                            add_stmt(module, function, summaries, outer, &mut scratch, globals);
                            effects.writes.extend(scratch.writes);
                        }
                        (jumps.breaks, jumps.continues) = (false, false);
                    }
                    Stmt::Switch { .. } => jumps.breaks = false,
                    _ => {}
                }
            }
        }
        if is_inside {
            if jumps.breaks || jumps.continues || jumps.returns {
                let mut scratch = Effects::default();
                add_block(module, function, summaries, &block[at + 1..], &mut scratch, globals);
                effects.writes.extend(scratch.writes);
            }
            return true;
        }
    }
    false
}
