//! The inputs of a draw, copied to memory: they are the world of [`eddy_glsl::walk`].
//!
//! Owns the copies of a draw's uniforms, textures and meshes from its start, and the reference implementation of a
//! sampler.

mod capture;
mod texture;
mod world;

pub(super) use capture::{Capture, texture_of};
pub use texture::{Level, LevelBy, TextureCopy};
pub use world::DrawInputs;
pub use world::{MeshInputs, PassInputs};
