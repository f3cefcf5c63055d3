//! Replaces operations by their values where these are known, takes known branches, and forwards stores to loads.

use super::{
    Assumptions,
    number::Number,
    summary::{Facts, Summary, of_words},
};
use crate::{
    builtins::Uniform,
    ir::{
        Binary, Block, Case, Function, GlobalId, GlobalKind, Input, Math, Module, Op, Stmt, Value, VarId,
        analysis::{leaves, stores},
    },
    types::{Scalar, Type, TypeId},
};
use rustc_hash::FxHashMap;

/// An upper bound for the pixels on a side of a texture, as a float.
const MAX_SIDE: f64 = (1 << 20) as f64;

/// Folds a function of `module`, which has been taken out of it. `summary` has what is known of the whole program, and
/// collects what this function contributes to the next round.
pub(super) fn function(
    module: &Module,
    index: usize,
    f: Function,
    assumptions: &Assumptions<'_>,
    known: &Summary,
    found: &mut Summary,
) -> Function {
    let map = (0..f.len()).map(Value::new).collect();
    let facts = vec![None; f.len()];
    let mut fold = Fold { module, index, f, assumptions, known, found, map, facts, literals: FxHashMap::default() };
    let body = std::mem::take(&mut fold.f.body);
    let body = fold.block(body, &mut Memory::default());
    fold.f.body = body;
    for var in 0..fold.f.vars.len() {
        if let Some(init) = fold.f.vars[var].init {
            let facts = fold.of(init);
            fold.found.store_var(index, VarId::new(var), None, facts);
        }
    }
    fold.f
}

/// A variable whose newest value is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Variable {
    Var(VarId),
    Global(GlobalId),
}

/// The values that variables were given last on the path to the current statement.
type Memory = FxHashMap<Variable, Value>;

struct Fold<'a> {
    module: &'a Module,
    index: usize,
    f: Function,
    assumptions: &'a Assumptions<'a>,
    known: &'a Summary,
    found: &'a mut Summary,
    /// The replacement of each value.
    map: Vec<Value>,
    facts: Vec<Option<Facts>>,
    literals: FxHashMap<(Scalar, u32), Value>,
}

impl Fold<'_> {
    fn mapped(&self, value: Value) -> Value {
        self.map.get(value.index()).copied().unwrap_or(value)
    }

    fn scalar(&self, value: Value) -> Option<Scalar> {
        match self.module.types.get(self.f.ty(value)) {
            Type::Scalar(scalar) | Type::Vector { scalar, .. } => Some(scalar),
            _ => None,
        }
    }

    /// Returns what is known of a value: of each component of a scalar or vector.
    fn of(&self, value: Value) -> Facts {
        if let Some(Some(facts)) = self.facts.get(value.index()) {
            return *facts;
        }
        match self.f[value] {
            Op::Literal(scalar, bits) => [Number::literal(scalar, bits), None, None, None],
            Op::Zero(ty) => match self.module.types.get(ty) {
                Type::Scalar(_) | Type::Vector { .. } => [Some(Number::between(0.0, 0.0)); 4],
                _ => [None; 4],
            },
            Op::Const(id) => {
                let constant = &self.module[id];
                of_words(self.module, constant.ty, &constant.words)
            }
            Op::Param(index) if !self.f.is_place(value) => self.known.param(self.index, index),
            Op::Input(Input::Position) => {
                let side = Some(Number::between(0.0, MAX_SIDE));
                [side, side, None, None]
            }
            _ => self.of_type(self.f.ty(value)),
        }
    }

    fn of_type(&self, ty: TypeId) -> Facts {
        match self.module.types.get(ty) {
            Type::Scalar(scalar) | Type::Vector { scalar, .. } => [Number::of_type(scalar); 4],
            _ => [None; 4],
        }
    }

    /// Returns the variable that a place is, or is a part of.
    fn variable(&self, place: Value) -> Option<Variable> {
        match self.f[self.f.root(place)] {
            Op::Var(id) => Some(Variable::Var(id)),
            Op::Global(id) => Some(Variable::Global(id)),
            _ => None,
        }
    }

    fn block(&mut self, block: Block, memory: &mut Memory) -> Block {
        let mut out = Block::with_capacity(block.len());
        for stmt in block {
            self.stmt(stmt, memory, &mut out);
            if matches!(out.last(), Some(Stmt::Output(_))) || ends(&out) {
                break;
            }
        }
        out
    }

    fn stmt(&mut self, mut stmt: Stmt, memory: &mut Memory, out: &mut Block) {
        if let Stmt::Let(value) = stmt {
            return self.compute(value, memory, out);
        }
        if !matches!(stmt, Stmt::Loop { .. }) {
            stmt.operands_mut(|operand| *operand = self.mapped(*operand));
        }
        match stmt {
            Stmt::Store { place, value } => {
                self.store(place, value, memory);
                out.push(Stmt::Store { place, value });
            }
            Stmt::If { condition, accept, reject } => {
                if let Some(bit) = self.bool(condition) {
                    let taken = self.block(if bit { accept } else { reject }, memory);
                    out.extend(taken);
                    return;
                }
                let before = memory.clone();
                let mut other = memory.clone();
                let accept = self.block(accept, memory);
                let reject = self.block(reject, &mut other);
                if leaves(&accept) {
                    *memory = other;
                } else if !leaves(&reject) {
                    memory.retain(|variable, value| other.get(variable) == Some(value));
                }
                // A value that was computed in a branch cannot be used after it.
                memory.retain(|variable, value| self.f[*value].is_free() || before.get(variable) == Some(value));
                if !accept.is_empty() || !reject.is_empty() {
                    out.push(Stmt::If { condition, accept, reject });
                }
            }
            Stmt::Loop { body, .. } if self.breaks_at_once(&body, memory) => {}
            Stmt::Loop { body, continuing, break_if } => {
                self.forget_stored(&body, memory);
                self.forget_stored(&continuing, memory);
                let body = self.block(body, &mut memory.clone());
                if leaves(&body) && !body.iter().any(crate::ir::analysis::continues) {
                    // One iteration, whose last statement leaves the loop.
                    if matches!(body[..], [Stmt::Break]) {
                        return;
                    }
                    out.push(Stmt::Loop { body, continuing: Block::new(), break_if: None });
                    return;
                }
                let continuing = self.block(continuing, &mut Memory::default());
                let break_if = break_if.map(|value| self.mapped(value));
                out.push(Stmt::Loop { body, continuing, break_if });
            }
            Stmt::Switch { selector, cases } => {
                let cases = self.taken_case(selector, cases);
                for case in &cases {
                    self.forget_stored(&case.body, memory);
                }
                let cases: Vec<Case> = cases
                    .into_iter()
                    .map(|case| Case { body: self.block(case.body, &mut memory.clone()), ..case })
                    .collect();
                if cases.iter().any(|case| !matches!(case.body[..], [] | [Stmt::Break])) {
                    out.push(Stmt::Switch { selector, cases });
                }
            }
            Stmt::Return(value) => {
                if let Some(value) = value {
                    let facts = self.of(value);
                    self.found.returned(self.index, facts);
                }
                out.push(Stmt::Return(value));
            }
            other => out.push(other),
        }
    }

    /// Returns whether the test of a loop is false before its first iteration.
    fn breaks_at_once(&mut self, body: &Block, memory: &Memory) -> bool {
        let mut computed = Vec::new();
        let mut breaks = false;
        for stmt in body {
            match stmt {
                Stmt::Let(value) if !matches!(self.f[*value], Op::Call { .. }) => {
                    let mut op = self.f[*value].clone();
                    op.operands_mut(|operand| *operand = self.mapped(*operand));
                    let facts = self.facts_of(&op, self.f.ty(*value), memory);
                    self.facts.resize(self.f.len(), None);
                    self.facts[value.index()] = Some(facts);
                    computed.push(*value);
                }
                Stmt::If { condition, accept, reject } => {
                    breaks = self
                        .bool(self.mapped(*condition))
                        .is_some_and(|bit| matches!(if bit { accept } else { reject }[..], [Stmt::Break]));
                    break;
                }
                _ => break,
            }
        }
        // They hold for the first iteration only.
        computed.into_iter().for_each(|value| self.facts[value.index()] = None);
        breaks
    }

    /// Drops the cases of a switch that a known selector does not run.
    fn taken_case(&self, selector: Value, mut cases: Vec<Case>) -> Vec<Case> {
        let known = self.scalar(selector).and_then(|scalar| self.of(selector)[0]?.bits(scalar));
        let Some(bits) = known else { return cases };
        let at = |label| cases.iter().position(|case| case.label == label);
        let Some(mut at) = at(Some(bits)).or_else(|| at(None)) else { return Vec::new() };
        while cases[at].falls_through && at + 1 < cases.len() {
            at += 1;
        }
        let taken = cases.swap_remove(at);
        vec![Case { label: None, body: taken.body, falls_through: false }]
    }

    fn bool(&self, condition: Value) -> Option<bool> {
        self.of(condition)[0]?.bits(Scalar::Bool).map(|bits| bits != 0)
    }

    fn forget_stored(&self, block: &Block, memory: &mut Memory) {
        stores(&self.f, block, &mut |place| {
            if let Some(variable) = self.variable(place) {
                memory.remove(&variable);
            }
        });
        if calls(&self.f, block) {
            memory.retain(|variable, _| matches!(variable, Variable::Var(_)));
        }
    }

    fn store(&mut self, place: Value, value: Value, memory: &mut Memory) {
        let Some(variable) = self.variable(place) else { return };
        let (part, facts) = match self.f[place] {
            Op::Var(_) | Op::Global(_) => (Some(None), self.of(value)),
            Op::Part { base, index }
                if matches!(self.f[base], Op::Var(_) | Op::Global(_))
                    && matches!(self.module.types.get(self.f.ty(base)), Type::Vector { .. }) =>
            {
                (Some(Some(index)), self.of(value))
            }
            _ => (None, [None; 4]),
        };
        match (variable, part) {
            (Variable::Var(id), Some(part)) => self.found.store_var(self.index, id, part, facts),
            (Variable::Var(id), None) => self.found.forget_var(self.index, id),
            (Variable::Global(id), Some(part)) => self.found.store_global(id, part, facts),
            (Variable::Global(id), None) => self.found.forget_global(id),
        }
        match part {
            Some(None) => memory.insert(variable, value),
            _ => memory.remove(&variable),
        };
    }

    /// Computes a value, or replaces it.
    fn compute(&mut self, value: Value, memory: &mut Memory, out: &mut Block) {
        let mut op = self.f.replace(value, Op::OpaqueZero);
        op.operands_mut(|operand| *operand = self.mapped(*operand));
        if let Some(other) = self.same(&op, memory) {
            self.f.replace(value, op);
            self.map[value.index()] = other;
            return;
        }
        let facts = self.facts_of(&op, self.f.ty(value), memory);
        if let Op::Fetch { channel, coordinate, .. } = op {
            let facts = self.of(coordinate);
            self.found.fetched(channel, facts);
        }
        if let Op::Call { function, args } = &op {
            for (index, &arg) in args.iter().enumerate() {
                match self.f.is_place(arg).then(|| self.variable(arg)).flatten() {
                    None => {
                        let facts = self.of(arg);
                        self.found.passed(function.index(), index as u32, facts);
                    }
                    Some(variable) => {
                        memory.remove(&variable);
                        match variable {
                            Variable::Var(id) => self.found.forget_var(self.index, id),
                            Variable::Global(id) => self.found.forget_global(id),
                        }
                    }
                }
            }
            memory.retain(|variable, _| matches!(variable, Variable::Var(_)));
        } else if let Some(known) = self.constant(self.f.ty(value), &facts, out) {
            self.f.replace(value, op);
            self.map[value.index()] = known;
            return;
        }
        self.without_zeros(&mut op);
        self.f.replace(value, op);
        self.facts.resize(self.f.len(), None);
        self.facts[value.index()] = Some(facts);
        out.push(Stmt::Let(value));
    }

    /// Returns a value that an operation only passes on.
    fn same(&self, op: &Op, memory: &Memory) -> Option<Value> {
        match *op {
            Op::Load { place } => match self.f[place] {
                Op::Var(id) => memory.get(&Variable::Var(id)).copied(),
                Op::Global(id) => memory.get(&Variable::Global(id)).copied(),
                _ => None,
            },
            Op::Part { base, index } if !self.f.is_place(base) => match &self.f[base] {
                Op::Compose { ty, parts } if parts.len() == self.module.extent(*ty) as usize => {
                    Some(parts[index as usize])
                }
                Op::Splat { value, .. } => Some(*value),
                _ => None,
            },
            Op::Select { condition, accept, reject } => {
                let is_scalar = matches!(self.module.types.get(self.f.ty(condition)), Type::Scalar(_));
                let bit = self.bool(condition).filter(|_| is_scalar)?;
                Some(if bit { accept } else { reject })
            }
            _ => None,
        }
    }

    /// Returns a value whose bits are all known, as literals.
    fn constant(&mut self, ty: TypeId, facts: &Facts, out: &mut Block) -> Option<Value> {
        let (scalar, size) = match self.module.types.get(ty) {
            Type::Scalar(scalar) => (scalar, 1),
            Type::Vector { scalar, size } => (scalar, usize::from(size)),
            _ => return None,
        };
        let mut bits = [0; 4];
        for (bits, fact) in bits.iter_mut().zip(&facts[..size]) {
            *bits = (*fact)?.bits(scalar)?;
        }
        let parts: Vec<Value> = bits[..size].iter().map(|&bits| self.literal(scalar, bits)).collect();
        if let [one] = parts[..] {
            return Some(one);
        }
        let value = self.f.append(Op::Compose { ty, parts: parts.into() }, ty, crate::ir::Origin::default());
        self.facts.resize(self.f.len(), None);
        self.facts[value.index()] = Some(*facts);
        out.push(Stmt::Let(value));
        Some(value)
    }

    fn literal(&mut self, scalar: Scalar, bits: u32) -> Value {
        let f = &mut self.f;
        let new = || f.append(Op::Literal(scalar, bits), TypeId::vector(scalar, 1), crate::ir::Origin::default());
        *self.literals.entry((scalar, bits)).or_insert_with(new)
    }

    /// Replaces operands on which the result does not depend.
    fn without_zeros(&mut self, op: &mut Op) {
        let is_scalar = |value: Value| self.f.ty(value) == TypeId::FLOAT;
        let fact = |value: Value| self.of(value)[0].filter(|_| is_scalar(value));
        // The sign of a zero matters only beside -0.
        let is_sum = |a: Value, b: Value| {
            let (Some(a), Some(b)) = (fact(a), fact(b)) else { return false };
            a.is_zero() && a.minus_zero && !b.minus_zero
        };
        match op {
            Op::Binary { op: Binary::Add | Binary::Subtract, left, right } => {
                let is_right = is_sum(*right, *left);
                if is_right || is_sum(*left, *right) {
                    let zero = self.literal(Scalar::Float, 0);
                    *(if is_right { right } else { left }) = zero;
                }
            }
            // `x * (1 - 0) + y * 0`, or `x + 0 * (y - x)`: the sum of x and a zero of any sign.
            Op::Math { fun: Math::Mix, arg, arg1: Some(other), arg2: Some(share), .. } => {
                let is_first = fact(*share).is_some_and(Number::is_zero)
                    && fact(*arg).is_some_and(|x| !x.minus_zero)
                    && fact(*other).is_some();
                if is_first {
                    *other = self.literal(Scalar::Float, 0);
                }
            }
            _ => {}
        }
    }

    fn facts_of(&self, op: &Op, ty: TypeId, memory: &Memory) -> Facts {
        let (scalar, size) = match self.module.types.get(ty) {
            Type::Scalar(scalar) => (scalar, 1),
            Type::Vector { scalar, size } => (scalar, usize::from(size)),
            _ => return [None; 4],
        };
        let mut all = self.of_type(ty);
        let component = |value: Value, index: usize| {
            let is_vector = matches!(self.module.types.get(self.f.ty(value)), Type::Vector { .. });
            self.of(value)[if is_vector { index } else { 0 }]
        };
        let is_flat = |value: Value| self.scalar(value).is_some() && !self.f.is_place(value);
        for (index, known) in all.iter_mut().enumerate().take(size) {
            let of = |value: Value| component(value, index);
            let computed = match *op {
                Op::Unary { op, operand } if is_flat(operand) => of(operand).and_then(|x| x.unary(op, scalar)),
                Op::Binary { op, left, right } if is_flat(left) && is_flat(right) => {
                    let Some(operands) = self.scalar(left) else { continue };
                    of(left).zip(of(right)).and_then(|(left, right)| left.binary(op, right, operands))
                }
                Op::Math { fun, arg, arg1, arg2, arg3: None }
                    if fun.is_componentwise() && [Some(arg), arg1, arg2].into_iter().flatten().all(is_flat) =>
                {
                    let args: Vec<_> = [Some(arg), arg1, arg2].into_iter().flatten().map(of).collect();
                    Number::function(fun, &args, scalar)
                }
                Op::Select { accept, reject, .. } => of(accept).zip(of(reject)).map(|(a, b)| a.or(b)),
                Op::Convert { value, to } => {
                    let Some(from) = self.scalar(value) else { continue };
                    of(value).and_then(|number| number.converted(from, to))
                }
                Op::Bitcast { value, to } => {
                    let Some(from) = self.scalar(value) else { continue };
                    of(value).and_then(|number| number.bitcast(from, to))
                }
                Op::Splat { value, .. } => self.of(value)[0],
                Op::All(vector) | Op::Any(vector) => self.joined(vector, matches!(op, Op::All(_))),
                Op::Swizzle { vector, swizzle } => self.of(vector)[swizzle.get(index)],
                Op::Part { base, index } if is_flat(base) => self.of(base)[index as usize],
                Op::Compose { ref parts, .. } => self.composed(parts)[index],
                Op::Load { place } => self.loaded(place, memory)[index],
                Op::Call { function, .. } => self.known.result(function.index())[index],
                Op::OpaqueZero => Some(Number::between(0.0, 0.0)),
                _ => continue,
            };
            *known = computed.or(*known);
        }
        all
    }

    /// Returns whether all components of a vector of bools are true, or any.
    fn joined(&self, vector: Value, all: bool) -> Option<Number> {
        let size = self.module.extent(self.f.ty(vector)) as usize;
        let facts = self.of(vector);
        let op = if all { Binary::And } else { Binary::InclusiveOr };
        let mut joined = facts[0]?;
        for fact in &facts[1..size.max(1)] {
            joined = joined.binary(op, (*fact)?, Scalar::Bool)?;
        }
        Some(joined)
    }

    fn composed(&self, parts: &[Value]) -> Facts {
        let mut all = [None; 4];
        let mut at = 0;
        for &part in parts {
            let size = self.module.types.components(self.f.ty(part)).unwrap_or(1) as usize;
            let facts = self.of(part);
            for fact in facts.into_iter().take(size) {
                if let Some(slot) = all.get_mut(at) {
                    *slot = fact;
                }
                at += 1;
            }
        }
        all
    }

    /// Returns what is known of the contents of a place.
    fn loaded(&self, place: Value, memory: &Memory) -> Facts {
        let whole = |place: Value| match self.f[place] {
            Op::Var(id) => match memory.get(&Variable::Var(id)) {
                Some(&value) => self.of(value),
                None => self.known.var(self.index, id),
            },
            Op::Global(id) => match (self.module[id].kind, memory.get(&Variable::Global(id))) {
                (_, Some(&value)) => self.of(value),
                (GlobalKind::Private(_), None) => self.known.global(id),
                (GlobalKind::Uniform(uniform), _) => uniform_facts(uniform),
                (GlobalKind::CustomUniform(slot), _) => match self.assumptions.slots.get(usize::from(slot)) {
                    Some(words) => words.map(|bits| Number::literal(Scalar::Uint, bits)),
                    None => [None; 4],
                },
                _ => [None; 4],
            },
            _ => [None; 4],
        };
        match self.f[place] {
            Op::Part { base, index } => {
                let is_vector = matches!(self.module.types.get(self.f.ty(base)), Type::Vector { .. });
                let facts = whole(base);
                [facts.get(index as usize).copied().flatten().filter(|_| is_vector), None, None, None]
            }
            _ => whole(place),
        }
    }
}

/// Returns what is assumed of Shadertoy's uniforms: see [`Assumptions`].
fn uniform_facts(uniform: Uniform) -> Facts {
    let seconds = Some(Number::between(0.0, super::MAX_SECONDS.into()));
    let side = Some(Number::between(0.0, MAX_SIDE));
    match uniform {
        Uniform::Time | Uniform::TimeDelta | Uniform::FrameRate => [seconds, None, None, None],
        Uniform::Resolution => [side, side, side, None],
        Uniform::Mouse => [Some(Number::signed(-MAX_SIDE, MAX_SIDE)); 4],
        Uniform::Frame => [Number::of_type(Scalar::Int), None, None, None],
        _ => [None; 4],
    }
}

/// Returns whether a block always ends by leaving.
fn ends(block: &Block) -> bool {
    match block.last() {
        Some(Stmt::If { accept, reject, .. }) => (leaves(accept) || ends(accept)) && (leaves(reject) || ends(reject)),
        _ => leaves(block),
    }
}

/// Returns whether a block calls a function.
fn calls(f: &Function, block: &Block) -> bool {
    block.iter().any(|stmt| match stmt {
        Stmt::Let(value) => matches!(f[*value], Op::Call { .. }),
        stmt => stmt.any_block(|block| calls(f, block)),
    })
}
