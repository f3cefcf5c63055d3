//! Dead code elimination: removes operations whose results are not used by anything that has an effect. Earlier passes
//! leave the operations that they replaced.

use crate::ir::{Block, Function, Module, Op, Stmt};

pub(super) fn run(module: &mut Module) {
    for function in &mut module.functions {
        let mut live = vec![false; function.len()];
        let mut body = std::mem::take(&mut function.body);
        block(function, &mut body, &mut live);
        function.body = body;
        function.compact();
    }
}

/// Marks the values that statements use, from the last to the first, and removes statements whose values are unused.
fn block(f: &Function, body: &mut Block, live: &mut [bool]) {
    let mut kept = Vec::with_capacity(body.len());
    for mut stmt in std::mem::take(body).into_iter().rev() {
        if let Stmt::Let(value) = stmt {
            if !live[value.index()] && !matches!(f[value], Op::Call { .. }) {
                continue;
            }
            f[value].operands(|operand| live[operand.index()] = true);
        }
        stmt.operands_mut(|operand| live[operand.index()] = true);
        // Values are used where they dominate: a value computed in one iteration of a loop is not used by earlier
        // statements of the next one.
        if let Stmt::Loop { body, continuing, .. } = &mut stmt {
            block(f, continuing, live);
            block(f, body, live);
        } else {
            stmt.blocks_mut(|inner| block(f, inner, live));
        }
        kept.push(stmt);
    }
    kept.reverse();
    *body = kept;
}
