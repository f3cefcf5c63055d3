//! Calls of small functions, replaced by what they do.
//!
//! Every driver does that sooner or later. OpenGL's compilers do it before they join constants and look for what is computed
//! twice, across the borders that the author drew; a SPIR-V driver finds most of that done for each function alone, and last
//! bits come out differently (see [`super::regroup`]).

use naga::Statement;

use super::{
    calls::Given,
    function::{Builder, Value},
    reach::known_bool,
    walk::{Node, walk},
};
use crate::glsl::{
    ast::List,
    hir::{ExprKind, FuncId, Module, StmtId, StmtKind, TypeId},
};

/// Expressions and statements of a function, with those of what is inlined into it, that are written again for each call.
const LARGEST: usize = 256;

/// As many of a whole program, after inlining. What would be larger inlines smaller functions only: texts that call one function
/// a million times must not become so many copies.
const LARGEST_PROGRAM: usize = 1 << 17;

/// Which functions are inlined wherever they are called, by [`FuncId::index`].
pub(super) fn inlined(module: &Module) -> Vec<bool> {
    let mut straight = vec![false; module.functions.len()];
    for &func in &module.call_order {
        let body = module[func].body.unwrap_or(List::EMPTY);
        straight[func.index()] = Some(func) != module.entry && is_straight(module, &module[body]);
    }
    let mut largest = LARGEST;
    loop {
        let mut sizes = vec![0usize; module.functions.len()];
        let mut program = 0usize;
        for &func in &module.call_order {
            let inlined = |func: FuncId| straight[func.index()] && sizes[func.index()] <= largest;
            let size = size(module, module[func].body.unwrap_or(List::EMPTY), |callee| match inlined(callee) {
                true => sizes[callee.index()],
                false => 0,
            });
            sizes[func.index()] = size;
            if !straight[func.index()] || size > largest {
                program = program.saturating_add(size);
            }
        }
        if program <= LARGEST_PROGRAM || largest == 0 {
            return straight.iter().zip(sizes).map(|(straight, size)| *straight && size <= largest).collect();
        }
        largest /= 4;
    }
}

/// Whether a body leaves at its end alone, or in branches that do nothing else after it.
fn is_straight(module: &Module, mut list: &[StmtId]) -> bool {
    while let Some((&first, rest)) = list.split_first() {
        match module[first].kind {
            StmtKind::Return(_) => return rest.is_empty(),
            StmtKind::If { cond, then, otherwise } if leaves(module, first) => {
                let (then, otherwise) = (&module[then], &module[otherwise]);
                if known_bool(module, cond).is_some() || !always_returns(module, then) || !is_straight(module, then) {
                    return false;
                }
                if !otherwise.is_empty() {
                    return rest.is_empty() && always_returns(module, otherwise) && is_straight(module, otherwise);
                }
            }
            _ if leaves(module, first) => return false,
            _ => {}
        }
        list = rest;
    }
    true
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
    walk(module, &module[body], &[], |node| {
        size += 1;
        if let Node::Expr(expr) = node
            && let ExprKind::Call { func, .. } = module[expr].kind
        {
            size = size.saturating_add(of_call(func));
        }
    });
    size
}

impl Builder<'_, '_> {
    /// Does what a function does with these arguments, which are as [`Builder::call`] would pass them; `None` if it is void.
    pub fn inline(&mut self, func: FuncId, given: Box<[Given]>, arguments: Vec<Value>) -> Option<Value> {
        let hir = self.cx.hir;
        let function = &hir[func];
        let outer = self.enter(func, given);
        let mut arguments = arguments.into_iter();
        self.parameters(func, |_, _| arguments.next().expect("an argument for each parameter"));
        let body = &hir[function.body.unwrap_or(List::EMPTY)];
        let value = if function.result == TypeId::VOID {
            self.straight(body, None);
            None
        } else if let Some((&last, rest)) = body.split_last()
            && let StmtKind::Return(Some(value)) = hir[last].kind
            && !rest.iter().any(|&stmt| leaves(hir, stmt))
        {
            self.straight(rest, None);
            Some(self.value(value))
        } else {
            let result = self.temporary(function.result);
            if !always_returns(hir, body) {
                // Falling off the end gives zero.
                let zero = self.zero(function.result);
                self.store(result, zero);
            }
            self.straight(body, Some(result));
            Some(self.load(result))
        };
        self.leave(outer);
        value
    }

    /// The statements of a body that [`is_straight`]; what it returns goes to `result`.
    fn straight(&mut self, list: &[StmtId], result: Option<Value>) {
        let hir = self.cx.hir;
        for (i, &stmt) in list.iter().enumerate() {
            match hir[stmt].kind {
                StmtKind::Return(value) => match (value, result) {
                    (Some(value), Some(result)) => {
                        let value = self.value(value);
                        self.store(result, value);
                    }
                    (Some(value), None) => self.effect(value),
                    (None, _) => {}
                },
                StmtKind::If { cond, then, otherwise } if leaves(hir, stmt) => {
                    let condition = self.value(cond);
                    let (then, otherwise) = (&hir[then], &hir[otherwise]);
                    let otherwise = if otherwise.is_empty() { &list[i + 1..] } else { otherwise };
                    let (accept, _) = self.branch_block(|b| b.straight(then, result));
                    let (reject, _) = self.branch_block(|b| b.straight(otherwise, result));
                    self.push(Statement::If { condition, accept, reject });
                    return;
                }
                _ => self.statement(stmt),
            }
        }
    }
}
