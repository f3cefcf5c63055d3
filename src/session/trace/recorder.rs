//! Writes down what an observer of a walk sees, by the author's names.

use super::{
    number::Number,
    step::{Event, Step},
};
use crate::{
    diag::Span,
    glsl::{
        ast::Loc,
        ir::{FuncId, GlobalKind, Op, Value},
        types::{Scalar, Type, TypeId},
        walk::{Cell, Observer, View},
        walkable::Walkable,
    },
};
use std::collections::HashMap;

pub struct Recorder<'w> {
    walkable: &'w Walkable,
    /// The names of each function's values and variables.
    names: HashMap<FuncId, HashMap<Value, &'w str>>,
    steps: Vec<Step>,
    most: usize,
    left_out: u64,
    depth: u32,
    /// The turns of the loops so far, of each call under way.
    turns: Vec<u64>,
}

impl<'w> Recorder<'w> {
    pub fn new(walkable: &'w Walkable, most: usize) -> Self {
        Self { walkable, names: HashMap::new(), steps: Vec::new(), most, left_out: 0, depth: 0, turns: Vec::new() }
    }

    /// The steps, and how many more there were.
    pub fn end(self) -> (Vec<Step>, u64) {
        (self.steps, self.left_out)
    }

    fn push(&mut self, event: Event, span: Option<Span>) {
        if self.steps.len() >= self.most {
            self.left_out += 1;
            return;
        }
        self.steps.push(Step { event, depth: self.depth, span });
    }

    fn span(&self, loc: Loc) -> Option<Span> {
        (loc != Loc::default()).then(|| self.walkable.span(loc))
    }

    fn name(&mut self, function: FuncId, value: Value) -> Option<&'w str> {
        let walkable = self.walkable;
        let names =
            self.names.entry(function).or_insert_with(|| walkable.locals(function).map(|(n, v)| (v, n)).collect());
        names.get(&value).copied()
    }

    /// A place as GLSL spells it, if it is or lies in one of the author's variables.
    fn place(&mut self, view: &View<'_, '_, f32>, place: Value) -> Option<String> {
        if let Some(name) = self.name(view.function_id(), place) {
            return Some(name.to_owned());
        }
        let part = |base: Value, index: u32, recorder: &mut Self| {
            let whole = recorder.place(view, base)?;
            let ty = view.function().ty(base);
            Some(whole + &recorder.part(view, ty, index))
        };
        match *view.op(place) {
            Op::Part { base, index } => part(base, index, self),
            Op::Element { base, index } => part(base, view.value(index)[0].bits(), self),
            Op::Global(global) => match view.module()[global].kind {
                GlobalKind::Private(_) => self.walkable.global_name(global).map(str::to_owned),
                _ => None,
            },
            _ => None,
        }
    }

    fn part(&self, view: &View<'_, '_, f32>, ty: TypeId, index: u32) -> String {
        match view.module().types.get(ty) {
            Type::Vector { .. } => format!(".{}", ["x", "y", "z", "w"][index.min(3) as usize]),
            Type::Struct(id) => format!(".{}", self.walkable.member_name(id, index)),
            _ => format!("[{index}]"),
        }
    }
}

/// The scalars of a value.
fn numbers(view: &View<'_, '_, f32>, ty: TypeId, cells: &mut dyn Iterator<Item = Cell<f32>>, out: &mut Vec<Number>) {
    let module = view.module();
    match module.types.get(ty) {
        Type::Scalar(scalar) => {
            let Some(cell) = cells.next() else { return };
            out.push(match scalar {
                Scalar::Bool => Number::Bool(cell.is_true()),
                Scalar::Int => Number::Int(cell.bits() as i32),
                Scalar::Uint => Number::Uint(cell.bits()),
                Scalar::Float => Number::Float(cell.float()),
            });
        }
        _ => (0..module.extent(ty)).for_each(|i| numbers(view, module.part(ty, i), cells, out)),
    }
}

impl Observer<f32> for Recorder<'_> {
    fn enter(&mut self, view: &View<'_, '_, f32>) {
        self.turns.push(0);
        let Some(name) = self.walkable.function_name(view.function_id()) else { return };
        self.push(Event::Enter(name.to_owned()), None);
        self.depth += 1;
        // What was passed by value; the rest is the caller's.
        let function = view.function();
        for (value, op) in function.values() {
            if let (Op::Param(_), false, Some(name)) =
                (op, function.is_place(value), self.name(view.function_id(), value))
            {
                let mut all = Vec::new();
                numbers(view, function.ty(value), &mut view.value(value).iter().copied(), &mut all);
                let span = self.span(function.loc(value));
                self.push(Event::Set { name: name.to_owned(), value: all }, span);
            }
        }
    }

    fn leave(&mut self, view: &View<'_, '_, f32>) {
        self.turns.pop();
        if self.walkable.function_name(view.function_id()).is_some() {
            self.depth -= 1;
            self.push(Event::Leave, None);
        }
    }

    fn turn(&mut self, _: &View<'_, '_, f32>) {
        let Some(turns) = self.turns.last_mut() else { return };
        *turns += 1;
        let turn = *turns;
        self.push(Event::Turn(turn), None);
    }

    fn value(&mut self, view: &View<'_, '_, f32>, value: Value) {
        let function = view.function();
        if function.is_place(value) {
            return;
        }
        let Some(name) = self.name(view.function_id(), value) else { return };
        let mut all = Vec::new();
        numbers(view, function.ty(value), &mut view.value(value).iter().copied(), &mut all);
        let span = self.span(function.loc(value));
        self.push(Event::Set { name: name.to_owned(), value: all }, span);
    }

    fn store(&mut self, view: &View<'_, '_, f32>, place: Value, value: Value) {
        let Some(name) = self.place(view, place) else { return };
        let function = view.function();
        let mut all = Vec::new();
        numbers(view, function.ty(place), &mut view.memory(place).iter().copied(), &mut all);
        // A literal is made once, where it is met first: the place of what it is written to is nearer.
        let loc = if view.op(value).is_free() { function.loc(place) } else { function.loc(value) };
        let span = self.span(loc);
        self.push(Event::Set { name, value: all }, span);
    }
}
