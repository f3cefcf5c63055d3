//! Records the events of a walk in terms of the author's names.

use super::number::Number;
use eddy_diag::Span;
use eddy_glsl::{
    ast::Loc,
    ir::{FuncId, GlobalKind, Op, Value},
    types::{Scalar, Type, TypeId},
    walk::{Cell, Float, Observer, View},
    walkable::Walkable,
};
use eddy_project::limits;

pub(super) struct Recorder<'w> {
    walkable: &'w Walkable,
    /// The names of each function's values and variables, by [`Value::index`].
    names: Vec<Vec<Option<&'w str>>>,
    steps: Vec<Step>,
    max_steps: usize,
    /// Remaining bytes for steps, including their contents.
    room: usize,
    left_out: u64,
    depth: u32,
    /// The number of loop iterations so far, for each active call.
    iterations: Vec<u64>,
}

impl<'w> Recorder<'w> {
    pub(super) fn new(walkable: &'w Walkable, max_steps: usize) -> Self {
        let names = walkable.program.functions.iter().enumerate().map(|(index, function)| {
            let mut names = vec![None; function.len()];
            walkable.locals(FuncId::new(index)).for_each(|(name, value)| names[value.index()] = Some(name));
            names
        });
        let names = names.collect();
        Self {
            walkable,
            names,
            steps: Vec::new(),
            max_steps,
            room: limits::TRACE_BYTES,
            left_out: 0,
            depth: 0,
            iterations: Vec::new(),
        }
    }

    /// Returns the steps, and how many were left out.
    pub(super) fn end(self) -> (Vec<Step>, u64) {
        (self.steps, self.left_out)
    }

    /// Returns whether a step with this number of bytes in addition to its own is kept; one that is not is counted.
    /// After the first that is not kept, none is.
    fn has_room(&mut self, bytes: usize) -> bool {
        let room = self.room.checked_sub(size_of::<Step>() + bytes);
        let is_kept = self.left_out == 0 && self.steps.len() < self.max_steps && room.is_some();
        match room.filter(|_| is_kept) {
            Some(room) => self.room = room,
            None => self.left_out += 1,
        }
        is_kept
    }

    fn push(&mut self, event: Event, span: Option<Span>) {
        self.steps.push(Step { event, depth: self.depth, span });
    }

    fn span(&self, loc: Loc) -> Option<Span> {
        (loc != Loc::default()).then(|| self.walkable.span(loc))
    }

    fn name(&self, function: FuncId, value: Value) -> Option<&'w str> {
        self.names[function.index()][value.index()]
    }

    fn set<R: Float>(&mut self, view: &View<'_, '_, R>, name: String, (ty, cells): (TypeId, &[Cell<R>]), loc: Loc) {
        if !self.has_room(name.len() + cells.len() * size_of::<Number>()) {
            return;
        }
        let mut value = Vec::with_capacity(cells.len());
        numbers(view, ty, &mut cells.iter(), &mut value);
        let span = self.span(loc);
        self.push(Event::Set { name, value }, span);
    }

    /// Returns a place in GLSL syntax, if it is one of the author's variables or a part of one.
    fn place<R: Float>(&self, view: &View<'_, '_, R>, place: Value) -> Option<String> {
        if let Some(name) = self.name(view.function_id(), place) {
            return Some(name.to_owned());
        }
        let part = |base: Value, index: u32| {
            let whole = self.place(view, base)?;
            let ty = view.function().ty(base);
            Some(whole + &self.part(view, ty, index))
        };
        match *view.op(place) {
            Op::Part { base, index } => part(base, index),
            Op::Element { base, index } => part(base, view.value(index)[0].bits()),
            Op::Global(global) => match view.module()[global].kind {
                GlobalKind::Private(_) => self.walkable.global_name(global).map(str::to_owned),
                _ => None,
            },
            _ => None,
        }
    }

    fn part<R: Float>(&self, view: &View<'_, '_, R>, ty: TypeId, index: u32) -> String {
        match view.module().types.get(ty) {
            Type::Vector { .. } => format!(".{}", ["x", "y", "z", "w"][index.min(3) as usize]),
            Type::Struct(id) => format!(".{}", self.walkable.member_name(id, index)),
            _ => format!("[{index}]"),
        }
    }
}

/// Returns the scalars of a value.
fn numbers<R: Float>(
    view: &View<'_, '_, R>,
    ty: TypeId,
    cells: &mut std::slice::Iter<'_, Cell<R>>,
    out: &mut Vec<Number>,
) {
    let module = view.module();
    match module.types.scalar(ty) {
        Some(scalar) => {
            let count = module.types.components(ty).unwrap_or(1) as usize;
            out.extend(cells.take(count).map(|cell| match scalar {
                Scalar::Bool => Number::Bool(cell.is_true()),
                Scalar::Int => Number::Int(cell.bits() as i32),
                Scalar::Uint => Number::Uint(cell.bits()),
                Scalar::Float => Number::Float(cell.float().to_f32()),
            }));
        }
        None => (0..module.extent(ty)).for_each(|i| numbers(view, module.part(ty, i), cells, out)),
    }
}

impl<R: Float> Observer<R> for Recorder<'_> {
    fn enter(&mut self, view: &View<'_, '_, R>) {
        self.iterations.push(0);
        let Some(name) = self.walkable.function_name(view.function_id()) else { return };
        if self.has_room(name.len()) {
            self.push(Event::Enter(name.to_owned()), None);
        }
        self.depth += 1;
        // Arguments passed by value; all others are the caller's.
        let function = view.function();
        for (value, op) in function.values() {
            if let (Op::Param(_), false, Some(name)) =
                (op, function.is_place(value), self.name(view.function_id(), value))
            {
                self.set(view, name.to_owned(), (function.ty(value), view.value(value)), function.loc(value));
            }
        }
    }

    fn leave(&mut self, view: &View<'_, '_, R>) {
        self.iterations.pop();
        if self.walkable.function_name(view.function_id()).is_some() {
            self.depth -= 1;
            if self.has_room(0) {
                self.push(Event::Leave, None);
            }
        }
    }

    fn iteration(&mut self, _: &View<'_, '_, R>) {
        let Some(iterations) = self.iterations.last_mut() else { return };
        *iterations += 1;
        let iteration = *iterations;
        if self.has_room(0) {
            self.push(Event::Iteration(iteration), None);
        }
    }

    fn value(&mut self, view: &View<'_, '_, R>, value: Value) {
        let Some(name) = self.name(view.function_id(), value) else { return };
        let function = view.function();
        if !function.is_place(value) {
            self.set(view, name.to_owned(), (function.ty(value), view.value(value)), function.loc(value));
        }
    }

    fn store(&mut self, view: &View<'_, '_, R>, place: Value, value: Value) {
        let Some(name) = self.place(view, place) else { return };
        let function = view.function();
        // A literal exists once, at its first use: the place of the store is more exact.
        let loc = if view.op(value).is_free() { function.loc(place) } else { function.loc(value) };
        self.set(view, name, (function.ty(place), view.memory(place)), loc);
    }
}

/// The event of a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// A function of this name starts.
    Enter(String),
    /// The function that started last has ended.
    Leave,
    /// A loop starts its next iteration, counted from 1 through all loops of the call. The last is the one whose test
    /// ends the loop.
    Iteration(u64),
    /// A variable, or a part of one, is assigned: its name in GLSL syntax, and its scalars in memory order.
    Set { name: String, value: Vec<Number> },
}

/// A step of a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    pub event: Event,
    /// The number of enclosing calls.
    pub depth: u32,
    /// The part of the text; none if it is not from the text.
    pub span: Option<Span>,
}
