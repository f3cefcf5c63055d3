//! Finds the expressions on which the amount of work depends, and the numbers that reach them.

use super::{
    Declared, Number, NumberType, Role, RoleKind,
    flow::{self, Flow, Leaf, Scope},
    text_of,
};
use crate::{
    ast::{
        Ast, BinaryOp, DeclKind, ExprId, ExprKind, Interner, Origins, PostfixOp, QualifierKind, StmtId, StmtKind,
        Symbol, TokenId, UnaryOp,
    },
    source::PassSource,
};
use eddy_diag::Span;
use std::collections::{BTreeMap, HashMap, HashSet};

pub(super) struct Finder<'a> {
    ast: &'a Ast,
    origins: &'a Origins,
    names: &'a Interner,
    source: &'a PassSource<'a>,
    flow: Flow<'a>,
    /// The variable that a number alone initialises, by the number's token.
    initialised: HashMap<TokenId, (Symbol, Declared)>,
    /// Keyed by the text, the place in it and the name.
    found: BTreeMap<(u16, u32, String), Number>,
}

impl<'a> Finder<'a> {
    pub(super) fn new(ast: &'a Ast, origins: &'a Origins, names: &'a Interner, source: &'a PassSource<'a>) -> Self {
        let mut initialised = HashMap::new();
        for decl in &ast.decls {
            let DeclKind::Vars { qualifiers, declarators, .. } = decl.kind else { continue };
            let is_const = ast[qualifiers].iter().any(|one| one.kind == QualifierKind::Const);
            let declared = if is_const { Declared::Const } else { Declared::Variable };
            for one in &ast[declarators] {
                if let Some(number) = one.init.and_then(|init| Flow::number(ast, init)) {
                    initialised.insert(ast[number].loc.first, (one.name.symbol, declared));
                }
            }
        }
        Self { ast, origins, names, source, flow: Flow::new(ast), initialised, found: BTreeMap::new() }
    }

    pub(super) fn numbers(mut self) -> Vec<Number> {
        // Every number with a name, so that one can be chosen by it.
        for expr in &self.ast.exprs {
            if let Some(number) = self.number_of(expr.loc.first, expr.kind, true)
                && matches!(number.declared, Declared::Macro | Declared::Const)
            {
                self.found.entry(key(&number)).or_insert(number);
            }
        }
        for &item in &self.ast.items {
            self.arrays(None, item);
        }
        for (index, function) in self.ast.functions.iter().enumerate() {
            if let Some(body) = function.body {
                self.function(Some(index), body);
            }
        }
        self.directives();
        self.found.into_values().collect()
    }

    fn function(&mut self, scope: Scope, body: StmtId) {
        let ast = self.ast;
        let mut all = Vec::new();
        flow::statements(ast, body, &mut |stmt| all.push(stmt));
        for stmt in all {
            match ast[stmt].kind {
                StmtKind::Decl(decl) => self.arrays(scope, decl),
                StmtKind::For { init, cond, step, body } => {
                    let mut counters = self.counters(body, step);
                    let starts = self.starts(init);
                    counters.extend(starts.iter().map(|(name, _)| *name));
                    let test = flow::condition(ast, cond);
                    self.test(scope, test, &counters, true);
                    self.counted_down(scope, step, &starts);
                    self.steps(scope, step, &counters);
                    self.body(scope, body, test, &counters);
                }
                StmtKind::While { cond, body } => {
                    let (counters, test) = (self.counters(body, None), flow::condition(ast, Some(cond)));
                    self.test(scope, test, &counters, true);
                    self.body(scope, body, test, &counters);
                }
                StmtKind::DoWhile { body, cond } => {
                    let counters = self.counters(body, None);
                    self.test(scope, Some(cond), &counters, true);
                    self.body(scope, body, Some(cond), &counters);
                }
                _ => {}
            }
        }
    }

    /// Returns the variables that a `for` sets first, with their values.
    fn starts(&self, init: StmtId) -> Vec<(Symbol, ExprId)> {
        match self.ast[init].kind {
            StmtKind::Decl(decl) => {
                let all = flow::declarators(self.ast, decl).iter();
                all.filter_map(|one| Some((one.name.symbol, one.init?))).collect()
            }
            StmtKind::Expr(expr) => match self.ast[expr].kind {
                ExprKind::Assign { op: None, place, value } => {
                    self.name(place).into_iter().map(|name| (name, value)).collect()
                }
                _ => Vec::new(),
            },
            _ => Vec::new(),
        }
    }

    fn name(&self, expr: ExprId) -> Option<Symbol> {
        if let ExprKind::Name(name) = self.ast[expr].kind { Some(name) } else { None }
    }

    /// Returns the variables that a loop changes by a number: `i++`, `i += 2`.
    fn counters(&self, body: StmtId, step: Option<ExprId>) -> HashSet<Symbol> {
        let mut roots: Vec<ExprId> = step.into_iter().collect();
        flow::statements(self.ast, body, &mut |stmt| {
            flow::own_expressions(self.ast, stmt, &mut |expr| roots.push(expr))
        });
        let mut counters = HashSet::new();
        for root in roots {
            flow::expressions(self.ast, root, &mut |expr| {
                let place = match self.ast[expr].kind {
                    ExprKind::Postfix { operand, .. }
                    | ExprKind::Unary { op: UnaryOp::Increment | UnaryOp::Decrement, operand } => Some(operand),
                    ExprKind::Assign { op: Some(_), place, value } if Flow::number(self.ast, value).is_some() => {
                        Some(place)
                    }
                    _ => None,
                };
                counters.extend(place.and_then(|place| self.name(place)));
            });
        }
        counters
    }

    /// Finds the numbers of a test that ends a loop: when it is false, if `continues`, else when it is true.
    fn test(&mut self, scope: Scope, test: Option<ExprId>, counters: &HashSet<Symbol>, continues: bool) {
        let mut parts: Vec<ExprId> = test.into_iter().collect();
        while let Some(expr) = parts.pop() {
            let ExprKind::Binary { op, lhs, rhs } = self.ast[expr].kind else { continue };
            let is_less = match op {
                BinaryOp::LogicalAnd | BinaryOp::LogicalOr => {
                    parts.extend([lhs, rhs]);
                    continue;
                }
                BinaryOp::Less | BinaryOp::LessEqual | BinaryOp::NotEqual => true,
                BinaryOp::Greater | BinaryOp::GreaterEqual | BinaryOp::Equal => false,
                _ => continue,
            };
            let counts = |side: ExprId| {
                let mut is_there = false;
                flow::expressions(self.ast, side, &mut |part| {
                    is_there |= self.name(part).is_some_and(|name| counters.contains(&name));
                });
                is_there
            };
            // `(quantity) < (limit)`, in either order.
            let (limit, is_less, counted) = match (counts(lhs), counts(rhs)) {
                (true, _) => (rhs, is_less, true),
                (false, true) => (lhs, !is_less, true),
                (false, false) if Flow::number(self.ast, lhs).is_some() => (lhs, !is_less, false),
                (false, false) => (rhs, is_less, false),
            };
            // The loop continues below the limit, or ends above it.
            let (kind, grows) = match (counted, is_less == continues) {
                (true, _) => (RoleKind::LoopBound, true),
                (false, true) => (RoleKind::Distance, true),
                (false, false) => (RoleKind::Tolerance, false),
            };
            self.sink(scope, limit, kind, grows);
        }
    }

    /// Finds where a loop starts that counts down.
    fn counted_down(&mut self, scope: Scope, step: Option<ExprId>, starts: &[(Symbol, ExprId)]) {
        let place = step.and_then(|step| match self.ast[step].kind {
            ExprKind::Postfix { op: PostfixOp::Decrement, operand }
            | ExprKind::Unary { op: UnaryOp::Decrement, operand } => Some(operand),
            ExprKind::Assign { op: Some(BinaryOp::Sub), place, .. } => Some(place),
            _ => None,
        });
        let name = place.and_then(|place| self.name(place));
        for (_, start) in starts.iter().filter(|(start, _)| Some(*start) == name) {
            self.sink(scope, *start, RoleKind::LoopBound, true);
        }
    }

    /// Finds the steps of counters in an expression.
    fn steps(&mut self, scope: Scope, root: Option<ExprId>, advancing: &HashSet<Symbol>) {
        let mut found = Vec::new();
        root.into_iter().for_each(|root| {
            flow::expressions(self.ast, root, &mut |expr| match self.ast[expr].kind {
                ExprKind::Assign { op: Some(BinaryOp::Add | BinaryOp::Sub), place, value } => {
                    found.extend(self.name(place).filter(|name| advancing.contains(name)).map(|_| value));
                }
                ExprKind::Assign { op: None, place, value } => {
                    if let ExprKind::Binary { op: BinaryOp::Add, lhs, rhs } = self.ast[value].kind
                        && let Some(name) = self.name(place).filter(|name| advancing.contains(name))
                    {
                        found.extend([lhs, rhs].into_iter().filter(|side| self.name(*side) != Some(name)));
                    }
                }
                _ => {}
            });
        });
        found.into_iter().for_each(|value| self.sink(scope, value, RoleKind::LoopStep, false));
    }

    /// Finds what ends a loop in its body, and the steps of what its end depends on.
    fn body(&mut self, scope: Scope, body: StmtId, test: Option<ExprId>, counters: &HashSet<Symbol>) {
        let ast = self.ast;
        let (mut tests, mut ends, mut roots) = (Vec::new(), HashSet::new(), Vec::new());
        flow::statements(ast, body, &mut |stmt| {
            if let StmtKind::If { cond, then, .. } = ast[stmt].kind
                && self.leaves_loop(then)
            {
                tests.push(cond);
            }
            flow::own_expressions(ast, stmt, &mut |expr| roots.push(expr));
        });
        for test in tests.iter().copied().chain(test) {
            flow::expressions(ast, test, &mut |part| ends.extend(self.name(part)));
        }
        tests.into_iter().for_each(|test| self.test(scope, Some(test), counters, false));
        roots.into_iter().for_each(|root| self.steps(scope, Some(root), &ends));
    }

    fn leaves_loop(&self, stmt: StmtId) -> bool {
        match self.ast[stmt].kind {
            StmtKind::Break | StmtKind::Return(_) => true,
            StmtKind::Block(list) => self.ast[list]
                .last()
                .is_some_and(|last| matches!(self.ast[*last].kind, StmtKind::Break | StmtKind::Return(_))),
            _ => false,
        }
    }

    /// Finds what sizes arrays.
    fn arrays(&mut self, scope: Scope, decl: crate::ast::DeclId) {
        let DeclKind::Vars { ty, declarators, .. } = self.ast[decl].kind else { return };
        let mut dims: Vec<_> = self.ast[self.ast[ty].dims].to_vec();
        dims.extend(self.ast[declarators].iter().flat_map(|one| &self.ast[one.dims]));
        for size in dims.into_iter().filter_map(|dim| dim.size) {
            self.sink(scope, size, RoleKind::ArraySize, true);
        }
    }

    /// Adds a role to each number that an expression may have as its value.
    fn sink(&mut self, scope: Scope, expr: ExprId, kind: RoleKind, grows: bool) {
        let at = self.origins.span(self.ast[expr].loc);
        for leaf in self.flow.leaves(scope, expr) {
            let (number, up) = match leaf {
                Leaf::Number { expr, grows: up, is_whole } => {
                    let number = self.number_of(self.ast[expr].loc.first, self.ast[expr].kind, is_whole);
                    (number.filter(|number| number.value > 0.0), up)
                }
                Leaf::Name { name, expr, grows: up } => (self.uniform(name, expr), up),
            };
            let Some(number) = number else { continue };
            // Steps of one are counters, not distances.
            if number.declared == Declared::Literal && (kind == RoleKind::LoopStep && number.value == 1.0) {
                continue;
            }
            let role = Role { kind, grows: grows == up, at };
            let roles = &mut self.found.entry(key(&number)).or_insert(number).roles;
            if !roles.contains(&role) {
                roles.push(role);
            }
        }
    }

    fn uniform(&self, name: Symbol, expr: ExprId) -> Option<Number> {
        let name = self.names.get(name);
        self.source.custom_uniforms.iter().find(|uniform| uniform.name == name)?;
        Some(Number {
            name: name.to_owned(),
            declared: Declared::Uniform,
            span: self.origins.span(self.ast[expr].loc),
            // Its value is the project's.
            value: 1.0,
            ty: NumberType::Float,
            roles: Vec::new(),
        })
    }

    /// Returns a number with what declares it. One in place counts if an expression is that number alone.
    fn number_of(&self, token: TokenId, kind: ExprKind, is_whole: bool) -> Option<Number> {
        let (value, ty) = match kind {
            ExprKind::Int(value) => (f64::from(value), NumberType::Int),
            ExprKind::Uint(value) => (f64::from(value), NumberType::Uint),
            ExprKind::Float(value) => (value.to_string().parse().ok()?, NumberType::Float),
            _ => return None,
        };
        let origin = self.origins.tokens[token.0 as usize];
        let span = origin.spelled;
        let written = text_of(self.source, span.source)?.get(span.range())?;
        let (name, declared) = match origin.expansion {
            Some(id) => {
                let def = self.origins[self.origins[id].macro_id];
                if def.function_like || !self.is_body(def.defined_at?, def.name_at?, written) {
                    return None;
                }
                (self.names.get(def.name).to_owned(), Declared::Macro)
            }
            None => match self.initialised.get(&token) {
                Some((name, declared)) => (self.names.get(*name).to_owned(), *declared),
                None if is_whole => (String::new(), Declared::Literal),
                None => return None,
            },
        };
        Some(Number { name, declared, span, value, ty, roles: Vec::new() })
    }

    /// Returns whether the replacement list of a macro is a number and nothing else.
    fn is_body(&self, defined_at: Span, name_at: Span, number: &str) -> bool {
        let body = text_of(self.source, defined_at.source)
            .and_then(|text| text.get(name_at.end as usize..defined_at.end as usize));
        body.is_some_and(|body| body.trim_matches(|c: char| c.is_whitespace() || "()+-".contains(c)) == number)
    }

    /// Finds macros in conditions of the preprocessor.
    fn directives(&mut self) {
        for &(span, id) in &self.origins.macro_uses {
            let def = self.origins[id];
            let Some(text) = text_of(self.source, span.source) else { continue };
            let start = text[..span.start as usize].rfind('\n').map_or(0, |at| at + 1);
            let line = text[start..].lines().next().unwrap_or("").trim_start();
            let Some(directive) = line.strip_prefix('#').map(str::trim_start) else { continue };
            let is_switch =
                directive.starts_with("ifdef") || directive.starts_with("ifndef") || directive.contains("defined");
            let kind = match directive {
                _ if is_switch => RoleKind::Switch,
                _ if directive.starts_with("if") || directive.starts_with("elif") => RoleKind::Condition,
                _ => continue,
            };
            let Some(number) = self.number_of_macro(def.name, def.name_at, def.defined_at) else { continue };
            let role = Role { kind, grows: true, at: span };
            let roles = &mut self.found.entry(key(&number)).or_insert(number).roles;
            if !roles.contains(&role) {
                roles.push(role);
            }
        }
    }

    /// Returns the number that a macro is, which no text may use.
    fn number_of_macro(&self, name: Symbol, name_at: Option<Span>, defined_at: Option<Span>) -> Option<Number> {
        let (name_at, defined_at) = (name_at?, defined_at?);
        let from = name_at.end as usize;
        let body = text_of(self.source, defined_at.source)?.get(from..defined_at.end as usize)?;
        let number = body.trim_matches(|c: char| c.is_whitespace() || "()+-".contains(c));
        let start = from + body.find(number).filter(|_| !number.is_empty())?;
        let ty = match number {
            _ if number.parse::<i32>().is_ok() => NumberType::Int,
            _ if number.trim_end_matches(['u', 'U']).parse::<u32>().is_ok() => NumberType::Uint,
            _ => NumberType::Float,
        };
        let value = number.trim_end_matches(['u', 'U', 'f', 'F']).parse().ok()?;
        let span = Span::new(defined_at.source, start..start + number.len());
        let name = self.names.get(name).to_owned();
        Some(Number { name, declared: Declared::Macro, span, value, ty, roles: Vec::new() })
    }
}

fn key(number: &Number) -> (u16, u32, String) {
    match number.declared {
        Declared::Uniform => (u16::MAX, 0, number.name.clone()),
        _ => (number.span.source.0, number.span.start, String::new()),
    }
}
