//! A pixel of a pass, prepared for a walk, and the origin of its value.

use eddy_engine::DrawInputs;
use eddy_glsl::{
    ir::Output,
    walk::{Drawn, EntryInputs, Float, Machine},
    walkable::Walkable,
};
use eddy_project::Region;

/// The content of a pixel.
#[expect(clippy::large_enum_variant, reason = "there is one at a time, and nearly all are walked")]
pub(crate) enum PixelContent<'p> {
    Fragment(Fragment<'p>),
    /// No program writes its value, or none that can be walked: the texels of a boundary may come from a picture.
    Undrawn(Origin),
}

/// The program that writes the value of a texel, and its inputs there.
pub(crate) struct Fragment<'p> {
    pub walkable: &'p Walkable,
    pub world: DrawInputs<'p>,
    pub inputs: EntryInputs,
    pub origin: Origin,
    /// The lane of the pixel in its quad.
    pub lane: usize,
    /// The number of statements after which a walk is stopped.
    pub limit: u64,
}

impl Fragment<'_> {
    /// Returns the machine that walks the pixel.
    pub(crate) fn machine<R: Float>(&self) -> Machine<'_, R> {
        Machine::new(&self.walkable.program, &self.world, self.inputs.clone(), self.limit)
    }

    /// Returns the pixel's output for the first target; `None` if it draws nothing.
    pub(crate) fn value<R: Float>(&self, drawn: &Drawn<R>) -> Option<[R; 4]> {
        let cells = drawn.output(Output::Target(0), self.lane)?;
        (cells.len() == 4).then(|| std::array::from_fn(|i| cells[i].float()))
    }
}

/// The origin of a texel's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The program of a pass that draws no meshes.
    Screen,
    /// A fragment of a mesh: the last one that passed the depth test and was not discarded.
    Mesh(MeshFragment),
    /// Nothing: the texel has the zeros of the initial clear of a pass that draws meshes.
    Clear,
    /// The value of the pass's boundary, which is drawn over the pass's output.
    Boundary,
    /// Nothing: the texel is outside of this region of the pass, and has its previous value.
    Outside(Region),
}

/// A fragment of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeshFragment {
    /// The draw of the pass, and the triangle of its mesh, from 0.
    pub draw: usize,
    pub triangle: usize,
    /// True if the triangle is front-facing.
    pub is_front: bool,
}

impl Origin {
    /// Returns the draw whose programs run.
    pub fn draw(self) -> Option<usize> {
        match self {
            Origin::Mesh(fragment) => Some(fragment.draw),
            Origin::Screen | Origin::Clear | Origin::Boundary | Origin::Outside(_) => None,
        }
    }
}
