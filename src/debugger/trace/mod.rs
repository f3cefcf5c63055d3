//! Owns what a pass does for one pixel, step by step.
//!
//! Owns the record of a walk: calls, turns of loops, and every value that one of the author's names takes, each with
//! its place in the text; and the history that a person goes forwards and backwards in, with expressions over it. The
//! walk itself is [`eddy_glsl::walk`]'s.

mod examine;
mod history;
mod number;
mod recorder;
pub mod travel;
mod watch_expression;

pub use crate::fragment::{MeshFragment, Origin};
pub use examine::{Breakpoint, Examiner, Printed, Traced};
pub use history::{Call, History, Iteration, Moment, MomentKind, NamedValue, Value};
pub use number::Number;
pub use recorder::{Event, Step};
pub use watch_expression::Watched;

use crate::fragment::{PassFragments, PixelContent, WalkError};
use eddy_diag::Diagnostic;
use eddy_engine::{PassInputs, Sources};
use eddy_glsl::{
    walk::{Shadowed, Stop},
    walkable::Detail,
};
use eddy_project::Region;
use recorder::Recorder;

/// Statements after which a walk is given up, unless somebody asks for another limit.
pub const STEPS: u64 = 100_000_000;

/// The way of one pixel through a pass.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    pub steps: Vec<Step>,
    /// Steps that were left out, as there were more than wanted.
    pub left_out: u64,
    /// Holds what the pass draws into its first target, in single precision; none where it draws nothing.
    pub value: Option<[f32; 4]>,
    /// The same along the same way in double precision.
    pub double: Option<[f64; 4]>,
    /// Statements that were run.
    pub statements: u64,
    /// Holds what the value comes from. What no program leaves there has no steps, and but for what is clear no value.
    pub origin: Origin,
}

/// A pass cannot be traced.
#[derive(Debug, thiserror::Error)]
pub enum TraceError {
    #[error("the pass has errors")]
    Diagnostics(Vec<Diagnostic>),
    #[error("the pass was removed")]
    Gone,
    #[error(
        "no triangle is drawn at pixel {},{} of the pass: it keeps the zeros from the start of the pass",
        .0.0, .0.1
    )]
    Clear((u32, u32)),
    #[error(
        "pixel {},{} is outside the region of the pass, {} x {} texels from {},{}: it is not drawn and keeps its \
         value",
        pixel.0, pixel.1, region.width, region.height, region.x, region.y
    )]
    Kept { pixel: (u32, u32), region: Region },
    #[error("pixel {},{} is in the boundary of the pass, which {written} overwrites after each draw", pixel.0, pixel.1)]
    Boundary { pixel: (u32, u32), written: String },
    #[error("pixel {},{} is outside the pass, which has {} x {} texels", pixel.0, pixel.1, size.0, size.1)]
    Outside { pixel: (u32, u32), size: (u32, u32) },
    #[error(
        "the pass did not end within {0} statements: raise the limit with --max-statements, or look for an endless \
         loop"
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

impl From<WalkError> for TraceError {
    fn from(error: WalkError) -> Self {
        match error {
            WalkError::Diagnostics(found) => TraceError::Diagnostics(found),
            WalkError::Stop(stop) => stop.into(),
        }
    }
}

/// Says how much is recorded.
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

/// A pass in one frame, of which any number of pixels can be traced.
pub struct Tracer<'p> {
    pass: PassFragments<'p>,
    size: (u32, u32),
    extent: Extent,
}

impl<'p> Tracer<'p> {
    /// Lowers `project.passes[index]`; of one that draws meshes all vertices are transformed.
    pub fn new(
        sources: &Sources<'_>,
        index: usize,
        inputs: &'p PassInputs,
        extent: Extent,
    ) -> Result<Self, TraceError> {
        let pass = PassFragments::new(sources, index, inputs, Detail::Values, extent.statements)?;
        Ok(Self { pass, size: inputs.size, extent })
    }

    /// Walks through the pass for a pixel, counted from the bottom left.
    pub fn trace(&self, pixel: (u32, u32)) -> Result<Trace, TraceError> {
        if pixel.0 >= self.size.0 || pixel.1 >= self.size.1 {
            return Err(TraceError::Outside { pixel, size: self.size });
        }
        let at = match self.pass.at(pixel)? {
            PixelContent::Fragment(at) => at,
            PixelContent::Undrawn(origin) => {
                let is_clear = origin == Origin::Clear;
                let (value, double) = (is_clear.then_some([0.0; 4]), is_clear.then_some([0.0; 4]));
                return Ok(Trace { steps: Vec::new(), left_out: 0, value, double, statements: 0, origin });
            }
        };
        let mut recorder = Recorder::new(at.walkable, self.extent.steps);
        // One walk gives both: the numbers of single precision know nothing of those beside them.
        let drawn = at.machine::<Shadowed>().run(at.lane, &mut recorder)?;
        let (steps, left_out) = recorder.end();
        let numbers = at.value(&drawn);
        let value = numbers.map(|numbers| numbers.map(|number| number.single));
        let double = numbers.map(|numbers| numbers.map(|number| number.double));
        Ok(Trace { steps, left_out, value, double, statements: drawn.steps, origin: at.origin })
    }
}

/// Walks through `project.passes[index]` for one pixel, counted from the bottom left; see [`Tracer`].
pub fn trace(
    sources: &Sources<'_>,
    index: usize,
    inputs: &PassInputs,
    pixel: (u32, u32),
    extent: Extent,
) -> Result<Trace, TraceError> {
    Tracer::new(sources, index, inputs, extent)?.trace(pixel)
}

/// Returns how many numbers of single precision lie between two: 0 for equal ones and for two NaN, `u32::MAX` where
/// only one is NaN.
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
