//! The program that a pass runs for a pixel, and its inputs.
//!
//! Owns the rasterizer of passes that draw meshes: the vertex stage by the walker, clipping, culling, the fill rule,
//! the depth test and the interpolation of varyings, as specified in chapters 2 to 4 of the OpenGL ES 3.0 specification
//! and configured by the engine's pipelines. A pass that draws no meshes runs its one program for every pixel. Texels
//! of its boundary are values of the boundary's expression, and no program writes those outside of its region. The
//! trace, the debugger and the audit all use it. Coverage and depth are those of single precision; the inputs of a
//! fragment are interpolated in both. Knows no device; there is no blending, as in the engine's pipelines.

mod clip;
mod coverage;
mod pass;
mod pixel;
mod raster;
mod vertices;
mod weights;
mod writer;

pub(crate) use pass::{PassFragments, WalkError};
pub(crate) use pixel::{Fragment, PixelContent};
pub use pixel::{MeshFragment, Origin};
pub(crate) use writer::own_texels;
