//! A walk over a function that computes it anew, statement by statement: what most passes have in common.
//!
//! Operands are seen as what stands for them by now. A rule says what stands for an operation; what it adds for that comes before.

use rustc_hash::FxHashMap;

use crate::glsl::{
    ast::Loc,
    ir::{Block, Function, Module, Op, Stmt, Value, infer},
    types::{Scalar, TypeId},
};

/// What a pass does to the operations and statements of a function.
pub(super) trait Rule {
    /// Says what stands for a value, whose operation has the operands that stand for its own. `None`: the operation itself.
    fn operation(&mut self, r: &mut Rewriter<'_>, value: Value, op: &Op) -> Option<Value>;

    /// A store is about to be made.
    fn store(&mut self, _: &mut Rewriter<'_>, _place: Value, _value: Value) {}

    /// A block begins: a branch, a case or the body of a loop.
    fn enter(&mut self) {}

    /// It ends.
    fn leave(&mut self, _: &Rewriter<'_>) {}

    /// A loop of these blocks is about to begin.
    fn enter_loop(&mut self, _: &Rewriter<'_>, _body: &Block, _continuing: &Block) {}

    /// Control meets again, after a branch, a switch or a loop.
    fn join(&mut self, _: &Rewriter<'_>) {}
}

/// Applies a rule to each function of a program.
pub(super) fn each_function<R: Rule>(module: &mut Module, mut rule: impl FnMut(&Module, &Function) -> R) {
    let mut functions = std::mem::take(&mut module.functions);
    for index in 0..functions.len() {
        let function = std::mem::take(&mut functions[index]);
        // Results of callees are asked for.
        std::mem::swap(&mut module.functions, &mut functions);
        let mut rule = rule(module, &function);
        let function = Rewriter::new(module, function).run(&mut rule);
        std::mem::swap(&mut module.functions, &mut functions);
        functions[index] = function;
    }
    module.functions = functions;
}

/// A function that is being computed anew.
pub(super) struct Rewriter<'m> {
    pub module: &'m Module,
    pub f: Function,
    out: Block,
    /// What stands for each value of the old function.
    map: Vec<Value>,
    /// Made when a rule asks for one; each is one value already.
    literals: Option<FxHashMap<(Scalar, u32), Value>>,
    /// Of the operation at hand.
    loc: Loc,
}

impl<'m> Rewriter<'m> {
    fn new(module: &'m Module, f: Function) -> Self {
        let map = (0..f.len()).map(Value::new).collect();
        Self { module, f, out: Block::new(), map, literals: None, loc: Loc::default() }
    }

    fn run(mut self, rule: &mut impl Rule) -> Function {
        let body = std::mem::take(&mut self.f.body);
        self.block(body, rule);
        for var in 0..self.f.vars.len() {
            self.f.vars[var].init = self.f.vars[var].init.map(|init| self.map[init.index()]);
        }
        self.f.body = std::mem::take(&mut self.out);
        self.f
    }

    /// An operation, computed here.
    pub fn add(&mut self, op: Op) -> Value {
        let ty = infer::ty(self.module, &self.f, &op);
        self.add_typed(op, ty)
    }

    pub fn add_typed(&mut self, op: Op, ty: TypeId) -> Value {
        let value = self.f.append(op, ty, self.loc);
        self.out.push(Stmt::Let(value));
        value
    }

    /// A scalar constant, the same value each time.
    pub fn literal(&mut self, scalar: Scalar, bits: u32) -> Value {
        let literal = |(value, op): (Value, &Op)| match *op {
            Op::Literal(scalar, bits) => Some(((scalar, bits), value)),
            _ => None,
        };
        let literals = self.literals.get_or_insert_with(|| self.f.values().filter_map(literal).collect());
        let (f, loc) = (&mut self.f, self.loc);
        let new = || f.append(Op::Literal(scalar, bits), TypeId::vector(scalar, 1), loc);
        *literals.entry((scalar, bits)).or_insert_with(new)
    }

    pub fn float(&mut self, number: f32) -> Value {
        self.literal(Scalar::Float, number.to_bits())
    }

    /// The number that a value is, if it is a literal float.
    pub fn number(&self, value: Value) -> Option<f32> {
        number(&self.f, value)
    }

    fn value(&self, old: Value) -> Value {
        // What was added has no other stand-in.
        self.map.get(old.index()).copied().unwrap_or(old)
    }

    fn nested(&mut self, block: Block, rule: &mut impl Rule) -> Block {
        let outer = std::mem::take(&mut self.out);
        rule.enter();
        self.block(block, rule);
        rule.leave(self);
        std::mem::replace(&mut self.out, outer)
    }

    fn block(&mut self, block: Block, rule: &mut impl Rule) {
        self.out.reserve(block.len());
        for stmt in block {
            let stmt = match stmt {
                Stmt::Let(value) => {
                    // Taken out, so that the rule sees it while it changes the function.
                    let mut op = self.f.replace(value, Op::OpaqueZero);
                    op.operands_mut(|operand| *operand = self.value(*operand));
                    self.loc = self.f.loc(value);
                    let other = rule.operation(self, value, &op);
                    self.f.replace(value, op);
                    match other {
                        Some(other) => self.map[value.index()] = other,
                        None => self.out.push(Stmt::Let(value)),
                    }
                    continue;
                }
                Stmt::Store { place, value } => {
                    let (place, value) = (self.value(place), self.value(value));
                    rule.store(self, place, value);
                    Stmt::Store { place, value }
                }
                Stmt::If { condition, accept, reject } => {
                    let condition = self.value(condition);
                    let (accept, reject) = (self.nested(accept, rule), self.nested(reject, rule));
                    rule.join(self);
                    Stmt::If { condition, accept, reject }
                }
                Stmt::Switch { selector, mut cases } => {
                    let selector = self.value(selector);
                    for case in &mut cases {
                        case.body = self.nested(std::mem::take(&mut case.body), rule);
                    }
                    rule.join(self);
                    Stmt::Switch { selector, cases }
                }
                Stmt::Loop { body, continuing, break_if } => {
                    rule.enter_loop(self, &body, &continuing);
                    let body = self.nested(body, rule);
                    let continuing = self.nested(continuing, rule);
                    let break_if = break_if.map(|value| self.value(value));
                    rule.join(self);
                    Stmt::Loop { body, continuing, break_if }
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

/// The number that a value is, if it is a literal float.
pub(super) fn number(f: &Function, value: Value) -> Option<f32> {
    match f[value] {
        Op::Literal(Scalar::Float, bits) => Some(f32::from_bits(bits)),
        _ => None,
    }
}
