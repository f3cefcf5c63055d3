//! Ambient occlusion with a closed form: on an open floor, next to a wall, and below a sphere.

use super::ao_setup::{ROOM_RADIUS, room_falloff, setup, texel};
use crate::{
    Field, LabError, Rig,
    reference::rays::{add, behind_high_wall, behind_wall, hidden, meets_sphere, under_sphere},
    setup::pass,
};
use eddy_project::{Camera, MeshDraw, MeshSource, Project};

/// A floor with a wall (SHAPE 1) or a sphere (2) on it, or with nothing (0), as a G-buffer.
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

/// Returns the pixel of a point of the floor in the scenes of [`SHAPES`].
fn floor_pixel(x: f64, z: f64, side: u32) -> (u32, u32) {
    let (s, c) = 0.36f64.sin_cos();
    let q = [x, -2.0, z - 2.0];
    let (up, back) = (c * q[1] - s * q[2], s * q[1] + c * q[2]);
    let n = f64::from(side);
    let scale = 0.8 * n * 1.8 / -back;
    ((0.5 * n + scale * q[0]) as u32, (0.5 * n + scale * up) as u32)
}

/// Signed errors relative to closed forms, the largest by absolute value: on an open floor, next to a wall, and below a
/// sphere.
#[derive(Clone, Copy, Debug)]
pub struct Closed {
    pub open: f64,
    pub wall: f64,
    pub sphere: f64,
}

/// Runs a method of slices in scenes with known occlusion; things are as thick as the sphere.
pub fn closed(rig: &Rig, method: &str, samples: f64, side: u32) -> Result<Closed, LabError> {
    let field = |shape: u32| {
        let setup = setup(method, samples, (side, side)).text("a", SHAPES).define("SHAPE", shape);
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
    // Near the picture's edge the 4 x 4 texels that share their directions are incomplete.
    let inside = |n: u32| 8..n - 8;
    let all = inside(side / 2).flat_map(|y| inside(side).map(move |x| (x, y)));
    let open = all.map(|(x, y)| texel(&open, x, y)[0]).fold(0.0, f64::max);
    Ok(Closed { open, wall: worst(beside.to_vec()), sphere: worst(below.to_vec()) })
}

/// The sphere over the floor of [`Scene::Sphere`], and the distance of the wall of [`Scene::Wall`] behind the centre.
const SPHERE: ([f64; 3], f64) = ([0.0, 0.3, 0.0], 0.25);
const WALL_Z: f64 = -2.0;
const WALL_HEIGHT: f64 = 2.0;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Scene {
    Open,
    Wall,
    Sphere,
}

/// Replaces the scene of the preset with meshes.
fn show(project: &mut Project, scene: Scene) {
    let target = if scene == Scene::Wall { [0.0, 0.1, -1.5] } else { [0.0, 0.1, 0.3] };
    let camera = Camera { yaw: 0.0, pitch: 35.0, distance: 5.0, target, fov: 30.0, ..Camera::default() };
    for name in ["geometry", "backs", "occlusion", "lighting"] {
        let Some(meshes) = project.pass_mut(&pass(name)).and_then(|p| p.body.geometry_mut()) else { continue };
        meshes.camera = camera;
        if name == "occlusion" || name == "lighting" {
            continue;
        }
        let draw = |mesh: &str, scale, rotation, position| MeshDraw {
            mesh: MeshSource::parse(mesh),
            scale,
            rotation,
            position,
            ..meshes.draws[0].clone()
        };
        // A plane has no back, so the pass that draws backs draws nothing of it.
        let floor = if scene == Scene::Wall { WALL_Z + 8.0 } else { 0.0 };
        let floor = draw("builtin:plane", 8.0, [0.0; 3], [0.0, 0.0, floor]);
        let thing = match scene {
            Scene::Open => None,
            Scene::Wall => Some(draw("builtin:plane", 8.0, [90.0, 0.0, 0.0], [0.0, WALL_HEIGHT - 8.0, WALL_Z])),
            Scene::Sphere => Some(draw("builtin:sphere", SPHERE.1, [0.0; 3], SPHERE.0)),
        };
        meshes.draws = thing.into_iter().chain([floor]).collect();
    }
}

/// Runs a method of the preset with meshes, at its own radius. A wall that is higher than the reach of the samples has
/// a closed form; for a sphere, rays are cast in f64, with the falloff that results from the sample lengths.
pub fn closed_of_meshes(rig: &Rig, method: &str, samples: f64, side: u32) -> Result<Closed, LabError> {
    // Returns places on the floor in front of the centre, and the hidden part there.
    let floor = |scene: Scene| {
        let setup = setup(method, samples, (side, side)).built(move |project| show(project, scene));
        let mut running = rig.open(&setup)?;
        running.frames(1)?;
        let (world, open) = (running.read_target("geometry", 1)?, running.read("blur")?);
        let inside = (8..side - 8).flat_map(|y| (8..side - 8).map(move |x| (x, y)));
        let found = inside.filter_map(|(x, y)| {
            let at = texel(&world, x, y);
            let is_floor = at[3] > 0.0 && at[1].abs() < 1e-3;
            is_floor.then(|| ([at[0], at[1], at[2]], 1.0 - texel(&open, x, y)[0]))
        });
        Ok::<_, LabError>(found.collect::<Vec<_>>())
    };
    // The mean of measured minus expected values around each of these distances.
    let worst = |found: &[([f64; 3], f64)],
                 about: &[f64],
                 distance: &dyn Fn([f64; 3]) -> f64,
                 expected: &dyn Fn([f64; 3]) -> f64| {
        let mean = |d: f64| {
            let near = found.iter().filter(|(at, _)| at[0].abs() < 0.4 && (distance(*at) - d).abs() < 0.015);
            let off: Vec<f64> = near.step_by(3).map(|(at, hidden)| hidden - expected(*at)).collect();
            if off.is_empty() { 0.0 } else { off.iter().sum::<f64>() / off.len() as f64 }
        };
        about.iter().map(|d| mean(*d)).fold(0.0f64, |worst, d| if d.abs() > worst.abs() { d } else { worst })
    };
    let open = floor(Scene::Open)?.iter().map(|(_, hidden)| *hidden).fold(0.0, f64::max);
    let from_wall = |at: [f64; 3]| at[2] - WALL_Z;
    let wall = worst(&floor(Scene::Wall)?, &[0.1, 0.2, 0.3, 0.4], &from_wall, &|at| {
        behind_high_wall(ROOM_RADIUS, from_wall(at))
    });
    let (centre, radius) = SPHERE;
    // On the side of the camera: behind the sphere the floor is not visible.
    let beside = |at: [f64; 3]| if at[2] > 0.0 { at[0].hypot(at[2]) } else { f64::INFINITY };
    let hit = |from, ray| meets_sphere(centre, radius, from, ray).filter(|d| *d < ROOM_RADIUS);
    let under = |at: [f64; 3]| {
        hidden(add(at, [0.0, 1.0, 0.0], 1e-4), [0.0, 1.0, 0.0], 16, hit, |d| room_falloff(ROOM_RADIUS, d))
    };
    let sphere = worst(&floor(Scene::Sphere)?, &[0.2, 0.3, 0.4, 0.5], &beside, &under);
    Ok(Closed { open, wall, sphere })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_the_floor_project_to_their_pixels() {
        // The centre of the picture looks 0.36 radians down from (0, 2, 2).
        let z = 2.0 - 2.0 / 0.36f64.tan();
        assert_eq!(floor_pixel(1e-9, z - 0.01, 320), (160, 160));
        assert!(floor_pixel(0.1, z, 320).0 > 160 && floor_pixel(0.0, z + 0.3, 320).1 < 160);
    }
}
