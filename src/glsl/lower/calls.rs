//! Calls of user functions, and how arguments to `out` and `inout` parameters are passed.

use naga::{Expression, Statement};

use super::{
    Instance,
    access::Place,
    function::{Builder, Slot, Value},
};
use crate::glsl::hir::{
    ExprFlags, ExprId, ExprKind, FuncId, Local, LocalId, LocalKind, Module, Type, TypeId, VarFlags,
};

/// Which locals some call takes as a whole for a parameter that is indexed, there or in what it calls in turn; by
/// [`LocalId::index`]. They are memory, as if they were indexed themselves: the call then reads them where they are.
pub(super) fn handed_on(module: &Module) -> Vec<bool> {
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
        let mut channels = Vec::new();
        let mut copies_out: Vec<(Place, Value)> = Vec::new();
        for (i, (param, &arg)) in params.iter().zip(args).enumerate() {
            if let Type::Sampler { .. } = hir.types.get(param.ty) {
                channels.push(self.channel(arg));
                continue;
            }
            let in_place = self.reads_in_place(LocalId::new(hir[func].locals.start as usize + i));
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
            self.inline(func, &arguments, &channels)
        } else {
            self.call_apart(Instance { func, channels: channels.into() }, arguments)
        };
        for (place, copy) in copies_out {
            let value = self.load(copy);
            self.store_place(place, value);
        }
        result
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

    fn root_local(&self, mut place: ExprId) -> Option<LocalId> {
        loop {
            match self.cx.hir[place].kind {
                ExprKind::Member { base, .. } | ExprKind::Swizzle { base, .. } | ExprKind::Index { base, .. } => {
                    place = base;
                }
                ExprKind::Local(local) => return Some(local),
                _ => return None,
            }
        }
    }
}
