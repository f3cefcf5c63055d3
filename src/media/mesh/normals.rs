//! Computes the normals of models without any.

use super::model::{Raw, Vertex};
use glam::{DVec3, Vec3};

/// Computes normals per triangle: each gets corners of its own.
pub(super) fn flat(raw: &mut Raw) {
    let mut vertices: Vec<Vertex> = Vec::with_capacity(raw.indices.len());
    for corners in raw.indices.chunks_exact(3) {
        let mut own = [0, 1, 2].map(|n| raw.vertices[corners[n] as usize]);
        let [a, b, c] = own.map(|vertex| Vec3::from(vertex.position).as_dvec3());
        let normal = face(a, b, c).try_normalize().unwrap_or(DVec3::Y).as_vec3().to_array();
        own.iter_mut().for_each(|vertex| vertex.normal = normal);
        vertices.extend(own);
    }
    raw.indices = (0..vertices.len() as u32).collect();
    raw.vertices = vertices;
}

/// Returns the normal of a triangle, whose length is twice its area.
fn face(a: DVec3, b: DVec3, c: DVec3) -> DVec3 {
    (b - a).cross(c - a)
}

/// Computes normals as the mean of those of the triangles around a place, weighted by area: seams of the texture are
/// invisible.
pub(super) fn smooth(raw: &mut Raw) {
    let group = places(raw);
    let mut sums = vec![DVec3::ZERO; group.iter().max().map_or(0, |last| *last as usize + 1)];
    let place = |i: u32| Vec3::from(raw.vertices[i as usize].position).as_dvec3();
    for corners in raw.indices.chunks_exact(3) {
        let [a, b, c] = [place(corners[0]), place(corners[1]), place(corners[2])];
        let normal = face(a, b, c);
        for &corner in corners {
            sums[group[corner as usize] as usize] += normal;
        }
    }
    for (vertex, group) in raw.vertices.iter_mut().zip(group) {
        // A vertex without a triangle of non-zero area gets an arbitrary normal.
        vertex.normal = sums[group as usize].try_normalize().unwrap_or(DVec3::Y).as_vec3().to_array();
    }
}

/// Returns an index for each vertex that vertices at the same place share, from 0. Uses sorting, as a hash table of
/// millions of places takes several times the memory.
pub(super) fn places(raw: &Raw) -> Vec<u32> {
    // Positive and negative zero are the same place.
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
