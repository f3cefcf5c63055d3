//! The size of a program once every call is written out, as every driver writes it.
//!
//! A shader has no stack: thirty functions of which each calls the one before twice are a billion copies of the first.
//! A driver that is handed such a program takes all memory and minutes before it gives up, and there is no simpler code
//! for it, so it is an error here.

use super::checker::Checker;
use crate::{
    ast::{List, Loc},
    hir::{ExprId, ExprKind, FuncId, Module},
    lower::reached,
};

/// Expressions and statements of a program with all calls written out.
pub(super) const MAX_PROGRAM: u64 = 1 << 20;

impl Checker<'_> {
    /// Judges a program without errors.
    pub(super) fn finish_size(&mut self) {
        let quick = quick_sizes(&self.module);
        let Some(func) = too_large(&self.module, &self.global_calls, &quick) else {
            self.bulk = bulk(&self.module, &quick);
            return;
        };
        let name = self.module[func].name;
        let text = self.name(name.symbol);
        let message = format!("with all calls inlined `{text}` has more than {MAX_PROGRAM} operations");
        self.error(name, message);
        self.hint("a graphics driver inlines every call: call repeated functions in a loop instead");
    }
}

/// The innermost function that is too large with what it calls, of those that are reached from the entry point or, by
/// these calls, from what globals begin with.
fn too_large(module: &Module, of_globals: &[FuncId], quick: &[u64]) -> Option<FuncId> {
    quick.iter().find(|&&size| size > MAX_PROGRAM)?;
    let of = |func: FuncId| reached(module, module[func].body.unwrap_or(List::EMPTY));
    let exact = sizes(module, |func, sizes| {
        let (nodes, calls) = of(func);
        calls.into_iter().fold(nodes as u64, |size, callee| size.saturating_add(sizes[callee.index()]))
    });
    let is_large = |func: &FuncId| exact[func.index()] > MAX_PROGRAM;
    let mut found = module.entry.into_iter().chain(of_globals.iter().copied()).find(is_large)?;
    while let Some(callee) = of(found).1.into_iter().find(is_large) {
        found = callee;
    }
    Some(found)
}

/// Returns the name of the innermost function that holds half of a program with what it calls.
fn bulk(module: &Module, sizes: &[u64]) -> Option<Loc> {
    let mut found = module.entry?;
    let half = sizes[found.index()] / 2;
    while let Some(callee) = calls(module, found).find(|callee| sizes[callee.index()] > half) {
        found = callee;
    }
    Some(module[found].name.into())
}

/// Returns the size of each function that is called by what stands in the text, which is quick: what is left out, and
/// what folding left behind, counts too.
fn quick_sizes(module: &Module) -> Vec<u64> {
    sizes(module, |func, sizes| {
        let own = u64::from(module[func].exprs.end - module[func].exprs.start);
        calls(module, func).fold(own, |size, callee| size.saturating_add(sizes[callee.index()]))
    })
}

/// Returns what a function calls, as often as it does.
fn calls(module: &Module, func: FuncId) -> impl Iterator<Item = FuncId> {
    module[func].exprs.clone().filter_map(|expr| match module[ExprId::new(expr as usize)].kind {
        ExprKind::Call { func, .. } => Some(func),
        _ => None,
    })
}

/// The size of each function that is called, by [`FuncId::index`], from those of what it calls.
fn sizes(module: &Module, size: impl Fn(FuncId, &[u64]) -> u64) -> Vec<u64> {
    let mut sizes = vec![0; module.functions.len()];
    for &func in &module.call_order {
        sizes[func.index()] = size(func, &sizes);
    }
    sizes
}
