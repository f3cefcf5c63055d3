//! The choice of the functions that become part of their callers: those that are called at one place, in programs whose
//! chains of calls a driver would copy too often; and the ways in which control leaves a function.

use crate::{
    ir::{Block, FuncId, Function, Module, Op, Stmt},
    types::TypeId,
};

/// Statements that a driver may hold of functions that it has inlined others into, for nothing to be done. Mesa takes
/// about half a kilobyte for each.
const FEW_COPIES: u64 = 1 << 17;

/// Functions that become one at most: a part is copied once for each function that it comes to lie in.
const LONGEST_CHAIN: usize = 128;

/// Blocks that may come to lie in one another. Mesa's compilers for the processor count to 80 (`LP_MAX_TGSI_NESTING`).
const DEEPEST: usize = 64;

/// Facts of a function's body.
#[derive(Default)]
struct Facts {
    /// Called functions, each as often as it is called, with how deep the call nests.
    calls: Vec<(FuncId, usize)>,
    /// Blocks around the innermost statement, and one for each `Return` but the last: what follows one becomes a branch.
    depth: usize,
    /// It always ends in a `Discard`, which nothing may follow.
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

/// Returns which functions are inlined, by [`FuncId::index`]; none where drivers have little to copy.
pub(super) fn inlined(module: &Module) -> Vec<bool> {
    // A driver that inlines everything has them all, before it drops what nothing calls any more
    // (`nir_inline_functions`).
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
                // Its body lies in the block of the call.
                depths[index] = depths[index].max(depth - 1 + depths[callee]);
                lengths[index] += lengths[callee];
            }
        }
        inlined[index] =
            places[index] == 1 && !facts.discards && depths[index] <= DEEPEST && lengths[index] < LONGEST_CHAIN;
    }
    inlined
}

/// Returns whether a statement may return from its function.
pub(super) fn returns(stmt: &Stmt) -> bool {
    let any = |block: &Block| block.iter().any(returns);
    match stmt {
        Stmt::Return(_) => true,
        Stmt::If { accept, reject, .. } => any(accept) || any(reject),
        Stmt::Loop { body, .. } => any(body),
        Stmt::Switch { cases, .. } => cases.iter().any(|case| any(&case.body)),
        _ => false,
    }
}

/// Returns whether control cannot reach the end of a block, outside of loops and switches.
pub(super) fn always_leaves(block: &Block) -> bool {
    match block.last() {
        Some(Stmt::Return(_) | Stmt::Discard) => true,
        Some(Stmt::If { accept, reject, .. }) => always_leaves(accept) && always_leaves(reject),
        _ => false,
    }
}

/// Returns whether some `Return` is followed by statements that no branch beside it can hold: what then is left out
/// depends on a variable.
pub(super) fn needs_flag(block: &Block) -> bool {
    block.iter().filter(|stmt| returns(stmt)).any(|stmt| match stmt {
        Stmt::If { accept, reject, .. } => {
            !always_leaves(accept) && !always_leaves(reject) || needs_flag(accept) || needs_flag(reject)
        }
        Stmt::Return(_) => false,
        _ => true,
    })
}
