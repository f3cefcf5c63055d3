//! Vectors, matrices and structures in memory, taken apart into scalars.
//!
//! OpenGL's compilers do that before all else; a SPIR-V driver keeps a vector that a branch or a loop writes as a whole (lavapipe,
//! in the phis of its SSA form). Then a component that nobody reads is computed all the same, and what puts vectors together
//! counts as work: loops just short enough to be written out, and branches just short enough to become selects, are so with
//! OpenGL only.

use crate::glsl::{
    ast::Loc,
    ir::{Block, Function, Module, Op, Stmt, Value, VarId},
    types::{Type, TypeId},
};

/// What holds more scalars stays memory: to copy it takes an instruction, not one for each of them. Structures that
/// people write have some dozens.
const MOST_SCALARS: usize = 256;

/// Runs the pass over all functions.
pub(super) fn run(module: &mut Module) {
    let mut functions = std::mem::take(&mut module.functions);
    functions.iter_mut().for_each(|function| split(function, module));
    module.functions = functions;
}

/// Takes apart the variables of a function that nothing but loads, stores and constant indices touch: no call is given a pointer
/// to them. What holds an array stays as it is, and what begins with a value.
fn split(f: &mut Function, module: &Module) {
    let scalars = f.vars.iter().map(|var| {
        let mut scalars = Vec::new();
        let is_large = module.scalars_up_to(var.ty, MOST_SCALARS) > MOST_SCALARS;
        let whole = var.init.is_some() || is_large || !scalars_of(module, var.ty, &mut scalars);
        if whole || scalars.len() == 1 { Vec::new() } else { scalars }
    });
    let mut scalars: Vec<Vec<TypeId>> = scalars.collect();
    if scalars.iter().all(Vec::is_empty) {
        return;
    }
    let places = places(f, module, &scalars);
    let mut keep = |place: Value| {
        if let Some(place) = places[place.index()] {
            scalars[place.var.index()].clear();
        }
    };
    for (_, op) in f.values() {
        match op {
            Op::Element { base, .. } => keep(*base),
            Op::Call { args, .. } => args.iter().for_each(|&arg| keep(arg)),
            _ => {}
        }
    }
    if scalars.iter().all(Vec::is_empty) {
        return;
    }
    let mut parts = Vec::with_capacity(scalars.len());
    for scalars in scalars {
        let place = |ty| {
            let var = f.add_var(ty);
            f.append(Op::Var(var), ty, Loc::default())
        };
        parts.push(scalars.into_iter().map(place).collect());
    }
    let body = std::mem::take(&mut f.body);
    let new = (0..f.len()).map(Value::new).collect();
    let mut split = Split { module, f, places, parts, new, out: Block::new() };
    split.block(body);
    let gone: Vec<bool> = split.parts.iter().map(|parts| !parts.is_empty()).collect();
    f.body = std::mem::take(&mut split.out);
    // Nothing reaches them any more.
    let nothing = |var| gone.get(var).is_some_and(|gone| *gone).then_some(Op::Zero(TypeId::FLOAT));
    f.replace_vars((0..f.vars.len()).map(nothing).collect());
}

/// A part of a variable.
#[derive(Clone, Copy)]
struct Place {
    var: VarId,
    /// How many scalars of the variable precede it.
    before: usize,
    ty: TypeId,
}

struct Split<'a> {
    module: &'a Module,
    f: &'a mut Function,
    /// Values that point into variables.
    places: Vec<Option<Place>>,
    /// Places of the scalars of variables that are taken apart; none of the others.
    parts: Vec<Vec<Value>>,
    /// What stands for each value now.
    new: Vec<Value>,
    out: Block,
}

impl Split<'_> {
    fn add(&mut self, op: Op, ty: TypeId, loc: Loc) -> Value {
        let value = self.f.append(op, ty, loc);
        self.out.push(Stmt::Let(value));
        value
    }

    fn value(&self, old: Value) -> Value {
        self.new[old.index()]
    }

    /// Where a value points, if that was taken apart.
    fn taken_apart(&self, value: Value) -> Option<Place> {
        self.places[value.index()].filter(|place| !self.parts[place.var.index()].is_empty())
    }

    fn compute(&mut self, value: Value) {
        if self.taken_apart(value).is_some() {
            return;
        }
        match self.f[value] {
            Op::Load { place } => {
                if let Some(Place { var, mut before, ty }) = self.taken_apart(place) {
                    self.new[value.index()] = self.load(var, &mut before, ty, self.f.loc(value));
                    return;
                }
            }
            Op::Part { base, index } => {
                if let Some(part) = self.component(self.value(base), index) {
                    self.new[value.index()] = part;
                    return;
                }
            }
            _ => {}
        }
        let mut op = self.f[value].clone();
        op.operands_mut(|operand| *operand = self.value(*operand));
        self.f.replace(value, op);
        self.out.push(Stmt::Let(value));
    }

    /// A part of a value that was put together from as many.
    fn component(&self, value: Value, index: u32) -> Option<Value> {
        match &self.f[value] {
            Op::Compose { ty, parts } if parts.len() == self.module.extent(*ty) as usize => Some(parts[index as usize]),
            _ => None,
        }
    }

    /// Puts a value together from scalars; counts those in `before`.
    fn load(&mut self, var: VarId, before: &mut usize, ty: TypeId, loc: Loc) -> Value {
        let extent = self.module.extent(ty);
        if extent == 0 {
            let place = self.parts[var.index()][*before];
            *before += 1;
            return self.add(Op::Load { place }, ty, loc);
        }
        let parts = (0..extent).map(|i| self.load(var, before, self.module.part(ty, i), loc)).collect();
        self.add(Op::Compose { ty, parts }, ty, loc)
    }

    /// The scalars of a value, in order.
    fn scalars(&mut self, value: Value, ty: TypeId, out: &mut Vec<Value>) {
        let extent = self.module.extent(ty);
        if extent == 0 {
            out.push(value);
        }
        for index in 0..extent {
            let part = self.module.part(ty, index);
            let component = self.component(value, index);
            let component =
                component.unwrap_or_else(|| self.add(Op::Part { base: value, index }, part, self.f.loc(value)));
            self.scalars(component, part, out);
        }
    }

    fn nested(&mut self, block: Block) -> Block {
        let outer = std::mem::take(&mut self.out);
        self.block(block);
        std::mem::replace(&mut self.out, outer)
    }

    fn block(&mut self, block: Block) {
        self.out.reserve(block.len());
        for stmt in block {
            let stmt = match stmt {
                Stmt::Let(value) => {
                    self.compute(value);
                    continue;
                }
                Stmt::Store { place, value } => {
                    let value = self.value(value);
                    if let Some(Place { var, before, ty }) = self.taken_apart(place) {
                        let mut scalars = Vec::new();
                        self.scalars(value, ty, &mut scalars);
                        let places = self.parts[var.index()][before..].to_vec();
                        self.out
                            .extend(places.into_iter().zip(scalars).map(|(place, value)| Stmt::Store { place, value }));
                        continue;
                    }
                    Stmt::Store { place: self.value(place), value }
                }
                Stmt::If { condition, accept, reject } => {
                    let condition = self.value(condition);
                    Stmt::If { condition, accept: self.nested(accept), reject: self.nested(reject) }
                }
                Stmt::Switch { selector, mut cases } => {
                    let selector = self.value(selector);
                    for case in &mut cases {
                        case.body = self.nested(std::mem::take(&mut case.body));
                    }
                    Stmt::Switch { selector, cases }
                }
                Stmt::Loop { body, continuing, break_if } => {
                    let (body, continuing) = (self.nested(body), self.nested(continuing));
                    Stmt::Loop { body, continuing, break_if: break_if.map(|value| self.value(value)) }
                }
                Stmt::Return(value) => Stmt::Return(value.map(|value| self.value(value))),
                Stmt::Output(parts) => {
                    Stmt::Output(parts.into_iter().map(|(output, value)| (output, self.value(value))).collect())
                }
                Stmt::Break | Stmt::Continue | Stmt::Discard => stmt,
            };
            self.out.push(stmt);
        }
    }
}

/// The types of the scalars of a type, in order; `false` if it holds anything else.
fn scalars_of(module: &Module, ty: TypeId, out: &mut Vec<TypeId>) -> bool {
    match module.types.get(ty) {
        Type::Scalar(_) => out.push(ty),
        Type::Vector { .. } | Type::Matrix { .. } | Type::Struct(_) => {
            return (0..module.extent(ty)).all(|index| scalars_of(module, module.part(ty, index), out));
        }
        _ => return false,
    }
    true
}

/// What each value points to, if that is a part of a variable of these scalars that constant indices lead to.
fn places(f: &Function, module: &Module, scalars: &[Vec<TypeId>]) -> Vec<Option<Place>> {
    f.values().map(|(value, _)| place(f, module, scalars, value)).collect()
}

fn place(f: &Function, module: &Module, scalars: &[Vec<TypeId>], value: Value) -> Option<Place> {
    match f[value] {
        Op::Var(var) if !scalars[var.index()].is_empty() => Some(Place { var, before: 0, ty: f.ty(value) }),
        // As deep as types nest.
        Op::Part { base, index } if f.is_place(base) => {
            let base = place(f, module, scalars, base)?;
            let skipped = (0..index).map(|index| count(module, module.part(base.ty, index)));
            let before = base.before + skipped.sum::<usize>();
            Some(Place { before, ty: module.part(base.ty, index), ..base })
        }
        _ => None,
    }
}

/// How many scalars a type holds.
fn count(module: &Module, ty: TypeId) -> usize {
    match module.extent(ty) {
        0 => 1,
        extent => (0..extent).map(|index| count(module, module.part(ty, index))).sum(),
    }
}
