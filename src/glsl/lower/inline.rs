//! Calls of small functions, and of functions called once, replaced by what they do.
//!
//! Every driver does that sooner or later. OpenGL's compilers do it before they join constants and look for what is computed
//! twice, across the borders that the author drew; a SPIR-V driver finds most of that done for each function alone, and last
//! bits come out differently (see [`super::geometry`]).

use super::{
    calls::Specialization,
    function::Builder,
    ranges::Bounds,
    reach::{Reach, known_bool},
    walk::{Node, walk},
};
use crate::glsl::{
    ast::{List, MAX_NESTING},
    hir::{ExprId, ExprKind, FuncId, LocalId, Module, Scalar, StmtId, StmtKind, TypeId},
    ir::{Block, Stmt, Value},
};

/// Expressions and statements of a function, with those of what is inlined into it, that are written again for each call.
const LARGEST: usize = 256;

/// As many of a whole program, after inlining. What would be larger inlines smaller functions only: texts that call one function
/// a million times must not become so many copies.
const LARGEST_PROGRAM: usize = 1 << 17;

/// Which functions are inlined wherever they are called, by [`FuncId::index`]: small ones, and those of any size that are called
/// at one place only, which makes the program no larger. These nest no deeper than an author may, lest the stack overflow.
pub(super) fn inlined(module: &Module, reach: &Reach) -> Vec<bool> {
    let mut inlined = small(module);
    let sites = sites(module, reach, &inlined);
    let mut depths = vec![0; module.functions.len()];
    for &func in &module.call_order {
        let body = &module[module[func].body.unwrap_or(List::EMPTY)];
        let once = sites[func.index()] == 1 && Some(func) != module.entry && only_returns(module, body);
        let depth = depth(module, body, |callee| if inlined[callee.index()] { depths[callee.index()] } else { 0 });
        depths[func.index()] = depth;
        inlined[func.index()] |= once && depth <= MAX_NESTING as usize;
    }
    inlined
}

/// How deep a body nests; `of_call` says how deep that of a called function does, where it becomes part of this one.
fn depth(module: &Module, body: &[StmtId], of_call: impl Fn(FuncId) -> usize) -> usize {
    // What follows a return becomes a branch.
    let (mut deepest, mut returns) = (0, 0);
    walk(module, body, &[], |node, depth| {
        let callee = match node {
            Node::Expr(expr) => match module[expr].kind {
                ExprKind::Call { func, .. } => of_call(func),
                _ => 0,
            },
            Node::Stmt(stmt) => {
                returns += usize::from(matches!(module[stmt].kind, StmtKind::Return(_)));
                0
            }
        };
        deepest = deepest.max(depth + 1 + callee);
    });
    deepest + returns
}

/// At how many places of the lowered program each function is called, where these functions are inlined; by [`FuncId::index`].
fn sites(module: &Module, reach: &Reach, inlined: &[bool]) -> Vec<usize> {
    let mut bodies = vec![0usize; module.functions.len()];
    for instance in &reach.instances {
        bodies[instance.func.index()] += 1;
    }
    let mut sites = vec![0usize; module.functions.len()];
    let count = |sites: &mut Vec<usize>, stmts: &[StmtId], exprs: &[ExprId], copies: usize| {
        walk(module, stmts, exprs, |node, _| {
            if let Node::Expr(expr) = node
                && let ExprKind::Call { func, .. } = module[expr].kind
            {
                sites[func.index()] = sites[func.index()].saturating_add(copies);
            }
        });
    };
    let initialisers: Vec<ExprId> = module.globals.iter().filter_map(|global| global.init).collect();
    count(&mut sites, &[], &initialisers, 1);
    for &func in module.call_order.iter().rev() {
        let copies = if inlined[func.index()] { sites[func.index()] } else { bodies[func.index()] };
        count(&mut sites, &module[module[func].body.unwrap_or(List::EMPTY)], &[], copies);
    }
    sites
}

/// Which functions are inlined because they are small.
fn small(module: &Module) -> Vec<bool> {
    let mut fits = vec![false; module.functions.len()];
    for &func in &module.call_order {
        let body = module[func].body.unwrap_or(List::EMPTY);
        fits[func.index()] = Some(func) != module.entry && only_returns(module, &module[body]);
    }
    let mut largest = LARGEST;
    loop {
        let mut sizes = vec![0usize; module.functions.len()];
        let mut program = 0usize;
        for &func in &module.call_order {
            let inlined = |func: FuncId| fits[func.index()] && sizes[func.index()] <= largest;
            let size = size(module, module[func].body.unwrap_or(List::EMPTY), |callee| match inlined(callee) {
                true => sizes[callee.index()],
                false => 0,
            });
            sizes[func.index()] = size;
            if !fits[func.index()] || size > largest {
                program = program.saturating_add(size);
            }
        }
        if program <= LARGEST_PROGRAM || largest == 0 {
            return fits.iter().zip(sizes).map(|(fits, size)| *fits && size <= largest).collect();
        }
        largest /= 4;
    }
}

/// Whether a function ends by returning only: nothing may follow a `discard` that stands in the middle of an expression.
fn only_returns(module: &Module, body: &[StmtId]) -> bool {
    let mut only = true;
    walk(module, body, &[], |node, _| {
        only &= !matches!(node, Node::Stmt(stmt) if matches!(module[stmt].kind, StmtKind::Discard));
    });
    only
}

/// Whether some return is followed by statements that no branch beside it holds: what then is left out depends on a variable.
fn needs_flag(module: &Module, list: &[StmtId]) -> bool {
    list.iter().filter(|&&stmt| leaves(module, stmt)).any(|&stmt| match module[stmt].kind {
        StmtKind::Block(list) => needs_flag(module, &module[list]),
        StmtKind::If { then, otherwise, .. } => {
            let (then, otherwise) = (&module[then], &module[otherwise]);
            !always_returns(module, then) && !always_returns(module, otherwise)
                || needs_flag(module, then)
                || needs_flag(module, otherwise)
        }
        StmtKind::Return(_) => false,
        _ => true,
    })
}

/// Whether control cannot reach the end of a list.
fn always_returns(module: &Module, list: &[StmtId]) -> bool {
    list.last().is_some_and(|&last| match module[last].kind {
        StmtKind::Return(_) => true,
        StmtKind::If { then, otherwise, .. } => {
            always_returns(module, &module[then]) && always_returns(module, &module[otherwise])
        }
        _ => false,
    })
}

/// Whether a statement may leave the function.
fn leaves(module: &Module, stmt: StmtId) -> bool {
    let any = |list: List<StmtId>| module[list].iter().any(|&stmt| leaves(module, stmt));
    match module[stmt].kind {
        StmtKind::Return(_) | StmtKind::Discard => true,
        StmtKind::Block(list) => any(list),
        StmtKind::If { then, otherwise, .. } => any(then) || any(otherwise),
        StmtKind::For { init, body, .. } => any(init) || any(body),
        StmtKind::DoWhile { body, .. } => any(body),
        StmtKind::Switch { cases, .. } => module[cases].iter().any(|case| any(case.body)),
        StmtKind::Expr(_) | StmtKind::Declare { .. } | StmtKind::Break | StmtKind::Continue => false,
    }
}

/// Counts expressions and statements; `of_call` says how many a call of a function adds.
fn size(module: &Module, body: List<StmtId>, of_call: impl Fn(FuncId) -> usize) -> usize {
    let mut size = 0usize;
    walk(module, &module[body], &[], |node, _| {
        size += 1;
        if let Node::Expr(expr) = node
            && let ExprKind::Call { func, .. } = module[expr].kind
        {
            size = size.saturating_add(of_call(func));
        }
    });
    size
}

/// How the function leaves that is part of another one.
#[derive(Clone, Copy)]
pub(super) struct Leaving {
    /// Where its result goes.
    result: Option<Value>,
    /// Where it says that it has returned.
    flag: Option<Value>,
    /// How many loops and switches its call lies in.
    breakable: usize,
}

impl Builder<'_, '_> {
    /// Does what a function does with these arguments, which are as [`Builder::call`] would pass them; `None` if it is void.
    /// `known` are bounds of parameters.
    pub fn inline(
        &mut self,
        func: FuncId,
        given: Box<[Specialization]>,
        arguments: Vec<Value>,
        known: Vec<(LocalId, Bounds)>,
    ) -> Option<Value> {
        let hir = self.cx.hir;
        let function = &hir[func];
        let outer = self.enter(func, given);
        self.declared.extend(known.into_iter().map(|(param, bounds)| (param.index() as u32, bounds)));
        let mut arguments = arguments.into_iter();
        self.parameters(func, |_, _| arguments.next().expect("an argument for each parameter"));
        let body = &hir[function.body.unwrap_or(List::EMPTY)];
        let value = if let Some((&last, rest)) = body.split_last()
            && let StmtKind::Return(Some(value)) = hir[last].kind
            && function.result != TypeId::VOID
            && !rest.iter().any(|&stmt| leaves(hir, stmt))
        {
            rest.iter().for_each(|&stmt| self.statement(stmt));
            Some(self.value(value))
        } else {
            let result = (function.result != TypeId::VOID).then(|| self.temporary(function.result));
            if let (Some(result), false) = (result, always_returns(hir, body)) {
                // Falling off the end gives zero.
                let zero = self.zero(function.result);
                self.store(result, zero);
            }
            let flag = needs_flag(hir, body).then(|| self.temporary(TypeId::BOOL));
            if let Some(flag) = flag {
                let not_yet = self.literal(Scalar::Bool, 0);
                self.store(flag, not_yet);
            }
            self.leaving = Some(Leaving { result, flag, breakable: self.breakable });
            self.body(body.to_vec());
            result.map(|result| self.load(result))
        };
        self.leave(outer);
        value
    }

    /// Statements of a body, outside its loops and switches: what follows one that may leave becomes part of a branch.
    fn body(&mut self, mut list: Vec<StmtId>) {
        let hir = self.cx.hir;
        let Some(at) = list.iter().position(|&stmt| leaves(hir, stmt)) else {
            return list.into_iter().for_each(|stmt| self.statement(stmt));
        };
        let mut rest = list.split_off(at + 1);
        let stmt = list.pop().expect("it was found");
        list.into_iter().for_each(|stmt| self.statement(stmt));
        let followed_by = |first: List<StmtId>, rest: &mut Vec<StmtId>| {
            let mut all = hir[first].to_vec();
            all.append(rest);
            all
        };
        match hir[stmt].kind {
            StmtKind::Block(inner) => return self.body(followed_by(inner, &mut rest)),
            StmtKind::If { cond, then, otherwise } => {
                if let Some(known) = known_bool(hir, cond) {
                    return self.body(followed_by(if known { then } else { otherwise }, &mut rest));
                }
                let condition = self.value(cond);
                let (mut then, mut otherwise) = (hir[then].to_vec(), hir[otherwise].to_vec());
                if always_returns(hir, &then) {
                    otherwise.append(&mut rest);
                } else if always_returns(hir, &otherwise) {
                    then.append(&mut rest);
                }
                let (accept, _) = self.nested(|b| b.body(then));
                let (reject, _) = self.nested(|b| b.body(otherwise));
                self.push(Stmt::If { condition, accept, reject });
            }
            StmtKind::Return(_) => {
                rest.clear();
                self.statement(stmt);
            }
            _ => self.statement(stmt),
        }
        if let (false, Some(flag)) = (rest.is_empty(), self.leaving.and_then(|leaving| leaving.flag)) {
            let condition = self.load(flag);
            let (reject, _) = self.nested(|b| b.body(rest));
            self.push(Stmt::If { condition, accept: Block::new(), reject });
        }
    }

    /// Returns from the function that is part of this one.
    pub fn return_inlined(&mut self, leaving: Leaving, value: Option<ExprId>) {
        match (value, leaving.result) {
            (Some(value), Some(result)) => {
                let value = self.value(value);
                self.store(result, value);
            }
            (Some(value), None) => self.effect(value),
            (None, _) => {}
        }
        if let Some(flag) = leaving.flag {
            let returned = self.literal(Scalar::Bool, 1);
            self.store(flag, returned);
        }
        if self.breakable > leaving.breakable {
            self.push(Stmt::Break);
        }
    }

    /// After a loop or switch within another one: leaves that too if the function has returned.
    pub fn leave_outer(&mut self, inner: StmtId) {
        if let Some(Leaving { flag: Some(flag), breakable, .. }) = self.leaving
            && self.breakable > breakable
            && leaves(self.cx.hir, inner)
        {
            let condition = self.load(flag);
            let (accept, _) = self.nested(|b| b.push(Stmt::Break));
            self.push(Stmt::If { condition, accept, reject: Block::new() });
        }
    }
}
