//! Surfaces for generated meshes: grids that may be closed.

use super::{
    finish::finished,
    model::{Mesh, Raw, Vertex},
};
use eddy_project::Normals;
use glam::Vec3;
use std::f32::consts::TAU;

/// A grid of quads over u and v. `closed`: the last column (row) is at the place of the first, with its own texture
/// coordinate.
pub(super) struct Grid {
    pub columns: u32,
    pub rows: u32,
    pub closed: [bool; 2],
}

impl Grid {
    /// Returns the surface through `place`, seen from the side where u turns counter-clockwise into v, with smooth
    /// normals.
    pub(super) fn surface(&self, color: [f32; 3], place: impl Fn(f32, f32) -> Vec3) -> Mesh {
        let mut raw = Raw { has_uv: true, ..Raw::default() };
        for j in 0..=self.rows {
            for i in 0..=self.columns {
                let part = |n: u32, of: u32, closed: bool| (if closed { n % of } else { n }) as f32 / of as f32;
                // Exactly the first place if the grid is closed, so that normals meet.
                let at = place(part(i, self.columns, self.closed[0]), part(j, self.rows, self.closed[1]));
                raw.vertices.push(Vertex {
                    position: at.to_array(),
                    uv: [i as f32 / self.columns as f32, j as f32 / self.rows as f32],
                    color: [color[0], color[1], color[2], 1.0],
                    ..Vertex::PLAIN
                });
            }
        }
        let width = self.columns + 1;
        for j in 0..self.rows {
            for i in 0..self.columns {
                let [a, b] = [j * width + i, j * width + i + 1];
                let [c, d] = [a + width, b + width];
                for corners in [[a, b, d], [a, d, c]] {
                    // At a pole, quads become triangles.
                    let p = corners.map(|n| raw.vertices[n as usize].position);
                    if p[0] != p[1] && p[1] != p[2] && p[2] != p[0] {
                        raw.indices.extend(corners);
                    }
                }
            }
        }
        finished(raw, Normals::Smooth).expect("a grid is whole")
    }
}

/// Rotates a profile of (radius, height) around the y axis, from the bottom up.
pub(super) fn lathe(color: [f32; 3], columns: u32, profile: &[[f32; 2]]) -> Mesh {
    let rows = profile.len() as u32 - 1;
    Grid { columns, rows, closed: [true, false] }.surface(color, |u, v| {
        let [radius, y] = profile[(v * rows as f32).round() as usize];
        let angle = u * TAU;
        Vec3::new(radius * angle.sin(), y, radius * angle.cos())
    })
}

/// Half a circle from pole to pole, stretched along y: the profile of a sphere, or of a capsule.
pub(super) fn round_profile(radius: f32, straight: f32, rows: u32) -> Vec<[f32; 2]> {
    let half = |n: u32, of: u32| n as f32 / of as f32 * TAU / 4.0;
    let bottom = (0..=rows / 2).map(|n| {
        let a = half(n, rows / 2);
        // Exactly on the axis at the pole.
        [if n == 0 { 0.0 } else { radius * a.sin() }, -radius * a.cos() - straight / 2.0]
    });
    let bottom: Vec<[f32; 2]> = bottom.collect();
    let top: Vec<[f32; 2]> = bottom.iter().rev().map(|[r, y]| [*r, -y]).collect();
    let skip = usize::from(straight == 0.0);
    bottom.into_iter().chain(top.into_iter().skip(skip)).collect()
}

/// Returns a tube of `radius` around a closed curve.
pub(super) fn tube(color: [f32; 3], columns: u32, rows: u32, radius: f32, curve: impl Fn(f32) -> Vec3) -> Mesh {
    Grid { columns, rows, closed: [true, true] }.surface(color, |u, v| {
        let step = 1e-3;
        let (before, at, after) = (curve(u - step), curve(u), curve(u + step));
        let along = (after - before).normalize_or(Vec3::X);
        let out = (before + after - 2.0 * at).cross(along).normalize_or(Vec3::Y);
        let side = along.cross(out);
        let angle = v * TAU;
        at + radius * (angle.cos() * side + angle.sin() * out)
    })
}
