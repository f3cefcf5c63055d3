//! Normals where a model brings none.

use super::model::Raw;
use glam::{DVec3, Vec3};

/// Normals that are the mean of those of the triangles around a place, by their areas: seams of the texture do not
/// show.
pub(super) fn smooth(raw: &mut Raw) {
    let group = places(raw);
    let mut sums = vec![DVec3::ZERO; group.iter().max().map_or(0, |last| *last as usize + 1)];
    let place = |i: u32| Vec3::from(raw.vertices[i as usize].position).as_dvec3();
    for corners in raw.indices.chunks_exact(3) {
        let [a, b, c] = [place(corners[0]), place(corners[1]), place(corners[2])];
        let normal = (b - a).cross(c - a);
        for &corner in corners {
            sums[group[corner as usize] as usize] += normal;
        }
    }
    for (vertex, group) in raw.vertices.iter_mut().zip(group) {
        // A vertex of no triangle that has an area points somewhere.
        vertex.normal = sums[group as usize].try_normalize().unwrap_or(DVec3::Y).as_vec3().to_array();
    }
}

/// A number for each vertex that vertices of one place share, from 0 on. By sorting, as a hash table of millions of
/// places takes several times the memory.
pub(super) fn places(raw: &Raw) -> Vec<u32> {
    // Both zeros are one place.
    let key = |i: u32| raw.vertices[i as usize].position.map(|x| (x + 0.0).to_bits());
    let mut order: Vec<u32> = (0..raw.vertices.len() as u32).collect();
    order.sort_unstable_by_key(|i| key(*i));
    let mut group = vec![0; order.len()];
    let mut number = 0;
    for (n, i) in order.iter().enumerate() {
        number += u32::from(n > 0 && key(order[n - 1]) != key(*i));
        group[*i as usize] = number;
    }
    group
}
