//! Chooses the functions to inline: those that are called at one place, in programs whose call chains a driver would
//! copy too often; and analyses how control leaves a function.

use crate::{
    ir::{Block, FuncId, Function, Module, Op, Stmt},
    types::TypeId,
};

/// The number of statements that a driver may keep of functions after inlining up to which nothing is done. Mesa uses
/// about half a kilobyte for each.
const FEW_COPIES: u64 = 1 << 17;

/// The maximum number of functions that are merged: a part is copied once for each function that contains it.
const MAX_CHAIN: usize = 128;

/// The maximum nesting depth of blocks. Mesa's CPU compilers support up to 80 (`LP_MAX_TGSI_NESTING`).
const MAX_DEPTH: usize = 64;

/// Properties of a function's body.
#[derive(Default)]
struct Facts {
    /// The called functions, once per call, with the nesting depth of the call.
    calls: Vec<(FuncId, usize)>,
    /// The number of blocks around the innermost statement, plus one for each `Return` except the last: the code after
    /// one becomes a branch.
    depth: usize,
    /// The body always ends in a `Discard`, which must be the last statement.
    discards: bool,
}

impl Facts {
    fn of(function: &Function) -> Facts {
        let body = &function.body;
        let never_returns = function.result != TypeId::VOID && !body.iter().any(returns);
        let discards = never_returns || matches!(body.last(), Some(Stmt::Discard));
        let mut facts = Facts { discards, ..Facts::default() };
        facts.block(function, body, 1);
        if matches!(body.last(), Some(Stmt::Return(_))) {
            facts.depth -= 1;
        }
        facts
    }

    fn block(&mut self, f: &Function, block: &Block, depth: usize) {
        self.depth = self.depth.max(depth);
        for stmt in block {
            match stmt {
                Stmt::Let(value) => {
                    if let Op::Call { function, .. } = f[*value] {
                        self.calls.push((function, depth));
                    }
                }
                Stmt::Return(_) => self.depth += 1,
                _ => stmt.blocks(|block| self.block(f, block, depth + 1)),
            }
        }
    }
}

/// Returns which functions are inlined, by [`FuncId::index`]; none if drivers have little to copy.
pub(super) fn inlined(module: &Module) -> Vec<bool> {
    // A driver that inlines everything keeps them all, before it removes unused functions (`nir_inline_functions`).
    let copies = module.inlined_sizes().into_iter().fold(0, u64::saturating_add);
    if copies <= FEW_COPIES {
        return Vec::new();
    }
    let facts: Vec<Facts> = module.functions.iter().map(Facts::of).collect();
    let mut places = vec![0usize; facts.len()];
    for (callee, _) in facts.iter().flat_map(|facts| &facts.calls) {
        places[callee.index()] += 1;
    }
    let mut inlined = vec![false; facts.len()];
    let (mut depths, mut lengths) = (vec![0; facts.len()], vec![1; facts.len()]);
    for (index, facts) in facts.iter().enumerate() {
        depths[index] = facts.depth;
        for (callee, depth) in facts.calls.iter().map(|(callee, depth)| (callee.index(), depth)) {
            if inlined[callee] {
                // Its body is in the block of the call.
                depths[index] = depths[index].max(depth - 1 + depths[callee]);
                lengths[index] += lengths[callee];
            }
        }
        inlined[index] =
            places[index] == 1 && !facts.discards && depths[index] <= MAX_DEPTH && lengths[index] < MAX_CHAIN;
    }
    inlined
}

/// Returns whether a statement may return from its function.
pub(super) fn returns(stmt: &Stmt) -> bool {
    matches!(stmt, Stmt::Return(_)) || stmt.any_block(|block| block.iter().any(returns))
}

/// Returns whether control cannot reach the end of a block, outside of loops and switches.
pub(super) fn always_leaves(block: &Block) -> bool {
    match block.last() {
        Some(Stmt::Return(_) | Stmt::Discard) => true,
        Some(Stmt::If { accept, reject, .. }) => always_leaves(accept) && always_leaves(reject),
        _ => false,
    }
}

/// Returns whether some `Return` is followed by statements that cannot be moved into the other branch, so that skipping
/// them depends on a variable.
pub(super) fn needs_flag(block: &Block) -> bool {
    block.iter().filter(|stmt| returns(stmt)).any(|stmt| match stmt {
        Stmt::If { accept, reject, .. } => {
            !always_leaves(accept) && !always_leaves(reject) || needs_flag(accept) || needs_flag(reject)
        }
        Stmt::Return(_) => false,
        _ => true,
    })
}
