//! Tangents where a model brings none, as MikkTSpace has them: what normal maps are baked for.

use super::{Mesh, Vertex};
use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
use std::collections::HashMap;

/// Every corner of every triangle, since two triangles of a vertex may have different tangents.
struct Corners(Vec<Vertex>);

impl Geometry for Corners {
    fn num_faces(&self) -> usize {
        self.0.len() / 3
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, face: usize, vert: usize) -> [f32; 3] {
        self.0[face * 3 + vert].position
    }

    fn normal(&self, face: usize, vert: usize) -> [f32; 3] {
        self.0[face * 3 + vert].normal
    }

    fn tex_coord(&self, face: usize, vert: usize) -> [f32; 2] {
        self.0[face * 3 + vert].uv
    }

    fn set_tangent(&mut self, tangent_space: Option<TangentSpace>, face: usize, vert: usize) {
        self.0[face * 3 + vert].tangent = tangent_space.unwrap_or_default().tangent_encoded();
    }
}

/// The mesh with tangents; vertices are parted where their tangents differ.
pub(super) fn with_tangents(mesh: Mesh) -> Mesh {
    let mut corners = Corners(mesh.indices.iter().map(|i| mesh.vertices[*i as usize]).collect());
    if generate_tangents(&mut corners).is_err() {
        return mesh;
    }
    let mut known: HashMap<[u32; 16], u32> = HashMap::new();
    let mut made = Mesh { vertices: Vec::new(), indices: Vec::with_capacity(mesh.indices.len()) };
    for vertex in corners.0 {
        let index = *known.entry(bytemuck::cast(vertex)).or_insert_with(|| {
            made.vertices.push(vertex);
            made.vertices.len() as u32 - 1
        });
        made.indices.push(index);
    }
    made
}
