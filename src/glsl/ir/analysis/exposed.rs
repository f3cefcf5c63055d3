//! Finds the variables of the module whose initial value may be read.
//!
//! Most are set at the start of the program, as `f = 5.0 / iResolution.y;`. A driver that has inlined the functions
//! sees that the initial zero of such a variable is never read.

use super::leaves;
use crate::ir::{Block, Function, GlobalKind, Module, Op, Stmt, Value};

/// Returns for each variable of the module whether it may be read before it is written as a whole.
pub fn exposed(program: &Module) -> Vec<bool> {
    let mut functions: Vec<Summary> = Vec::with_capacity(program.functions.len());
    for f in &program.functions {
        let mut walk = Walk { program, f, functions: &functions, exposed: none(program), returned: None };
        let mut written = none(program);
        walk.block(&f.body, &mut written);
        // The end of the body is reached unless its last statement leaves it.
        if !matches!(f.body.last(), Some(Stmt::Return(_) | Stmt::Discard)) {
            walk.leave(&written);
        }
        let Walk { exposed, returned, .. } = walk;
        functions.push(Summary { exposed, written: returned.unwrap_or(written) });
    }
    functions.pop().map_or_else(|| none(program), |entry| entry.exposed)
}

/// A set of the variables of the module.
type Set = Vec<bool>;

fn none(program: &Module) -> Set {
    vec![false; program.globals.len()]
}

fn intersect(set: &mut Set, other: &Set) {
    set.iter_mut().zip(other).for_each(|(one, other)| *one &= other);
}

/// The variables that a function may read before it has written them, and those that it has written when it returns.
struct Summary {
    exposed: Set,
    written: Set,
}

struct Walk<'a> {
    program: &'a Module,
    f: &'a Function,
    /// Summaries of the callees.
    functions: &'a [Summary],
    exposed: Set,
    /// The variables that are written on every path that returns.
    returned: Option<Set>,
}

impl Walk<'_> {
    fn leave(&mut self, written: &Set) {
        match &mut self.returned {
            Some(returned) => intersect(returned, written),
            None => self.returned = Some(written.clone()),
        }
    }

    fn variable(&self, place: Value) -> Option<usize> {
        match self.f[self.f.root(place)] {
            Op::Global(id) if matches!(self.program[id].kind, GlobalKind::Private(_)) => Some(id.index()),
            _ => None,
        }
    }

    fn read(&mut self, place: Value, written: &Set) {
        if let Some(variable) = self.variable(place) {
            self.exposed[variable] |= !written[variable];
        }
    }

    fn block(&mut self, block: &Block, written: &mut Set) {
        for stmt in block {
            match stmt {
                Stmt::Let(value) => match &self.f[*value] {
                    Op::Load { place } => self.read(*place, written),
                    Op::Call { function, args } => {
                        args.iter().for_each(|&arg| self.read(arg, written));
                        let callee = &self.functions[function.index()];
                        for (variable, written) in written.iter_mut().enumerate() {
                            self.exposed[variable] |= callee.exposed[variable] && !*written;
                            *written |= callee.written[variable];
                        }
                    }
                    _ => {}
                },
                Stmt::Store { place, .. } => {
                    if let Op::Global(id) = self.f[*place] {
                        written[id.index()] = true;
                    }
                }
                Stmt::If { accept, reject, .. } => {
                    let mut other = written.clone();
                    self.block(accept, written);
                    self.block(reject, &mut other);
                    match (leaves(accept), leaves(reject)) {
                        (true, _) => *written = other,
                        (false, true) => {}
                        (false, false) => intersect(written, &other),
                    }
                }
                // These blocks may not run, or may be left at any point.
                Stmt::Loop { .. } | Stmt::Switch { .. } => {
                    stmt.blocks(|block| self.block(block, &mut written.clone()));
                }
                Stmt::Return(_) => self.leave(written),
                Stmt::Break | Stmt::Continue | Stmt::Discard | Stmt::Output(_) => {}
            }
        }
    }
}
