//! Counts by line and by loop.

use super::{LoopRuns, PassCounts};
use eddy_glsl::count::{Line, OpClass};
use std::collections::BTreeMap;

/// The counts of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct LineCounts {
    pub line: Line,
    /// The largest number of times that pixels ran a part of it; 0 if no pixel reached it.
    pub runs: u64,
    /// The nanoseconds that the device spends on it in one draw, by the prices.
    pub nanos: f64,
    /// Its part of the time of the pass, from 0 to 1.
    pub share: f64,
    /// The operations of the pixels by class, without those that are not there.
    pub operations: Vec<(OpClass, u64)>,
}

impl LineCounts {
    /// Returns the number of texture reads.
    pub fn texture_reads(&self) -> u64 {
        self.operations.iter().filter(|(class, _)| class.is_texture_read()).map(|(_, count)| count).sum()
    }
}

/// The counts of a loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopCounts {
    /// The line of its condition, or of the first operation in it.
    pub line: Line,
    /// The number of loops around it in the same function.
    pub depth: u32,
    pub runs: LoopRuns,
}

impl PassCounts {
    /// Returns the counts of each line that operations belong to, in the order of the texts.
    pub fn lines(&self) -> Vec<LineCounts> {
        let whole = self.prices.pixel * self.pixels as f64 + self.work_nanos();
        let mut runs = vec![0; self.table.lines.len()];
        let mut nanos = vec![0.0; self.table.lines.len()];
        let mut operations: Vec<BTreeMap<OpClass, u64>> = vec![BTreeMap::new(); self.table.lines.len()];
        for ((block, count), lanes) in self.table.blocks.iter().zip(&self.runs).zip(&self.lanes) {
            for work in &block.work {
                let Some(line) = work.line.map(|line| line as usize) else { continue };
                runs[line] = count.max(&runs[line]).to_owned();
                nanos[line] += lanes * self.prices.of_work(work, &self.filters);
                if work.count > 0 && *count > 0 {
                    *operations[line].entry(work.class).or_default() += count * u64::from(work.count);
                }
            }
        }
        let all = self.table.lines.iter().zip(runs).zip(nanos).zip(operations);
        all.map(|(((&line, runs), nanos), operations)| LineCounts {
            line,
            runs,
            nanos,
            share: if whole > 0.0 { nanos / whole } else { 0.0 },
            operations: operations.into_iter().collect(),
        })
        .collect()
    }

    /// Returns the counts of each loop, an outer one before those inside it.
    pub fn loops(&self) -> Vec<LoopCounts> {
        let depth = |mut inside: Option<usize>| {
            let mut depth = 0;
            while let Some(outer) = inside {
                depth += 1;
                inside = self.table.loops[outer].inside;
            }
            depth
        };
        let all = self.table.loops.iter().zip(&self.loops);
        let known = all.filter_map(|(counted, &runs)| {
            let line = self.table.lines[counted.line? as usize];
            Some(LoopCounts { line, depth: depth(counted.inside), runs })
        });
        known.collect()
    }
}
