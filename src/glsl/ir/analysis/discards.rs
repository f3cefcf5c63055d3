//! The functions that may discard the fragment.

use crate::ir::{Block, Function, Module, Op, Stmt};

/// Returns for each function whether it, or one that it calls, may discard; by [`crate::ir::FuncId::index`].
pub fn functions(program: &Module) -> Vec<bool> {
    let mut discards = Vec::with_capacity(program.functions.len());
    for f in &program.functions {
        discards.push(may_discard(f, &f.body, &discards));
    }
    discards
}

/// Returns whether a block may discard; `discards` are the functions that do.
pub fn may_discard(f: &Function, block: &Block, discards: &[bool]) -> bool {
    block.iter().any(|stmt| match stmt {
        Stmt::Discard => true,
        Stmt::Let(value) => calls(f, *value, discards),
        other => other.any_block(|block| may_discard(f, block, discards)),
    })
}

/// Returns whether a value is the result of a call that may discard.
pub fn calls(f: &Function, value: crate::ir::Value, discards: &[bool]) -> bool {
    matches!(f[value], Op::Call { function, .. } if discards[function.index()])
}
