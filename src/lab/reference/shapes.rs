//! Spheres, boxes and tori: the intervals of a ray inside of them, and their visible lines.

pub type V = [f64; 3];

pub fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Returns a + by * b.
pub fn along(a: V, b: V, by: f64) -> V {
    [0, 1, 2].map(|i| a[i] + by * b[i])
}

pub fn length(a: V) -> f64 {
    dot(a, a).sqrt()
}

/// A shape centred at the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Its radius.
    Sphere(f64),
    /// Half of its sides.
    Cuboid(V),
    /// The radius of the ring around the y axis, and of the tube.
    Torus(f64, f64),
}

/// A shape with a position and orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedShape {
    pub shape: Shape,
    pub centre: V,
    /// Its own x, y and z axes in the scene.
    pub axes: [V; 3],
}

/// A point of a line: of a silhouette, or of a crease between two visible faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinePoint {
    pub at: V,
    /// The direction away from the shape.
    pub out: V,
}

/// Returns axes rotated by degrees around x, then around y.
pub fn turned(x: f64, y: f64) -> [V; 3] {
    let ((sx, cx), (sy, cy)) = (x.to_radians().sin_cos(), y.to_radians().sin_cos());
    let about_x = [[1.0, 0.0, 0.0], [0.0, cx, sx], [0.0, -sx, cx]];
    about_x.map(|[a, b, c]| [cy * a + sy * c, b, cy * c - sy * a])
}

impl PlacedShape {
    fn own(&self, v: V) -> V {
        self.axes.map(|axis| dot(axis, v))
    }

    fn scene(&self, own: V) -> V {
        (0..3).fold([0.0; 3], |sum, i| along(sum, self.axes[i], own[i]))
    }

    /// Returns the intervals of the ray from + t d, d of any length, that are inside: increasing pairs of t, without
    /// those before the eye.
    pub fn spans(&self, from: V, d: V) -> Vec<(f64, f64)> {
        let (o, d) = (self.own(along(from, self.centre, -1.0)), self.own(d));
        let mut spans = match self.shape {
            Shape::Sphere(r) => ball(o, d, r).into_iter().collect(),
            Shape::Cuboid(half) => slabs(o, d, half).into_iter().collect(),
            Shape::Torus(ring, tube) => torus(o, d, ring, tube),
        };
        spans.retain(|(enters, _)| *enters > 0.0);
        spans
    }

    /// Returns the outward normal at a point of the surface.
    pub fn normal(&self, at: V) -> V {
        let p = self.own(along(at, self.centre, -1.0));
        let own = match self.shape {
            Shape::Sphere(r) => p.map(|x| x / r),
            Shape::Cuboid(half) => {
                let depth: V = [0, 1, 2].map(|i| p[i].abs() - half[i]);
                let face = (0..3).max_by(|a, b| depth[*a].total_cmp(&depth[*b])).unwrap_or(0);
                let mut n = [0.0; 3];
                n[face] = p[face].signum();
                n
            }
            Shape::Torus(ring, _) => {
                let round = p[0].hypot(p[2]);
                let n = [p[0] * (1.0 - ring / round), p[1], p[2] * (1.0 - ring / round)];
                n.map(|x| x / length(n))
            }
        };
        self.scene(own)
    }

    /// Returns points of its lines as seen from `eye`, about `count` per line, including hidden ones.
    pub fn lines(&self, eye: V, count: usize) -> Vec<LinePoint> {
        let e = self.own(along(eye, self.centre, -1.0));
        let own: Vec<(V, V)> = match self.shape {
            Shape::Sphere(r) => rim(e, r, count).into_iter().map(|p| (p, p)).collect(),
            Shape::Cuboid(half) => edges(e, half, count).into_iter().map(|p| (p, p)).collect(),
            Shape::Torus(ring, tube) => contour(e, ring, tube, count),
        };
        let place = |(p, out): (V, V)| LinePoint {
            at: along(self.centre, self.scene(p), 1.0),
            out: self.scene(out.map(|x| x / length(out))),
        };
        own.into_iter().map(place).collect()
    }
}

/// Returns the first surface that a ray hits, and the shape's index.
pub fn first_hit(shapes: &[PlacedShape], from: V, d: V) -> Option<(f64, usize)> {
    let hits = shapes.iter().enumerate().filter_map(|(i, s)| Some((s.spans(from, d).first()?.0, i)));
    hits.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// Returns whether a point of a line is visible from the eye.
pub fn is_seen(shapes: &[PlacedShape], eye: V, point: LinePoint) -> bool {
    // Slightly off the surface, so that the shape's own rim does not count.
    let to = along(along(point.at, point.out, 1e-4), eye, -1.0);
    first_hit(shapes, eye, to).is_none_or(|(t, _)| t > 1.0 - 1e-6)
}

fn ball(o: V, d: V, r: f64) -> Option<(f64, f64)> {
    let (a, b, c) = (dot(d, d), dot(o, d), dot(o, o) - r * r);
    let root = b * b - a * c;
    (root > 0.0).then(|| ((-b - root.sqrt()) / a, (-b + root.sqrt()) / a))
}

fn slabs(o: V, d: V, half: V) -> Option<(f64, f64)> {
    let (mut enters, mut leaves) = (f64::NEG_INFINITY, f64::INFINITY);
    for i in 0..3 {
        let (a, b) = ((-half[i] - o[i]) / d[i], (half[i] - o[i]) / d[i]);
        (enters, leaves) = (enters.max(a.min(b)), leaves.min(a.max(b)));
    }
    (enters < leaves).then_some((enters, leaves))
}

/// By sampling and bisection: a chord of less than 1 % of the torus may be missed, which is within 1e-5 of its size
/// from the rim.
fn torus(o: V, d: V, ring: f64, tube: f64) -> Vec<(f64, f64)> {
    const SAMPLES: usize = 200;
    let Some((low, high)) = ball(o, d, 1.0001 * (ring + tube)) else { return Vec::new() };
    let distance = |t: f64| {
        let p = along(o, d, t);
        (p[0].hypot(p[2]) - ring).hypot(p[1]) - tube
    };
    let at = |i: usize| low + (high - low) * i as f64 / SAMPLES as f64;
    let mut roots = Vec::new();
    let mut before = distance(low);
    for i in 1..=SAMPLES {
        let now = distance(at(i));
        if (before > 0.0) != (now > 0.0) {
            let (mut a, mut b) = (at(i - 1), at(i));
            for _ in 0..50 {
                let middle = 0.5 * (a + b);
                if (distance(middle) > 0.0) == (before > 0.0) { a = middle } else { b = middle }
            }
            roots.push(0.5 * (a + b));
        }
        before = now;
    }
    roots.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect()
}

/// Returns the circle in which a cone from `e` touches a sphere.
fn rim(e: V, r: f64, count: usize) -> Vec<V> {
    let far = length(e);
    let axis = e.map(|x| x / far);
    let (middle, radius) = (r * r / far, r * (1.0 - r * r / far / far).sqrt());
    let beside = if axis[1].abs() < 0.9 { [0.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0] };
    let u = cross(axis, beside);
    let u = u.map(|x| x / length(u));
    let v = cross(axis, u);
    let point = |i: usize| {
        let (s, c) = (std::f64::consts::TAU * i as f64 / count as f64).sin_cos();
        along(along(axis.map(|x| x * middle), u, radius * c), v, radius * s)
    };
    (0..count).map(point).collect()
}

/// Returns the edges of which at least one face is turned towards `e`.
fn edges(e: V, half: V, count: usize) -> Vec<V> {
    let mut points = Vec::new();
    for axis in 0..3 {
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        for (sj, sk) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
            if e[j] * sj <= half[j] && e[k] * sk <= half[k] {
                continue;
            }
            points.extend((0..count).map(|i| {
                let mut p = [0.0; 3];
                p[axis] = half[axis] * (2.0 * (i as f64 + 0.5) / count as f64 - 1.0);
                (p[j], p[k]) = (sj * half[j], sk * half[k]);
                p
            }));
        }
    }
    points
}

/// Returns points of a torus whose normal is perpendicular to the direction from `e`, with that normal. For each angle
/// of the ring the angle f of the tube satisfies A cos f + B sin f + r = 0.
fn contour(e: V, ring: f64, tube: f64, count: usize) -> Vec<(V, V)> {
    let mut points = Vec::new();
    for i in 0..count {
        let (s, c) = (std::f64::consts::TAU * i as f64 / count as f64).sin_cos();
        let (a, b) = (ring - (c * e[0] + s * e[2]), -e[1]);
        let size = a.hypot(b);
        if size <= tube {
            continue;
        }
        for sign in [-1.0, 1.0] {
            let f = b.atan2(a) + sign * (-tube / size).acos();
            let n = [f.cos() * c, f.sin(), f.cos() * s];
            points.push((along([ring * c, 0.0, ring * s], n, tube), n));
        }
    }
    points
}

fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn each() -> [PlacedShape; 3] {
        [Shape::Sphere(0.7), Shape::Cuboid([0.5, 0.6, 0.4]), Shape::Torus(0.8, 0.3)].map(|shape| PlacedShape {
            shape,
            centre: [0.2, -0.1, -5.0],
            axes: turned(35.0, 20.0),
        })
    }

    #[test]
    fn silhouettes_separate_rays_that_hit_from_rays_that_miss() {
        for shape in each() {
            let lines = shape.lines([0.0; 3], 40);
            let seen: Vec<_> = lines.iter().filter(|p| is_seen(&[shape], [0.0; 3], **p)).collect();
            assert!(seen.len() >= 40, "{shape:?}");
            let mut silhouettes = 0;
            for point in seen {
                let beside = |by: f64| first_hit(&[shape], [0.0; 3], along(point.at, point.out, by)).is_some();
                assert!(beside(-1e-3), "{shape:?}: inside of {point:?} there is nothing");
                silhouettes += usize::from(!beside(1e-3));
            }
            assert!(silhouettes >= 40, "{shape:?}: {silhouettes}");
        }
    }

    #[test]
    fn occluded_points_are_hidden() {
        let [sphere, ..] = each();
        let farther = PlacedShape { centre: [0.4, -0.2, -10.0], ..sphere };
        let hidden = |p: &LinePoint| !is_seen(&[sphere, farther], [0.0; 3], *p);
        assert!(farther.lines([0.0; 3], 30).iter().all(hidden));
        assert!(!sphere.lines([0.0; 3], 30).iter().any(hidden));
    }

    #[test]
    fn normals_are_perpendicular_to_the_surface() {
        for shape in each() {
            let d = [0.06, -0.03, -1.0];
            let Some((t, _)) = first_hit(&[shape], [0.0; 3], d) else { continue };
            let p = along([0.0; 3], d, t);
            let n = shape.normal(p);
            assert!((length(n) - 1.0).abs() < 1e-9 && dot(n, d) < 0.0, "{shape:?}");
            let out = first_hit(&[shape], along(p, n, 1.0), n.map(|x| -x)).unwrap().0;
            assert!((out - 1.0).abs() < 1e-6, "{shape:?}: {out}");
        }
    }

    #[test]
    fn rotations_are_right_handed() {
        let near = |a: V, b: V| length(along(a, b, -1.0)) < 1e-12;
        assert!(near(turned(90.0, 0.0)[1], [0.0, 0.0, 1.0]), "y goes to z about x");
        assert!(near(turned(0.0, 90.0)[2], [1.0, 0.0, 0.0]), "z goes to x about y");
    }
}
