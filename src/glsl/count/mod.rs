//! Counting variants of a pass: programs that run as the pass does, and output how often each part of it ran.
//!
//! Owns the blocks that a program divides into, the operations in each by class and line ([`CountTable`]), and the
//! counters that are added to it. A block is a sequence of statements that always run together, so one number says how
//! often each of them ran. Control flow is structured, and what enters a statement leaves it (Kirchhoff's law, as in
//! D. E. Knuth and F. R. Stevenson, "Optimal measurement points for program frequency counts", BIT 13, 1973), so most
//! of these numbers follow from a few counters ([`Sum`]): one for a branch, one for a loop.
//!
//! Knows neither devices nor how long an operation takes.

mod classes;
mod discards;
mod flow;
mod instrument;
mod sum;
#[cfg(test)]
mod tests;
mod trips;
mod work;

pub use classes::OpClass;
pub use sum::Sum;

use super::{
    PassSource,
    ast::Origins,
    compile::{self, Compiled},
    ir,
    preamble::Preamble,
    stack::on_deep_stack,
    stages::Link,
};
use eddy_diag::{Diagnostic, SourceId};

/// A block of a [`CountTable`], by its index there.
pub type BlockIndex = usize;

/// The blocks, lines and loops of a program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CountTable {
    /// The number of counters that the variants have together.
    pub counters: usize,
    pub blocks: Vec<CountedBlock>,
    /// The lines that operations belong to, in ascending order.
    pub lines: Vec<Line>,
    /// In the order of the program: an outer loop before those inside it.
    pub loops: Vec<CountedLoop>,
}

/// A line of one of the texts of a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Line {
    pub source: SourceId,
    /// From 1.
    pub number: u32,
}

/// Statements that run equally often.
#[derive(Clone, Debug, PartialEq)]
pub struct CountedBlock {
    /// The number of times that a pixel runs it, as a sum of counters.
    pub runs: Sum,
    /// The way in which control reaches it.
    pub entered: Entered,
    /// The innermost loop that contains it within its function, by its index in [`CountTable::loops`].
    pub in_loop: Option<usize>,
    /// It ends with a `discard`.
    pub discards: bool,
    /// Its operations, by line and class.
    pub work: Vec<Work>,
}

/// The way in which control reaches a block.
#[derive(Clone, Debug, PartialEq)]
pub enum Entered {
    /// It is the start of the entry point.
    Start,
    /// It is the start of a function, which these blocks call, each as often as it is named.
    Calls(Vec<BlockIndex>),
    /// It is a side of a branch, or a case of a switch, of this block.
    Branch(BlockIndex),
    /// It is the start of the body of a loop in this block.
    Iteration(BlockIndex),
    /// It is what follows the body of a loop, before the next iteration; the start of the body.
    Continuing(BlockIndex),
    /// It follows a statement of this block that pixels may have left.
    After(BlockIndex),
    /// Control never reaches it.
    Never,
}

/// Operations of one class on a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Work {
    /// By its index in [`CountTable::lines`]; `None` for code that the author did not write.
    pub line: Option<u32>,
    pub class: OpClass,
    /// The channel of a texture read.
    pub channel: Option<u8>,
    /// The number of operations on single components; texture reads are counted whole.
    pub count: u32,
}

/// A loop.
#[derive(Clone, Debug, PartialEq)]
pub struct CountedLoop {
    /// The line of its condition, or of the first operation in it, by its index in [`CountTable::lines`].
    pub line: Option<u32>,
    /// The loop around it in the same function, by its index.
    pub inside: Option<usize>,
    /// The number of times that a pixel reaches the loop.
    pub entries: Sum,
    /// The number of iterations, if it is a constant so small that compilers of drivers write the loop out.
    pub trips: Option<u32>,
    /// The number of times that a pixel runs its body, beyond a condition at its start.
    pub iterations: Sum,
}

/// The counting variants of a pass.
pub struct Counting {
    pub table: CountTable,
    /// The programs, one per draw. Program `i` outputs [`Counting::counters_of`]`(i)`, four to a target, as `uvec4`s.
    pub variants: Vec<Compiled>,
    /// The most counters that a program outputs.
    pub per_draw: usize,
}

impl Counting {
    /// Compiles the counting variants of a pass, each with at most `per_draw` counters. A program without branches and
    /// loops has no variant: its counts are known. On failure the list contains at least one error.
    ///
    /// A variant reads the same resources at the same bindings as the program that [`super::compile_linked`] returns.
    pub fn new(
        source: &PassSource<'_>,
        link: &Link<'_>,
        preamble: Option<&Preamble>,
        per_draw: usize,
    ) -> Result<Self, Vec<Diagnostic>> {
        on_deep_stack(|| compile::compile_counting(source, link, preamble, per_draw.max(1)))
    }

    /// Returns the counters that a variant outputs.
    pub fn counters_of(&self, variant: usize) -> std::ops::Range<usize> {
        let start = variant * self.per_draw;
        start..(start + self.per_draw).min(self.table.counters)
    }
}

/// Returns the table of a pass, and its program that outputs all counters, for the walker: pass them through
/// [`Sum::of`].
#[doc(hidden)]
pub fn walkable(source: &PassSource<'_>, link: &Link<'_>) -> Result<(CountTable, ir::Module), Vec<Diagnostic>> {
    let prepared = on_deep_stack(|| compile::prepare_counting(source, link, None))?.0;
    let program = prepared.variant(0..prepared.table.counters);
    Ok((prepared.table, program))
}

/// A program whose discards are exits, with its table and the places of its counters.
pub(crate) struct Prepared {
    program: ir::Module,
    sites: Vec<Vec<Option<u32>>>,
    pub table: CountTable,
    #[cfg(test)]
    placed: Vec<Vec<(ir::Value, BlockIndex)>>,
}

impl Prepared {
    /// Divides an optimised program into blocks.
    pub(crate) fn new(mut program: ir::Module, source: &PassSource<'_>, origins: &Origins) -> Self {
        let flag = discards::to_exits(&mut program);
        let lines = work::Lines::new(source, origins);
        let flow = flow::divide(&program, flag, lines);
        Self {
            program,
            sites: flow.sites,
            table: flow.table,
            #[cfg(test)]
            placed: flow.placed,
        }
    }

    /// Returns the program that outputs some of the counters.
    pub(crate) fn variant(&self, counters: std::ops::Range<usize>) -> ir::Module {
        let mut program = self.program.clone();
        instrument::run(&mut program, &self.sites, counters);
        program
    }
}
