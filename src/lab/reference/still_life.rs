//! The still life of the presets with a G-buffer, as distances in f64: the intersections of rays, and the projection to
//! the camera.
//!
//! Sizes and places are those of the scene's description; nothing is read from the G-buffer.

use super::rays::{V, add, cross, dot, unit};

/// The material of a hit, as numbered in the G-buffer.
pub const TABLE: u32 = 1;
pub const DIE: u32 = 3;

/// The size of the table.
pub const FAR: f64 = 14.0;

/// A ray that is nearer to a surface than this has hit it.
const NEAR: f64 = 2e-5;

fn cylinder(p: V, radius: f64, half: f64) -> f64 {
    let q = [p[0].hypot(p[2]) - radius, p[1].abs() - half];
    q[0].max(q[1]).min(0.0) + q[0].max(0.0).hypot(q[1].max(0.0))
}

/// Returns the distance to the things on the table: a mug, a die, a ball, a ring.
pub fn things(p: V) -> f64 {
    let q = add(p, [-0.80, 0.56, -0.25], -1.0);
    let inside = cylinder(add(q, [0.0, 0.12, 0.0], -1.0), 0.39, 0.52);
    let handle = ((q[0] + 0.50).hypot(q[1]) - 0.27).hypot(q[2]) - 0.07;
    let handle = handle.max(if q[0].hypot(q[2]) > 0.44 { -1.0 } else { 1.0 });
    let mug = (cylinder(q, 0.46, 0.52).max(-inside) - 0.03).min(handle);
    let b = add(p, [0.78, 0.40, -0.38], -1.0);
    let r = [0.84 * b[0] + 0.54 * b[2], b[1], -0.54 * b[0] + 0.84 * b[2]].map(|x| x.abs() - 0.37);
    let outside = r.map(|x| x.max(0.0));
    let die = dot(outside, outside).sqrt() + r[0].max(r[1]).max(r[2]).min(0.0) - 0.02;
    let c = add(p, [0.05, 0.36, 0.62], -1.0);
    let ball = dot(c, c).sqrt() - 0.36;
    let ring = ((p[0] - 0.92).hypot(p[2] - 0.78) - 0.30).hypot(p[1] - 0.11) - 0.11;
    mug.min(die).min(ball).min(ring)
}

/// Returns the distance of the first of the things along a ray of length 1, if it is less than `limit`.
pub fn march(from: V, ray: V, limit: f64) -> Option<f64> {
    let mut t = 0.0;
    while t < limit {
        let p = add(from, ray, t);
        // Above all things, without returning to them.
        if p[1] > 1.2 && ray[1] >= 0.0 {
            return None;
        }
        let d = things(p);
        if d < NEAR {
            return Some(t);
        }
        t += d;
    }
    None
}

/// Does the same for the things and the table.
pub fn first(from: V, ray: V, limit: f64) -> Option<f64> {
    let table = if ray[1] < 0.0 { -from[1] / ray[1] } else { f64::INFINITY };
    march(from, ray, limit.min(table)).or((table < limit).then_some(table))
}

pub fn is_table(at: V) -> bool {
    at[1] < 1e-9
}

/// Returns the normal at a place that a ray has hit.
pub fn normal(at: V) -> V {
    if is_table(at) {
        return [0.0, 1.0, 0.0];
    }
    let slope = |axis: usize| {
        let step = [0, 1, 2].map(|i| if i == axis { 1e-5 } else { 0.0 });
        things(add(at, step, 1.0)) - things(add(at, step, -1.0))
    };
    unit([slope(0), slope(1), slope(2)])
}

/// The camera at rest on a canvas: 0.35 round, 0.46 down, 5.2 away.
#[derive(Clone, Copy, Debug)]
pub struct View {
    pub eye: V,
    right: V,
    up: V,
    back: V,
    size: [f64; 2],
    /// Pixels per unit at distance 1.
    focal: f64,
}

impl View {
    pub fn new(width: u32, height: u32) -> View {
        let (angle, pitch) = (0.35f64, 0.46f64);
        let back = [angle.sin() * pitch.cos(), pitch.sin(), angle.cos() * pitch.cos()];
        let right = unit(cross([0.0, 1.0, 0.0], back));
        let size = [f64::from(width), f64::from(height)];
        let focal = size[1].min(0.8 * size[0]) * 1.8;
        View { eye: add([0.0, 0.42, 0.05], back, 5.2), right, up: cross(back, right), back, size, focal }
    }

    /// Returns the direction towards a place of the picture, of length 1.
    pub fn ray(&self, pixel: [f64; 2]) -> V {
        let q = [0, 1].map(|i| (pixel[i] - 0.5 * self.size[i]) / self.focal);
        unit(add(add(self.right.map(|v| v * q[0]), self.up, q[1]), self.back, -1.0))
    }

    /// Returns the projection of a point in pixels; `None` outside of the picture or behind the camera.
    pub fn pixel(&self, point: V) -> Option<[f64; 2]> {
        let d = add(point, self.eye, -1.0);
        let depth = -dot(d, self.back);
        let at = [
            0.5 * self.size[0] + self.focal * dot(d, self.right) / depth,
            0.5 * self.size[1] + self.focal * dot(d, self.up) / depth,
        ];
        (depth > 0.0 && (0..2).all(|i| at[i] >= 0.0 && at[i] < self.size[i])).then_some(at)
    }

    /// Returns whether a point on a surface is visible from the camera.
    pub fn sees(&self, point: V) -> bool {
        let d = add(point, self.eye, -1.0);
        let distance = dot(d, d).sqrt();
        first(self.eye, unit(d), 2.0 * distance).is_some_and(|t| t > distance - 2e-3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_and_projections_agree() {
        let view = View::new(320, 180);
        for pixel in [[10.5, 20.5], [160.0, 90.0], [300.25, 170.0]] {
            let point = add(view.eye, view.ray(pixel), 3.0);
            let back = view.pixel(point).unwrap();
            assert!((0..2).all(|i| (back[i] - pixel[i]).abs() < 1e-9), "{pixel:?} {back:?}");
        }
        assert_eq!(view.pixel(add(view.eye, view.ray([160.0, 90.0]), -3.0)), None);
    }

    #[test]
    fn nearer_things_hide_those_behind_them() {
        let view = View::new(320, 180);
        let ball = [0.05, 0.36, 0.62];
        let towards = unit(add(ball, view.eye, -1.0));
        let near = add(view.eye, towards, first(view.eye, towards, FAR).unwrap());
        assert!((dot(add(near, ball, -1.0), add(near, ball, -1.0)).sqrt() - 0.36).abs() < 1e-3, "the ball's front");
        assert!(view.sees(near) && !view.sees(add(ball, towards, 0.36)), "its back is hidden");
        assert!(dot(normal(near), towards) < -0.99);
    }
}
