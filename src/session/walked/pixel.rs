//! A pixel of a pass, ready to be walked.

use super::origin::Origin;
use eddy_engine::DrawInputs;
use eddy_glsl::{
    ir::Output,
    walk::{Drawn, EntryInputs, Machine, Real},
    walkable::Walkable,
};

/// Says what there is to walk at a pixel.
#[expect(clippy::large_enum_variant, reason = "there is one at a time, and nearly all are walked")]
pub enum AtPixel<'p> {
    Walked(WalkedPixel<'p>),
    /// No program leaves its value there, or none that can be walked: the texels of a boundary may be a picture's.
    Unwalked(Origin),
}

/// The program that leaves its value in a texel, and what it is handed there.
pub struct WalkedPixel<'p> {
    pub walkable: &'p Walkable,
    pub world: DrawInputs<'p>,
    pub inputs: EntryInputs,
    pub origin: Origin,
    /// The lane of the pixel in its quad.
    pub lane: usize,
    /// Statements after which a walk is given up.
    pub limit: u64,
}

impl WalkedPixel<'_> {
    /// The machine that walks the pixel.
    pub fn machine<R: Real>(&self) -> Machine<'_, R> {
        Machine::new(&self.walkable.program, &self.world, self.inputs.clone(), self.limit)
    }

    /// Returns what the pixel draws into the first target; `None` where it draws nothing.
    pub fn value<R: Real>(&self, drawn: &Drawn<R>) -> Option<[R; 4]> {
        let cells = drawn.output(Output::Target(0), self.lane)?;
        (cells.len() == 4).then(|| std::array::from_fn(|i| cells[i].float()))
    }
}
