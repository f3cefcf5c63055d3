//! Tracks the influence of unwritten values through a walk, scalar by scalar, up to the output of the pass.
//!
//! The rules: a result of arithmetic depends on each operand of its component, even if the operand has no effect on the
//! number (`0.0 * x`, `min(x, x)`); a conditional expression depends only on the condition and on the evaluated side; a
//! read or write at an undefined index depends on the index, as does everything that the write might have hit. If a
//! branch, a loop or a jump depends on an undefined value, so does everything that is written under it, and everything
//! that the path not taken would have written. A defined value that is written on a defined path is defined.

mod control;
mod operations;
mod sets;
mod writes;

use control::{Control, Kind};
use eddy_diag::Span;
use eddy_glsl::{
    ir::{Op, Output, Stmt, Value},
    types::TypeId,
    walk::{Shadowed, View},
    walkable::{UnsetKind, Walkable},
};
use operations::all;
use sets::{Scalar, Set, Sets};
use std::{
    collections::{BTreeSet, HashMap},
    ops::Range,
};
use writes::{Effects, Globals, Summary};

/// A declaration that leaves a value undefined.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Origin {
    pub kind: UnsetKind,
    pub name: String,
    /// The place of the name.
    pub span: Span,
    pub ty: TypeId,
}

impl Origin {
    /// Returns whether it is the same declaration: a function that is compiled several times has several copies.
    pub(super) fn is_same_declaration(&self, other: &Origin) -> bool {
        (self.kind, self.span, &self.name) == (other.kind, other.span, &other.name)
    }
}

/// A declaration, and those of its scalars that the output depends on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shown {
    pub origin: Origin,
    pub cells: BTreeSet<u32>,
}

/// One activation of a function.
struct Frame {
    /// By [`View::cells_of`].
    cells: Vec<Set>,
    /// Places at an undefined index: the dependencies of the index, and all cells that it may refer to.
    places: HashMap<Value, (Set, Range<usize>)>,
    result: Vec<Set>,
}

/// An argument of a call: the dependencies of its scalars, or of an address.
enum Argument {
    Value(Vec<Set>),
    Place(Option<(Set, Range<usize>)>),
}

pub(super) struct Flow<'w> {
    walkable: &'w Walkable,
    sets: Sets,
    origins: Vec<Origin>,
    /// The number of the first scalar's origin, by function and value.
    numbers: HashMap<(usize, Value), u32>,
    frames: Vec<Frame>,
    memory: Vec<Set>,
    arguments: Vec<Argument>,
    returned: Vec<Set>,
    control: Control,
    /// The undefined values that the output depends on.
    drawn: Set,
    has_drawn: bool,
    /// The number of scalars that each target stores.
    stored: &'w [usize],
    summaries: Option<Vec<Summary>>,
}

impl<'w> Flow<'w> {
    pub(super) fn new(walkable: &'w Walkable, stored: &'w [usize]) -> Self {
        Self {
            walkable,
            sets: Sets::new(),
            origins: Vec::new(),
            numbers: HashMap::new(),
            frames: Vec::new(),
            memory: Vec::new(),
            arguments: Vec::new(),
            returned: Vec::new(),
            control: Control::default(),
            drawn: Set::EMPTY,
            has_drawn: false,
            stored,
            summaries: None,
        }
    }

    /// Returns the undefined values that the pixel shows.
    pub(super) fn shown(mut self) -> Vec<Shown> {
        if !self.has_drawn {
            self.drawn = self.control.total();
        }
        let mut all: Vec<Shown> = Vec::new();
        for scalar in self.sets.of(self.drawn) {
            let origin = &self.origins[scalar.origin as usize];
            match all.iter_mut().find(|shown| shown.origin.is_same_declaration(origin)) {
                Some(shown) => _ = shown.cells.insert(scalar.cell),
                None => all.push(Shown { origin: origin.clone(), cells: [scalar.cell].into() }),
            }
        }
        all
    }

    /// Returns whether some operand of an operation depends on an undefined value.
    pub(super) fn is_undefined(&self, view: &View<'_, '_, Shadowed>, op: &Op) -> bool {
        let Some(frame) = self.frames.last() else { return false };
        let mut found = false;
        op.operands(|operand| {
            found |= !view.is_place(operand) && frame.cells[view.cells_of(operand)].iter().any(|set| !set.is_empty());
        });
        found
    }

    pub(super) fn is_undefined_value(&self, view: &View<'_, '_, Shadowed>, value: Value) -> bool {
        let Some(frame) = self.frames.last() else { return false };
        !view.is_place(value) && frame.cells[view.cells_of(value)].iter().any(|set| !set.is_empty())
    }

    pub(super) fn calling(&mut self, view: &View<'_, '_, Shadowed>, arguments: &[Value]) {
        let Some(frame) = self.frames.last() else { return };
        let argument = |&argument: &Value| match view.is_place(argument) {
            true => Argument::Place(frame.places.get(&argument).cloned()),
            false => Argument::Value(frame.cells[view.cells_of(argument)].to_vec()),
        };
        self.arguments = arguments.iter().map(argument).collect();
    }

    pub(super) fn enter(&mut self, view: &View<'_, '_, Shadowed>) {
        let own = view.own_memory();
        self.memory.truncate(own.start);
        self.memory.resize(own.end, Set::EMPTY);
        if self.frames.is_empty() {
            for (global, name, span) in self.walkable.undefined_globals() {
                let (memory, ty) = (view.global_memory(global), view.module()[global].ty);
                let origin = Origin { kind: UnsetKind::Variable, name: name.to_owned(), span, ty };
                let number = self.origins.len() as u32;
                self.origins.push(origin);
                for (cell, at) in memory.enumerate() {
                    self.memory[at] = self.sets.single(Scalar { origin: number, cell: cell as u32 });
                }
            }
        }
        let mut frame =
            Frame { cells: vec![Set::EMPTY; view.frame_cells()], places: HashMap::new(), result: Vec::new() };
        let function = view.function_id();
        for unset in self.walkable.undefined(function) {
            let ty = view.function().ty(unset.value);
            let number = *self.numbers.entry((function.index(), unset.value)).or_insert_with(|| {
                self.origins.push(Origin { kind: unset.kind, name: unset.name.to_owned(), span: unset.span, ty });
                self.origins.len() as u32 - 1
            });
            let is_place = view.is_place(unset.value);
            let (start, count) = match is_place {
                true => (view.address(unset.value), view.memory(unset.value).len()),
                false => (view.cells_of(unset.value).start, view.cells_of(unset.value).len()),
            };
            let cells = if is_place { &mut self.memory } else { &mut frame.cells };
            for i in 0..count {
                cells[start + i] = self.sets.single(Scalar { origin: number, cell: i as u32 });
            }
        }
        let arguments = std::mem::take(&mut self.arguments);
        for (value, op) in view.function().values() {
            let Op::Param(index) = *op else { continue };
            match arguments.get(index as usize) {
                Some(Argument::Value(sets)) => frame.cells[view.cells_of(value)].copy_from_slice(sets),
                Some(Argument::Place(Some(place))) => _ = frame.places.insert(value, place.clone()),
                _ => {}
            }
        }
        self.frames.push(frame);
        self.returned.clear();
        self.control.push(Kind::Function);
    }

    pub(super) fn returned(&mut self, view: &View<'_, '_, Shadowed>, value: Option<Value>) {
        let way = self.control.total();
        let Some(frame) = self.frames.last_mut() else { return };
        let cells = value.map_or(0..0, |value| view.cells_of(value));
        frame.result = frame.cells[cells].iter().map(|&set| self.sets.union(set, way)).collect();
    }

    pub(super) fn leave(&mut self) {
        self.control.pop_function();
        self.returned = self.frames.pop().map(|frame| frame.result).unwrap_or_default();
    }

    /// Records the dependencies of a computed place.
    pub(super) fn place(&mut self, view: &View<'_, '_, Shadowed>, place: Value) {
        let Some(frame) = self.frames.last_mut() else { return };
        let known = match *view.op(place) {
            Op::Part { base, .. } => frame.places.get(&base).cloned(),
            Op::Element { base, index } => {
                let decides = frame.cells[view.cells_of(index).start];
                let through = frame.places.get(&base).cloned();
                let start = view.address(base);
                let whole = start..start + view.memory(base).len();
                match through {
                    Some((set, range)) => Some((self.sets.union(set, decides), range)),
                    None => (!decides.is_empty()).then_some((decides, whole)),
                }
            }
            _ => return,
        };
        match known {
            Some(known) => _ = frame.places.insert(place, known),
            None => _ = frame.places.remove(&place),
        }
    }

    pub(super) fn store(&mut self, view: &View<'_, '_, Shadowed>, place: Value, value: Value) {
        let way = self.control.total();
        let Some(frame) = self.frames.last() else { return };
        let through = frame.places.get(&place).cloned();
        if let Some((set, range)) = &through {
            for at in range.clone() {
                self.memory[at] = self.sets.union(self.memory[at], *set);
            }
        }
        let way = self.sets.union(way, through.map_or(Set::EMPTY, |known| known.0));
        let start = view.address(place);
        for (i, from) in view.cells_of(value).enumerate() {
            self.memory[start + i] = self.sets.union(frame.cells[from], way);
        }
    }

    pub(super) fn output(&mut self, view: &View<'_, '_, Shadowed>, output: Output, value: Value) {
        let Some(frame) = self.frames.last() else { return };
        let cells = view.cells_of(value);
        let count = match output {
            Output::Target(index) => self.stored.get(index as usize).copied().unwrap_or(4).min(cells.len()),
            _ => cells.len(),
        };
        let read = all(&mut self.sets, &frame.cells[cells.start..cells.start + count]);
        let way = self.control.total();
        let read = self.sets.union(read, way);
        self.drawn = self.sets.union(self.drawn, read);
        self.has_drawn = true;
    }

    pub(super) fn branch(&mut self, view: &View<'_, '_, Shadowed>, stmt: &Stmt) {
        let (kind, condition) = match *stmt {
            Stmt::If { condition, .. } => (Kind::If, condition),
            Stmt::Switch { selector, .. } => (Kind::Switch, selector),
            _ => return,
        };
        self.control.push(kind);
        let set = self.frames.last().map_or(Set::EMPTY, |frame| frame.cells[view.cells_of(condition).start]);
        if !set.is_empty() {
            self.decided(view, stmt, set);
        }
    }

    pub(super) fn branch_end(&mut self) {
        self.control.pop();
    }

    pub(super) fn loop_start(&mut self, stmt: &Stmt) {
        if let Stmt::Loop { break_if, .. } = *stmt {
            self.control.push(Kind::Loop { stmt, break_if });
        }
    }

    pub(super) fn turn(&mut self) {
        self.control.end_iteration(&mut self.sets);
    }

    /// Called for a deciding value; the test after an iteration of a loop is only reported here.
    pub(super) fn decide(&mut self, view: &View<'_, '_, Shadowed>, value: Value) {
        let Some(Kind::Loop { stmt, break_if }) = self.control.top() else { return };
        let set = self.frames.last().map_or(Set::EMPTY, |frame| frame.cells[view.cells_of(value).start]);
        if break_if != Some(value) || set.is_empty() {
            return;
        }
        self.control.add(set, |kind| matches!(kind, Kind::Loop { .. }), &mut self.sets);
        self.spread(view, stmt, set, Effects { breaks: true, ..Effects::default() });
    }

    /// Records that a branch depends on an undefined value.
    fn decided(&mut self, view: &View<'_, '_, Shadowed>, stmt: &Stmt, set: Set) {
        self.control.add(set, |_| true, &mut self.sets);
        let jumps = self.effects(view, stmt).0;
        if jumps.breaks {
            let is_left = |kind| matches!(kind, Kind::Loop { .. } | Kind::Switch);
            self.control.add(set, is_left, &mut self.sets);
        }
        if jumps.continues {
            self.control.add_to_iteration(set, &mut self.sets);
        }
        if jumps.returns {
            self.control.add(set, |kind| kind == Kind::Function, &mut self.sets);
        }
        if jumps.discards {
            self.control.add_discard(set, &mut self.sets);
        }
        self.spread(view, stmt, set, Effects { writes: Default::default(), ..jumps });
    }

    fn effects(&mut self, view: &View<'_, '_, Shadowed>, stmt: &Stmt) -> (Effects, Globals) {
        let module = view.module();
        let summaries = self.summaries.get_or_insert_with(|| writes::summaries(module));
        let (mut effects, mut globals) = Default::default();
        writes::add_stmt(module, view.function(), summaries, stmt, &mut effects, &mut globals);
        (effects, globals)
    }

    /// Adds a set to the dependencies of everything that a statement may write, and that its jumps skip.
    fn spread(&mut self, view: &View<'_, '_, Shadowed>, stmt: *const Stmt, set: Set, mut jumps: Effects) {
        let (module, function) = (view.module(), view.function());
        let summaries = self.summaries.get_or_insert_with(|| writes::summaries(module));
        let (mut effects, mut globals): (Effects, Globals) = Default::default();
        let place = (module, function, &summaries[..]);
        add_own(place, &function.body, stmt, &mut effects, &mut globals);
        writes::add_rest(place, &function.body, stmt, &mut jumps, &mut effects, &mut globals);
        let mut reach = |range: Range<usize>| {
            for at in range {
                if let Some(held) = self.memory.get_mut(at) {
                    *held = self.sets.union(*held, set);
                }
            }
        };
        for written in effects.writes {
            let start = view.address(written.root) + written.start;
            reach(start..start + written.count);
        }
        for (global, start, count) in globals {
            let first = view.global_memory(global).start + start;
            reach(first..first + count);
        }
    }
}

/// Adds the effects of the statement at an address itself.
fn add_own(
    place: (&eddy_glsl::ir::Module, &eddy_glsl::ir::Function, &[Summary]),
    block: &[Stmt],
    stmt: *const Stmt,
    effects: &mut Effects,
    globals: &mut Globals,
) {
    for inner in block {
        if std::ptr::eq(inner, stmt) {
            writes::add_stmt(place.0, place.1, place.2, inner, effects, globals);
            return;
        }
        inner.blocks(|block| add_own(place, block, stmt, effects, globals));
    }
}
