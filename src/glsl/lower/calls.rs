//! Calls of user functions, and how arguments are passed: without a copy wherever the difference is not observable.
//!
//! This is decided here and not by a pass over the IR: whether a copy is observable follows from the order in which
//! arguments are evaluated and from which of them are `out`, and neither is known once the copies are loads and stores.
//! The specialization of parameters ([`super::arguments`]) also determines how their function is lowered.

use super::{
    access::Place,
    arguments::{Instance, Specialization, SpecializedArgument, last_effect},
    function::{Builder, Slot},
};
use crate::{
    hir::{ExprId, ExprKind, FuncId, Local, LocalId, LocalKind, TypeId},
    ir::Value,
};

/// The destination of the value at an argument's place once all arguments have been evaluated.
enum Copy {
    /// An argument of the call, by its index.
    Argument(usize),
    /// The callee's own memory.
    Memory(Value),
}

impl Builder<'_, '_> {
    /// Calls a function; returns `None` if it is void.
    ///
    /// Section 6.1.1: arguments are evaluated in order, each once, and variables among them are read after all others
    /// ([`Builder::read_late`]); `inout` ones are copied in; after the call `out` and `inout` ones are copied back, in
    /// order. If the difference is not observable, the function works on the caller's variable itself.
    pub(super) fn call(&mut self, func: FuncId, args: &[ExprId]) -> Option<Value> {
        let hir = self.cx.hir;
        let params = hir.params(func);
        let mut arguments = Vec::with_capacity(args.len());
        let specializations: Box<[Specialization]> = self
            .cx
            .arguments
            .passed(hir, self.func, func, args)
            .into_iter()
            .map(|passed| self.resolved(passed))
            .collect();
        let mut next_specialization = specializations.iter();
        let mut copies_in: Vec<(Copy, Place)> = Vec::new();
        let mut copies_out: Vec<(Place, Value)> = Vec::new();
        let last_effect = last_effect(hir, args);
        let outs = self.out_locals(params, args);
        for (i, (param, &arg)) in params.iter().zip(args).enumerate() {
            let local = LocalId::new(hir[func].locals.start as usize + i);
            if self.cx.arguments.is_specializable(hir, local)
                && next_specialization.next().is_some_and(|s| *s != Specialization::None)
            {
                continue;
            }
            let in_place = self.cx.arguments.reads_in_place(hir, local);
            // A copy that becomes the callee's own variable.
            let is_moved = !param.kind.copies_out() && !in_place && self.cx.is_long(param.ty);
            let late = self.read_late(arg, Some(i) < last_effect);
            if !param.kind.copies_out() && !in_place && !is_moved {
                match late {
                    Some(place) => {
                        copies_in.push((Copy::Argument(arguments.len()), place));
                        arguments.push(place.pointer);
                    }
                    None => arguments.push(self.value(arg)),
                }
                continue;
            }
            // If no other `out` or `inout` parameter receives it, and no later argument changes it, the copy and the
            // variable are indistinguishable.
            if let Some((local, pointer)) = self.whole_local(arg)
                && !is_moved
                && last_effect <= Some(i)
                && outs[outs.partition_point(|out| out.0 < local)..]
                    .iter()
                    .take(2)
                    .all(|&out| out.0 != local || out.1 == i)
            {
                arguments.push(pointer);
                continue;
            }
            let copy = self.temporary(param.ty);
            arguments.push(copy);
            if !param.kind.copies_out() {
                match late {
                    Some(place) => copies_in.push((Copy::Memory(copy), place)),
                    None => {
                        let value = self.value(arg);
                        self.store(copy, value);
                    }
                }
                continue;
            }
            let place = match late {
                Some(place) => place,
                None => self.place(arg),
            };
            if param.kind == LocalKind::Inout {
                copies_in.push((Copy::Memory(copy), place));
            }
            copies_out.push((place, copy));
        }
        for (into, place) in copies_in {
            let value = self.load_place(place);
            match into {
                Copy::Argument(index) => arguments[index] = value,
                Copy::Memory(copy) => self.store(copy, value),
            }
        }
        let result = self.call_instance(Instance { func, specializations }, arguments);
        for (place, copy) in copies_out {
            let value = self.load(copy);
            self.store_place(place, value);
        }
        result
    }

    fn resolved(&self, passed: SpecializedArgument) -> Specialization {
        match passed {
            SpecializedArgument::Known(specialization) => specialization,
            SpecializedArgument::Param(index) => self.specializations[index],
        }
    }

    fn call_instance(&mut self, instance: Instance, arguments: Vec<Value>) -> Option<Value> {
        let function = self.cx.functions[&instance];
        let result = self.push_call(function, arguments);
        (self.cx.hir[instance.func].result != TypeId::VOID).then_some(result)
    }

    /// Returns the channel of a sampler argument.
    pub(super) fn channel(&self, arg: ExprId) -> u8 {
        match self.cx.hir[arg].kind {
            ExprKind::Channel(channel) => channel,
            ExprKind::Local(local) => match self.slot(local) {
                Slot::Channel(channel) => channel,
                slot => unreachable!("{slot:?} is no sampler"),
            },
            other => unreachable!("{other:?} is no sampler"),
        }
    }

    /// Returns the variables that `out` and `inout` parameters of a call are, or are parts of, in order, each with the
    /// index of its argument.
    fn out_locals(&self, params: &[Local], args: &[ExprId]) -> Vec<(LocalId, usize)> {
        let outs = params.iter().zip(args).enumerate().filter(|(_, (param, _))| param.kind.copies_out());
        let mut outs: Vec<_> = outs.filter_map(|(i, (_, &arg))| Some((self.root_local(arg)?, i))).collect();
        outs.sort_unstable();
        outs
    }

    fn root_local(&self, place: ExprId) -> Option<LocalId> {
        match self.cx.hir[self.cx.hir.root(place)].kind {
            ExprKind::Local(local) => Some(local),
            _ => None,
        }
    }
}
