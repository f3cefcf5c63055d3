//! Calls of user functions, and how arguments are handed over: without a copy wherever nobody can see the difference.

use std::collections::HashSet;

use naga::{Expression, Statement};

use super::{
    Instance,
    access::Place,
    function::{Builder, Slot, Value},
    tables::NOT_UNROLLED,
    writes,
};
use crate::glsl::hir::{
    ConstId, ExprFlags, ExprId, ExprKind, FuncId, GlobalId, GlobalStorage, Local, LocalId, LocalKind, Module, Type,
    TypeId, VarFlags,
};

/// What a copy of a function has in place of one of its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) enum Given {
    /// An argument, after all.
    Argument,
    /// The channel a sampler stands for.
    Channel(u8),
    /// A global that neither the function nor what it calls writes: the parameter is that global.
    Global(GlobalId),
    /// A table.
    Table(ConstId),
}

/// What a call passes for such a parameter.
#[derive(Clone, Copy, Debug)]
pub(super) enum Passed {
    Known(Given),
    /// What the caller itself has for one of its parameters, counted among those that can be given.
    Param(usize),
}

/// How arguments are handed over in a module.
pub(super) struct Arguments {
    /// Which locals some call takes as a whole for a parameter that is indexed, there or in what it calls in turn; by
    /// [`LocalId::index`]. They are memory, as if they were indexed themselves: the call then reads them where they are.
    pub handed_on: Vec<bool>,
    /// Which globals a function or what it calls writes, by [`FuncId::index`].
    written: Vec<HashSet<GlobalId>>,
    /// Parameters of each function that a copy of it can have something in place of, in order.
    givable: Vec<Vec<LocalId>>,
    /// How many expressions name each constant, by [`ConstId::index`].
    named: Vec<u32>,
}

impl Arguments {
    /// `writes` has the globals that each function itself writes, by [`FuncId::index`].
    pub fn new(module: &Module, writes: Vec<HashSet<GlobalId>>) -> Self {
        let mut written = writes;
        for &func in &module.call_order {
            let mut all = std::mem::take(&mut written[func.index()]);
            for callee in &module[func].calls {
                all.extend(&written[callee.index()]);
            }
            written[func.index()] = all;
        }
        let mut named = vec![0; module.consts.len()];
        for expr in &module.exprs {
            if let ExprKind::Const(id) = expr.kind {
                named[id.index()] += 1;
            }
        }
        let givable = vec![Vec::new(); module.functions.len()];
        let mut made = Self { handed_on: handed_on(module), written, givable, named };
        for &func in &module.call_order {
            let first = module[func].locals.start as usize;
            let params = (first..first + module.params(func).len()).map(LocalId::new);
            made.givable[func.index()] = params.filter(|&param| made.is_givable(module, param)).collect();
        }
        made
    }

    /// Whether a constant is a table rather than a few numbers written into one call: those are cheaper put into memory where
    /// they are needed than at the start of every invocation.
    fn is_table(&self, module: &Module, id: ConstId) -> bool {
        self.named[id.index()] > 1 || module[module[id].words].len() >= NOT_UNROLLED as usize
    }

    pub fn givable(&self, func: FuncId) -> &[LocalId] {
        &self.givable[func.index()]
    }

    pub fn is_givable(&self, module: &Module, param: LocalId) -> bool {
        matches!(module.types.get(module[param].ty), Type::Sampler { .. }) || self.reads_in_place(module, param)
    }

    /// Whether a function or what it calls writes a global.
    pub fn writes(&self, func: FuncId, global: GlobalId) -> bool {
        self.written[func.index()].contains(&global)
    }

    /// Whether a local is indexed, in its function or in one it is handed to as a whole.
    pub fn is_indexed(&self, module: &Module, local: LocalId) -> bool {
        module[local].flags.contains(VarFlags::INDEXED) || self.handed_on[local.index()]
    }

    /// Whether a parameter is only read, but indexed in a way values cannot be: then it is a pointer to what the caller has, or
    /// that itself, and not a copy that each call fills anew, element by element.
    pub fn reads_in_place(&self, module: &Module, param: LocalId) -> bool {
        let declared = &module[param];
        !declared.kind.copies_out()
            && self.is_indexed(module, param)
            && !declared.flags.contains(VarFlags::WRITTEN)
            && !matches!(module.types.get(declared.ty), Type::Scalar(_) | Type::Vector { .. } | Type::Sampler { .. })
    }

    /// What a call in `caller` (none: an initialiser) passes for those.
    pub fn passed(&self, module: &Module, caller: Option<FuncId>, func: FuncId, args: &[ExprId]) -> Vec<Passed> {
        let first = module[func].locals.start as usize;
        let passed = self.givable(func).iter().map(|param| {
            let place = param.index() - first;
            // What a later argument changes is not what was passed.
            let changes = args[place + 1..].iter().any(|&arg| module[arg].flags.contains(ExprFlags::EFFECTS));
            match module[args[place]].kind {
                ExprKind::Channel(channel) => Passed::Known(Given::Channel(channel)),
                ExprKind::Const(table) if self.is_table(module, table) => Passed::Known(Given::Table(table)),
                ExprKind::Global(global) if module[global].storage == GlobalStorage::Private => {
                    let declared = &module[global];
                    let stays = !changes && !self.writes(func, global);
                    Passed::Known(match (declared.flags.contains(VarFlags::WRITTEN), declared.value) {
                        (false, Some(value)) => Given::Table(value),
                        // Nobody sets it: it is zero.
                        (false, None) if declared.init.is_none() => Given::Argument,
                        _ if stays => Given::Global(global),
                        _ => Given::Argument,
                    })
                }
                ExprKind::Local(local) => {
                    let givable = caller.map_or(&[][..], |caller| self.givable(caller));
                    match givable.iter().position(|&param| param == local) {
                        Some(param) => Passed::Param(param),
                        None => Passed::Known(Given::Argument),
                    }
                }
                _ => Passed::Known(Given::Argument),
            }
        });
        passed.collect()
    }
}

/// See [`Arguments::handed_on`].
fn handed_on(module: &Module) -> Vec<bool> {
    let mut found = vec![false; module.locals.len()];
    // Once more for each call that a local is handed on through; there is no recursion.
    loop {
        let mut grows = false;
        for expr in &module.exprs {
            let ExprKind::Call { func, args } = expr.kind else { continue };
            let first = module[func].locals.start as usize;
            for (i, &arg) in module[args].iter().enumerate() {
                let param = LocalId::new(first + i);
                let indexed = module[param].flags.contains(VarFlags::INDEXED) || found[param.index()];
                if let (true, ExprKind::Local(local)) = (indexed, module[arg].kind) {
                    grows |= !std::mem::replace(&mut found[local.index()], true);
                }
            }
        }
        if !grows {
            return found;
        }
    }
}

impl Builder<'_, '_> {
    /// Calls a function; `None` if it is void.
    ///
    /// Section 6.1.1: arguments are evaluated in order, each once; `inout` ones are copied in; after the call `out` and `inout`
    /// ones are copied back, in order. Where nobody can see the difference, the function works on the caller's variable itself.
    pub fn call(&mut self, func: FuncId, args: &[ExprId]) -> Option<Value> {
        let hir = self.cx.hir;
        let params = hir.params(func);
        let mut arguments = Vec::with_capacity(args.len());
        let given: Box<[Given]> = self
            .cx
            .arguments
            .passed(hir, self.func, func, args)
            .into_iter()
            .map(|passed| self.resolved(passed))
            .collect();
        let mut next_given = given.iter();
        let mut copies_out: Vec<(Place, Value)> = Vec::new();
        for (i, (param, &arg)) in params.iter().zip(args).enumerate() {
            let local = LocalId::new(hir[func].locals.start as usize + i);
            if self.cx.arguments.is_givable(hir, local) && next_given.next().is_some_and(|g| *g != Given::Argument) {
                continue;
            }
            let in_place = self.cx.arguments.reads_in_place(hir, local);
            if !param.kind.copies_out() && !in_place {
                arguments.push(self.value(arg));
                continue;
            }
            if let Some((local, pointer)) = self.whole_local(arg)
                && self.is_private_to_call(local, i, params, args)
            {
                arguments.push(pointer);
                continue;
            }
            if in_place {
                let value = self.value(arg);
                let copy = self.temporary(param.ty);
                self.store(copy, value);
                arguments.push(copy);
                continue;
            }
            let place = self.place(arg);
            let copy = self.temporary(param.ty);
            if param.kind == LocalKind::Inout {
                let value = self.load_place(place);
                self.store(copy, value);
            }
            arguments.push(copy);
            copies_out.push((place, copy));
        }
        let result = if self.cx.inlined[func.index()] {
            let result = self.inline(func, given, arguments);
            self.returned.extend(result);
            result
        } else {
            self.call_apart(Instance { func, given }, arguments)
        };
        for (place, copy) in copies_out {
            let value = self.load(copy);
            self.store_place(place, value);
        }
        result
    }

    fn resolved(&self, passed: Passed) -> Given {
        match passed {
            Passed::Known(given) => given,
            Passed::Param(index) => self.given[index],
        }
    }

    fn call_apart(&mut self, instance: Instance, arguments: Vec<Value>) -> Option<Value> {
        let function = self.cx.functions[&instance];
        let has_result = self.cx.hir[instance.func].result != TypeId::VOID;
        let result = has_result.then(|| self.computed_elsewhere(Expression::CallResult(function)));
        self.push(Statement::Call { function, arguments, result });
        result
    }

    /// The channel a sampler argument stands for.
    pub fn channel(&self, arg: ExprId) -> u8 {
        match self.cx.hir[arg].kind {
            ExprKind::Channel(channel) => channel,
            ExprKind::Local(local) => match self.slot(local) {
                Slot::Channel(channel) => channel,
                slot => unreachable!("{slot:?} is no sampler"),
            },
            other => unreachable!("{other:?} is no sampler"),
        }
    }

    /// Whether argument `i`, the variable `local`, is passed by no other `out` or `inout` parameter of this call, and no later
    /// argument changes anything: then the copy and the variable cannot be told apart.
    fn is_private_to_call(&self, local: LocalId, i: usize, params: &[Local], args: &[ExprId]) -> bool {
        let hir = self.cx.hir;
        let others = params.iter().zip(args).enumerate().filter(|(other, _)| *other != i);
        others.into_iter().all(|(other, (param, &arg))| {
            let changes = other > i && hir[arg].flags.contains(ExprFlags::EFFECTS);
            let is_out_too = param.kind.copies_out() && self.root_local(arg) == Some(local);
            !changes && !is_out_too
        })
    }

    fn root_local(&self, place: ExprId) -> Option<LocalId> {
        match self.cx.hir[writes::root(self.cx.hir, place)].kind {
            ExprKind::Local(local) => Some(local),
            _ => None,
        }
    }
}
