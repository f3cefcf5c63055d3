//! Lines detected in a G-buffer, compared with the silhouettes and creases of its content.

use super::silhouettes::Found;
use crate::{
    HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit,
    reference::shapes::{PlacedShape, Shape, V, along, dot, first_hit, is_seen, turned},
    three_of,
};
use std::{borrow::Cow, sync::LazyLock};

const SENSITIVITIES: &[f64] = &[0.25, 0.5, 1.0, 2.0, 4.0];

const METHODS: &[Method] = &[
    Method { name: "preset", title: "the preset gbuffer-edges", settings: SENSITIVITIES, usual: 1.0 },
    Method { name: "roberts", title: "Roberts' cross", settings: SENSITIVITIES, usual: 1.0 },
    Method { name: "sobel", title: "Sobel's operator", settings: SENSITIVITIES, usual: 1.0 },
    Method { name: "laplacian", title: "Laplacian", settings: SENSITIVITIES, usual: 1.0 },
];

/// The focal length of the preset's camera: the picture's unit, 0.8 of the width of a square canvas, at distance 1.8 is
/// 1 long.
const FOCAL: f64 = 0.8 * 1.8;
const EYE: V = [0.0; 3];
/// The floor is seen at 8 to 20 degrees.
const FLOOR: f64 = -1.2;
const WALL: f64 = -8.0;
/// The distance in texels between a line and the centres of its detected texels: an operator of 3 x 3 texels marks both
/// sides.
const REACH: f64 = 1.5;
const BORDER: usize = 3;
/// Texels of the floor that are this far from every line must not be lines.
const FAR: f64 = 4.0;

/// Returns the shapes in camera space.
fn scene() -> [PlacedShape; 3] {
    [
        PlacedShape { shape: Shape::Sphere(0.55), centre: [-1.05, -0.25, -6.0], axes: turned(0.0, 0.0) },
        PlacedShape { shape: Shape::Cuboid([0.42; 3]), centre: [1.0, -0.3, -5.6], axes: turned(25.0, 35.0) },
        PlacedShape { shape: Shape::Torus(0.55, 0.2), centre: [0.0, 0.85, -6.2], axes: turned(50.0, 15.0) },
    ]
}

/// Returns the ray through a place in texels, of depth 1.
fn ray(n: f64, x: f64, y: f64) -> V {
    [(x - 0.5 * n) / (n * FOCAL), (y - 0.5 * n) / (n * FOCAL), -1.0]
}

fn texel_of(n: f64, p: V) -> [f64; 2] {
    [0, 1].map(|i| 0.5 * n - n * FOCAL * p[i] / p[2])
}

/// Returns the depth and the direction of floor and wall.
fn room(d: V) -> (f64, V) {
    let floor = if d[1] < 0.0 { FLOOR / d[1] } else { f64::INFINITY };
    if floor < -WALL { (floor, [0.0, 1.0, 0.0]) } else { (-WALL, [0.0, 0.0, 1.0]) }
}

const GRIDS: [u32; 4] = [64, 128, 256, 512];

/// They are the same for all methods and settings.
static SURFACES: [LazyLock<Vec<(V, f64)>>; 4] = [
    LazyLock::new(|| seen_surfaces(GRIDS[0])),
    LazyLock::new(|| seen_surfaces(GRIDS[1])),
    LazyLock::new(|| seen_surfaces(GRIDS[2])),
    LazyLock::new(|| seen_surfaces(GRIDS[3])),
];

/// Returns the normal and the depth of every texel.
fn surfaces(n: u32) -> Cow<'static, [(V, f64)]> {
    match GRIDS.iter().position(|grid| *grid == n) {
        Some(index) => Cow::Borrowed(&SURFACES[index]),
        None => Cow::Owned(seen_surfaces(n)),
    }
}

fn seen_surfaces(n: u32) -> Vec<(V, f64)> {
    let shapes = scene();
    let side = f64::from(n);
    let surface = |i: u32| {
        let d = ray(side, f64::from(i % n) + 0.5, f64::from(i / n) + 0.5);
        let (room_depth, facing) = room(d);
        match first_hit(&shapes, EYE, d) {
            Some((t, index)) if t < room_depth => (shapes[index].normal(along(EYE, d, t)), t),
            _ => (facing, room_depth),
        }
    };
    (0..n * n).map(surface).collect()
}

/// Returns points of all visible lines, in texels, four or more per texel.
fn lines(n: u32) -> Vec<[f64; 2]> {
    let (shapes, side) = (scene(), f64::from(n));
    let count = 8 * n as usize;
    let mut points: Vec<[f64; 2]> = shapes
        .iter()
        .flat_map(|shape| shape.lines(EYE, count))
        .filter(|point| is_seen(&shapes, EYE, *point))
        .map(|point| texel_of(side, point.at))
        .collect();
    // The line where the floor touches the wall.
    let y = texel_of(side, [0.0, FLOOR, WALL])[1];
    let corner = (0..4 * n).map(|i| [f64::from(i) / 4.0, y]);
    points.extend(corner.filter(|[x, y]| first_hit(&shapes, EYE, ray(side, *x, *y)).is_none()));
    points
}

/// Returns the preset's map of a normal: Lambert's equal-area projection.
fn packed([x, y, z]: V) -> [f64; 2] {
    let by = 1.0 / (8.0 * z + 8.0).max(1e-6).sqrt();
    [x * by, y * by]
}

fn setup(name: &str, n: u32, sensitivity: f64) -> Setup {
    let state = |texel: &dyn Fn(&(V, f64)) -> [f64; 4]| -> Vec<[f32; 4]> {
        surfaces(n).iter().map(|s| texel(s).map(|x| x as f32)).collect()
    };
    let method = match name {
        "preset" => {
            let texels = state(&|(normal, depth)| [packed(*normal)[0], packed(*normal)[1], *depth, 1.5]);
            return Setup::new("gbuffer-edges", (n, n))
                .wants(&["b"])
                .uniform("depthSensitivity", sensitivity)
                .uniform("normalSensitivity", sensitivity)
                .given("a", &texels);
        }
        "roberts" => "ROBERTS",
        "sobel" => "SOBEL",
        _ => "LAPLACIAN",
    };
    let texels = state(&|([x, y, z], depth)| [*x, *y, *z, *depth]);
    Setup::new("edges", (n, n)).define("METHOD", method).uniform("sensitivity", sensitivity).state("source", &texels)
}

/// Returns which texels a method detects as a line.
pub fn found(rig: &Rig, name: &str, n: u32, sensitivity: f64) -> Result<Vec<bool>, LabError> {
    let pass = if name == "preset" { "b" } else { "field" };
    let field = rig.after(&setup(name, n, sensitivity), 1, pass)?;
    Ok(field.texels().iter().map(|t| t[0].max(if name == "preset" { t[1] } else { 0.0 }) > 0.5).collect())
}

/// Returns the accuracy of a method, and the part of the open floor that it detects as a line.
pub fn judged(found: &[bool], n: u32) -> (Found, f64) {
    let lines = lines(n);
    let all = Found::of_lines(found, n as usize, &lines, REACH, BORDER);
    let mut is_floor: Vec<bool> = surfaces(n).iter().map(|(normal, _)| dot(*normal, [0.0, 1.0, 0.0]) == 1.0).collect();
    for [x, y] in lines {
        let low = |v: f64| (v - FAR).max(0.0) as usize;
        let high = |v: f64| ((v + FAR) as usize + 1).min(n as usize);
        for j in low(y)..high(y) {
            is_floor[j * n as usize + low(x)..j * n as usize + high(x).max(low(x))].fill(false);
        }
    }
    let side = n as usize;
    let is_open = |i: &usize| {
        let inside = |v: usize| v >= BORDER && v + BORDER < side;
        is_floor[*i] && inside(i % side) && inside(i / side)
    };
    let open: Vec<usize> = (0..found.len()).filter(is_open).collect();
    let wrong = open.iter().filter(|i| found[**i]).count() as f64;
    (all, wrong / open.len().max(1) as f64)
}

pub static STUDY: Study = Study {
    name: "edges",
    title: "Edges",
    text: "A sphere, a cube and a torus hover before a wall, over a floor seen at 8 to 20 degrees. Normals and \
           depths of each texel are computed in f64 and handed to all methods. The lines there are follow from \
           geometry: the circle in which a cone touches the sphere, the cube's edges, the torus's contour in \
           closed form, each where nothing hides it, and the corner of the room. Precision is the part of the \
           texels found that lie within 1.5 texels of such a line, recall the part of the lines that has a \
           texel found within 1.5. The error, as L2, is 1 - F1, F1 the harmonic mean of both; Linf is the \
           worse of 1 - precision and 1 - recall, each with half of a point of the lines added, as less is not \
           resolved. The hard case is that the open floor is no line, on .1 % of its texels at most. At \
           sensitivity 1 a step of 2 % of the depth and a turn of 32 degrees are lines.",
    parameter: "sensitivity",
    unit: Unit::Frame,
    error: "1 - F1 of the lines found",
    methods: METHODS,
    grids: three_of(GRIDS),
    // A line has the same width in texels on each grid.
    has_order: false,
    is_relative: false,
    ..Study::of(|point| setup(&point.method, point.grid, point.setting), measure)
};

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let (all, floor) = judged(&found(rig, &point.method, point.grid, point.setting)?, point.grid);
    // Less than half of a point of the lines cannot be distinguished from nothing.
    let least = 0.5 / lines(point.grid).len() as f64;
    let mut norms = all.norms();
    (norms.l1, norms.l2, norms.linf) = (norms.l1 + least, norms.l2 + least, norms.linf + least);
    Ok(Measured { norms, frames_per_unit: 1.0, ..Measured::default() }
        .value("precision", all.precision)
        .value("recall", all.recall)
        .value("f1", all.f1())
        .value("floor", floor)
        .hard(HardCase::at_most("lines on the open floor", floor, 1e-3)))
}
