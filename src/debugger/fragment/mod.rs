//! Owns what a pass runs for a pixel: which program, and what it is handed.
//!
//! Owns the rasterizer of passes that draw meshes: the vertex stage by the walker, clipping, culling, the fill rule,
//! the depth test and the interpolation of varyings, as chapters 2 to 4 of the OpenGL ES 3.0 specification have them
//! and the engine's pipelines set them. A pass that draws no meshes runs its one program for every pixel. Texels of its
//! boundary are what the boundary's expression makes of them, and those outside of its region nobody's. The trace, the
//! debugger and the audit all ask here. Coverage and depth are those of single precision; what a fragment is handed is
//! interpolated in both. Knows no device; nothing is blended, as no pipeline of the engine blends.

mod clip;
mod coverage;
mod pass;
mod pixel;
mod raster;
mod vertices;
mod weights;
mod writer;

pub use pass::{PassFragments, WalkError};
pub(crate) use pixel::{Fragment, PixelContent};
pub use pixel::{MeshFragment, Origin};
pub use writer::own_texels;
