//! Records a history during the walk.

use super::record::{Call, History, Moment, MomentKind, NONE, Variable, Write};
use eddy_glsl::{
    ir::{Block, FuncId, GlobalId, GlobalKind, Op, Stmt, Value},
    types::TypeId,
    walk::{Cell, Float, Observer, View},
    walkable::{StatementEvent, Walkable},
};
use std::collections::HashMap;

/// The limit of moments, calls' variables and words: about 200 MB, as a write of a word takes 20 bytes.
const MAX_MOMENTS: usize = 2_000_000;
const MAX_SLOTS: usize = 8_000_000;
const MAX_WORDS: usize = 6_000_000;
/// The size limit of a value passed by reference that is recorded at the call.
const MAX_PASSED: usize = 64;

/// The meaning of a function's value for the recorder.
#[derive(Clone, Debug, Default)]
struct Role {
    event: Option<StatementEvent>,
    /// Variables of the function that the value is, or is an address of.
    variables: Vec<u32>,
    global: Option<u32>,
}

/// A function, prepared for recording.
struct Function {
    name: Option<String>,
    /// By [`Value::index`]: 0 for a value without a role, otherwise the index of its role plus one.
    roles: Vec<u32>,
    list: Vec<Role>,
    /// Parameters that are variables, and whether each is an address.
    params: Vec<(Value, bool)>,
    /// The number of its variables, which are followed by its result.
    slots: u32,
    /// True for each parameter that it writes.
    writes: Vec<bool>,
}

struct Active {
    /// None for code around the author's.
    call: Option<u32>,
    /// Active loops, each with its iteration.
    loops: Vec<(u32, u32)>,
    last: Option<u32>,
}

pub(crate) struct HistoryRecorder<'w> {
    out: Recorded,
    functions: Vec<Function>,
    ids: Vec<GlobalId>,
    active: Vec<Active>,
    has_started: bool,
    walkable: &'w Walkable,
}

impl<'w> HistoryRecorder<'w> {
    pub(crate) fn new(walkable: &'w Walkable) -> Self {
        let program = &walkable.program;
        let mut globals = Vec::new();
        let mut ids = Vec::new();
        for (name, id) in walkable.globals() {
            if matches!(program[id].kind, GlobalKind::Private(_)) {
                globals.push(Variable { name: name.to_owned(), ty: program[id].ty, local: None, constant: None });
                ids.push(id);
            }
        }
        let mut recorder = Self {
            out: Recorded { slots: vec![NONE; globals.len()], globals, ..Recorded::default() },
            functions: Vec::new(),
            ids,
            active: Vec::new(),
            has_started: false,
            walkable,
        };
        (0..program.functions.len()).for_each(|index| recorder.add_function(FuncId::new(index)));
        recorder
    }

    fn add_function(&mut self, id: FuncId) {
        let (walkable, statements) = (self.walkable, self.walkable.statements());
        let function = &walkable.program[id];
        let mut roles: HashMap<usize, Role> = HashMap::new();
        for &(value, event) in walkable.marks(id) {
            roles.entry(value.index()).or_default().event = Some(event);
        }
        let mut variables = Vec::new();
        for (local, value) in walkable.variables(id) {
            let known = &statements.locals[local as usize];
            // A value that is never computed is constant.
            let constant = (!function.is_place(value)).then(|| constant(walkable, id, value)).flatten();
            let (name, ty) = (known.name.clone(), known.ty);
            roles.entry(value.index()).or_default().variables.push(variables.len() as u32);
            variables.push(Variable { name, ty, local: Some(local), constant });
        }
        variables.push(Variable { name: String::new(), ty: function.result, local: None, constant: None });
        let slots = variables.len() as u32;
        // Constants of the language are not values of the function, and are never written.
        for (local, known) in statements.locals.iter().enumerate() {
            if let Some(words) = &known.constant {
                let (name, ty) = (known.name.clone(), known.ty);
                variables.push(Variable { name, ty, local: Some(local as u32), constant: Some(words.clone()) });
            }
        }
        for (value, op) in function.values() {
            if let Op::Global(global) = *op
                && let Some(at) = self.ids.iter().position(|id| *id == global)
            {
                roles.entry(value.index()).or_default().global = Some(at as u32);
            }
        }
        let (mut places, mut list) = (vec![0; function.len()], Vec::new());
        for (value, role) in roles {
            list.push(role);
            places[value] = list.len() as u32;
        }
        let params = function.values().filter(|(_, op)| matches!(op, Op::Param(_)));
        let params = params.filter(|(value, _)| places[value.index()] > 0);
        let params = params.map(|(value, _)| (value, function.is_place(value))).collect();
        let mut writes = vec![false; function.params.len()];
        self.record_param_writes(id, &function.body, &mut writes);
        self.functions.push(Function {
            name: walkable.function_name(id).map(str::to_owned),
            roles: places,
            list,
            params,
            slots,
            writes,
        });
        self.out.variables.push(variables);
    }

    /// Records which parameters a function writes, itself or through callees: callees come before their callers.
    fn record_param_writes(&self, id: FuncId, block: &Block, writes: &mut [bool]) {
        let function = &self.walkable.program[id];
        let mut note = |place: Value| {
            if let Op::Param(index) = function[function.root(place)] {
                writes[index as usize] = true;
            }
        };
        for stmt in block {
            match stmt {
                Stmt::Store { place, .. } => note(*place),
                Stmt::Let(value) => {
                    if let Op::Call { function: callee, args } = &function[*value] {
                        let written = self.functions[callee.index()].writes.iter();
                        args.iter().zip(written).filter(|(_, written)| **written).for_each(|(arg, _)| note(*arg));
                    }
                }
                _ => {}
            }
        }
        for stmt in block {
            stmt.blocks(|inner| self.record_param_writes(id, inner, writes));
        }
    }

    /// Returns the history after the walk has ended.
    pub(crate) fn end(self) -> Recorded {
        self.out
    }

    fn role(&self, function: FuncId, value: Value) -> Option<&Role> {
        let function = &self.functions[function.index()];
        let place = *function.roles.get(value.index())?;
        (place > 0).then(|| &function.list[place as usize - 1])
    }

    fn call(&self) -> Option<u32> {
        self.active.last()?.call
    }

    fn moment(&mut self, kind: MomentKind, statement: u32) {
        let Some(call) = self.call() else { return };
        let is_full = self.out.words.len() >= MAX_WORDS || self.out.slots.len() >= MAX_SLOTS;
        if self.out.moments.len() >= MAX_MOMENTS || is_full {
            self.out.is_cut = true;
            return;
        }
        if let Some(active) = self.active.last_mut() {
            active.last = Some(statement);
        }
        self.out.moments.push(Moment { kind, statement, call, writes: self.out.writes.len() as u32 });
    }

    fn write<R: Float>(&mut self, slot: usize, offset: usize, cells: &[Cell<R>]) {
        if self.out.is_cut {
            return;
        }
        let words = self.out.words.len() as u32;
        self.out.words.extend(cells.iter().map(|cell| cell.bits()));
        let previous = std::mem::replace(&mut self.out.slots[slot], self.out.writes.len() as u32);
        self.out.writes.push(Write { words, offset: offset as u32, count: cells.len() as u32, previous });
    }

    fn event(&mut self, event: StatementEvent) {
        let Some(active) = self.active.last_mut() else { return };
        let (kind, statement) = match event {
            StatementEvent::Start(statement) => {
                active.loops.retain(|(of, _)| *of != statement);
                (MomentKind::Statement, statement)
            }
            StatementEvent::Iteration(statement) => {
                let iteration = match active.loops.iter_mut().find(|(of, _)| *of == statement) {
                    Some((_, iterations)) => {
                        *iterations += 1;
                        *iterations
                    }
                    None => {
                        active.loops.push((statement, 1));
                        1
                    }
                };
                (MomentKind::Iteration(iteration), statement)
            }
            StatementEvent::Test(statement) => (MomentKind::Test, statement),
            StatementEvent::Step(statement) => (MomentKind::Step, statement),
        };
        self.moment(kind, statement);
    }

    /// Records the contents of a place of the current function, as a write to its variable.
    fn record_place<R: Float>(&mut self, view: &View<'_, '_, R>, place: Value) {
        let (root, offset) = view.root(place);
        let Some(role) = self.role(view.function_id(), root) else { return };
        let (variable, global) = (role.variables.first().copied(), role.global);
        let cells = view.memory(place);
        if let Some(global) = global {
            self.write(global as usize, offset, cells);
        }
        if let (Some(variable), Some(call)) = (variable, self.call()) {
            let slot = self.out.calls[call as usize].slots + variable;
            self.write(slot as usize, offset, cells);
        }
    }
}

/// Returns the words of a value that no statement computes.
fn constant(walkable: &Walkable, function: FuncId, value: Value) -> Option<Vec<u32>> {
    let program = &walkable.program;
    match program[function][value] {
        Op::Literal(_, bits) => Some(vec![bits]),
        Op::Const(id) => Some(program[id].words.clone()),
        Op::Zero(ty) => Some(vec![0; eddy_glsl::walk::cells(program, ty)]),
        _ => None,
    }
}

/// A history without its program.
#[derive(Default)]
pub(crate) struct Recorded {
    variables: Vec<Vec<Variable>>,
    globals: Vec<Variable>,
    moments: Vec<Moment>,
    calls: Vec<Call>,
    writes: Vec<Write>,
    words: Vec<u32>,
    slots: Vec<u32>,
    is_cut: bool,
}

impl Recorded {
    pub(crate) fn of(self, walkable: Walkable) -> History {
        let Self { variables, globals, moments, calls, writes, words, slots, is_cut } = self;
        History { walkable, moments, calls, is_cut, writes, words, slots, globals, variables }
    }
}

impl<R: Float> Observer<R> for HistoryRecorder<'_> {
    fn enter(&mut self, view: &View<'_, '_, R>) {
        if !std::mem::replace(&mut self.has_started, true) {
            for slot in 0..self.ids.len() {
                self.write(slot, 0, view.global(self.ids[slot]));
            }
        }
        let id = view.function_id();
        let function = &self.functions[id.index()];
        let parent = self.active.iter().rev().find_map(|active| active.call);
        let mut call = None;
        if let Some(name) = function.name.clone().filter(|_| !self.out.is_cut) {
            let slots = self.out.slots.len() as u32;
            self.out.slots.resize(self.out.slots.len() + function.slots as usize, NONE);
            call = Some(self.out.calls.len() as u32);
            self.out.calls.push(Call {
                name,
                parent,
                from: (self.out.moments.len() as u32).saturating_sub(1),
                depth: parent.map_or(0, |parent| self.out.calls[parent as usize].depth + 1),
                slots,
                function: id.index() as u32,
            });
        }
        self.active.push(Active { call, loops: Vec::new(), last: None });
        if call.is_none() {
            return;
        }
        for index in 0..self.functions[id.index()].params.len() {
            let (param, is_place) = self.functions[id.index()].params[index];
            match is_place {
                false => self.value(view, param),
                true if view.memory(param).len() <= MAX_PASSED => self.record_place(view, param),
                true => {}
            }
        }
    }

    fn leave(&mut self, view: &View<'_, '_, R>) {
        if let (Some(call), Some(last)) = (self.call(), self.active.last().and_then(|active| active.last)) {
            let function = &self.functions[view.function_id().index()];
            let slot = self.out.calls[call as usize].slots + function.slots - 1;
            if view.function().result != TypeId::VOID {
                self.write(slot as usize, 0, view.result());
            }
            self.moment(MomentKind::Return, last);
        }
        self.active.pop();
    }

    fn value(&mut self, view: &View<'_, '_, R>, value: Value) {
        let id = view.function_id();
        if let Some(role) = self.role(id, value) {
            if let Some(event) = role.event {
                return self.event(event);
            }
            if let Some(call) = self.call().filter(|_| !view.function().is_place(value)) {
                for variable in role.variables.clone() {
                    let slot = self.out.calls[call as usize].slots + variable;
                    self.write(slot as usize, 0, view.value(value));
                }
            }
        }
        // The caller records what a function wrote to its arguments.
        if let Op::Call { function: callee, args } = view.op(value) {
            for (index, &arg) in args.iter().enumerate() {
                if self.functions[callee.index()].writes.get(index) == Some(&true) && view.function().is_place(arg) {
                    self.record_place(view, arg);
                }
            }
        }
    }

    fn store(&mut self, view: &View<'_, '_, R>, place: Value, _: Value) {
        self.record_place(view, place);
    }
}
