//! Outlines by inverted hulls, compared with the region that the hull of an exact shape covers.

use super::silhouettes::Found;
use crate::{
    HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit,
    reference::shapes::{PlacedShape, Shape, V, along, dot, first_hit, length, turned},
    three_of,
};
use eddy_project::{Camera, MeshDraw, MeshSource, Project};

/// In units of the scene.
const WIDTHS: &[f64] = &[0.02, 0.04, 0.08, 0.16];

const METHODS: &[Method] = &[
    Method { name: "normals", title: "along the mesh's own normals", settings: WIDTHS, usual: 0.08 },
    Method { name: "scaled", title: "positions scaled from the origin", settings: WIDTHS, usual: 0.08 },
    Method { name: "baked", title: "along smooth normals from a texture", settings: WIDTHS, usual: 0.08 },
];

const DISTANCE: f64 = 13.0;
const PITCH: f64 = 20.0;
const FOV: f64 = 30.0;
/// The fade of a line with distance: opaque up to the first, invisible from the second.
const FADE: [f64; 2] = [4.0, 36.0];
/// The preset fits its scene, 3 : 2, into a square.
const FIT: f64 = 1.0 / 1.5;

/// A mesh of the preset: the page with which it is drawn, its position and its rotation (degrees around one axis).
struct MeshPlacement {
    page: usize,
    mesh: &'static str,
    shape: Shape,
    at: V,
    turn: V,
}

const THINGS: [MeshPlacement; 3] = [
    MeshPlacement { page: 0, mesh: "builtin:sphere", shape: Shape::Sphere(1.0), at: [-3.3, 0.0, 0.0], turn: [0.0; 3] },
    MeshPlacement {
        page: 1,
        mesh: "builtin:cube",
        shape: Shape::Cuboid([1.0; 3]),
        at: [0.0; 3],
        turn: [0.0, 30.0, 0.0],
    },
    MeshPlacement {
        page: 2,
        mesh: "builtin:torus",
        shape: Shape::Torus(1.0, 0.4),
        at: [3.3, 0.0, 0.0],
        turn: [40.0, 0.0, 0.0],
    },
];

impl MeshPlacement {
    fn placed(&self, shape: Shape) -> PlacedShape {
        PlacedShape { shape, centre: self.at, axes: turned(self.turn[0], self.turn[1]) }
    }

    /// Returns the shape whose vertices are moved by the line's width.
    fn hull(&self, method: &str, width: f64) -> PlacedShape {
        let t = ((length(along(eye(), self.at, -1.0)) - FADE[0]) / (FADE[1] - FADE[0])).clamp(0.0, 1.0);
        let w = width * (1.0 - t * t * (3.0 - 2.0 * t));
        self.placed(match self.shape {
            Shape::Sphere(r) => Shape::Sphere(r + w),
            Shape::Torus(ring, tube) => Shape::Torus(ring, tube + w),
            // Along its faces' normals, or, at a corner, away from the centre.
            Shape::Cuboid(half) if method == "normals" => Shape::Cuboid(half.map(|h| h + w)),
            Shape::Cuboid(half) => Shape::Cuboid(half.map(|h| h + w / 3f64.sqrt())),
        })
    }
}

fn back() -> V {
    let (s, c) = PITCH.to_radians().sin_cos();
    [0.0, s, c]
}

fn eye() -> V {
    back().map(|x| x * DISTANCE)
}

/// Returns the ray through the centre of a texel of a square picture.
fn ray(n: usize, i: usize) -> V {
    let half = (0.5 * FOV).to_radians().tan() / FIT;
    let at = |k: usize| half * (2.0 * (k as f64 + 0.5) / n as f64 - 1.0);
    let (s, c) = PITCH.to_radians().sin_cos();
    along([at(i % n), c * at(i / n), -s * at(i / n)], back(), -1.0)
}

/// Returns which texels are a line: those in which a hull's far side is visible, for each thing.
fn exact(n: usize, method: &str, width: f64) -> [Vec<bool>; 3] {
    let shapes: Vec<PlacedShape> = THINGS.iter().map(|t| t.placed(t.shape)).collect();
    let hulls = THINGS.each_ref().map(|t| t.hull(method, width));
    let from = eye();
    let mut regions = [const { Vec::new() }; 3];
    for i in 0..n * n {
        let d = ray(n, i);
        let mesh = first_hit(&shapes, from, d).map_or(f64::INFINITY, |(t, _)| t);
        let far = hulls.map(|h| h.spans(from, d).iter().map(|s| s.1).fold(f64::INFINITY, f64::min));
        for k in 0..3 {
            let is_first = (0..3).all(|j| far[k] <= far[j]);
            regions[k].push(far[k] < mesh && is_first);
        }
    }
    regions
}

fn staged(project: &mut Project, method: &str, width: f64) {
    let (mode, baked) = if method == "scaled" { (1, false) } else { (0, method == "baked") };
    for custom_uniform in [
        "spin=0".to_owned(),
        "widthMask=0".into(),
        "blendBase=0".into(),
        "outlineTexture=0".into(),
        "outlineColour=0,1,0".into(),
        "depthOffset=0".into(),
        format!("bakedNormals={baked}"),
        format!("outlineMode={mode}"),
        format!("outlineWidth={width}"),
        format!("nearest={}", FADE[0]),
        format!("farthest={}", FADE[1]),
    ] {
        // The preset has them; a test of the studies opens each setup.
        project.set_custom_uniform(&custom_uniform).unwrap_or_else(|why| panic!("{custom_uniform}: {why}"));
    }
    let scene = project.pass_mut(&super::super::setup::pass("scene")).and_then(|p| p.body.geometry_mut());
    let geometry = scene.expect("the preset draws meshes");
    geometry.camera = Camera {
        yaw: 0.0,
        pitch: PITCH,
        distance: DISTANCE,
        target: [0.0; 3],
        fov: FOV,
        near: 0.5,
        far: 60.0,
        ..Camera::default()
    };
    let draws = geometry.draws.clone();
    let place = |thing: &MeshPlacement, draw: &MeshDraw| MeshDraw {
        mesh: MeshSource::parse(thing.mesh),
        scale: 1.0,
        position: thing.at,
        rotation: thing.turn,
        ..draw.clone()
    };
    // The mesh and its line; the third draw of each is only for depth.
    geometry.draws =
        THINGS.iter().flat_map(|t| draws[3 * t.page..3 * t.page + 2].iter().map(move |d| place(t, d))).collect();
    geometry.drop_unused_stages();
}

fn setup(name: &str, n: u32, width: f64) -> Setup {
    let method = name.to_owned();
    Setup::new("toon-outline", (n, n)).wants(&["scene"]).built(move |project| staged(project, &method, width))
}

/// Returns the result for a method's lines: all of them, each thing's, and the sphere's width relative to the exact
/// one, by areas.
pub fn judged(rig: &Rig, name: &str, n: u32, width: f64) -> Result<(Found, [Found; 3], f64), LabError> {
    let field = rig.after(&setup(name, n, width), 1, "scene")?;
    let found: Vec<bool> = field.texels().iter().map(|t| t[0] == 0.0 && t[1] == 1.0 && t[2] == 0.0).collect();
    let side = field.width();
    let regions = exact(side, name, width);
    let whole: Vec<bool> = (0..found.len()).map(|i| regions.iter().any(|r| r[i])).collect();
    // A texel belongs to the thing whose centre is nearest across the picture.
    let middles = THINGS.map(|t| {
        let q = along(t.at, eye(), -1.0);
        q[0] / -dot(q, back())
    });
    let owner = |i: usize| {
        let x = ray(side, i)[0];
        (0..3).min_by(|a, b| (x - middles[*a]).abs().total_cmp(&(x - middles[*b]).abs())).unwrap_or(0)
    };
    let of = |k: usize| -> Vec<bool> { (0..found.len()).map(|i| found[i] && owner(i) == k).collect() };
    let each = [0, 1, 2].map(|k| Found::of_regions(&of(k), &regions[k]));
    let count = |r: &[bool]| r.iter().filter(|x| **x).count() as f64;
    // Rings between discs: the width is the difference of the radii.
    let inner = {
        let sphere = THINGS[0].placed(THINGS[0].shape);
        count(&(0..found.len()).map(|i| !sphere.spans(eye(), ray(side, i)).is_empty()).collect::<Vec<_>>())
    };
    let wide = |ring: f64| (inner + ring).sqrt() - inner.sqrt();
    Ok((Found::of_regions(&found, &whole), each, wide(count(&of(0))) / wide(count(&regions[0]))))
}

pub static STUDY: Study = Study {
    name: "outline",
    title: "Outlines",
    text: "The preset toon-outline draws a sphere, a cube and a torus with lines of so many units' width, \
           faded with distance as its formula says. The exact lines are found by f64 rays: a texel is one if \
           the far side of a shape whose vertices have moved by the width is seen before any surface. A \
           cube's vertices move along the faces' normals (its corners should close), or away from its middle. \
           Precision and recall are counted in texels; the error, as L2, is 1 - F1, F1 the harmonic mean of \
           both, and Linf is the worse of 1 - precision and 1 - recall. The hard cases: the sphere's line is \
           as wide as the formula within 3 %, or a quarter of a texel where that is more, and each shape's F1 \
           is at least .9: along split normals a cube's line comes apart.",
    parameter: "width of the line",
    unit: Unit::Frame,
    error: "1 - F1 of the lines",
    methods: METHODS,
    grids: three_of([48, 96, 192, 384]),
    // More texels are another picture of the same lines.
    has_order: false,
    is_relative: false,
    ..Study::of(|point| setup(&point.method, point.grid, point.setting), measure)
};

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let (all, each, width) = judged(rig, &point.method, point.grid, point.setting)?;
    // The approximate number of texels per unit, at the sphere's distance in the picture, which is drawn twice as large
    // as the canvas.
    let texels = f64::from(2 * point.grid) * FIT / (2.0 * (0.5 * FOV).to_radians().tan() * DISTANCE) * point.setting;
    let mut measured = Measured { norms: all.norms(), frames_per_unit: 1.0, ..Measured::default() }
        .value("precision", all.precision)
        .value("recall", all.recall)
        .value("f1", all.f1())
        .value("width/formula", width)
        .hard(HardCase::at_most("width off its formula", (width - 1.0).abs(), 0.03f64.max(0.25 / texels)));
    for (name, found) in ["sphere", "cube", "torus"].into_iter().zip(each) {
        measured = measured.value(&format!("f1_{name}"), found.f1());
        measured = measured.hard(HardCase::at_most(&format!("1 - F1 of the {name}"), 1.0 - found.f1(), 0.1));
    }
    Ok(measured)
}
