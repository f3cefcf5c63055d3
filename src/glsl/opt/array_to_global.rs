//! Memory that is filled before it is read needs no zeros before that.
//!
//! naga lets each variable of a function begin with zeros, which are written anew at every call; a software driver stores each
//! element of an array once for each pixel and component. What is private to the invocation gets them once. GLSL knows no
//! recursion, so that no two calls of a function share what one of them still reads.

use crate::glsl::{
    ir::{Block, Function, GlobalKind, Module, Op, Stmt, Value, VarId},
    types::Type,
};

/// Runs the pass over all functions but the entry point, which runs once.
pub(super) fn run(module: &mut Module) {
    let mut functions = std::mem::take(&mut module.functions);
    let called = functions.len().saturating_sub(1);
    functions[..called].iter_mut().for_each(|function| make_global(function, module));
    module.functions = functions;
}

/// Makes arrays and matrices of a function global that are indexed at run time, given to no call, and stored as
/// a whole before anything else is done to them.
fn make_global(f: &mut Function, module: &mut Module) {
    let is_candidate = |var: &crate::glsl::ir::Var| {
        var.init.is_none() && matches!(module.types.get(var.ty), Type::Array { .. } | Type::Matrix { .. })
    };
    let states: Vec<_> = f.vars.iter().map(|v| if is_candidate(v) { State::Untouched } else { State::Local }).collect();
    if states.iter().all(|state| *state == State::Local) {
        return;
    }
    let mut walk = Walk { f, roots: roots(f), states, open: Vec::new(), blocks: 0 };
    walk.block(&f.body);
    let mut indexed = vec![false; f.vars.len()];
    for (_, op) in f.values() {
        if let Op::Element { base, .. } = *op
            && let Some(var) = walk.roots[base.index()]
        {
            indexed[var.index()] = true;
        }
    }
    let states = walk.states;
    let replacements = f.vars.iter().enumerate().map(|(index, var)| match states[index] {
        State::Filled(_) if indexed[index] => {
            Some(Op::Global(module.add_global(var.ty, GlobalKind::Private { init: None, overwritten: true })))
        }
        _ => None,
    });
    let replacements = replacements.collect();
    f.replace_vars(replacements);
}

/// The variable that each place lies in, by [`Value::index`].
fn roots(f: &Function) -> Vec<Option<VarId>> {
    let root = |(value, op): (Value, &Op)| match (op, &f[f.root(value)]) {
        (Op::Var(_) | Op::Part { .. } | Op::Element { .. }, Op::Var(var)) => Some(*var),
        _ => None,
    };
    f.values().map(root).collect()
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    Untouched,
    /// Stored as a whole in this block.
    Filled(usize),
    /// Someone may read the zeros, or gets a pointer.
    Local,
}

/// A walk over a body, in the order of execution.
struct Walk<'a> {
    f: &'a Function,
    roots: Vec<Option<VarId>>,
    states: Vec<State>,
    /// Numbers of the block at hand and of those around it.
    open: Vec<usize>,
    blocks: usize,
}

impl Walk<'_> {
    fn block(&mut self, block: &Block) {
        self.blocks += 1;
        self.open.push(self.blocks);
        for stmt in block {
            match stmt {
                Stmt::Let(value) => match self.f[*value] {
                    Op::Load { place } => self.touch(place),
                    Op::Call { ref args, .. } => {
                        for arg in args {
                            if let Some(var) = self.roots[arg.index()] {
                                self.states[var.index()] = State::Local;
                            }
                        }
                    }
                    _ => {}
                },
                Stmt::Store { place, .. } => self.store(*place),
                Stmt::If { accept, reject, .. } => {
                    self.block(accept);
                    self.block(reject);
                }
                Stmt::Switch { cases, .. } => cases.iter().for_each(|case| self.block(&case.body)),
                Stmt::Loop { body, continuing, .. } => {
                    self.block(body);
                    self.block(continuing);
                }
                _ => {}
            }
        }
        self.open.pop();
    }

    fn store(&mut self, place: Value) {
        let Op::Var(var) = self.f[place] else { return self.touch(place) };
        let block = *self.open.last().expect("a statement stands in a block");
        let state = &mut self.states[var.index()];
        match *state {
            State::Local => {}
            State::Filled(block) if self.open.contains(&block) => {}
            State::Untouched | State::Filled(_) => *state = State::Filled(block),
        }
    }

    /// A part is read or written.
    fn touch(&mut self, place: Value) {
        let Some(var) = self.roots[place.index()] else { return };
        let state = &mut self.states[var.index()];
        if !matches!(*state, State::Filled(block) if self.open.contains(&block)) {
            *state = State::Local;
        }
    }
}
