//! Meshes: glTF 2.0 and OBJ files, and built-in ones.
//!
//! Defines the vertex format and loads meshes. Missing normals are made flat or smooth; missing tangents as by
//! MikkTSpace if there are texture coordinates. v points upward, as in the rest of Eddy, so glTF's is flipped; the
//! front of a triangle is where its corners are counter-clockwise.

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
