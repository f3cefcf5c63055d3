//! Ambient occlusion by rays, in f64: what the presets that guess it from a depth buffer are held against.
#![allow(dead_code, reason = "every test file uses its own part")]

use eddy::{media::mesh, project::MeshDraw};

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

/// The part of the cosine-weighted sky over a surface that is hidden: the mean over `side` x `side` stratified rays of `falloff` at
/// the distance at which `hit` says that a ray meets something.
pub fn hidden(from: V, normal: V, side: u32, hit: impl Fn(V, V) -> Option<f64>, falloff: impl Fn(f64) -> f64) -> f64 {
    let along = unit(cross(if normal[1].abs() < 0.9 { [0.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0] }, normal));
    let across = cross(normal, along);
    // A stratum's own place, other for other points: P. L'Ecuyer's multiplier, seeded by the place.
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

/// Does `work` for every item, on all cores.
pub fn on_all_cores<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let cores = std::thread::available_parallelism().map_or(1, |n| n.get());
    let share = items.len().div_ceil(cores).max(1);
    std::thread::scope(|scope| {
        let jobs: Vec<_> =
            items.chunks(share).map(|part| scope.spawn(|| part.iter().map(&work).collect::<Vec<R>>())).collect();
        jobs.into_iter().flat_map(|job| job.join().unwrap()).collect()
    })
}

/// Triangles in a tree of boxes.
pub struct Meshes {
    triangles: Vec<[V; 3]>,
    nodes: Vec<Node>,
}

struct Node {
    low: V,
    high: V,
    /// Of a leaf its triangles; of a fork the second child, the first being the next node.
    content: Result<std::ops::Range<usize>, usize>,
}

impl Meshes {
    /// What a geometry pass draws, in the world.
    pub fn of(draws: &[MeshDraw]) -> Meshes {
        let mut triangles = Vec::new();
        for draw in draws {
            let mesh = mesh::load(&draw.mesh, None).unwrap();
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
        meshes
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
        let axis = (0..3).max_by(|&a, &b| (high[a] - low[a]).total_cmp(&(high[b] - low[b]))).unwrap();
        let middle = |t: &[V; 3]| t[0][axis] + t[1][axis] + t[2][axis];
        let half = range.len() / 2;
        self.triangles[range.clone()].select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)));
        self.split(range.start..range.start + half);
        self.nodes[at].content = Err(self.nodes.len());
        self.split(range.start + half..range.end);
    }

    /// How far along a ray of length 1 the first triangle is, if it is nearer than `limit`.
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

/// T. Möller, B. Trumbore, "Fast, Minimum Storage Ray-Triangle Intersection", 1997.
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
