//! The size of a program after inlining all calls, as every driver does.
//!
//! A shader has no stack: with thirty functions, each of which calls the previous one twice, there are a billion copies
//! of the first. A driver that receives such a program uses all memory and takes minutes before it fails, and no
//! simpler code can be generated for it, so it is an error here.

use super::checker::Checker;
use crate::{
    ast::{List, Loc},
    hir::{ExprId, ExprKind, FuncId, Module},
    lower::reached,
};

/// The maximum number of expressions and statements of a program with all calls inlined.
pub(super) const MAX_PROGRAM: u64 = 1 << 20;

impl Checker<'_> {
    /// Checks the size of an error-free program.
    pub(super) fn finish_size(&mut self) {
        let quick = quick_sizes(&self.module);
        let Some(func) = too_large(&self.module, &self.global_calls, &quick) else {
            self.largest_function = largest_function(&self.module, &quick);
            return;
        };
        let name = self.module[func].name;
        let text = self.name(name.symbol);
        let message = format!("with all calls inlined `{text}` has more than {MAX_PROGRAM} operations");
        self.error(name, message);
        self.hint("a graphics driver inlines every call: call repeated functions in a loop instead");
    }
}

/// Returns the innermost function that is too large including its callees, among those that are reachable from the
/// entry point or, through `of_globals`, from the initialisers of globals.
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

/// Returns the name of the innermost function that, including its callees, makes up more than half of a program.
fn largest_function(module: &Module, sizes: &[u64]) -> Option<Loc> {
    let mut found = module.entry?;
    let half = sizes[found.index()] / 2;
    while let Some(callee) = calls(module, found).find(|callee| sizes[callee.index()] > half) {
        found = callee;
    }
    Some(module[found].name.into())
}

/// Returns an upper bound of the size of each called function, which is fast to compute: it also counts excluded
/// branches and expressions left over from folding.
fn quick_sizes(module: &Module) -> Vec<u64> {
    sizes(module, |func, sizes| {
        let own = u64::from(module[func].exprs.end - module[func].exprs.start);
        calls(module, func).fold(own, |size, callee| size.saturating_add(sizes[callee.index()]))
    })
}

/// Returns the callees of a function, once for each call.
fn calls(module: &Module, func: FuncId) -> impl Iterator<Item = FuncId> {
    module[func].exprs.clone().filter_map(|expr| match module[ExprId::new(expr as usize)].kind {
        ExprKind::Call { func, .. } => Some(func),
        _ => None,
    })
}

/// Returns the size of each called function, by [`FuncId::index`], computed from those of its callees.
fn sizes(module: &Module, size: impl Fn(FuncId, &[u64]) -> u64) -> Vec<u64> {
    let mut sizes = vec![0; module.functions.len()];
    for &func in &module.call_order {
        sizes[func.index()] = size(func, &sizes);
    }
    sizes
}
