//! The execution of a pass for one pixel, step by step.
//!
//! Owns the record of a walk: calls, iterations of loops, and every value of the author's names, each with its place in
//! the text; and the history for stepping forwards and backwards, with expressions over it. The walk itself is
//! implemented in [`eddy_glsl::walk`].

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

/// The default number of statements after which a walk is stopped.
pub const STEPS: u64 = 100_000_000;

/// The steps of one pixel of a pass.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    pub steps: Vec<Step>,
    /// The number of steps that were left out because of the limit.
    pub left_out: u64,
    /// The value that the pass draws into its first target, in single precision; none if it draws nothing.
    pub value: Option<[f32; 4]>,
    /// The same path in double precision.
    pub double: Option<[f64; 4]>,
    /// The number of executed statements.
    pub statements: u64,
    /// The origin of the value. A texel that no program writes has no steps and, unless it is cleared, no value.
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

/// The limits of a recording.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    /// The number of statements after which the walk is stopped.
    pub statements: u64,
    /// The number of steps that are kept, from the first.
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
    /// Lowers `project.passes[index]`; for one that draws meshes all vertices are transformed.
    pub fn new(
        sources: &Sources<'_>,
        index: usize,
        inputs: &'p PassInputs,
        extent: Extent,
    ) -> Result<Self, TraceError> {
        let pass = PassFragments::new(sources, index, inputs, Detail::Values, extent.statements)?;
        Ok(Self { pass, size: inputs.size, extent })
    }

    /// Walks the pass for a pixel, counted from the bottom left.
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
        // One walk computes both: single precision does not depend on the double-precision shadows.
        let drawn = at.machine::<Shadowed>().run(at.lane, &mut recorder)?;
        let (steps, left_out) = recorder.end();
        let numbers = at.value(&drawn);
        let value = numbers.map(|numbers| numbers.map(|number| number.single));
        let double = numbers.map(|numbers| numbers.map(|number| number.double));
        Ok(Trace { steps, left_out, value, double, statements: drawn.steps, origin: at.origin })
    }
}

/// Walks `project.passes[index]` for one pixel, counted from the bottom left; see [`Tracer`].
pub fn trace(
    sources: &Sources<'_>,
    index: usize,
    inputs: &PassInputs,
    pixel: (u32, u32),
    extent: Extent,
) -> Result<Trace, TraceError> {
    Tracer::new(sources, index, inputs, extent)?.trace(pixel)
}

/// Returns the number of single-precision steps between two numbers: 0 for equal ones and for two NaN, `u32::MAX` if
/// only one is NaN.
pub fn ulps(a: f32, b: f32) -> u32 {
    // These integers are in the order of the numbers.
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
