//! Ambient occlusion in the picture's space against 1,024 rays a point in the scene itself.

use crate::lab::{
    About, Extent, Field, HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit,
    metrics::Norms,
    reference::{
        rays::{Errors, Meshes, add, behind_wall, hidden, on_all_cores, under_sphere, unit},
        still_life::{FAR, View, first, is_table, normal},
    },
};

pub struct Ao;

/// Rays a point along either side of the square of strata.
const SIDE: u32 = 32;

/// Points of a picture that are held against rays.
const POINTS: f64 = 900.0;

/// Radii of the two presets, in units of their scenes.
const TABLE_RADIUS: f64 = 0.8;
const ROOM_RADIUS: f64 = 0.6;

const SAMPLES: &[f64] = &[8.0, 16.0, 32.0, 64.0];

const METHODS: &[Method] = &[
    Method {
        name: "horizons",
        title: "preset gbuffer-ssao-ssr: sectors of slices",
        settings: &[8.0, 16.0, 24.0, 32.0, 64.0],
        usual: 24.0,
    },
    Method { name: "rays", title: "preset ssao: rays of four samples", settings: SAMPLES, usual: 64.0 },
    Method { name: "points", title: "ssao, method 1: points of the hemisphere", settings: SAMPLES, usual: 64.0 },
    Method { name: "sphere", title: "ssao, method 2: points of the sphere", settings: SAMPLES, usual: 64.0 },
];

/// Slices and steps on either side of one, for so many samples.
fn slices(samples: f64) -> (f64, f64) {
    match samples as u32 {
        8 => (1.0, 4.0),
        16 => (2.0, 4.0),
        24 => (2.0, 6.0),
        32 => (2.0, 8.0),
        _ => (4.0, 8.0),
    }
}

fn setup(method: &str, samples: f64, size: (u32, u32)) -> Setup {
    let ssao = |method| {
        let setup = Setup::new("ssao", size).wants(&["geometry", "blur"]).restless();
        setup.uniform("power", 1.0).uniform("method", method).uniform("samples", samples)
    };
    match method {
        "horizons" => {
            let (slices, steps) = slices(samples);
            let setup = Setup::new("gbuffer-ssao-ssr", size).wants(&["a", "c"]).restless();
            setup.uniform("turning", 0.0).uniform("slices", slices).uniform("steps", steps)
        }
        "rays" => ssao(0.0),
        "points" => ssao(1.0),
        _ => ssao(2.0),
    }
}

/// A point of a picture: what the method says is hidden of its sky, and what rays say.
#[derive(Clone, Copy, Debug)]
pub struct Occluded {
    pub measured: f64,
    pub expected: f64,
    /// It lies on the table, or on the room's floor.
    pub is_plane: bool,
}

/// The most that a method hides where nothing does, on the scene's plane.
pub fn open_most(found: &[Occluded]) -> f64 {
    found.iter().filter(|o| o.is_plane && o.expected == 0.0).map(|o| o.measured).fold(0.0, f64::max)
}

fn spots((width, height): (u32, u32)) -> Vec<(u32, u32)> {
    let step = ((f64::from(width) * f64::from(height) / POINTS).sqrt() as u32).max(1) | 1;
    let along = move |n: u32| (step / 2..n).step_by(step as usize);
    along(height).flat_map(|y| along(width).map(move |x| (x, y))).collect()
}

fn texel(field: &Field, x: u32, y: u32) -> [f64; 4] {
    field.texels()[y as usize * field.width() + x as usize].map(f64::from)
}

/// The still life. Points are found by rays from the camera; only edges are asked of the G-buffer, where a point may be
/// either side's.
fn on_the_table(rig: &Rig, setup: &Setup) -> Result<Vec<Occluded>, LabError> {
    let size = setup.size();
    let mut running = rig.open(setup)?;
    running.frames(1)?;
    let (surfaces, measured) = (running.read("a")?, running.read("c")?);
    let view = View::new(size.0, size.1);
    let material = |x: u32, y: u32| texel(&surfaces, x.min(size.0 - 1), y.min(size.1 - 1))[3] as u32;
    let found = on_all_cores(&spots(size), |&(x, y)| {
        let near = |i: u32| material((x + i % 3 * 2).saturating_sub(2), (y + i / 3 * 2).saturating_sub(2));
        if (0..9).any(|i| near(i) != material(x, y)) {
            return None;
        }
        let ray = view.ray([f64::from(x) + 0.5, f64::from(y) + 0.5]);
        let at = add(view.eye, ray, first(view.eye, ray, FAR)?);
        let normal = normal(at);
        let falloff = |d: f64| ((TABLE_RADIUS - d) / (0.4 * TABLE_RADIUS)).clamp(0.0, 1.0);
        let hit = |from, ray| first(from, ray, TABLE_RADIUS);
        let expected = hidden(add(at, normal, 1e-4), normal, SIDE, hit, falloff);
        Some(Occluded { measured: texel(&measured, x, y)[0], expected, is_plane: is_table(at) })
    });
    Ok(found.into_iter().flatten().collect())
}

/// The meshes in a room. A point and its smooth normal are what the geometry pass has there.
fn in_the_room(rig: &Rig, setup: &Setup) -> Result<Vec<Occluded>, LabError> {
    let lacks = || LabError::Setup { method: setup.folder().into(), what: "meshes that are its own".into() };
    let mut running = rig.open(setup)?;
    running.frames(1)?;
    let (world, normals) = (running.read_target("geometry", 1)?, running.read_target("geometry", 2)?);
    let open = running.read("blur")?;
    let (project, _) = setup.project()?;
    let pass = project.pass(&crate::lab::setup::pass("geometry"));
    let geometry = pass.and_then(|p| p.settings.meshes()).ok_or_else(lacks)?;
    let meshes = Meshes::of(&geometry.draws).map_err(|_| lacks())?;
    // A sample of the length s = radius (0.1 + 0.9 u u), u uniform, finds what is no farther than s.
    let falloff = |d: f64| 1.0 - ((d / ROOM_RADIUS - 0.1).max(0.0) / 0.9).sqrt();
    let found = on_all_cores(&spots(setup.size()), |&(x, y)| {
        let [place, normal] = [&world, &normals].map(|field| texel(field, x, y));
        if place[3] == 0.0 {
            return None;
        }
        let [at, normal] = [place, normal].map(|t| [t[0], t[1], t[2]]);
        // Positions have 11 bits, and meshes facets.
        let from = add(at, normal, 2.5e-3);
        let hit = |from, ray| meshes.hit(from, ray, ROOM_RADIUS);
        let expected = hidden(from, unit(normal), SIDE, hit, falloff);
        let is_plane = at[1].abs() < 2e-3 && normal[1] > 0.99;
        Some(Occluded { measured: 1.0 - texel(&open, x, y)[0], expected, is_plane })
    });
    Ok(found.into_iter().flatten().collect())
}

/// Returns what a method finds in its own scene.
pub fn occlusion(rig: &Rig, method: &str, samples: f64, size: (u32, u32)) -> Result<Vec<Occluded>, LabError> {
    let setup = setup(method, samples, size);
    if method == "horizons" { on_the_table(rig, &setup) } else { in_the_room(rig, &setup) }
}

/// A floor with a wall (SHAPE 1) or a sphere (2) on it, or with nothing (0), as the G-buffer has it.
const SHAPES: &str = "
void mainImage(out vec4 texel, in vec2 fragCoord) {
    const float C = 0.9358968, S = 0.3522742; // of 0.36 radians down
    mat3 axes = mat3(1.0, 0.0, 0.0, 0.0, C, -S, 0.0, S, C);
    vec3 eye = vec3(0.0, 2.0, 2.0), d = axes * viewFromPixel(fragCoord, 1.0, iResolution.xy), n = vec3(0.0, 1.0, 0.0);
    float t = d.y < 0.0 ? -eye.y / d.y : FAR;
#if SHAPE == 1
    float wall = (-3.0 - eye.z) / d.z, y = eye.y + wall * d.y;
    if (wall < t) t = FAR; // beyond it there is nothing
    if (t == FAR && y >= 0.0 && y < 0.8) {
        t = wall;
        n = vec3(0.0, 0.0, 1.0);
    }
#elif SHAPE == 2
    vec3 q = eye - vec3(0.0, 0.6, -1.0);
    float a = dot(d, d), b = dot(q, d), h = b * b - a * (dot(q, q) - 0.25);
    if (h > 0.0) {
        t = (-b - sqrt(h)) / a;
        n = (q + t * d) / 0.5;
    }
#endif
    texel = t < FAR ? vec4(packNormal(n * axes), t, n.y == 1.0 ? 1.5 : 2.5) : vec4(packNormal(vec3(0.0, 0.0, 1.0)), FAR, 0.999);
}";

/// The pixel of a point of the floor in the scenes of [`SHAPES`].
fn floor_pixel(x: f64, z: f64, side: u32) -> (u32, u32) {
    let (s, c) = 0.36f64.sin_cos();
    let q = [x, -2.0, z - 2.0];
    let (up, back) = (c * q[1] - s * q[2], s * q[1] + c * q[2]);
    let n = f64::from(side);
    let scale = 0.8 * n * 1.8 / -back;
    ((0.5 * n + scale * q[0]) as u32, (0.5 * n + scale * up) as u32)
}

/// Signed errors against closed forms, largest by size: on an open floor, beside a wall, and below a sphere.
#[derive(Clone, Copy, Debug)]
pub struct Closed {
    pub open: f64,
    pub wall: f64,
    pub sphere: f64,
}

/// The method of slices in scenes whose occlusion is known; things are as thick as the sphere is.
pub fn closed(rig: &Rig, samples: f64, side: u32) -> Result<Closed, LabError> {
    let field = |shape: u32| {
        let setup = setup("horizons", samples, (side, side)).text("a", SHAPES).define("SHAPE", shape);
        rig.after(&setup.uniform("radius", 4.0).uniform("thickness", 1.0), 1, "c")
    };
    let (open, wall, sphere) = (field(0)?, field(1)?, field(2)?);
    let worst = |pairs: Vec<(f64, f64)>| {
        pairs.iter().map(|(m, e)| m - e).fold(0.0f64, |worst, d| if d.abs() > worst.abs() { d } else { worst })
    };
    let mean = |field: &Field, places: &[(f64, f64)]| {
        let sum = places.iter().map(|&(x, z)| floor_pixel(x, z, side)).map(|(x, y)| texel(field, x, y)[0]);
        sum.sum::<f64>() / places.len() as f64
    };
    let beside = [0.3, 0.4, 0.8, 1.2].map(|distance| {
        let row: Vec<(f64, f64)> = (-8..=8).map(|i| (0.04 * f64::from(i), -3.0 + distance)).collect();
        (mean(&wall, &row), behind_wall(0.8, distance))
    });
    let below = [0.6, 0.8, 1.0, 1.3].map(|r| {
        // On the side of the camera: behind the sphere the floor is hidden.
        let arc: Vec<(f64, f64)> =
            (-4..=4).map(|i| (0.25 * f64::from(i)).sin_cos()).map(|(s, c)| (r * s, -1.0 + r * c)).collect();
        (mean(&sphere, &arc), under_sphere(0.5, 0.6, r))
    });
    // Within the 4 x 4 texels that share their directions the picture's edge is not whole.
    let inside = |n: u32| 8..n - 8;
    let all = inside(side / 2).flat_map(|y| inside(side).map(move |x| (x, y)));
    let open = all.map(|(x, y)| texel(&open, x, y)[0]).fold(0.0, f64::max);
    Ok(Closed { open, wall: worst(beside.to_vec()), sphere: worst(below.to_vec()) })
}

impl Study for Ao {
    fn about(&self) -> About {
        About {
            name: "ao",
            title: "Ambient occlusion",
            text: "Some 900 points of each preset's scene, the still life on its table and the meshes in their room, \
                   against 1,024 stratified rays a point, weighted by the cosine, of the preset's radius and falloff, \
                   in f64. The error is the root mean square of the hidden part of the sky, of which 1 is all. The \
                   table gives the mean of the error, the points that are hidden by .1 too much (a halo), and the most \
                   where nothing hides; and of the slices, with a radius of 4, the largest errors beside a wall ((1 - \
                   cos t) / 2) and below a sphere (R² h / (r² + h²)^(3/2)). Hard cases: at most .05 from the rays; an \
                   open plane less than .01; a halo on at most 1 % of the points. Costs are those of the whole preset, \
                   every pass drawn.",
            parameter: "samples",
            unit: Unit::Frame,
            error: "of the hidden part of the sky, of which 1 is all",
        }
    }

    fn methods(&self) -> &'static [Method] {
        METHODS
    }

    fn grids(&self, extent: Extent) -> &'static [u32] {
        match extent {
            Extent::Quick => &[80, 160, 320],
            Extent::Full => &[160, 320, 640],
        }
    }

    /// The radius is as many times the scene on every grid, and so are the errors.
    fn has_order(&self) -> bool {
        false
    }

    fn setup(&self, point: &Point) -> Setup {
        setup(&point.method, point.setting, (point.grid, point.grid))
    }

    fn measure(&self, rig: &Rig, point: &Point) -> Result<Measured, LabError> {
        let found = occlusion(rig, &point.method, point.setting, (point.grid, point.grid))?;
        let off = Errors::of(found.iter().map(|o| (o.measured, o.expected)));
        let size = found.iter().map(|o| (o.measured - o.expected).abs()).sum::<f64>() / found.len() as f64;
        let halo = found.iter().filter(|o| o.measured - o.expected > 0.1).count() as f64 / found.len() as f64;
        let open = open_most(&found);
        let norms = Norms { l1: size, l2: off.rms, linf: off.most };
        let measured = Measured { norms, frames_per_unit: 1.0, ..Measured::default() }
            .value("bias", off.mean)
            .value("halo_share", halo)
            .value("open_most", open)
            .hard(HardCase::at_most("rays", off.rms, 0.05))
            .hard(HardCase::at_most("an open plane", open, 0.01))
            .hard(HardCase::at_most("points in a halo", halo, 0.01));
        if point.method != "horizons" {
            return Ok(measured);
        }
        let closed = closed(rig, point.setting, point.grid)?;
        let measured = measured.value("wall_error", closed.wall).value("sphere_error", closed.sphere);
        Ok(measured.hard(HardCase::at_most("an endless plane", closed.open, 0.01)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_floors_points_are_where_the_camera_sees_them() {
        // The middle of the picture looks 0.36 radians down from (0, 2, 2).
        let z = 2.0 - 2.0 / 0.36f64.tan();
        assert_eq!(floor_pixel(1e-9, z - 0.01, 320), (160, 160));
        assert!(floor_pixel(0.1, z, 320).0 > 160 && floor_pixel(0.0, z + 0.3, 320).1 < 160);
    }

    #[test]
    fn samples_are_slices_times_steps_on_both_sides() {
        for samples in METHODS[0].settings {
            let (slices, steps) = slices(*samples);
            assert_eq!(2.0 * slices * steps, *samples);
        }
    }
}
