//! Large global arrays that the program fills with constants before anything else: they are tables, and need not be
//! filled at run time.
//!
//! GLSL ES 1.00 had no array constructors, so a scene is often written as `triangles[0].a = vec3(..); triangles[1].a =
//! ..` in a function that `mainImage` calls first. In memory such an array is thousands of stores in one block, once
//! for its zeros and once for its values, and LLVM's time for a block grows faster than the square of their number: 550
//! triangles take lavapipe minutes, while Mesa's OpenGL, which sees the constants and needs no zeros, takes a second.
//! As a table (`emit/tables.rs`) they are a buffer.
//!
//! This is detected in the checked program and not by a pass over the IR, because lowering depends on it: an array that
//! is a table can replace a parameter, and then its function has a copy for it ([`super::arguments`]). After lowering,
//! each call would copy the array.

use super::walk as writes;
use crate::{
    ast::List,
    hir::{ExprId, ExprKind, GlobalId, GlobalStorage, Module, Stmt, StmtId, StmtKind, Swizzle, Type, TypeId, VarFlags},
};

/// The maximum number of arrays considered in one program: one bit each.
const MAX_ARRAYS: usize = 64;

/// The maximum number of members of a structure, which are counted for each store.
const MAX_MEMBERS: usize = 64;

/// The maximum call depth at which an array may be filled.
const MAX_CALL_DEPTH: u32 = 16;

/// Turns arrays of at least `least` scalars that are filled with constants before anything else into constants, and
/// removes the statements that fill them.
pub(crate) fn arrays_to_constants(module: &mut Module, min_len: usize) {
    let Some(entry) = module.entry else { return };
    let mut arrays = candidates(module, min_len);
    if arrays.is_empty() {
        return;
    }
    let calls = call_counts(module);
    let mut search = Search { module: &*module, arrays: &mut arrays, named: Vec::new(), calls };
    search.note_names();
    search.global_initialisers();
    search.statements(module[entry].body.unwrap_or(List::EMPTY), 0);
    for array in arrays {
        array.make_constant(module);
    }
}

/// A global array and the constants stored in it first.
struct Array {
    global: GlobalId,
    words: Vec<u32>,
    /// The statements that only store constants in the array.
    stores: Vec<StmtId>,
    /// The number of expressions that write the array: all, and those in these statements.
    written: usize,
    seen: usize,
    /// The array may have been read: later stores are not initial values.
    is_open: bool,
}

fn candidates(module: &Module, min_len: usize) -> Vec<Array> {
    let mut found = Vec::new();
    for (i, global) in module.globals.iter().enumerate() {
        let is_array = matches!(module.types.get(global.ty), Type::Array { .. });
        let varies = global.init.is_some() && global.value.is_none();
        if global.storage != GlobalStorage::Private
            || !is_array
            || varies
            || !global.flags.contains(VarFlags::WRITTEN)
            || !global.flags.contains(VarFlags::INDEXED)
            || found.len() == MAX_ARRAYS
        {
            continue;
        }
        let size = words(module, global.ty);
        if size < min_len || members(module, global.ty) > MAX_MEMBERS {
            continue;
        }
        let first = global.value.map_or_else(|| vec![0; size], |value| module[module[value].words].to_vec());
        let global = GlobalId::new(i);
        found.push(Array { global, words: first, stores: Vec::new(), written: 0, seen: 0, is_open: true });
    }
    if found.is_empty() {
        return found;
    }
    for i in 0..module.exprs.len() {
        writes::places(module, ExprId::new(i), |place| {
            if let ExprKind::Global(global) = module[module.root(place)].kind
                && let Some(array) = found.iter_mut().find(|array| array.global == global)
            {
                array.written += 1;
            }
        });
    }
    found
}

/// Counts the members of the structures that are an array's elements.
fn members(module: &Module, ty: TypeId) -> usize {
    match module.types.get(ty) {
        Type::Array { element, .. } => members(module, element),
        Type::Struct(id) => module[id].members.len(),
        _ => 0,
    }
}

/// Counts the scalars of a type.
fn words(module: &Module, ty: TypeId) -> usize {
    match module.types.get(ty) {
        Type::Array { element, len } => words(module, element) * len as usize,
        Type::Struct(id) => module[module[id].members].iter().map(|member| words(module, member.ty)).sum(),
        _ => module.types.components(ty).unwrap_or(0) as usize,
    }
}

/// Counts the expressions that call each function, by [`FuncId::index`](crate::hir::FuncId::index).
fn call_counts(module: &Module) -> Vec<u32> {
    let mut counts = vec![0; module.functions.len()];
    for expr in &module.exprs {
        if let ExprKind::Call { func, .. } = expr.kind {
            counts[func.index()] += 1;
        }
    }
    counts
}

struct Search<'a> {
    module: &'a Module,
    arrays: &'a mut [Array],
    /// The arrays that each function or its callees name, by [`FuncId::index`](crate::hir::FuncId::index): one bit
    /// each.
    named: Vec<u64>,
    calls: Vec<u32>,
}

impl<'a> Search<'a> {
    fn note_names(&mut self) {
        self.named = vec![0; self.module.functions.len()];
        for &func in &self.module.call_order {
            let exprs = self.module[func].exprs.clone();
            self.named[func.index()] = exprs.fold(0, |all, expr| all | self.names(ExprId::new(expr as usize)));
        }
    }

    /// Returns the arrays that an expression or its callees name.
    fn names(&self, expr: ExprId) -> u64 {
        match self.module[expr].kind {
            ExprKind::Global(global) => {
                let at = self.arrays.iter().position(|array| array.global == global);
                at.map_or(0, |at| 1 << at)
            }
            ExprKind::Call { func, .. } => self.named[func.index()],
            _ => 0,
        }
    }

    /// Closes the arrays that run-time initialisers of globals name.
    fn global_initialisers(&mut self) {
        let module = self.module;
        for global in &module.globals {
            if let (Some(init), None) = (global.init, global.value) {
                self.close(&[], &[init]);
            }
        }
    }

    /// Closes the arrays that statements and expressions name: these run, and may read and write them.
    fn close(&mut self, stmts: &[StmtId], exprs: &[ExprId]) {
        let mut named = 0;
        super::walk::walk(self.module, stmts, exprs, |node, _| {
            if let super::walk::Node::Expr(expr) = node {
                named |= self.names(expr);
            }
        });
        for (i, array) in self.arrays.iter_mut().enumerate() {
            array.is_open &= named & (1 << i) == 0;
        }
    }

    /// Visits the statements of a function in execution order; `calls` is the depth of calls that lead to it. Returns
    /// `false` if control may not reach their end. For the entry point the result is irrelevant, as nothing follows it.
    fn statements(&mut self, list: List<StmtId>, calls: u32) -> bool {
        let module = self.module;
        for (i, &stmt) in module[list].iter().enumerate() {
            if self.arrays.iter().all(|array| !array.is_open) {
                return true;
            }
            let continues = match module[stmt].kind {
                StmtKind::Block(inner) => self.statements(inner, calls),
                StmtKind::Expr(expr) => {
                    self.statement(stmt, expr, calls);
                    true
                }
                _ => {
                    self.close(&[stmt], &[]);
                    calls == 0 || !may_leave(module, stmt)
                }
            };
            if !continues {
                self.close(&module[list][i + 1..], &[]);
                return false;
            }
        }
        true
    }

    fn statement(&mut self, stmt: StmtId, expr: ExprId, calls: u32) {
        let module = self.module;
        if let ExprKind::Call { func, args } = module[expr].kind
            && self.calls[func.index()] == 1
            && calls < MAX_CALL_DEPTH
        {
            self.close(&[], &module[args]);
            self.statements(module[func].body.unwrap_or(List::EMPTY), calls + 1);
            return;
        }
        match self.store(expr) {
            Some(Store { at, from, components, value }) => {
                let array = &mut self.arrays[at];
                for (i, &word) in value.iter().enumerate() {
                    array.words[from + components.map_or(i, |components| components.get(i))] = word;
                }
                array.stores.push(stmt);
                array.seen += 1;
            }
            None => self.close(&[], &[expr]),
        }
    }

    fn store(&self, expr: ExprId) -> Option<Store<'a>> {
        let module = self.module;
        let ExprKind::Assign { place, value } = module[expr].kind else { return None };
        let value = match &module[value].kind {
            ExprKind::Literal(bits) => std::slice::from_ref(bits),
            ExprKind::Const(id) => &module[module[*id].words],
            _ => return None,
        };
        let mut from = 0;
        let (mut part, components) = match module[place].kind {
            ExprKind::Swizzle { base, swizzle } => (base, Some(swizzle)),
            _ => (place, None),
        };
        loop {
            match module[part].kind {
                ExprKind::Global(global) => {
                    let at = self.arrays.iter().position(|array| array.global == global)?;
                    return self.arrays[at].is_open.then_some(Store { at, from, components, value });
                }
                ExprKind::Member { base, index } => {
                    let Type::Struct(id) = module.types.get(module[base].ty) else { return None };
                    let before = &module[module[id].members][..index as usize];
                    from += before.iter().map(|member| words(module, member.ty)).sum::<usize>();
                    part = base;
                }
                ExprKind::Index { base, index } => {
                    let ExprKind::Literal(index) = module[index].kind else { return None };
                    let element = words(module, module[part].ty);
                    if index as usize * element >= words(module, module[base].ty) {
                        return None;
                    }
                    from += index as usize * element;
                    part = base;
                }
                _ => return None,
            }
        }
    }
}

/// An assignment of a constant to a part of an array.
struct Store<'a> {
    /// The index of the array among the considered ones.
    at: usize,
    /// The offset of the part in scalars.
    from: usize,
    /// The stored components, if the part is a vector and not all are stored.
    components: Option<Swizzle>,
    value: &'a [u32],
}

/// Returns whether a statement can return from its function.
fn may_leave(module: &Module, stmt: StmtId) -> bool {
    let mut leaves = false;
    super::walk::walk(module, &[stmt], &[], |node, _| {
        if let super::walk::Node::Stmt(stmt) = node {
            leaves |= matches!(module[stmt].kind, StmtKind::Return(_) | StmtKind::Discard);
        }
    });
    leaves
}

impl Array {
    /// Turns the array into a constant if nothing else writes it.
    fn make_constant(self, module: &mut Module) {
        if self.seen != self.written || self.seen == 0 {
            return;
        }
        let ty = module[self.global].ty;
        let value = module.constant(ty, &self.words);
        let global = &mut module[self.global];
        global.value = Some(value);
        global.flags.remove(VarFlags::WRITTEN);
        for stmt in self.stores {
            let Stmt { kind, .. } = &mut module[stmt];
            *kind = StmtKind::Block(List::EMPTY);
        }
    }
}
