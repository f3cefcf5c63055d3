//! What the entry point reaches: functions, once for each combination of channels passed to them, and globals.
//!
//! A branch whose condition is a literal counts as not there; [`super::flow`] and [`super::expr`] leave out the same ones. Reads of
//! uniforms and textures are noted while lowering, which visits exactly what is found here.

use std::collections::HashSet;

use super::Instance;
use crate::glsl::{
    ast::List,
    hir::{ExprId, ExprKind, FuncId, GlobalId, LogicalOp, Module, StmtId, StmtKind, Type},
};

/// The reachable part of a module.
pub(super) struct Reach {
    /// Callees before callers; the last is the entry point.
    pub instances: Vec<Instance>,
    /// By [`GlobalId::index`].
    pub globals: Vec<bool>,
}

/// Something passed for a sampler parameter.
#[derive(Clone, Copy)]
enum SamplerArg {
    Channel(u8),
    /// The caller's own sampler parameter, counted among samplers.
    Param(usize),
}

/// What a function body or an initialiser names.
#[derive(Default)]
struct Facts {
    calls: Vec<(FuncId, Vec<SamplerArg>)>,
    globals: Vec<GlobalId>,
}

impl Reach {
    pub fn new(module: &Module) -> Self {
        let entry = module.entry.expect("a program without errors has an entry point");
        let mut globals = vec![false; module.globals.len()];
        let mut facts: Vec<Option<Facts>> = module.functions.iter().map(|_| None).collect();
        let mut found: HashSet<Instance> = HashSet::new();
        let mut pending = vec![Instance { func: entry, channels: Box::default() }];
        found.insert(pending[0].clone());
        while let Some(instance) = pending.pop() {
            let facts = facts[instance.func.index()].get_or_insert_with(|| {
                let body = module[instance.func].body.unwrap_or(List::EMPTY);
                let mut walk = Walk::new(module, Some(instance.func));
                walk.statements(body);
                walk.run()
            });
            let mut call = |func: FuncId, args: &[SamplerArg], channels: &[u8]| {
                let channels = args.iter().map(|&arg| match arg {
                    SamplerArg::Channel(channel) => channel,
                    SamplerArg::Param(index) => channels[index],
                });
                let instance = Instance { func, channels: channels.collect() };
                if found.insert(instance.clone()) {
                    pending.push(instance);
                }
            };
            for (func, args) in &facts.calls {
                call(*func, args, &instance.channels);
            }
            let mut named = facts.globals.clone();
            while let Some(global) = named.pop() {
                if std::mem::replace(&mut globals[global.index()], true) {
                    continue;
                }
                if let (Some(init), None) = (module[global].init, module[global].value) {
                    let mut walk = Walk::new(module, None);
                    walk.pending.push(Node::Expr(init));
                    let facts = walk.run();
                    named.extend(&facts.globals);
                    for (func, args) in &facts.calls {
                        call(*func, args, &[]);
                    }
                }
            }
        }
        let mut order = vec![0; module.functions.len()];
        for (i, func) in module.call_order.iter().enumerate() {
            order[func.index()] = i + 1;
        }
        let mut instances: Vec<_> = found.into_iter().collect();
        // The channels make the order the same in every run.
        instances
            .sort_unstable_by(|a, b| (order[a.func.index()], &a.channels).cmp(&(order[b.func.index()], &b.channels)));
        Self { instances, globals }
    }
}

/// The value of a condition that is a literal.
pub(super) fn known_bool(module: &Module, expr: ExprId) -> Option<bool> {
    match module[expr].kind {
        ExprKind::Literal(bits) => Some(bits != 0),
        _ => None,
    }
}

#[derive(Clone, Copy)]
enum Node {
    Expr(ExprId),
    Stmt(StmtId),
}

/// A walk over a body without recursion.
struct Walk<'a> {
    module: &'a Module,
    func: Option<FuncId>,
    pending: Vec<Node>,
    facts: Facts,
}

impl<'a> Walk<'a> {
    fn new(module: &'a Module, func: Option<FuncId>) -> Self {
        Self { module, func, pending: Vec::new(), facts: Facts::default() }
    }

    fn run(mut self) -> Facts {
        while let Some(node) = self.pending.pop() {
            match node {
                Node::Expr(expr) => self.expr(expr),
                Node::Stmt(stmt) => self.stmt(stmt),
            }
        }
        self.facts.calls.sort_unstable_by_key(|(func, args)| (func.index(), args.len()));
        // Without samplers one call of a function is as good as all.
        self.facts.calls.dedup_by(|a, b| a.0 == b.0 && a.1.is_empty());
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
        match module[expr].kind {
            ExprKind::Error
            | ExprKind::Literal(_)
            | ExprKind::Const(_)
            | ExprKind::Local(_)
            | ExprKind::Uniform(_)
            | ExprKind::Knob(_)
            | ExprKind::Channel(_)
            | ExprKind::BuiltinVar(_) => {}
            ExprKind::Global(global) => self.facts.globals.push(global),
            ExprKind::Member { base: of, .. }
            | ExprKind::Swizzle { base: of, .. }
            | ExprKind::Unary { operand: of, .. }
            | ExprKind::IncDec { place: of, .. }
            | ExprKind::Convert(of)
            | ExprKind::Splat(of)
            | ExprKind::MatrixDiagonal(of)
            | ExprKind::MatrixResize(of) => self.exprs([of]),
            ExprKind::Index { base: a, index: b }
            | ExprKind::Binary { lhs: a, rhs: b, .. }
            | ExprKind::Comma { lhs: a, rhs: b }
            | ExprKind::Assign { place: a, value: b }
            | ExprKind::AssignOp { place: a, value: b, .. } => self.exprs([a, b]),
            ExprKind::Logical { op, lhs, rhs } => {
                self.exprs([lhs]);
                if known_bool(module, lhs) != Some(op == LogicalOp::Or) {
                    self.exprs([rhs]);
                }
            }
            ExprKind::Ternary { cond, then, otherwise } => match known_bool(module, cond) {
                Some(known) => self.exprs([if known { then } else { otherwise }]),
                None => self.exprs([cond, then, otherwise]),
            },
            ExprKind::Vector(args)
            | ExprKind::Matrix(args)
            | ExprKind::Struct(args)
            | ExprKind::Array(args)
            | ExprKind::Builtin { args, .. } => self.exprs(module[args].iter().copied()),
            ExprKind::Call { func, args } => {
                self.exprs(module[args].iter().copied());
                let samplers = module.params(func).iter().zip(&module[args]);
                let samplers = samplers.filter(|(param, _)| matches!(module.types.get(param.ty), Type::Sampler { .. }));
                let samplers = samplers.map(|(_, &arg)| self.sampler(arg)).collect();
                self.facts.calls.push((func, samplers));
            }
        }
    }

    fn sampler(&self, arg: ExprId) -> SamplerArg {
        match self.module[arg].kind {
            ExprKind::Channel(channel) => SamplerArg::Channel(channel),
            ExprKind::Local(local) => {
                let func = self.func.expect("initialisers have no parameters");
                let position = local.index() - self.module[func].locals.start as usize;
                let before = &self.module.params(func)[..position];
                let samplers = before.iter().filter(|p| matches!(self.module.types.get(p.ty), Type::Sampler { .. }));
                SamplerArg::Param(samplers.count())
            }
            other => unreachable!("{other:?} is no sampler"),
        }
    }
}
