//! The data of a mesh: its vertices in the format of the vertex buffer, and its triangles.

use bytemuck::{Pod, Zeroable};

/// The attributes of a vertex in the format of the vertex buffer.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Vertex {
    pub position: [f32; 3],
    /// The normal, of length 1.
    pub normal: [f32; 3],
    /// The tangent, of length 1 and along u; the fourth component is the sign of the bitangent
    /// `cross(normal, tangent)`. Zeros without uv.
    pub tangent: [f32; 4],
    pub uv: [f32; 2],
    /// White if the mesh has no colours.
    pub color: [f32; 4],
}

impl Vertex {
    /// A white vertex with all other attributes zero.
    pub const PLAIN: Vertex =
        Vertex { position: [0.0; 3], normal: [0.0; 3], tangent: [0.0; 4], uv: [0.0; 2], color: [1.0; 4] };
}

/// Triangles: three indices each, at least one triangle.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    pub vertices: Vec<Vertex>,
    pub indices: Vec<u32>,
}

impl Mesh {
    /// Returns its size in memory.
    pub fn bytes(&self) -> u64 {
        (size_of_val(&*self.vertices) + size_of_val(&*self.indices)) as u64
    }

    /// Appends another mesh.
    pub(super) fn append(&mut self, other: Mesh) {
        if self.vertices.is_empty() && self.indices.is_empty() {
            *self = other;
            return;
        }
        let first = self.vertices.len() as u32;
        self.vertices.extend(other.vertices);
        self.indices.extend(other.indices.into_iter().map(|i| i.wrapping_add(first)));
    }
}

/// The triangles as in a file, before missing attributes are made.
#[derive(Debug, Default)]
pub(super) struct Raw {
    pub vertices: Vec<Vertex>,
    pub indices: Vec<u32>,
    pub has_normals: bool,
    pub has_tangents: bool,
    pub has_uv: bool,
}
