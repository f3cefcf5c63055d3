//! Triangulates faces of any number of corners, which need not be convex.
//!
//! Ears are clipped here rather than by a crate: existing ones drop corners that are collinear with their neighbours,
//! which leaves gaps next to the adjacent faces.

use crate::mesh::trouble::{ModelError, at_most};
use eddy_project::limits;
use glam::{DVec2, DVec3};

/// Triangulates the faces of a file.
#[derive(Default)]
pub(super) struct Cutter {
    /// The face projected to two dimensions, seen from its front.
    flat: Vec<DVec2>,
    /// The remaining corners of the face.
    ring: Vec<u32>,
    /// The number of visited corners, which bounds the time.
    steps: u64,
}

impl Cutter {
    /// Computes the corners of the triangles of a face with corners at these places: a fan if that covers exactly the
    /// face. There are two triangles less than corners.
    pub(super) fn triangles(&mut self, places: &[[f32; 3]], out: &mut Vec<u32>) -> Result<(), ModelError> {
        out.clear();
        let count = places.len() as u32;
        let fan = |first: u32| (2..count).map(move |i| [0, i - 1, i].map(|corner| (corner + first) % count));
        let at = |corner: u32| DVec3::from(places[corner as usize].map(f64::from));
        let area = |[a, b, c]: [u32; 3]| (at(b) - at(a)).cross(at(c) - at(a));
        // The normal of the whole face, by Newell's method: the fan's signed areas.
        let whole: DVec3 = fan(0).map(area).sum();
        // A smaller part of the face is a rounding error.
        let least = -1e-7 * whole.length_squared();
        let is_upright = |triangle: [u32; 3]| area(triangle).dot(whole) >= least;
        let found = (0..if count == 4 { 2 } else { 1 }).find(|&first| fan(first).all(is_upright));
        if found.is_none() && count > 4 {
            let (u, v) = whole.normalize().any_orthonormal_pair();
            let v = if u.cross(v).dot(whole) < 0.0 { -v } else { v };
            self.flat.clear();
            self.flat.extend((0..count).map(|corner| DVec2::new(at(corner).dot(u), at(corner).dot(v))));
            return self.cut_ears(out);
        }
        out.extend(fan(found.unwrap_or(0)).flatten());
        Ok(())
    }

    /// Clips one ear after the other: a corner whose triangle with its neighbours contains no other corner. Ears
    /// without an area come last, and so does any corner of a face that intersects itself.
    fn cut_ears(&mut self, out: &mut Vec<u32>) -> Result<(), ModelError> {
        self.ring.clear();
        self.ring.extend(0..self.flat.len() as u32);
        let mut next = 0;
        while self.ring.len() > 3 {
            let count = self.ring.len();
            let mut ear = None;
            for n in (next..next + count).map(|n| n % count) {
                self.steps += 1;
                if self.is_ear(n) {
                    ear = Some(n);
                    break;
                }
            }
            at_most(self.steps, limits::CONCAVE_STEPS, "steps to triangulate faces that are not convex")?;
            let ear = ear.unwrap_or(next % count);
            out.extend(self.around(ear));
            self.ring.remove(ear);
            // Continuing after the ear makes fewer slivers than staying at one corner.
            next = ear + 1;
        }
        out.extend_from_slice(&self.ring);
        Ok(())
    }

    /// Returns a corner of the ring between its neighbours.
    fn around(&self, n: usize) -> [u32; 3] {
        let count = self.ring.len();
        [n + count - 1, n, n + 1].map(|n| self.ring[n % count])
    }

    fn is_ear(&mut self, n: usize) -> bool {
        let corners = self.around(n);
        let [a, b, c] = corners.map(|corner| self.flat[corner as usize]);
        if side(a, b, c) <= 0.0 {
            return false;
        }
        self.steps += self.ring.len() as u64;
        let is_inside = |p: DVec2| side(a, b, p) > 0.0 && side(b, c, p) > 0.0 && side(c, a, p) >= 0.0;
        let is_in_the_way = |corner: &u32| {
            let p = self.flat[*corner as usize];
            is_inside(p) && p != a && p != b && p != c
        };
        !self.ring.iter().any(is_in_the_way)
    }
}

/// Returns twice the signed area of a triangle, which is positive if the point is left of the line `from`-`to`.
fn side(from: DVec2, to: DVec2, point: DVec2) -> f64 {
    (to - from).perp_dot(point - from)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangulates a face in a slanted plane, by its corners in that plane.
    fn cut(corners: &[[f32; 2]]) -> Vec<[u32; 3]> {
        let places: Vec<[f32; 3]> = corners.iter().map(|[x, y]| [*x, *y, 2.0 * x + y]).collect();
        let mut out = Vec::new();
        Cutter::default().triangles(&places, &mut out).unwrap();
        out.as_chunks().0.to_vec()
    }

    /// Returns twice the area, which is negative for a clockwise triangle.
    fn area(corners: &[[f32; 2]], [a, b, c]: [u32; 3]) -> f32 {
        let [a, b, c] = [a, b, c].map(|i| glam::Vec2::from(corners[i as usize]));
        (b - a).perp_dot(c - a)
    }

    #[test]
    fn a_convex_face_is_a_fan() {
        assert_eq!(cut(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), [[0, 1, 2]]);
        assert_eq!(cut(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]), [[0, 1, 2], [0, 2, 3]]);
        let five = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
        assert_eq!(cut(&five), [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
        // A face without an area.
        assert_eq!(cut(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [3.0, 3.0], [0.0, 0.0]]).len(), 3);
    }

    #[test]
    fn concave_faces_are_covered_once_for_every_start_and_winding() {
        let arrow = vec![[0.0, 0.0], [2.0, -1.0], [1.0, 0.0], [2.0, 1.0]];
        let comb = vec![
            [0.0, 0.0],
            [7.0, 0.0],
            [7.0, 3.0],
            [6.0, 3.0],
            [6.0, 1.0],
            [5.0, 1.0],
            [5.0, 3.0],
            [3.0, 3.0],
            [3.0, 1.0],
            [1.0, 1.0],
            [1.0, 3.0],
            [0.0, 3.0],
        ];
        for (mut corners, twice) in [(arrow, 2.0), (comb, 30.0)] {
            for turn in 0..2 * corners.len() {
                corners.rotate_left(1);
                if turn == corners.len() {
                    corners.reverse();
                }
                let sign = if turn < corners.len() { 1.0 } else { -1.0 };
                let triangles = cut(&corners);
                let areas: Vec<f32> = triangles.iter().map(|t| sign * area(&corners, *t)).collect();
                assert_eq!(triangles.len(), corners.len() - 2);
                assert!(areas.iter().all(|a| *a > 0.0), "{areas:?}");
                assert!((areas.iter().sum::<f32>() - twice).abs() < 1e-5, "{areas:?}");
            }
        }
    }

    #[test]
    fn the_time_for_concave_faces_is_bounded() {
        let star = |corners: u16| -> Vec<[f32; 3]> {
            let corner = |i: u16| {
                let (sin, cos) = (f32::from(i) * std::f32::consts::TAU / f32::from(corners)).sin_cos();
                let r = f32::from(1 + i % 2);
                [r * cos, r * sin, 0.0]
            };
            (0..corners).map(corner).collect()
        };
        let mut cutter = Cutter { steps: limits::CONCAVE_STEPS - 20_000, ..Cutter::default() };
        let mut out = Vec::new();
        cutter.triangles(&star(100), &mut out).unwrap();
        assert_eq!(out.len(), 3 * 98);
        let error = cutter.triangles(&star(400), &mut out).unwrap_err();
        assert!(matches!(error, ModelError::TooLarge(reason) if reason.contains("not convex")));
    }
}
