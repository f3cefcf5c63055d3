//! Finds what a driver's constant propagation may know of values, once it has inlined functions and unrolled loops.
//!
//! A variable is followed through its function in the order of the statements. Where two ways meet that an unknown
//! condition parts, only a number that both bring is known. A loop is taken to be unrolled, so that a variable that it
//! counts has all numbers that are stored to it; if an unknown condition leaves the loop, none is known behind it. A
//! parameter has the numbers of all calls that pass known ones. Vectors, arrays and structures have one interval, that
//! of all their parts. Nothing is known of what lies in variables of the module, but in tables.

use super::{known::Known, zeros::MOST_ROUNDS};
use crate::glsl::{
    ir::{Block, ConstId, FuncId, Function, GlobalKind, Math, Module, Op, Stmt, Value},
    types::{Scalar, Type},
};

/// The knowledge of a value.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum State {
    /// No statement that computes it has been looked at yet.
    #[default]
    Unseen,
    /// It is one number of an interval: a driver may know which.
    Known(Known),
    Unknown,
}

use State::{Unknown, Unseen};

impl State {
    /// Returns what holds of both, where a driver knows which of the two it is.
    fn or(self, other: State) -> State {
        match (self, other) {
            (Unseen, state) | (state, Unseen) => state,
            (State::Known(a), State::Known(b)) => State::Known(a.or(b)),
            _ => Unknown,
        }
    }

    /// Returns what is known where an unknown condition has chosen between both.
    fn met(self, other: State) -> State {
        match (self, other) {
            (Unseen, state) | (state, Unseen) => state,
            (State::Known(a), State::Known(b)) if a == b && a.is_exact() => self,
            _ => Unknown,
        }
    }

    fn map(self, f: impl FnOnce(Known) -> Known) -> State {
        match self {
            State::Known(known) => State::Known(f(known)),
            state => state,
        }
    }

    fn zip(self, other: State, f: impl FnOnce(Known, Known) -> Known) -> State {
        match (self, other) {
            (State::Known(a), State::Known(b)) => State::Known(f(a, b)),
            (Unknown, _) | (_, Unknown) => Unknown,
            _ => Unseen,
        }
    }
}

/// The knowledge of something that is written in several places.
#[derive(Clone, Copy, Default)]
struct Held {
    state: State,
    /// The number of times that its interval has grown.
    grown: u8,
}

impl Held {
    /// The number of times that an interval grows by as much as it must. A counter without an end would grow for ever.
    const MOST_GROWN: u8 = 3;

    /// Adds what is stored; says whether that is new.
    fn add(&mut self, state: State) -> bool {
        let before = self.state;
        let mut after = before.or(state);
        if after == before {
            return false;
        }
        if let (State::Known(old), State::Known(new)) = (before, after) {
            self.grown = self.grown.saturating_add(1);
            if self.grown > Self::MOST_GROWN {
                after = State::Known(new.widened(old));
            }
        }
        self.state = after;
        true
    }
}

/// The knowledge of every value of a program.
pub(super) struct Constants {
    /// By function and [`Value::index`].
    values: Vec<Vec<State>>,
    /// The arguments of all calls that pass known ones.
    params: Vec<Vec<Held>>,
    results: Vec<State>,
    /// By function: something that its values follow from has changed since they were found.
    stale: Vec<bool>,
}

impl Constants {
    pub(super) fn of(program: &Module) -> Constants {
        let count = program.functions.len();
        let mut constants = Constants {
            values: program.functions.iter().map(|f| vec![Unseen; f.len()]).collect(),
            params: program.functions.iter().map(|f| vec![Held::default(); f.params.len()]).collect(),
            results: vec![Unknown; count],
            stale: vec![true; count],
        };
        for _ in 0..MOST_ROUNDS {
            if !constants.stale.contains(&true) {
                break;
            }
            // Callers come behind their callees, and hand them what they know.
            for index in (0..count).rev() {
                if std::mem::take(&mut constants.stale[index]) {
                    constants.function(program, index);
                }
            }
        }
        constants
    }

    pub(super) fn may_be_zero(&self, program: &Module, function: usize, value: Value) -> bool {
        let state = match program.functions[function][value] {
            Op::Literal(scalar, bits) => State::Known(Known::literal(scalar, bits)),
            Op::Zero(_) => State::Known(Known::literal(Scalar::Int, 0)),
            Op::Const(id) => of_const(program, id),
            _ => self.values[function][value.index()],
        };
        matches!(state, State::Known(known) if known.zero)
    }

    fn function(&mut self, program: &Module, index: usize) {
        let f = &program.functions[index];
        let mut walk = Walk {
            program,
            f,
            values: std::mem::take(&mut self.values[index]),
            stored: vec![Held::default(); f.vars.len()],
            is_new: true,
            held: Vec::new(),
            result: Unseen,
            uncertain: 0,
            leaves: false,
            constants: self,
            index,
        };
        // What loops store is found by going through them again.
        for _ in 0..MOST_ROUNDS {
            if !std::mem::take(&mut walk.is_new) {
                break;
            }
            walk.held = f.vars.iter().map(|var| var.init.map_or(Unseen, |init| walk.state(init))).collect();
            (walk.result, walk.uncertain) = (Unseen, 0);
            walk.block(&f.body);
        }
        let (values, result) = (walk.values, walk.result);
        self.values[index] = values;
        let result = if result == Unseen { Unknown } else { result };
        if result != self.results[index] {
            self.results[index] = result;
            // Its callers come behind it.
            self.stale[index + 1..].fill(true);
        }
    }
}

/// A way through the statements of a function.
struct Walk<'a> {
    program: &'a Module,
    f: &'a Function,
    index: usize,
    values: Vec<State>,
    /// The knowledge of each variable where the way is.
    held: Vec<State>,
    /// All that is stored to a variable in loops.
    stored: Vec<Held>,
    /// `stored` has grown.
    is_new: bool,
    result: State,
    /// Unknown conditions around the statement, within the innermost loop.
    uncertain: u32,
    /// An unknown condition leaves the innermost loop.
    leaves: bool,
    constants: &'a mut Constants,
}

impl Walk<'_> {
    fn state(&self, value: Value) -> State {
        match self.f[value] {
            Op::Literal(scalar, bits) => State::Known(Known::literal(scalar, bits)),
            Op::Zero(_) => State::Known(Known::literal(Scalar::Int, 0)),
            Op::Const(id) => of_const(self.program, id),
            Op::Param(param) => match self.constants.params[self.index][param as usize].state {
                Unseen => Unknown,
                state => state,
            },
            Op::Global(id) => match self.program[id].kind {
                GlobalKind::Table(table) => of_const(self.program, table),
                _ => Unknown,
            },
            Op::Var(var) => self.held[var.index()],
            Op::Input(_) => Unknown,
            // Places are named by no statement.
            Op::Part { base, .. } if self.f.is_place(value) => self.state(base),
            Op::Element { base, index } if self.f.is_place(value) => match self.state(index) {
                State::Known(_) => self.state(base),
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
                let is_known = matches!(self.state(*condition), State::Known(_));
                let before = self.held.clone();
                self.uncertain += u32::from(!is_known);
                self.block(accept);
                let accepted = std::mem::replace(&mut self.held, before);
                self.block(reject);
                self.uncertain -= u32::from(!is_known);
                if leaves(reject) {
                    self.held = accepted;
                } else if !leaves(accept) {
                    self.meet(&accepted, is_known);
                }
            }
            Stmt::Switch { selector, cases } => {
                let is_known = matches!(self.state(*selector), State::Known(_));
                let before = self.held.clone();
                self.uncertain += u32::from(!is_known);
                let mut met: Option<Vec<State>> = None;
                for case in cases {
                    // A case may begin where the one before it ends.
                    self.meet(&before, is_known);
                    self.block(&case.body);
                    if let Some(met) = &met {
                        self.meet(met, is_known);
                    }
                    met = Some(self.held.clone());
                }
                self.meet(&before, is_known);
                self.uncertain -= u32::from(!is_known);
            }
            Stmt::Loop { body, continuing, break_if } => {
                let around = (std::mem::take(&mut self.uncertain), std::mem::take(&mut self.leaves));
                let mut written = Vec::new();
                collect(self.f, body, &mut written);
                collect(self.f, continuing, &mut written);
                for &var in &written {
                    self.note(var, self.held[var]);
                    self.held[var] = self.stored[var].state;
                }
                self.block(body);
                self.block(continuing);
                let is_left =
                    self.leaves || break_if.is_some_and(|condition| !matches!(self.state(condition), State::Known(_)));
                for &var in &written {
                    self.held[var] = if is_left { Unknown } else { self.stored[var].state };
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

    /// Two ways meet here; a driver knows which it is if `is_known`.
    fn meet(&mut self, other: &[State], is_known: bool) {
        for (held, &other) in self.held.iter_mut().zip(other) {
            *held = if is_known { held.or(other) } else { held.met(other) };
        }
    }

    fn note(&mut self, var: usize, state: State) {
        self.is_new |= self.stored[var].add(state);
    }

    fn store(&mut self, place: Value, state: State) {
        let Op::Var(var) = self.f[self.f.root(place)] else { return };
        let var = var.index();
        self.held[var] = if matches!(self.f[place], Op::Var(_)) { state } else { self.held[var].or(state) };
        let held = if self.uncertain > 0 { Unknown } else { self.held[var] };
        self.note(var, held);
    }

    fn compute(&mut self, value: Value) -> State {
        let f = self.f;
        let scalar = |of: Value| self.program.types.scalar(f.ty(of)).unwrap_or(Scalar::Float);
        match f[value] {
            Op::Part { base, index } => match f[base] {
                Op::Const(id) if matches!(self.program.types.get(self.program[id].ty), Type::Vector { .. }) => {
                    State::Known(Known::literal(scalar(base), self.program[id].words[index as usize]))
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
            Op::Bitcast { value: of, .. } | Op::All(of) | Op::Any(of) => self.state(of).map(|_| Known::ANY),
            Op::Binary { op, left, right } => {
                let scalar = scalar(left);
                self.state(left).zip(self.state(right), |l, r| l.binary(op, r, scalar))
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
                    others => others.into_iter().flatten().fold(first, |all, other| all.zip(other, |_, _| Known::ANY)),
                }
            }
            Op::Select { condition, accept, reject } => match self.state(condition) {
                State::Known(_) => self.state(accept).or(self.state(reject)),
                _ => self.state(accept).met(self.state(reject)),
            },
            Op::Call { function, ref args } => self.call(function, args),
            _ => Unknown,
        }
    }

    fn call(&mut self, function: FuncId, args: &[Value]) -> State {
        let callee = function.index();
        for (param, &arg) in args.iter().enumerate() {
            let state = self.state(arg);
            if self.f.is_place(arg) {
                // What it leaves there is not followed.
                self.store(arg, Unknown);
            }
            if matches!(state, State::Known(_)) && self.constants.params[callee][param].add(state) {
                self.constants.stale[callee] = true;
            }
        }
        self.constants.results[callee]
    }
}

fn of_const(program: &Module, id: ConstId) -> State {
    let words = &program[id].words;
    let known = match program.types.scalar(program[id].ty) {
        Some(scalar) => words.iter().map(|&word| Known::literal(scalar, word)).reduce(Known::or),
        None => Some(Known::any_but(words.iter().any(|word| word << 1 == 0))),
    };
    known.map_or(Unknown, State::Known)
}

/// Says whether no way leads behind a block.
fn leaves(block: &Block) -> bool {
    matches!(block.last(), Some(Stmt::Break | Stmt::Continue | Stmt::Return(_) | Stmt::Discard))
}

/// Variables that a block writes.
fn collect(f: &Function, block: &Block, out: &mut Vec<usize>) {
    let mut add = |place: Value| {
        if let Op::Var(var) = f[f.root(place)]
            && !out.contains(&var.index())
        {
            out.push(var.index());
        }
    };
    for stmt in block {
        match stmt {
            Stmt::Store { place, .. } => add(*place),
            Stmt::Let(value) => {
                if let Op::Call { args, .. } = &f[*value] {
                    args.iter().copied().filter(|&arg| f.is_place(arg)).for_each(&mut add);
                }
            }
            _ => {}
        }
    }
    for stmt in block {
        stmt.blocks(|block| collect(f, block, out));
    }
}
