//! Both presets with ambient occlusion against rays: 1,024 a point, weighted by the cosine, with the same radius and falloff, in
//! f64 and in geometry that is known without the G-buffer.

#[path = "support/preset.rs"]
mod preset;
#[path = "support/rays.rs"]
mod rays;
mod support;

use eddy::engine::Pixels;
use preset::*;
use rays::*;
use support::*;

/// Root mean square and mean of what is measured less what rays find.
fn errors(pairs: impl Iterator<Item = (f64, f64)>) -> (f64, f64, usize) {
    let (mut square, mut sum, mut n) = (0.0, 0.0, 0);
    for (measured, expected) in pairs {
        square += (measured - expected).powi(2);
        sum += measured - expected;
        n += 1;
    }
    ((square / n as f64).sqrt(), sum / n as f64, n)
}

// ------------------------------------------------------------------------------------------------ the still life

const TABLE: u32 = 1;
const DIE: u32 = 3;

fn cylinder(p: V, radius: f64, half: f64) -> f64 {
    let q = [p[0].hypot(p[2]) - radius, p[1].abs() - half];
    q[0].max(q[1]).min(0.0) + q[0].max(0.0).hypot(q[1].max(0.0))
}

/// The distance to the things on the table of `scene.glsl`: a mug, a die, a ball, a ring.
fn things(p: V) -> f64 {
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

fn march(from: V, ray: V, limit: f64) -> Option<f64> {
    let mut t = 0.0;
    while t < limit {
        let p = add(from, ray, t);
        // Above all things, and never again among them.
        if p[1] > 1.2 && ray[1] >= 0.0 {
            return None;
        }
        let d = things(p);
        if d < 2e-5 {
            return Some(t);
        }
        t += d;
    }
    None
}

/// The first of the things and the table.
fn still_life(from: V, ray: V, limit: f64) -> Option<f64> {
    let table = if ray[1] < 0.0 { -from[1] / ray[1] } else { f64::INFINITY };
    march(from, ray, limit.min(table)).or((table < limit).then_some(table))
}

#[test]
fn occlusion_on_the_still_life_is_that_of_rays() {
    let Some(gpu) = gpu() else { return };
    let (width, height) = (640u32, 360u32);
    let radius = 0.8;
    let mut engine = whole(&gpu, &preset("gbuffer-ssao-ssr", &["turning=0"]), (width, height));
    draw(&mut engine, 0..1);
    let (surfaces, measured) = (read(&mut engine, "A"), read(&mut engine, "C"));
    // The camera at rest, from its description: 0.35 round, 0.46 down, 5.2 away.
    let (angle, pitch) = (0.35f64, 0.46f64);
    let back = [angle.sin() * pitch.cos(), pitch.sin(), angle.cos() * pitch.cos()];
    let right = unit(cross([0.0, 1.0, 0.0], back));
    let (up, eye) = (cross(back, right), add([0.0, 0.42, 0.05], back, 5.2));
    let unit_pixels = f64::from(height).min(0.8 * f64::from(width)) * 1.8;
    let material = |x: u32, y: u32| texel(&surfaces, x.min(width - 1), y.min(height - 1))[3] as u32;
    let spots: Vec<(u32, u32)> =
        (0..height).step_by(9).flat_map(|y| (0..width).step_by(9).map(move |x| (x, y))).collect();
    let found = on_all_cores(&spots, |&(x, y)| {
        // A point on an edge may be either side's.
        if (0..9)
            .any(|i| material((x + i % 3 * 2).saturating_sub(2), (y + i / 3 * 2).saturating_sub(2)) != material(x, y))
        {
            return None;
        }
        let q = [f64::from(x) + 0.5 - 0.5 * f64::from(width), f64::from(y) + 0.5 - 0.5 * f64::from(height)];
        let ray = unit(add(add(right.map(|v| v * q[0] / unit_pixels), up, q[1] / unit_pixels), back, -1.0));
        let at = add(eye, ray, still_life(eye, ray, 14.0)?);
        let normal = if at[1] < 1e-9 {
            [0.0, 1.0, 0.0]
        } else {
            let slope = |axis: usize| {
                let step = [0, 1, 2].map(|i| if i == axis { 1e-5 } else { 0.0 });
                things(add(at, step, 1.0)) - things(add(at, step, -1.0))
            };
            unit([slope(0), slope(1), slope(2)])
        };
        let falloff = |d: f64| ((radius - d) / (0.4 * radius)).clamp(0.0, 1.0);
        let expected = hidden(add(at, normal, 1e-4), normal, 32, |from, ray| still_life(from, ray, radius), falloff);
        Some((material(x, y), normal[1], f64::from(texel(&measured, x, y)[0]), expected))
    });
    let found: Vec<_> = found.into_iter().flatten().collect();
    let pairs = found.iter().map(|&(.., measured, expected)| (measured, expected));
    let upright =
        found.iter().filter(|f| f.0 == DIE && f.1 < 0.5).map(|&(.., measured, expected)| (measured, expected));
    let (all, sides) = (errors(pairs), errors(upright));
    let open: Vec<f64> = found.iter().filter(|f| f.0 == TABLE && f.3 == 0.0).map(|f| f.2).collect();
    let most = open.iter().copied().fold(0.0, f64::max);
    println!("all: {:.4} off, {:+.4} in the mean, {} points", all.0, all.1, all.2);
    println!("the die's upright faces: {:.4} off, {:+.4} in the mean, {} points", sides.0, sides.1, sides.2);
    println!("open table: at most {most:.4}, {} points", open.len());
    assert!(all.2 > 1500 && all.0 < 0.05, "{} off", all.0);
    assert!(sides.2 > 30 && sides.1 > -0.08, "the die's upright faces are {} too bright", -sides.1);
    assert!(open.len() > 500 && most < 0.01, "the open table is hidden by {most}");
}

// --------------------------------------------------------------------------------------------------- the meshes

#[test]
fn occlusion_among_meshes_is_that_of_rays() {
    let Some(gpu) = gpu() else { return };
    let (width, height) = (320u32, 180u32);
    let radius = 0.6;
    let project = preset("ssao", &["power=1"]);
    let mut engine = whole(&gpu, &project, (width, height));
    draw(&mut engine, 0..1);
    let target =
        |engine: &mut eddy::engine::Engine, i| -> Pixels { engine.read_target(&buffer("geometry"), i).unwrap() };
    let (world, normals, open) = (target(&mut engine, 1), target(&mut engine, 2), read(&mut engine, "blur"));
    let geometry = project.pass(&buffer("geometry")).unwrap().settings.geometry.as_ref().unwrap();
    let meshes = Meshes::of(&geometry.draws);
    let spots: Vec<(u32, u32)> =
        (2..height).step_by(5).flat_map(|y| (2..width).step_by(5).map(move |x| (x, y))).collect();
    // A sample of the length s = radius (0.1 + 0.9 u u), u uniform, finds what is no farther than s.
    let falloff = |d: f64| 1.0 - ((d / radius - 0.1).max(0.0) / 0.9).sqrt();
    let found = on_all_cores(&spots, |&(x, y)| {
        let [place, normal] = [&world, &normals].map(|p| texel(p, x, y));
        if place[3] == 0.0 {
            return None;
        }
        let [at, normal] = [place, normal].map(|t| [0, 1, 2].map(|i| f64::from(t[i])));
        // Positions have 11 bits, and meshes facets.
        let from = add(at, normal, 2.5e-3);
        let expected = hidden(from, unit(normal), 32, |from, ray| meshes.hit(from, ray, radius), falloff);
        Some((1.0 - f64::from(texel(&open, x, y)[0]), expected))
    });
    let found: Vec<_> = found.into_iter().flatten().collect();
    let (rms, mean, n) = errors(found.iter().copied());
    let halo = found.iter().filter(|(measured, expected)| measured - expected > 0.1).count() as f64 / n as f64;
    let most = found.iter().filter(|(_, expected)| *expected == 0.0).map(|f| f.0).fold(0.0, f64::max);
    println!(
        "{rms:.4} off, {mean:+.4} in the mean, {n} points; 0.1 too much on {:.2} %; in the open {most:.4}",
        100.0 * halo
    );
    assert!(n > 1000 && rms < 0.045, "{rms} off");
    assert!(halo < 0.005, "{} of all points are hidden by 0.1 too much", halo);
    assert!(most < 0.01, "the open is hidden by {most}");
}
