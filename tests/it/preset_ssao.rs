//! The preset `ssao` on meshes whose occlusion is known.

use crate::support::{preset::*, *};
use eddy::{
    engine::{Engine, FrameInputs, Pixels},
    gpu::Gpu,
    media::Keyboard,
    project::{Camera, MeshDraw, MeshSource, Project},
};
use std::f64::consts::PI;

const SIZE: (u32, u32) = (320, 180);
const WALL_Z: f64 = -2.0;

/// Returns a camera in front of the scene and above it.
fn camera() -> Camera {
    Camera { yaw: 0.0, pitch: 35.0, distance: 5.0, target: [0.0, 0.1, -1.5], fov: 30.0, ..Camera::default() }
}

/// Replaces the scene by a floor that ends at a wall of `height`, which faces the camera; both extend to the sides.
fn corner(project: &mut Project, height: Option<f64>) {
    for name in ["geometry", "backs", "occlusion", "lighting"] {
        let geometry = project.pass_mut(&buffer(name)).unwrap().body.geometry_mut().unwrap();
        geometry.camera = camera();
        if name == "geometry" || name == "backs" {
            let floor = geometry.draws[0].clone();
            let mesh = MeshSource::parse("builtin:plane");
            let floor = MeshDraw { mesh, scale: 8.0, rotation: [0.0; 3], position: [0.0, 0.0, WALL_Z + 8.0], ..floor };
            let wall = |height: f64| MeshDraw {
                rotation: [90.0, 0.0, 0.0],
                position: [0.0, height - 8.0, WALL_Z],
                ..floor.clone()
            };
            geometry.draws = height.map(wall).into_iter().chain([floor.clone()]).collect();
        }
    }
}

/// Returns world positions and the visible share of the sky in a scene of [`corner`].
fn open(gpu: &Gpu, height: Option<f64>, custom_uniforms: &[&str]) -> (Pixels, Pixels) {
    let mut project = preset("ssao", custom_uniforms);
    corner(&mut project, height);
    let mut engine = drawn(gpu, &project, SIZE, 0..1);
    (engine.read_target(&buffer("geometry"), 1).unwrap(), read(&mut engine, "blur"))
}

/// Returns the share of the kernel that a wall of `height` at `distance` hides. A point at length s in direction w is
/// inside the wall if s w.x > distance and s w.y < height; a ray up to it is blocked if it meets the wall's front, at
/// distance / w.x, below its height. w.x and w.z are uniform on the unit disc, s = radius (0.1 + 0.9 u u).
fn analytic(radius: f64, height: f64, distance: f64, rays: bool) -> f64 {
    const N: usize = 400;
    let middle = |i: usize| (i as f64 + 0.5) / N as f64;
    let of_length = |s: f64| {
        // Integrates numerically over the squared distance from the disc's centre, which is uniform, and in closed form
        // over the angle.
        let of_square = |square: f64| {
            let up = (1.0 - square).sqrt();
            let is_below = rays || s * up < height;
            let least = if rays { (1.0 / s).max(up / height) } else { 1.0 / s };
            let x = (distance * least / square.sqrt()).min(1.0);
            if is_below { x.acos() / PI } else { 0.0 }
        };
        (0..N).map(|i| of_square(middle(i))).sum::<f64>() / N as f64
    };
    (0..N).map(|i| of_length(radius * (0.1 + 0.9 * middle(i).powi(2)))).sum::<f64>() / N as f64
}

/// Returns, for each row of floor texels, the distance from the wall and the mean occlusion.
fn by_distance(world: &Pixels, open: &Pixels) -> Vec<(f64, f64)> {
    let row = |y: u32| {
        let texels = (0..world.width).map(|x| (texel(world, x, y), texel(open, x, y)[0]));
        let floor: Vec<_> = texels.filter(|(w, _)| w[3] > 0.0 && w[1].abs() < 1e-3 && w[0].abs() < 0.6).collect();
        let hidden = floor.iter().map(|(_, o)| f64::from(1.0 - o)).sum::<f64>() / floor.len() as f64;
        let z = floor.iter().map(|(w, _)| f64::from(w[2])).sum::<f64>() / floor.len() as f64;
        (floor.len() > 20).then_some((z - WALL_Z, hidden))
    };
    (0..world.height).filter_map(row).collect()
}

#[test]
fn analytic_occlusion_matches_the_closed_form_for_a_high_wall() {
    let segment = |c: f64| if c < 1.0 { (c.acos() - c * (1.0 - c * c).sqrt()) / PI } else { 0.0 };
    for distance in [0.05, 0.2, 0.4, 0.59, 0.7] {
        let mean = (0..4000).map(|i| (f64::from(i) + 0.5) / 4000.0);
        let mean = mean.map(|u| segment(distance / (0.6 * (0.1 + 0.9 * u * u)))).sum::<f64>() / 4000.0;
        for rays in [false, true] {
            let whole = analytic(0.6, 0.6, distance, rays);
            assert!((whole - mean).abs() < 1e-3, "{distance}: {whole}, {mean}");
        }
    }
}

#[test]
fn occlusion_next_to_a_wall_matches_the_analytic_value() {
    let Some(gpu) = gpu() else { return };
    for (radius, height, rays, too_little, too_much) in [
        (0.3, 2.0, true, 0.025, 0.025),
        (0.6, 2.0, true, 0.025, 0.025),
        (1.0, 2.0, true, 0.025, 0.025),
        (0.6, 0.25, true, 0.045, 0.01),
        (0.6, 2.0, false, 0.025, 0.025),
        (0.6, 0.25, false, 0.045, 0.01),
    ] {
        let method = if rays { "method=0" } else { "method=1" };
        let custom_uniforms = ["power=1".to_owned(), method.to_owned(), format!("radius={radius}")];
        let custom_uniforms: Vec<&str> = custom_uniforms.iter().map(String::as_str).collect();
        let (world, open) = open(&gpu, Some(height), &custom_uniforms);
        let rows = by_distance(&world, &open);
        let (mut low, mut high, mut near, mut beyond) = (0.0f64, 0.0f64, 0, 0);
        for (distance, hidden) in rows {
            if distance < 0.06 {
                continue;
            }
            if distance > radius + 0.06 {
                beyond += 1;
                assert_eq!(hidden, 0.0, "{distance} away, no part of the wall is within {radius}");
                continue;
            }
            near += 1;
            let error = hidden - analytic(radius, height, distance, rays);
            (low, high) = (low.min(error), high.max(error));
        }
        println!(
            "{method}, radius {radius}, wall {height} high: {low:.4} to {high:.4} off, {near} rows near, {beyond} \
             beyond"
        );
        assert!(near > 10 && beyond > 10, "{near} rows near the wall, {beyond} beyond");
        assert!(low > -too_little && high < too_much, "radius {radius}, height {height}: {low} to {high} off");
    }
}

#[test]
fn an_open_plane_is_not_occluded() {
    let Some(gpu) = gpu() else { return };
    for custom_uniforms in
        [&["bias=0.002"][..], &["radius=2", "bias=0.002"], &["radius=0.05"], &["method=1", "bias=0.002"]]
    {
        let (world, open) = open(&gpu, None, custom_uniforms);
        let floor = world.texels.iter().zip(&open.texels).filter(|(w, _)| w[3] > 0.0);
        let all: Vec<f32> = floor.map(|(_, o)| o[0]).collect();
        assert!(
            all.len() > 10_000 && all.iter().all(|o| *o == 1.0),
            "{custom_uniforms:?}: {:?}",
            all.iter().min_by(|a, b| a.total_cmp(b))
        );
    }
}

#[test]
fn the_kernel_is_a_cosine_weighted_hemisphere() {
    let Some(gpu) = gpu() else { return };
    let mut engine = drawn(&gpu, &preset("ssao", &[]), (16, 9), 0..1);
    let kernel = read(&mut engine, "kernel");
    let points: Vec<[f64; 3]> = kernel.texels[..64].iter().map(|t| [0, 1, 2].map(|i| f64::from(t[i]))).collect();
    let length = |p: &[f64; 3]| p.iter().map(|x| x * x).sum::<f64>().sqrt();
    assert!(points.iter().all(|p| p[2] > 0.0 && (0.1 - 1e-6..=1.0).contains(&length(p))));
    let mean = |f: &dyn Fn(&[f64; 3]) -> f64| points.iter().map(f).sum::<f64>() / 64.0;
    // The cosine's mean is 2/3, that of its square 1/2, both sides have equal weight; the mean length is 0.1 + 0.9 / 3.
    for (what, measured, expected) in [
        ("cosine", mean(&|p| p[2] / length(p)), 2.0 / 3.0),
        ("its square", mean(&|p| (p[2] / length(p)).powi(2)), 0.5),
        ("x", mean(&|p| p[0] / length(p)), 0.0),
        ("y", mean(&|p| p[1] / length(p)), 0.0),
        ("length", mean(&length), 0.4),
    ] {
        assert!((measured - expected).abs() < 0.02, "{what}: {measured}, not {expected}");
    }
}

const SPACE: u8 = 32;

/// Draws a frame with Space pressed and one after its release, and returns the picture.
fn press(engine: &mut Engine, frame: i32) -> Pixels {
    let mut down = FrameInputs::at_fixed_step(frame, 60.0);
    down.keyboard.press(SPACE);
    engine.draw(&down).unwrap();
    engine.draw(&FrameInputs { keyboard: Keyboard::default(), ..FrameInputs::at_fixed_step(frame + 1, 60.0) }).unwrap();
    picture(engine)
}

#[test]
fn space_cycles_occlusion_on_off_and_alone() {
    let Some(gpu) = gpu() else { return };
    let mut engine = drawn(&gpu, &preset("ssao", &["lampSpeed=0"]), (160, 90), 0..1);
    let on = picture(&mut engine);
    let off = press(&mut engine, 1);
    let alone = press(&mut engine, 3);
    let again = press(&mut engine, 5);
    assert_eq!(on.texels, again.texels, "three presses return to the start");
    let blur = read(&mut engine, "blur");
    // Without the smoothing of edges, no texel would be brighter.
    let (mut darker, mut brighter, mut grey) = (0, 0, 0);
    for i in 0..on.texels.len() {
        let luma = |p: &Pixels| p.texels[i][0] + p.texels[i][1] + p.texels[i][2];
        darker += usize::from(luma(&on) < luma(&off) - 0.01);
        brighter += usize::from(luma(&on) > luma(&off) + 0.01);
        let [r, g, b, _] = alone.texels[i];
        assert!(r == g && g == b, "occlusion alone has no colour: {:?}", alone.texels[i]);
        grey += usize::from((r - blur.texels[i][0]).abs() < 1e-3);
    }
    assert!(darker > 500 && 50 * brighter < darker, "occlusion darkens: {darker} texels darker, {brighter} brighter");
    assert!(grey > on.texels.len() * 8 / 10, "the occlusion shown alone differs from the blurred one: {grey}");
}
