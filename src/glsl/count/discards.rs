//! Discards become exits of functions and of the entry point, so that a discarded pixel still outputs its counters.

use crate::{
    ast::Loc,
    ir::{
        Block, Function, GlobalId, GlobalKind, Module, Op, Stmt, Value,
        analysis::discards::{self, calls, may_discard},
    },
    types::{Scalar, TypeId},
};

/// Replaces all discards: a flag is set, and all functions return. Returns the flag; `None` if there is no discard.
pub(super) fn to_exits(program: &mut Module) -> Option<GlobalId> {
    let discards = discards::functions(program);
    if !discards.contains(&true) {
        return None;
    }
    let flag = program.add_global(TypeId::BOOL, GlobalKind::Private(None));
    let entry = program.functions.len() - 1;
    for (index, _) in discards.iter().enumerate().filter(|(_, discards)| **discards) {
        let mut body = std::mem::take(&mut program.functions[index].body);
        let f = &mut program.functions[index];
        let exits = Exits { flag, discards: &discards, is_entry: index == entry };
        exits.block(f, &mut body);
        program.functions[index].body = body;
    }
    Some(flag)
}

struct Exits<'a> {
    flag: GlobalId,
    discards: &'a [bool],
    is_entry: bool,
}

impl Exits<'_> {
    fn block(&self, f: &mut Function, block: &mut Block) {
        let mut out = Block::with_capacity(block.len());
        for mut stmt in std::mem::take(block) {
            match &mut stmt {
                Stmt::Discard => {
                    let place = self.place(f);
                    let value = f.append(Op::Literal(Scalar::Bool, 1), TypeId::BOOL, Loc::default());
                    out.push(Stmt::Store { place, value });
                    out.push(self.exit(f));
                }
                Stmt::Let(value) if calls(f, *value, self.discards) => {
                    out.push(stmt);
                    out.extend(self.exit_if_set(f));
                }
                Stmt::Loop { body, continuing, .. } => {
                    // A step cannot leave a loop: the next iteration does.
                    let in_step = may_discard(f, continuing, self.discards);
                    self.block(f, body);
                    if in_step {
                        body.splice(0..0, self.exit_if_set(f));
                    }
                    out.push(stmt);
                }
                _ => {
                    stmt.blocks_mut(|inner| self.block(f, inner));
                    out.push(stmt);
                }
            }
        }
        *block = out;
    }

    fn place(&self, f: &mut Function) -> Value {
        f.append(Op::Global(self.flag), TypeId::BOOL, Loc::default())
    }

    fn exit(&self, f: &mut Function) -> Stmt {
        if self.is_entry {
            return Stmt::Output(Vec::new());
        }
        let result = f.result;
        Stmt::Return((result != TypeId::VOID).then(|| f.append(Op::Zero(result), result, Loc::default())))
    }

    fn exit_if_set(&self, f: &mut Function) -> [Stmt; 2] {
        let place = self.place(f);
        let condition = f.append(Op::Load { place }, TypeId::BOOL, Loc::default());
        let accept = vec![self.exit(f)];
        [Stmt::Let(condition), Stmt::If { condition, accept, reject: Block::new() }]
    }
}
