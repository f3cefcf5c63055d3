//! Loop unrolling: unrolls a short loop whose counter limits an inner loop over an array.
//!
//! A driver knows the number of iterations of the inner loop of de Casteljau's algorithm, `for (int n = 4; n > 0; n--)
//! for (int i = 0; i < n - 1; i++) p[i] = mix(p[i], p[i + 1], t);`, only when the outer one is unrolled. Then it
//! unrolls the inner one as well, and the elements become registers; otherwise the array stays in memory, to which
//! llvmpipe stores pixel by pixel. Mesa's GLSL compiler unrolls such loops (`loop_unroll.cpp`), but not if it gets
//! SPIR-V. Other loops are left to the driver.

use rustc_hash::FxHashMap;

use crate::{
    ast::Loc,
    ir::{Binary, Block, Function, Module, Op, Stmt, Unary, Value, VarId, analysis::stores},
    types::{Scalar, Type, TypeId},
};

/// The maximum number of iterations that are unrolled.
const MAX_ITERATIONS: usize = 8;

/// The maximum number of statements of an unrolled loop.
const MAX_STATEMENTS: usize = 512;

pub(super) fn run(module: &mut Module) {
    for index in 0..module.functions.len() {
        let f = &module.functions[index];
        let is_array = |place: Value| {
            matches!(f[f.root(place)], Op::Var(_)) && matches!(module.types.get(f.ty(place)), Type::Array { .. })
        };
        // Places in arrays of the function.
        let elements: Vec<Value> = f
            .values()
            .filter(|(_, op)| matches!(**op, Op::Element { base, .. } if is_array(base)))
            .map(|(value, _)| value)
            .collect();
        if elements.is_empty() {
            continue;
        }
        let f = &mut module.functions[index];
        let body = std::mem::take(&mut f.body);
        let mut unroller = Unroller { f, elements };
        let body = unroller.block(body);
        f.body = body;
    }
}

struct Unroller<'a> {
    f: &'a mut Function,
    /// In ascending order.
    elements: Vec<Value>,
}

/// A loop to unroll.
struct Plan {
    counter: VarId,
    start: i32,
    by: i32,
    iterations: usize,
    /// The index of its test in the body.
    test: usize,
}

impl Unroller<'_> {
    fn block(&mut self, block: Block) -> Block {
        let mut out = Block::with_capacity(block.len());
        // The known values of variables here.
        let mut known: FxHashMap<VarId, i32> = FxHashMap::default();
        for mut stmt in block {
            let plan = self.plan(&stmt, &known);
            forget(self.f, &stmt, &mut known);
            match (stmt, plan) {
                (Stmt::Loop { body, continuing, .. }, Some(plan)) => {
                    self.write_out(&plan, &body, &continuing, &mut out);
                    continue;
                }
                (other, _) => stmt = other,
            }
            if let Stmt::Store { place, value } = stmt
                && let (Op::Var(var), Some(number)) = (&self.f[place], self.number(value))
            {
                known.insert(*var, number);
            }
            stmt.blocks_mut(|inner| *inner = self.block(std::mem::take(inner)));
            out.push(stmt);
        }
        out
    }

    fn number(&self, value: Value) -> Option<i32> {
        match self.f[value] {
            Op::Literal(Scalar::Int, bits) => Some(bits as i32),
            Op::Zero(TypeId::INT) => Some(0),
            _ => None,
        }
    }

    fn loads(&self, value: Value) -> Option<VarId> {
        let Op::Load { place } = self.f[value] else { return None };
        match self.f[place] {
            Op::Var(var) => Some(var),
            _ => None,
        }
    }

    fn plan(&self, stmt: &Stmt, known: &FxHashMap<VarId, i32>) -> Option<Plan> {
        let Stmt::Loop { body, continuing, break_if: None } = stmt else { return None };
        let test = body.iter().position(|stmt| !matches!(stmt, Stmt::Let(_)))?;
        let Stmt::If { condition, accept, reject } = &body[test] else { return None };
        let mut goes_on_if = match (&accept[..], &reject[..]) {
            ([], [Stmt::Break]) => true,
            ([Stmt::Break], []) => false,
            _ => return None,
        };
        let mut condition = *condition;
        while let Op::Unary { op: Unary::LogicalNot, operand } = self.f[condition] {
            (condition, goes_on_if) = (operand, !goes_on_if);
        }
        let Op::Binary { op, left, right } = self.f[condition] else { return None };
        let (counter, bound) = (self.loads(left)?, self.number(right)?);
        let start = *known.get(&counter)?;
        let rest = &body[test + 1..];
        if rest.iter().any(leaves_iteration) || !self.bounds_inner_loop(rest, counter) {
            return None;
        }
        let by = self.step(counter, rest, continuing)?;
        let (mut iterations, mut count) = (0, start);
        while compare(op, count, bound)? == goes_on_if {
            iterations += 1;
            count = count.checked_add(by)?;
            if iterations > MAX_ITERATIONS {
                return None;
            }
        }
        let statements = size(body) + size(continuing);
        (statements * iterations <= MAX_STATEMENTS).then_some(Plan { counter, start, by, iterations, test })
    }

    /// Returns the increment of a counter per iteration, if nothing else is written to it.
    fn step(&self, counter: VarId, body: &[Stmt], continuing: &Block) -> Option<i32> {
        let steps: Vec<Value> = body.iter().chain(continuing).filter_map(|stmt| self.stores(stmt, counter)).collect();
        let mut written = FxHashMap::from_iter([(counter, 0)]);
        let others = body.iter().chain(continuing).filter(|stmt| self.stores(stmt, counter).is_none());
        others.for_each(|stmt| forget(self.f, stmt, &mut written));
        let (&[step], false) = (&steps[..], written.is_empty()) else { return None };
        match self.f[step] {
            Op::Binary { op: Binary::Add, left, right } if self.loads(left) == Some(counter) => self.number(right),
            Op::Binary { op: Binary::Add, left, right } if self.loads(right) == Some(counter) => self.number(left),
            Op::Binary { op: Binary::Subtract, left, right } if self.loads(left) == Some(counter) => {
                self.number(right)?.checked_neg()
            }
            _ => None,
        }
    }

    /// Returns the value that a statement stores to a variable as a whole.
    fn stores(&self, stmt: &Stmt, var: VarId) -> Option<Value> {
        match *stmt {
            Stmt::Store { place, value } if matches!(self.f[place], Op::Var(id) if id == var) => Some(value),
            _ => None,
        }
    }

    /// Returns whether an inner loop is limited by the counter and iterates over an array.
    fn bounds_inner_loop(&self, block: &[Stmt], counter: VarId) -> bool {
        block.iter().any(|stmt| {
            if let Stmt::Loop { body, .. } = stmt {
                let before_test = body.iter().map_while(|stmt| match stmt {
                    Stmt::Let(value) => Some(*value),
                    _ => None,
                });
                if before_test.into_iter().any(|value| self.loads(value) == Some(counter)) && self.has_element(body) {
                    return true;
                }
            }
            stmt.any_block(|block| self.bounds_inner_loop(block, counter))
        })
    }

    fn has_element(&self, block: &[Stmt]) -> bool {
        block.iter().any(|stmt| match stmt {
            Stmt::Let(value) => self.elements.binary_search(value).is_ok(),
            other => other.any_block(|block| self.has_element(block)),
        })
    }

    fn write_out(&mut self, plan: &Plan, body: &Block, continuing: &Block, out: &mut Block) {
        let mut count = self.literal(plan.start);
        let mut next = plan.start;
        for _ in 0..plan.iterations {
            let mut copy = Copy { counter: plan.counter, count, map: FxHashMap::default() };
            let statements = body.iter().enumerate().filter(|(at, _)| *at != plan.test).map(|(_, stmt)| stmt);
            for stmt in statements.chain(continuing) {
                if self.stores(stmt, plan.counter).is_some() {
                    next = next.wrapping_add(plan.by);
                    copy.count = self.literal(next);
                } else if let Some(stmt) = self.copy(&mut copy, stmt) {
                    out.push(stmt);
                }
            }
            count = copy.count;
        }
        let place = self.f.append(Op::Var(plan.counter), TypeId::INT, Loc::default());
        out.push(Stmt::Store { place, value: count });
    }

    fn literal(&mut self, number: i32) -> Value {
        self.f.append(Op::Literal(Scalar::Int, number as u32), TypeId::INT, Loc::default())
    }

    fn copies(&mut self, copy: &mut Copy, block: &Block) -> Block {
        block.iter().filter_map(|stmt| self.copy(copy, stmt)).collect()
    }

    /// Returns a copy of a statement with new values. A load of the counter needs no statement.
    fn copy(&mut self, copy: &mut Copy, stmt: &Stmt) -> Option<Stmt> {
        if let Stmt::Let(value) = *stmt {
            if self.loads(value) == Some(copy.counter) {
                copy.map.insert(value, copy.count);
                return None;
            }
            let mut op = self.f[value].clone();
            op.operands_mut(|operand| *operand = copy.value(*operand));
            let new = self.f.append(op, self.f.ty(value), self.f.origin(value));
            if self.elements.binary_search(&value).is_ok() {
                self.elements.push(new);
            }
            copy.map.insert(value, new);
            return Some(Stmt::Let(new));
        }
        // The exit condition of a loop is computed inside it.
        let mut stmt = stmt.with_blocks(|block| self.copies(copy, block));
        stmt.operands_mut(|operand| *operand = copy.value(*operand));
        Some(stmt)
    }
}

/// An iteration that is being copied.
struct Copy {
    counter: VarId,
    /// The value of the counter.
    count: Value,
    /// The copy of each value that the loop computes.
    map: FxHashMap<Value, Value>,
}

impl Copy {
    fn value(&self, old: Value) -> Value {
        self.map.get(&old).copied().unwrap_or(old)
    }
}

fn compare(op: Binary, left: i32, right: i32) -> Option<bool> {
    Some(match op {
        Binary::Less => left < right,
        Binary::LessEqual => left <= right,
        Binary::Greater => left > right,
        Binary::GreaterEqual => left >= right,
        Binary::Equal => left == right,
        Binary::NotEqual => left != right,
        _ => return None,
    })
}

/// Returns whether a statement may end an iteration of the enclosing loop.
fn leaves_iteration(stmt: &Stmt) -> bool {
    match stmt {
        Stmt::Break | Stmt::Continue => true,
        Stmt::Loop { .. } => false,
        // A `Break` in a switch leaves only that; none of these loops contains one.
        other => other.any_block(|block| block.iter().any(leaves_iteration)),
    }
}

fn size(block: &Block) -> usize {
    let mut sum = block.len();
    block.iter().for_each(|stmt| stmt.blocks(|block| sum += size(block)));
    sum
}

/// Removes the variables that a statement may write.
fn forget(f: &Function, stmt: &Stmt, known: &mut FxHashMap<VarId, i32>) {
    stores(f, std::slice::from_ref(stmt), &mut |place| {
        if let Op::Var(var) = f[f.root(place)] {
            known.remove(&var);
        }
    });
}
