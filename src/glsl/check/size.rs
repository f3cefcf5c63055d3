//! The size of a program once every call is written out, as every driver writes it.
//!
//! A shader has no stack: thirty functions of which each calls the one before twice are a billion copies of the first.
//! A driver that is handed such a program takes all memory and minutes before it gives up, and there is no simpler code
//! for it, so it is an error here.

use super::checker::Checker;
use crate::glsl::{
    ast::List,
    hir::{ExprId, ExprKind, FuncId, Module},
    lower::reached,
};

/// Expressions and statements of a program with all calls written out.
pub(super) const MAX_PROGRAM: u64 = 1 << 20;

impl Checker<'_> {
    /// Judges a program without errors.
    pub(super) fn finish_size(&mut self) {
        let Some(func) = too_large(&self.module, &self.global_calls) else { return };
        let name = self.module[func].name;
        let text = self.name(name.symbol);
        let message = format!("with all calls written out `{text}` has more than {MAX_PROGRAM} operations");
        self.error(name, message);
        self.hint(
            "a graphics driver copies a function to each of its calls, and all that it calls with it: \
             call what is called twice in a loop instead",
        );
    }
}

/// The innermost function that is too large with what it calls, of those that are reached from the entry point or, by
/// these calls, from what globals begin with.
fn too_large(module: &Module, of_globals: &[FuncId]) -> Option<FuncId> {
    // By what stands in the text, which is quick: what is left out, and what folding left behind, counts too.
    let quick = sizes(module, |func, sizes| {
        let function = &module[func];
        let mut size = u64::from(function.exprs.end - function.exprs.start);
        for expr in function.exprs.clone() {
            if let ExprKind::Call { func, .. } = module[ExprId::new(expr as usize)].kind {
                size = size.saturating_add(sizes[func.index()]);
            }
        }
        size
    });
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

/// The size of each function that is called, by [`FuncId::index`], from those of what it calls.
fn sizes(module: &Module, size: impl Fn(FuncId, &[u64]) -> u64) -> Vec<u64> {
    let mut sizes = vec![0; module.functions.len()];
    for &func in &module.call_order {
        sizes[func.index()] = size(func, &sizes);
    }
    sizes
}
