//! A pixel of a pass, ready to be walked, and what its value comes from.

use eddy_engine::DrawInputs;
use eddy_glsl::{
    ir::Output,
    walk::{Drawn, EntryInputs, Machine, Real},
    walkable::Walkable,
};
use eddy_project::Region;

/// Says what there is to walk at a pixel.
#[expect(clippy::large_enum_variant, reason = "there is one at a time, and nearly all are walked")]
pub enum PixelContent<'p> {
    Fragment(Fragment<'p>),
    /// No program leaves its value there, or none that can be walked: the texels of a boundary may be a picture's.
    Undrawn(Origin),
}

/// The program that leaves its value in a texel, and what it is handed there.
pub struct Fragment<'p> {
    pub walkable: &'p Walkable,
    pub world: DrawInputs<'p>,
    pub inputs: EntryInputs,
    pub origin: Origin,
    /// The lane of the pixel in its quad.
    pub lane: usize,
    /// Statements after which a walk is given up.
    pub limit: u64,
}

impl Fragment<'_> {
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

/// Says what leaves its value in a texel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The one program of a pass that draws no meshes.
    Screen,
    /// A fragment of a mesh: the last one that the depth test and `discard` let through.
    Mesh(MeshFragment),
    /// Nothing: the texel holds the zeros that a pass that draws meshes begins with.
    Clear,
    /// The value of the pass's boundary, which is drawn over what the pass draws.
    Boundary,
    /// Nothing: the texel lies outside of this region of the pass, and holds what it held before.
    Outside(Region),
}

/// A fragment of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeshFragment {
    /// The draw of the pass, and the triangle of its mesh, from 0.
    pub draw: usize,
    pub triangle: usize,
    /// The triangle's front is seen.
    pub is_front: bool,
}

impl Origin {
    /// The draw whose programs run.
    pub fn draw(self) -> Option<usize> {
        match self {
            Origin::Mesh(fragment) => Some(fragment.draw),
            Origin::Screen | Origin::Clear | Origin::Boundary | Origin::Outside(_) => None,
        }
    }
}
