//! Both presets with ambient occlusion compared with ray casting: 1,024 rays per point, weighted by the cosine, with
//! the same radius and falloff, in f64 and on geometry that is known without the G-buffer.

use crate::support::{preset::*, *};
use eddy::{
    engine::Pixels,
    lab::reference::{
        rays::{Errors, Meshes, add, hidden, on_all_cores, unit},
        still_life::{DIE, FAR, TABLE, View, first, normal},
    },
    project::Project,
};

#[test]
fn occlusion_on_the_still_life_matches_ray_casting() {
    let Some(gpu) = gpu() else { return };
    let (width, height) = (640u32, 360u32);
    let radius = 0.8;
    let mut engine = drawn(&gpu, &preset("gbuffer-ssao-ssr", &["turning=0"]), (width, height), 0..1);
    let (surfaces, measured) = (read(&mut engine, "A"), read(&mut engine, "C"));
    let view = View::new(width, height);
    let material = |x: u32, y: u32| texel(&surfaces, x.min(width - 1), y.min(height - 1))[3] as u32;
    let spots: Vec<(u32, u32)> =
        (0..height).step_by(9).flat_map(|y| (0..width).step_by(9).map(move |x| (x, y))).collect();
    let found = on_all_cores(&spots, |&(x, y)| {
        // A point on an edge may belong to either side.
        if (0..9)
            .any(|i| material((x + i % 3 * 2).saturating_sub(2), (y + i / 3 * 2).saturating_sub(2)) != material(x, y))
        {
            return None;
        }
        let ray = view.ray([f64::from(x) + 0.5, f64::from(y) + 0.5]);
        let at = add(view.eye, ray, first(view.eye, ray, FAR)?);
        let normal = normal(at);
        let falloff = |d: f64| ((radius - d) / (0.4 * radius)).clamp(0.0, 1.0);
        let expected = hidden(add(at, normal, 1e-4), normal, 32, |from, ray| first(from, ray, radius), falloff);
        Some((material(x, y), normal[1], f64::from(texel(&measured, x, y)[0]), expected))
    });
    let found: Vec<_> = found.into_iter().flatten().collect();
    let pairs = found.iter().map(|&(.., measured, expected)| (measured, expected));
    let upright =
        found.iter().filter(|f| f.0 == DIE && f.1 < 0.5).map(|&(.., measured, expected)| (measured, expected));
    let (all, sides) = (Errors::of(pairs), Errors::of(upright));
    let open: Vec<f64> = found.iter().filter(|f| f.0 == TABLE && f.3 == 0.0).map(|f| f.2).collect();
    let largest = open.iter().copied().fold(0.0, f64::max);
    println!("all: {:.4} off, {:+.4} in the mean, {} points", all.rms, all.mean, all.count);
    println!("the die's upright faces: {:.4} off, {:+.4} in the mean, {} points", sides.rms, sides.mean, sides.count);
    println!("open table: at most {largest:.4}, {} points", open.len());
    assert!(all.count > 1500 && all.rms < 0.05, "{} off", all.rms);
    assert!(sides.count > 30 && sides.mean > -0.05, "the die's upright faces are {} too bright", -sides.mean);
    assert!(open.len() > 500 && largest < 0.01, "the open table is hidden by {largest}");
}

/// From some directions, normals at the rim of a shape point away from the camera: occlusion must not become negative.
#[test]
fn occlusion_is_never_negative_from_any_direction() {
    let Some(gpu) = gpu() else { return };
    let range = |project: &Project| {
        let mut engine = whole(&gpu, project, (640, 360));
        let mut range = (f32::MAX, f32::MIN);
        for frame in 0..16 {
            // The camera moves around the still life, and up and down.
            let turn = f64::from(frame);
            let at = [320.0 + 300.0 * (0.11 * turn).sin(), 180.0 + 150.0 * (0.173 * turn).sin()];
            engine.draw(&at_frame(frame, Some(at.map(|v| v.trunc() as f32)))).unwrap();
            let hidden = read(&mut engine, "B");
            range = hidden.texels.iter().fold(range, |(smallest, largest), t| (smallest.min(t[0]), largest.max(t[0])));
        }
        range
    };
    let mut project = preset("gbuffer-ssao-ssr", &[]);
    let (smallest, largest) = range(&project);
    // A slice has a weight of at most pi / 2.
    assert!(smallest == 0.0 && largest > 0.3 && largest <= 1.572, "{smallest} to {largest}");
    let correction = "normal = normalize(normal - min(dot(normal, view), 0.0) * view);";
    presets::patch(&mut project, &buffer("B"), correction, "");
    assert!(range(&project).0 < -0.01, "the test does not detect negative occlusion");
}

// --------------------------------------------------------------------------------------------------- the meshes

#[test]
fn occlusion_on_meshes_matches_ray_casting() {
    let Some(gpu) = gpu() else { return };
    let (width, height) = (320u32, 180u32);
    let radius = 0.6;
    let project = preset("ssao", &["power=1"]);
    let mut engine = drawn(&gpu, &project, (width, height), 0..1);
    let target =
        |engine: &mut eddy::engine::Engine, i| -> Pixels { engine.read_target(&buffer("geometry"), i).unwrap() };
    let (world, normals, open) = (target(&mut engine, 1), target(&mut engine, 2), read(&mut engine, "blur"));
    let geometry = project.pass(&buffer("geometry")).unwrap().body.geometry().unwrap();
    let meshes = Meshes::of(&geometry.draws).unwrap();
    let spots: Vec<(u32, u32)> =
        (2..height).step_by(5).flat_map(|y| (2..width).step_by(5).map(move |x| (x, y))).collect();
    // A sample of length s = radius (0.1 + 0.9 u u), u uniform, is blocked by surfaces at most s away.
    let falloff = |d: f64| 1.0 - ((d / radius - 0.1).max(0.0) / 0.9).sqrt();
    let found = on_all_cores(&spots, |&(x, y)| {
        let [place, normal] = [&world, &normals].map(|p| texel(p, x, y));
        if place[3] == 0.0 {
            return None;
        }
        let [at, normal] = [place, normal].map(|t| [0, 1, 2].map(|i| f64::from(t[i])));
        // Meshes have facets.
        let from = add(at, normal, 2.5e-3);
        let expected = hidden(from, unit(normal), 32, |from, ray| meshes.hit(from, ray, radius), falloff);
        Some((1.0 - f64::from(texel(&open, x, y)[0]), expected))
    });
    let found: Vec<_> = found.into_iter().flatten().collect();
    let Errors { rms, mean, count: n, .. } = Errors::of(found.iter().copied());
    let halo = found.iter().filter(|(measured, expected)| measured - expected > 0.1).count() as f64 / n as f64;
    let largest = found.iter().filter(|(_, expected)| *expected == 0.0).map(|f| f.0).fold(0.0, f64::max);
    println!(
        "{rms:.4} off, {mean:+.4} in the mean, {n} points; 0.1 too much on {:.2} %; in the open {largest:.4}",
        100.0 * halo
    );
    assert!(n > 1000 && rms < 0.045, "{rms} off");
    assert!(halo < 0.005, "{} of all points are hidden by 0.1 too much", halo);
    assert!(largest < 0.01, "the open is hidden by {largest}");
}
