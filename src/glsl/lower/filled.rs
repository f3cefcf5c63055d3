//! Memory that is filled before it is read needs no zeros before that.
//!
//! naga lets each variable of a function begin with zeros, which are written anew at every call; a software driver stores each
//! element of an array once for each pixel and component. What is private to the invocation gets them once. GLSL knows no
//! recursion, so that no two calls of a function share what one of them still reads.

use naga::{Arena, Block, Expression, Function, Handle, LocalVariable, Statement, TypeInner};

use super::{Lowering, function::Value};

/// Makes arrays and matrices of a function global that are indexed at run time, given to no call, and stored as
/// a whole before anything else is done to them.
pub(super) fn make_global(f: &mut Function, cx: &mut Lowering<'_>) {
    let types = &cx.out.types;
    let is_candidate = |variable: &LocalVariable| {
        let aggregate = matches!(types[variable.ty].inner, TypeInner::Array { .. } | TypeInner::Matrix { .. });
        aggregate && variable.init.is_none()
    };
    let states = f.local_variables.iter().map(|(_, v)| if is_candidate(v) { State::Untouched } else { State::Local });
    let mut walk = Walk { f, roots: roots(f), states: states.collect(), open: Vec::new(), blocks: 0 };
    if walk.states.iter().all(|state| *state == State::Local) {
        return;
    }
    walk.block(&f.body);
    let mut indexed = vec![false; f.local_variables.len()];
    for (_, expression) in f.expressions.iter() {
        if let Expression::Access { base, .. } = *expression
            && let Some(variable) = walk.roots[base.index()]
        {
            indexed[variable.index()] = true;
        }
    }
    let states = walk.states;
    let mut variables = Arena::new();
    let expressions: Vec<_> = f
        .local_variables
        .drain()
        .map(|(old, variable, span)| match states[old.index()] {
            State::Filled(_) if indexed[old.index()] => {
                let global = cx.private(variable.ty, None);
                cx.filled.insert(global);
                Expression::GlobalVariable(global)
            }
            _ => Expression::LocalVariable(variables.append(variable, span)),
        })
        .collect();
    f.local_variables = variables;
    for (_, expression) in f.expressions.iter_mut() {
        if let Expression::LocalVariable(variable) = *expression {
            *expression = expressions[variable.index()].clone();
        }
    }
}

/// The variable that each expression points into.
fn roots(f: &Function) -> Vec<Option<Handle<LocalVariable>>> {
    let mut roots = Vec::with_capacity(f.expressions.len());
    for (_, expression) in f.expressions.iter() {
        roots.push(match *expression {
            Expression::LocalVariable(variable) => Some(variable),
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => roots[base.index()],
            _ => None,
        });
    }
    roots
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
    roots: Vec<Option<Handle<LocalVariable>>>,
    states: Vec<State>,
    /// Numbers of the block at hand and of those around it.
    open: Vec<usize>,
    blocks: usize,
}

impl Walk<'_> {
    fn block(&mut self, block: &Block) {
        self.blocks += 1;
        self.open.push(self.blocks);
        for statement in block {
            match statement {
                Statement::Emit(range) => {
                    for value in range.clone() {
                        if let Expression::Load { pointer } = self.f.expressions[value] {
                            self.touch(pointer);
                        }
                    }
                }
                Statement::Store { pointer, .. } => self.store(*pointer),
                Statement::Call { arguments, .. } => {
                    for argument in arguments {
                        if let Some(variable) = self.roots[argument.index()] {
                            self.states[variable.index()] = State::Local;
                        }
                    }
                }
                Statement::Block(block) => self.block(block),
                Statement::If { accept, reject, .. } => {
                    self.block(accept);
                    self.block(reject);
                }
                Statement::Switch { cases, .. } => cases.iter().for_each(|case| self.block(&case.body)),
                Statement::Loop { body, continuing, .. } => {
                    self.block(body);
                    self.block(continuing);
                }
                _ => {}
            }
        }
        self.open.pop();
    }

    fn store(&mut self, pointer: Value) {
        let Expression::LocalVariable(variable) = self.f.expressions[pointer] else { return self.touch(pointer) };
        let block = *self.open.last().expect("a statement stands in a block");
        let state = &mut self.states[variable.index()];
        match *state {
            State::Local => {}
            State::Filled(block) if self.open.contains(&block) => {}
            State::Untouched | State::Filled(_) => *state = State::Filled(block),
        }
    }

    /// A part is read or written.
    fn touch(&mut self, pointer: Value) {
        let Some(variable) = self.roots[pointer.index()] else { return };
        let state = &mut self.states[variable.index()];
        if !matches!(*state, State::Filled(block) if self.open.contains(&block)) {
            *state = State::Local;
        }
    }
}
