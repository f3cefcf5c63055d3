//! A walk that rebuilds a function statement by statement: the common part of most passes.
//!
//! A rule sees each operation with operands already replaced. It may return a replacement for the value; the operations
//! that it adds for that come before.

use rustc_hash::FxHashMap;

use super::{Binary, Block, Function, Module, Op, Origin, Stmt, Value, infer};
use crate::types::{Scalar, Type, TypeId};

/// A rule that a pass applies to the operations and statements of a function.
pub trait Rule {
    /// Returns the value that replaces this one. The operands of its operation are already replaced. `None` keeps the
    /// operation.
    fn operation(&mut self, _: &mut Rewriter<'_>, _value: Value, _op: &Op) -> Option<Value> {
        None
    }

    /// Called at the start of the function.
    fn start(&mut self, _: &mut Rewriter<'_>) {}

    /// Called before a store.
    fn store(&mut self, _: &Rewriter<'_>, _place: Value, _value: Value) {}

    /// Called at the start of a loop's body: statements that it adds come before the body.
    fn start_body(&mut self, _: &mut Rewriter<'_>, _body: &Block) {}

    /// Called at the end of a loop's body; its `continuing` block comes next.
    fn end_body(&mut self) {}

    /// Called where control flow joins after a branch.
    fn after_if(&mut self, _: &Rewriter<'_>) {}
}

/// Applies a rule, created for each function, to the functions of a program.
pub fn each_function<R: Rule>(module: &mut Module, rule: impl Fn() -> R) {
    for index in 0..module.functions.len() {
        function(module, index, &mut rule());
    }
}

/// Applies a rule to one function.
pub fn function(module: &mut Module, index: usize, rule: &mut impl Rule) {
    let function = std::mem::take(&mut module.functions[index]);
    let function = Rewriter::new(module, function).run(rule);
    module.functions[index] = function;
}

/// A function that is being rebuilt.
pub struct Rewriter<'m> {
    pub module: &'m Module,
    pub f: Function,
    out: Block,
    /// Statements that come before all others.
    start: Block,
    /// The replacement of each value of the old function.
    map: Vec<Value>,
    /// Built when a rule first requests a literal; each is a single value.
    literals: Option<FxHashMap<(Scalar, u32), Value>>,
    /// The origin of the current operation: operations added for it have the same.
    origin: Origin,
}

impl<'m> Rewriter<'m> {
    fn new(module: &'m Module, f: Function) -> Self {
        let map = (0..f.len()).map(Value::new).collect();
        Self { module, f, out: Block::new(), start: Block::new(), map, literals: None, origin: Origin::default() }
    }

    fn run(mut self, rule: &mut impl Rule) -> Function {
        let body = std::mem::take(&mut self.f.body);
        rule.start(&mut self);
        self.block(body, rule);
        for var in 0..self.f.vars.len() {
            self.f.vars[var].init = self.f.vars[var].init.map(|init| self.map[init.index()]);
        }
        self.f.body = std::mem::take(&mut self.start);
        self.f.body.append(&mut self.out);
        self.f
    }

    /// Adds an operation, computed here.
    pub fn add(&mut self, op: Op) -> Value {
        let ty = infer::ty(self.module, &self.f, &op);
        self.add_typed(op, ty)
    }

    pub fn add_typed(&mut self, op: Op, ty: TypeId) -> Value {
        let value = self.f.append(op, ty, self.origin);
        self.out.push(Stmt::Let(value));
        value
    }

    /// Adds a statement here.
    pub fn push(&mut self, stmt: Stmt) {
        self.out.push(stmt);
    }

    /// Makes `add` insert its operations at the start of the function.
    pub fn at_start<T>(&mut self, add: impl FnOnce(&mut Self) -> T) -> T {
        std::mem::swap(&mut self.out, &mut self.start);
        let added = add(self);
        std::mem::swap(&mut self.out, &mut self.start);
        added
    }

    /// Adds the same bits, of a scalar or vector of numbers, combined with a zero that is unknown to every later
    /// compiler.
    pub fn opaque(&mut self, value: Value) -> Value {
        let scalar = self.module.scalar(self.f.ty(value));
        let bits = if scalar == Scalar::Int { value } else { self.add(Op::Bitcast { value, to: Scalar::Int }) };
        let mut zero = self.add(Op::OpaqueZero);
        if let Type::Vector { size, .. } = self.module.types.get(self.f.ty(value)) {
            zero = self.add(Op::Splat { size, value: zero });
        }
        let value = self.add(Op::Binary { op: Binary::InclusiveOr, left: bits, right: zero });
        if scalar == Scalar::Int { value } else { self.add(Op::Bitcast { value, to: scalar }) }
    }

    /// Adds a jump that is never taken, which no later compiler can know.
    pub fn push_untaken_jump(&mut self, jump: Stmt) {
        let number = self.add(Op::OpaqueZero);
        let zero = self.literal(Scalar::Int, 0);
        let condition = self.add(Op::Binary { op: Binary::NotEqual, left: number, right: zero });
        self.push(Stmt::If { condition, accept: vec![jump], reject: Block::new() });
    }

    /// Returns a scalar constant, the same value each time.
    pub fn literal(&mut self, scalar: Scalar, bits: u32) -> Value {
        let literal = |(value, op): (Value, &Op)| match *op {
            Op::Literal(scalar, bits) => Some(((scalar, bits), value)),
            _ => None,
        };
        let literals = self.literals.get_or_insert_with(|| self.f.values().filter_map(literal).collect());
        let (f, origin) = (&mut self.f, self.origin);
        let new = || f.append(Op::Literal(scalar, bits), TypeId::vector(scalar, 1), origin);
        *literals.entry((scalar, bits)).or_insert_with(new)
    }

    /// Returns the current replacement of a value of the old function.
    pub fn value(&self, old: Value) -> Value {
        // Values that were added are not replaced.
        self.map.get(old.index()).copied().unwrap_or(old)
    }

    fn nested(&mut self, block: Block, rule: &mut impl Rule) -> Block {
        let outer = std::mem::take(&mut self.out);
        self.block(block, rule);
        std::mem::replace(&mut self.out, outer)
    }

    fn block(&mut self, block: Block, rule: &mut impl Rule) {
        self.out.reserve(block.len());
        for mut stmt in block {
            if let Stmt::Let(value) = stmt {
                // Taken out, so that the rule can read it while it changes the function.
                let mut op = self.f.replace(value, Op::OpaqueZero);
                op.operands_mut(|operand| *operand = self.value(*operand));
                self.origin = self.f.origin(value);
                let other = rule.operation(self, value, &op);
                self.f.replace(value, op);
                match other {
                    Some(other) => self.map[value.index()] = other,
                    None => self.out.push(stmt),
                }
                continue;
            }
            // The exit condition of a loop is computed inside it.
            if !matches!(stmt, Stmt::Loop { .. }) {
                stmt.operands_mut(|operand| *operand = self.value(*operand));
            }
            match &mut stmt {
                Stmt::Store { place, value } => rule.store(self, *place, *value),
                Stmt::If { accept, reject, .. } => {
                    for block in [accept, reject] {
                        *block = self.nested(std::mem::take(block), rule);
                    }
                    rule.after_if(self);
                }
                Stmt::Switch { cases, .. } => {
                    for case in cases {
                        case.body = self.nested(std::mem::take(&mut case.body), rule);
                    }
                }
                Stmt::Loop { body, continuing, break_if } => {
                    let old = std::mem::take(body);
                    let outer = std::mem::take(&mut self.out);
                    rule.start_body(self, &old);
                    self.block(old, rule);
                    *body = std::mem::replace(&mut self.out, outer);
                    rule.end_body();
                    *continuing = self.nested(std::mem::take(continuing), rule);
                    *break_if = break_if.map(|value| self.value(value));
                }
                _ => {}
            }
            self.out.push(stmt);
        }
    }
}
