//! Statements: declarations, branches, loops, switches, jumps.

use super::{
    context::const_id,
    function::{Builder, Slot},
    names::{StatementEvent, UnsetKind},
    reachable::known_bool,
};
use crate::{
    ast::List,
    hir::{Case, ExprId, ExprKind, LocalId, StmtId, StmtKind, TypeId, VarFlags},
    ir::{self, Binary, Block, Stmt, Value},
};

impl Builder<'_, '_> {
    pub(super) fn statements(&mut self, list: List<StmtId>) {
        let hir = self.cx.hir;
        for &stmt in &hir[list] {
            // Statements after a jump are unreachable.
            if self.ended {
                return;
            }
            self.statement(stmt);
        }
    }

    pub(super) fn statement(&mut self, stmt: StmtId) {
        let hir = self.cx.hir;
        self.loc = hir[stmt].loc;
        if !matches!(hir[stmt].kind, StmtKind::Block(_)) {
            self.mark_statement(StatementEvent::Start, stmt);
        }
        match hir[stmt].kind {
            StmtKind::Block(list) => self.statements(list),
            StmtKind::Expr(expr) => self.effect(expr),
            StmtKind::Declare { local, init } => self.declaration(local, init),
            StmtKind::If { cond, then, otherwise } => self.branch(cond, then, otherwise),
            StmtKind::For { init, test, step, body } => self.for_loop(stmt, init, (test, step), body),
            StmtKind::DoWhile { body, test } => self.do_while(stmt, body, test),
            StmtKind::Switch { value, cases } => self.switch(value, &hir[cases]),
            StmtKind::Return(value) => match value {
                Some(expr) if self.result != TypeId::VOID => {
                    let value = self.value(expr);
                    self.push(Stmt::Return(Some(value)));
                }
                value => {
                    value.into_iter().for_each(|expr| self.effect(expr));
                    self.push(Stmt::Return(None));
                }
            },
            StmtKind::Break => self.push(Stmt::Break),
            StmtKind::Continue => self.push(Stmt::Continue),
            // In a function of Common that the checker accepted.
            StmtKind::Discard if self.cx.source.kind.is_vertex() => {}
            StmtKind::Discard => {
                self.cx.reflection.discards = true;
                self.push(Stmt::Discard);
            }
        }
    }

    fn declaration(&mut self, local: LocalId, init: Option<ExprId>) {
        let hir = self.cx.hir;
        // A table that is only read here needs no copy.
        if let (Some(init), true, false) = (init, self.needs_memory(local), self.cx.arguments.forwarded[local.index()])
            && let (ExprKind::Const(id), false) = (hir[init].kind, hir[local].flags.contains(VarFlags::WRITTEN))
            && !self.is_vector_or_scalar(hir[local].ty)
        {
            self.set_slot(local, Slot::Table(const_id(id)));
            return;
        }
        if self.starts_with_value(local, init) {
            return;
        }
        let value = match init {
            Some(init) => self.value(init),
            None => self.undefined_local(UnsetKind::Variable, local),
        };
        self.declare(local, value);
    }

    /// Initialises an array, matrix or structure that is declared once per call with its value instead of zeros first:
    /// filling memory twice is expensive, and not every driver removes the first fill.
    fn starts_with_value(&mut self, local: LocalId, init: Option<ExprId>) -> bool {
        let hir = self.cx.hir;
        if (self.cx.marks.undefined && init.is_none())
            || self.loops > 0
            || !self.needs_memory(local)
            || self.is_vector_or_scalar(hir[local].ty)
        {
            return false;
        }
        let value = match init.map(|init| hir[init].kind) {
            None => self.zero(hir[local].ty),
            Some(ExprKind::Const(id)) if self.is_initialiser(id) => self.constant(id),
            Some(_) => return false,
        };
        let pointer = self.address_of(local);
        self.set_initializer(pointer, value);
        true
    }

    fn branch(&mut self, cond: ExprId, then: List<StmtId>, otherwise: List<StmtId>) {
        if let Some(known) = known_bool(self.cx.hir, cond) {
            return self.statements(if known { then } else { otherwise });
        }
        let condition = self.value(cond);
        let (accept, then_ended) = self.nested(|b| b.statements(then));
        let (reject, else_ended) = self.nested(|b| b.statements(otherwise));
        self.push(Stmt::If { condition, accept, reject });
        self.ended = then_ended && else_ended;
    }

    fn for_loop(
        &mut self,
        stmt: StmtId,
        init: List<StmtId>,
        (test, step): (Option<ExprId>, Option<ExprId>),
        body: List<StmtId>,
    ) {
        let hir = self.cx.hir;
        self.statements(init);
        let known = test.map_or(Some(true), |test| known_bool(hir, test));
        if known == Some(false) {
            return;
        }
        self.loops += 1;
        let (body, _) = self.nested(|b| {
            b.mark_statement(StatementEvent::Iteration, stmt);
            if let (None, Some(test)) = (known, test) {
                let condition = b.value(test);
                b.push(Stmt::If { condition, accept: Block::new(), reject: vec![Stmt::Break] });
            }
            b.statements(body);
        });
        let (continuing, _) = self.nested(|b| {
            b.mark_statement(StatementEvent::Step, stmt);
            step.into_iter().for_each(|step| b.effect(step));
        });
        self.loops -= 1;
        self.push(Stmt::Loop { body, continuing, break_if: None });
    }

    fn do_while(&mut self, stmt: StmtId, body: List<StmtId>, test: ExprId) {
        let known = known_bool(self.cx.hir, test);
        self.loops += 1;
        let (body, _) = self.nested(|b| {
            b.mark_statement(StatementEvent::Iteration, stmt);
            b.statements(body);
        });
        let mut break_if = None;
        let (continuing, _) = self.nested(|b| {
            b.mark_statement(StatementEvent::Test, stmt);
            if known != Some(true) {
                let again = b.value(test);
                break_if = Some(b.not(again));
            }
        });
        self.loops -= 1;
        self.push(Stmt::Loop { body, continuing, break_if });
    }

    fn switch(&mut self, value: ExprId, cases: &[Case]) {
        let selector = self.value(value);
        for case in cases {
            self.force_declared(case.body);
        }
        // Each body by itself, and whether it falls through into the next.
        let mut bodies = Vec::with_capacity(cases.len());
        for case in cases {
            bodies.push(self.nested(|b| b.statements(case.body)));
        }
        let last = cases.len().saturating_sub(1);
        let falls = bodies.iter().enumerate().any(|(i, (body, ended))| i != last && !*ended && !body.is_empty());
        if falls {
            return self.switch_with_fall_through(selector, cases, bodies);
        }
        let mut out = Vec::with_capacity(cases.len() + 1);
        let mut labels = Vec::new();
        for (case, (body, _)) in cases.iter().zip(bodies) {
            labels.extend(self.labels(case));
            // A case without a body: its labels belong to the next one.
            if body.is_empty() && !std::ptr::eq(case, &cases[last]) {
                continue;
            }
            let Some(main) = labels.pop() else { continue };
            let empty = |label| ir::Case { label, body: Block::new(), falls_through: true };
            out.extend(labels.drain(..).map(empty));
            out.push(ir::Case { label: main, body, falls_through: false });
        }
        self.finish_switch(selector, out);
    }

    fn labels(&self, case: &Case) -> Vec<Option<u32>> {
        let values = self.cx.hir[case.values].iter();
        values.map(|&bits| Some(bits)).chain(case.is_default.then_some(None)).collect()
    }

    fn finish_switch(&mut self, selector: Value, mut cases: Vec<ir::Case>) {
        if !cases.iter().any(|case| case.label.is_none()) {
            cases.push(ir::Case { label: None, body: Block::new(), falls_through: false });
        }
        self.push(Stmt::Switch { selector, cases });
    }

    /// Adds a switch in which a body falls through into the next one. naga's writers disagree on what they accept
    /// there, so a first switch determines the number of the first body to run, and a second, with one case, contains
    /// all bodies, each under a test that it is reached; a `break` leaves it.
    fn switch_with_fall_through(&mut self, selector: Value, cases: &[Case], bodies: Vec<(Block, bool)>) {
        use crate::hir::Scalar;
        let first = self.temporary(TypeId::INT);
        let none = self.literal(Scalar::Int, cases.len() as u32);
        let mut out = Vec::new();
        let mut has_default = false;
        for (i, case) in cases.iter().enumerate() {
            has_default |= case.is_default;
            let mut labels = self.labels(case);
            let Some(main) = labels.pop() else { continue };
            let number = self.literal(Scalar::Int, i as u32);
            let (body, _) = self.nested(|b| b.store(first, number));
            let empty = |label| ir::Case { label, body: Block::new(), falls_through: true };
            out.extend(labels.into_iter().map(empty));
            out.push(ir::Case { label: main, body, falls_through: false });
        }
        if !has_default {
            let (body, _) = self.nested(|b| b.store(first, none));
            out.push(ir::Case { label: None, body, falls_through: false });
        }
        self.push(Stmt::Switch { selector, cases: out });
        let start = self.load(first);
        let (body, _) = self.nested(|b| {
            for (i, (accept, _)) in bodies.into_iter().enumerate() {
                let number = b.literal(Scalar::Int, i as u32);
                let condition = b.op(Binary::LessEqual, start, number);
                b.push(Stmt::If { condition, accept, reject: Block::new() });
            }
        });
        let only = ir::Case { label: None, body, falls_through: false };
        self.push(Stmt::Switch { selector: start, cases: vec![only] });
    }

    /// Makes locals declared in one case memory, because the next case can name them, and their declaration does not
    /// dominate its code.
    fn force_declared(&mut self, list: List<StmtId>) {
        let hir = self.cx.hir;
        for &stmt in &hir[list] {
            match hir[stmt].kind {
                StmtKind::Declare { local, .. } => self.force_memory(local),
                StmtKind::Block(list) => self.force_declared(list),
                _ => {}
            }
        }
    }
}
