//! Adds what a file omits: normals and tangents.

use super::{
    model::{Mesh, Raw},
    normals, tangents,
    trouble::ModelError,
};
use eddy_project::Normals;

/// Returns a mesh with all attributes of its vertices. `normals` selects how missing ones are made.
pub(super) fn finished(mut raw: Raw, normals: Normals) -> Result<Mesh, ModelError> {
    if !raw.indices.len().is_multiple_of(3) {
        return Err(ModelError::broken(format!("{} corners are not a whole number of triangles", raw.indices.len())));
    }
    let count = raw.vertices.len();
    if let Some(index) = raw.indices.iter().find(|i| **i as usize >= count) {
        return Err(ModelError::broken(format!("a triangle uses vertex {index}, but there are {count}")));
    }
    let broken = |numbers: &[f32]| numbers.iter().any(|x| !x.is_finite());
    for (at, v) in raw.vertices.iter().enumerate() {
        let numbers: [(&[f32], &str); 5] = [
            (&v.position, "position"),
            (&v.normal, "normal"),
            (&v.tangent, "tangent"),
            (&v.uv, "texture coordinate"),
            (&v.color, "colour"),
        ];
        if let Some((_, what)) = numbers.into_iter().find(|(numbers, _)| broken(numbers)) {
            return Err(ModelError::broken(format!("the {what} of vertex {at} is not a number")));
        }
    }
    match normals {
        _ if raw.has_normals => {}
        Normals::Smooth => normals::smooth(&mut raw),
        Normals::Flat => normals::flat(&mut raw),
    }
    let needs_tangents = raw.has_uv && !raw.has_tangents;
    if needs_tangents {
        tangents::check(&raw)?;
    }
    let mesh = Mesh { vertices: raw.vertices, indices: raw.indices };
    Ok(if needs_tangents { tangents::with_tangents(mesh) } else { mesh })
}
