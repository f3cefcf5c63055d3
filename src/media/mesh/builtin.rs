//! Meshes made by code. All stand about the origin and fit into a ball of radius 2, y up; closed ones face outward.

use super::{
    finish::finished,
    model::{Mesh, Raw, Vertex},
    shape::{Grid, lathe, round_profile, tube},
};
use eddy_project::Normals;
use glam::{Mat3, Mat4, Vec3};
use std::{collections::HashMap, f32::consts::TAU};

/// The names that `builtin:NAME` may have.
pub const NAMES: [&str; 7] = ["plane", "cube", "sphere", "icosphere", "torus", "knot", "figure"];

const WHITE: [f32; 3] = [1.0; 3];

pub(super) fn make(name: &str) -> Option<Mesh> {
    Some(match name {
        // 2 by 2, in y = 0, facing up.
        "plane" => Grid { columns: 1, rows: 1, closed: [false; 2] }
            .surface(WHITE, |u, v| Vec3::new(2.0 * u - 1.0, 0.0, 1.0 - 2.0 * v)),
        "cube" => cube(),
        // Of radius 1, with u about the y axis and v from the south pole up.
        "sphere" => on_ball(lathe(WHITE, 64, &round_profile(1.0, 0.0, 32))),
        "icosphere" => icosphere(4),
        // About the y axis: radius 1, of the tube 0.4.
        "torus" => tube(WHITE, 96, 32, 0.4, |u| Vec3::new((u * TAU).sin(), 0.0, (u * TAU).cos())),
        // The trefoil.
        "knot" => tube(WHITE, 256, 24, 0.28, |u| {
            let t = u * TAU;
            0.5 * Vec3::new(t.sin() + 2.0 * (2.0 * t).sin(), t.cos() - 2.0 * (2.0 * t).cos(), -(3.0 * t).sin())
        }),
        "figure" => figure(),
        _ => return None,
    })
}

/// Returns the cube from -1 to 1, each face with the whole texture.
fn cube() -> Mesh {
    let mut mesh = Mesh { vertices: Vec::new(), indices: Vec::new() };
    let face = Grid { columns: 1, rows: 1, closed: [false; 2] }
        .surface(WHITE, |u, v| Vec3::new(2.0 * u - 1.0, 2.0 * v - 1.0, 1.0));
    // Front, right, back, left, top, bottom: exact quarter turns.
    for [x, y, z] in [
        [Vec3::X, Vec3::Y, Vec3::Z],
        [Vec3::NEG_Z, Vec3::Y, Vec3::X],
        [Vec3::NEG_X, Vec3::Y, Vec3::NEG_Z],
        [Vec3::Z, Vec3::Y, Vec3::NEG_X],
        [Vec3::X, Vec3::NEG_Z, Vec3::Y],
        [Vec3::X, Vec3::Z, Vec3::NEG_Y],
    ] {
        mesh.append(moved(face.clone(), Mat4::from_mat3(Mat3::from_cols(x, y, z))));
    }
    mesh
}

/// Turned and moved; without scaling that differs by direction.
fn moved(mut mesh: Mesh, by: Mat4) -> Mesh {
    let turned = |v: Vec3| by.transform_vector3(v).normalize_or_zero();
    for vertex in &mut mesh.vertices {
        vertex.position = by.transform_point3(Vec3::from(vertex.position)).to_array();
        vertex.normal = turned(Vec3::from(vertex.normal)).to_array();
        let [x, y, z, sign] = vertex.tangent;
        let along = turned(Vec3::new(x, y, z));
        vertex.tangent = [along.x, along.y, along.z, sign];
    }
    mesh
}

/// A mesh of a ball about the origin with the ball's own normals.
fn on_ball(mut mesh: Mesh) -> Mesh {
    for vertex in &mut mesh.vertices {
        vertex.normal = Vec3::from(vertex.position).normalize_or(Vec3::Y).to_array();
    }
    mesh
}

/// An icosahedron whose triangles are parted in four so many times, of radius 1; triangles of nearly one size, no uv.
fn icosphere(times: u32) -> Mesh {
    let golden = (1.0 + 5f32.sqrt()) / 2.0;
    let mut places: Vec<Vec3> = Vec::new();
    for (a, b) in [(-1.0, golden), (1.0, golden), (-1.0, -golden), (1.0, -golden)] {
        places.push(Vec3::new(a, b, 0.0));
    }
    for (a, b) in [(-1.0, golden), (1.0, golden), (-1.0, -golden), (1.0, -golden)] {
        places.push(Vec3::new(0.0, a, b));
    }
    for (a, b) in [(golden, -1.0), (golden, 1.0), (-golden, -1.0), (-golden, 1.0)] {
        places.push(Vec3::new(a, 0.0, b));
    }
    places.iter_mut().for_each(|p| *p = p.normalize());
    // All triples of corners that are neighbours, turned outward.
    let edge = places[0].distance(places[1]) * 1.01;
    let mut indices: Vec<u32> = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                let [p, q, r] = [places[a], places[b], places[c]];
                if p.distance(q) < edge && q.distance(r) < edge && r.distance(p) < edge {
                    let is_out = (q - p).cross(r - p).dot(p) > 0.0;
                    let corners = if is_out { [a, b, c] } else { [a, c, b] };
                    indices.extend(corners.map(|n| n as u32));
                }
            }
        }
    }
    for _ in 0..times {
        let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
        let mut finer = Vec::with_capacity(indices.len() * 4);
        for t in indices.chunks_exact(3) {
            let mut middle = |a: u32, b: u32| {
                *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    places.push((places[a as usize] + places[b as usize]).normalize());
                    places.len() as u32 - 1
                })
            };
            let (ab, bc, ca) = (middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0]));
            finer.extend([t[0], ab, ca, t[1], bc, ab, t[2], ca, bc, ab, bc, ca]);
        }
        indices = finer;
    }
    let vertices = places.into_iter().map(|p| Vertex { position: p.to_array(), ..Vertex::PLAIN }).collect();
    on_ball(finished(Raw { vertices, indices, ..Raw::default() }, Normals::Smooth).expect("an icosahedron is whole"))
}

/// A figure on a stand, its parts in colours of their own: something with creases, thin parts and parts before others.
fn figure() -> Mesh {
    let (coat, skin, dark, brass) = ([0.24, 0.42, 0.72], [0.93, 0.74, 0.58], [0.12, 0.13, 0.16], [0.85, 0.62, 0.22]);
    // Each surface by itself where an edge shall be sharp: normals are smooth within one.
    let mut mesh = lathe(brass, 64, &[[0.0, -1.5], [0.85, -1.5]]);
    mesh.append(lathe(brass, 64, &[[0.85, -1.5], [0.9, -1.46], [0.9, -1.34], [0.85, -1.3]]));
    mesh.append(lathe(brass, 64, &[[0.85, -1.3], [0.5, -1.29], [0.0, -1.28]]));
    // Radius of the coat at a height from 0, its hem, to 1.
    let coat_at = |t: f32| 0.62 - 0.42 * t - 0.1 * (t * TAU).sin();
    let coat_profile: Vec<[f32; 2]> =
        (0..=24).map(|n| n as f32 / 24.0).map(|t| [coat_at(t), -1.29 + 1.79 * t]).collect();
    let mut part = |made: Mesh, by: Mat4| mesh.append(moved(made, by));
    part(lathe(coat, 64, &coat_profile), Mat4::IDENTITY);
    part(
        on_ball(lathe(skin, 48, &round_profile(1.0, 0.0, 24))),
        Mat4::from_translation(Vec3::Y * 0.85) * Mat4::from_scale(Vec3::splat(0.4)),
    );
    let brim = |u: f32| 0.36 * Vec3::new((u * TAU).sin(), 0.0, (u * TAU).cos());
    part(tube(dark, 64, 16, 0.07, brim), Mat4::from_translation(Vec3::Y * 1.1));
    for profile in [&[[0.33, 0.0], [0.3, 0.3], [0.27, 0.33]][..], &[[0.27, 0.33], [0.0, 0.34]]] {
        part(lathe(dark, 48, profile), Mat4::from_translation(Vec3::Y * 1.1));
    }
    for side in [-1.0, 1.0] {
        let arm = lathe(coat, 24, &round_profile(0.11, 0.7, 12));
        let by = Mat4::from_translation(Vec3::new(side * 0.5, 0.1, 0.08)) * Mat4::from_rotation_z(side * 0.6);
        part(arm, by);
        let hand = on_ball(lathe(skin, 24, &round_profile(1.0, 0.0, 12)));
        part(hand, Mat4::from_translation(Vec3::new(side * 0.76, -0.28, 0.08)) * Mat4::from_scale(Vec3::splat(0.13)));
        let eye = on_ball(lathe(dark, 16, &round_profile(1.0, 0.0, 8)));
        part(eye, Mat4::from_translation(Vec3::new(side * 0.14, 0.92, 0.36)) * Mat4::from_scale(Vec3::splat(0.05)));
    }
    for n in 0..3 {
        let button = on_ball(lathe(brass, 16, &round_profile(1.0, 0.0, 8)));
        let y = 0.3 - 0.3 * n as f32;
        let z = coat_at((y + 1.29) / 1.79);
        part(button, Mat4::from_translation(Vec3::new(0.0, y, z)) * Mat4::from_scale(Vec3::splat(0.05)));
    }
    mesh
}
