//! Meshes: glTF 2.0 and OBJ files, and some made by code.
//!
//! Owns what a vertex holds and where it comes from. Normals that a file does not have are made flat or
//! smooth, tangents as MikkTSpace has them where there are texture coordinates. v runs upward, as in the rest of Eddy,
//! so glTF's is turned; a triangle's front is where its corners turn counter-clockwise.

mod builtin;
mod error;
mod finish;
mod gltf;
mod load;
mod model;
mod normals;
mod obj;
mod shape;
mod tangents;
#[cfg(test)]
mod tests;
mod trouble;

pub use builtin::NAMES;
pub use error::{MeshError, MeshWarning};
pub use load::load;
pub(super) use load::{Loaded, load_within};
pub use model::{Mesh, Vertex};
