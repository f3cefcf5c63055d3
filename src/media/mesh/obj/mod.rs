//! Wavefront OBJ. Materials are ignored: a draw has its own program and channels. So are lines, points, curves and
//! surfaces, and the weight of a vertex, which is for these (appendix B1 of the manual of Wavefront's Advanced
//! Visualizer).
//!
//! Not parsed by a crate, because existing ones do not report the line of an error, require UTF-8, and triangulate
//! faces as if all were convex. The text is read three times: for its size, for its numbers, and for its faces, which
//! may precede their vertices. So no face is stored.

mod census;
mod elements;
mod faces;
mod numbers;
mod polygon;
#[cfg(test)]
mod tests;
mod text;

use super::{
    error::MeshWarning,
    model::{Raw, Vertex},
    trouble::ModelError,
};
use census::Census;
use elements::Elements;
use faces::Faces;

/// Reads the bytes of an `.obj` file, and passes every part of it to `take`. Returns warnings about ignored parts.
pub(super) fn load(
    bytes: &[u8],
    room: u64,
    take: &mut dyn FnMut(Raw) -> Result<(), ModelError>,
) -> Result<Vec<MeshWarning>, ModelError> {
    let text = text::decoded(bytes);
    let census = Census::of(&text)?;
    census.counts.fit(room)?;
    let elements = Elements::of(&text, &census)?;
    let drawn = Faces::new(&elements, &census, room).hand_over(&text, take)?;
    let mut warnings = census.warnings();
    warnings.extend(elements.warnings());
    if drawn == 0 {
        if census.counts.triangles > 0 {
            return Err(elements.no_places());
        }
        warnings.push(census.no_triangles()?);
        // A mesh has at least one triangle; this one has no area.
        let vertex = Vertex { position: elements.somewhere(), ..Vertex::PLAIN };
        take(Raw { vertices: vec![vertex], indices: vec![0; 3], ..Raw::default() })?;
    }
    Ok(warnings)
}
