//! Statements (section 6): scopes, placement, and the rules of switch.

use rustc_hash::FxHashMap;

use super::checker::{Checker, Switch};
use crate::{
    ast::{self, Condition, DeclKind, ExprKind as A, List, Loc, StmtKind as S},
    hir::{self, Case, ExprFlags, ExprId, ExprKind, StmtId, StmtKind, TypeId},
};

impl Checker<'_> {
    /// Checks a list of statements in the current scope.
    pub(super) fn statements(&mut self, list: List<ast::StmtId>) -> List<StmtId> {
        let ast = self.ast;
        let base = self.stmt_stack.len();
        for &stmt in &ast[list] {
            self.statement(stmt);
        }
        self.take_statements(base)
    }

    /// Takes the statements on the stack above `base`, and returns them as a list.
    fn take_statements(&mut self, base: usize) -> List<StmtId> {
        let list = self.module.list(&self.stmt_stack[base..]);
        self.stmt_stack.truncate(base);
        list
    }

    /// Checks the body of a branch, which is a scope whatever the statement is.
    fn branch(&mut self, stmt: ast::StmtId) -> List<StmtId> {
        self.scopes.push();
        let list = self.body(stmt);
        self.pop_scope();
        list
    }

    /// Checks the body of a loop, whose scope the loop has opened.
    fn body(&mut self, stmt: ast::StmtId) -> List<StmtId> {
        match self.ast[stmt].kind {
            S::Block(list) => self.statements(list),
            _ => {
                let base = self.stmt_stack.len();
                self.statement(stmt);
                self.take_statements(base)
            }
        }
    }

    pub(super) fn add_stmt(&mut self, kind: StmtKind, loc: Loc) {
        let id = self.module.stmt(kind, loc);
        self.stmt_stack.push(id);
    }

    fn statement(&mut self, id: ast::StmtId) {
        self.settings.cancel.check();
        let ast::Stmt { kind, loc } = self.ast[id];
        match kind {
            S::Error | S::Empty => {}
            S::Block(list) => {
                self.scopes.push();
                let list = self.statements(list);
                self.pop_scope();
                self.add_stmt(StmtKind::Block(list), loc);
            }
            S::Expr(expr) => {
                let value = self.expr(expr);
                self.warn_unused(expr, value);
                self.add_stmt(StmtKind::Expr(value), loc);
            }
            S::Decl(decl) => self.local_declaration(decl),
            S::If { cond, then, otherwise } => {
                let value = self.expr(cond);
                self.expect_bool(value, cond, "the condition of `if`");
                let then = self.branch(then);
                let otherwise = otherwise.map_or(List::EMPTY, |stmt| self.branch(stmt));
                self.add_stmt(StmtKind::If { cond: value, then, otherwise }, loc);
            }
            S::For { init, cond, step, body } => {
                self.scopes.push();
                let base = self.stmt_stack.len();
                self.statement(init);
                let test = cond.and_then(|cond| self.condition(cond, "the condition of `for`"));
                let init = self.take_statements(base);
                let step = step.map(|step| self.expr(step));
                self.rest_of_loop(init, test, step, body, loc);
            }
            S::While { cond, body } => {
                self.scopes.push();
                let base = self.stmt_stack.len();
                let test = self.condition(cond, "the condition of `while`");
                let init = self.take_statements(base);
                self.rest_of_loop(init, test, None, body, loc);
            }
            S::DoWhile { body, cond } => {
                self.loops += 1;
                let body = self.branch(body);
                self.loops -= 1;
                let test = self.expr(cond);
                self.expect_bool(test, cond, "the condition of `while`");
                self.add_stmt(StmtKind::DoWhile { body, test }, loc);
            }
            S::Switch { value, body } => self.switch(value, body, loc),
            S::Case(_) | S::Default => {
                let what = if matches!(kind, S::Default) { "default:" } else { "case" };
                if self.switches.is_empty() {
                    self.error(loc, format!("`{what}` outside a switch"));
                } else {
                    self.error(loc, format!("`{what}` must be directly in its switch, not inside another statement"));
                }
            }
            S::Return(value) => self.return_(value, loc),
            S::Break => {
                if self.loops == 0 && self.switches.is_empty() {
                    self.error(loc, "`break` outside a loop or switch");
                    if self.func.is_some() {
                        self.hint("to leave the function write `return`");
                    }
                } else {
                    self.add_stmt(StmtKind::Break, loc);
                }
            }
            S::Continue => {
                if self.loops == 0 {
                    self.error(loc, "`continue` outside a loop");
                } else {
                    self.add_stmt(StmtKind::Continue, loc);
                }
            }
            S::Discard => {
                if self.env.is_vertex() && !self.is_shared(loc) {
                    self.error(loc, "`discard` works only in a fragment stage");
                    self.hint("move it to the fragment stage");
                }
                self.add_stmt(StmtKind::Discard, loc);
            }
        }
    }

    /// Checks the body of a `for` or `while`, closes its scope, and adds the loop.
    fn rest_of_loop(
        &mut self,
        init: List<StmtId>,
        test: Option<ExprId>,
        step: Option<ExprId>,
        body: ast::StmtId,
        loc: Loc,
    ) {
        self.loops += 1;
        let errors = self.diagnostics.len();
        let body = self.body(body);
        self.loops -= 1;
        if self.diagnostics.len() == errors {
            self.expect_end(test, body, loc);
        }
        self.pop_scope();
        self.add_stmt(StmtKind::For { init, test, step, body }, loc);
    }

    /// Reports an endless loop: ANGLE, and therefore Shadertoy, rejects `for` and `while` loops with a constant true
    /// test that nothing leaves: such a program never draws, and hangs the device. `discard` does not count as leaving.
    fn expect_end(&mut self, test: Option<ExprId>, body: List<StmtId>, loc: Loc) {
        let is_endless = test.is_none_or(|test| self.words(test) == Some(&[1]));
        if is_endless && !self.leaves(body, true) {
            self.error(loc, "this loop never ends: nothing in it breaks or returns");
            self.hint("add a condition, or `if (...) break;` in the loop; `discard` does not end it on Shadertoy");
        }
    }

    /// Returns whether a statement of the list leaves the current loop (`is_own`) or an outer loop.
    fn leaves(&self, list: List<StmtId>, is_own: bool) -> bool {
        self.module[list].iter().any(|id| match self.module[*id].kind {
            StmtKind::Break => is_own,
            StmtKind::Return(_) => true,
            StmtKind::Block(list) => self.leaves(list, is_own),
            StmtKind::If { then, otherwise, .. } => self.leaves(then, is_own) || self.leaves(otherwise, is_own),
            StmtKind::For { body, .. } | StmtKind::DoWhile { body, .. } => self.leaves(body, false),
            StmtKind::Switch { cases, .. } => self.module[cases].iter().any(|case| self.leaves(case.body, false)),
            StmtKind::Expr(_) | StmtKind::Declare { .. } | StmtKind::Continue | StmtKind::Discard => false,
        })
    }

    /// Warns about `x == 1;` where `x = 1;` was probably meant.
    fn warn_unused(&mut self, written: ast::ExprId, value: ExprId) {
        if let A::Binary { op: ast::BinaryOp::Equal, .. } = self.ast[written].kind
            && self.ty(value) == TypeId::BOOL
            && !self.module[value].flags.contains(ExprFlags::EFFECTS)
        {
            let loc = self.loc(value);
            self.warning(loc, "this comparison has no effect");
            self.hint("to assign write `=`");
        }
    }

    fn condition(&mut self, cond: Condition, what: &str) -> Option<ExprId> {
        match cond {
            Condition::Expr(expr) => {
                let value = self.expr(expr);
                self.expect_bool(value, expr, what);
                Some(value)
            }
            Condition::Decl(decl) => self.condition_declaration(decl, what),
        }
    }

    /// Checks `while (bool b = e)`: `b` is declared before the loop and assigned by its test.
    fn condition_declaration(&mut self, decl: ast::DeclId, what: &str) -> Option<ExprId> {
        let ast = self.ast;
        let DeclKind::Vars { qualifiers, ty, declarators } = ast[decl].kind else { return None };
        let &[declarator] = &ast[declarators] else { return None };
        let quals = self.qualifiers(qualifiers, super::qualifiers::DeclContext::Local);
        let base = self.base_type(ty);
        self.check_precision(&quals, base, ast[ty].loc);
        let init = declarator.init?;
        let value = self.expr(init);
        let name = declarator.name;
        let found = self.complete_type(base, ast[ty].dims, declarator.dims, "an array");
        if found != TypeId::BOOL {
            if found != TypeId::ERROR {
                let shown = self.type_name(found);
                self.error(ast[ty].loc, format!("{what} must be a `bool`, not `{shown}`"));
            }
        } else {
            self.expect_type(value, init, TypeId::BOOL, |checker| {
                format!("cannot initialise the `bool` `{}` with {{}}", checker.name(name.symbol))
            });
        }
        let local = self.add_local(name, TypeId::BOOL, hir::LocalKind::Var, None, None);
        let flags = self.inherited(&[value]) | ExprFlags::EFFECTS;
        self.module[local].flags.insert(hir::VarFlags::WRITTEN);
        self.add_stmt(StmtKind::Declare { local, init: None }, ast[decl].loc);
        let place = self.push(ExprKind::Local(local), TypeId::BOOL, ExprFlags::PLACE, name.into());
        let loc = ast[decl].loc;
        Some(self.push(ExprKind::Assign { place, value }, TypeId::BOOL, flags, loc))
    }

    fn return_(&mut self, value: Option<ast::ExprId>, loc: Loc) {
        let value = value.map(|written| (self.expr(written), written));
        let Some(func) = self.func else { return };
        let want = self.module[func].result;
        let name = self.name(self.module[func].name.symbol);
        match value {
            None => {
                if want != TypeId::VOID && want != TypeId::ERROR {
                    let ty = self.type_name(want);
                    self.error(loc, format!("`return` needs a value here: `{name}` returns `{ty}`"));
                    self.returns = true;
                }
                self.add_stmt(StmtKind::Return(None), loc);
            }
            Some((value, written)) => {
                self.returns = true;
                if want == TypeId::VOID {
                    self.error(loc, format!("`{name}` is `void` and cannot return a value"));
                    if self.is_header_entry(func) && self.ty(value) == TypeId::VEC4 {
                        self.hint("assign the colour to the `out` parameter instead: `fragColor = ..;`");
                    } else if self.ty(value) == TypeId::VOID {
                        self.hint("write the call and `return;` as two statements");
                    } else {
                        let ty = self.type_name(self.ty(value));
                        self.hint(format!("declare it to return `{ty}`, or remove the value"));
                    }
                    return;
                }
                if self.is_void(value) {
                    return;
                }
                let value = self.implicit(written, want);
                self.expect_type(value, written, want, |checker| {
                    format!("`{name}` returns `{}`, not {{}}", checker.type_name(want))
                });
                self.add_stmt(StmtKind::Return(Some(value)), loc);
            }
        }
    }

    fn switch(&mut self, value: ast::ExprId, body: List<ast::StmtId>, loc: Loc) {
        let ast = self.ast;
        let selector = self.expr(value);
        let mut ty = self.ty(selector);
        if ty != TypeId::INT && ty != TypeId::UINT {
            if ty != TypeId::ERROR {
                let (found, at) = (self.type_name(ty), self.loc(selector));
                self.error(at, format!("the value of a switch must be an `int` or `uint`, not `{found}`"));
                if ty == TypeId::FLOAT {
                    self.hint("write `int(..)` around it");
                }
            }
            ty = TypeId::ERROR;
        }
        self.scopes.push();
        self.switches.push(Switch { ty, values: FxHashMap::default(), default: None });
        let mut cases: Vec<Case> = Vec::new();
        // The current labels, and the position on the stack where the statements after them start.
        let mut labels: Option<Case> = None;
        let mut values: Vec<u32> = Vec::new();
        let base = self.stmt_stack.len();
        let mut follows = false;
        let mut stray_said = false;
        for &id in &ast[body] {
            let stmt = ast[id];
            let is_default = match stmt.kind {
                S::Case(_) => false,
                S::Default => true,
                S::Error => {
                    follows = true;
                    continue;
                }
                _ => {
                    if labels.is_none() && !stray_said {
                        stray_said = true;
                        self.error(stmt.loc, "a statement comes before the first `case` of this switch");
                        self.hint("move it before the switch, or after a label");
                    }
                    follows = true;
                    self.statement(id);
                    continue;
                }
            };
            if follows && let Some(mut done) = labels.take() {
                done.values = self.module.list(&values);
                done.body = self.take_statements(base);
                values.clear();
                cases.push(done);
            }
            follows = false;
            let value = match stmt.kind {
                S::Case(label) => self.case_label(label),
                _ => {
                    self.default_label(stmt.loc);
                    None
                }
            };
            values.extend(value);
            let case =
                labels.get_or_insert(Case { values: List::EMPTY, is_default: false, body: List::EMPTY, loc: stmt.loc });
            case.is_default |= is_default;
            case.loc = case.loc.to(stmt.loc);
        }
        if let Some(mut last) = labels {
            if !follows {
                self.error(last.loc, "nothing follows the last label of this switch");
                self.hint("write `break;` after it");
            }
            last.values = self.module.list(&values);
            last.body = self.take_statements(base);
            cases.push(last);
        }
        self.stmt_stack.truncate(base);
        self.switches.pop();
        self.pop_scope();
        let cases = self.module.list(&cases);
        self.add_stmt(StmtKind::Switch { value: selector, cases }, loc);
    }

    /// Returns the bits of a `case` label; reports errors in it.
    fn case_label(&mut self, label: ast::ExprId) -> Option<u32> {
        let value = self.expr(label);
        let (found, loc) = (self.ty(value), self.loc(value));
        let want = self.switches.last()?.ty;
        if found == TypeId::ERROR {
            return None;
        }
        if found != TypeId::INT && found != TypeId::UINT {
            let name = self.type_name(found);
            self.error(loc, format!("a `case` must be an `int` or `uint`, not `{name}`"));
            return None;
        }
        if want != TypeId::ERROR && found != want {
            self.expect_type(value, label, want, |checker| {
                format!("this switch is over `{}`, but the label is {{}}", checker.type_name(want))
            });
            return None;
        }
        let Some(&[bits]) = self.words(value) else {
            if self.is_broken() {
                return None;
            }
            self.error(loc, "a `case` must be a constant expression");
            self.hint("compare with `if` and `else if` instead");
            return None;
        };
        let switch = self.switches.last_mut()?;
        if let Some(&first) = switch.values.get(&bits) {
            let shown = if found == TypeId::INT { i64::from(bits as i32) } else { i64::from(bits) };
            self.error(loc, format!("this switch already has a `case {shown}`"));
            self.label(first, "the first one");
            return None;
        }
        switch.values.insert(bits, loc);
        Some(bits)
    }

    fn default_label(&mut self, loc: Loc) {
        let Some(switch) = self.switches.last_mut() else { return };
        if let Some(first) = switch.default {
            self.error(loc, "this switch already has a `default:`");
            self.label(first, "the first one");
            return;
        }
        switch.default = Some(loc);
    }
}
