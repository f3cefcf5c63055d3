//! Adds counters to a program.

use crate::{
    ast::Loc,
    ir::{Binary, Block, Function, GlobalId, GlobalKind, Module, Op, Output, Stmt, Value},
    types::{Scalar, TypeId},
};
use std::ops::Range;

/// Adds the counters of a range at their places, and makes the entry point output them, four to a target. `sites` has
/// the counter at the start of each nested block of each function, in the order of the text.
pub(super) fn run(program: &mut Module, sites: &[Vec<Option<u32>>], counters: Range<usize>) {
    let globals: Vec<GlobalId> =
        counters.clone().map(|_| program.add_global(TypeId::UINT, GlobalKind::Private(None))).collect();
    let global = |counter: u32| globals.get((counter as usize).checked_sub(counters.start)?).copied();
    for (f, sites) in program.functions.iter_mut().zip(sites) {
        let mut body = std::mem::take(&mut f.body);
        let mut sites = sites.iter().map(|site| site.and_then(global));
        nested(f, &mut body, &mut sites);
        f.body = body;
    }
    if let Some(entry) = program.functions.last_mut() {
        let mut body = std::mem::take(&mut entry.body);
        output(entry, &mut body, &globals);
        entry.body = body;
    }
}

/// Adds the counters of the blocks nested in a block.
fn nested(f: &mut Function, block: &mut Block, sites: &mut impl Iterator<Item = Option<GlobalId>>) {
    for stmt in block {
        stmt.blocks_mut(|inner| {
            let counter = sites.next().flatten();
            nested(f, inner, sites);
            if let Some(counter) = counter {
                inner.splice(0..0, count(f, counter));
            }
        });
    }
}

fn count(f: &mut Function, counter: GlobalId) -> [Stmt; 3] {
    let mut add = |op| f.append(op, TypeId::UINT, Loc::default());
    let place = add(Op::Global(counter));
    let before = add(Op::Load { place });
    let one = add(Op::Literal(Scalar::Uint, 1));
    let after = add(Op::Binary { op: Binary::Add, left: before, right: one });
    [Stmt::Let(before), Stmt::Let(after), Stmt::Store { place, value: after }]
}

/// Replaces the outputs of the entry point.
fn output(f: &mut Function, block: &mut Block, counters: &[GlobalId]) {
    block.iter_mut().for_each(|stmt| stmt.blocks_mut(|inner| output(f, inner, counters)));
    if !matches!(block.last(), Some(Stmt::Output(_))) {
        return;
    }
    block.pop();
    let ty = TypeId::vector(Scalar::Uint, 4);
    let mut parts = Vec::new();
    for (target, four) in counters.chunks(4).enumerate() {
        let mut load = |n: usize| -> Value {
            let Some(&counter) = four.get(n) else {
                return f.append(Op::Literal(Scalar::Uint, 0), TypeId::UINT, Loc::default());
            };
            let place = f.append(Op::Global(counter), TypeId::UINT, Loc::default());
            let value = f.append(Op::Load { place }, TypeId::UINT, Loc::default());
            block.push(Stmt::Let(value));
            value
        };
        let components: Box<[Value]> = (0..4).map(&mut load).collect();
        let value = f.append(Op::Compose { ty, parts: components }, ty, Loc::default());
        block.push(Stmt::Let(value));
        parts.push((Output::Target(target as u32), value));
    }
    block.push(Stmt::Output(parts));
}
