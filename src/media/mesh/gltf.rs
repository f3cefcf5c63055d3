//! glTF 2.0: every triangle of the scene, with the transforms of its nodes applied. Materials, skins and animations are left
//! aside.

use super::{MeshError, Raw, Vertex};
use glam::{Mat3, Mat4, Vec3};
use gltf::{Accessor, Document, Gltf, Node, Primitive, buffer::Data, mesh::Mode};
use std::path::Path;

pub(super) fn load(path: &Path) -> Result<Vec<Raw>, MeshError> {
    let trouble = |error: gltf::Error| match error {
        gltf::Error::Io(e) => MeshError::Unreadable { path: path.to_owned(), reason: e.to_string() },
        other => MeshError::Broken { path: path.to_owned(), reason: other.to_string() },
    };
    let broken = |reason: String| MeshError::Broken { path: path.to_owned(), reason };
    let Gltf { document, blob } = Gltf::open(path).map_err(trouble)?;
    let buffers = gltf::import_buffers(&document, path.parent(), blob).map_err(|error| match error {
        gltf::Error::Io(e) => broken(format!("a file it names cannot be read: {e}")),
        other => trouble(other),
    })?;
    let mut scene = Scene { buffers: &buffers, parts: Vec::new(), on_the_way: vec![false; document.nodes().len()] };
    for node in roots(&document) {
        scene.node(&node, Mat4::IDENTITY).map_err(broken)?;
    }
    Ok(scene.parts)
}

/// Of the default scene, else of the first, else every node that is nobody's child.
fn roots(document: &Document) -> Vec<Node<'_>> {
    if let Some(scene) = document.default_scene().or_else(|| document.scenes().next()) {
        return scene.nodes().collect();
    }
    let children: Vec<usize> =
        document.nodes().flat_map(|n| n.children().map(|c| c.index()).collect::<Vec<_>>()).collect();
    document.nodes().filter(|n| !children.contains(&n.index())).collect()
}

struct Scene<'a> {
    buffers: &'a [Data],
    parts: Vec<Raw>,
    /// Nodes that lead to the one at hand.
    on_the_way: Vec<bool>,
}

impl Scene<'_> {
    fn node(&mut self, node: &Node<'_>, parent: Mat4) -> Result<(), String> {
        if std::mem::replace(&mut self.on_the_way[node.index()], true) {
            return Err(format!("node {} is a child of itself", node.index()));
        }
        let to_world = parent * Mat4::from_cols_array_2d(&node.transform().matrix());
        for (n, primitive) in node.mesh().iter().flat_map(|m| m.primitives()).enumerate() {
            let part = self.primitive(&primitive, to_world);
            self.parts.extend(part.map_err(|why| format!("primitive {n} of node {}: {why}", node.index()))?);
        }
        for child in node.children() {
            self.node(&child, to_world)?;
        }
        self.on_the_way[node.index()] = false;
        Ok(())
    }

    /// `None` for points and lines.
    fn primitive(&self, primitive: &Primitive<'_>, to_world: Mat4) -> Result<Option<Raw>, String> {
        if !matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            return Ok(None);
        }
        for (_, accessor) in primitive.attributes() {
            self.check(&accessor)?;
        }
        if let Some(accessor) = primitive.indices() {
            self.check(&accessor)?;
        }
        let reader = primitive.reader(|buffer| self.buffers.get(buffer.index()).map(|data| &data.0[..]));
        let positions = reader.read_positions().ok_or("it has no positions")?;
        let mut vertices: Vec<Vertex> = positions
            .map(|p| Vertex { position: to_world.transform_point3(Vec3::from(p)).to_array(), ..Vertex::PLAIN })
            .collect();
        let of_normals = normal_matrix(to_world);
        let count = vertices.len();
        let same = |what: &str, n: usize| {
            if n == count { Ok(()) } else { Err(format!("it has {count} positions and {n} {what}")) }
        };
        let normals: Option<Vec<[f32; 3]>> = reader.read_normals().map(Iterator::collect);
        if let Some(normals) = &normals {
            same("normals", normals.len())?;
            for (vertex, normal) in vertices.iter_mut().zip(normals) {
                vertex.normal = (of_normals * Vec3::from(*normal)).normalize_or(Vec3::Y).to_array();
            }
        }
        let uv: Option<Vec<[f32; 2]>> = reader.read_tex_coords(0).map(|uv| uv.into_f32().collect());
        if let Some(uv) = &uv {
            same("texture coordinates", uv.len())?;
            // glTF has v run downward.
            vertices.iter_mut().zip(uv).for_each(|(vertex, uv)| vertex.uv = [uv[0], 1.0 - uv[1]]);
        }
        // Tangents go with the normals they were made for.
        let tangents: Option<Vec<[f32; 4]>> =
            normals.as_ref().and_then(|_| reader.read_tangents().map(Iterator::collect));
        if let Some(tangents) = &tangents {
            same("tangents", tangents.len())?;
            let mirrored = if to_world.determinant() < 0.0 { -1.0 } else { 1.0 };
            for (vertex, t) in vertices.iter_mut().zip(tangents) {
                let along = to_world.transform_vector3(Vec3::new(t[0], t[1], t[2])).normalize_or_zero();
                vertex.tangent = [along.x, along.y, along.z, t[3] * mirrored];
            }
        }
        if let Some(colors) = reader.read_colors(0) {
            let colors: Vec<[f32; 4]> = colors.into_rgba_f32().collect();
            same("colours", colors.len())?;
            vertices.iter_mut().zip(colors).for_each(|(vertex, color)| vertex.color = color);
        }
        let corners: Vec<u32> = match reader.read_indices() {
            Some(indices) => indices.into_u32().collect(),
            None => (0..count as u32).collect(),
        };
        let mut indices = triangles(primitive.mode(), &corners);
        if to_world.determinant() < 0.0 {
            // A mirror turns the fronts away.
            indices.chunks_exact_mut(3).for_each(|corners| corners.swap(1, 2));
        }
        Ok(Some(Raw {
            vertices,
            indices,
            has_normals: normals.is_some(),
            has_tangents: tangents.is_some(),
            has_uv: uv.is_some(),
        }))
    }

    /// Whether what an accessor reads is there: the crate's readers take it for granted.
    fn check(&self, accessor: &Accessor<'_>) -> Result<(), String> {
        let views =
            accessor.view().into_iter().map(|view| (view, accessor.offset(), accessor.count(), accessor.size()));
        let sparse = accessor.sparse().into_iter().flat_map(|sparse| {
            let (indices, values) = (sparse.indices(), sparse.values());
            let width = indices.index_type().size();
            [
                (indices.view(), indices.offset(), sparse.count(), width),
                (values.view(), values.offset(), sparse.count(), accessor.size()),
            ]
        });
        for (view, offset, count, size) in views.chain(sparse) {
            let stride = view.stride().unwrap_or(size);
            let needed = count
                .checked_sub(1)
                .map_or(Some(0), |last| last.checked_mul(stride)?.checked_add(size)?.checked_add(offset));
            let there = self.buffers.get(view.buffer().index()).map_or(0, |data| data.0.len());
            let end = view.offset().checked_add(view.length());
            if needed.is_none_or(|n| n > view.length()) || end.is_none_or(|end| end > there) || stride < size {
                return Err(format!("accessor {} reaches beyond its buffer", accessor.index()));
            }
        }
        Ok(())
    }
}

/// Corners three by three.
pub(super) fn triangles(mode: Mode, corners: &[u32]) -> Vec<u32> {
    match mode {
        Mode::TriangleStrip => corners
            .windows(3)
            .enumerate()
            .flat_map(|(i, w)| if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] })
            .collect(),
        Mode::TriangleFan => corners.windows(2).skip(1).flat_map(|w| [corners[0], w[0], w[1]]).collect(),
        _ => corners.to_vec(),
    }
}

/// From normals of the mesh to those of the world.
fn normal_matrix(to_world: Mat4) -> Mat3 {
    let m = Mat3::from_mat4(to_world);
    let inverse = m.inverse();
    if inverse.is_finite() { inverse.transpose() } else { m }
}
