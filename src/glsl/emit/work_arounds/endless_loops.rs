//! Loops that may never end, ended: a driver of a GPU cannot always stop a shader, and one that never ends then keeps the
//! device from every program. An H100 and an H200 (driver 580.159) stood still for minutes, at two of some 1,300 public
//! shaders.
//!
//! What such a loop does is up to the platform (section 6.3 of the specification of GLSL ES 3.00). Rounds of all loops
//! of an invocation that no counter ends are counted together.

use crate::{
    ast::Loc,
    ir::{Binary, Block, Function, GlobalId, GlobalKind, Module, Op, Stmt, analysis},
    types::{Scalar, TypeId},
};

/// So many rounds of a pixel take a frame of 1920 x 1080 pixels more than ten seconds on the fastest device.
const MOST_ROUNDS: u32 = 1 << 22;

pub(super) fn run(program: &mut Module) {
    let mut rounds = None;
    for index in 0..program.functions.len() {
        let mut f = std::mem::take(&mut program.functions[index]);
        let mut body = std::mem::take(&mut f.body);
        block(program, &mut f, &mut body, &mut rounds);
        f.body = body;
        program.functions[index] = f;
    }
}

fn block(program: &mut Module, f: &mut Function, stmts: &mut Block, rounds: &mut Option<GlobalId>) {
    for stmt in stmts {
        stmt.blocks_mut(|inner| block(program, f, inner, rounds));
        if let Stmt::Loop { body, continuing, break_if } = stmt
            && !analysis::ends(&program.globals, f, body, continuing, *break_if)
        {
            let new = || program.add_global(TypeId::UINT, GlobalKind::Private(None));
            let counted = counted(f, *rounds.get_or_insert_with(new));
            body.splice(0..0, counted);
        }
    }
}

/// Returns statements that count a round, and leave the loop where there were enough.
fn counted(f: &mut Function, rounds: GlobalId) -> [Stmt; 5] {
    let mut add = |op, ty| f.append(op, ty, Loc::default());
    let place = add(Op::Global(rounds), TypeId::UINT);
    let before = add(Op::Load { place }, TypeId::UINT);
    let one = add(Op::Literal(Scalar::Uint, 1), TypeId::UINT);
    let after = add(Op::Binary { op: Binary::Add, left: before, right: one }, TypeId::UINT);
    let most = add(Op::Literal(Scalar::Uint, MOST_ROUNDS), TypeId::UINT);
    let condition = add(Op::Binary { op: Binary::GreaterEqual, left: before, right: most }, TypeId::BOOL);
    [
        Stmt::Let(before),
        Stmt::Let(after),
        Stmt::Store { place, value: after },
        Stmt::Let(condition),
        Stmt::If { condition, accept: vec![Stmt::Break], reject: Block::new() },
    ]
}
