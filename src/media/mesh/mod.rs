//! Meshes: glTF 2.0 and OBJ files, and some made by code.
//!
//! Owns what a vertex holds and where it comes from. Normals that a file does not have are made smooth, tangents as MikkTSpace
//! has them where there are texture coordinates. v runs upward, as in the rest of Eddy, so glTF's is turned; a triangle's front
//! is where its corners turn counter-clockwise.

mod builtin;
mod gltf;
mod obj;
mod shape;
mod tangents;
#[cfg(test)]
mod tests;

pub use builtin::NAMES;

use crate::project::{MeshSource, listed, nearest};
use bytemuck::{Pod, Zeroable};
use std::{
    collections::HashMap,
    path::{Path, PathBuf},
};

/// What a vertex has, as the vertex buffer holds it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Vertex {
    pub position: [f32; 3],
    /// Of length 1.
    pub normal: [f32; 3],
    /// Of length 1, along u; the fourth is the sign of the bitangent `cross(normal, tangent)`. Zeros without uv.
    pub tangent: [f32; 4],
    pub uv: [f32; 2],
    /// White where the mesh says nothing.
    pub color: [f32; 4],
}

impl Vertex {
    /// White, and else zeros.
    pub const PLAIN: Vertex =
        Vertex { position: [0.0; 3], normal: [0.0; 3], tangent: [0.0; 4], uv: [0.0; 2], color: [1.0; 4] };
}

/// Triangles: three indices each, at least one triangle.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    pub vertices: Vec<Vertex>,
    pub indices: Vec<u32>,
}

/// Why there is no mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    #[error("there is no mesh builtin:{0}")]
    UnknownBuiltin(String),
    #[error("cannot read {}: {reason}", path.display())]
    Unreadable { path: PathBuf, reason: String },
    #[error("{} is no model Eddy knows by its ending", .0.display())]
    UnknownKind(PathBuf),
    #[error("{} is broken: {reason}", path.display())]
    Broken { path: PathBuf, reason: String },
}

impl MeshError {
    /// What to do about it.
    pub fn hint(&self) -> String {
        match self {
            MeshError::UnknownBuiltin(name) => match nearest(name, NAMES) {
                Some(near) => format!("did you mean builtin:{near}?"),
                None => format!("there are {}", listed(&NAMES)),
            },
            MeshError::Unreadable { .. } => "put the file there, or name another in eddy.toml".into(),
            MeshError::UnknownKind(_) => "name a .glb, .gltf or .obj file".into(),
            MeshError::Broken { .. } => "export the model anew".into(),
        }
    }
}

/// What a file says of its triangles, before what it leaves out is made.
#[derive(Debug, Default)]
struct Raw {
    vertices: Vec<Vertex>,
    indices: Vec<u32>,
    has_normals: bool,
    has_tangents: bool,
    has_uv: bool,
}

/// Loads a mesh. A path is relative to `base`, where there is one.
pub fn load(source: &MeshSource, base: Option<&Path>) -> Result<Mesh, MeshError> {
    let path = match source {
        MeshSource::Builtin(name) => {
            return builtin::make(name).ok_or_else(|| MeshError::UnknownBuiltin(name.clone()));
        }
        MeshSource::File(path) => base.map_or_else(|| path.clone(), |base| base.join(path)),
    };
    let is = |ending: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(ending));
    let parts = if is("glb") || is("gltf") {
        gltf::load(&path)
    } else if is("obj") {
        obj::load(&path)
    } else {
        return Err(MeshError::UnknownKind(path));
    };
    let broken = |reason: String| MeshError::Broken { path: path.clone(), reason };
    let mut mesh = Mesh { vertices: Vec::new(), indices: Vec::new() };
    for raw in parts? {
        add(&mut mesh, finished(raw).map_err(broken)?);
    }
    if mesh.indices.is_empty() {
        return Err(broken("it holds no triangles".into()));
    }
    if u32::try_from(mesh.vertices.len()).is_err() {
        return Err(broken("it holds more vertices than can be counted in 32 bits".into()));
    }
    Ok(mesh)
}

/// Puts a mesh behind another.
fn add(mesh: &mut Mesh, other: Mesh) {
    let first = mesh.vertices.len() as u32;
    mesh.vertices.extend(other.vertices);
    mesh.indices.extend(other.indices.into_iter().map(|i| i.wrapping_add(first)));
}

/// A mesh with everything a vertex has.
fn finished(mut raw: Raw) -> Result<Mesh, String> {
    if !raw.indices.len().is_multiple_of(3) {
        return Err(format!("{} corners make no whole number of triangles", raw.indices.len()));
    }
    let count = raw.vertices.len();
    if let Some(index) = raw.indices.iter().find(|i| **i as usize >= count) {
        return Err(format!("a triangle names vertex {index}, and there are {count}"));
    }
    if let Some(at) = raw.vertices.iter().position(|v| v.position.iter().any(|x| !x.is_finite())) {
        return Err(format!("the position of vertex {at} is not a number"));
    }
    if !raw.has_normals {
        smooth_normals(&mut raw);
    }
    let mesh = Mesh { vertices: raw.vertices, indices: raw.indices };
    Ok(if raw.has_uv && !raw.has_tangents { tangents::with_tangents(mesh) } else { mesh })
}

/// Normals that are the mean of those of the triangles around a place, by their areas: seams of the texture do not show.
fn smooth_normals(raw: &mut Raw) {
    let key = |v: &Vertex| v.position.map(|x| (x + 0.0).to_bits());
    let mut sums: HashMap<[u32; 3], glam::DVec3> = HashMap::new();
    let place = |i: u32| glam::Vec3::from(raw.vertices[i as usize].position).as_dvec3();
    for corners in raw.indices.chunks_exact(3) {
        let [a, b, c] = [place(corners[0]), place(corners[1]), place(corners[2])];
        let normal = (b - a).cross(c - a);
        for &corner in corners {
            *sums.entry(key(&raw.vertices[corner as usize])).or_default() += normal;
        }
    }
    for vertex in &mut raw.vertices {
        let sum = sums.get(&key(vertex)).copied().unwrap_or_default();
        // A vertex of no triangle that has an area points somewhere.
        vertex.normal = sum.try_normalize().unwrap_or(glam::DVec3::Y).as_vec3().to_array();
    }
}
