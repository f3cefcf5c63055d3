//! Converts a primitive to triangles in world space: its attributes, displaced by morph targets, then posed by joints
//! or transformed by its node.

use super::{
    accessors::{Elements, Source, Values},
    document::{Attributes, Index, Primitive},
    extensions,
    skins::Bound,
    texture::Transform,
};
use crate::mesh::{
    model::{Raw, Vertex},
    trouble::ModelError,
};
use glam::{DAffine3, DMat3, DVec3};

/// The topologies of section 3.7.2.1 by number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    Points,
    Lines,
    Triangles,
    Strip,
    Fan,
}

impl Mode {
    pub(super) fn of(primitive: &Primitive) -> Result<Mode, ModelError> {
        Ok(match primitive.mode {
            0 => Mode::Points,
            1..=3 => Mode::Lines,
            4 => Mode::Triangles,
            5 => Mode::Strip,
            6 => Mode::Fan,
            other => return Err(ModelError::broken(format!("its mode is {other}, but glTF has 0 to 6"))),
        })
    }

    /// Returns the number of triangles for this number of corners.
    pub(super) fn triangles(self, corners: u64) -> u64 {
        match self {
            Mode::Points | Mode::Lines => 0,
            Mode::Triangles => corners / 3,
            Mode::Strip | Mode::Fan => corners.saturating_sub(2),
        }
    }
}

/// The placement of a primitive.
pub(super) enum Pose<'a> {
    /// At its node, or at each of that node's instances.
    Placed(DAffine3),
    /// By its joints. The node's own transform is ignored (section 3.7.3.2).
    Bound(Bound<'a>),
}

/// A primitive of triangles with positions, and the weights of its morph targets.
pub(super) struct Part<'a> {
    pub source: Source<'a>,
    pub primitive: &'a Primitive,
    pub mode: Mode,
    pub weights: &'a [f32],
    /// By material: see [`super::texture`].
    pub textures: &'a [Option<Transform>],
}

impl<'a> Part<'a> {
    /// Returns the morph targets that affect the shape.
    pub(super) fn targets(&self) -> impl Iterator<Item = (&'a Attributes, f32)> {
        self.primitive.targets.iter().zip(self.weights.iter().copied()).filter(|(_, weight)| *weight != 0.0)
    }

    /// Returns whether its elements are stored by an extension that Eddy does not read, which [`Part::values`] reports.
    pub(super) fn is_compressed(&self) -> bool {
        self.primitive.extensions.draco.is_some()
    }

    pub(super) fn attributes(&self) -> &'a Attributes {
        &self.primitive.attributes
    }

    fn values(&self, index: Index, kind: Elements, what: &str, count: u64) -> Result<Values<'a>, ModelError> {
        let accessor = &self.source.root.accessors[index as usize];
        if self.primitive.extensions.draco.is_some() && accessor.buffer_view.is_none() && accessor.sparse.is_none() {
            return Err(extensions::draco());
        }
        let values = self.source.values(index, kind, what)?;
        if values.count as u64 == count {
            return Ok(values);
        }
        Err(ModelError::broken(format!("it has {count} positions but {} {what}", values.count)))
    }

    /// Reads it at `pose`.
    pub(super) fn raw(&self, pose: &Pose<'a>) -> Result<Raw, ModelError> {
        let attributes = self.attributes();
        let mut raw = self.modelled()?;
        if let Pose::Bound(bound) = pose {
            let count = raw.vertices.len();
            for (what, there) in bound.counts() {
                if there != count {
                    return Err(ModelError::broken(format!("it has {count} positions but {there} {what}")));
                }
            }
        }
        raw.indices = self.corners(raw.vertices.len())?;
        raw.has_normals = attributes.normal.is_some();
        raw.has_tangents = attributes.tangent.is_some() && raw.has_normals;
        raw.has_uv = attributes.uv.is_some();
        match pose {
            Pose::Placed(to_world) => {
                let moved = Moved::by(*to_world);
                raw.vertices.iter_mut().for_each(|vertex| moved.apply(vertex));
                if moved.sign < 0.0 {
                    // A mirroring transform turns fronts into backs.
                    raw.indices.chunks_exact_mut(3).for_each(|corners| corners.swap(1, 2));
                }
            }
            Pose::Bound(bound) => {
                let mut is_mirrored = vec![false; raw.vertices.len()];
                bound.each(|n, to_world| {
                    let moved = Moved::by(to_world);
                    moved.apply(&mut raw.vertices[n]);
                    is_mirrored[n] = moved.sign < 0.0;
                })?;
                // Joints may mirror a part of the mesh: the majority of a triangle's corners decides.
                for corners in raw.indices.chunks_exact_mut(3) {
                    let at = |i: u32| is_mirrored.get(i as usize).copied().unwrap_or_default();
                    if corners.iter().filter(|i| at(**i)).count() >= 2 {
                        corners.swap(1, 2);
                    }
                }
            }
        }
        Ok(raw)
    }

    /// Returns the vertices with their morph targets applied, in the mesh's own space.
    fn modelled(&self) -> Result<Raw, ModelError> {
        let attributes = self.attributes();
        let Some(position) = attributes.position else { return Ok(Raw::default()) };
        let count = self.source.root.accessors[position as usize].count;
        let positions = self.values(position, Elements::POSITIONS, "positions", count)?;
        let mut vertices: Vec<Vertex> = Vec::with_capacity(positions.count);
        vertices.extend(positions.floats([0.0; 3]).map(|position| Vertex { position, ..Vertex::PLAIN }));
        let mut texture = None;
        if let Some(index) = attributes.normal {
            let values = self.values(index, Elements::NORMALS, "normals", count)?;
            vertices.iter_mut().zip(values.floats([0.0; 3])).for_each(|(vertex, v)| vertex.normal = v);
        }
        // Tangents are only valid for the normals they were made for.
        if let Some(index) = attributes.tangent.filter(|_| attributes.normal.is_some()) {
            let values = self.values(index, Elements::TANGENTS, "tangents", count)?;
            vertices.iter_mut().zip(values.floats([0.0; 4])).for_each(|(vertex, v)| vertex.tangent = v);
        }
        if let Some(index) = attributes.uv {
            let values = self.values(index, Elements::COORDINATES, "texture coordinates", count)?;
            vertices.iter_mut().zip(values.floats([0.0; 2])).for_each(|(vertex, v)| vertex.uv = v);
            if values.are_integers() {
                texture = self.primitive.material.and_then(|m| self.textures.get(m as usize).copied().flatten());
            }
        }
        if let Some(index) = attributes.color {
            let values = self.values(index, Elements::COLORS, "colours", count)?;
            vertices.iter_mut().zip(values.floats([1.0; 4])).for_each(|(vertex, v)| vertex.color = v);
        }
        for (target, weight) in self.targets() {
            self.morph(&mut vertices, target, weight, count)?;
        }
        for vertex in &mut vertices {
            if let Some(texture) = &texture {
                vertex.uv = texture.apply(vertex.uv);
            }
            // In glTF, v points downward.
            vertex.uv[1] = if attributes.uv.is_some() { 1.0 - vertex.uv[1] } else { 0.0 };
            vertex.color = vertex.color.map(|c| if c.is_nan() { c } else { c.clamp(0.0, 1.0) });
        }
        Ok(Raw { vertices, ..Raw::default() })
    }

    /// Adds a target's displacements (section 3.7.2.2). Those of an attribute that the primitive lacks are ignored.
    fn morph(&self, vertices: &mut [Vertex], target: &Attributes, weight: f32, count: u64) -> Result<(), ModelError> {
        fn add<const N: usize>(
            vertices: &mut [Vertex],
            values: &Values<'_>,
            weight: f32,
            place: impl Fn(&mut Vertex) -> &mut [f32],
        ) {
            for (vertex, shift) in vertices.iter_mut().zip(values.floats([0.0; N])) {
                place(vertex).iter_mut().zip(shift).for_each(|(x, shift)| *x += weight * shift);
            }
        }
        let base = self.attributes();
        let values = |index: Option<Index>, base: Option<Index>, kind, what| {
            index.filter(|_| base.is_some()).map(|index| self.values(index, kind, what, count)).transpose()
        };
        if let Some(shifts) =
            values(target.position, base.position, Elements::POSITIONS, "positions of a morph target")?
        {
            add::<3>(vertices, &shifts, weight, |vertex| &mut vertex.position);
        }
        if let Some(shifts) = values(target.normal, base.normal, Elements::NORMALS, "normals of a morph target")? {
            add::<3>(vertices, &shifts, weight, |vertex| &mut vertex.normal);
        }
        // The sign of a tangent stays.
        if let Some(shifts) = values(target.tangent, base.tangent, Elements::NORMALS, "tangents of a morph target")? {
            add::<3>(vertices, &shifts, weight, |vertex| &mut vertex.tangent[..3]);
        }
        let what = "texture coordinates of a morph target";
        if let Some(shifts) = values(target.uv, base.uv, Elements::COORDINATE_SHIFTS, what)? {
            add::<2>(vertices, &shifts, weight, |vertex| &mut vertex.uv);
        }
        if let Some(shifts) = values(target.color, base.color, Elements::COLOR_SHIFTS, "colours of a morph target")? {
            add::<4>(vertices, &shifts, weight, |vertex| &mut vertex.color);
        }
        Ok(())
    }

    /// Returns the corners of its triangles, three by three.
    fn corners(&self, count: usize) -> Result<Vec<u32>, ModelError> {
        let Some(index) = self.primitive.indices else {
            return Ok(triangles(self.mode, (0..count as u32).collect()));
        };
        let accessor = &self.source.root.accessors[index as usize];
        let indices = self.values(index, Elements::INDICES, "indices", accessor.count)?;
        let corners: Vec<u32> = indices.integers().collect();
        let restart = indices.restart();
        if (restart as usize) >= count && corners.contains(&restart) {
            return Err(ModelError::broken(format!(
                "its indices use primitive restart at {restart}, which glTF 2.0 does not allow"
            )));
        }
        Ok(triangles(self.mode, corners))
    }
}

/// Returns corners three by three. Leftover corners form no triangle.
fn triangles(mode: Mode, mut corners: Vec<u32>) -> Vec<u32> {
    match mode {
        Mode::Strip => corners
            .windows(3)
            .enumerate()
            .flat_map(|(i, w)| if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] })
            .collect(),
        Mode::Fan => corners.windows(2).skip(1).flat_map(|w| [corners[0], w[0], w[1]]).collect(),
        Mode::Points | Mode::Lines | Mode::Triangles => {
            corners.truncate(corners.len() / 3 * 3);
            corners
        }
    }
}

/// A transform of vertices with its effect on normals and tangents.
struct Moved {
    by: DAffine3,
    normals: DMat3,
    /// -1 if it mirrors.
    sign: f64,
}

impl Moved {
    fn by(by: DAffine3) -> Moved {
        let m = by.matrix3;
        // The transposed inverse except for its length, which also exists for a matrix that flattens. Scaled first, as
        // that of small numbers is tiny.
        let largest = m.to_cols_array().into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let m = if largest > 0.0 { m * (1.0 / largest) } else { m };
        let sign = if m.determinant() < 0.0 { -1.0 } else { 1.0 };
        let [a, b, c] = [m.x_axis, m.y_axis, m.z_axis];
        Moved { by, normals: DMat3::from_cols(b.cross(c), c.cross(a), a.cross(b)) * sign, sign }
    }

    fn apply(&self, vertex: &mut Vertex) {
        vertex.position = self.by.transform_point3(double(vertex.position)).as_vec3().to_array();
        let normal = self.normals * double(vertex.normal);
        vertex.normal = normal.normalize_or(DVec3::Y).as_vec3().to_array();
        let [x, y, z, side] = vertex.tangent;
        let along = self.by.transform_vector3(double([x, y, z])).normalize_or_zero().as_vec3();
        vertex.tangent = [along.x, along.y, along.z, side * self.sign as f32];
    }
}

fn double(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_of_a_strip_and_a_fan_all_face_one_way() {
        // Verified by hand with the figures of section 3.7.2.1 of the glTF specification.
        let corners = vec![0, 1, 2, 3, 4];
        assert_eq!(triangles(Mode::Strip, corners.clone()), [0, 1, 2, 2, 1, 3, 2, 3, 4]);
        assert_eq!(triangles(Mode::Fan, corners.clone()), [0, 1, 2, 0, 2, 3, 0, 3, 4]);
        assert_eq!(triangles(Mode::Triangles, corners), [0, 1, 2]);
    }
}
