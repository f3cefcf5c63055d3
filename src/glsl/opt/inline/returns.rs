//! The ways in which control leaves a function.

use crate::ir::{Block, Stmt};

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
