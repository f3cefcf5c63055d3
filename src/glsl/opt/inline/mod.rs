//! Inlining of long chains of calls: a call is replaced with the body of the function.
//!
//! Drivers inline everything in any case, callees first, and keep each function with all its inlined callees until the
//! last one is done: `nir_inline_functions` of Mesa. For a chain, where each function calls the previous one, that is
//! half the square of its length. Here such functions are merged, as long as they are called at one place, which does
//! not enlarge the program. Programs without such chains are left unchanged: inlining would not help them.
//!
//! Control flow is structured, so a `Return` in the middle of a function becomes a branch: the code after it moves into
//! the other branch, or is skipped if a flag indicates that the function has returned. In a loop a `Return` is a
//! `Break`.

mod choose;

use crate::{
    ast::Loc,
    ir::{Block, Function, Module, Op, Stmt, Value, Var, VarId},
    types::{Scalar, TypeId},
};
use choose::{always_leaves, needs_flag, returns};

pub(super) fn run(module: &mut Module) {
    let inlined = choose::inlined(module);
    if !inlined.contains(&true) {
        return;
    }
    for index in 0..module.functions.len() {
        let (callees, rest) = module.functions.split_at_mut(index);
        let caller = &mut rest[0];
        let calls = |(_, op): (Value, &Op)| matches!(op, Op::Call { function, .. } if inlined[function.index()]);
        if caller.values().any(calls) {
            inline_calls(caller, callees, &inlined);
        }
    }
    module.drop_uncalled();
}

/// Replaces calls in one function, whose callees have been processed. Inlined functions are removed from `callees`.
fn inline_calls(caller: &mut Function, callees: &mut [Function], inlined: &[bool]) {
    let body = std::mem::take(&mut caller.body);
    let map = (0..caller.len()).map(Value::new).collect();
    let mut inliner = Inliner { f: caller, callees, inlined, map, out: Block::new(), loops: 0 };
    inliner.block(body);
    let body = std::mem::take(&mut inliner.out);
    caller.body = body;
    caller.compact();
}

struct Inliner<'a> {
    f: &'a mut Function,
    callees: &'a mut [Function],
    inlined: &'a [bool],
    /// The new value for each of the caller's values: the results of calls change.
    map: Vec<Value>,
    out: Block,
    /// The number of loops around the current code.
    loops: usize,
}

/// A call that is being replaced.
struct Site<'a> {
    callee: &'a Function,
    args: Box<[Value]>,
    /// The caller has the callee's values from this index on, and its variables from `first_var`.
    first_value: usize,
    first_var: usize,
    /// The variable for the result.
    result: Option<Value>,
    /// The variable that indicates whether the function has returned.
    flag: Option<Value>,
    /// The number of loops and switches of the callee around the current code.
    breakable: usize,
}

impl Site<'_> {
    /// Returns the caller's value for one of the callee's.
    fn value(&self, old: Value) -> Value {
        match self.callee[old] {
            Op::Param(index) => self.args[index as usize],
            _ => Value::new(self.first_value + old.index()),
        }
    }
}

impl Inliner<'_> {
    fn value(&self, old: Value) -> Value {
        self.map[old.index()]
    }

    fn nested(&mut self, fill: impl FnOnce(&mut Self)) -> Block {
        let outer = std::mem::take(&mut self.out);
        fill(self);
        std::mem::replace(&mut self.out, outer)
    }

    fn flag_literal(&mut self, is_set: bool) -> Value {
        self.f.append(Op::Literal(Scalar::Bool, is_set.into()), TypeId::BOOL, Loc::default())
    }

    fn temporary(&mut self, ty: TypeId, loc: Loc) -> Value {
        let var = self.f.add_var(ty);
        self.f.append(Op::Var(var), ty, loc)
    }

    fn add(&mut self, op: Op, ty: TypeId, loc: Loc) -> Value {
        let value = self.f.append(op, ty, loc);
        self.out.push(Stmt::Let(value));
        value
    }

    /// Rewrites statements of the caller.
    fn block(&mut self, block: Block) {
        self.out.reserve(block.len());
        for mut stmt in block {
            match &mut stmt {
                Stmt::Let(value) => {
                    let value = *value;
                    let mut op = self.f.replace(value, Op::OpaqueZero);
                    op.operands_mut(|operand| *operand = self.value(*operand));
                    if let Op::Call { function, args } = op {
                        if self.inlined[function.index()] {
                            self.inline(function.index(), args, value);
                            continue;
                        }
                        op = Op::Call { function, args };
                    }
                    self.f.replace(value, op);
                }
                Stmt::Loop { body, continuing, break_if } => {
                    self.loops += 1;
                    [body, continuing].into_iter().for_each(|block| self.rewrite(block));
                    self.loops -= 1;
                    *break_if = break_if.map(|value| self.value(value));
                }
                other => {
                    other.operands_mut(|operand| *operand = self.value(*operand));
                    other.blocks_mut(|block| self.rewrite(block));
                }
            }
            self.out.push(stmt);
        }
    }

    fn rewrite(&mut self, block: &mut Block) {
        let old = std::mem::take(block);
        *block = self.nested(|s| s.block(old));
    }

    /// Inlines a function here; `call` is the caller's value for its result.
    fn inline(&mut self, function: usize, args: Box<[Value]>, call: Value) {
        let callee = &std::mem::take(&mut self.callees[function]);
        let (first_value, first_var) = (self.f.len(), self.f.vars.len());
        let mut site = Site { callee, args, first_value, first_var, result: None, flag: None, breakable: 0 };
        self.values(&site);
        self.variables(&site);
        let (last, before) = match callee.body.split_last() {
            Some((Stmt::Return(Some(last)), before)) => (Some(*last), before),
            _ => (None, &callee.body[..]),
        };
        let is_straight = !before.iter().any(returns);
        if let (Some(last), true) = (last, is_straight) {
            before.iter().for_each(|stmt| self.statement(&mut site, stmt));
            self.map[call.index()] = site.value(last);
            return;
        }
        let loc = self.f.loc(call);
        site.result = (callee.result != TypeId::VOID).then(|| self.temporary(callee.result, loc));
        site.flag = needs_flag(&callee.body).then(|| self.temporary(TypeId::BOOL, loc));
        if let Some(flag) = site.flag {
            let value = self.flag_literal(false);
            self.out.push(Stmt::Store { place: flag, value });
        }
        self.body(&mut site, callee.body.iter().collect());
        if let Some(result) = site.result {
            self.map[call.index()] = self.add(Op::Load { place: result }, callee.result, loc);
        }
    }

    /// Appends the callee's values, in their order.
    fn values(&mut self, site: &Site<'_>) {
        for (value, op) in site.callee.values() {
            let op = match *op {
                // It is replaced with the argument.
                Op::Param(_) => Op::OpaqueZero,
                Op::Var(id) => Op::Var(VarId::new(site.first_var + id.index())),
                ref op => {
                    let mut op = op.clone();
                    op.operands_mut(|operand| *operand = site.value(*operand));
                    op
                }
            };
            self.f.append(op, site.callee.ty(value), site.callee.origin(value));
        }
    }

    /// Adds the callee's variables. In a loop they are initialised again in each iteration.
    fn variables(&mut self, site: &Site<'_>) {
        let first = self.f.vars.len();
        let is_repeated = self.loops > 0;
        self.f.vars.extend(site.callee.vars.iter().map(|var| {
            let init = var.init.filter(|_| !is_repeated).map(|init| site.value(init));
            Var { init, ..*var }
        }));
        if is_repeated {
            for (index, var) in site.callee.vars.iter().enumerate() {
                if let Some(init) = var.init {
                    let id = VarId::new(first + index);
                    let place = self.f.append(Op::Var(id), var.ty, Loc::default());
                    self.out.push(Stmt::Store { place, value: site.value(init) });
                }
            }
        }
    }

    /// Adds statements of the callee that are outside its loops and switches: the statements after one that may return
    /// become part of a branch.
    fn body<'a>(&mut self, site: &mut Site<'_>, mut list: Vec<&'a Stmt>) {
        let Some(at) = list.iter().position(|stmt| returns(stmt)) else {
            return list.into_iter().for_each(|stmt| self.statement(site, stmt));
        };
        let mut rest = list.split_off(at + 1);
        let stmt = list.pop().expect("it was found");
        list.into_iter().for_each(|stmt| self.statement(site, stmt));
        match stmt {
            Stmt::If { condition, accept, reject } => {
                let condition = site.value(*condition);
                let with = |block: &'a Block, rest: &mut Vec<&'a Stmt>| -> Vec<&'a Stmt> {
                    block.iter().chain(rest.drain(..)).collect()
                };
                let mut nothing = Vec::new();
                let (accept, reject) = if always_leaves(accept) {
                    (with(accept, &mut nothing), with(reject, &mut rest))
                } else if always_leaves(reject) {
                    (with(accept, &mut rest), with(reject, &mut nothing))
                } else {
                    (with(accept, &mut nothing), with(reject, &mut nothing))
                };
                let accept = self.nested(|s| s.body(site, accept));
                let reject = self.nested(|s| s.body(site, reject));
                self.out.push(Stmt::If { condition, accept, reject });
            }
            Stmt::Return(_) => return self.statement(site, stmt),
            _ => self.statement(site, stmt),
        }
        if !rest.is_empty() {
            let flag = site.flag.expect("a function that may return before its end has a flag");
            let condition = self.add(Op::Load { place: flag }, TypeId::BOOL, Loc::default());
            let reject = self.nested(|s| s.body(site, rest));
            self.out.push(Stmt::If { condition, accept: Block::new(), reject });
        }
    }

    fn copy(&mut self, site: &mut Site<'_>, block: &Block) -> Block {
        self.nested(|s| block.iter().for_each(|stmt| s.statement(site, stmt)))
    }

    /// Adds a statement of the callee. A `Return` in it is at the end, or in a loop or switch.
    fn statement(&mut self, site: &mut Site<'_>, stmt: &Stmt) {
        let copy = match stmt {
            Stmt::Let(value) => Stmt::Let(site.value(*value)),
            Stmt::Return(value) => return self.leave(site, *value),
            other => {
                let (is_loop, is_switch) = (matches!(other, Stmt::Loop { .. }), matches!(other, Stmt::Switch { .. }));
                self.loops += usize::from(is_loop);
                site.breakable += usize::from(is_loop || is_switch);
                let mut copy = other.with_blocks(|block| self.copy(site, block));
                self.loops -= usize::from(is_loop);
                site.breakable -= usize::from(is_loop || is_switch);
                copy.operands_mut(|operand| *operand = site.value(*operand));
                copy
            }
        };
        self.out.push(copy);
        // A loop or switch within another one: the outer one is left too.
        if let (Some(flag), true) = (site.flag, site.breakable > 0)
            && matches!(stmt, Stmt::Loop { .. } | Stmt::Switch { .. })
            && returns(stmt)
        {
            let condition = self.add(Op::Load { place: flag }, TypeId::BOOL, Loc::default());
            self.out.push(Stmt::If { condition, accept: vec![Stmt::Break], reject: Block::new() });
        }
    }

    /// Leaves the callee.
    fn leave(&mut self, site: &mut Site<'_>, value: Option<Value>) {
        if let (Some(value), Some(place)) = (value, site.result) {
            let value = site.value(value);
            self.out.push(Stmt::Store { place, value });
        }
        if let Some(place) = site.flag {
            let value = self.flag_literal(true);
            self.out.push(Stmt::Store { place, value });
        }
        if site.breakable > 0 {
            self.out.push(Stmt::Break);
        }
    }
}
