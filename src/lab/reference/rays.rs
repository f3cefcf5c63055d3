//! Ambient occlusion by ray casting in f64, with closed forms, and meshes for the rays to hit.

use eddy_media::mesh::{self, MeshError};
use eddy_project::MeshDraw;

pub type V = [f64; 3];

pub fn add(a: V, b: V, by: f64) -> V {
    [0, 1, 2].map(|i| a[i] + by * b[i])
}

pub fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn unit(a: V) -> V {
    a.map(|x| x / dot(a, a).sqrt())
}

/// Returns the part of the cosine-weighted hemisphere over a surface that is hidden: the mean over `side` x `side`
/// stratified rays of `falloff` at the distance returned by `hit`.
pub fn hidden(from: V, normal: V, side: u32, hit: impl Fn(V, V) -> Option<f64>, falloff: impl Fn(f64) -> f64) -> f64 {
    let along = unit(cross(if normal[1].abs() < 0.9 { [0.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0] }, normal));
    let across = cross(normal, along);
    // A jittered position in each stratum that differs between points: P. L'Ecuyer's multiplier, seeded by the place.
    let mut seed = (from[0].to_bits() ^ from[1].to_bits().rotate_left(21) ^ from[2].to_bits().rotate_left(42)) | 1;
    let mut random = || {
        seed = seed.wrapping_mul(3_935_559_000_370_003_845).wrapping_add(2_691_343_689_449_507_681);
        (seed >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut sum = 0.0;
    for i in 0..side * side {
        let (u, v) = (f64::from(i % side) + random(), f64::from(i / side) + random());
        let (square, angle) = (u / f64::from(side), std::f64::consts::TAU * v / f64::from(side));
        let (r, up) = (square.sqrt(), (1.0 - square).sqrt());
        let ray = add(add(normal.map(|x| x * up), along, r * angle.cos()), across, r * angle.sin());
        sum += hit(from, ray).map_or(0.0, &falloff);
    }
    sum / f64::from(side * side)
}

/// Returns the part of a floor's cosine-weighted hemisphere that an infinite wall of a height and a distance hides:
/// (1 - cos t) / 2, t = atan(height / distance).
pub fn behind_wall(height: f64, distance: f64) -> f64 {
    0.5 * (1.0 - (height / distance).atan().cos())
}

/// Returns the part that a wall hides which is higher than the reach of the samples, where samples have the lengths
/// radius (.1 + .9 u u), u uniform, and directions weighted by the cosine: the mean over them of the segment of a disc,
/// (acos c - c sqrt(1 - c c)) / pi, c = distance / length.
pub fn behind_high_wall(radius: f64, distance: f64) -> f64 {
    const N: u32 = 1000;
    let segment = |c: f64| if c < 1.0 { (c.acos() - c * (1.0 - c * c).sqrt()) / std::f64::consts::PI } else { 0.0 };
    let length = |i: u32| radius * (0.1 + 0.9 * ((f64::from(i) + 0.5) / f64::from(N)).powi(2));
    (0..N).map(|i| segment(distance / length(i))).sum::<f64>() / f64::from(N)
}

/// Returns the part of a floor's cosine-weighted hemisphere that a sphere hides whose centre is `height` above the
/// floor, at least a radius, and `beside` to the side: R^2 h / (r^2 + h^2)^(3/2).
pub fn under_sphere(radius: f64, height: f64, beside: f64) -> f64 {
    radius * radius * height / (beside * beside + height * height).powf(1.5)
}

/// Returns the first intersection of a ray of length 1 with a sphere.
pub fn meets_sphere(centre: V, radius: f64, from: V, ray: V) -> Option<f64> {
    let q = add(from, centre, -1.0);
    let (b, c) = (dot(q, ray), dot(q, q) - radius * radius);
    let root = b * b - c;
    (root > 0.0 && -b - root.sqrt() > 0.0).then(|| -b - root.sqrt())
}

/// The root mean square, the mean and the largest absolute value of differences, and their number.
#[derive(Clone, Copy, Debug)]
pub struct Errors {
    pub rms: f64,
    pub mean: f64,
    pub most: f64,
    pub count: usize,
}

impl Errors {
    /// Summarises measured minus expected values.
    pub fn of(pairs: impl Iterator<Item = (f64, f64)>) -> Errors {
        let (mut square, mut sum, mut most, mut count) = (0.0, 0.0, 0.0f64, 0);
        for (measured, expected) in pairs {
            let off = measured - expected;
            (square, sum, most, count) = (square + off * off, sum + off, most.max(off.abs()), count + 1);
        }
        let n = count.max(1) as f64;
        Errors { rms: (square / n).sqrt(), mean: sum / n, most, count }
    }
}

/// Runs `work` for every item, on all cores.
pub fn on_all_cores<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let cores = std::thread::available_parallelism().map_or(1, |n| n.get());
    let share = items.len().div_ceil(cores).max(1);
    std::thread::scope(|scope| {
        let jobs: Vec<_> =
            items.chunks(share).map(|part| scope.spawn(|| part.iter().map(&work).collect::<Vec<R>>())).collect();
        jobs.into_iter().flat_map(|job| job.join().unwrap_or_else(|e| std::panic::resume_unwind(e))).collect()
    })
}

/// Triangles in a bounding volume hierarchy.
pub struct Meshes {
    triangles: Vec<[V; 3]>,
    nodes: Vec<Node>,
}

struct Node {
    low: V,
    high: V,
    /// A leaf contains its triangles; an inner node contains its second child, the first being the next node.
    content: Result<std::ops::Range<usize>, usize>,
}

impl Meshes {
    /// Returns the triangles that a geometry pass draws, in world space. Only built-in meshes are supported.
    pub fn of(draws: &[MeshDraw]) -> Result<Meshes, MeshError> {
        let mut triangles = Vec::new();
        for draw in draws {
            let mesh = mesh::load(&draw.mesh, draw.normals, None)?;
            let [x, y, z] = draw.rotation.map(f64::to_radians);
            let turned = |[a, b, c]: V| {
                let [b, c] = [b * x.cos() - c * x.sin(), b * x.sin() + c * x.cos()];
                let [a, c] = [a * y.cos() + c * y.sin(), -a * y.sin() + c * y.cos()];
                [a * z.cos() - b * z.sin(), a * z.sin() + b * z.cos(), c]
            };
            let place = |i: u32| {
                let p = mesh.vertices[i as usize].position.map(|x| draw.scale * f64::from(x));
                add(draw.position, turned(p), 1.0)
            };
            triangles.extend(mesh.indices.chunks_exact(3).map(|c| [place(c[0]), place(c[1]), place(c[2])]));
        }
        let mut meshes = Meshes { triangles, nodes: Vec::new() };
        meshes.split(0..meshes.triangles.len());
        Ok(meshes)
    }

    fn split(&mut self, range: std::ops::Range<usize>) {
        let corners = || self.triangles[range.clone()].iter().flatten();
        let bound = |f: fn(f64, f64) -> f64, start: f64| [0, 1, 2].map(|i| corners().fold(start, |b, p| f(b, p[i])));
        let (low, high) = (bound(f64::min, f64::INFINITY), bound(f64::max, f64::NEG_INFINITY));
        let at = self.nodes.len();
        self.nodes.push(Node { low, high, content: Ok(range.clone()) });
        if range.len() <= 4 {
            return;
        }
        let size = [0, 1, 2].map(|i| high[i] - low[i]);
        let axis = if size[0] >= size[1].max(size[2]) { 0 } else { 1 + usize::from(size[2] > size[1]) };
        let middle = |t: &[V; 3]| t[0][axis] + t[1][axis] + t[2][axis];
        let half = range.len() / 2;
        self.triangles[range.clone()].select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)));
        self.split(range.start..range.start + half);
        self.nodes[at].content = Err(self.nodes.len());
        self.split(range.start + half..range.end);
    }

    /// Returns the distance of the first triangle along a ray of length 1, if it is less than `limit`.
    pub fn hit(&self, from: V, ray: V, limit: f64) -> Option<f64> {
        let mut nearest = limit;
        let inverse = ray.map(|x| 1.0 / x);
        let mut todo = vec![0];
        while let Some(at) = todo.pop() {
            let node = &self.nodes[at];
            let (mut enter, mut leave) = (0.0f64, nearest);
            for i in 0..3 {
                let (a, b) = ((node.low[i] - from[i]) * inverse[i], (node.high[i] - from[i]) * inverse[i]);
                enter = enter.max(a.min(b));
                leave = leave.min(a.max(b));
            }
            if enter > leave + 1e-9 {
                continue;
            }
            match &node.content {
                Err(second) => todo.extend([*second, at + 1]),
                Ok(range) => {
                    for triangle in &self.triangles[range.clone()] {
                        nearest = meets(triangle, from, ray).filter(|t| *t < nearest).unwrap_or(nearest);
                    }
                }
            }
        }
        (nearest < limit).then_some(nearest)
    }
}

/// Implements T. Möller, B. Trumbore, "Fast, Minimum Storage Ray-Triangle Intersection", 1997.
fn meets([a, b, c]: &[V; 3], from: V, ray: V) -> Option<f64> {
    let (e, f) = (add(*b, *a, -1.0), add(*c, *a, -1.0));
    let p = cross(ray, f);
    let size = dot(e, p);
    if size.abs() < 1e-14 {
        return None;
    }
    let s = add(from, *a, -1.0);
    let (u, q) = (dot(s, p) / size, cross(s, e));
    let v = dot(ray, q) / size;
    let t = dot(f, q) / size;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 1e-6).then_some(t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_project::MeshSource;

    const UP: V = [0.0, 1.0, 0.0];

    #[test]
    fn rays_agree_with_the_closed_forms() {
        for (height, distance) in [(1.0, 4.0), (1.0, 1.0), (4.0, 1.0)] {
            let wall = |from: V, ray: V| {
                let t = (distance - from[0]) / ray[0];
                (t > 0.0 && t * ray[1] < height).then_some(t)
            };
            let found = hidden([0.0; 3], UP, 64, wall, |_| 1.0);
            assert!((found - behind_wall(height, distance)).abs() < 4e-3, "{height}, {distance}: {found}");
        }
        for (height, beside) in [(1.0, 0.0), (1.5, 0.7), (1.0, 2.0)] {
            let centre = [beside, height, 0.0];
            let found = hidden([0.0; 3], UP, 64, |from, ray| meets_sphere(centre, 0.8, from, ray), |_| 1.0);
            assert!((found - under_sphere(0.8, height, beside)).abs() < 4e-3, "{height}, {beside}: {found}");
        }
        // With a short reach, by the falloff that results from the sample lengths: a ray that hits something at d is
        // blocked for longer samples.
        let (radius, distance) = (0.6, 0.2);
        let wall = |from: V, ray: V| Some((distance - from[0]) / ray[0]).filter(|t| *t > 0.0);
        let falloff = |d: f64| 1.0 - ((d / radius - 0.1).max(0.0) / 0.9).sqrt().min(1.0);
        let found = hidden([0.0; 3], UP, 64, wall, falloff);
        assert!((found - behind_high_wall(radius, distance)).abs() < 4e-3, "{found}");
        // A uniform hemisphere, which a wrong kernel would measure, results in t / pi: far off.
        assert!((std::f64::consts::FRAC_1_PI * 0.25f64.atan() - behind_wall(1.0, 4.0)).abs() > 0.05);
    }

    #[test]
    fn rays_hit_meshes_at_the_right_distance() {
        let ssao = eddy_project::presets::load("ssao").unwrap().project;
        let geometry = ssao.passes.iter().find_map(|p| p.body.geometry()).unwrap();
        let draw = MeshDraw { mesh: MeshSource::parse("builtin:cube"), ..geometry.draws[0].clone() };
        let draw = MeshDraw { scale: 0.5, rotation: [0.0; 3], position: [0.0, 2.0, 0.0], ..draw };
        let cube = Meshes::of(&[draw]).unwrap();
        let at = cube.hit([0.1, 0.0, 0.05], UP, 10.0).unwrap();
        assert!((at - 1.5).abs() < 1e-6, "{at}");
        assert_eq!(cube.hit([0.6, 0.0, 0.05], UP, 10.0), None);
        assert_eq!(cube.hit([0.1, 0.0, 0.05], UP, 1.4), None);
    }

    #[test]
    fn errors_have_magnitude_and_sign() {
        let off = Errors::of([(1.0, 0.5), (0.0, 0.5), (0.5, 0.5)].into_iter());
        assert!((off.rms - (0.5f64 / 3.0).sqrt()).abs() < 1e-12 && off.mean == 0.0 && off.most == 0.5);
        assert!(Errors::of([(0.4, 0.5)].into_iter()).mean < -0.09);
    }
}
