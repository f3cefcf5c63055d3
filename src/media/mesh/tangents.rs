//! Computes the tangents of models without any, as MikkTSpace does: normal maps are baked for those.

use super::{
    model::{Mesh, Raw, Vertex},
    normals,
    trouble::ModelError,
};
use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
use eddy_project::limits;
use std::collections::HashMap;

/// Checks that tangents can be computed in reasonable time: MikkTSpace compares all pairs of corners that meet at a
/// place.
pub(super) fn check(raw: &Raw) -> Result<(), ModelError> {
    let group = normals::places(raw);
    let mut corners = vec![0u64; group.iter().max().map_or(0, |last| *last as usize + 1)];
    raw.indices.iter().for_each(|i| corners[group[*i as usize] as usize] += 1);
    let pairs = corners.iter().fold(0u64, |sum, n| sum.saturating_add(n * n));
    let most = corners.iter().max().unwrap_or(&0);
    if pairs <= limits::TANGENT_PAIRS {
        return Ok(());
    }
    Err(ModelError::TooLarge(format!(
        "{most} corners of its triangles meet at one point, too many to compute tangents for"
    )))
}

/// Every corner of every triangle, since two triangles may have different tangents at a vertex.
struct Corners<'a> {
    mesh: &'a Mesh,
    tangents: Vec<[f32; 4]>,
}

impl Corners<'_> {
    fn vertex(&self, face: usize, vert: usize) -> &Vertex {
        &self.mesh.vertices[self.mesh.indices[face * 3 + vert] as usize]
    }
}

impl Geometry for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.mesh.indices.len() / 3
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, face: usize, vert: usize) -> [f32; 3] {
        self.vertex(face, vert).position
    }

    fn normal(&self, face: usize, vert: usize) -> [f32; 3] {
        self.vertex(face, vert).normal
    }

    fn tex_coord(&self, face: usize, vert: usize) -> [f32; 2] {
        self.vertex(face, vert).uv
    }

    fn set_tangent(&mut self, tangent_space: Option<TangentSpace>, face: usize, vert: usize) {
        self.tangents[face * 3 + vert] = tangent_space.unwrap_or_default().tangent_encoded();
    }
}

/// Returns the mesh with tangents; vertices are split where their tangents differ.
pub(super) fn with_tangents(mut mesh: Mesh) -> Mesh {
    let tangents = mesh.indices.iter().map(|i| mesh.vertices[*i as usize].tangent).collect();
    let mut corners = Corners { mesh: &mesh, tangents };
    if generate_tangents(&mut corners).is_err() {
        return mesh;
    }
    let tangents = corners.tangents;
    // By vertex and tangent.
    let mut known: HashMap<(u32, [u32; 4]), u32> = HashMap::new();
    let mut vertices = Vec::with_capacity(mesh.vertices.len());
    for (index, tangent) in mesh.indices.iter_mut().zip(tangents) {
        let old = *index;
        *index = *known.entry((old, bytemuck::cast(tangent))).or_insert_with(|| {
            vertices.push(Vertex { tangent, ..mesh.vertices[old as usize] });
            vertices.len() as u32 - 1
        });
    }
    Mesh { vertices, indices: mesh.indices }
}
