//! Which functions are inlined wherever they are called: small ones, and those of any size that are called at one place only,
//! which makes the program no larger.

use crate::glsl::{
    ast::MAX_NESTING,
    ir::{Block, FuncId, Function, Module, Op, Stmt},
};

/// Statements of a function, with those of what is inlined into it, that are written again for each call.
const LARGEST: usize = 256;

/// As many of a whole program, after inlining. What would be larger inlines smaller functions only: texts that call one function
/// a million times must not become so many copies.
const LARGEST_PROGRAM: usize = 1 << 17;

/// What counts of a function's body.
#[derive(Default)]
struct Facts {
    /// Statements, those in blocks among them.
    statements: usize,
    /// Called functions, each as often as it is called, with how deep the call nests.
    calls: Vec<(FuncId, usize)>,
    /// Blocks around the innermost statement, and one for each `Return`: what follows one becomes a branch.
    depth: usize,
    /// Nothing may follow a `Discard` that stands in the middle of another function.
    discards: bool,
}

impl Facts {
    fn of(function: &Function) -> Facts {
        let mut facts = Facts::default();
        facts.block(function, &function.body, 1);
        facts
    }

    fn block(&mut self, f: &Function, block: &Block, depth: usize) {
        self.statements += block.len();
        self.depth = self.depth.max(depth);
        for stmt in block {
            match stmt {
                Stmt::Let(value) => {
                    if let Op::Call { function, .. } = f[*value] {
                        self.calls.push((function, depth));
                    }
                }
                Stmt::Return(_) => self.depth += 1,
                Stmt::Discard => self.discards = true,
                _ => stmt.blocks(|block| self.block(f, block, depth + 1)),
            }
        }
    }
}

/// Which functions are inlined, by [`FuncId::index`]. What becomes of them nests no deeper than an author's text may, lest the
/// stack overflow.
pub(super) fn inlined(module: &Module) -> Vec<bool> {
    let facts: Vec<Facts> = module.functions.iter().map(Facts::of).collect();
    let Some((entry, functions)) = facts.split_last() else { return Vec::new() };
    let mut fits = vec![true; facts.len()];
    fits[functions.len()] = false;
    // What the entry point calls stays a function.
    entry.calls.iter().for_each(|(callee, _)| fits[callee.index()] = false);
    for (index, facts) in functions.iter().enumerate() {
        fits[index] &= !facts.discards;
    }
    let mut inlined = small(&facts, &fits);
    let sites = sites(&facts, &inlined);
    let mut depths = vec![0; facts.len()];
    for (index, facts) in functions.iter().enumerate() {
        let of_calls = facts.calls.iter().map(|(callee, depth)| {
            let within = if inlined[callee.index()] { depths[callee.index()] } else { 0 };
            depth + within
        });
        depths[index] = of_calls.max().unwrap_or(0).max(facts.depth);
        inlined[index] |= fits[index] && sites[index] == 1;
        inlined[index] &= depths[index] <= MAX_NESTING as usize;
    }
    inlined
}

/// Functions that are small with what is inlined into them.
fn small(facts: &[Facts], fits: &[bool]) -> Vec<bool> {
    let mut largest = LARGEST;
    loop {
        let mut small = vec![false; facts.len()];
        let mut sizes = vec![0usize; facts.len()];
        let mut program = 0usize;
        for (index, facts) in facts.iter().enumerate() {
            let inlined = facts.calls.iter().map(|(callee, _)| callee.index()).filter(|&callee| small[callee]);
            sizes[index] = inlined.fold(facts.statements, |sum, callee| sum.saturating_add(sizes[callee]));
            small[index] = fits[index] && sizes[index] <= largest;
            if !small[index] {
                program = program.saturating_add(sizes[index]);
            }
        }
        if program <= LARGEST_PROGRAM || largest == 0 {
            return small;
        }
        largest /= 4;
    }
}

/// At how many places each function is called where these are inlined.
fn sites(facts: &[Facts], inlined: &[bool]) -> Vec<usize> {
    let mut sites = vec![0usize; facts.len()];
    for (index, facts) in facts.iter().enumerate().rev() {
        let copies = if inlined[index] { sites[index] } else { 1 };
        for (callee, _) in &facts.calls {
            sites[callee.index()] = sites[callee.index()].saturating_add(copies);
        }
    }
    sites
}
