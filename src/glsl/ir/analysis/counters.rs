//! The stores to the scalar variables of a function, and the loops that count them up or down.

use rustc_hash::FxHashMap;

use crate::{
    ir::{Binary, Block, Function, Op, Stmt, Unary, Value},
    types::{Scalar, TypeId},
};

/// The stores to a variable.
#[derive(Clone, Copy, Debug)]
pub enum Definition {
    /// Not analysed.
    Unknown,
    /// One store, before every read.
    Once,
    /// Such a store, and one that adds a constant to the variable, at most once per iteration of the loop of this
    /// number and after the loop's test.
    Counted { number: usize, ty: TypeId, by: Step },
}

/// The amount added per iteration.
#[derive(Clone, Copy, Debug)]
pub enum Step {
    Int(i64),
    Float { start: f32, by: f32 },
}

pub struct Counters {
    /// By [`VarId::index`](crate::ir::VarId::index).
    pub vars: Vec<Definition>,
    /// The test of each counter's loop: the comparison that is true for another iteration, and the value that the
    /// counter is compared with.
    tests: FxHashMap<usize, (Binary, Value)>,
}

impl Counters {
    pub fn of(f: &Function) -> Counters {
        let vars = f.vars.iter().map(|var| Var { is_unanalysed: var.init.is_some(), ..Var::default() }).collect();
        let mut walk = Walk {
            f,
            vars,
            loads: FxHashMap::default(),
            open: Vec::new(),
            blocks: 0,
            loops: Vec::new(),
            count: 0,
            tests: Vec::new(),
        };
        walk.block(&f.body);
        let mut tests = FxHashMap::default();
        let definitions = (0..f.vars.len()).map(|var| walk.definition(var, &mut tests));
        let vars = definitions.collect();
        Counters { vars, tests }
    }

    pub fn test(&self, var: usize) -> Option<(Binary, Value)> {
        self.tests.get(&var).copied()
    }
}

/// The uses of a variable found so far.
#[derive(Default)]
struct Var {
    /// It is read where it may not have been written yet, or passed to a call, or written more than twice.
    is_unanalysed: bool,
    /// The block of the first store.
    first: Option<usize>,
    /// The stored values, and the loops around each store.
    stores: Vec<(Value, Vec<usize>)>,
}

/// A walk over a body, in the order of execution.
struct Walk<'a> {
    f: &'a Function,
    vars: Vec<Var>,
    /// The variable that each load reads, and the innermost loop around it.
    loads: FxHashMap<Value, (usize, usize)>,
    /// Numbers of the current block and of the enclosing ones.
    open: Vec<usize>,
    blocks: usize,
    /// Numbers of the enclosing loops.
    loops: Vec<usize>,
    count: usize,
    /// Comparisons that are true for another iteration of each loop, by its number.
    tests: Vec<Vec<(Binary, Value, Value)>>,
}

impl Walk<'_> {
    fn block(&mut self, block: &Block) {
        self.blocks += 1;
        self.open.push(self.blocks);
        for stmt in block {
            match stmt {
                Stmt::Let(value) => self.compute(*value),
                Stmt::Store { place, value } => self.store(*place, *value),
                Stmt::Loop { body, continuing, .. } => {
                    self.loops.push(self.count);
                    self.count += 1;
                    self.tests.push(test(self.f, body));
                    self.block(body);
                    self.block(continuing);
                    self.loops.pop();
                }
                _ => stmt.blocks(|block| self.block(block)),
            }
        }
        self.open.pop();
    }

    fn var(&self, place: Value) -> Option<usize> {
        match self.f[self.f.root(place)] {
            Op::Var(var) => Some(var.index()),
            _ => None,
        }
    }

    fn compute(&mut self, value: Value) {
        match self.f[value] {
            Op::Load { place } => {
                let Some(var) = self.var(place) else { return };
                let is_written = self.vars[var].first.is_some_and(|block| self.open.contains(&block));
                self.vars[var].is_unanalysed |= !is_written;
                if let Some(&innermost) = self.loops.last() {
                    self.loads.insert(value, (var, innermost));
                }
            }
            Op::Call { ref args, .. } => {
                for &arg in args.iter().filter(|&&arg| self.f.is_place(arg)) {
                    if let Some(var) = self.var(arg) {
                        self.vars[var].is_unanalysed = true;
                    }
                }
            }
            _ => {}
        }
    }

    fn store(&mut self, place: Value, value: Value) {
        let Some(var) = self.var(place) else { return };
        let block = *self.open.last().expect("a statement is in a block");
        let var = &mut self.vars[var];
        let is_first = var.first.is_none();
        let is_after = var.first.is_some_and(|block| self.open.contains(&block));
        var.is_unanalysed |= var.stores.len() == 2 || !(is_first || is_after) || !matches!(self.f[place], Op::Var(_));
        if !var.is_unanalysed {
            var.first = var.first.or(Some(block));
            var.stores.push((value, self.loops.clone()));
        }
    }

    fn definition(&self, var: usize, tests: &mut FxHashMap<usize, (Binary, Value)>) -> Definition {
        let seen = &self.vars[var];
        match &seen.stores[..] {
            _ if seen.is_unanalysed => Definition::Unknown,
            [_] => Definition::Once,
            [(start, around), (next, loops)] => {
                let counted = || {
                    let number = *loops.last().filter(|number| !around.contains(number))?;
                    let test = self.tests[number].iter().find_map(|test| self.compares(*test, var, number))?;
                    Some((number, self.step(*start, *next, var, number)?, test))
                };
                match counted() {
                    Some((number, by, test)) => {
                        tests.insert(var, test);
                        Definition::Counted { number, ty: self.f.ty(*start), by }
                    }
                    None => Definition::Unknown,
                }
            }
            _ => Definition::Unknown,
        }
    }

    /// Returns whether a value was loaded from a variable in the current iteration of a loop.
    fn is_loaded(&self, value: Value, var: usize, number: usize) -> bool {
        self.loads.get(&value) == Some(&(var, number))
    }

    fn compares(
        &self,
        (op, left, right): (Binary, Value, Value),
        var: usize,
        number: usize,
    ) -> Option<(Binary, Value)> {
        if self.is_loaded(left, var, number) {
            return Some((op, right));
        }
        let mirrored = mirrored(op).filter(|op| *op != Binary::NotEqual)?;
        self.is_loaded(right, var, number).then_some((mirrored, left))
    }

    /// Returns the amount that a store adds to the variable.
    fn step(&self, start: Value, next: Value, var: usize, number: usize) -> Option<Step> {
        let Op::Binary { op, left, right } = self.f[next] else { return None };
        let (by, sign) = match op {
            Binary::Add if self.is_loaded(left, var, number) => (right, 1),
            Binary::Add if self.is_loaded(right, var, number) => (left, 1),
            Binary::Subtract if self.is_loaded(left, var, number) => (right, -1),
            _ => return None,
        };
        match (&self.f[by], &self.f[start]) {
            (Op::Literal(Scalar::Int, bits), _) => Some(Step::Int(sign * i64::from(*bits as i32))),
            (Op::Literal(Scalar::Uint, bits), _) => Some(Step::Int(sign * i64::from(*bits))),
            (Op::Literal(Scalar::Float, by), Op::Literal(Scalar::Float, start)) => {
                Some(Step::Float { start: f32::from_bits(*start), by: sign as f32 * f32::from_bits(*by) })
            }
            _ => None,
        }
    }
}

/// Returns the comparisons that are true where a loop's body continues after the test at its start.
fn test(f: &Function, body: &Block) -> Vec<(Binary, Value, Value)> {
    let first = body.iter().find(|stmt| match stmt {
        Stmt::Let(value) => matches!(f[*value], Op::Call { .. }),
        _ => true,
    });
    let leaves = |block: &Block| matches!(block[..], [Stmt::Break]);
    let mut found = Vec::new();
    match first {
        Some(Stmt::If { condition, accept, reject }) if accept.is_empty() && leaves(reject) => {
            holding(f, *condition, true, &mut found);
        }
        Some(Stmt::If { condition, accept, reject }) if leaves(accept) && reject.is_empty() => {
            holding(f, *condition, false, &mut found);
        }
        _ => {}
    }
    found
}

/// Returns the equivalent comparison with its sides exchanged.
pub(super) fn mirrored(op: Binary) -> Option<Binary> {
    Some(match op {
        Binary::Less => Binary::Greater,
        Binary::Greater => Binary::Less,
        Binary::LessEqual => Binary::GreaterEqual,
        Binary::GreaterEqual => Binary::LessEqual,
        Binary::NotEqual => Binary::NotEqual,
        _ => return None,
    })
}

/// Collects the comparisons that are true where a condition is `truth`.
pub(super) fn holding(f: &Function, condition: Value, truth: bool, out: &mut Vec<(Binary, Value, Value)>) {
    match f[condition] {
        Op::Unary { op: Unary::LogicalNot, operand } => holding(f, operand, !truth, out),
        Op::Binary { op, left, right } if truth => out.push((op, left, right)),
        // For floats both may be false (NaN).
        Op::Binary { op, left, right } if matches!(f.ty(left), TypeId::INT | TypeId::UINT) => {
            let opposite = match op {
                Binary::Less => Binary::GreaterEqual,
                Binary::Greater => Binary::LessEqual,
                Binary::LessEqual => Binary::Greater,
                Binary::GreaterEqual => Binary::Less,
                _ => return,
            };
            out.push((opposite, left, right));
        }
        _ => {}
    }
}
