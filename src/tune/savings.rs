//! The most that a knob can save, by the counts of one draw.
//!
//! A loop that takes a part s of the time takes at least s r of it with r times the bound: the number of iterations with a
//! lower bound is a concave function of the bound, and 0 at 0. So no setting takes less than 1 minus the sum of s (1 - r)
//! over its knobs, whether their loops are apart or inside each other. Settings that cannot be faster than the best
//! are not drawn, knobs of little weight are not tried, and a bound that no pixel reaches has converged.

use crate::knob::{Kind, Knob};
use eddy_diag::Span;
use eddy_engine::counts::{CountedBlock, Line, PassCounts};
use eddy_glsl::count::Entered;
use std::collections::HashSet;

/// A place where a knob decides how often code runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The expression in the author's text.
    pub span: Span,
    /// The line of the expression.
    pub line: Line,
    /// It bounds the iterations of a loop, and is not a step or an end of it.
    pub is_bound: bool,
}

/// The counts of the passes that a knob has places in.
#[derive(Debug, Default)]
pub(crate) struct Counts {
    passes: Vec<(PassCounts, f64)>,
}

/// The most that one knob can save.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Saving {
    /// The part of the time that its loops take, 0 to 1.
    pub share: f64,
    /// The number of loops inside each other that it bounds.
    pub power: i32,
    /// The most iterations of a loop that a pixel had in the mean, if it bounds loops and has no other place.
    pub most: Option<f64>,
}

/// Counts are of one frame, and the times of operations are estimates: a share may be larger by this.
const SLACK: f64 = 1.25;
const MORE: f64 = 0.03;

impl Counts {
    /// Adds the counts of a pass, and its milliseconds.
    pub(crate) fn add(&mut self, counts: PassCounts, millis: f64) {
        self.passes.push((counts, millis));
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.passes.is_empty()
    }

    /// Returns what a knob can save; `None` if it is not known. `all` is the milliseconds of a frame.
    pub(crate) fn saving(&self, knob: &Knob, all: f64) -> Option<Saving> {
        let (mut share, mut depth, mut most, mut found) = (0.0, 0, 0.0f64, false);
        let mut is_bound_alone = knob.kind == Kind::Count;
        for (counts, millis) in &self.passes {
            let loops = loops_of(counts, &knob.places);
            if loops.is_empty() {
                continue;
            }
            found = true;
            share += part_in(counts, &loops) * millis / all;
            for &at in &loops {
                let around = std::iter::successors(Some(at), |at| counts.table.loops[*at].inside);
                depth = depth.max(around.filter(|at| loops.contains(at)).count());
                most = most.max(counts.loops[at].most);
                // The mean of several entries hides one that reaches the bound.
                let entries = counts.loops[at].entries as f64;
                is_bound_alone &= entries <= counts.pixels as f64 * 1.0001;
            }
        }
        is_bound_alone &= knob.places.iter().all(|place| place.is_bound);
        // Loops in functions that call each other are not seen to be inside each other.
        let power = depth.max(knob.places.len()).clamp(1, 3) as i32;
        found.then_some(Saving { share: share.clamp(0.0, 1.0), power, most: is_bound_alone.then_some(most) })
    }
}

impl Saving {
    /// Returns the least part of the present time that a value of the knob can save no more than.
    pub(crate) fn at_most(&self, knob: &Knob, value: f64) -> f64 {
        let share = (self.share * SLACK + MORE).min(1.0);
        let ratio = if knob.grows { value / knob.value } else { knob.value / value };
        match (knob.kind, ratio >= 1.0) {
            (_, true) => 0.0,
            (Kind::Count | Kind::Step, _) => share * (1.0 - ratio.powi(self.power)),
            _ => share,
        }
    }

    /// Returns whether no pixel comes near the value as a bound: larger ones change nothing.
    pub(crate) fn is_unreached(&self, value: f64) -> bool {
        self.most.is_some_and(|most| most > 0.0 && most <= 0.7 * value)
    }
}

/// Returns the loops whose lines the places are on, or that contain them.
fn loops_of(counts: &PassCounts, places: &[Place]) -> Vec<usize> {
    let table = &counts.table;
    let mut loops = HashSet::new();
    for place in places {
        let index = table.lines.iter().position(|line| *line == place.line).map(|at| at as u32);
        let Some(index) = index else { continue };
        let own: Vec<usize> = (0..table.loops.len()).filter(|at| table.loops[*at].line == Some(index)).collect();
        let inside = table.blocks.iter().filter(|block| block.work.iter().any(|work| work.line == Some(index)));
        match own.is_empty() {
            false => loops.extend(own),
            true => loops.extend(inside.filter_map(|block| block.in_loop)),
        }
    }
    loops.into_iter().collect()
}

/// Returns the part of a pass's time that its pixels spend in some loops and the functions called there.
fn part_in(counts: &PassCounts, loops: &[usize]) -> f64 {
    let table = &counts.table;
    let blocks = &table.blocks;
    let is_in = |block: &CountedBlock| {
        std::iter::successors(block.in_loop, |at| table.loops[*at].inside).any(|at| loops.contains(&at))
    };
    // The part of each function's calls that comes from there: callers may come later in the table.
    let mut parts: Vec<f64> = blocks.iter().map(|block| f64::from(u8::from(is_in(block)))).collect();
    for _ in 0..16 {
        let mut changed = false;
        for at in 0..blocks.len() {
            if is_in(&blocks[at]) {
                continue;
            }
            let part = match &blocks[at].entered {
                Entered::Start | Entered::Never => 0.0,
                Entered::Calls(callers) => {
                    let runs = |at: &usize| counts.runs[*at] as f64;
                    let all: f64 = callers.iter().map(runs).sum();
                    let there: f64 = callers.iter().map(|at| runs(at) * parts[*at]).sum();
                    if all > 0.0 { there / all } else { 0.0 }
                }
                Entered::Branch(from) | Entered::Iteration(from) | Entered::Continuing(from) | Entered::After(from) => {
                    parts[*from]
                }
            };
            changed |= (part - parts[at]).abs() > 1e-9;
            parts[at] = part;
        }
        if !changed {
            break;
        }
    }
    let nanos = |at: usize| counts.lanes[at] * counts.prices.of_block(&blocks[at], &counts.filters);
    let all: f64 = (0..blocks.len()).map(nanos).sum::<f64>() + counts.prices.pixel * counts.pixels as f64;
    let there: f64 = (0..blocks.len()).map(|at| nanos(at) * parts[at]).sum();
    if all > 0.0 { there / all } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Found, Kind};
    use eddy_project::Project;

    fn knob(text: &str) -> Knob {
        Found::new(&Project::of_image("test".into(), text.into())).knobs.remove(0)
    }

    #[test]
    fn a_loop_saves_at_most_its_share() {
        let text = "#define STEPS 64\nvoid mainImage(out vec4 o, in vec2 p) {\n  o = vec4(0);\n  for (int i = 0; i < STEPS; i++) o += .01;\n}";
        let knob = knob(text);
        assert_eq!((knob.kind, knob.places.len(), knob.places[0].line.number), (Kind::Count, 1, 4));
        let saving = Saving { share: 0.4, power: 1, most: Some(20.0) };
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{a} {b}");
        close(saving.at_most(&knob, 64.0), 0.0);
        close(saving.at_most(&knob, 128.0), 0.0);
        // Half the steps, with what the estimate may be off.
        close(saving.at_most(&knob, 32.0), 0.5 * (0.4 * SLACK + MORE));
        close(Saving { power: 2, ..saving }.at_most(&knob, 32.0), 0.75 * (0.4 * SLACK + MORE));
        close(Saving { share: 1.0, ..saving }.at_most(&knob, 16.0), 0.75);
        assert!(saving.is_unreached(64.0) && !saving.is_unreached(24.0));
        assert!(!Saving { most: None, ..saving }.is_unreached(64.0));
    }
}
