//! The values that an expression may have: its numbers, followed through names and parameters.

use crate::ast::{
    Ast, BinaryOp, Condition, DeclId, DeclKind, Declarator, ExprId, ExprKind, FunctionDecl, List, StmtId, StmtKind,
    Symbol, TypeSpecKind, UnaryOp,
};
use std::collections::{HashMap, HashSet};

/// A function by its place in [`Ast::functions`]; `None` is outside of all.
pub(super) type Scope = Option<usize>;

/// The definitions of a program by name.
pub(super) struct Flow<'a> {
    ast: &'a Ast,
    /// Initialisers and assigned values of variables.
    values: HashMap<(Scope, Symbol), Vec<ExprId>>,
    /// The function and place of each parameter.
    params: HashMap<(Scope, Symbol), (Symbol, usize)>,
    /// The arguments of each call of a function, and where it is called.
    calls: HashMap<Symbol, Vec<(Scope, List<ExprId>)>>,
}

/// A number or name that a value comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Leaf {
    /// `is_whole`: the expression is this number, directly or by names alone.
    Number { expr: ExprId, grows: bool, is_whole: bool },
    /// A name that no text declares: a uniform.
    Name { name: Symbol, expr: ExprId, grows: bool },
}

/// Calls `visit` with each statement of a function's body, the outer one first.
pub(super) fn statements(ast: &Ast, body: StmtId, visit: &mut dyn FnMut(StmtId)) {
    let mut stack = vec![body];
    while let Some(stmt) = stack.pop() {
        visit(stmt);
        match ast[stmt].kind {
            StmtKind::Block(list) | StmtKind::Switch { body: list, .. } => stack.extend(ast[list].iter().rev()),
            StmtKind::If { then, otherwise, .. } => stack.extend(otherwise.into_iter().chain([then])),
            StmtKind::For { init, body, .. } => stack.extend([body, init]),
            StmtKind::While { body, .. } | StmtKind::DoWhile { body, .. } => stack.push(body),
            _ => {}
        }
    }
}

/// Calls `visit` with each expression in an expression, in no particular order.
pub(super) fn expressions(ast: &Ast, root: ExprId, visit: &mut dyn FnMut(ExprId)) {
    let mut stack = vec![root];
    while let Some(expr) = stack.pop() {
        visit(expr);
        ast.parts(expr, |part| stack.push(part));
    }
}

/// Calls `visit` with the expressions of a statement itself, without those of statements in it.
pub(super) fn own_expressions(ast: &Ast, stmt: StmtId, visit: &mut dyn FnMut(ExprId)) {
    match ast[stmt].kind {
        StmtKind::Expr(expr) | StmtKind::Return(Some(expr)) | StmtKind::Case(expr) => visit(expr),
        StmtKind::Decl(decl) => declarators(ast, decl).iter().filter_map(|one| one.init).for_each(visit),
        StmtKind::If { cond, .. } | StmtKind::DoWhile { cond, .. } => visit(cond),
        StmtKind::Switch { value, .. } => visit(value),
        StmtKind::For { cond, step, .. } => {
            condition(ast, cond).into_iter().chain(step).for_each(visit);
        }
        StmtKind::While { cond, .. } => condition(ast, Some(cond)).into_iter().for_each(visit),
        _ => {}
    }
}

/// Returns the expression of a condition.
pub(super) fn condition(ast: &Ast, cond: Option<Condition>) -> Option<ExprId> {
    match cond? {
        Condition::Expr(expr) => Some(expr),
        Condition::Decl(decl) => declarators(ast, decl).first()?.init,
    }
}

pub(super) fn declarators(ast: &Ast, decl: DeclId) -> &[Declarator] {
    match ast[decl].kind {
        DeclKind::Vars { declarators, .. } => &ast[declarators],
        _ => &[],
    }
}

impl<'a> Flow<'a> {
    pub(super) fn new(ast: &'a Ast) -> Self {
        let mut flow = Self { ast, values: HashMap::new(), params: HashMap::new(), calls: HashMap::new() };
        for &item in &ast.items {
            for one in declarators(ast, item) {
                flow.define((None, one.name.symbol), one.init);
                let init = one.init;
                init.into_iter().for_each(|init| flow.read(None, init));
            }
        }
        for (index, function) in ast.functions.iter().enumerate() {
            flow.function(index, function);
        }
        flow
    }

    fn function(&mut self, index: usize, function: &FunctionDecl) {
        let (ast, scope) = (self.ast, Some(index));
        for (place, param) in ast[function.params].iter().enumerate() {
            if let Some(name) = param.name {
                self.params.insert((scope, name.symbol), (function.name.symbol, place));
            }
        }
        let Some(body) = function.body else { return };
        let mut found = Vec::new();
        statements(ast, body, &mut |stmt| {
            if let StmtKind::Decl(decl) = ast[stmt].kind {
                for one in declarators(ast, decl) {
                    found.push((one.name.symbol, one.init));
                }
            }
        });
        found.into_iter().for_each(|(name, init)| self.define((scope, name), init));
        let mut all = Vec::new();
        statements(ast, body, &mut |stmt| own_expressions(ast, stmt, &mut |expr| all.push(expr)));
        all.into_iter().for_each(|expr| self.read(scope, expr));
    }

    fn define(&mut self, name: (Scope, Symbol), value: Option<ExprId>) {
        self.values.entry(name).or_default().extend(value);
    }

    /// Collects the assignments and calls in an expression.
    fn read(&mut self, scope: Scope, root: ExprId) {
        let ast = self.ast;
        expressions(ast, root, &mut |expr| match ast[expr].kind {
            ExprKind::Assign { op: None, place, value } => {
                if let ExprKind::Name(name) = ast[place].kind {
                    let local = (scope, name);
                    let at = if self.is_local(local) { local } else { (None, name) };
                    self.values.entry(at).or_default().push(value);
                }
            }
            ExprKind::Call { name, args } => self.calls.entry(name).or_default().push((scope, args)),
            _ => {}
        });
    }

    fn is_local(&self, name: (Scope, Symbol)) -> bool {
        self.values.contains_key(&name) || self.params.contains_key(&name)
    }

    /// Returns where the value of an expression comes from, each once.
    pub(super) fn leaves(&self, scope: Scope, root: ExprId) -> Vec<Leaf> {
        let (mut stack, mut seen, mut found) = (vec![(scope, root, true, true)], HashSet::new(), Vec::new());
        while let Some(item @ (scope, expr, grows, is_whole)) = stack.pop() {
            if !seen.insert(item) {
                continue;
            }
            match self.ast[expr].kind {
                ExprKind::Int(_) | ExprKind::Uint(_) | ExprKind::Float(_) => {
                    found.push(Leaf::Number { expr, grows, is_whole });
                }
                ExprKind::Name(name) => {
                    let local = (scope, name);
                    let place = if self.is_local(local) { local } else { (None, name) };
                    if let Some((function, index)) = self.params.get(&place) {
                        for (from, args) in self.calls.get(function).into_iter().flatten() {
                            stack.extend(self.ast[*args].get(*index).map(|arg| (*from, *arg, grows, is_whole)));
                        }
                    }
                    match self.values.get(&place) {
                        Some(values) => stack.extend(values.iter().map(|value| (place.0, *value, grows, is_whole))),
                        None if self.params.contains_key(&place) => {}
                        None => found.push(Leaf::Name { name, expr, grows }),
                    }
                }
                ExprKind::Unary { op: UnaryOp::Plus | UnaryOp::Minus, operand } => {
                    stack.push((scope, operand, grows, is_whole));
                }
                ExprKind::Binary { op, lhs, rhs } => match op {
                    BinaryOp::Div => stack.extend([(scope, lhs, grows, false), (scope, rhs, !grows, false)]),
                    BinaryOp::Mul | BinaryOp::Add | BinaryOp::Sub | BinaryOp::Shl | BinaryOp::Shr => {
                        stack.extend([(scope, lhs, grows, false), (scope, rhs, grows, false)]);
                    }
                    _ => {}
                },
                ExprKind::Ternary { then, otherwise, .. } => {
                    stack.extend([(scope, then, grows, is_whole), (scope, otherwise, grows, is_whole)]);
                }
                ExprKind::Construct { ty, args } if matches!(self.ast[ty].kind, TypeSpecKind::Basic(_)) => {
                    let is_whole = is_whole && self.ast[args].len() == 1;
                    stack.extend(self.ast[args].iter().map(|arg| (scope, *arg, grows, is_whole)));
                }
                ExprKind::Call { name, args } if crate::builtins::Builtin::from_symbol(name).is_some() => {
                    stack.extend(self.ast[args].iter().map(|arg| (scope, *arg, grows, false)));
                }
                _ => {}
            }
        }
        found
    }

    /// Returns the number that an expression is, without its sign and conversions.
    pub(super) fn number(ast: &Ast, mut expr: ExprId) -> Option<ExprId> {
        loop {
            expr = match ast[expr].kind {
                ExprKind::Int(_) | ExprKind::Uint(_) | ExprKind::Float(_) => return Some(expr),
                ExprKind::Unary { op: UnaryOp::Plus | UnaryOp::Minus, operand } => operand,
                ExprKind::Construct { args, .. } if ast[args].len() == 1 => ast[args][0],
                _ => return None,
            }
        }
    }
}
