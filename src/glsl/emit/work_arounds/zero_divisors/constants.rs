//! Computes what a driver's constant propagation may know of values, once it has inlined functions and unrolled loops.
//!
//! A variable is followed through its function in the order of the statements. Where two paths of an unknown condition
//! meet, only a number that is the same on both is known. A loop is assumed to be unrolled, so that its counter has all
//! numbers that are stored to it; if an unknown condition leaves the loop, none is known after it. A parameter has the
//! numbers of all calls that pass known ones; if these differ, the function is analysed again for each call. Variables
//! that parameters refer to, and globals, have all known numbers that are stored to them anywhere; a global also has
//! its initial value, if that may be read ([`exposed`]). Vectors, arrays and structures have one interval for all their
//! parts.

use super::{
    same::is_same,
    state::{
        Merged,
        State::{self, Unknown, Unseen},
    },
};
use crate::{
    ir::{
        Binary, Block, ConstId, FuncId, Function, Global, GlobalId, GlobalKind, Math, Module, Op, Stmt, Value,
        analysis::{Interval, exposed, leaves, stores},
    },
    types::{Scalar, Type},
};

/// The maximum number of times that the functions are analysed, on average, and that the statements of a loop are. One
/// more iteration is needed for each step by which a constant propagates between variables against the order of the
/// program, so a chain of ten thousand would take as many.
const MAX_ROUNDS: usize = 64;

/// The maximum number of calls of a function that are analysed individually.
const MAX_CALLS: usize = 16;

/// The known state of every value of a program.
pub(super) struct Constants {
    /// By function and [`Value::index`].
    values: Vec<Vec<State>>,
    /// The arguments of all calls that pass known ones, and the values stored through those that refer to variables.
    params: Vec<Vec<Merged>>,
    globals: Vec<Merged>,
    results: Vec<State>,
    /// By function: its callers.
    callers: Vec<Vec<usize>>,
    /// By global: the functions that read it.
    readers: Vec<Vec<usize>>,
    /// By function: the inputs of its values have changed since they were computed.
    stale: Vec<bool>,
    /// `MAX_ROUNDS` through a loop were not enough.
    gave_up: bool,
    /// The analysis is complete: analysing a function again does not affect others.
    is_found: bool,
    /// The components of each parameter, while a function is analysed for one call and they are known individually.
    components: Vec<Vec<State>>,
}

impl Constants {
    pub(super) fn of(program: &Module) -> Constants {
        let count = program.functions.len();
        let first = exposed(program).into_iter().zip(&program.globals);
        let first = first.map(|(is_exposed, global)| match global.kind {
            GlobalKind::Private(_) if !is_exposed => Unseen,
            _ => initial_state(program, global),
        });
        let mut constants = Constants {
            values: program.functions.iter().map(|f| vec![Unseen; f.len()]).collect(),
            params: program.functions.iter().map(|f| vec![Merged::default(); f.params.len()]).collect(),
            globals: first.map(|state| Merged { state, grown: 0 }).collect(),
            results: vec![Unknown; count],
            callers: vec![Vec::new(); count],
            readers: vec![Vec::new(); program.globals.len()],
            stale: vec![false; count],
            gave_up: false,
            is_found: false,
            components: Vec::new(),
        };
        constants.find_readers(program);
        // Callers come after their callees, and pass known arguments to them.
        (0..count).rev().for_each(|index| constants.function(program, index));
        // A caller that reads several results is analysed again when all of them are known.
        for _ in 0..MAX_ROUNDS * count {
            match constants.stale.iter().position(|&is_stale| is_stale) {
                _ if constants.gave_up => break,
                Some(index) => constants.function(program, index),
                None => {
                    constants.is_found = true;
                    return constants;
                }
            }
        }
        // Any value may be a zero: that costs one instruction per division.
        constants.values.iter_mut().for_each(|values| values.fill(State::Range(Interval::ANY)));
        let any = Merged { state: State::Range(Interval::ANY), grown: 0 };
        constants.params.iter_mut().for_each(|params| params.fill(any));
        constants
    }

    fn find_readers(&mut self, program: &Module) {
        for (index, f) in program.functions.iter().enumerate() {
            for (_, op) in f.values() {
                match op {
                    Op::Load { place } => self.add_reader(f, *place, index),
                    Op::Call { function, args } => {
                        add_once(&mut self.callers[function.index()], index);
                        args.iter().filter(|&&arg| f.is_place(arg)).for_each(|&arg| self.add_reader(f, arg, index));
                    }
                    _ => {}
                }
            }
        }
    }

    fn add_reader(&mut self, f: &Function, place: Value, reader: usize) {
        if let Op::Global(global) = f[f.root(place)] {
            add_once(&mut self.readers[global.index()], reader);
        }
    }

    /// Removes the divisions of a function, by [`Value::index`], whose divisor is not zero in any of its calls: the
    /// arguments of each call are analysed separately, as in a driver that inlines the function.
    pub(super) fn analyse_call_sites(&mut self, program: &Module, function: usize, divisions: &mut [bool]) {
        let differs = |held: &Merged| matches!(held.state, State::Range(known) if !known.is_exact());
        if !self.is_found || !self.params[function].iter().any(differs) {
            return;
        }
        let calls = self.calls(program, function);
        if calls.len() < 2 || calls.len() > MAX_CALLS {
            return;
        }
        let f = &program.functions[function];
        let (values, params) = (self.values[function].clone(), self.params[function].clone());
        let mut remain = vec![false; divisions.len()];
        for (caller, args) in calls {
            for (param, &arg) in args.iter().enumerate().filter(|&(param, _)| !f.params[param].by_reference) {
                self.params[function][param].state = self.state(program, caller, arg);
            }
            self.components = args.iter().map(|&arg| self.components(program, caller, arg)).collect();
            self.function(program, function);
            for (value, op) in f.values().filter(|(value, _)| divisions[value.index()]) {
                if let Op::Binary { right, .. } = *op {
                    remain[value.index()] |= self.may_be_zero(program, function, right);
                }
            }
        }
        (self.values[function], self.params[function]) = (values, params);
        self.components.clear();
        divisions.copy_from_slice(&remain);
    }

    /// Returns the calls of a function: callers and arguments.
    fn calls<'p>(&self, program: &'p Module, function: usize) -> Vec<(usize, &'p [Value])> {
        let mut calls = Vec::new();
        for &caller in &self.callers[function] {
            calls.extend(program.functions[caller].values().filter_map(|(_, op)| match op {
                Op::Call { function: callee, args } if callee.index() == function => Some((caller, &args[..])),
                _ => None,
            }));
        }
        calls
    }

    /// Returns the state of each component of a vector; none if they are not known individually.
    fn components(&self, program: &Module, function: usize, value: Value) -> Vec<State> {
        let f = &program.functions[function];
        let is_scalar = |&part: &Value| matches!(program.types.get(f.ty(part)), Type::Scalar(_));
        match f[value] {
            Op::Const(id) => match program.types.get(program[id].ty) {
                Type::Vector { scalar, .. } => {
                    program[id].words.iter().map(|&word| State::Range(Interval::literal(scalar, word))).collect()
                }
                _ => Vec::new(),
            },
            Op::Compose { ref parts, .. } if parts.iter().all(is_scalar) => {
                parts.iter().map(|&part| self.state(program, function, part)).collect()
            }
            _ => Vec::new(),
        }
    }

    pub(super) fn may_be_zero(&self, program: &Module, function: usize, value: Value) -> bool {
        matches!(self.state(program, function, value), State::Range(known) if known.zero)
    }

    fn state(&self, program: &Module, function: usize, value: Value) -> State {
        match program.functions[function][value] {
            Op::Literal(scalar, bits) => State::Range(Interval::literal(scalar, bits)),
            Op::Zero(_) => State::Range(Interval::literal(Scalar::Int, 0)),
            Op::Const(id) => of_const(program, id),
            Op::Param(param) => self.params[function][param as usize].state(),
            _ => self.values[function][value.index()],
        }
    }

    /// Adds a known number to those of a parameter, or of the variable it refers to.
    fn pass(&mut self, program: &Module, function: usize, param: usize, state: State) {
        if !self.is_found && matches!(state, State::Range(_)) && self.params[function][param].add(state) {
            self.stale[function] = true;
            // Callers read the value that is stored there.
            if program.functions[function].params[param].by_reference {
                mark(&self.callers[function], &mut self.stale);
            }
        }
    }

    fn store(&mut self, global: GlobalId, state: State) {
        if !self.is_found && matches!(state, State::Range(_)) && self.globals[global.index()].add(state) {
            mark(&self.readers[global.index()], &mut self.stale);
        }
    }

    fn function(&mut self, program: &Module, index: usize) {
        self.stale[index] = false;
        let f = &program.functions[index];
        let mut walk = Walk {
            program,
            f,
            values: std::mem::take(&mut self.values[index]),
            stored: vec![Merged::default(); f.vars.len()],
            growths: 0,
            held: Vec::new(),
            trail: Vec::new(),
            result: Unseen,
            loops: 0,
            uncertain: 0,
            leaves: false,
            constants: self,
            index,
        };
        walk.held = f.vars.iter().map(|var| var.init.map_or(Unseen, |init| walk.state(init))).collect();
        walk.block(&f.body);
        let (values, result) = (walk.values, walk.result);
        self.values[index] = values;
        if self.is_found {
            return;
        }
        let result = if result == Unseen { Unknown } else { result };
        if result != self.results[index] {
            self.results[index] = result;
            mark(&self.callers[index], &mut self.stale);
        }
    }
}

/// The variables that a block changes, in ascending order, and their states after it.
type Changes = Vec<(usize, State)>;

/// A walk through the statements of a function.
struct Walk<'a> {
    program: &'a Module,
    f: &'a Function,
    index: usize,
    values: Vec<State>,
    /// The current state of each variable.
    held: Vec<State>,
    /// The variables that have been set during the walk, and their previous states.
    trail: Vec<(usize, State)>,
    /// All values stored to each variable in loops.
    stored: Vec<Merged>,
    /// The number of times that `stored` has grown.
    growths: usize,
    result: State,
    /// The number of enclosing loops.
    loops: u32,
    /// The number of enclosing unknown conditions within the innermost loop.
    uncertain: u32,
    /// An unknown condition leaves the innermost loop.
    leaves: bool,
    constants: &'a mut Constants,
}

impl Walk<'_> {
    fn state(&self, value: Value) -> State {
        match self.f[value] {
            Op::Literal(scalar, bits) => State::Range(Interval::literal(scalar, bits)),
            Op::Zero(_) => State::Range(Interval::literal(Scalar::Int, 0)),
            Op::Const(id) => of_const(self.program, id),
            Op::Param(param) => self.constants.params[self.index][param as usize].state(),
            Op::Global(global) => self.constants.globals[global.index()].state(),
            Op::Var(var) => self.held[var.index()],
            Op::Input(_) => Unknown,
            // Places are not named by statements.
            Op::Part { base, .. } if self.f.is_place(value) => self.state(base),
            Op::Element { base, index } if self.f.is_place(value) => match self.state(index) {
                State::Range(_) => self.state(base),
                state => state,
            },
            _ => self.values[value.index()],
        }
    }

    fn block(&mut self, block: &Block) {
        for stmt in block {
            self.stmt(stmt);
        }
    }

    fn stmt(&mut self, stmt: &Stmt) {
        match stmt {
            Stmt::Let(value) => self.values[value.index()] = self.compute(*value),
            Stmt::Store { place, value } => self.store(*place, self.state(*value)),
            Stmt::If { condition, accept, reject } => {
                let is_known = matches!(self.state(*condition), State::Range(_));
                self.uncertain += u32::from(!is_known);
                let accepted = self.branch(&Changes::new(), is_known, accept);
                let rejected = self.branch(&Changes::new(), is_known, reject);
                self.uncertain -= u32::from(!is_known);
                let changes = match (leaves(accept), leaves(reject)) {
                    (_, true) => accepted,
                    (true, false) => rejected,
                    (false, false) => self.joined(accepted, &rejected, is_known),
                };
                changes.into_iter().for_each(|(var, state)| self.set(var, state));
            }
            Stmt::Switch { selector, cases } => {
                let is_known = matches!(self.state(*selector), State::Range(_));
                self.uncertain += u32::from(!is_known);
                let mut changes = Changes::new();
                for case in cases {
                    // A case may be entered from the end of the previous one.
                    let after = self.branch(&changes, is_known, &case.body);
                    changes = self.joined(after, &changes, is_known);
                }
                self.uncertain -= u32::from(!is_known);
                // Possibly no case is chosen.
                for (var, state) in changes {
                    self.set(var, state.join(self.held[var], is_known));
                }
            }
            Stmt::Loop { body, continuing, break_if } => {
                let around = (self.uncertain, self.leaves);
                let written = self.written(&[body, continuing]);
                for &var in &written {
                    self.note(var, self.held[var]);
                }
                self.loops += 1;
                // The values stored in the loop are found by iterating over it.
                for round in 0.. {
                    let growths = self.growths;
                    (self.uncertain, self.leaves) = (0, false);
                    for &var in &written {
                        self.set(var, self.stored[var].state);
                    }
                    self.block(body);
                    self.block(continuing);
                    if self.growths == growths {
                        break;
                    }
                    if round == MAX_ROUNDS {
                        self.constants.gave_up = true;
                        break;
                    }
                }
                self.loops -= 1;
                let is_left =
                    self.leaves || break_if.is_some_and(|condition| !matches!(self.state(condition), State::Range(_)));
                for &var in &written {
                    self.set(var, if is_left { Unknown } else { self.stored[var].state });
                }
                (self.uncertain, self.leaves) = around;
            }
            Stmt::Break | Stmt::Continue => self.leaves |= self.uncertain > 0,
            Stmt::Return(value) => {
                self.leaves |= self.uncertain > 0;
                if let Some(value) = value {
                    let state = self.state(*value);
                    self.result = match self.uncertain {
                        0 => self.result.or(state),
                        _ => self.result.met(state),
                    };
                }
            }
            Stmt::Discard | Stmt::Output(_) => {}
        }
    }

    /// Returns the variables that blocks write.
    fn written(&self, blocks: &[&Block]) -> Vec<usize> {
        let mut written = Vec::new();
        let mut add = |place: Value| {
            if let Op::Var(var) = self.f[self.f.root(place)] {
                written.push(var.index());
            }
        };
        blocks.iter().for_each(|block| stores(self.f, block, &mut add));
        written.sort_unstable();
        written.dedup();
        written
    }

    fn set(&mut self, var: usize, state: State) {
        let before = std::mem::replace(&mut self.held[var], state);
        self.trail.push((var, before));
    }

    /// Analyses a block that may also be entered after others, whose changes are `changes`. Returns its changes, and
    /// reverts them.
    fn branch(&mut self, changes: &Changes, is_known: bool, block: &Block) -> Changes {
        let start = self.trail.len();
        for &(var, state) in changes {
            self.set(var, state.join(self.held[var], is_known));
        }
        self.block(block);
        let trail: Vec<_> = self.trail.drain(start..).rev().collect();
        let mut changes: Changes =
            trail.into_iter().map(|(var, before)| (var, std::mem::replace(&mut self.held[var], before))).collect();
        // The first entry of a variable is its newest.
        changes.sort_by_key(|&(var, _)| var);
        changes.dedup_by_key(|&mut (var, _)| var);
        changes
    }

    /// Returns the changes where two paths meet; a driver knows which one was taken if `is_known`.
    fn joined(&self, mut one: Changes, other: &Changes, is_known: bool) -> Changes {
        let known = one.len();
        for &(var, state) in other {
            match one[..known].binary_search_by_key(&var, |&(var, _)| var) {
                Ok(at) => one[at].1 = state.join(one[at].1, is_known),
                Err(_) => one.push((var, state.join(self.held[var], is_known))),
            }
        }
        for (var, state) in &mut one[..known] {
            if other.binary_search_by_key(var, |&(var, _)| var).is_err() {
                *state = state.join(self.held[*var], is_known);
            }
        }
        one.sort_by_key(|&(var, _)| var);
        one
    }

    fn note(&mut self, var: usize, state: State) {
        self.growths += usize::from(self.stored[var].add_in_loop(state));
    }

    fn store(&mut self, place: Value, state: State) {
        let var = match self.f[self.f.root(place)] {
            Op::Var(var) => var.index(),
            Op::Param(param) => return self.constants.pass(self.program, self.index, param as usize, state),
            Op::Global(global) => return self.constants.store(global, state),
            _ => return,
        };
        self.set(var, if matches!(self.f[place], Op::Var(_)) { state } else { self.held[var].or(state) });
        if self.loops > 0 {
            let held = if self.uncertain > 0 { Unknown } else { self.held[var] };
            self.note(var, held);
        }
    }

    fn compute(&mut self, value: Value) -> State {
        let f = self.f;
        let scalar = |of: Value| self.program.types.scalar(f.ty(of)).unwrap_or(Scalar::Float);
        match f[value] {
            Op::Part { base, index } => match f[base] {
                Op::Const(id) if matches!(self.program.types.get(self.program[id].ty), Type::Vector { .. }) => {
                    State::Range(Interval::literal(scalar(base), self.program[id].words[index as usize]))
                }
                Op::Param(param) => {
                    let components = self.constants.components.get(param as usize);
                    components.and_then(|all| all.get(index as usize).copied()).unwrap_or_else(|| self.state(base))
                }
                _ => self.state(base),
            },
            Op::Element { base, index } => self.state(base).zip(self.state(index), |base, _| base),
            Op::Swizzle { vector: of, .. } | Op::Splat { value: of, .. } | Op::Load { place: of } => self.state(of),
            Op::Compose { ref parts, .. } => {
                parts.iter().map(|&part| self.state(part)).reduce(State::or).unwrap_or(Unknown)
            }
            Op::Unary { op, operand } => self.state(operand).map(|known| known.unary(op, scalar(value))),
            Op::Convert { value: of, to } => self.state(of).map(|known| known.converted(to)),
            Op::Bitcast { value: of, .. } | Op::All(of) | Op::Any(of) => self.state(of).map(|_| Interval::ANY),
            // The difference of equal expressions is zero, even if their value is unknown.
            Op::Binary { op: Binary::Subtract, left, right } if is_same(f, left, right) => State::ZERO,
            Op::Binary { op, left, right } => {
                let scalar = scalar(left);
                match (self.state(left), self.state(right)) {
                    // The value that a zero is multiplied with or divided by need not be known.
                    (Unknown, State::Range(known)) if known.zero && is_zero_of_zero(op).1 => State::ZERO,
                    (State::Range(known), Unknown) if known.zero && is_zero_of_zero(op).0 => State::ZERO,
                    (left, right) => left.zip(right, |l, r| l.binary(op, r, scalar)),
                }
            }
            Op::Math { fun, arg, arg1, arg2, arg3 } => {
                let scalar = scalar(value);
                let first = self.state(arg);
                match [arg1, arg2, arg3].map(|arg| arg.map(|arg| self.state(arg))) {
                    [None, None, None] => first.map(|x| x.function(fun, None, scalar)),
                    [Some(second), None, None] => first.zip(second, |x, y| x.function(fun, Some(y), scalar)),
                    [Some(low), Some(high), None] if fun == Math::Clamp => first
                        .zip(low, |x, y| x.function(Math::Max, Some(y), scalar))
                        .zip(high, |x, y| x.function(Math::Min, Some(y), scalar)),
                    // If both ends are the same number, the mix factor need not be known.
                    [Some(second), Some(Unknown), None] if fun == Math::Mix => first.met(second),
                    others => {
                        others.into_iter().flatten().fold(first, |all, other| all.zip(other, |_, _| Interval::ANY))
                    }
                }
            }
            Op::Select { condition, accept, reject } => {
                let is_known = matches!(self.state(condition), State::Range(_));
                self.state(accept).join(self.state(reject), is_known)
            }
            Op::Call { function, ref args } => self.call(function, args),
            _ => Unknown,
        }
    }

    fn call(&mut self, function: FuncId, args: &[Value]) -> State {
        let callee = function.index();
        for (param, &arg) in args.iter().enumerate() {
            self.constants.pass(self.program, callee, param, self.state(arg));
            if self.f.is_place(arg) {
                self.store(arg, self.constants.params[callee][param].state());
            }
        }
        self.constants.results[callee]
    }
}

/// Adds a function to a sorted list, if it is not the last entry.
fn add_once(functions: &mut Vec<usize>, function: usize) {
    if functions.last() != Some(&function) {
        functions.push(function);
    }
}

fn mark(functions: &[usize], stale: &mut [bool]) {
    functions.iter().for_each(|&function| stale[function] = true);
}

/// Returns the initial state of a global.
fn initial_state(program: &Module, global: &Global) -> State {
    match global.kind {
        GlobalKind::Private(Some(init)) | GlobalKind::Table(init) => of_const(program, init),
        GlobalKind::Private(None) => State::ZERO,
        GlobalKind::Uniform(_)
        | GlobalKind::CustomUniform(_)
        | GlobalKind::CubeFace
        | GlobalKind::TileOrigin
        | GlobalKind::Member { .. } => Unknown,
    }
}

fn of_const(program: &Module, id: ConstId) -> State {
    let words = &program[id].words;
    let known = match program.types.scalar(program[id].ty) {
        Some(scalar) => words.iter().map(|&word| Interval::literal(scalar, word)).reduce(Interval::or),
        None => Some(Interval::any_but(words.iter().any(|word| word << 1 == 0))),
    };
    known.map_or(Unknown, State::Range)
}

/// Returns whether an operation is 0 if its left side is, and if its right side is.
fn is_zero_of_zero(op: Binary) -> (bool, bool) {
    match op {
        Binary::Multiply | Binary::And => (true, true),
        Binary::Divide | Binary::Modulo | Binary::ShiftLeft | Binary::ShiftRight => (true, false),
        _ => (false, false),
    }
}
