//! Dead code elimination: drops what is computed and used by nothing that has an effect. The passes before it leave the
//! operations that they replaced.

use crate::ir::{Block, Function, Module, Op, Stmt, Value};

pub(super) fn run(module: &mut Module) {
    for function in &mut module.functions {
        let mut live = vec![false; function.len()];
        let mut body = std::mem::take(&mut function.body);
        block(function, &mut body, &mut live);
        function.body = body;
        function.compact();
    }
}

/// Marks what statements use, from the last to the first, and drops those that compute what nothing does.
fn block(f: &Function, body: &mut Block, live: &mut [bool]) {
    let mut kept = Vec::with_capacity(body.len());
    for mut stmt in std::mem::take(body).into_iter().rev() {
        let mut used = |value: Value| live[value.index()] = true;
        match &mut stmt {
            Stmt::Let(value) => {
                let has_effect = matches!(f[*value], Op::Call { .. });
                if !live[value.index()] && !has_effect {
                    continue;
                }
                f[*value].operands(|operand| live[operand.index()] = true);
            }
            Stmt::Store { place, value } => [*place, *value].into_iter().for_each(used),
            Stmt::If { condition, accept, reject } => {
                used(*condition);
                block(f, accept, live);
                block(f, reject, live);
            }
            Stmt::Switch { selector, cases } => {
                used(*selector);
                cases.iter_mut().for_each(|case| block(f, &mut case.body, live));
            }
            Stmt::Loop { body, continuing, break_if } => {
                // Values are used where they dominate: what a round computes, no earlier statement of the next one
                // uses.
                break_if.iter().for_each(|value| live[value.index()] = true);
                block(f, continuing, live);
                block(f, body, live);
            }
            Stmt::Return(value) => value.iter().for_each(|value| used(*value)),
            Stmt::Output(parts) => parts.iter().for_each(|(_, value)| used(*value)),
            Stmt::Break | Stmt::Continue | Stmt::Discard => {}
        }
        kept.push(stmt);
    }
    kept.reverse();
    *body = kept;
}
