//! Expressions whose value depends on an order of evaluation that GLSL ES 3.00 leaves undefined.
//!
//! Arguments of calls and constructors are evaluated from left to right (section 6.1.1), the left side of an assignment
//! before the right (5.8), and the left side of a comma, `&&`, `||` or `?` before the right (5.9). No section defines
//! an order for the operands of the other operators, and `out` arguments are written back in any order (6.1.1). Eddy
//! evaluates from left to right everywhere, as ANGLE does, and like ANGLE reads operands and arguments that are
//! variables, or parts of them, after all others have been evaluated.

use super::{
    ast::{List, Loc},
    hir::{ExprId, ExprKind, FuncId, LocalKind, Module},
};
use std::collections::BTreeSet;

pub(crate) const OPERANDS: &str = "one side changes a variable that the other uses, and their order is undefined (5.9)";
pub(crate) const ARGUMENTS: &str = "one variable is written back twice, and their order is undefined (6.1.1)";

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Variable {
    Local(u32),
    Global(u32),
}

/// The reads and writes of an evaluation.
#[derive(Clone, Debug, Default)]
struct Effects {
    reads: BTreeSet<Variable>,
    writes: BTreeSet<Variable>,
}

impl Effects {
    fn add(&mut self, mut other: Effects) {
        if self.reads.len() + self.writes.len() < other.reads.len() + other.writes.len() {
            std::mem::swap(self, &mut other);
        }
        self.reads.extend(other.reads);
        self.writes.extend(other.writes);
    }

    /// Returns whether one of the two writes a variable that the other reads or writes.
    fn meets(&self, other: &Effects) -> bool {
        let changes = |a: &Effects, b: &Effects| a.writes.iter().any(|v| b.reads.contains(v) || b.writes.contains(v));
        changes(self, other) || changes(other, self)
    }
}

/// Returns the locations of such expressions in the reachable functions, and what is undefined there.
pub(crate) fn find(module: &Module) -> Vec<(Loc, &'static str)> {
    let mut functions = vec![Effects::default(); module.functions.len()];
    let mut found = Vec::new();
    for &func in &module.call_order {
        let mut finder = Finder { module, functions: &functions, found: &mut found, first: 0, effects: Vec::new() };
        functions[func.index()] = finder.function(func);
    }
    found
}

struct Finder<'m> {
    module: &'m Module,
    /// The effects on globals of a call of each function processed so far.
    functions: &'m [Effects],
    found: &'m mut Vec<(Loc, &'static str)>,
    /// The index of the function's first expression.
    first: usize,
    /// The effects of the function's expressions, from its first on; empty where a parent has taken them.
    effects: Vec<Effects>,
}

impl Finder<'_> {
    fn function(&mut self, func: FuncId) -> Effects {
        let exprs = self.module[func].exprs.clone();
        self.first = exprs.start as usize;
        // A child comes before its parent.
        for index in exprs {
            let effects = self.expression(ExprId::new(index as usize));
            self.effects.push(effects);
        }
        let mut all = Effects::default();
        self.effects.drain(..).for_each(|effects| all.add(effects));
        let is_global = |variable: &Variable| matches!(variable, Variable::Global(_));
        all.reads.retain(is_global);
        all.writes.retain(is_global);
        all
    }

    fn take(&mut self, expr: ExprId) -> Effects {
        self.effects.get_mut(expr.index().wrapping_sub(self.first)).map(std::mem::take).unwrap_or_default()
    }

    /// Takes the effects of all operands of an expression.
    fn take_all(&mut self, expr: ExprId) -> Effects {
        let mut parts = Vec::new();
        self.module.parts(expr, &mut parts);
        let mut all = Effects::default();
        parts.into_iter().for_each(|part| all.add(self.take(part)));
        all
    }

    fn expression(&mut self, id: ExprId) -> Effects {
        let expr = &self.module[id];
        match expr.kind {
            ExprKind::Local(_) | ExprKind::Global(_) => self.root(id).map(reads).unwrap_or_default(),
            ExprKind::Binary { lhs, rhs, .. } => self.unordered(expr.loc, lhs, rhs),
            ExprKind::Index { base, index } => self.unordered(expr.loc, base, index),
            ExprKind::Assign { place, .. } | ExprKind::AssignOp { place, .. } | ExprKind::IncDec { place, .. } => {
                let mut all = self.take_all(id);
                all.writes.extend(self.root(place));
                all
            }
            ExprKind::Call { func, args } => self.call(id, func, args),
            ExprKind::Builtin { builtin, args } => {
                let mut all = self.take_all(id);
                for &at in builtin.writes {
                    all.writes.extend(self.root(self.module[args][at]));
                }
                all
            }
            _ => self.take_all(id),
        }
    }

    fn unordered(&mut self, loc: Loc, a: ExprId, b: ExprId) -> Effects {
        let (mut left, right) = (self.take(a), self.take(b));
        if left.meets(&right) {
            self.found.push((loc, OPERANDS));
        }
        left.add(right);
        left
    }

    fn call(&mut self, call: ExprId, func: FuncId, args: List<ExprId>) -> Effects {
        let mut all = self.take_all(call);
        let is_written = |kind: LocalKind| matches!(kind, LocalKind::Out | LocalKind::Inout);
        let params = self.module.params(func).iter().zip(&self.module[args]);
        let written: Vec<ExprId> = params.filter(|(param, _)| is_written(param.kind)).map(|(_, &arg)| arg).collect();
        let overlap = |(i, &a): (usize, &ExprId)| written[..i].iter().any(|&b| self.overlaps(a, b));
        if written.iter().enumerate().any(overlap) {
            self.found.push((self.module[call].loc, ARGUMENTS));
        }
        all.writes.extend(written.iter().filter_map(|&place| self.root(place)));
        all.add(self.functions[func.index()].clone());
        all
    }

    /// Returns the variable that contains a place.
    fn root(&self, place: ExprId) -> Option<Variable> {
        match self.module[self.module.root(place)].kind {
            ExprKind::Local(local) => Some(Variable::Local(local.index() as u32)),
            ExprKind::Global(global) => Some(Variable::Global(global.index() as u32)),
            _ => None,
        }
    }

    /// Returns whether two places may overlap.
    fn overlaps(&self, a: ExprId, b: ExprId) -> bool {
        if self.root(a).is_none() || self.root(a) != self.root(b) {
            return false;
        }
        // From the variable down, as far as both paths go.
        let (a, b) = (self.path(a), self.path(b));
        !a.iter().zip(&b).any(|(a, b)| a & b == 0)
    }

    /// Returns the parts that each step from the variable to a place may select, as bits; all bits if that is unknown.
    fn path(&self, mut place: ExprId) -> Vec<u128> {
        let mut path = Vec::new();
        let part = |index: u32| 1u128.checked_shl(index).unwrap_or(u128::MAX);
        loop {
            let (base, parts) = match self.module[place].kind {
                ExprKind::Member { base, index } => (base, part(index)),
                ExprKind::Swizzle { base, swizzle } => (base, swizzle.iter().fold(0, |all, i| all | part(i as u32))),
                ExprKind::Index { base, index } => match self.module[index].kind {
                    ExprKind::Literal(index) => (base, part(index)),
                    _ => (base, u128::MAX),
                },
                _ => break,
            };
            path.push(parts);
            place = base;
        }
        path.reverse();
        path
    }
}

fn reads(variable: Variable) -> Effects {
    Effects { reads: BTreeSet::from([variable]), writes: BTreeSet::new() }
}
