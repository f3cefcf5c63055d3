//! Effects of statements: the places that they write, and whether control flow continues after them.

use crate::ir::{Block, Function, Op, Stmt, Value};

/// Visits the places that statements and their nested blocks write: those that are stored to, or passed to a call.
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

/// Returns whether a statement may end an iteration of the enclosing loop.
pub fn continues(stmt: &Stmt) -> bool {
    match stmt {
        Stmt::Continue => true,
        Stmt::Loop { .. } => false,
        other => other.any_block(|block| block.iter().any(continues)),
    }
}

/// Returns whether control flow never continues after a block.
pub fn leaves(block: &Block) -> bool {
    matches!(block.last(), Some(Stmt::Break | Stmt::Continue | Stmt::Return(_) | Stmt::Discard))
}
