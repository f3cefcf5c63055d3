//! Divides a program into blocks, and finds which of them need a counter.

use super::{BlockIndex, CountTable, CountedBlock, CountedLoop, Entered, Sum, trips, work::Lines};
use crate::ir::{Block, Case, Function, GlobalId, Module, Op, Stmt, analysis::continues};

/// Loops of more operations, in all iterations, are not written out: 32 iterations of 26 operations in Mesa
/// (`is_loop_small_enough` in `nir_opt_loop_unroll.c`).
const MOST_UNROLLED: u32 = 32 * 26;

/// A table, and the counter at the start of each nested block of each function, in the order of the text.
pub(super) struct Flow {
    pub table: CountTable,
    pub sites: Vec<Vec<Option<u32>>>,
    /// For each function its values, each with the block that computes it.
    #[cfg(test)]
    pub placed: Vec<Vec<(crate::ir::Value, BlockIndex)>>,
}

/// Divides a program. `discarded` is the flag that its discards set.
pub(super) fn divide(program: &Module, discarded: Option<GlobalId>, lines: Lines<'_>) -> Flow {
    let count = program.functions.len();
    let mut divider = Divider {
        program,
        discarded,
        lines,
        table: CountTable::default(),
        calls: vec![Vec::new(); count],
        sites: Vec::new(),
        #[cfg(test)]
        placed: Vec::new(),
    };
    let mut sites = vec![Vec::new(); count];
    #[cfg(test)]
    let mut placed = vec![Vec::new(); count];
    // Callers come after their callees.
    for index in (0..count).rev() {
        divider.function(index);
        sites[index] = std::mem::take(&mut divider.sites);
        #[cfg(test)]
        (placed[index] = std::mem::take(&mut divider.placed));
    }
    let Divider { mut table, lines, .. } = divider;
    lines.finish(&mut table);
    Flow {
        table,
        sites,
        #[cfg(test)]
        placed,
    }
}

struct Divider<'a> {
    program: &'a Module,
    discarded: Option<GlobalId>,
    lines: Lines<'a>,
    table: CountTable,
    /// The blocks that call each function.
    calls: Vec<Vec<BlockIndex>>,
    /// The sites of the current function.
    sites: Vec<Option<u32>>,
    #[cfg(test)]
    placed: Vec<(crate::ir::Value, BlockIndex)>,
}

/// The number of times that control leaves a block in each way.
#[derive(Clone, Debug, Default)]
struct Exits {
    /// The last block, if control may reach its end.
    end: Option<BlockIndex>,
    breaks: Sum,
    continues: Sum,
    returns: Sum,
    /// Some pixel may leave it before its end.
    leaves: bool,
}

impl Exits {
    fn add_jumps(&mut self, other: &Exits) {
        self.breaks.add(&other.breaks, 1);
        self.continues.add(&other.continues, 1);
        self.returns.add(&other.returns, 1);
        self.leaves |= other.leaves;
    }
}

/// The surroundings of a block.
#[derive(Clone, Default)]
struct Around {
    in_loop: Option<usize>,
    /// The number of runs of the only exit of the innermost loop, a `break`.
    only_break: Option<Sum>,
}

impl<'a> Divider<'a> {
    fn function(&mut self, index: usize) {
        let calls = std::mem::take(&mut self.calls[index]);
        let runs = calls.iter().fold(Sum::default(), |sum, &caller| sum.plus(&self.table.blocks[caller].runs));
        let (runs, entered) = if index + 1 == self.program.functions.len() {
            (Sum::constant(1), Entered::Start)
        } else {
            (runs, if calls.is_empty() { Entered::Never } else { Entered::Calls(calls) })
        };
        let f: &'a Function = &self.program.functions[index];
        let start = self.add_block(runs, entered, &Around::default());
        self.lines.operations.start();
        self.block(f, &f.body, start, &Around::default());
    }

    fn add_block(&mut self, runs: Sum, entered: Entered, around: &Around) -> BlockIndex {
        let in_loop = around.in_loop;
        self.table.blocks.push(CountedBlock { runs, entered, in_loop, discards: false, work: Vec::new() });
        self.table.blocks.len() - 1
    }

    fn runs(&self, block: BlockIndex) -> &Sum {
        &self.table.blocks[block].runs
    }

    /// Enters a nested block whose runs are known or counted.
    fn nested(&mut self, parent: BlockIndex, known: Option<Sum>, entered: Entered, around: &Around) -> BlockIndex {
        let known = if self.runs(parent).is_zero() { Some(Sum::default()) } else { known };
        let mut site = None;
        let runs = known.unwrap_or_else(|| {
            site = Some(self.table.counters as u32);
            self.table.counters += 1;
            Sum::counter(self.table.counters as u32 - 1)
        });
        self.sites.push(site);
        let entered = if runs.is_zero() { Entered::Never } else { entered };
        self.add_block(runs, entered, around)
    }

    fn block(&mut self, f: &Function, block: &Block, start: BlockIndex, around: &Around) -> Exits {
        let mut exits = Exits::default();
        let mut at = start;
        let mut is_reached = true;
        for (place, stmt) in block.iter().enumerate() {
            match stmt {
                Stmt::Let(value) => {
                    #[cfg(test)]
                    self.placed.push((*value, at));
                    if let Op::Call { function, .. } = f[*value]
                        && !self.runs(at).is_zero()
                    {
                        self.calls[function.index()].push(at);
                    }
                    self.lines.compute(self.program, f, *value, &mut self.table.blocks[at].work);
                }
                Stmt::Store { place, value } => {
                    if matches!(f[*place], Op::Global(id) if Some(id) == self.discarded) {
                        self.table.blocks[at].discards = true;
                    }
                    self.lines.store(self.program, f, (*place, *value), &mut self.table.blocks[at].work);
                }
                Stmt::If { condition, accept, reject } => {
                    self.lines.branch(f, *condition, 1, &mut self.table.blocks[at].work);
                    let inner = self.branch(f, [accept, reject], at, around);
                    (at, is_reached) = self.after_branch(&inner, at, around);
                    inner.iter().for_each(|side| exits.add_jumps(side));
                }
                Stmt::Switch { selector, cases } => {
                    self.lines.branch(f, *selector, cases.len() as u32, &mut self.table.blocks[at].work);
                    let mut inner = self.switch(f, cases, at, around);
                    // A break leaves the switch only.
                    inner.breaks = Sum::default();
                    let left = inner.returns.clone().plus(&inner.continues);
                    if inner.leaves {
                        let runs = self.runs(at).clone().minus(&left);
                        at = self.add_block(runs, Entered::After(at), around);
                    }
                    exits.add_jumps(&inner);
                }
                Stmt::Loop { body, continuing, break_if } => {
                    let trips = trips::of(f, &block[..place], body, continuing);
                    let number = self.table.loops.len();
                    let returns = self.repeat(f, (body, continuing, break_if.is_some()), at, around);
                    self.table.loops[number].trips =
                        trips.filter(|trips| self.operations(number) * trips < MOST_UNROLLED);
                    if returns.leaves {
                        let runs = self.runs(at).clone().minus(&returns.returns);
                        at = self.add_block(runs, Entered::After(at), around);
                    }
                    exits.add_jumps(&returns);
                }
                Stmt::Break => {
                    exits.breaks.add(&self.runs(at).clone(), 1);
                    (exits.leaves, is_reached) = (true, false);
                }
                Stmt::Continue => {
                    exits.continues.add(&self.runs(at).clone(), 1);
                    (exits.leaves, is_reached) = (true, false);
                }
                Stmt::Return(_) | Stmt::Output(_) | Stmt::Discard => {
                    exits.returns.add(&self.runs(at).clone(), 1);
                    (exits.leaves, is_reached) = (true, false);
                }
            }
        }
        exits.end = is_reached.then_some(at);
        exits
    }

    /// Divides the sides of a branch.
    fn branch(&mut self, f: &Function, sides: [&Block; 2], at: BlockIndex, around: &Around) -> [Exits; 2] {
        let only = |side: &Block| match (side.last(), &around.only_break) {
            // What comes before the break must not leave the block in another way.
            (Some(Stmt::Break), Some(runs)) if !side.iter().any(continues) => Some(runs.clone()),
            _ => None,
        };
        let parent = self.runs(at).clone();
        let [accept, reject] = sides;
        let known_accept = only(accept).or_else(|| only(reject).map(|runs| parent.clone().minus(&runs)));
        // A side without statements needs no number: the other one is counted.
        let counts_reject = known_accept.is_none() && accept.is_empty() && !reject.is_empty();
        if counts_reject {
            // The empty side has a place in the order of the blocks.
            self.sites.push(None);
            let second = self.nested(at, None, Entered::Branch(at), around);
            let runs = parent.minus(&self.runs(second).clone());
            let first = self.add_block(runs, Entered::Branch(at), around);
            let second = self.scoped(f, reject, second, around);
            return [Exits { end: Some(first), ..Exits::default() }, second];
        }
        let known_accept = if accept.is_empty() && reject.is_empty() { Some(Sum::default()) } else { known_accept };
        let first = self.nested(at, known_accept, Entered::Branch(at), around);
        let runs = parent.minus(&self.runs(first).clone());
        let first = self.scoped(f, accept, first, around);
        let second = self.nested(at, Some(runs), Entered::Branch(at), around);
        [first, self.scoped(f, reject, second, around)]
    }

    /// Divides a nested block; values that it computes are not available after it.
    fn scoped(&mut self, f: &Function, block: &Block, start: BlockIndex, around: &Around) -> Exits {
        let scope = self.lines.operations.enter();
        let exits = self.block(f, block, start, around);
        self.lines.operations.leave(scope);
        exits
    }

    /// Returns the block after a branch, and whether any pixel may reach it.
    fn after_branch(&mut self, sides: &[Exits; 2], at: BlockIndex, around: &Around) -> (BlockIndex, bool) {
        if sides.iter().all(|side| !side.leaves) {
            return (at, true);
        }
        let ends = || sides.iter().filter_map(|side| side.end);
        let runs = ends().fold(Sum::default(), |sum, end| sum.plus(self.runs(end)));
        let is_reached = ends().next().is_some();
        let entered = if is_reached { Entered::After(at) } else { Entered::Never };
        (self.add_block(runs, entered, around), is_reached)
    }

    fn switch(&mut self, f: &Function, cases: &[Case], at: BlockIndex, around: &Around) -> Exits {
        let around = Around { only_break: None, ..around.clone() };
        let mut rest = self.runs(at).clone();
        let has_default = cases.iter().any(|case| case.label.is_none());
        let last = cases.iter().rposition(|case| !case.falls_through).filter(|_| has_default);
        let mut all = Exits::default();
        for (number, case) in cases.iter().enumerate() {
            if case.falls_through {
                self.sites.push(None);
                continue;
            }
            let known = (last == Some(number)).then(|| rest.clone());
            let start = self.nested(at, known, Entered::Branch(at), &around);
            rest.add(&self.runs(start).clone(), -1);
            let exits = self.scoped(f, &case.body, start, &around);
            all.breaks.add(&exits.breaks, 1);
            all.continues.add(&exits.continues, 1);
            all.returns.add(&exits.returns, 1);
            all.leaves |= exits.leaves && (!exits.continues.is_zero() || !exits.returns.is_zero());
        }
        all
    }

    /// Returns the number of operations in the body of a loop, with those of inner loops.
    fn operations(&self, number: usize) -> u32 {
        let is_inside = |mut inner: usize| loop {
            if inner == number {
                return true;
            }
            match self.table.loops[inner].inside {
                Some(outer) => inner = outer,
                None => return false,
            }
        };
        let blocks = self.table.blocks.iter().filter(|block| block.in_loop.is_some_and(is_inside));
        blocks.flat_map(|block| &block.work).map(|work| work.count).sum()
    }

    /// Divides a loop. Returns only its exits from the function.
    fn repeat(
        &mut self,
        f: &Function,
        (body, continuing, has_test): (&Block, &Block, bool),
        at: BlockIndex,
        around: &Around,
    ) -> Exits {
        let entries = self.runs(at).clone();
        let number = self.table.loops.len();
        self.table.loops.push(CountedLoop {
            line: None,
            inside: around.in_loop,
            entries: entries.clone(),
            trips: None,
            iterations: Sum::default(),
        });
        let has_only_break = !has_test && exits_of(body, true) == [1, 0];
        let inner = Around { in_loop: Some(number), only_break: has_only_break.then(|| entries.clone()) };
        let start = self.nested(at, None, Entered::Iteration(at), &inner);
        let scope = self.lines.operations.enter();
        let blocks_before = self.table.blocks.len();
        let exits = self.block(f, body, start, &inner);
        self.table.loops[number].iterations = match starts_with_test(body) {
            // The block after the test.
            true => self.table.blocks[blocks_before..]
                .iter()
                .find(|block| block.entered == Entered::After(start))
                .map_or_else(|| self.runs(start).clone(), |block| block.runs.clone()),
            false => self.runs(start).clone(),
        };
        self.table.loops[number].line = self.lines.of_loop(f, body);
        let ended = exits.end.map_or_else(Sum::default, |end| self.runs(end).clone());
        let steps = ended.plus(&exits.continues);
        let step = self.nested(at, Some(steps), Entered::Continuing(start), &inner);
        self.block(f, continuing, step, &inner);
        self.lines.operations.leave(scope);
        self.lines.iteration(self.table.loops[number].line, &mut self.table.blocks[start].work);
        Exits { leaves: !exits.returns.is_zero(), returns: exits.returns, ..Exits::default() }
    }
}

/// Returns whether a body starts with operations and a branch whose one side is a `break`.
fn starts_with_test(body: &Block) -> bool {
    let first = body.iter().find(|stmt| !matches!(stmt, Stmt::Let(_) | Stmt::Store { .. }));
    let breaks = |side: &Block| matches!(side[..], [Stmt::Break]);
    matches!(first, Some(Stmt::If { accept, reject, .. }) if breaks(accept) && reject.is_empty() || breaks(reject) && accept.is_empty())
}

/// Returns the number of breaks from a loop, and of exits from the function, in a block of it.
fn exits_of(block: &Block, breaks_leave: bool) -> [usize; 2] {
    let mut sum = [0, 0];
    for stmt in block {
        match stmt {
            Stmt::Break => sum[0] += usize::from(breaks_leave),
            Stmt::Return(_) | Stmt::Output(_) | Stmt::Discard => sum[1] += 1,
            _ => {
                let leaves = breaks_leave && !matches!(stmt, Stmt::Loop { .. } | Stmt::Switch { .. });
                stmt.blocks(|inner| {
                    let [breaks, returns] = exits_of(inner, leaves);
                    sum = [sum[0] + breaks, sum[1] + returns];
                });
            }
        }
    }
    sum
}
