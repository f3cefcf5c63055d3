//! Wavefront OBJ. Materials are left aside: a draw has its own program and channels.

use super::{
    model::{Raw, Vertex},
    trouble::{Counts, Trouble},
};
use std::path::Path;

/// Reads the bytes of an `.obj` file, and hands every part of it to `take`.
pub(super) fn load(bytes: &[u8], room: u64, take: &mut dyn FnMut(Raw) -> Result<(), Trouble>) -> Result<(), Trouble> {
    measure(bytes)?.fit(room)?;
    let options = tobj::LoadOptions { triangulate: true, single_index: true, ignore_points: true, ignore_lines: true };
    let no_materials = |_: &Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut &bytes[..], &options, no_materials).map_err(Trouble::broken)?;
    models.into_iter().try_for_each(|m| take(raw(m.mesh)))
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

/// Counts what the file comes to, and looks at the numbers in its faces, which the crate multiplies before it compares
/// them.
fn measure(bytes: &[u8]) -> Result<Counts, Trouble> {
    let mut counts = Counts::default();
    for (n, line) in bytes.split(|b| *b == b'\n').enumerate() {
        let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        match words.next() {
            Some(b"v") => counts.add(1, 0)?,
            Some(b"f" | b"l") => {
                let mut corners: u64 = 0;
                for index in words.flat_map(|corner| {
                    corners += 1;
                    corner.split(|b| *b == b'/')
                }) {
                    // An element takes at least a byte of the file.
                    let number = str::from_utf8(index).ok().and_then(|text| text.parse::<i64>().ok());
                    if let Some(far) = number.filter(|n| n.unsigned_abs() > bytes.len() as u64) {
                        return Err(Trouble::broken(format!("line {} names element {far}, which is not there", n + 1)));
                    }
                }
                counts.add(0, corners.saturating_sub(2))?;
            }
            Some(b"o" | b"g" | b"usemtl") => counts.add_part()?,
            _ => {}
        }
    }
    Ok(counts)
}
