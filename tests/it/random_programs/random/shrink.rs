//! Shrinks a program that shows a fault.

use super::{Program, Stmt};

/// Removes statements, one after the other, while `fails` reports that the fault remains; stops after `attempts`
/// attempts.
pub(crate) fn shrink(program: &Program, mut attempts: usize, mut fails: impl FnMut(&Program) -> bool) -> Program {
    let mut best = program.clone();
    loop {
        let mut smaller = false;
        let mut at = 0;
        loop {
            let mut candidate = best.clone();
            let mut left = at;
            let mut removed = candidate.functions.iter_mut().any(|function| remove(&mut function.body, &mut left));
            removed |= !removed && remove(&mut candidate.body, &mut left);
            if !removed || attempts == 0 {
                break;
            }
            attempts -= 1;
            if fails(&candidate) {
                (best, smaller) = (candidate, true);
            } else {
                at += 1;
            }
        }
        if !smaller || attempts == 0 {
            return best;
        }
    }
}

/// Removes the statement with index `left`, in an order that counts outer statements before the inner ones. Returns
/// whether it was found; `left` counts down.
fn remove(list: &mut Vec<Stmt>, left: &mut usize) -> bool {
    let mut i = 0;
    while i < list.len() {
        if *left == 0 {
            list.remove(i);
            return true;
        }
        *left -= 1;
        let within = match &mut list[i] {
            Stmt::If(_, then, otherwise) => remove(then, left) || remove(otherwise, left),
            Stmt::For { body, .. } | Stmt::While(_, body) | Stmt::Do(body, _) | Stmt::Block(body) => remove(body, left),
            Stmt::Switch(_, cases) => cases.iter_mut().any(|(_, body)| remove(body, left)),
            _ => false,
        };
        if within {
            return true;
        }
        i += 1;
    }
    false
}
