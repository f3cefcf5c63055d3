//! Ends loops where the fragment is discarded.
//!
//! `discard` ends a shader (GLSL ES 3.00, 6.4), and [`Stmt::Discard`] has that meaning. Mesa's gallivm only masks the
//! fragment and continues running it (`discard` in `lp_bld_nir_soa.c`), as long as a loop has iterations to run: a pass
//! that discards the pixels it does not need takes the time of the whole picture. Therefore Mesa's GLSL compiler ends
//! loops itself (`lower_discard_flow.cpp`), with a flag, as is done here; nothing does so for SPIR-V.

use crate::{
    ast::Loc,
    ir::{
        Block, Function, GlobalId, GlobalKind, Module, Op, Stmt,
        analysis::discards::{self, may_discard},
        rewrite::{self, Rewriter, Rule},
    },
    types::{Scalar, TypeId},
};

pub(super) fn run(program: &mut Module) {
    let discards = discards::functions(program);
    if !discards.contains(&true) {
        return;
    }
    let marked = Marked::of(program, &discards).loops;
    if marked.iter().all(|loops| !loops.contains(&true)) {
        return;
    }
    let flag = program.add_global(TypeId::BOOL, GlobalKind::Private(None));
    for (index, loops) in marked.into_iter().enumerate() {
        let mut body = std::mem::take(&mut program.functions[index].body);
        set_flag(&mut program.functions[index], &mut body, flag);
        program.functions[index].body = body;
        if loops.contains(&true) {
            rewrite::function(program, index, &mut Exits { flag, loops: loops.into_iter() });
        }
    }
}

/// The loops that a discarded fragment may reach.
struct Marked<'a> {
    discards: &'a [bool],
    /// By function: whether it may be called for a discarded fragment.
    called: Vec<bool>,
    /// By function: its loops, in text order.
    loops: Vec<Vec<bool>>,
}

impl Marked<'_> {
    fn of<'a>(program: &'a Module, discards: &'a [bool]) -> Marked<'a> {
        let count = program.functions.len();
        let mut marked = Marked { discards, called: vec![false; count], loops: vec![Vec::new(); count] };
        // Callers come after their callees.
        for index in (0..count).rev() {
            let f = &program.functions[index];
            marked.block(f, index, &f.body, marked.called[index]);
        }
        marked
    }

    /// Returns whether the fragment may be discarded after a block.
    fn block(&mut self, f: &Function, index: usize, block: &Block, mut is_discarded: bool) -> bool {
        for stmt in block {
            match stmt {
                Stmt::Discard => is_discarded = true,
                Stmt::Let(value) => {
                    if let Op::Call { function, .. } = f[*value] {
                        self.called[function.index()] |= is_discarded;
                        is_discarded |= self.discards[function.index()];
                    }
                }
                Stmt::Loop { body, continuing, .. } => {
                    let number = self.loops[index].len();
                    self.loops[index].push(false);
                    is_discarded |= may_discard(f, body, self.discards) || may_discard(f, continuing, self.discards);
                    self.loops[index][number] = is_discarded;
                    self.block(f, index, body, is_discarded);
                    self.block(f, index, continuing, is_discarded);
                }
                _ => {
                    let before = is_discarded;
                    stmt.blocks(|block| is_discarded |= self.block(f, index, block, before));
                }
            }
        }
        is_discarded
    }
}

/// Sets the flag before each discard.
fn set_flag(f: &mut Function, block: &mut Block, flag: GlobalId) {
    for stmt in block.iter_mut() {
        stmt.blocks_mut(|inner| set_flag(f, inner, flag));
    }
    if let Some(Stmt::Discard) = block.last() {
        let place = f.append(Op::Global(flag), TypeId::BOOL, Loc::default());
        let value = f.append(Op::Literal(Scalar::Bool, 1), TypeId::BOOL, Loc::default());
        block.insert(block.len() - 1, Stmt::Store { place, value });
    }
}

/// Adds an exit for discarded fragments at the start of loops.
struct Exits {
    flag: GlobalId,
    loops: std::vec::IntoIter<bool>,
}

impl Rule for Exits {
    fn start_body(&mut self, r: &mut Rewriter<'_>, _: &Block) {
        if self.loops.next() == Some(true) {
            let place = r.f.append(Op::Global(self.flag), TypeId::BOOL, Loc::default());
            let condition = r.add(Op::Load { place });
            r.push(Stmt::If { condition, accept: vec![Stmt::Break], reject: Block::new() });
        }
    }
}
