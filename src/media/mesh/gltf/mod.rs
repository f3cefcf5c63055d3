//! glTF 2.0: every triangle of the scene, with the transforms of its nodes applied. Materials, skins and animations are
//! left aside.
//!
//! The file may be damaged or made to do harm, so all of it is checked before it is used, and what it comes to is
//! counted before memory is taken: in `json` what its text says, in `nodes` the hierarchy, in `buffers` the bytes, in
//! `accessors` what is read of them.

mod accessors;
mod buffers;
mod json;
mod nodes;

use super::{
    model::{Raw, Vertex},
    trouble::{Counts, Trouble},
};
use accessors::{Elements, check};
use buffers::Named;
use glam::{Mat3, Mat4, Vec3};
use gltf::{Glb, Primitive, mesh::Mode};
use std::borrow::Cow;

/// Reads the bytes of a `.gltf` or `.glb` file, and hands every part of it to `take`.
pub(super) fn load(
    bytes: Vec<u8>,
    named: Named<'_>,
    room: u64,
    take: &mut dyn FnMut(Raw) -> Result<(), Trouble>,
) -> Result<(), Trouble> {
    let (text, blob) = split(&bytes)?;
    let document = json::document(&text)?;
    let placed = nodes::placed(&document)?;
    let mut counts = Counts::default();
    for (node, _) in &placed {
        for primitive in node.mesh().iter().flat_map(|m| m.primitives()) {
            let (vertices, triangles) = size(&primitive);
            counts.add_part()?;
            counts.add(vertices, triangles)?;
        }
    }
    counts.fit(room)?;
    let buffers = buffers::load(&document, blob, named, bytes.len() as u64)?;
    let buffers: Vec<&[u8]> = buffers.iter().map(|b| &**b).collect();
    for (node, to_world) in &placed {
        for (n, primitive) in node.mesh().iter().flat_map(|m| m.primitives()).enumerate() {
            let part = part(&primitive, *to_world, &buffers);
            let part = part.map_err(|why| Trouble::broken(format!("primitive {n} of node {}: {why}", node.index())))?;
            part.map_or(Ok(()), &mut *take)?;
        }
    }
    Ok(())
}

/// The JSON text of a file, and the binary chunk of a `.glb`.
type Chunks<'a> = (Cow<'a, [u8]>, Option<Cow<'a, [u8]>>);

fn split(bytes: &[u8]) -> Result<Chunks<'_>, Trouble> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes.into(), None));
    }
    // The crate subtracts the header's length from this without a look.
    let length = bytes.get(8..12).and_then(|b| b.try_into().ok()).map_or(0, u32::from_le_bytes);
    if length < 12 {
        return Err(Trouble::broken("its header says a length shorter than the header"));
    }
    let glb = Glb::from_slice(bytes).map_err(Trouble::broken)?;
    Ok((glb.json, glb.bin))
}

/// Vertices and triangles of a primitive, as its accessors say; none for points and lines.
fn size(primitive: &Primitive<'_>) -> (u64, u64) {
    let vertices = primitive.get(&gltf::Semantic::Positions).map_or(0, |a| a.count() as u64);
    let corners = primitive.indices().map_or(vertices, |a| a.count() as u64);
    match primitive.mode() {
        Mode::Triangles => (vertices, corners / 3),
        Mode::TriangleStrip | Mode::TriangleFan => (vertices, corners.saturating_sub(2)),
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => (0, 0),
    }
}

/// `None` for points and lines.
fn part(primitive: &Primitive<'_>, to_world: Mat4, buffers: &[&[u8]]) -> Result<Option<Raw>, String> {
    use gltf::Semantic::{Colors, Normals, Positions, Tangents, TexCoords};
    if !matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
        return Ok(None);
    }
    let positions = primitive.get(&Positions).ok_or("it has no positions")?;
    let count = positions.count();
    for (semantic, elements, what) in [
        (Positions, Elements::FLOATS_3, "positions"),
        (Normals, Elements::FLOATS_3, "normals"),
        (Tangents, Elements::FLOATS_4, "tangents"),
        (TexCoords(0), Elements::COORDINATES, "texture coordinates"),
        (Colors(0), Elements::COLORS, "colours"),
    ] {
        let Some(accessor) = primitive.get(&semantic) else { continue };
        check(&accessor, elements, what, buffers)?;
        if accessor.count() != count {
            return Err(format!("it has {count} positions and {} {what}", accessor.count()));
        }
    }
    if let Some(accessor) = primitive.indices() {
        check(&accessor, Elements::INDICES, "indices", buffers)?;
    }
    let reader = primitive.reader(|buffer| buffers.get(buffer.index()).copied());
    let positions = reader.read_positions().ok_or("it has no positions")?;
    let mut vertices: Vec<Vertex> = Vec::with_capacity(count);
    vertices.extend(
        positions.map(|p| Vertex { position: to_world.transform_point3(Vec3::from(p)).to_array(), ..Vertex::PLAIN }),
    );
    let of_normals = normal_matrix(to_world);
    let normals = reader.read_normals();
    let has_normals = normals.is_some();
    for (vertex, normal) in vertices.iter_mut().zip(normals.into_iter().flatten()) {
        vertex.normal = (of_normals * Vec3::from(normal)).normalize_or(Vec3::Y).to_array();
    }
    let uv = reader.read_tex_coords(0);
    let has_uv = uv.is_some();
    if let Some(uv) = uv {
        // glTF has v run downward.
        vertices.iter_mut().zip(uv.into_f32()).for_each(|(vertex, uv)| vertex.uv = [uv[0], 1.0 - uv[1]]);
    }
    // Tangents go with the normals they were made for.
    let tangents = reader.read_tangents().filter(|_| has_normals);
    let has_tangents = tangents.is_some();
    let mirrored = if to_world.determinant() < 0.0 { -1.0 } else { 1.0 };
    for (vertex, t) in vertices.iter_mut().zip(tangents.into_iter().flatten()) {
        let along = to_world.transform_vector3(Vec3::new(t[0], t[1], t[2])).normalize_or_zero();
        vertex.tangent = [along.x, along.y, along.z, t[3] * mirrored];
    }
    if let Some(colors) = reader.read_colors(0) {
        vertices.iter_mut().zip(colors.into_rgba_f32()).for_each(|(vertex, color)| vertex.color = color);
    }
    let corners: Vec<u32> = match reader.read_indices() {
        Some(indices) => indices.into_u32().collect(),
        None => (0..count as u32).collect(),
    };
    let mut indices = triangles(primitive.mode(), corners);
    if to_world.determinant() < 0.0 {
        // A mirror turns the fronts away.
        indices.chunks_exact_mut(3).for_each(|corners| corners.swap(1, 2));
    }
    Ok(Some(Raw { vertices, indices, has_normals, has_tangents, has_uv }))
}

/// Corners three by three.
pub(super) fn triangles(mode: Mode, corners: Vec<u32>) -> Vec<u32> {
    match mode {
        Mode::TriangleStrip => corners
            .windows(3)
            .enumerate()
            .flat_map(|(i, w)| if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] })
            .collect(),
        Mode::TriangleFan => corners.windows(2).skip(1).flat_map(|w| [corners[0], w[0], w[1]]).collect(),
        _ => corners,
    }
}

/// Returns the matrix from normals of the mesh to those of the world.
fn normal_matrix(to_world: Mat4) -> Mat3 {
    let m = Mat3::from_mat4(to_world);
    let inverse = m.inverse();
    if inverse.is_finite() { inverse.transpose() } else { m }
}
