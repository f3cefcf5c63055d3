//! Measurements of the presets that solve for a flow: self-advection, the accurate fluid, the multi-scale fluid.

use crate::support::{presets::*, *};
use eddy::{
    engine::{BuildOptions, Engine, FrameInputs, Pixels},
    media::MediaSet,
    project::{PassName, Project},
};
use std::f64::consts::PI;

// ---------------------------------------------------------------------------------------------------- self-advection

#[test]
fn leaving_the_ring_loop_early_does_not_change_the_flow() {
    let Some(gpu) = gpu() else { return };
    // Rings of 2 * 1.25^n pixels in a picture 36 pixels high: the twelfth has a radius of 23, the thirteenth of 29,
    // beyond 0.7 * 36 = 25.
    let flow = |custom_uniforms: &[&str]| {
        let project = preset_with("self-advection", custom_uniforms);
        let mut engine = drawn(&gpu, &project, true, (64, 36), 0..12, drag);
        [buffer("flow"), PassName::image()].map(|id| bits(&engine.read(&id).unwrap()))
    };
    let all = flow(&["growth=1.25", "scales=20"]);
    assert!(all == flow(&["growth=1.25", "scales=12"]), "a ring beyond the limit was sampled");
    assert!(all != flow(&["growth=1.25", "scales=11"]), "a ring within the limit was not sampled");
    // Without rings there is no flow.
    assert!(flow(&["scales=0"])[0].iter().all(|t| t[..2] == [0, 0]));
}

/// Returns the flow of a vector field; `field` is GLSL in terms of `c`, the pixel's position.
fn flow_of(engine: impl Fn(&Project) -> Engine, custom_uniforms: &[&str], field: &str) -> Pixels {
    let mut project = preset_with("self-advection", custom_uniforms);
    overwrite(&mut project, "paint", &format!("o = vec4({field}, 0.0, 0.0);"));
    let mut engine = engine(&project);
    draw(&mut engine, 0..2, untouched);
    engine.read(&buffer("flow")).unwrap()
}

#[test]
fn uniform_rotating_and_sheared_fields_cause_no_flow() {
    let Some(gpu) = gpu() else { return };
    let engine = |p: &Project| whole(&gpu, p, true, (128, 128));
    // Away from the seam where the picture repeats; rings of 2, 4 and 8 pixels reach 16 pixels.
    let inner = |flow: &Pixels| {
        let mut largest = 0.0f32;
        for y in 6..26 {
            for x in 6..26 {
                largest = largest.max(texel(flow, x, y)[0].hypot(texel(flow, x, y)[1]));
            }
        }
        largest
    };
    let three = ["scales=3"];
    assert!(inner(&flow_of(engine, &[], "vec2(0.6, -0.3)")) < 1e-5, "uniform");
    assert!(inner(&flow_of(engine, &three, "0.01 * perp(c - 64.0)")) < 1e-4, "a rigid rotation");
    assert!(inner(&flow_of(engine, &three, "vec2(0.01 * (c.y - 64.0), 0.0)")) < 1e-4, "a shear");
    // An eddy in the middle moves its surroundings around it, in its direction of rotation.
    let eddy = flow_of(engine, &["scales=5"], "perp(c - 64.0) / 6.0 * exp(-dot(c - 64.0, c - 64.0) / 72.0)");
    for step in 0..12 {
        let angle = f64::from(step) * PI / 6.0;
        let (x, y) = (15.5 + 3.0 * angle.cos(), 15.5 + 3.0 * angle.sin());
        let at = texel(&eddy, x.round() as u32, y.round() as u32);
        let along = -angle.sin() * f64::from(at[0]) + angle.cos() * f64::from(at[1]);
        let outward = angle.cos() * f64::from(at[0]) + angle.sin() * f64::from(at[1]);
        assert!(along > 0.05 && outward.abs() < 0.5 * along, "{angle}: {along} along, {outward} outward");
    }
}

// ---------------------------------------------------------------------------------------------------- fluid-accurate

/// Returns the velocity on a texel's faces, 0 in the walls.
fn faces(u: &Pixels, x: u32, y: u32) -> [f64; 2] {
    let at = |x, y, c: usize| if x < u.width && y < u.height { f64::from(texel(u, x, y)[c]) } else { 0.0 };
    [if x > 0 { at(x, y, 0) } else { 0.0 }, if y > 0 { at(x, y, 1) } else { 0.0 }]
}

/// Returns the root mean square of the divergence of a staggered velocity.
fn divergence(u: &Pixels) -> f64 {
    let mut sum = 0.0;
    for y in 0..u.height {
        for x in 0..u.width {
            let d = faces(u, x + 1, y)[0] - faces(u, x, y)[0] + faces(u, x, y + 1)[1] - faces(u, x, y)[1];
            sum += d * d;
        }
    }
    (sum / f64::from(u.width * u.height)).sqrt()
}

fn energy(u: &Pixels) -> f64 {
    u.texels.iter().map(|t| f64::from(t[0]).powi(2) + f64::from(t[1]).powi(2)).sum()
}

/// Returns the accurate fluid without jets or dye, with an initial velocity in frame 0 from a GLSL expression in terms
/// of `at`, the middle of a face in cells.
fn accurate(custom_uniforms: &[&str], initial: &str) -> Project {
    let mut project = preset_with("fluid-accurate", &[&["jets=0"], custom_uniforms].concat());
    let code = format!(
        "vec2 at = c - vec2(0.5, 0.0); vec2 u = {initial}; at = c - vec2(0.0, 0.5); vec2 v = {initial};
         if (iFrame == 0) o = vec4(u.x, v.y, 0.0, 0.0);"
    );
    overwrite(&mut project, "velocity", &code);
    project.passes.retain(|p| !["dye", "sums_64", "sums_8", "ledger"].map(buffer).contains(&p.id));
    let image = project.image_mut().unwrap();
    image.source.text = "void mainImage(out vec4 o, in vec2 c) { o = texelFetch(iChannel0, ivec2(c) / 2, 0); }".into();
    image.bindings.set(0, nearest("velocity"));
    project
}

/// Returns an engine of `cells` by `cells` whose velocity can be read.
fn square(gpu: &eddy::gpu::Gpu, project: &Project, cells: u32) -> Engine {
    let options = BuildOptions { requested: vec![buffer("velocity")], ..Default::default() };
    engine_with(gpu, project, &MediaSet::new(), &options, (2 * cells, 2 * cells))
}

/// Returns the value of the slider `speed` at which a velocity of 1 crosses `number` cells per frame.
fn courant(number: f64, cells: u32) -> String {
    format!("speed={}", number * 60.0 / f64::from(cells))
}

fn velocity(engine: &mut Engine) -> Pixels {
    engine.read(&buffer("velocity")).unwrap()
}

/// Returns the relative L2 error against `exact`, a velocity in terms of x and y from 0 to 1.
fn relative_error(found: &Pixels, exact: impl Fn(f64, f64) -> [f64; 2]) -> f64 {
    let (n, mut error, mut all) = (f64::from(found.width), 0.0, 0.0);
    for y in 0..found.height {
        for x in 0..found.width {
            let (i, j) = (f64::from(x) / n, f64::from(y) / n);
            let half = 0.5 / n;
            for (c, e) in [exact(i, j + half)[0], exact(i + half, j)[1]].into_iter().enumerate() {
                error += (f64::from(texel(found, x, y)[c]) - e).powi(2);
                all += e * e;
            }
        }
    }
    (error / all).sqrt()
}

#[test]
fn a_v_cycle_reduces_divergence_to_a_fifth() {
    let Some(gpu) = gpu() else { return };
    // Divergence of every wavelength: noise, and a wave as long as the picture, which sweeps alone barely reduce.
    let seed =
        "if (iFrame == 0) o.xy = 0.1 * (fract(sin(vec2(p.x * 12 + p.y * 78, p.x * 39 + p.y * 11)) * 4375.8) - 0.5)
        + sin(3.1416 * vec2(p) / vec2(textureSize(iChannel0, 0))) * vec2(1.0, 0.5);
        if (p.x == 0) o.x = 0.0;
        if (p.y == 0) o.y = 0.0;";
    for size in [(128, 128), (192, 108), (131, 97), (66, 250), (480, 270), (1024, 64), (1920, 1080)] {
        // Time is stopped, so each frame only projects the result of the previous one.
        let mut project = preset_with("fluid-accurate", &["speed=0"]);
        overwrite(&mut project, "advected", seed);
        let mut engine = drawn(&gpu, &project, true, size, 0..1, untouched);
        let before = divergence(&engine.read(&buffer("advected")).unwrap());
        let mut left = vec![before, divergence(&velocity(&mut engine))];
        for frame in 1..4 {
            draw(&mut engine, frame..frame + 1, untouched);
            left.push(divergence(&velocity(&mut engine)));
        }
        let factors: Vec<f64> = left.windows(2).map(|w| w[1] / w[0]).collect();
        println!("{size:?}: {factors:.3?}");
        assert!(factors.iter().all(|f| *f < 0.2), "{size:?}: divergence is scaled by {factors:?} per cycle");
    }
}

/// The coarsest grid is smoothed, not solved: if it had many cells, the remaining error grew from frame to frame.
#[test]
fn dragging_in_a_long_picture_keeps_the_speed_bounded() {
    let Some(gpu) = gpu() else { return };
    let project = preset_with("fluid-accurate", &[]);
    let mut engine = whole(&gpu, &project, true, (4096, 16));
    let from = [1024.0, 4.0];
    draw(&mut engine, 0..120, |frame| {
        let at = [from[0] + 32.0 * (frame - 30) as f32, from[1]];
        held(frame, (30..60).contains(&frame).then_some((from, at)))
    });
    let fastest = velocity(&mut engine).texels.iter().map(|t| t[0].hypot(t[1])).fold(0.0, f32::max);
    // Picture heights per second: the bound of `lab stability`.
    assert!(fastest < 4.5, "{fastest}");
}

/// Taylor-Green eddies, one wave across, `at` in cells: u = sin kx cos ky, v = -cos kx sin ky. They satisfy free-slip
/// walls.
fn taylor_green(cells: u32) -> String {
    let k = 2.0 * PI / f64::from(cells);
    format!("vec2(sin({k} * at.x) * cos({k} * at.y), -cos({k} * at.x) * sin({k} * at.y))")
}

/// The same eddies in box coordinates, carried by a wind along x for `time` and decayed to `kept`.
fn carried_eddies(wind: f64, time: f64, kept: f64) -> impl Fn(f64, f64) -> [f64; 2] {
    move |x, y| {
        let (x, y) = (2.0 * PI * (x - wind * time), 2.0 * PI * y);
        [wind + kept * x.sin() * y.cos(), -kept * x.cos() * y.sin()]
    }
}

/// Returns the largest speed in the velocity.
fn fastest(engine: &mut Engine) -> f32 {
    velocity(engine).texels.iter().map(|t| t[0].hypot(t[1])).fold(0.0, f32::max)
}

#[test]
fn a_uniform_wind_stays_constant() {
    let Some(gpu) = gpu() else { return };
    // A thousand frames with viscosity: biased rounding errors would accumulate.
    let wind = [0.5f32, 0.3];
    let project = accurate(&["walls=2", "viscosity=0.0015"], "vec2(0.5, 0.3)");
    let mut engine = square(&gpu, &project, 32);
    draw(&mut engine, 0..1001, untouched);
    let deviation = |t: &[f32; 4]| (0..2).map(|c| (t[c] / wind[c] - 1.0).abs()).fold(0.0, f32::max);
    let largest = velocity(&mut engine).texels.iter().map(deviation).fold(0.0, f32::max);
    println!("a uniform wind is off by {largest:e} of itself after 1,000 frames");
    assert!(largest < 1e-6, "{largest:e}");
}

#[test]
fn a_fast_lid_keeps_speeds_bounded() {
    let Some(gpu) = gpu() else { return };
    // Without viscosity, at sliders that request steps of 30 cells.
    let project = preset_with("fluid-accurate", &["walls=1", "lid_speed=2", "speed=10"]);
    let mut engine = whole(&gpu, &project, true, (320, 180));
    let mut largest = 0.0f32;
    for part in 0..10 {
        draw(&mut engine, 30 * part..30 * part + 30, untouched);
        largest = largest.max(fastest(&mut engine));
    }
    let pace = texel(&engine.read(&buffer("pace")).unwrap(), 0, 0)[0];
    println!("a lid of 2 makes {largest} at most, at a pace of {pace}");
    assert!(largest > 1.0 && largest < 2.2, "{largest}");
    assert!(pace < 0.5, "{pace}: time was not slowed down");
    // At the preset's defaults no step is shortened.
    let mut engine = whole(&gpu, &preset_with("fluid-accurate", &[]), true, (320, 180));
    for part in 0..4 {
        draw(&mut engine, 30 * part..30 * part + 30, untouched);
        assert_eq!(texel(&engine.read(&buffer("pace")).unwrap(), 0, 0)[0], 1.0);
    }
}

/// Returns the sum of the dye in picture pixels.
fn dye_of(engine: &mut Engine) -> f64 {
    engine.read(&buffer("dye")).unwrap().texels.iter().map(|t| f64::from(t[0])).sum()
}

/// Returns the preset without jets, with an initial velocity in terms of `at` in cells, and a round blob of dye with a
/// radius of 12 pixels in the middle.
fn with_blob(custom_uniforms: &[&str], initial: &str) -> Project {
    let mut project = preset_with("fluid-accurate", &[&["jets=0", "fade_seconds=120"], custom_uniforms].concat());
    let code = format!(
        "vec2 at = c - vec2(0.5, 0.0); vec2 u = {initial}; at = c - vec2(0.0, 0.5); vec2 v = {initial};
         if (iFrame == 0) o = vec4(u.x, v.y, 0.0, 0.0);"
    );
    overwrite(&mut project, "velocity", &code);
    overwrite(
        &mut project,
        "dye",
        "vec2 off = (c - 0.5 * iResolution.xy) / 12.0; if (iFrame == 0) o = vec4(exp(-dot(off, off)), 0.0, 0.0, 0.0);",
    );
    project
}

#[test]
fn dye_wraps_around_a_periodic_picture() {
    let Some(gpu) = gpu() else { return };
    // Once around a picture of 128 pixels, at 4 pixels per frame, in a wind along both axes.
    let mut engine = whole(&gpu, &with_blob(&["walls=2"], "vec2(1.875, 1.875)"), true, (128, 128));
    draw(&mut engine, 0..1, untouched);
    let (initial, first) = (dye_of(&mut engine), engine.read(&buffer("dye")).unwrap());
    draw(&mut engine, 1..33, untouched);
    let faded = (-32.0f64 / 60.0 / 120.0).exp();
    let (kept, last) = (dye_of(&mut engine) / (initial * faded), engine.read(&buffer("dye")).unwrap());
    let squares =
        first.texels.iter().zip(&last.texels).map(|(a, b)| (f64::from(b[0]) / faded - f64::from(a[0])).powi(2));
    let rms = (squares.sum::<f64>() / first.texels.iter().map(|t| f64::from(t[0]).powi(2)).sum::<f64>()).sqrt();
    println!("once round, {kept:.4} of the dye is left, {rms:.4} of it elsewhere");
    assert!((kept - 1.0).abs() < 1e-3 && rms < 0.05, "{kept}, {rms}");
}

#[test]
fn a_closed_box_keeps_its_dye() {
    let Some(gpu) = gpu() else { return };
    // Eddies that stir the blob for five seconds.
    let k = 2.0 * PI / 64.0;
    let initial = format!("0.5 * vec2(sin({k} * at.x) * cos({k} * at.y), -cos({k} * at.x) * sin({k} * at.y))");
    for walls in ["walls=0", "walls=2"] {
        let mut engine = whole(&gpu, &with_blob(&[walls], &initial), true, (256, 256));
        draw(&mut engine, 0..1, untouched);
        let initial_dye = dye_of(&mut engine);
        draw(&mut engine, 1..301, untouched);
        let kept = dye_of(&mut engine) / (initial_dye * (-300.0f64 / 60.0 / 120.0).exp());
        println!("{walls}: {kept:.4} of the dye after five seconds");
        assert!((kept - 1.0).abs() < 5e-3, "{walls}: {kept}");
    }
}

#[test]
fn jets_do_not_depend_on_the_frame_rate() {
    let Some(gpu) = gpu() else { return };
    // After two seconds at three frame rates: the energy of the flow, and the dye.
    let found = [30, 60, 120].map(|rate| {
        let mut engine = whole(&gpu, &preset_with("fluid-accurate", &[]), true, (320, 180));
        for frame in 0..2 * rate {
            engine.draw(&FrameInputs::at_fixed_step(frame, f64::from(rate))).unwrap();
        }
        let field = velocity(&mut engine);
        ((energy(&field) / f64::from(field.width * field.height)).sqrt(), dye_of(&mut engine))
    });
    println!("rms speed and dye at 30, 60 and 120 frames a second: {found:.4?}");
    for (speed, dye) in found {
        assert!((speed / found[1].0 - 1.0).abs() < 0.05, "{found:?}");
        assert!((dye / found[1].1 - 1.0).abs() < 0.05, "{found:?}");
    }
}

#[test]
fn halving_the_cells_quarters_the_error() {
    let Some(gpu) = gpu() else { return };
    // (name, custom uniforms, wind, largest error at 128 cells per side): half a cell per step, for one time unit.
    let cases: [(&str, &[&str], f64, f64); 2] =
        [("at rest", &["walls=0"], 0.0, 3e-4), ("in a wind", &["walls=2"], 0.5, 6e-4)];
    for (name, custom_uniforms, wind, limit) in cases {
        let errors = [32u32, 64, 128].map(|cells| {
            let initial = format!("{} + vec2({wind:?}, 0.0)", taylor_green(cells));
            let project = accurate(&[custom_uniforms, &[&*courant(0.5, cells)]].concat(), &initial);
            let mut engine = square(&gpu, &project, cells);
            draw(&mut engine, 0..2 * cells as i32 + 1, untouched);
            relative_error(&velocity(&mut engine), carried_eddies(wind, 1.0, 1.0))
        });
        let order = (errors[0] / errors[2]).log2() / 2.0;
        println!("Taylor-Green {name}: {errors:.5?}, order {order:.2}");
        assert!(errors[2] < limit && order > 1.95, "{name}: {errors:?}, order {order}");
    }
}

#[test]
fn eddies_decay_at_the_taylor_green_rate() {
    let Some(gpu) = gpu() else { return };
    // At 0.15 cells per step, the case of the reference table, and at 2.
    for (viscosity, number, seconds, limit) in [(0.0092, 0.15, 0.85, 0.001), (0.01, 2.0, 1.0, 0.006)] {
        let cells = 64u32;
        let custom_uniforms = [courant(number, cells), format!("viscosity={viscosity}")];
        let mut engine =
            square(&gpu, &accurate(&[&*custom_uniforms[0], &*custom_uniforms[1]], &taylor_green(cells)), cells);
        let steps = (seconds * f64::from(cells) / number).round();
        draw(&mut engine, 0..steps as i32 + 1, untouched);
        let time = steps * number / f64::from(cells);
        let rate = 2.0 * viscosity * (2.0 * PI).powi(2);
        let kept = (-rate * time).exp();
        let found = velocity(&mut engine);
        let error = relative_error(&found, carried_eddies(0.0, time, kept));
        // The energy of eddies of amplitude 1 is half the number of texels.
        let effective = -(energy(&found) / (0.5 * f64::from(cells * cells))).ln() / (2.0 * rate * time);
        println!("viscosity {viscosity}, {number} cells a step: error {error:.5}, viscosity as {effective:.5} of it");
        assert!(kept < 0.6, "{kept}: hardly anything decayed");
        assert!(error < limit && (effective - 1.0).abs() < limit, "error {error}, effective viscosity {effective}");
    }
}

/// A sinusoidal shear only decays, by e^(-nu k^2 t). Second differences would have an error of k^2 / 12 in cells: 5 %
/// and 1.3 % of the rate for waves of 8 and 16 cells.
#[test]
fn viscosity_is_fourth_order_accurate() {
    let Some(gpu) = gpu() else { return };
    let cells = 64u32;
    let error = |wave: u32, viscosity: f64, speed: f64, steps: i32| {
        let k = 2.0 * PI / f64::from(wave);
        let settings = ["walls=2".into(), format!("viscosity={viscosity}"), format!("speed={speed}")];
        let project = accurate(&settings.each_ref().map(String::as_str), &format!("vec2(0.1 * sin({k} * at.y), 0.0)"));
        let mut engine = square(&gpu, &project, cells);
        draw(&mut engine, 0..1, untouched);
        let before = energy(&velocity(&mut engine));
        draw(&mut engine, 1..1 + steps, untouched);
        let kept = (energy(&velocity(&mut engine)) / before).sqrt();
        let exact = viscosity * (k * f64::from(cells)).powi(2) * speed * f64::from(steps) / 60.0;
        assert!((0.2..2.0).contains(&exact), "{exact}");
        -kept.ln() / exact - 1.0
    };
    let (coarse, fine) = (error(8, 0.005, 1.0, 6), error(16, 0.005, 1.0, 24));
    // More than 2 cells squared per step.
    let quick = error(16, 0.01, 10.0, 1);
    println!("rates of waves of 8 and 16 cells are off by {coarse:.5} and {fine:.6}; in one long step {quick:.1e}");
    assert!(coarse.abs() < 0.005 && fine.abs() < 3e-4 && (coarse / fine).log2() > 3.5, "{coarse}, {fine}");
    assert!(quick.abs() < 2e-5, "{quick}");
}

#[test]
fn every_viscosity_is_stable_at_any_height() {
    let Some(gpu) = gpu() else { return };
    // A narrow picture 1080 high has the same numbers as a wide one: viscosity in cells squared per step is 4.9 and 490
    // at the ends.
    for custom_uniforms in
        [["viscosity=0.0001", "speed=1"], ["viscosity=0.0005", "speed=1"], ["viscosity=0.01", "speed=10"]]
    {
        let project = preset_with("fluid-accurate", &custom_uniforms);
        let options = BuildOptions { requested: vec![buffer("velocity")], ..Default::default() };
        let mut engine = engine_with(&gpu, &project, &MediaSet::new(), &options, (64, 1080));
        draw(&mut engine, 0..24, untouched);
        let found = velocity(&mut engine);
        let fastest = found.texels.iter().map(|t| t[0].hypot(t[1])).fold(0.0, f32::max);
        println!("{custom_uniforms:?}: {fastest}");
        // The jets blow at 0.55.
        assert!(all_finite(&found) && fastest > 1e-4 && fastest < 0.8, "{custom_uniforms:?}: {fastest}");
    }
}

/// Two shear layers in a periodic box that roll up: D. Brown, M. Minion, "Performance of Under-resolved Two-dimensional
/// Incompressible Flow Simulations", J. Comput. Phys. 122, 1995; rho = 30, delta = 0.05, nu = 1e-4, at t = 1.
#[test]
fn shear_layers_keep_as_much_energy_as_a_spectral_method() {
    let Some(gpu) = gpu() else { return };
    // 256 x 256 modes, fourth-order Runge-Kutta with steps of 1/1024, in f64.
    const SPECTRAL: f64 = 0.982_792;
    let cells = 128u32;
    let initial = "vec2(tanh(30.0 * (at.y < 64.0 ? at.y / 128.0 - 0.25 : 0.75 - at.y / 128.0)),
                        0.05 * sin(6.2831853 * at.x / 128.0))";
    let project = accurate(&["walls=2", "viscosity=0.0001", &courant(0.5, cells)], initial);
    let mut engine = square(&gpu, &project, cells);
    draw(&mut engine, 0..1, untouched);
    let initial_energy = energy(&velocity(&mut engine));
    draw(&mut engine, 1..2 * cells as i32 + 1, untouched);
    let kept = energy(&velocity(&mut engine)) / initial_energy;
    println!("shear layers keep {kept:.5} of their energy, {SPECTRAL} by a spectral method");
    assert!((kept - SPECTRAL).abs() < 0.001, "{kept}");
}

/// The lid-driven cavity of U. Ghia, K. Ghia, C. Shin, J. Comput. Phys. 48, 1982, at two cells per step.
#[test]
fn lid_driven_cavity_matches_the_tables_without_noise() {
    let Some(gpu) = gpu() else { return };
    // (y, u at x = 1/2) and (x, v at y = 1/2) for Re = 100, tables I and II.
    let across = [
        (0.9531, 0.68717),
        (0.8516, 0.23151),
        (0.7344, 0.00332),
        (0.5, -0.20581),
        (0.2813, -0.15662),
        (0.1016, -0.06434),
    ];
    let upwards = [(0.9453, -0.10313), (0.8594, -0.22445), (0.5, 0.05454), (0.2266, 0.17507), (0.0781, 0.10890)];
    let cells = 128u32;
    let project = accurate(&["walls=1", "lid_speed=1", "viscosity=0.01", &courant(2.0, cells)], "vec2(0.0)");
    let mut engine = square(&gpu, &project, cells);
    draw(&mut engine, 0..12 * cells as i32 / 2, untouched);
    let found = velocity(&mut engine);
    let (middle, n) = (cells / 2, f64::from(cells));
    // The faces of the middle line are on it; the outermost are half a cell from the walls.
    let on_line = |at: f64, value: &dyn Fn(u32) -> f32| {
        let g = at * n - 0.5;
        let (i, f) = (g.floor() as u32, g.fract());
        f64::from(value(i)) * (1.0 - f) + f64::from(value(i + 1)) * f
    };
    for (y, u) in across {
        let here = on_line(y, &|j| texel(&found, middle, j)[0]);
        assert!((here - u).abs() < 0.01, "u({y}) is {here}, not {u}");
    }
    for (x, v) in upwards {
        let here = on_line(x, &|i| texel(&found, i, middle)[1]);
        assert!((here - v).abs() < 0.01, "v({x}) is {here}, not {v}");
    }
    // The extremum by a high-order method, as of Botella and Peyret, is -0.2140424.
    let lowest = (0..cells).map(|j| texel(&found, middle, j)[0]).fold(0.0, f32::min);
    assert!((f64::from(lowest) + 0.214_042_4).abs() < 0.001, "{lowest}");
    // Cell-to-cell oscillations next to the lid.
    let u = |x: u32, y: u32| texel(&found, x, y)[0];
    let noise = (cells / 8..7 * cells / 8)
        .flat_map(|x| (0..cells).map(move |y| (x, y)))
        .map(|(x, y)| (u(x - 2, y) - 4.0 * u(x - 1, y) + 6.0 * u(x, y) - 4.0 * u(x + 1, y) + u(x + 2, y)).abs())
        .fold(0.0, f32::max);
    println!("least u {lowest}, fourth differences up to {noise}");
    assert!(noise < 5e-4, "{noise}");
}

#[test]
fn without_viscosity_energy_is_kept_and_never_grows() {
    let Some(gpu) = gpu() else { return };
    // The loss that the preset's text states, also for paths ten times as long.
    for (speed, limit) in [("speed=1", 0.995), ("speed=10", 0.95)] {
        let initial = format!("0.2 * {}", taylor_green(48));
        let mut engine = square(&gpu, &accurate(&["viscosity=0", speed], &initial), 48);
        draw(&mut engine, 0..1, untouched);
        let initial_energy = energy(&velocity(&mut engine));
        let mut before = initial_energy;
        for part in 0..6 {
            draw(&mut engine, 1 + 50 * part..51 + 50 * part, untouched);
            let now = energy(&velocity(&mut engine));
            assert!(now <= before * 1.001, "{speed}: energy grew from {before} to {now}");
            before = now;
        }
        println!("{speed}: {:.4} of the energy after 300 frames", before / initial_energy);
        assert!(before > limit * initial_energy, "{speed}: only {} of the energy is left", before / initial_energy);
    }
}

// --------------------------------------------------------------------------------------------------------- mip-fluid

/// Returns the mip fluid's velocity after frame 0, which is written from GLSL in terms of `c`, the texel's middle, and
/// after `frames` frames.
fn mip_velocity(
    gpu: &eddy::gpu::Gpu,
    custom_uniforms: &[&str],
    size: (u32, u32),
    field: &str,
    frames: i32,
) -> [Pixels; 2] {
    let mut project = preset_with("mip-fluid", custom_uniforms);
    overwrite(&mut project, "moved", &format!("if (iFrame == 0) o = vec4({field}, 0.0, 0.0);"));
    let mut engine = drawn(gpu, &project, true, size, 0..1, untouched);
    let initial = engine.read(&buffer("moved")).unwrap();
    draw(&mut engine, 1..frames, untouched);
    [initial, engine.read(&buffer("velocity")).unwrap()]
}

#[test]
fn a_uniform_flow_stays_uniform_for_every_number_of_scales() {
    let Some(gpu) = gpu() else { return };
    for size in [(64, 64), (96, 54), (75, 43), (128, 4)] {
        for scales in ["scales=0", "scales=1", "scales=5", "scales=12"] {
            for weights in ["weight_function=0", "weight_function=1"] {
                let custom_uniforms = ["stirring=0", "drag_seconds=60", scales, weights];
                let [_, flow] = mip_velocity(&gpu, &custom_uniforms, size, "vec2(0.3, -0.1)", 30);
                let kept = (-0.5f64 / 60.0).exp();
                for t in &flow.texels {
                    let difference =
                        (f64::from(t[0]) / (0.3 * kept) - 1.0).abs().max((f64::from(t[1]) / (-0.1 * kept) - 1.0).abs());
                    // 29 or 30 frames of drag; the same everywhere.
                    assert!(difference < 1e-3, "{size:?} {scales} {weights}: {t:?}");
                    assert!((t[0] - flow.texels[0][0]).abs() < 1e-6, "{size:?} {scales} {weights}: not uniform");
                }
            }
        }
    }
}

#[test]
fn the_sum_over_mips_reduces_divergence_at_every_wavelength() {
    let Some(gpu) = gpu() else { return };
    // Longitudinal waves of 1 to 32 periods across 128 texels, along each axis, and the fraction of their divergence
    // left after one frame.
    let left = |custom_uniforms: &[&str], wave: i32, axis: &str| {
        let k = 2.0 * PI * f64::from(wave) / 128.0;
        let unit = if axis == "x" { "vec2(1.0, 0.0)" } else { "vec2(0.0, 1.0)" };
        let field = format!("0.1 * {unit} * sin({k} * c.{axis})");
        let [before, after] = mip_velocity(&gpu, &[&["speed=0"], custom_uniforms].concat(), (256, 256), &field, 1);
        (energy(&after) / energy(&before)).sqrt()
    };
    for axis in ["x", "y"] {
        let of_waves = [1, 2, 4, 8, 16, 32].map(|wave| left(&[], wave, axis));
        println!("left of waves of 128, 64, 32, 16, 8, 4 texels along {axis}: {of_waves:.3?}");
        assert!(of_waves.iter().all(|l| *l < 0.8), "{of_waves:?}");
        // Fewer scales do not reach the long waves.
        let few = left(&["scales=3"], 1, axis);
        assert!(few > 0.9, "three scales left {few} of a wave of 128 texels");
        assert_eq!(left(&["scales=0"], 4, axis), 1.0, "no scales, no pressure");
    }
}

#[test]
fn long_steps_of_the_mip_fluid_add_no_energy() {
    let Some(gpu) = gpu() else { return };
    // Without the terms that feed eddies on purpose: only advection and a little drag act on them.
    let rest = ["stirring=0", "turbulence=0", "confinement=0", "drag_seconds=60"];
    for (speed, limit) in [("speed=1", 0.75), ("speed=10", 0.1)] {
        let custom_uniforms = [&rest[..], &[speed]].concat();
        let field = format!("0.3 * sin({} * c.yx)", 2.0 * PI / 64.0);
        let mut before = f64::MAX;
        let mut kept = 1.0;
        for frames in [1, 30, 60, 120] {
            let [initial, now] = mip_velocity(&gpu, &custom_uniforms, (128, 128), &field, frames);
            let now = energy(&now);
            assert!(now <= before * 1.001, "{speed}: energy grew from {before} to {now} by frame {frames}");
            (before, kept) = (now, now / energy(&initial));
        }
        println!("{speed}: {kept:.3} of the energy after two seconds");
        assert!(kept > limit, "{speed}: only {kept} of the energy is left");
    }
}
