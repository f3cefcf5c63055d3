//! Owns what a texel's value comes from.

use eddy_project::Region;

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
