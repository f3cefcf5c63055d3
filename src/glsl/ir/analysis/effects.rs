//! Effects of statements: the places that they write, and whether control goes on behind them.

use crate::ir::{Block, Function, Op, Stmt, Value};

/// Visits the places that statements write, with those of the blocks within: that are stored to, or given to a call.
pub fn stores(f: &Function, stmts: &[Stmt], visit: &mut impl FnMut(Value)) {
    for stmt in stmts {
        match stmt {
            Stmt::Store { place, .. } => visit(*place),
            Stmt::Let(value) => {
                if let Op::Call { args, .. } = &f[*value] {
                    args.iter().copied().filter(|&arg| f.is_place(arg)).for_each(&mut *visit);
                }
            }
            _ => stmt.blocks(|block| stores(f, block, visit)),
        }
    }
}

/// Returns whether no way leads behind a block.
pub fn leaves(block: &Block) -> bool {
    matches!(block.last(), Some(Stmt::Break | Stmt::Continue | Stmt::Return(_) | Stmt::Discard))
}
