//! Wavefront OBJ. Materials are left aside: a draw has its own program and channels.

use super::{MeshError, Raw, Vertex};
use std::{fs, path::Path};

pub(super) fn load(path: &Path) -> Result<Vec<Raw>, MeshError> {
    let bytes = fs::read(path).map_err(|e| MeshError::Unreadable { path: path.to_owned(), reason: e.to_string() })?;
    let options = tobj::LoadOptions { triangulate: true, single_index: true, ignore_points: true, ignore_lines: true };
    let no_materials = |_: &Path| Ok(Default::default());
    let read = tobj::load_obj_buf(&mut &bytes[..], &options, no_materials);
    let (models, _) = read.map_err(|e| MeshError::Broken { path: path.to_owned(), reason: e.to_string() })?;
    Ok(models.into_iter().map(|m| raw(m.mesh)).collect())
}

fn raw(mesh: tobj::Mesh) -> Raw {
    let count = mesh.positions.len() / 3;
    let has = |numbers: &[f32], each: usize| count > 0 && numbers.len() == count * each;
    let three = |numbers: &[f32], i: usize| [numbers[i * 3], numbers[i * 3 + 1], numbers[i * 3 + 2]];
    let (has_normals, has_uv) = (has(&mesh.normals, 3), has(&mesh.texcoords, 2));
    let vertices = (0..count).map(|i| {
        let mut vertex = Vertex { position: three(&mesh.positions, i), ..Vertex::PLAIN };
        if has_normals {
            vertex.normal = glam::Vec3::from(three(&mesh.normals, i)).normalize_or(glam::Vec3::Y).to_array();
        }
        if has_uv {
            vertex.uv = [mesh.texcoords[i * 2], mesh.texcoords[i * 2 + 1]];
        }
        if has(&mesh.vertex_color, 3) {
            let [r, g, b] = three(&mesh.vertex_color, i);
            vertex.color = [r, g, b, 1.0];
        }
        vertex
    });
    Raw { vertices: vertices.collect(), indices: mesh.indices, has_normals, has_tangents: false, has_uv }
}
