//! The statements of a pass for the debugger: the span of each, its parent, and the variables in scope there.

use super::{
    ast::{Interner, List, Loc, Origins},
    hir::{ExprId, LocalId, LocalKind, Module, StmtId, StmtKind},
    types::TypeId,
};
use eddy_diag::Span;

/// A statement, identified by its index in [`Statements::list`].
#[derive(Clone, Debug)]
pub struct Statement {
    /// The span of the statement; for a branch or a loop, only of its head.
    pub head: Span,
    /// The test of a loop, and the step between two iterations.
    pub test: Option<Span>,
    pub step: Option<Span>,
    /// The enclosing statement.
    pub parent: Option<u32>,
    /// The test comes before the body.
    pub tests_first: bool,
    /// The statement is the initialiser of a `for`, and belongs to its head.
    pub is_init: bool,
    /// The variables in scope before the statement, within its head and its body, and after it.
    before: Option<u32>,
    within: Option<u32>,
    after: Option<u32>,
    /// The span of the whole statement.
    pub whole: Span,
    function: u32,
}

/// A parameter or local variable.
#[derive(Clone, Debug)]
pub struct LocalVariable {
    pub name: String,
    pub ty: TypeId,
    /// The value of a `const`.
    pub constant: Option<Vec<u32>>,
    /// The span of its name.
    declared: Option<Span>,
}

/// The point at which variables are queried: before a statement, within it, or after it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StatementPoint {
    Before,
    Within,
    After,
}

/// The statements and variables of a pass.
#[derive(Debug, Default)]
pub struct Statements {
    /// Indexed by the ids of the checked program; `None` for what is not a statement of a function's body.
    pub list: Vec<Option<Statement>>,
    pub locals: Vec<LocalVariable>,
    /// The span of each function.
    pub functions: Vec<Span>,
    /// The `const` variables of each function.
    constants: Vec<Vec<u32>>,
    /// Each entry is a variable in scope and the next outer entry.
    scopes: Vec<(Option<u32>, u32)>,
}

struct Finder<'m> {
    module: &'m Module,
    origins: &'m Origins,
    out: Statements,
    function: u32,
}

impl Statement {
    /// Returns the index of the function that contains the statement.
    pub fn function(&self) -> u32 {
        self.function
    }
}

impl Statements {
    pub(super) fn new(module: &Module, origins: &Origins, names: &Interner) -> Self {
        let local = |local: &super::hir::Local| LocalVariable {
            name: local.name.map_or(String::new(), |name| names.get(name.symbol).to_owned()),
            ty: local.ty,
            constant: local.value.map(|id| module[module[id].words].to_vec()),
            declared: local.name.map(|name| origins.token_span(name.token)),
        };
        let out = Statements {
            list: vec![None; module.stmts.len()],
            locals: module.locals.iter().map(local).collect(),
            functions: module.functions.iter().map(|function| origins.span(function.loc)).collect(),
            constants: vec![Vec::new(); module.functions.len()],
            scopes: Vec::new(),
        };
        let mut finder = Finder { module, origins, out, function: 0 };
        for (index, function) in module.functions.iter().enumerate() {
            let Some(body) = function.body else { continue };
            finder.function = index as u32;
            let mut scope = None;
            for param in 0..function.param_count {
                scope = Some(finder.scope(scope, LocalId::new((function.locals.start + param) as usize)));
            }
            let is_const = |id: &u32| module[LocalId::new(*id as usize)].kind == LocalKind::Const;
            finder.out.constants[index] = function.locals.clone().filter(is_const).collect();
            finder.statements(body, None, scope, false);
        }
        finder.out
    }

    pub fn get(&self, index: u32) -> Option<&Statement> {
        self.list.get(index as usize)?.as_ref()
    }

    /// Returns the variables in scope at a statement, the outermost first: of several of one name the last one is
    /// visible.
    pub fn visible(&self, index: u32, when: StatementPoint) -> Vec<u32> {
        let Some(statement) = self.get(index) else { return Vec::new() };
        let mut scope = match when {
            StatementPoint::Before => statement.before,
            StatementPoint::Within => statement.within,
            StatementPoint::After => statement.after,
        };
        let mut found = Vec::new();
        while let Some((outer, local)) = scope.map(|scope| self.scopes[scope as usize]) {
            found.push(local);
            scope = outer;
        }
        found.reverse();
        // Constants are folded at their declaration, for which there is no statement.
        let is_before = |id: &&u32| {
            let declared = self.locals[**id as usize].declared;
            declared.is_some_and(|at| at.source == statement.head.source && at.start < statement.head.start)
        };
        let constants = self.constants[statement.function as usize].iter().filter(is_before);
        constants.copied().chain(found).collect()
    }

    /// Returns whether a statement is another one, or nested in it.
    pub fn lies_in(&self, index: u32, outer: u32) -> bool {
        std::iter::successors(Some(index), |&at| self.get(at)?.parent).any(|at| at == outer)
    }
}

impl Finder<'_> {
    fn scope(&mut self, outer: Option<u32>, local: LocalId) -> u32 {
        self.out.scopes.push((outer, local.index() as u32));
        self.out.scopes.len() as u32 - 1
    }

    /// Adds the statements of a list, and returns the scope after it.
    fn statements(
        &mut self,
        list: List<StmtId>,
        parent: Option<u32>,
        mut scope: Option<u32>,
        is_init: bool,
    ) -> Option<u32> {
        for &stmt in &self.module[list] {
            scope = self.statement(stmt, parent, scope, is_init);
        }
        scope
    }

    fn statement(&mut self, stmt: StmtId, parent: Option<u32>, before: Option<u32>, is_init: bool) -> Option<u32> {
        let whole = self.module[stmt].loc;
        let loc_of = |expr: ExprId| self.module[expr].loc;
        let to = |end: Option<Loc>| end.map_or(whole, |end| Loc { first: whole.first, last: end.last });
        let (mut head, mut test, mut step): (Loc, Option<Loc>, Option<Loc>) = (whole, None, None);
        let (mut within, mut after, mut tests_first) = (before, before, false);
        let own = Some(stmt.index() as u32);
        match self.module[stmt].kind {
            StmtKind::Block(list) => {
                self.statements(list, own, before, false);
            }
            StmtKind::Declare { local, .. } => after = Some(self.scope(before, local)),
            StmtKind::If { cond, then, otherwise } => {
                head = to(Some(loc_of(cond)));
                self.statements(then, own, before, false);
                self.statements(otherwise, own, before, false);
            }
            StmtKind::For { init, test: condition, step: between, body } => {
                (test, step) = (condition.map(loc_of), between.map(loc_of));
                head = to(step.or(test).or(Some(whole.first.into())));
                tests_first = true;
                within = self.statements(init, own, before, true);
                self.statements(body, own, within, false);
            }
            StmtKind::DoWhile { body, test: condition } => {
                test = Some(loc_of(condition));
                head = whole.first.into();
                self.statements(body, own, before, false);
            }
            StmtKind::Switch { value, cases } => {
                head = to(Some(loc_of(value)));
                let mut scope = before;
                for case in &self.module[cases] {
                    scope = self.statements(case.body, own, scope, false);
                }
            }
            StmtKind::Expr(_) | StmtKind::Return(_) | StmtKind::Break | StmtKind::Continue | StmtKind::Discard => {}
        }
        let span = |loc: Loc| self.origins.span(loc);
        self.out.list[stmt.index()] = Some(Statement {
            head: span(head),
            test: test.map(span),
            step: step.map(span),
            parent,
            tests_first,
            is_init,
            before,
            within,
            after,
            whole: span(whole),
            function: self.function,
        });
        after
    }
}
