//! Calling conventions: the parameters that a copy of a function is specialized for, and those that it reads in place.

use rustc_hash::FxHashSet;

use crate::{
    ast::List,
    hir::{ConstId, ExprFlags, ExprId, ExprKind, FuncId, GlobalId, GlobalStorage, LocalId, Module, Type, VarFlags},
};

/// The maximum number of globals that are visited to determine which each function writes. A chain of ten thousand
/// functions that write one each would use all memory.
const MAX_WRITES: usize = 1 << 22;

/// A user function with its specializations for samplers and for arrays that it only reads, in order.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Instance {
    pub func: FuncId,
    pub specializations: Box<[Specialization]>,
}

/// A compile-time value that replaces a parameter in a copy of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) enum Specialization {
    /// Passed at run time.
    None,
    /// The channel of a sampler.
    Channel(u8),
    /// A global that neither the function nor its callees write: the parameter is that global.
    Global(GlobalId),
    /// A constant table.
    Table(ConstId),
}

/// The argument of a call for a specializable parameter.
#[derive(Clone, Copy, Debug)]
pub(super) enum SpecializedArgument {
    Known(Specialization),
    /// The caller's own specialization of a parameter, by its index among the specializable ones.
    Param(usize),
}

/// The calling conventions of a module.
pub(super) struct Arguments {
    /// Locals that some call passes as a whole for a parameter that is indexed, in the callee or in functions it calls
    /// in turn; by [`LocalId::index`]. They are in memory, as if they were indexed themselves: the call then reads them
    /// in place.
    pub forwarded: Vec<bool>,
    /// Globals that a function or its callees write, by [`FuncId::index`]; `None` if there are too many, so any may be
    /// written.
    written: Vec<Option<FxHashSet<GlobalId>>>,
    /// The specializable parameters of each function, in order.
    specializable: Vec<Vec<LocalId>>,
    /// The number of expressions that name each constant, by [`ConstId::index`].
    named: Vec<u32>,
    /// See [`Options::table`](super::context::Options::table).
    table: usize,
}

impl Arguments {
    /// `writes` contains the globals that each function itself writes, by [`FuncId::index`].
    pub(super) fn new(module: &Module, writes: Vec<FxHashSet<GlobalId>>, table: usize) -> Self {
        let mut written: Vec<_> = writes.into_iter().map(Some).collect();
        let mut work = 0;
        for &func in &module.call_order {
            let mut all = written[func.index()].take();
            for callee in &module[func].calls {
                let of_callee = written[callee.index()].as_ref();
                work += of_callee.map_or(0, FxHashSet::len);
                match (&mut all, of_callee.filter(|_| work <= MAX_WRITES)) {
                    (Some(all), Some(of_callee)) => all.extend(of_callee),
                    _ => all = None,
                }
            }
            written[func.index()] = all;
        }
        let mut named = vec![0; module.consts.len()];
        for expr in &module.exprs {
            if let ExprKind::Const(id) = expr.kind {
                named[id.index()] += 1;
            }
        }
        let specializable = vec![Vec::new(); module.functions.len()];
        let mut made = Self { forwarded: forwarded_locals(module), written, specializable, named, table };
        for &func in &module.call_order {
            let first = module[func].locals.start as usize;
            let params = (first..first + module.params(func).len()).map(LocalId::new);
            made.specializable[func.index()] = params.filter(|&param| made.is_specializable(module, param)).collect();
        }
        made
    }

    /// Returns whether a constant is a table rather than a few numbers in one call: the latter are cheaper to store in
    /// memory where they are used than at the start of every invocation.
    fn is_table(&self, module: &Module, id: ConstId) -> bool {
        self.named[id.index()] > 1 || module[module[id].words].len() >= self.table
    }

    pub(super) fn specializable(&self, func: FuncId) -> &[LocalId] {
        &self.specializable[func.index()]
    }

    pub(super) fn is_specializable(&self, module: &Module, param: LocalId) -> bool {
        matches!(module.types.get(module[param].ty), Type::Sampler { .. }) || self.reads_in_place(module, param)
    }

    /// Returns whether a function or one of its callees writes a global.
    pub(super) fn writes(&self, func: FuncId, global: GlobalId) -> bool {
        self.written[func.index()].as_ref().is_none_or(|written| written.contains(&global))
    }

    /// Returns whether a local is indexed, in its function or in a callee that it is passed to as a whole.
    pub(super) fn is_indexed(&self, module: &Module, local: LocalId) -> bool {
        module[local].flags.contains(VarFlags::INDEXED) || self.forwarded[local.index()]
    }

    /// Returns whether a parameter is only read, but indexed in a way that values cannot be: it is then a pointer to
    /// the caller's argument, or the argument itself, instead of a copy that each call fills element by element.
    pub(super) fn reads_in_place(&self, module: &Module, param: LocalId) -> bool {
        let declared = &module[param];
        !declared.kind.copies_out()
            && self.is_indexed(module, param)
            && !declared.flags.contains(VarFlags::WRITTEN)
            && !matches!(module.types.get(declared.ty), Type::Scalar(_) | Type::Vector { .. } | Type::Sampler { .. })
    }

    /// Returns the arguments of a call in `caller` (`None` for an initialiser) for the specializable parameters.
    pub(super) fn passed(
        &self,
        module: &Module,
        caller: Option<FuncId>,
        func: FuncId,
        args: &[ExprId],
    ) -> Vec<SpecializedArgument> {
        let first = module[func].locals.start as usize;
        let last_effect = last_effect(module, args);
        let passed = self.specializable(func).iter().map(|param| {
            let place = param.index() - first;
            // If a later argument changes the value, it is not the passed one.
            let changes = last_effect > Some(place);
            match module[args[place]].kind {
                ExprKind::Channel(channel) => SpecializedArgument::Known(Specialization::Channel(channel)),
                ExprKind::Const(table) if self.is_table(module, table) => {
                    SpecializedArgument::Known(Specialization::Table(table))
                }
                ExprKind::Global(global) if module[global].storage == GlobalStorage::Private => {
                    let declared = &module[global];
                    let stays = !changes && !self.writes(func, global);
                    SpecializedArgument::Known(match (declared.flags.contains(VarFlags::WRITTEN), declared.value) {
                        (false, Some(value)) => Specialization::Table(value),
                        // Nothing sets it: it is zero.
                        (false, None) if declared.init.is_none() => Specialization::None,
                        _ if stays => Specialization::Global(global),
                        _ => Specialization::None,
                    })
                }
                ExprKind::Local(local) => {
                    let specializable = caller.map_or(&[][..], |caller| self.specializable(caller));
                    // They are sorted.
                    match specializable.binary_search(&local) {
                        Ok(param) => SpecializedArgument::Param(param),
                        Err(_) => SpecializedArgument::Known(Specialization::None),
                    }
                }
                _ => SpecializedArgument::Known(Specialization::None),
            }
        });
        passed.collect()
    }
}

/// Returns the last argument whose evaluation has effects.
pub(super) fn last_effect(module: &Module, args: &[ExprId]) -> Option<usize> {
    args.iter().rposition(|&arg| module[arg].flags.contains(ExprFlags::EFFECTS))
}

/// See [`Arguments::forwarded`].
fn forwarded_locals(module: &Module) -> Vec<bool> {
    let mut found = vec![false; module.locals.len()];
    let mut order = vec![usize::MAX; module.functions.len()];
    for (i, func) in module.call_order.iter().enumerate() {
        order[func.index()] = i;
    }
    let mut calls: Vec<(FuncId, List<ExprId>)> = Vec::new();
    for expr in &module.exprs {
        if let ExprKind::Call { func, args } = expr.kind {
            calls.push((func, args));
        }
    }
    // A function's own calls come before all calls of it, so its indexed parameters are known by then.
    calls.sort_by_key(|(func, _)| order[func.index()]);
    for (func, args) in calls {
        let first = module[func].locals.start as usize;
        for (i, &arg) in module[args].iter().enumerate() {
            let param = LocalId::new(first + i);
            let indexed = module[param].flags.contains(VarFlags::INDEXED) || found[param.index()];
            if let (true, ExprKind::Local(local)) = (indexed, module[arg].kind) {
                found[local.index()] = true;
            }
        }
    }
    found
}
