//! What a pass does for one pixel, step by step.
//!
//! Owns the record of a walk: calls, turns of loops, and every value that one of the author's names takes, each with
//! its place in the text; and the history that a person goes forwards and backwards in, with expressions over it. The
//! walk itself is [`crate::glsl::walk`]'s.

mod examine;
mod history;
mod number;
mod recorder;
mod step;
pub mod travel;
mod watch;

pub use examine::{Breakpoint, Examiner, Printed, Traced};
pub use history::{Call, History, Moment, MomentKind, Shown, Turn, Value};
pub use number::Number;
pub use step::{Event, Step};
pub use watch::Watched;

use crate::{
    diag::Diagnostic,
    engine::{PassInputs, Sources},
    glsl::{
        ir::Output,
        walk::{Machine, Nobody, Shadowed, Stop},
        walkable::Walkable,
    },
};
use recorder::Recorder;

/// Statements after which a walk is given up, unless somebody asks for another limit.
pub const STEPS: u64 = 100_000_000;

/// The way of one pixel through a pass.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    pub steps: Vec<Step>,
    /// Steps that were left out, as there were more than wanted.
    pub left_out: u64,
    /// What the pass draws, in single precision; none where it draws nothing.
    pub value: Option<[f32; 4]>,
    /// The same along the same way in double precision.
    pub double: Option<[f64; 4]>,
    /// Statements that were run.
    pub statements: u64,
}

/// A pass cannot be traced.
#[derive(Debug, thiserror::Error)]
pub enum TraceError {
    #[error("the pass has errors")]
    Diagnostics(Vec<Diagnostic>),
    #[error("passes that draw meshes cannot be traced")]
    Meshes,
    #[error("pixel {},{} is outside of the pass, which has {} x {} texels", pixel.0, pixel.1, size.0, size.1)]
    Outside { pixel: (u32, u32), size: (u32, u32) },
    #[error(
        "the pass has not ended within {0} statements: let it do more by --max-statements, or look for a loop that \
             does not end"
    )]
    Endless(u64),
}

impl From<Stop> for TraceError {
    fn from(stop: Stop) -> Self {
        match stop {
            Stop::Steps(limit) => TraceError::Endless(limit),
        }
    }
}

/// How much is recorded.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// Statements after which the walk is given up.
    pub statements: u64,
    /// Steps that are kept, from the first on.
    pub steps: usize,
}

impl Default for Extent {
    fn default() -> Self {
        Self { statements: STEPS, steps: usize::MAX }
    }
}

/// Walks through `project.passes[index]` for a pixel, counted from the bottom left.
pub fn trace(
    sources: &Sources<'_>,
    index: usize,
    inputs: &PassInputs,
    pixel: (u32, u32),
    extent: Extent,
) -> Result<Trace, TraceError> {
    if pixel.0 >= inputs.size.0 || pixel.1 >= inputs.size.1 {
        return Err(TraceError::Outside { pixel, size: inputs.size });
    }
    let walkable = sources.walkable(index).ok_or(TraceError::Meshes)?.map_err(TraceError::Diagnostics)?;
    let mut recorder = Recorder::new(&walkable, extent.steps);
    let lane = Machine::<f32>::lane_of(pixel);
    let machine = Machine::<f32>::new(&walkable.program, inputs, pixel, extent.statements);
    let drawn = machine.run(lane, &mut recorder)?;
    let value = drawn.outputs.iter().find(|(output, _)| *output == Output::Target(0)).map(|(_, cells)| &cells[lane]);
    let value = value.filter(|cells| cells.len() == 4).map(|cells| std::array::from_fn(|i| cells[i].float()));
    let (steps, left_out) = recorder.end();
    let double = shadowed(&walkable, inputs, pixel, extent.statements)?;
    Ok(Trace { steps, left_out, value, double, statements: drawn.steps })
}

fn shadowed(
    walkable: &Walkable,
    inputs: &PassInputs,
    pixel: (u32, u32),
    limit: u64,
) -> Result<Option<[f64; 4]>, TraceError> {
    let lane = Machine::<Shadowed>::lane_of(pixel);
    let drawn = Machine::<Shadowed>::new(&walkable.program, inputs, pixel, limit).run(lane, &mut Nobody)?;
    let cells = drawn.outputs.iter().find(|(output, _)| *output == Output::Target(0)).map(|(_, cells)| &cells[lane]);
    let cells = cells.filter(|cells| cells.len() == 4);
    Ok(cells.map(|cells| std::array::from_fn(|i| cells[i].float().double)))
}

/// How many numbers of single precision lie between two: 0 for equal ones and for two NaN, `u32::MAX` where only one is
/// NaN.
pub fn ulps(a: f32, b: f32) -> u32 {
    // The order of the numbers is that of these integers.
    let rank = |x: f32| {
        let bits = x.to_bits() as i32;
        i64::from(if bits < 0 { i32::MIN.wrapping_sub(bits) } else { bits })
    };
    match (a.is_nan(), b.is_nan()) {
        (true, true) => 0,
        (false, false) => rank(a).abs_diff(rank(b)).min(u64::from(u32::MAX - 1)) as u32,
        _ => u32::MAX,
    }
}

#[cfg(test)]
mod tests;
