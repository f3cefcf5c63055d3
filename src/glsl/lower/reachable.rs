//! The part of a program that is reachable from the entry point: functions, once for each combination of channels and
//! tables passed to them, and globals.
//!
//! A branch that a literal condition excludes is unreachable; [`super::flow`] and [`super::expr`] skip the same ones.
//! Reads of uniforms and textures are recorded during lowering, which visits exactly the code found here.

use rustc_hash::FxHashSet;

use super::{
    arguments::{Arguments, Instance, Specialization, SpecializedArgument},
    walk::{self as writes, Node},
};
use crate::{
    ast::List,
    hir::{ExprId, ExprKind, FuncId, GlobalId, LogicalOp, Module, StmtId, StmtKind},
};

/// The reachable part of a module.
pub(super) struct Reachable {
    /// Callees before callers; the last is the entry point.
    pub instances: Vec<Instance>,
    /// By [`GlobalId::index`].
    pub globals: Vec<bool>,
}

/// The calls in a body, with their arguments for specializable parameters.
type Calls = Vec<(FuncId, Vec<SpecializedArgument>)>;

/// The names in a function body or an initialiser.
#[derive(Default)]
struct Facts {
    calls: Vec<(FuncId, List<ExprId>)>,
    globals: Vec<GlobalId>,
    /// Globals that are written, in whole or in part.
    writes: FxHashSet<GlobalId>,
    /// The number of expressions and statements.
    nodes: usize,
}

impl Reachable {
    /// Finds the reachable part; a constant of at least `table` scalars can replace a parameter even if only one call
    /// passes it.
    pub(super) fn new(module: &Module, table: usize) -> (Self, Arguments) {
        let entry = module.entry.expect("a program without errors has an entry point");
        let mut facts: Vec<Facts> = module.functions.iter().map(|_| Facts::default()).collect();
        for &func in &module.call_order {
            let mut walk = Walk::new(module);
            walk.statements(module[func].body.unwrap_or(List::EMPTY));
            facts[func.index()] = walk.run();
        }
        let writes = facts.iter_mut().map(|facts| std::mem::take(&mut facts.writes)).collect();
        let arguments = Arguments::new(module, writes, table);
        let passed = |caller: Option<FuncId>, calls: &[(FuncId, List<ExprId>)]| {
            let passed =
                |&(func, args): &(FuncId, List<ExprId>)| (func, arguments.passed(module, caller, func, &module[args]));
            let mut passed: Calls = calls.iter().map(passed).collect();
            passed.sort_unstable_by_key(|(func, passed)| (func.index(), passed.len()));
            // Without specializations one call of a function is enough.
            passed.dedup_by(|a, b| a.0 == b.0 && a.1.is_empty());
            passed
        };

        let mut globals = vec![false; module.globals.len()];
        let mut calls: Vec<Option<Calls>> = module.functions.iter().map(|_| None).collect();
        let mut found: FxHashSet<Instance> = FxHashSet::default();
        let mut pending = vec![Instance { func: entry, specializations: Box::default() }];
        found.insert(pending[0].clone());
        while let Some(instance) = pending.pop() {
            let facts = &facts[instance.func.index()];
            let mut call = |func: FuncId, passed: &[SpecializedArgument], of_caller: &[Specialization]| {
                let specializations = passed.iter().map(|&passed| match passed {
                    SpecializedArgument::Known(specialization) => specialization,
                    SpecializedArgument::Param(index) => of_caller[index],
                });
                let instance = Instance { func, specializations: specializations.collect() };
                if found.insert(instance.clone()) {
                    pending.push(instance);
                }
            };
            let calls = calls[instance.func.index()].get_or_insert_with(|| passed(Some(instance.func), &facts.calls));
            for (func, passed) in calls {
                call(*func, passed, &instance.specializations);
            }
            let mut named = facts.globals.clone();
            while let Some(global) = named.pop() {
                if std::mem::replace(&mut globals[global.index()], true) {
                    continue;
                }
                if let (Some(init), None) = (module[global].init, module[global].value) {
                    let mut walk = Walk::new(module);
                    walk.pending.push(Node::Expr(init));
                    let facts = walk.run();
                    named.extend(&facts.globals);
                    for (func, passed) in passed(None, &facts.calls) {
                        call(func, &passed, &[]);
                    }
                }
            }
        }
        let mut order = vec![0; module.functions.len()];
        for (i, func) in module.call_order.iter().enumerate() {
            order[func.index()] = i + 1;
        }
        let mut instances: Vec<_> = found.into_iter().collect();
        // Sorted by specializations too, so that the order is deterministic.
        instances.sort_unstable_by(|a, b| {
            (order[a.func.index()], &a.specializations).cmp(&(order[b.func.index()], &b.specializations))
        });
        (Self { instances, globals }, arguments)
    }
}

/// Returns the number of reachable expressions and statements of a body, and the functions that they call, once for
/// each call.
pub(crate) fn reached(module: &Module, body: List<StmtId>) -> (usize, Vec<FuncId>) {
    let mut walk = Walk::new(module);
    walk.statements(body);
    let facts = walk.run();
    (facts.nodes, facts.calls.into_iter().map(|(func, _)| func).collect())
}

/// Returns the value of a condition that is a literal.
pub(super) fn known_bool(module: &Module, expr: ExprId) -> Option<bool> {
    match module[expr].kind {
        ExprKind::Literal(bits) => Some(bits != 0),
        _ => None,
    }
}

/// A walk over a body without recursion.
struct Walk<'a> {
    module: &'a Module,
    pending: Vec<Node>,
    /// A reusable buffer for the operands of an expression; empty between uses.
    within: Vec<ExprId>,
    facts: Facts,
}

impl<'a> Walk<'a> {
    fn new(module: &'a Module) -> Self {
        Self { module, pending: Vec::new(), within: Vec::new(), facts: Facts::default() }
    }

    fn run(mut self) -> Facts {
        while let Some(node) = self.pending.pop() {
            self.facts.nodes += 1;
            match node {
                Node::Expr(expr) => self.expr(expr),
                Node::Stmt(stmt) => self.stmt(stmt),
            }
        }
        self.facts
    }

    fn statements(&mut self, list: List<StmtId>) {
        self.pending.extend(self.module[list].iter().map(|&stmt| Node::Stmt(stmt)));
    }

    fn exprs(&mut self, exprs: impl IntoIterator<Item = ExprId>) {
        self.pending.extend(exprs.into_iter().map(Node::Expr));
    }

    fn stmt(&mut self, stmt: StmtId) {
        match self.module[stmt].kind {
            StmtKind::Block(list) => self.statements(list),
            StmtKind::Expr(expr) => self.exprs([expr]),
            StmtKind::Declare { init, .. } => self.exprs(init),
            StmtKind::If { cond, then, otherwise } => match known_bool(self.module, cond) {
                Some(known) => self.statements(if known { then } else { otherwise }),
                None => {
                    self.exprs([cond]);
                    self.statements(then);
                    self.statements(otherwise);
                }
            },
            StmtKind::For { init, test, step, body } => {
                self.statements(init);
                if test.and_then(|test| known_bool(self.module, test)) != Some(false) {
                    self.exprs(test.into_iter().chain(step));
                    self.statements(body);
                }
            }
            StmtKind::DoWhile { body, test } => {
                self.statements(body);
                self.exprs([test]);
            }
            StmtKind::Switch { value, cases } => {
                self.exprs([value]);
                for case in &self.module[cases] {
                    self.statements(case.body);
                }
            }
            StmtKind::Return(value) => self.exprs(value),
            StmtKind::Break | StmtKind::Continue | StmtKind::Discard => {}
        }
    }

    fn expr(&mut self, expr: ExprId) {
        let module = self.module;
        writes::places(module, expr, |place| {
            if let ExprKind::Global(global) = module[module.root(place)].kind {
                self.facts.writes.insert(global);
            }
        });
        match module[expr].kind {
            ExprKind::Global(global) => self.facts.globals.push(global),
            ExprKind::Logical { op, lhs, .. } if known_bool(module, lhs) == Some(op == LogicalOp::Or) => {
                return self.exprs([lhs]);
            }
            ExprKind::Ternary { cond, then, otherwise } => {
                if let Some(known) = known_bool(module, cond) {
                    return self.exprs([if known { then } else { otherwise }]);
                }
            }
            ExprKind::Call { func, args } => self.facts.calls.push((func, args)),
            _ => {}
        }
        let mut within = std::mem::take(&mut self.within);
        module.parts(expr, &mut within);
        self.exprs(within.drain(..));
        self.within = within;
    }
}
