//! A vertex as its stage leaves it.

use eddy_glsl::walk::{Cell, Shadowed};

/// The outputs of a vertex stage for one vertex, in both precisions.
#[derive(Clone, Debug)]
pub struct Corner {
    /// In the clip space of a device: y = w is row 0, and depth goes from 0 to w.
    pub position: [Shadowed; 4],
    /// By their locations.
    pub varyings: Vec<CornerVarying>,
}

/// Holds what a vertex hands on at one location.
#[derive(Clone, Debug)]
pub struct CornerVarying {
    pub location: u32,
    pub is_flat: bool,
    /// One to four components.
    pub cells: Vec<Cell<Shadowed>>,
}
